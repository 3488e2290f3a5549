//! Tests `emit` through a post: names, tools, joined programs, rejections. (book: program/posts)

use crate::support::{Place, dxf, runs};
use insta::assert_snapshot;

const LIBRARY: &str = r#"
== pathbuild.toml ==
library = ["."]
feed = 150
rapid = 1000
sweep-height = 20
[tool.2mm]
diameter = 2
number = 4
spindle = 12000
coolant = "flood"
[tool.3mm]
diameter = 3
spindle = 9000
[tool.slot]
diameter = 2
paths = 'T$'
number = 7
spindle = 6000
direction = "ccw"
== 1234.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 40,0
end 40,0
== 1300.dxf ==
layer 1300.1P
start 0,20 "T5 O3 I1 B4 MPlate RX"
mill 0,20 40,20
end 40,20
== 1400.1T.dxf ==
layer 1400.1T
start 0,0 "T5 O2 S9 I1 B4 MPlate"
mill 0,0 0,10
end 0,10
== 1500.dxf ==
layer 1500.1P
start 0,0 "T5 O2 I1 B4 MPlate"
sweep 0,0 10,0
circle 10,0 d 2 "B0 C2"
sweep 10,0 20,0
end 20,0
== 1600.dxf ==
layer 1600.1P
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 40,0
probe 20,20 "LA"
end 40,0
"#;

/// Creates the library with further lines at the top of its configuration.
fn library(head: &str) -> Place {
    Place::of(&LIBRARY.replace("library = [\".\"]", &format!("library = [\".\"]\n{head}")))
}

/// Names of paths do not differ by case, so the layer `1400.1t` has the same tool.
#[test]
fn the_tool_of_a_path_does_not_depend_on_case() {
    let drawing = LIBRARY.replace("layer 1400.1T", "layer 1400.1t");
    let place = Place::of(&drawing);
    let written = runs(&place, ["emit 1400.1T --post linuxcnc -o -"]);
    assert!(written.contains("T7 M6") && written.contains("S6000"), "{written}");
}

#[test]
fn a_program_is_written_through_a_post() {
    let place = library("");
    assert_snapshot!(runs(
        &place,
        [
            "emit 1234.1P --post grbl",
            "emit 1234.1P --post grbl",
            "emit 1300.1P 1234.1P --post fanuc --out-dir out",
            "emit 1234.1P --post linuxcnc -o - --date 2026-11-21",
            "emit 1234.1P --post grbll --format concise",
            "emit 1234.1P --post missing.cbpp --format concise",
        ]
    ));
    assert_snapshot!(place.read("1234_Milling.gcode"));
    assert!(place.path().join("out/1300X_Milling.nc").is_file(), "R is part of the name");
}

/// A program of pathbuild always has an end. A foreign program may lack one.
#[test]
fn a_program_that_was_cut_off_is_not_converted() {
    let place = library("");
    for post in ["native", "grbl"] {
        let whole = place.run(&format!("emit 1234.1P -o - --post {post}")).stdout;
        let lines: Vec<&str> = whole.split_inclusive('\n').collect();
        let half = lines[..lines.len() / 2].concat();
        let foreign = half.replace("pathbuild", "another program");
        for (text, is_refused) in [(&whole, false), (&half, true), (&foreign, false)] {
            std::fs::write(place.path().join("a.nc"), text).unwrap();
            let run = place.run("post a.nc --post linuxcnc -o -");
            assert_eq!(run.stderr.contains("error[PB710]"), is_refused, "{text} {run}");
            assert_eq!(run.stdout.is_empty(), is_refused, "{run}");
        }
    }
}

#[test]
fn the_configurations_post_is_the_default_and_native_can_be_asked_for() {
    let place = library("post = \"grbl\"");
    assert!(place.run("emit 1234.1P -o -").stdout.starts_with("(Program 1234.1P)"));
    assert!(place.run("emit 1234.1P -o - --post native").stdout.starts_with("%\n(pathbuild"));
    let below = Place::new()
        .file("posts/my.cbpp", "<PostProcessor><PostFile>(mine)\n{$mops}</PostFile></PostProcessor>")
        .file(
            "pathbuild.toml",
            "post = \"posts/my.cbpp\"\nspindle = \"manual\"\nfeed = 1\nrapid = 1\nsweep-height = 20\n",
        )
        .file("drawings/1234.dxf", std::fs::read(library("").path().join("1234.dxf")).unwrap());
    let run = below.run_in("drawings", &["emit", "1234.dxf", "-o", "-"]);
    assert!(run.stdout.starts_with("(mine)"), "a post's file is relative to the configuration: {run}");
}

/// Native programs always contain T1; their header names O.
#[test]
fn a_native_program_gets_the_cutter_of_its_path() {
    let tools = "[tool.fine]\ndiameter = 2\nSPINDLE = 12000\n[tool.coarse]\ndiameter = 6\nnumber = 1\nspindle = 3000\n";
    let posted = |tools: &str| {
        let place = Place::of(
            "== pathbuild.toml ==\nfeed = 150\nrapid = 1000\nsweep-height = 20\n\n== 1234.1P.dxf ==\nlayer 1234.1P\nstart 0,0 \"T5 O2 I1 B4\"\nmill 0,0 40,0\nend 40,0\n",
        );
        let place =
            place.file("pathbuild.toml", format!("feed = 150\nrapid = 1000\nsweep-height = 20\n{tools}"));
        place.run("emit 1234.1P");
        place.run("post 1234.1P_Milling.gcode --post linuxcnc --format concise")
    };
    for (tool, number) in [("number = 3\nspindle", "T3 M6"), ("spindle", "T2 M6")] {
        let run = posted(&tools.replace("SPINDLE", tool));
        assert_eq!(run.status, Some(0), "{run}");
        assert!(run.stdout.contains(number) && run.stdout.contains("M3 S12000"), "{run}");
    }
    let run = posted(&tools.replace("SPINDLE", "spindle").replace("diameter = 2", "diameter = 2.5"));
    assert!(run.stderr.contains("PB764") || run.stderr.contains("PB754"), "no tool is guessed: {run}");
    assert!(!run.stdout.contains("S3000"), "{run}");
}

/// No `paths` matches the project; the tool of its component has a speed.
#[test]
fn a_project_without_a_tool_is_named() {
    let emitted = |paths: &str| {
        let place = Place::of(
            "== 8001.1P.dxf ==\nlayer 8001.1P\nstart 0,0 \"T5 O2\"\nsubpath 0,0 40,0 \">1234.1P MX\"\nend 40,0\n\n== 1234.1P.dxf ==\nlayer 1234.1P\nstart 0,0 \"T5 O2 I1 B4 MX\"\nmill 0,0 40,0\nend 40,0\n",
        );
        let tools = format!("[tool.one]\ndiameter = 2\nspindle = 9000\npaths = '{paths}'\n");
        let place =
            place.file("pathbuild.toml", format!("feed = 150\nrapid = 1000\nsweep-height = 20\n{tools}"));
        place.run("emit 8001.1P --post linuxcnc --format concise -o -")
    };
    let run = emitted("^7");
    assert!(
        run.stderr.contains("PB754") && run.stderr.contains("for path 8001.1P: each [tool] with"),
        "{run}"
    );
    assert!(emitted("^8").stdout.contains("M3 S9000"));
}

#[test]
fn tools_come_from_the_configuration() {
    let place = library("");
    let tool = |path: &str| {
        let text = place.run(&format!("emit {path} --post linuxcnc -o - -q")).stdout;
        let is_of_tools = |line: &&str| line.contains('T') && line.contains("M6") || line.starts_with('M');
        text.lines().filter(is_of_tools).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(tool("1234.1P"), "T4 M6 M3 S12000 M8 M5 M9 M30");
    assert_eq!(tool("1400.1T"), "T7 M6 M4 S6000 M5 M9 M30");
    assert_eq!(tool("1300.1P"), "T1 M6 M3 S9000 M5 M9 M30");
    let without = |head: &str| {
        let text = LIBRARY.replace("[tool.3mm]\ndiameter = 3\nspindle = 9000\n", "");
        Place::of(&text.replace("library =", &format!("{head}library =")))
            .run("emit 1300.1P --post linuxcnc --format concise")
    };
    assert_snapshot!(without("spindle = \"manual\"\n"));
    assert_snapshot!(without(""));
    let notes = |path: &str| place.run(&format!("emit {path} --post xpertmill -o -")).stderr;
    let both = notes("1234.1P");
    assert!(both.contains("~ToolControl1~") && both.contains("~MillingSpindleDir~"), "{both}");
}

#[test]
fn what_the_machine_cannot_do_is_not_written() {
    let place = |machine: &str| {
        Place::of(&LIBRARY.replace("[tool.2mm]", &format!("[machine]\n{machine}\n[tool.2mm]")))
    };
    for (machine, post, status) in [
        ("travel = [40, 200, 60]", "native", 0),
        ("travel = [39, 200, 60]", "native", 1),
        ("x = [0, 40]", "grbl", 0),
        ("x = [1, 40]", "grbl", 1),
        ("spindle-speeds = [3000, 12000]", "linuxcnc", 0),
        ("spindle-speeds = [3000, 11999]", "linuxcnc", 1),
    ] {
        let run = place(machine).run(&format!("emit 1234.1P --post {post} --out-dir out"));
        assert_eq!(run.status, Some(status), "{machine}, {post}: {run}");
    }
    assert_snapshot!(runs(
        &place("travel = [39, 200, 60]\nspindle-speeds = [3000, 11999]"),
        ["emit 1234.1P", "emit 1234.1P --post fanuc", "emit 1300.1P --post fanuc --format concise"]
    ));
}

#[test]
fn a_rewritten_program_names_its_own_dialect() {
    let place = library("spindle = \"manual\"\nprobe-feed = 40");
    assert_eq!(place.run("emit 1600.1P 1234.1P").status, Some(0));
    for post in ["grbl", "linuxcnc", "mach3", "fanuc", "haas", "marlin"] {
        for program in ["1600_Probing.gcode", "1234_Milling.gcode"] {
            let output = program.replace("gcode", post);
            let run = place.run(&format!("post {program} --post {post} -o {output}"));
            assert_eq!(run.status, Some(0), "{run}");
            let text = place.read(&output);
            assert!(text.to_lowercase().contains(&format!(" {post} o2 t5")), "{text}");
            assert!(!text.to_lowercase().contains(" native "), "{text}");
            let verified = place.run(&format!("verify {output}"));
            assert!(verified.status == Some(0), "{verified}");
        }
    }
    let again = place.run("post 1234_Milling.linuxcnc --post haas -o again.nc");
    assert_eq!(again.status, Some(0), "{again}");
    let text = place.read("again.nc").to_lowercase();
    assert!(text.contains(" haas o2 t5") && !text.contains(" linuxcnc "), "{text}");
}

#[test]
fn the_feed_of_paths_without_f_is_held_against_the_machine_s() {
    let place = Place::of(&LIBRARY.replace("[tool.2mm]", "[machine]\nmaximum-feed = 150\n[tool.2mm]"));
    assert_snapshot!(runs(
        &place,
        [
            "emit 1234.1P --format concise --out-dir out",
            "emit 1234.1P --feed 151 --format concise --out-dir out",
            "emit 1234.1P --feed 151 --post grbl --out-dir out",
            "check 1234.1P --feed 151"
        ]
    ));
}

/// Windows takes a name such as `CON` for a device, whatever follows its first dot.
#[test]
fn a_joined_program_is_not_named_like_a_device() {
    let is_device = |name: &str| {
        let run = library("").run(&format!("emit --join {name} 1234.1P --post linuxcnc --lang en"));
        let is_refused = run.stderr.contains("denotes a device");
        assert_eq!(run.status, Some(i32::from(is_refused)), "{run}");
        is_refused
    };
    for name in ["nul.x", "Com1.x", "lpt9.tap", "AUX.1.2", "com².x", "conin$.x"] {
        assert!(is_device(name), "{name}");
    }
    for name in ["nul", "Com0.x", "Com10.x", "x.nul", "Auxiliary.x"] {
        assert!(!is_device(name), "{name}");
    }
}

#[test]
fn paths_are_joined_with_tool_changes_in_the_order_of_the_arguments() {
    let place = library("");
    assert_snapshot!(runs(
        &place,
        [
            "emit --join sheet 1400.1T 1234.1P 1300.1P --post linuxcnc",
            "emit --join sheet 1300.dxf 1400.1T --post grbl -o -",
            "emit --join sheet 1234.1P 1600.1P --post grbl",
            "emit --join ../sheet 1234.1P --post grbl --format concise",
            "emit --join sheet 1234.1P 1300.1P",
        ]
    ));
    let text = place.read("sheet_Milling.ngc");
    let again = place.run("emit . --post linuxcnc --remove-stale --format concise");
    assert!(!again.stderr.contains("PB520") && place.path().join("sheet_Milling.ngc").exists(), "{again}");
    let changes: Vec<&str> = text.lines().filter(|line| line.ends_with("M6")).collect();
    assert_eq!(changes, ["T7 M6", "T4 M6", "T1 M6"]);
    assert!(!place.path().join("sheet_Milling.gcode").exists(), "of paths with probes nothing is written");
}

#[test]
fn holes_become_cycles_when_asked() {
    let moves = library("").run("emit 1500.1P --post linuxcnc -o -").stdout;
    let cycles = library("cycles = true").run("emit 1500.1P --post linuxcnc -o -").stdout;
    assert!(!moves.contains("G83") && cycles.contains("G83"), "{cycles}");
    let grbl = library("cycles = true").run("emit 1500.1P --post grbl -o -").stdout;
    assert!(!grbl.contains("G83") && grbl.matches("G1").count() > moves.matches("G1").count(), "{grbl}");
}

/// A native program has no word for pecks, and probes need one; with `cycles = true`, the drawing's C is meant to count.
#[test]
fn a_peck_depth_is_told_to_have_no_effect_in_a_program_with_probes() {
    let path = |text: &str, probe: &str| {
        let holes =
            format!("sweep 0,0 10,0\ncircle 10,0 d 2 \"B0{text}\"\nsweep 10,0 20,0\nend 20,0\n{probe}");
        dxf(&format!("layer 1700.1P\nstart 0,0 \"T5 O2 I1 B4 MPlate\"\n{holes}"))
    };
    for (text, probe, is_told) in
        [(" C2", "probe 5,5\n", true), (" C2", "", false), ("", "probe 5,5\n", false)]
    {
        let run = library("cycles = true").file("1700.dxf", path(text, probe)).run("emit 1700.1P");
        assert_eq!(run.status, Some(0), "{run}");
        assert_eq!(run.stderr.contains("warning[PB210]"), is_told, "{text} {probe}: {run}");
    }
}

/// Between holes, the tool would move at R if the program before has left G99.
#[test]
fn cycles_without_g98_are_an_error_on_controls_that_keep_it() {
    for post in ["mach3", "fanuc", "haas"] {
        let place = library("cycles = true");
        let program = place.run(&format!("emit 1500.1P --post {post} -o -")).stdout;
        assert!(program.contains("G98"), "{program}");
        let place = place.file("good.nc", &*program).file("bad.nc", program.replace("G98", ""));
        let verify = |name: &str, more: &str| {
            place.run(&format!("verify {name} --dialect {post} --format concise {more}"))
        };
        let run = verify("good.nc", "--against 1500.1P");
        assert_eq!(run.status, Some(0), "{run}");
        let run = verify("bad.nc", "");
        assert!(run.stderr.contains("warning[PB731]"), "{run}");
        let run = verify("bad.nc", "--against 1500.1P");
        assert!(run.status == Some(1) && run.stderr.contains("error[PB731]"), "{run}");
        let run = place.run(&format!("post bad.nc --dialect {post} --post linuxcnc -o -"));
        assert!(run.status == Some(1) && run.stderr.contains("error[PB731]"), "{run}");
    }
}

#[test]
fn a_program_without_its_number_is_an_error_on_controls_that_know_it_by_that() {
    for (post, is_numbered) in [("fanuc", true), ("haas", true), ("mach3", false)] {
        let place = library("");
        let program = place.run(&format!("emit 1234.1P --post {post} -o -")).stdout;
        let rest: Vec<&str> = program.lines().filter(|line| !line.starts_with('O')).collect();
        assert_eq!(rest.len() < program.lines().count(), is_numbered, "{program}");
        let place = place.file("good.nc", &*program).file("bad.nc", rest.join("\r\n"));
        for (name, is_found) in [("good.nc", false), ("bad.nc", is_numbered)] {
            let run =
                place.run(&format!("verify {name} --dialect {post} --against 1234.1P --format concise"));
            assert_eq!(run.status, Some(i32::from(is_found)), "{run}");
            assert_eq!(run.stderr.contains("the program lacks its number"), is_found, "{run}");
        }
    }
}

#[test]
fn holes_drilled_in_pecks_are_as_drawn() {
    for post in ["linuxcnc", "fanuc", "grbl"] {
        let place = library("cycles = true");
        let program = place.run(&format!("emit 1500.1P --post {post} -o -")).stdout;
        let place = place.file(&format!("{post}.nc"), program);
        let verified =
            place.run(&format!("verify {post}.nc --against 1500.1P --post {post} --format concise"));
        assert_eq!(verified.status, Some(0), "{verified}");
    }
}

#[test]
fn macros_of_the_configuration_win_over_the_posts() {
    let post = "<PostProcessor><PostProcessorMacros>$who=bert</PostProcessorMacros><PostFile>({$who})\n{$mops}\n{$footer}</PostFile></PostProcessor>";
    let place = library("").file("my.cbpp", post);
    assert!(place.run("emit 1234.1P --post my.cbpp -o -").stdout.starts_with("(bert)"));
    let place = Place::of(&LIBRARY.replace("[tool.2mm]", "[macros]\nwho = \"anna\"\n[tool.2mm]"))
        .file("my.cbpp", post);
    assert!(place.run("emit 1234.1P --post my.cbpp -o -").stdout.starts_with("(anna)"));
}

/// A mistake in a macro is reported where the macro stands.
#[test]
fn a_wrong_macro_of_the_configuration_is_not_a_mistake_of_the_post() {
    let post = |macros: &str| {
        format!(
            "<PostProcessor><PostProcessorMacros>{macros}</PostProcessorMacros><PostFile>{{$who}}\n{{$mops}}\n{{$footer}}</PostFile></PostProcessor>"
        )
    };
    for (value, problem) in [("{$nix}", "unknown macro {$nix}"), ("{$nix", "a macro")] {
        let place = library("").file("my.cbpp", post(&format!("$who={value}")));
        let run = place.run("emit 1234.1P --post my.cbpp -o - --format concise");
        assert!(run.stderr.starts_with("my.cbpp:1:"), "{run}");
        assert!(run.stderr.contains(&format!("{problem} in PostProcessorMacros")), "{run}");
        let macros = format!("[macros]\nwho = \"{value}\"\n[tool.2mm]");
        let place = Place::of(&LIBRARY.replace("[tool.2mm]", &macros)).file("my.cbpp", post(""));
        let run = place.run("emit 1234.1P --post my.cbpp -o - --format concise");
        assert!(run.stderr.contains(&format!("] {problem} in [macros]")), "{run}");
        assert!(!run.stderr.starts_with("my.cbpp"), "{run}");
    }
    for (name, is_ignored) in [("mop.name", true), ("tool.length", false)] {
        let macros = format!("[macros]\nwho = \"\"\n\"{name}\" = \"7\"\n[tool.2mm]");
        let place = Place::of(&LIBRARY.replace("[tool.2mm]", &macros)).file("my.cbpp", post(""));
        let run = place.run("emit 1234.1P --post my.cbpp -o - --format concise");
        let note = format!("${name} is built in; its definition is ignored");
        assert_eq!(run.stderr.contains(&note), is_ignored, "{run}");
    }
}

#[test]
fn emit_says_what_verify_says_of_the_written_program() {
    for (z, is_low) in [("-10", false), ("-10.1", true)] {
        let park = format!("[macros]\npark = \"G53 G0 Z{z}\"\n[tool.2mm]");
        let place = Place::of(&LIBRARY.replacen("[tool.2mm]", &park, 1));
        let emitted = place.run("emit 1300.1P 1234.1P --join both --post grbl --format concise");
        let verified = place.run("verify both_Milling.gcode --dialect grbl --format concise");
        for run in [emitted, verified] {
            assert_eq!((run.status, run.stderr.contains("PB729")), (Some(0), is_low), "{z}: {run}");
        }
    }
}

#[test]
fn no_program_moves_in_the_plane_at_the_height_of_a_tool_change_by_hand() {
    let grbl = library("").run("post show grbl").stdout;
    let height = "\n{$set(x,NaN)}{$set(y,NaN)}{$set(z,NaN)}\n{$clearance}</ToolChange>";
    assert!(grbl.contains(height), "{grbl}");
    for (end, is_raised) in [(height, true), ("</ToolChange>", false)] {
        let place = library("").file("my.cbpp", grbl.replace(height, end));
        let emitted = place.run("emit 1300.1P 1234.1P --join both --post my.cbpp --format concise");
        assert_eq!(emitted.status, Some(i32::from(!is_raised)), "{emitted}");
        assert_eq!(emitted.stderr.contains("PB742"), !is_raised, "{emitted}");
    }
}

#[test]
fn what_a_post_cannot_do_is_refused() {
    let lossy = "<PostProcessor><FeedMove>{$_g1} {$_f} {$_x} {$_y}</FeedMove><Dialect>linuxcnc</Dialect></PostProcessor>";
    let place = library("").file("lossy.cbpp", lossy).file("open.cbpp", "<PostProcessor/>");
    assert_snapshot!(runs(
        &place,
        [
            "emit 1600.1P --post grbl",
            "emit 1234.1P --post lossy.cbpp",
            "emit 1234.1P --post open.cbpp --dialect grbl --format concise",
            "emit 1234.1P --post open.cbpp -o out",
            "emit 1234.1P --dialect grbl",
            "emit 1234.1P --run-post-build --check --post grbl",
        ]
    ));
    for file in ["1600_Milling.gcode", "1600_Clean.gcode", "1234_Milling.nc", "1234_Milling.gcode"] {
        assert!(!place.path().join(file).exists(), "{file}");
    }
}

#[test]
fn the_provenance_tells_posts_tools_and_macros_apart() {
    let provenance = |place: &Place, options: &str| {
        let run = place.run(&format!("emit 1234.1P -o - {options}"));
        let line = run
            .stdout
            .lines()
            .find(|line| line.to_lowercase().contains("pathbuild "))
            .unwrap_or_else(|| panic!("{run}"));
        line.trim_matches(['(', ')']).to_owned()
    };
    let place =
        library("").file("my.cbpp", "<PostProcessor/>").file("other.cbpp", "<PostProcessor></PostProcessor>");
    let all = [
        provenance(&place, ""),
        provenance(&place, "--post grbl"),
        provenance(&place, "--post haas"),
        provenance(&place, "--post my.cbpp"),
        provenance(&place, "--post other.cbpp"),
        provenance(&place, "--post grbl --date 2026-11-21"),
        provenance(&library("cycles = true"), "--post grbl"),
        provenance(&Place::of(&LIBRARY.replace("number = 4", "number = 5")), "--post grbl"),
        provenance(
            &Place::of(&LIBRARY.replace("[tool.2mm]", "[macros]\na = \"b\"\n[tool.2mm]")),
            "--post grbl",
        ),
    ];
    let mut distinct = all.to_vec();
    distinct.sort();
    distinct.dedup();
    assert_eq!(distinct.len(), all.len(), "{all:#?}");
    let inserting = |name: &str, head: &str| {
        let texts = "comment = '(~CommentText~)'\nprogram-start = '\\\\\\~*{name}*'\nline = 'G01 X{.~X1~} Y{.~Y1~} Z{.~Z1~} F{.~MovingVel~}'\nrapid = 'G00 X{.~X1~} Y{.~Y1~} Z{.~Z1~}'\ntool-change = 'S{#~MillingSpindleRate~} M03'\nprogram-end = 'M30'\n"
            .replace("{name}", name);
        let post = format!("[post]\nname = \"mine\"\nextension = \"nc\"\n[text]\n{texts}");
        let place = Place::of(&LIBRARY.replace("[tool.2mm]", "[macros]\nHead = 'head'\n[tool.2mm]"));
        provenance(&place.file("my.toml", post).file("head.nc", head), "--post my.toml")
    };
    for name in ["head.nc", "~Head~.nc"] {
        assert_ne!(inserting(name, "(a)\n"), inserting(name, "(b)\n"));
    }
    let native = provenance(&Place::of(&LIBRARY.replace("number = 4", "number = 5")), "");
    assert_eq!(native, all[0], "what a native program does not depend on is not in it");
}

#[test]
fn current_and_stale_programs_of_posts_are_known() {
    let place = library("");
    assert_eq!(place.run("emit . --post fanuc --restrict x:y").status, Some(1), "1600 has probes");
    assert_eq!(place.run("emit 1234.1P --post fanuc --check").status, Some(0));
    let text = place.read("1234_Milling.nc");
    let place = place.file("1234_Milling.nc", text.replace("(PATH 1234.1P)", "(REMARK)"));
    assert_eq!(place.run("emit 1234.1P --post fanuc --check").status, Some(1));
    assert_eq!(place.run("emit 1234.1P --post fanuc --check --moves").status, Some(0));
    let place = place.file("1234_Milling.nc", text.replace("X40.", "X41."));
    let moved = place.run("emit 1234.1P --post fanuc --check --moves");
    assert!(moved.status == Some(1) && moved.stderr.contains("PB739"), "{moved}");
    std::fs::rename(place.path().join("1300.dxf"), place.path().join("1301.dxf")).unwrap();
    let stale = place.run("emit . --post fanuc --format concise");
    assert!(stale.stderr.contains("1300X_Milling.nc: warning[PB520]"), "{stale}");
}

/// Tool and spindle are not moves. All modes that change how the cuts are read belong to the moves, as do the ways to the first cut and from the last.
#[test]
fn modes_of_a_posts_program_belong_to_its_moves() {
    let place = library("");
    assert_eq!(place.run("emit 1234.1P --post linuxcnc").status, Some(0));
    let name = "1234_Milling.ngc";
    let ours = place.read(name);
    let status = |text: String| {
        assert_ne!(text, ours);
        std::fs::write(place.path().join(name), text).unwrap();
        place.run("emit 1234.1P --post linuxcnc --check --moves").status
    };
    for (from, to) in [
        ("G21", "G20"),
        ("G90", "G91"),
        ("G1 ", "G91\nG1 "),
        ("G1 ", "G55\nG1 "),
        ("G1 ", "G53 G0 Z0\nG1 "),
        ("G0 ", "G0 Z-5\nG0 "),
        ("M30", "G53 G0 Z0\nM30"),
        ("M30", "G0 Z-5\nM30"),
    ] {
        assert_eq!(status(ours.replacen(from, to, 1)), Some(1), "{from} {to}");
    }
    assert_eq!(status(ours.replacen("S12000", "S9000", 1)), Some(0));
}

/// With the prefix X, a line number would be a position, so such a prefix is refused.
#[test]
fn line_numbers_begin_with_no_other_word() {
    let place = library("");
    let grbl = place.run("post show grbl").stdout;
    let numbered = |prefix: &str| {
        let numbers = "<AddLineNumbers>true</AddLineNumbers><LineNumberPrefix>";
        let end = format!("{numbers}{prefix}</LineNumberPrefix></PostProcessor>");
        let place = library("").file("mine.cbpp", grbl.replace("</PostProcessor>", &end));
        place.run("emit 1234.1P --post mine.cbpp")
    };
    assert_eq!(numbered("N").status, Some(0));
    for prefix in ["X", "F", "S"] {
        let refused = numbered(prefix);
        assert!(refused.status == Some(1) && refused.stderr.contains("PB750"), "{refused}");
    }
}

/// `X10` may be 10 mm or 0.01 mm on these controls.
#[test]
fn numbers_have_a_point_where_the_control_may_need_it() {
    let with_format = |post: &str, format: &str, head: &str| {
        let text = library("").run(&format!("post show {post}")).stdout;
        let (before, rest) = text.split_once("<NumberFormat>").unwrap();
        let (_, after) = rest.split_once("</NumberFormat>").unwrap();
        let text = format!("{before}<NumberFormat>{format}</NumberFormat>{after}");
        library(head).file("mine.cbpp", text)
    };
    let emit = |post: &str, format: &str| {
        with_format(post, format, "").run("emit 1234.1P --post mine.cbpp --format concise")
    };
    for post in ["fanuc", "haas"] {
        assert_eq!(emit(post, "0.0##").status, Some(0), "{post}");
        for format in ["0.###", "#.###"] {
            let refused = emit(post, format);
            assert_eq!(refused.status, Some(1), "{refused}");
            assert_eq!(refused.stderr.matches("error[").count(), 1, "{refused}");
            assert!(
                refused.stderr.contains(&format!("mine.cbpp:8: error[PB750] NumberFormat is \"{format}\"")),
                "{refused}"
            );
        }
    }
    assert_eq!(emit("linuxcnc", "0.###").status, Some(0));
    let unchecked = with_format("fanuc", "0.###", "post.unchecked = true");
    assert_eq!(unchecked.run("emit 1234.1P --post mine.cbpp").status, Some(0));
    let verified =
        unchecked.run("verify 1234_Milling.nc --against 1234.1P --post mine.cbpp --format concise");
    assert!(verified.stderr.contains("warning[PB707]"), "{verified}");
}

/// The radii of this arc differ by 0.002 mm, as four decimals in inches allow. The post writes a centre that suits both ends.
#[test]
fn arcs_of_inch_programs_are_compared_as_exactly_as_they_are_given() {
    let program = "G17 G20 G90 G94\nM3 S1000\nG0 Z1.\nG0 X0. Y0.\nG1 Z-.04 F4.\nG3 X3.1087 Y-0.5694 I1.7658 J0.8700 F4.\nG0 Z1.\nM5\nM30\n";
    let place = library("").file("inch.ngc", program);
    let written = place.run("post inch.ngc --dialect linuxcnc --post linuxcnc --surface 0 -o mm.ngc");
    assert_eq!(written.status, Some(0), "{written}");
}

/// If the words of a post are unknown, its programs are compared byte for byte.
#[test]
fn a_program_that_cannot_be_read_is_compared_as_it_is() {
    let post = "<PostProcessor><PostFile>(anna)\n{$mops}\n{$footer}</PostFile></PostProcessor>";
    let place = library("").file("my.cbpp", post);
    assert_eq!(place.run("emit 1234.1P --post my.cbpp").status, Some(0));
    let check = |place: &Place, dialect: &str| {
        place.run(&format!("emit 1234.1P --post my.cbpp --check --moves{dialect}")).status
    };
    assert_eq!(check(&place, ""), Some(0));
    let text = place.read("1234_Milling.nc");
    let place = place.file("1234_Milling.nc", text.replace("(anna)", "(bert)"));
    assert_eq!((check(&place, ""), check(&place, " --dialect linuxcnc")), (Some(1), Some(0)));
}

/// A program for another machine is harmless while the path has the same moves, and dangerous as soon as it has others.
#[test]
fn the_leftover_of_another_post_counts_once_the_path_has_other_moves() {
    let before = "layer 1234.1P\nstart 0,0 \"T5 O2 I5 B0 MPlate\"\nmill 0,0 40,0\nend 40,0\n";
    let after = before.replace("40,0", "41,0");
    let drawn = |text: &str| pathbuild_testkit::sheet(text).unwrap().to_dxf();
    for (old, new) in [("native", "fanuc"), ("fanuc", "native"), ("linuxcnc", "mach3"), ("mach3", "grbl")] {
        let place = library("").file("1234.dxf", drawn(before));
        for post in [old, new] {
            assert_eq!(place.run(&format!("emit 1234.1P --post {post}")).status, Some(0));
        }
        let check = format!("emit 1234.1P --check --post {new}");
        let same = place.run(&check);
        assert_eq!((same.status, &*same.stdout), (Some(0), ""), "{old}: {same}");
        let place = place.file("1234.dxf", drawn(&after));
        assert_eq!(place.run(&format!("emit 1234.1P --post {new}")).status, Some(0));
        for line in [check, format!("emit . --check --post {new} --restrict x:y")] {
            let others = place.run(&line);
            assert_eq!(others.status, Some(1), "{old}: {others}");
            assert!(
                others
                    .stdout
                    .lines()
                    .any(|it| it.starts_with("1234_Milling.") && it.ends_with(": not current")),
                "{old}: {others}"
            );
            assert!(
                others.stderr.contains("PB520") && others.stderr.contains("has other moves than"),
                "{old}: {others}"
            );
        }
        assert_eq!(place.run(&format!("emit 1234.1P --post {new} --remove-stale")).status, Some(0));
        assert_eq!(place.run(&format!("emit 1234.1P --check --post {new}")).status, Some(0));
    }
}

/// The extension that a definition chooses is not recognised if the definition is not in use, unless it is a usual one.
#[test]
fn leftovers_of_a_former_definition_are_found_by_the_usual_extensions() {
    let drawn = |end: &str| {
        let text =
            format!("layer 1234.1P\nstart 0,0 \"T5 O2 I5 B0 MPlate\"\nmill 0,0 {end},0\nend {end},0\n");
        pathbuild_testkit::sheet(&text).unwrap().to_dxf()
    };
    for (extension, is_found) in [("cnc", true), ("xyz", false)] {
        let post = format!(
            "<PostProcessor><Dialect>linuxcnc</Dialect><FileExtension>{extension}</FileExtension>\
             <Header>{{$cbfile.header}}\n{{$units}} {{$distancemode}}\n{{$toolchange(first)}}\n{{$clearance}}</Header></PostProcessor>"
        );
        let place = library("").file("my.cbpp", post).file("1234.dxf", drawn("40"));
        let posted = place.run("emit 1234.1P --post my.cbpp");
        assert_eq!(posted.status, Some(0), "{posted}");
        let place = place.file("1234.dxf", drawn("41"));
        let native = place.run("emit 1234.1P --format concise");
        assert_eq!(native.status, Some(0), "{native}");
        assert_eq!(native.stderr.contains("PB520"), is_found, "{extension}: {native}");
    }
}

/// A definition may choose any extension. `verify` of a directory reads the programs of the configured one, or of that of the option.
#[test]
fn verify_finds_programs_with_the_extension_of_the_post() {
    let post = "<PostProcessor><Dialect>linuxcnc</Dialect><FileExtension>mpf</FileExtension>\
                <Header>{$cbfile.header}\n{$units} {$distancemode}\n{$toolchange(first)}\n{$clearance}</Header></PostProcessor>";
    let place =
        library("").file("my.cbpp", post).file("nc/1234.MPF", "G21 G90\nG0 Z5\nG1 Z-1 F100 Q3\nM30\n");
    let find = |arguments: &str| place.run(&format!("verify {arguments} --format concise"));
    for arguments in ["nc --post my.cbpp", "n* --post my.cbpp", "nc/* --post my.cbpp"] {
        let run = find(arguments);
        assert!(run.stderr.contains("nc/1234.MPF:3") && !run.stderr.contains("PB518"), "{run}");
    }
    for arguments in ["nc", "nc --post grbl"] {
        let run = find(arguments);
        assert!(run.stderr.contains("PB518") && !run.stderr.contains("1234.MPF"), "{run}");
    }
    let configuration = place.read("pathbuild.toml");
    let place = place.file("pathbuild.toml", format!("post = \"my.cbpp\"\n{configuration}"));
    let run = place.run("verify . --format concise");
    assert!(run.stderr.contains("nc/1234.MPF:3"), "{run}");
}

/// Programs are identified by their extension: a user's copies are not programs.
#[test]
fn copies_that_are_no_programs_by_name_are_left_alone() {
    let place = library("");
    assert_eq!(place.run("emit 1234.1P").status, Some(0));
    for copy in ["1234_Milling.bak", "1234_Milling.txt", "1234_Milling.nc"] {
        std::fs::copy(place.path().join("1234_Milling.gcode"), place.path().join(copy)).unwrap();
    }
    std::fs::remove_file(place.path().join("1234.dxf")).unwrap();
    let stale = place.run("emit . --check --format concise");
    let named = |name: &str| stale.stderr.contains(&format!("1234_Milling.{name}: error[PB520]"));
    assert_eq!(["gcode", "nc", "bak", "txt"].map(named), [true, true, false, false], "{stale}");
}

/// Programs are recognised by their extension, even if another post than the one that wrote them is in use.
#[test]
fn programs_of_every_built_in_post_are_known_when_their_drawing_is_gone() {
    for post in pathbuild_post::BUILT_IN.iter().map(|post| post.name) {
        let place = library("");
        assert_eq!(place.run(&format!("emit 1234.1P --out-dir out --post {post}")).status, Some(0));
        std::fs::remove_file(place.path().join("1234.dxf")).unwrap();
        let stale = place.run("emit . --check --out-dir out");
        assert!(
            stale.stderr.contains("was written earlier, but no path would write it now"),
            "{post}: {stale}"
        );
    }
}

#[test]
fn deps_name_the_post_and_what_it_puts_in() {
    let post = "[post]\nname = \"mine\"\nextension = \"nc\"\n[text]\nprogram-start = '\\\\\\~*head.txt*'\nline = 'G01 X{.~X1~} Y{.~Y1~} Z{.~Z1~} F{.~MovingVel~}'\nrapid = 'G00 X{.~X1~} Y{.~Y1~} Z{.~Z1~}'\ntool-change = 'S{#~MillingSpindleRate~} M03'\nprogram-end = 'M30'\n";
    let place = library("").file("posts/mine.toml", post).file("posts/head.txt", "(head)\n");
    let run = place.run("emit 1234.1P --post posts/mine.toml --deps out.d");
    assert_eq!(run.status, Some(0), "{run}");
    assert!(place.read("1234_Milling.nc").starts_with("(head)"));
    assert_eq!(
        place.read("out.d"),
        "1234_Milling.nc: 1234.dxf pathbuild.toml posts/mine.toml posts/head.txt\n1234.dxf:\npathbuild.toml:\nposts/head.txt:\nposts/mine.toml:\n"
    );
}

#[cfg(unix)]
#[test]
fn the_posts_command_runs_only_when_asked() {
    let post = |command: &str, arguments: &str| {
        format!(
            "<PostProcessor><PostBuildCommand>{command}</PostBuildCommand><PostBuildCommandArgs>{arguments}</PostBuildCommandArgs></PostProcessor>"
        )
    };
    let place = library("")
        .file("copy.cbpp", post("/bin/cp", "{$outfile} \"a copy.nc\""))
        .file("fails.cbpp", post("/bin/false", "x; touch y"))
        .file("missing.cbpp", post("/nowhere/tool", ""));
    assert_snapshot!(runs(
        &place,
        [
            "emit 1234.1P --post copy.cbpp --dialect linuxcnc",
            "emit 1234.1P --post copy.cbpp --dialect linuxcnc --run-post-build",
            "emit 1234.1P --post fails.cbpp --dialect linuxcnc --run-post-build",
        ]
    ));
    assert!(place.read("a copy.nc").contains("G1 X40.0"));
    let missing = place.run("emit 1234.1P --post missing.cbpp --run-post-build");
    assert!(missing.status == Some(1) && missing.stderr.contains("PB768"), "{missing}");
}

/// `emit --check` does not run the command, so it cannot know what the command made of the program: only the moves can be compared.
#[cfg(unix)]
#[test]
fn a_program_that_the_posts_command_edited_has_its_moves() {
    let post = |edit: &str| {
        format!(
            "<PostProcessor><PostBuildCommand>/bin/sed</PostBuildCommand><PostBuildCommandArgs>-i \"{edit}\" {{$outfile}}</PostBuildCommandArgs></PostProcessor>"
        )
    };
    for (edit, is_same_way) in [("1i (made for mill 3)", true), ("s/X40/X41/", false)] {
        let place = library("").file("edit.cbpp", post(edit));
        let arguments = "1234.1P --post edit.cbpp --dialect linuxcnc";
        let emitted = || {
            let run = place.run(&format!("emit {arguments} --run-post-build"));
            assert_eq!(run.status, Some(0), "{run}");
            place.read("1234_Milling.nc")
        };
        let first = emitted();
        assert!(first.contains(if is_same_way { "mill 3" } else { "X41" }), "{first}");
        let check = |option: &str| place.run(&format!("emit {arguments} --check{option}")).status;
        assert_eq!(check(""), Some(1), "{edit}");
        assert_eq!(check(" --moves"), Some(i32::from(!is_same_way)), "{edit}");
        // The command works on what the post has written, not on its own earlier result.
        assert_eq!(emitted(), first, "{edit}");
    }
}

/// Under the name of 1500.1P, the operator would start 1234.1P.
#[test]
fn post_does_not_replace_the_program_of_another_path() {
    let place = library("");
    assert_eq!(place.run("emit 1234.1P 1500.1P").status, Some(0));
    let post = |to: &str| place.run(&format!("post 1234_Milling.gcode --post linuxcnc -o {to}"));
    let kept = place.read("1500_Milling.gcode");
    let run = post("1500_Milling.gcode");
    assert!(run.status == Some(1) && run.stderr.contains("program of another path"), "{run}");
    assert_eq!(place.read("1500_Milling.gcode"), kept);
    for _ in 0..2 {
        let run = post("1500.ngc");
        assert_eq!(run.status, Some(0), "{run}");
    }
    assert!(post("1500_Z.txt").stderr.contains("PB004"));
}

#[cfg(unix)]
#[test]
fn post_does_not_replace_the_program_that_it_reads() {
    let place = library("");
    assert_eq!(place.run("emit 1234.1P").status, Some(0));
    std::os::unix::fs::symlink("1234_Milling.gcode", place.path().join("link.gcode")).unwrap();
    let kept = place.read("1234_Milling.gcode");
    let post = |from: &str, to: &str| place.run(&format!("post {from} --post linuxcnc -o {to}"));
    for [from, to] in [
        ["1234_Milling.gcode", "./1234_Milling.gcode"],
        ["link.gcode", "1234_Milling.gcode"],
        ["1234_Milling.gcode", "link.gcode"],
    ] {
        let run = post(from, to);
        assert!(run.status == Some(1) && run.stderr.contains("program to rewrite"), "{run}");
        assert_eq!(place.read("1234_Milling.gcode"), kept);
    }
    assert_eq!(post("link.gcode", "link.ngc").status, Some(0));
}

/// The posts haas and fanuc write titles in upper case, too.
#[test]
fn the_old_program_of_a_lost_path_is_named_whatever_the_case_of_its_title() {
    for post in ["linuxcnc", "haas", "fanuc"] {
        let place = library("");
        let emit = |arguments: &str| {
            place.run(&format!("emit {arguments} --post {post} --out-dir g --format concise"))
        };
        assert_eq!(emit("1234.1P").status, Some(0));
        assert_eq!(emit("1234.1P 1500.1P --join both").status, Some(0));
        let place = place.file("1234.dxf", "no drawing EOF");
        let emit = |arguments: &str| {
            place.run(&format!("emit {arguments} --post {post} --out-dir g --format concise"))
        };
        let both = emit(".");
        assert!(both.stderr.contains("path 1234.1P was not written, so both_Milling"), "{post}: {both}");
        for is_there in [true, false] {
            if !is_there {
                std::fs::remove_file(place.path().join("1234.dxf")).unwrap();
            }
            let run = emit("1234.1P");
            assert!(run.stderr.contains("path 1234.1P was not written, so 1234_Milling"), "{post}: {run}");
        }
    }
}

/// A program that could not be written must not be processed.
#[cfg(unix)]
#[test]
fn the_posts_command_runs_on_what_was_written_only() {
    let post = "<PostProcessor><PostBuildCommand>/bin/touch</PostBuildCommand>\
        <PostBuildCommandArgs>ran</PostBuildCommandArgs></PostProcessor>";
    for (name, is_in_the_way) in [("1234_Milling.nc/other", true), ("other", false)] {
        let place = library("").file("touch.cbpp", post).file(name, "");
        let run = place.run("emit 1234.1P --post touch.cbpp --dialect linuxcnc --run-post-build");
        assert_eq!(run.stderr.contains("PB004"), is_in_the_way, "{run}");
        assert_eq!(place.path().join("ran").exists(), !is_in_the_way, "{run}");
    }
}

#[test]
fn the_native_program_is_read_back_whatever_the_drawing_holds() {
    // A difference cannot be provoked here; the conformance cases go through the same check.
    let place = library("z-model = \"tin\"\nz-split = 3");
    assert_eq!(place.run("emit .").status, Some(0));
}

/// The control would keep the unit and the distance mode of the previous program.
#[test]
fn a_post_that_does_not_state_its_modes_is_a_warning() {
    let codes = |dialect: &str, header: &str| {
        let post = format!(
            "<PostProcessor>{dialect}<Header>{header}\n{{$toolchange(first)}}\n{{$clearance}}</Header></PostProcessor>"
        );
        let place = library("").file("my.cbpp", post);
        let emitted = place.run("emit 1234.1P --post my.cbpp --format concise");
        assert_eq!(emitted.status, Some(0), "{emitted}");
        let verified = place.run("verify 1234_Milling.nc --against 1234.1P --post my.cbpp --format concise");
        assert_eq!(verified.status, Some(0), "{verified}");
        [emitted, verified]
            .map(|run| ["PB730", "PB731"].map(|code| run.stderr.matches(&format!("warning[{code}]")).count()))
    };
    for dialect in ["<Dialect>linuxcnc</Dialect>", ""] {
        assert_eq!(codes(dialect, "{$units} {$distancemode}"), [[0, 0]; 2], "{dialect}");
        assert_eq!(codes(dialect, "{$distancemode}"), [[1, 0]; 2], "{dialect}");
        assert_eq!(codes(dialect, "{$units}"), [[0, 1]; 2], "{dialect}");
    }
}

/// The table's speed is for cutting: a tool that only probes must not turn.
#[test]
fn a_tool_that_only_probes_gets_no_speed_from_the_table() {
    let tools = |name: &str, number: u32| {
        format!("[tool.{name}]\ndiameter = 2\nnumber = {number}\nspindle = 9{number}00\n")
    };
    let program = |second: &str| {
        format!(
            "G21 G90 G17 G94\nT1 M6\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG0 Z5\nT2 M6\nG0 Z5\nG0 X9 Y0\n{second}\nG0 Z5\nM2\n"
        )
    };
    let place = Place::new()
        .file("pathbuild.toml", tools("a", 1) + &tools("b", 2))
        .file("cuts.nc", program("G1 Z-1 F100"))
        .file("probes.nc", program("G38.2 Z-1 F100"));
    let speeds = |file: &str| {
        let run = place
            .run(&format!("post {file} --dialect linuxcnc --post linuxcnc --surface 0 --format concise"));
        assert_eq!(run.status, Some(0), "{run}");
        ["S9100", "S9200"].map(|speed| run.stdout.matches(speed).count())
    };
    assert_eq!([speeds("cuts.nc"), speeds("probes.nc")], [[1, 1], [1, 0]]);
}

/// A post writes numbers, so it cannot express "2 mm above the position that the probe touched".
#[test]
fn values_that_only_the_machine_knows_are_refused() {
    let program = |z: &str| {
        format!(
            "G21 G90 G17 G94\nG0 Z5\nG0 X20 Y0\nG38.2 Z-10 F50\n{z}\nG0 X0\nG1 Z-1 F100\nG1 X20\nG0 Z5\nM2\n"
        )
    };
    let place = Place::new()
        .file("pathbuild.toml", "spindle = \"manual\"\n")
        .file("fixed.nc", program("G0 Z[3+2]"))
        .file("probed.nc", program("G0 Z[#5063+2]"))
        .file("branch.nc", program("o1 if [#5070 EQ 1]\nG0 Z5\no1 else\nM2\no1 endif"));
    let post = |file: &str| {
        place.run(&format!(
            "post {file} --dialect linuxcnc --post grbl --surface 0 -o out.nc --format concise"
        ))
    };
    let fixed = post("fixed.nc");
    assert_eq!(fixed.status, Some(0), "{fixed}");
    std::fs::remove_file(place.path().join("out.nc")).unwrap();
    for (file, place_of_error) in [("probed.nc", "probed.nc:5"), ("branch.nc", "branch.nc:5")] {
        let refused = post(file);
        assert_eq!(refused.status, Some(1), "{refused}");
        let line = refused.stderr.lines().find(|line| line.contains("error[PB765]")).expect("an error");
        assert!(line.starts_with(place_of_error), "{refused}");
        assert!(!place.path().join("out.nc").exists(), "{file}");
    }
}

/// When the program stops, the operator may change the tool and set zero, so that the tip is on the plate.
#[test]
fn a_stop_of_the_program_is_followed_by_the_lift_of_the_program() {
    let program = |height: &str| {
        format!(
            "G21 G90 G17 G94\nG0 Z20\nG0 X0 Y0\nG1 Z-1 F100\nG1 X20\n{height}\nM0\nG0 X0 Y30\nG1 Z-1\nG1 X20\nG0 Z20\nM30\n"
        )
    };
    let behind_stop = |height: &str, post: &str| {
        let place =
            Place::new().file("pathbuild.toml", "spindle = \"manual\"\n").file("a.nc", program(height));
        let run = place.run(&format!("post a.nc --dialect grbl --post {post} --surface 0"));
        run.stdout.lines().skip_while(|line| *line != "M0").nth(1).map(str::to_owned)
    };
    for post in ["grbl", "linuxcnc", "mach3", "estlcam"] {
        assert_eq!(behind_stop("G0 Z20", post).as_deref(), Some("G0 Z20.0"), "{post}");
    }
    // A pause in the middle of a cut resumes at the same position.
    let goes_on = "G0 Z20\nG0 X1\nG0 Z1\nG1 Z-1";
    assert_eq!(behind_stop(goes_on, "grbl").as_deref(), Some("G0 X0.0 Y30.0 Z-1.0"));
}

#[test]
fn post_writes_to_standard_output_as_emit_does() {
    let program = "G21 G90 G17 G94\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG0 Z5\nM2\n";
    let place = Place::new().file("a.nc", program).file("pathbuild.toml", "spindle = \"manual\"\n");
    let run =
        |options: &str| place.run(&format!("post a.nc --dialect linuxcnc --post grbl --surface 0 {options}"));
    let (plain, dash) = (run(""), run("-o -"));
    assert!(plain.stdout.contains("G1 F100.0 Z-1.0") && plain.stdout == dash.stdout, "{dash}");
    assert!(!place.path().join("-").exists());
    assert_eq!(run("-o - --run-post-build").status, Some(2));
}

/// T and H refer to the control's entries for a cutter, so they must not depend on the other paths of a program.
#[test]
fn a_cutter_without_a_number_has_the_same_one_in_each_program() {
    let tools = "spindle = \"manual\"\nfeed = 150\nrapid = 1000\nsweep-height = 20\n[tool.a]\ndiameter = 2\n[tool.b]\ndiameter = 3\n[tool.c]\ndiameter = 4\nnumber = 1\n";
    let place = library("").file("pathbuild.toml", tools);
    let changes = |options: &str| {
        let run = place.run(&format!("emit {options} --post linuxcnc -o -"));
        assert_eq!(run.status, Some(0), "{run}");
        let changes = run.stdout.lines().filter(|line| line.ends_with("M6")).map(str::to_owned);
        changes.collect::<Vec<_>>()
    };
    assert_eq!(changes("1234.1P"), ["T2 M6"], "1 is taken");
    assert_eq!(changes("1300.1P"), ["T3 M6"]);
    assert_eq!(changes("1234.1P 1300.1P --join both"), ["T2 M6", "T3 M6"]);
    assert_eq!(changes("1300.1P 1234.1P --join both"), ["T3 M6", "T2 M6"]);
}

const SLOTS: &str = "( T1 D=6 CR=0 - flat end mill )\nG17 G21 G40 G49 G54 G80 G90 G94\nT1 M6\nM3 S12000\nG0 Z5\nG0 X0 Y0\n\
    G1 Z-1 F100\nG1 X40\nG0 Y20\nG1 X0\nG0 Z5\nM5\nM30\n";

/// `post` knows the cutter and the surface: a program whose rapid move goes through material is not written for another machine.
#[test]
fn a_program_with_a_rapid_move_through_material_is_not_written() {
    let post = |program: &str, diameter: &str, more: &str| {
        let tools = format!("[tool.a]\ndiameter = {diameter}\nnumber = 1\nspindle = 12000\n{more}");
        let place = Place::new().file("pathbuild.toml", tools).file("a.nc", program);
        let run = place.run("post a.nc --dialect linuxcnc --post grbl --surface 0 -o b.nc");
        assert_eq!(place.path().join("b.nc").exists(), run.status == Some(0), "{run}");
        run
    };
    let refused = post(SLOTS, "6", "");
    assert!(
        refused.status == Some(1) && refused.stderr.contains("error[PB740] rapid-in-material · a.nc:9:1"),
        "{refused}"
    );
    let back = post(&SLOTS.replace("G0 Y20", "G0 Z5\nG0 Y20\nG1 Z-1"), "6", "");
    assert!(back.status == Some(0) && back.stderr == "b.nc: written\n", "{back}");
    // A user who lowers the severity takes responsibility.
    let lowered = post(SLOTS, "6", "[severity]\nPB740 = \"warning\"\n");
    assert!(lowered.status == Some(0) && lowered.stderr.contains("warning[PB740]"), "{lowered}");
    let waiver = "[[severity-in]]\nfiles = [\"a.nc\"]\nPB740 = \"ignore\"\nreason = \"milled before\"\n";
    let waived = post(SLOTS, "6", waiver);
    assert!(waived.status == Some(0) && !waived.stderr.contains("PB740"), "{waived}");
    let other_cutter = post(&SLOTS.replace("G0 Y20\nG1 X0\n", ""), "3", "");
    assert!(other_cutter.status == Some(0) && other_cutter.stderr.contains("PB777"), "{other_cutter}");
}

/// `verify` compares with a drawing, or checks the travel, if the configuration demands it; `post` has no drawing.
#[test]
fn demanded_checks_do_not_concern_post() {
    let options = "[verify]\nrequire = [\"drawing\"]\n[tool.a]\ndiameter = 6\nnumber = 1\nspindle = 12000\n";
    let place = Place::new()
        .file("pathbuild.toml", options)
        .file("a.nc", SLOTS.replace("G0 Y20", "G0 Z5\nG0 Y20\nG1 Z-1"));
    assert_eq!(place.run("verify a.nc --dialect linuxcnc --surface 0").status, Some(1));
    assert_eq!(place.run("post a.nc --dialect linuxcnc --post grbl --surface 0").status, Some(0));
}

/// Controls of Fanuc and Haas move each axis at its own speed. The tool returns along a slot by a rapid move.
#[test]
fn bent_rapid_moves_are_judged_as_the_target_makes_them() {
    let written = |from: &str, to: &str, end: &str, tool: &str| {
        let program = format!(
            "{tool}\nG21 G90 G17 G94 G40 G49 G80 G54\nT1 M6\nG43 H1 G0 Z5.\nM3 S9000\nG0 X0. Y0.\nG1 Z-1. F100.\nG1 {end} F200.\nG0 X0. Y0.\nG0 Z5.\nM5\nM30\n"
        );
        let table = if tool.is_empty() { "[tool.a]\ndiameter = 2\nnumber = 1\n" } else { "" };
        let place = Place::new().file("1234.nc", program).file("pathbuild.toml", table);
        let run =
            place.run(&format!("post 1234.nc --dialect {from} --post {to} --surface 0 --format concise"));
        let is_written = run.stdout.contains("M30");
        (run.status, is_written, run.stderr.matches("[PB744]").count())
    };
    for from in ["linuxcnc", "fanuc", "haas"] {
        for to in ["fanuc", "haas"] {
            assert_eq!(written(from, to, "X20. Y50.", ""), (Some(1), false, 1), "{from} {to}");
            assert_eq!(
                written(from, to, "X20. Y50.", "(T1 D=2. CR=0. - FLAT END MILL)"),
                (Some(1), false, 1),
                "{from} {to}"
            );
            assert_eq!(written(from, to, "X20. Y20.", ""), (Some(0), true, 0), "{from} {to}");
        }
        assert_eq!(written(from, "linuxcnc", "X20. Y50.", ""), (Some(0), true, 0), "{from}");
    }
}

/// Library with a joined program that has just been written, and the programs of its paths.
fn joined() -> Place {
    let place = Place::of(&LIBRARY.replace("probe 20,20 \"LA\"\n", ""));
    assert_eq!(place.run("emit . --post linuxcnc").status, Some(0));
    assert_eq!(place.run("emit 1300.1P 1234.1P --post linuxcnc --join both").status, Some(0));
    place
}

/// Replaces a drawing of the library by the same one with other parameters.
fn redrawn(place: Place, name: &str, from: &str, to: &str) -> Place {
    let changed = Place::of(&LIBRARY.replace("probe 20,20 \"LA\"\n", "").replace(from, to));
    let drawing = std::fs::read(changed.path().join(name)).unwrap();
    place.file(name, drawing)
}

#[test]
fn joined_programs_are_stale_if_their_paths_changed() {
    let check = "emit . --post linuxcnc --check --format concise";
    let place = joined();
    assert_eq!(place.run(check).status, Some(0), "{}", place.run(check));
    let native = place.run("emit . --check --format concise");
    assert!(!native.stderr.contains("both_Milling.ngc"), "{native}");
    let place = redrawn(place, "1300.dxf", "O3 I1 B4", "O3 I1 B3");
    assert_eq!(place.run("emit . --post linuxcnc").status, Some(0));
    for arguments in ["--post linuxcnc --check", "--post linuxcnc --check --moves", "--check"] {
        let run = place.run(&format!("emit . {arguments} --format concise"));
        let told = "both_Milling.ngc: error[PB520] both_Milling.ngc joins 1300.1P, 1234.1P, which";
        assert!(run.status == Some(1) && run.stderr.contains(told), "{run}");
    }
    let copy = place.read("both_Milling.ngc");
    let place = place.file("copy.ngc", copy);
    let run = place.run("emit . --post linuxcnc --remove-stale --format concise");
    assert!(run.stderr.contains("both_Milling.ngc: stale, removed"), "{run}");
    assert!(
        run.stderr.contains("copy.ngc: warning[PB520]") && place.path().join("copy.ngc").exists(),
        "{run}"
    );
    assert_eq!(place.run("emit 1300.1P 1234.1P --post linuxcnc --join both").status, Some(0));
    std::fs::remove_file(place.path().join("copy.ngc")).unwrap();
    assert_eq!(place.run(check).status, Some(0), "{}", place.run(check));
}

/// The number of a tool is no move.
#[test]
fn joined_programs_are_stale_if_their_tools_changed() {
    let place = joined();
    let settings = place.read("pathbuild.toml").replace("number = 4", "number = 5");
    let place = place.file("pathbuild.toml", settings);
    assert_eq!(place.run("emit . --post linuxcnc").status, Some(0));
    let is_told = |arguments: &str| {
        let run = place.run(&format!("emit . --post linuxcnc --check --format concise {arguments}"));
        run.stderr.contains("both_Milling.ngc: error[PB520]")
    };
    assert!(is_told("") && !is_told("--moves"));
}

#[test]
fn joined_programs_of_broken_and_removed_paths_are_out_of_date() {
    let place = redrawn(joined(), "1300.dxf", "O3 I1 B4", "O3 I1");
    let run = place.run("emit . --post linuxcnc --remove-stale --format concise");
    let told = "both_Milling.ngc: warning[PB522] path 1300.1P was not written, so both_Milling.ngc";
    assert!(run.stderr.contains(told) && place.path().join("both_Milling.ngc").exists(), "{run}");
    let place = place.file("1300.dxf", "nothing");
    let run = place.run("emit . --post linuxcnc --remove-stale --format concise");
    assert!(run.stderr.contains("both_Milling.ngc: warning[PB522]"), "{run}");
    std::fs::remove_file(place.path().join("1300.dxf")).unwrap();
    let run = place.run("emit . --post linuxcnc --check --format concise");
    assert!(run.stderr.contains("both_Milling.ngc: error[PB520]"), "{run}");
    // Without one of its paths, the joined program is not written again.
    let text = place.read("both_Milling.ngc");
    let run = place.run("emit 1300.1P 1234.1P --post linuxcnc --join both --format concise");
    assert!(run.stderr.contains("PB503") && run.stderr.contains("both_Milling.ngc: warning[PB522]"), "{run}");
    assert_eq!(place.read("both_Milling.ngc"), text);
}

#[test]
fn a_joined_program_does_not_replace_that_of_a_path() {
    let place = joined();
    let text = place.read("1400.1T_Milling.ngc");
    for (name, file) in [("1400.1T", "1400.1T"), ("1234", "1234")] {
        let run = place.run(&format!("emit 1300.1P 1234.1P --post linuxcnc --join {name} --format concise"));
        let told = format!("error[PB514] {file}_Milling.ngc is the file of path");
        assert!(run.status == Some(1) && run.stderr.contains(&told), "{run}");
        assert!(!run.stderr.contains("PB522"), "{run}");
    }
    assert_eq!(place.read("1400.1T_Milling.ngc"), text);
    // An R is part of the name.
    for (name, status) in [("1300X", 1), ("1300", 0)] {
        let run = place.run(&format!("emit 1300.1P 1234.1P --post linuxcnc --join {name}"));
        assert_eq!((run.status, run.stderr.contains("PB514")), (Some(status), status == 1), "{run}");
    }
    // The program of this path has the name of its drawing.
    let run = place.run("emit 1300.1P 1234.1P --post linuxcnc --join 1234.1P");
    assert_eq!(run.status, Some(0), "{run}");
}

#[test]
fn programs_with_the_same_number_are_reported() {
    let drawing = |name: &&str| {
        let body = "start 0,0 \"T5 O2 I1 B4 MPlate\"\nmill 0,0 40,0\nend 40,0";
        format!("== {name}.dxf ==\nlayer {name}\n{body}\n")
    };
    let (configuration, _) = LIBRARY.split_once("== 1234.dxf").unwrap();
    let place = |head: &str, names: &[&str]| {
        let drawings: String = names.iter().map(drawing).collect();
        Place::of(&format!("{}{drawings}", configuration.replace("rapid = ", &format!("{head}\nrapid = "))))
    };
    let two = place("", &["1234.1P", "1234.2P"]);
    let told = |[first, second]: [&str; 2]| {
        format!("warning[PB530] 2 programs have the number O1234, such as {first} and {second}: on the")
    };
    for post in ["haas", "fanuc"] {
        let run = two.run(&format!("emit . --post {post} --out-dir {post} --format concise"));
        let drawn = told(["1234.1P (1234.1P.dxf)", "1234.2P (1234.2P.dxf)"]);
        assert!(run.status == Some(0) && run.stderr.contains(&drawn), "{run}");
        let run = two.run(&format!("verify {post} --format concise"));
        assert!(run.stderr.contains(&told(["1234.1P_Milling.nc", "1234.2P_Milling.nc"])), "{run}");
        let run = two.run(&format!("emit . --post {post} --out-dir {post} --join 1234 --format concise"));
        assert!(!run.stderr.contains("PB530"), "{run}");
    }
    let by_haas = |place: Place| place.run("emit . --post haas --out-dir out --format concise");
    let reserved = |name: &str| {
        let place = place("", &[name]);
        let run = place.run("emit . --post haas --out-dir out --format concise");
        let verified = place.run("verify out --format concise");
        let is_told = run.stderr.contains("warning[PB530]");
        assert!(
            run.status == Some(0) && verified.stderr.contains("warning[PB530]") == is_told,
            "{run}{verified}"
        );
        is_told
    };
    assert_eq!(["8999.1P", "9000.1P", "9999.1P"].map(reserved), [false, true, true]);
    let five_digits = place("post = { name = \"haas\", program-number = 10000 }", &["9999.1P"]);
    assert!(!five_digits.run("emit . --out-dir out").stderr.contains("PB530"));
    assert!(!two.run("emit . --post grbl --out-dir out").stderr.contains("PB530"), "GRBL has no numbers");
    assert!(!by_haas(place("", &["1234.1P", "1235.1P"])).stderr.contains("PB530"));
    let configured = place("post = { name = \"haas\", program-number = 77 }", &["1234.1P", "1235.1P"]);
    let run = configured.run("emit . --format concise");
    assert!(run.stderr.contains("warning[PB530] 2 programs have the number O77, "), "{run}");
    let run = by_haas(place("", &["0000.1P"]));
    assert!(run.status == Some(1) && run.stderr.contains("the name contains no number above 0"), "{run}");
}

#[test]
fn tools_that_fit_equally_well_are_reported_once() {
    let place = |paths: &str| {
        let twin = format!("[tool.twin]\ndiameter = 2\nnumber = 9\nspindle = 9000\n{paths}\n[tool.3mm]");
        Place::of(&LIBRARY.replace("[tool.3mm]", &twin))
    };
    let emit = |paths: &str, names: &str| {
        place(paths).run(&format!("emit {names} --post linuxcnc --out-dir out --format concise"))
    };
    let told = "the tools 2mm and twin both have the diameter 2 and fit the same paths: 2mm is used";
    let run = emit("", "1234.1P 1300.1P 1500.1P");
    assert_eq!(run.stderr.matches("PB764").count(), 1, "{run}");
    assert!(run.stderr.contains(&format!("pathbuild.toml: warning[PB764] {told}")), "{run}");
    // The order of the file counts, not that of the names.
    let zero = LIBRARY.replace("[tool.3mm]", "[tool.0]\ndiameter = 2\n[tool.3mm]");
    let run = Place::of(&zero).run("emit 1234.1P --post linuxcnc --format concise");
    assert!(run.stderr.contains("the tools 2mm and 0 both"), "{run}");
    // More specific `paths` decide.
    assert!(!emit("", "1400.1T").stderr.contains("PB764"));
    assert!(!emit("", "1300.1P").stderr.contains("PB764"));
    assert!(!emit("paths = '^1234'", "1234.1P 1500.1P").stderr.contains("PB764"));
    let run = emit("paths = '^1400'", "1400.1T");
    assert!(run.stderr.contains("the tools twin and slot"), "{run}");
}

/// Native programs say T1, so their tool is known only from the comments at their head.
#[test]
fn native_programs_without_a_path_or_for_two_tools_are_refused() {
    let place = library("");
    assert_eq!(place.run("emit 1234.1P 1300.1P 1400.1T 1500.1P --out-dir .").status, Some(0));
    let [mill, other, wide, slot] =
        ["1234", "1500", "1300X", "1400.1T"].map(|name| place.read(&format!("{name}_Milling.gcode")));
    let post = |text: String| {
        let text = text.replace("M30\n%\n%\n", "");
        std::fs::write(place.path().join("a.gcode"), text).unwrap();
        place.run("post a.gcode --post linuxcnc -o a.ngc --format concise")
    };
    let without_path =
        |text: &str| text.split_inclusive('\n').filter(|line| !line.starts_with("(Path ")).collect();
    let run = post(without_path(&slot));
    assert!(run.status == Some(1) && run.stderr.contains("error[PB765] several tools"), "{run}");
    // There is one tool of 3 mm.
    let run = post(without_path(&wide));
    assert!(run.status == Some(0) && place.read("a.ngc").contains("T1 M6"), "{run}");
    let joined = |first: &str, second: &str| {
        let first = first.split("M30").next().unwrap();
        post(format!("{first}{}", second.trim_start_matches("%\n")))
    };
    for (first, second) in [(&slot, &mill), (&mill, &slot), (&mill, &wide)] {
        let run = joined(first, second);
        assert!(run.status == Some(1) && run.stderr.contains("error[PB765] a program for the tool"), "{run}");
    }
    let run = joined(&mill, &other);
    assert!(!run.stderr.contains("PB765"), "{run}");
}
