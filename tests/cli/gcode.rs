//! Tests `import`, `verify` and `post` for programs of any origin. (book: program/posts, book: program/reading)

use crate::support::{Place, runs, shared};
use insta::assert_snapshot;

/// A program of other software, with two tools, a circle and a dwell, that does not select a plane.
const FOREIGN: &str = "\
%
G21 G90 G94
T1 M6
M3 S12000
G0 Z5
G0 X0 Y0
G1 Z-1 F60
G1 X20 F300
G2 X20 Y0 I-5 J0
G4 P1.5
G0 Z5
T2 M6
M3 S8000
G0 X40 Y10
G1 Z-2 F40
G0 Z5
M30
%
";

const LIBRARY: &str = r#"
== pathbuild.toml ==
library = ["parts"]
feed = 150
rapid = 1000
sweep-height = 20
[tool.2mm]
diameter = 2
number = 1
spindle = 12000
== parts/1234.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 40,0
end 40,0
== parts/1300.dxf ==
layer 1300.1P
start 0,20 "T5 O2 I1 B4 MPlate"
mill 0,20 40,20
probe 20,20 "LA"
end 40,20
== parts/1400.dxf ==
layer 1400.1P
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 41,0
end 41,0
"#;

#[test]
fn import_says_what_a_program_is() {
    let place = Place::new().file("foreign.nc", FOREIGN);
    assert_snapshot!(runs(
        &place,
        [
            "import foreign.nc",
            "import foreign.nc --rapid 1000 --lang de",
            "import foreign.nc --dialect linuxcnc --format json",
            "import foreign.nc --dialect siemens",
            "import missing.nc",
        ]
    ));
}

#[test]
fn import_reckons_with_what_the_machine_can_do() {
    let machine = "rapid = 3000\n[machine]\naccelerations = [100, 100, 20]\n";
    let place = Place::new().file("foreign.nc", FOREIGN).file("pathbuild.toml", machine);
    let slow = place.run("import foreign.nc").stdout;
    let stronger = machine.replace("[100, 100, 20]", "[2000, 2000, 1000]");
    let fast = place.file("pathbuild.toml", stronger).run("import foreign.nc").stdout;
    let time =
        |text: &str| text.lines().find(|line| line.trim_start().starts_with("time")).unwrap().to_owned();
    assert_snapshot!(format!("{}\n{}", time(&slow), time(&fast)));
}

#[test]
fn import_reads_the_layers_of_xpertmill() {
    let text = "% //Start\r\nG71 //mm\r\nG0 X0 Y0 Z1\r\nG1 Z-1 F500 S30000\r\nM06 05\r\nS20000\r\nG1 X8 F1200\r\nM3\r\nG5 X1\r\nM30\r\n";
    let inch = text.replace("G71", "G70");
    let place = Place::new().file("a.nc", text).file("b.nc", inch);
    assert_snapshot!(runs(
        &place,
        ["import a.nc", "import b.nc --unit-codes table --ignore-feed --format concise"]
    ));
}

#[test]
fn verify_reports_with_the_severities_of_the_configuration() {
    let unsafe_program = "G17 G21 G90 G94\nG0 X0 Y0\nG0 Z5\nG1 Z1\nG1 X10 F100\nM30\n";
    let place = Place::new().file("a.gcode", unsafe_program).file(
        "pathbuild.toml",
        "[severity]\nPB742 = \"ignore\"\nPB743 = \"error\"\nmissing-feed = \"warning\"\n[machine]\nx = [0, 5]\nmaximum-feed = 90\n",
    );
    assert_snapshot!(runs(
        &place,
        [
            "verify a.gcode --cutter 2 --surface 5",
            "verify a.gcode --format json --surface 5,0 --cutter 2",
            "verify a.gcode --lang de --format concise",
            "verify a.gcode --cutter 0",
        ]
    ));
}

#[test]
fn tools_are_those_of_the_table_where_there_is_one() {
    let place = Place::of(LIBRARY).file("foreign.nc", FOREIGN);
    let verified = place.run("verify foreign.nc --format concise --surface 0 --cutter 2 --dialect linuxcnc");
    assert!(
        verified.stderr.contains("foreign.nc:12:1: warning[PB764] T2 is not in the tool table"),
        "{verified}"
    );
    assert!(!verified.stderr.contains("T1"), "{verified}");
    let elsewhere = Place::new().file("foreign.nc", FOREIGN);
    assert!(!elsewhere.run("verify foreign.nc --format concise").stderr.contains("PB764"));
}

/// In all commands, tools without a number get the free numbers, as in the programs that `emit` writes.
#[test]
fn tools_without_a_number_have_the_free_ones() {
    let program =
        "G17 G21 G90 G94\nT1 M6\nM3 S12000\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG1 X20 F200\nG0 Z5\nM5\nM30\n";
    let tools = "[tool.a]\ndiameter = 2\nspindle = 12000\n[tool.c]\ndiameter = 4\nnumber = 2\n[tool.b]\ndiameter = 6\n";
    let place = Place::new()
        .file("pathbuild.toml", tools)
        .file("one.nc", program)
        .file("three.nc", program.replace("T1", "T3"))
        .file("four.nc", program.replace("T1", "T4"));
    let verify =
        |name: &str| place.run(&format!("verify {name}.nc --dialect linuxcnc --surface 0 --format concise"));
    assert!(verify("one").stderr.contains("against a cutter of 2 mm ([tool])"), "{}", verify("one"));
    assert!(verify("three").stderr.contains("against a cutter of 6 mm ([tool])"), "{}", verify("three"));
    assert!(
        verify("four").stderr.contains("warning[PB764] T4 is not in the tool table"),
        "{}",
        verify("four")
    );
    let post =
        |name: &str| place.run(&format!("post {name}.nc --dialect linuxcnc --post mach3 --surface 0 -o -"));
    assert!(post("three").stdout.contains("(T3: 6.0 b)"), "{}", post("three"));
    assert!(post("four").stderr.contains("PB764"), "{}", post("four"));
}

/// A diameter that a comment states is written, and only its absence from the table is reported.
#[test]
fn a_tool_that_only_the_program_states_has_its_diameter() {
    let program = "(T1 D=6 CR=0 - ZMIN=-1 - flat end mill)\nG17 G21 G90 G94\nT1 M6\nM3 S12000\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG1 X20 F200\nG0 Z5\nM5\nM30\n";
    let post = |place: &Place| place.run("post a.nc --dialect linuxcnc --post mach3 --surface 0");
    let run = post(&Place::new().file("a.nc", program));
    assert!(run.stdout.contains("(T1: 6.0 6 mm)") && !run.stderr.contains("PB764"), "{run}");
    let table = "[tool.a]\ndiameter = 2\nnumber = 2\nspindle = 12000\n";
    let run = post(&Place::new().file("a.nc", program).file("pathbuild.toml", table));
    assert!(run.stdout.contains("(T1: 6.0 6 mm)"), "{run}");
    assert!(run.stderr.contains("T1 is not in the tool table"), "{run}");
    let run = post(&Place::new().file("a.nc", program.replace("D=6", "")));
    assert!(run.stderr.contains("the diameter of T1 is unknown"), "{run}");
}

/// If [tool] and the drawing disagree, the line about checks gives the diameter of the drawing, and states that it is from the drawing.
#[test]
fn the_cutter_of_the_drawing_is_named_as_such() {
    let drawing = "== 1234.1P.dxf ==\nlayer 1234.1P\nstart 0,0 \"T5 O2 I1 B4\"\nmill 0,0 40,0\nend 40,0\n";
    let program = "G17 G21 G40 G49 G54 G80 G90 G94\nT1 M6\nM3 S9000\nG0 Z20\nG0 X0 Y0\nG1 Z4 F150\nG1 X40\nG0 Z20\nM5\nM30\n";
    let place = Place::of(drawing).file("a.nc", program).file(
        "pathbuild.toml",
        "feed = 150\nrapid = 1000\nsweep-height = 20\n[tool.b]\ndiameter = 6\nnumber = 1\n",
    );
    let run = place.run("verify a.nc --against 1234.1P --dialect linuxcnc");
    assert!(run.stderr.contains("against a cutter of 2 mm (drawing)"), "{run}");
}

/// Where a rapid move differs from the drawing, the drawing's own rapid move is named.
#[test]
fn a_rapid_move_is_compared_with_that_of_the_drawing() {
    let drawing = "== 1234.1P.dxf ==\nlayer 1234.1P\nstart 0,0 \"T5 O2 I1 B4\"\nmill 0,0 40,0\nend 40,0\n";
    let place = Place::of(drawing).file("pathbuild.toml", "feed = 150\nrapid = 1000\nsweep-height = 20\n");
    assert_eq!(place.run("emit 1234.1P").status, Some(0));
    let program = place.read("1234.1P_Milling.gcode");
    let against = |text: String| {
        let place =
            Place::of(drawing).file("a.gcode", text).file("pathbuild.toml", place.read("pathbuild.toml"));
        place.run("verify a.gcode --against 1234.1P --format concise").stderr
    };
    let higher = against(program.replace("Z20.000", "Z25.000"));
    assert!(higher.contains("Z25.000; the drawing says X0.000 Y0.000 Z20.000"), "{higher}");
    let last = program.rfind("G00 Z20.000").unwrap();
    let foot = against(format!("{}G00 Z15.000{}", &program[..last], &program[last + 11..]));
    assert!(foot.contains("; the drawing says X40.000 Y0.000 Z20.000"), "{foot}");
}

/// The configuration is the nearest one above the program, or else the working directory's. The output names it if it is not obvious.
#[test]
fn the_configuration_of_a_program_is_told() {
    let configuration = |most: u32| format!("[machine]\nmaximum-feed = {most}\n");
    let program = "G17 G21 G90 G94 G40\nM3 S1000\nG0 Z5\nG0 X0 Y0\nG1 Z1 F100\nM30\n";
    let place = Place::new()
        .file("library/pathbuild.toml", configuration(90))
        .file("library/gcode/a.nc", program)
        .file("other/pathbuild.toml", configuration(200))
        .file("other/a.nc", program)
        .file("stick/a.nc", program);
    for (directory, file, told, is_limited) in [
        ("library", "gcode/a.nc", None, true),
        ("library/gcode", "a.nc", None, true),
        ("library", "../stick/a.nc", Some("configuration: pathbuild.toml"), true),
        ("library/gcode", "../../stick/a.nc", Some("configuration: ../pathbuild.toml"), true),
        ("library", "../other/a.nc", Some("configuration: ../other/pathbuild.toml"), false),
        ("stick", "../library/gcode/a.nc", Some("configuration: ../library/pathbuild.toml"), true),
        ("stick", "a.nc", None, false),
    ] {
        for command in ["verify", "import"] {
            let run = place.run_in(directory, &[command, file, "--dialect", "grbl"]);
            let said = run.stderr.lines().find(|line| line.starts_with("configuration: "));
            assert_eq!(said, told, "{directory}: {command} {file}: {run}");
            assert_eq!(run.stderr.contains("PB747"), command == "verify" && is_limited, "{run}");
        }
    }
    let run = place.run_in("library", &["verify", "../stick/a.nc", "--config", "../other/pathbuild.toml"]);
    assert!(!run.stderr.contains("configuration: "), "{run}");
    let json = |directory: &str, file: &str| {
        let run = place.run_in(directory, &["verify", file, "--dialect", "grbl", "--format", "json"]);
        let last: serde_json::Value = serde_json::from_str(run.stdout.lines().last().unwrap()).unwrap();
        last["configuration"].as_str().map(str::to_owned)
    };
    assert_eq!(json("library", "../stick/a.nc").as_deref(), Some("pathbuild.toml"));
    assert_eq!(json("stick", "a.nc"), None);
}

#[test]
fn every_format_of_diagnostics_is_there_for_programs() {
    let place = Place::new().file("a.gcode", "G17 G21 G90 G94\nG0 X1 X2\nM30\n");
    for format in ["full", "concise", "json", "sarif", "github", "gitlab", "junit"] {
        let run = place.run(&format!("verify a.gcode --dialect native --format {format}"));
        let (said, other) = if matches!(format, "full" | "concise") {
            (&run.stderr, &run.stdout)
        } else {
            (&run.stdout, &run.stderr)
        };
        assert!(run.status == Some(1) && said.contains("PB723") && !other.contains("PB723"), "{run}");
    }
}

#[test]
fn what_was_emitted_is_what_the_drawing_says() {
    let place = Place::of(LIBRARY);
    assert_eq!(place.run("emit 1234.1P 1300.1P").status, Some(0));
    let program = place.read("parts/1234_Milling.gcode");
    let place = place
        .file("moved.gcode", program.replace("X40.000", "X40.002"))
        .file("rounded.gcode", program.replace("X40.000", "X40.001"))
        .file("faster.gcode", program.replace("F150.000", "F151.000"))
        .file("cut off.gcode", program.split_once("G01 F").map_or("", |(head, _)| head));
    assert_snapshot!(runs(
        &place,
        [
            "verify parts/1234_Milling.gcode --against 1234.1P",
            "verify rounded.gcode --against parts/1234.dxf",
            "verify moved.gcode --against 1234.1P",
            "verify faster.gcode --against 1234.1P --format concise",
            "verify parts/1300_Clean.gcode --against 1234.1P --format concise",
            "verify parts/1234_Milling.gcode --against 1400.1P --format concise",
            "verify parts/1300_Clean.gcode --against 1300.1P",
            "verify parts/1234_Milling.gcode --against 9999.1P --format concise",
            "verify parts/1234_Milling.gcode --against parts/ --format concise",
        ]
    ));
    let cut_off = place.run_with(&["verify", "cut off.gcode", "--against", "1234.1P", "--format", "concise"]);
    assert_snapshot!(cut_off);
}

/// A program cannot be compared with a drawing of several paths if none of them is named.
#[test]
fn a_program_is_compared_with_one_path() {
    let path = |name: &str, y: u32| {
        format!("layer {name}\nstart 0,{y} \"T5 O2 I1 B4\"\nmill 0,{y} 40,{y}\nend 40,{y}\n")
    };
    let against = |paths: &[String]| {
        let drawing = format!("== a.nc ==\nG17 G21 G90 G94\nM30\n== 1234.dxf ==\n{}", paths.concat());
        Place::of(&drawing).run("verify a.nc --against 1234.dxf --feed 150 --rapid 1000 --sweep-height 20")
    };
    let said = |paths: &[String]| against(paths).stderr.contains("several paths: 1234.1P, 1234.2P");
    assert!(said(&[path("1234.1P", 0), path("1234.2P", 50)]));
    assert!(!said(&[path("1234.1P", 0)]));
}

/// Comments are compared if the program was written with the current options.
#[test]
fn a_comment_that_emit_does_not_write_is_found() {
    let place = Place::of(LIBRARY);
    assert_eq!(place.run("emit 1234.1P").status, Some(0));
    let other = place.read("parts/1234_Milling.gcode").replace("drawing 1234.dxf", "drawing 4321.dxf");
    let longer = place.read("parts/1234_Milling.gcode") + "(one more)\n";
    let place = place.file("other.gcode", other).file("longer.gcode", longer);
    let run = place.run("verify longer.gcode --against 1234.1P --format concise");
    assert!(run.stderr.contains("PB777] emit does not write this comment"), "{run}");
    let is_found = |place: &Place| {
        let run = place.run("verify other.gcode --against 1234.1P --format concise");
        assert_eq!(run.status, Some(0), "{run}");
        let missing = "PB777] the program does not have the comment that emit writes here: `(Path 1234.1P, drawing 1234.dxf)`";
        run.stderr.contains(missing)
    };
    assert!(is_found(&place));
    let configuration = place.read("pathbuild.toml").replace("rapid = 1000", "rapid = 2000");
    assert!(!is_found(&place.file("pathbuild.toml", configuration)));
}

/// The arc ends 0.25 mm farther along the next line. The cut itself differs by less than the rounding, but the written number differs by more.
#[test]
fn an_arc_that_goes_on_into_the_next_line_is_another() {
    let round = "layer 1235.1P\nstart 0,0 \"T5 O2 I1 B4 MPlate\"\nmill 0,0 30,0\nmill arc centre 30,10 r 10 from 270 to 0\nmill 40,10 40,40\nend 40,40\n";
    for post in ["native", "haas", "grbl", "xpertmill", "marlin"] {
        let drawing = pathbuild_testkit::sheet(round).unwrap().to_dxf();
        let place = Place::of(LIBRARY).file("parts/1235.dxf", drawing);
        let run = place.run(&format!("emit 1235.1P --post {post} --out-dir out"));
        assert_eq!(run.status, Some(0), "{run}");
        let file = std::fs::read_dir(place.path().join("out")).unwrap().next().unwrap().unwrap().path();
        let good = std::fs::read_to_string(&file).unwrap();
        let mut lines: Vec<String> = good.lines().map(str::to_owned).collect();
        let is_arc = |line: &&mut String| line.starts_with("G3 ") || line.starts_with("G03 ");
        let arc = lines.iter_mut().find(is_arc).unwrap_or_else(|| panic!("{post}: {good}"));
        let longer = arc.replace("Y10.", "Y10.25").replace("Y10 ", "Y10.25 ");
        assert_ne!(*arc, longer, "{post}");
        *arc = longer;
        let place = place.file("good.nc", &good).file("longer.nc", lines.join("\n") + "\n");
        let verify = |file: &str| place.run(&format!("verify --dialect {post} --against 1235.1P {file}"));
        assert_eq!(verify("good.nc").status, Some(0), "{}", verify("good.nc"));
        let found = verify("longer.nc");
        assert!(found.status == Some(1) && found.stderr.contains("PB739"), "{post}: {found}");
    }
}

/// M30 does not reset a tool length; a following G43 overrides it.
#[test]
fn a_tool_length_of_the_program_before_is_switched_off() {
    let place = Place::of(LIBRARY);
    for (post, is_needed) in [("native", true), ("grbl", true), ("linuxcnc", false), ("fanuc", false)] {
        let run = place.run(&format!("emit 1234.1P --post {post} --out-dir {post}"));
        assert_eq!(run.status, Some(0), "{run}");
        let file = std::fs::read_dir(place.path().join(post)).unwrap().next().unwrap().unwrap().path();
        let good = std::fs::read_to_string(&file).unwrap();
        let without = good.replacen("G49 ", "", 1);
        assert_ne!(good, without, "{post}");
        std::fs::write(place.path().join("without.nc"), without).unwrap();
        let found = place.run(&format!("verify --dialect {post} --against 1234.1P without.nc"));
        assert_eq!(found.status, Some(i32::from(is_needed)), "{post}: {found}");
        assert_eq!(found.stderr.contains("no G49 before"), is_needed, "{post}: {found}");
    }
}

/// Without H at G43, Fanuc and Haas keep the H of the previous program, and LinuxCNC takes the tool's H. A tool length that the post for DIN
/// 66025 never switches on must not begin between two cuts either.
#[test]
fn a_tool_length_is_that_of_the_tool() {
    let place = Place::of(LIBRARY);
    let verified = |post: &str, change: fn(&str) -> String| {
        let run = place.run(&format!("emit 1234.1P --post {post} --out-dir {post}"));
        assert_eq!(run.status, Some(0), "{run}");
        let file = std::fs::read_dir(place.path().join(post)).unwrap().next().unwrap().unwrap().path();
        let good = std::fs::read_to_string(&file).unwrap();
        let changed = change(&good);
        assert_ne!(good, changed, "{post}");
        std::fs::write(place.path().join("changed.nc"), changed).unwrap();
        place.run(&format!("verify --dialect {post} --against 1234.1P changed.nc")).status
    };
    for (post, status) in [("fanuc", 1), ("haas", 1), ("linuxcnc", 0)] {
        assert_eq!(verified(post, |good| good.replace("G43 H1", "G43")), Some(status), "{post}");
    }
    let midway = |good: &str| {
        let (head, cuts) = good.split_at(good.rfind("G01").unwrap());
        let begin = head.rfind('\n').unwrap() + 1;
        format!("{}G43 H1\n{}{cuts}", &head[..begin], &head[begin..])
    };
    assert_eq!(verified("din", midway), Some(1));
}

/// Programs of other software that have been milled successfully yield no findings.
#[test]
fn programs_of_cambam_have_no_finding() {
    let Some(folder) = shared("cambam-output") else { return };
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let programs: Vec<_> = files.filter(|file| file.extension().is_some_and(|it| it != "md")).collect();
    assert!(programs.len() >= 6, "{programs:?}");
    for program in programs {
        let place = Place::new().file("a.nc", std::fs::read(&program).unwrap());
        let run = place.run("verify a.nc --format concise");
        assert!(
            run.status == Some(0) && run.stderr.contains("errors: 0, warnings: 0\n"),
            "{program:?}: {run}"
        );
    }
}

#[test]
fn a_program_that_follows_a_tilted_plate_mills_nothing_by_rapid() {
    let tilted = "== parts/1700.dxf ==\nlayer 1700.1P\nstart 0,0 \"T5 O2 I1 B4 MPlate\"\nmill 0,0 40,0\nsweep 40,0 40,50\nmill 40,50 0,50\nprobe 20,15 \"LA\"\nprobe 20,35 \"LB\"\nend 0,50\n";
    let place = Place::of(&format!("{LIBRARY}{tilted}"));
    assert_eq!(place.run("emit 1700.1P").status, Some(0));
    let values = place.read("parts/1700_Z.txt").replace("#51=", "#51=5.4").replace("#52=", "#52=4.6");
    let place = place.file("parts/1700_Z.txt", values);
    assert_eq!(place.run("adjust parts/1700.dxf --max-correction 1").status, Some(0));
    for against in ["", "--against 1700.1P"] {
        let run = place.run(&format!("verify parts/1700_Milling.gcode --cutter 2 {against}"));
        assert!(run.status == Some(0) && run.stderr.contains("errors: 0, warnings: 0\n"), "{run}");
        assert_eq!(run.stderr.contains("10 of 10 moves as in path 1700.1P"), !against.is_empty(), "{run}");
    }
}

#[test]
fn what_a_post_wrote_is_what_the_drawing_says() {
    let place = Place::of(LIBRARY);
    assert_eq!(place.run("emit 1234.1P").status, Some(0));
    for (post, dialect) in [("linuxcnc", "linuxcnc"), ("grbl", "grbl"), ("xpertmill", "xpertmill")] {
        let rewritten = place.run(&format!("post parts/1234_Milling.gcode --post {post} -o {post}.nc"));
        assert_eq!(rewritten.status, Some(0), "{rewritten}");
        let verified = place.run(&format!("verify {post}.nc --dialect {dialect} --against 1234.1P"));
        assert_eq!(verified.status, Some(0), "{verified}");
        let moved = place.read(&format!("{post}.nc")).replace("X40", "X39");
        let place = Place::of(LIBRARY).file("moved.nc", moved);
        let verified = place.run(&format!("verify moved.nc --dialect {dialect} --against 1234.1P"));
        assert_eq!(verified.status, Some(1), "{verified}");
        assert!(verified.stderr.contains("PB739"), "{verified}");
    }
}

#[test]
fn a_program_is_written_for_another_machine() {
    let place = Place::of(LIBRARY).file("foreign.nc", FOREIGN).file(
        "mine.cbpp",
        "<PostProcessor><FileExtension>tap</FileExtension><EndOfLine>\\n</EndOfLine></PostProcessor>",
    );
    assert_snapshot!(runs(
        &place,
        [
            "post foreign.nc --post linuxcnc",
            "post foreign.nc --post grbl -o foreign.gcode",
            "post foreign.nc --post grbl -o foreign.gcode",
            "post foreign.nc --post mine.cbpp --date 2026-11-21",
            "post foreign.nc --post mine.cbpp --target grbl",
            "post foreign.nc --post mine.cbpp --target grblx --format concise",
            "post foreign.nc --post native",
            "post foreign.nc --post linuxcn --format concise",
            "post foreign.nc --post missing.cbpp --format concise",
            "post foreign.nc",
        ]
    ));
}

#[test]
fn a_program_with_errors_is_not_rewritten() {
    let place = Place::of(LIBRARY).file("bad.nc", FOREIGN.replace("G1 X20 F300", "G1 X20 X30 F300"));
    assert_snapshot!(place.run("post bad.nc --post grbl -o out.gcode"));
    assert!(!place.path().join("out.gcode").exists());
}

#[test]
fn words_that_a_rewritten_program_does_not_have_are_told() {
    let text = "G21 G90 G17 G40 G49 G80 G94 G54\nT1 M6\nM3 S12000\nM64 P1\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG0 Z5\nM1\nM5\nM30\n";
    let place = Place::new().file("a.ngc", text);
    let place = place.file("plain.ngc", text.replace("M64 P1\n", "").replace("M1\n", "M0\n"));
    let options = "--dialect linuxcnc --surface 0 --format concise";
    let posted = place.run(&format!("post a.ngc --post linuxcnc {options}"));
    assert!(posted.stderr.contains("a.ngc:4:1: warning[PB778] the post does not write M64"), "{posted}");
    assert!(posted.stderr.contains("a.ngc:9:1: warning[PB778] M1 is written as M0"), "{posted}");
    assert!(!posted.stdout.contains("M64") && posted.stdout.contains("\nM0\n"), "{posted}");
    let verified = place.run(&format!("verify a.ngc {options}"));
    assert!(verified.stderr.contains("M64 is not checked"), "`verify` writes nothing: {verified}");
    let plain = place.run(&format!("post plain.ngc --post linuxcnc {options}"));
    assert!(plain.status == Some(0) && !plain.stderr.contains("PB778"), "{plain}");
}

#[test]
fn heights_that_are_still_to_be_corrected_are_not_rewritten() {
    let place = Place::of(LIBRARY);
    assert_eq!(place.run("emit 1300.1P").status, Some(0));
    assert_snapshot!(place.run("post parts/1300_Clean.gcode --post grbl -o out.gcode"));
    let values = place.read("parts/1300_Z.txt").replace("#51=", "#51=5.1");
    let adjusted = place.file("parts/1300_Z.txt", values);
    assert_eq!(adjusted.run("adjust parts/1300.dxf --max-correction 1").status, Some(0));
    let rewritten = adjusted.run("post parts/1300_Milling.gcode --post grbl");
    assert_eq!(rewritten.status, Some(0), "{rewritten}");
    assert!(rewritten.stdout.contains("Z4.1"), "4 above a plate that is 0.1 thicker: {rewritten}");
}

#[test]
fn built_in_posts_are_listed_and_shown() {
    let place = Place::new();
    assert_snapshot!(runs(&place, ["post list", "post show native", "post show gbrl --format concise"]));
    let shown = place.run("post show grbl").stdout;
    let program = "G17 G21 G90 G94\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F60\nG0 Z5\nM30\n";
    let place = place.file("copy.cbpp", shown).file("a.gcode", program);
    let place = place.file("pathbuild.toml", "spindle = \"manual\"\n");
    let [own, copy] = ["grbl", "copy.cbpp"].map(|post| place.run(&format!("post a.gcode --post {post}")));
    assert_eq!((own.status, own.stdout), (Some(0), copy.stdout));
}

/// The names of all built-in posts.
const POSTS: [&str; 10] =
    ["native", "grbl", "linuxcnc", "mach3", "fanuc", "haas", "marlin", "estlcam", "din", "xpertmill"];

#[test]
fn what_any_post_wrote_is_what_the_drawing_says() {
    let place = Place::of(LIBRARY);
    for post in POSTS {
        let emitted = place.run(&format!("emit 1234.1P --post {post} --out-dir {post}"));
        assert_eq!(emitted.status, Some(0), "{emitted}");
        let directory = std::fs::read_dir(place.path().join(post)).unwrap();
        let names = directory.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let file = names.into_iter().find(|name| name.starts_with("1234")).unwrap();
        for arguments in ["", "--against 1234.1P", "--cutter 2 --surface 5"] {
            let verified = place.run(&format!("verify --dialect {post} {post}/{file} {arguments}"));
            assert_eq!(verified.status, Some(0), "{post}: {verified}");
            assert!(verified.stderr.contains("errors: 0, warnings: 0"), "{post} {arguments}: {verified}");
        }
    }
}

#[test]
fn material_of_several_heights_is_known_in_native_programs_alone() {
    for (start, height, is_level) in
        [("T5 MPlate", "", true), ("T5 MPlate", " H3", false), ("T6 MThick", " T5 MPlate", false)]
    {
        let project = format!(
            "== parts/1900.dxf ==\nlayer 1900.1P\nstart 0,0 \"{start} O2\"\nsubpath 0,0 40,0 \">1234.1P T5 MPlate\"\nsubpath 40,0 80,0 \">1234.1P{height}\"\nend 80,0\n"
        );
        let place = Place::of(&format!("{LIBRARY}{project}"));
        for (post, file, is_known) in
            [("native", "1900_Milling.gcode", true), ("linuxcnc", "1900_Milling.ngc", is_level)]
        {
            let emitted = place.run(&format!("emit 1900.1P --post {post} --out-dir out"));
            assert_eq!(emitted.status, Some(0), "{emitted}");
            let run = place.run(&format!("verify out/{file} --against 1900.1P"));
            assert_eq!(run.status, Some(0), "{run}");
            assert_eq!(run.stderr.contains("material up to Z"), is_known, "{height} {post}: {run}");
            let reason =
                "rapid moves (the upper face of the drawing's material has several heights (several T, or H)";
            assert_eq!(run.stderr.contains(reason), !is_known, "{height} {post}: {run}");
        }
    }
}

#[test]
fn a_configured_post_of_another_dialect_has_not_written_the_program() {
    for post in ["grbl", "linuxcnc"] {
        let place = Place::of(&LIBRARY.replacen("library", &format!("post = \"{post}\"\nlibrary"), 1));
        assert_eq!(place.run("emit 1234.1P --post grbl --out-dir out").status, Some(0));
        let verified = place.run("verify out/1234_Milling.gcode --dialect grbl");
        assert!(verified.stderr.contains("errors: 0, warnings: 0"), "{post}: {verified}");
    }
}

#[test]
fn verify_against_finds_what_moves_the_machine_and_not_the_program() {
    let place = Place::of(LIBRARY);
    assert_eq!(place.run("emit 1234.1P --post grbl --out-dir out").status, Some(0));
    let good = place.read("out/1234_Milling.gcode");
    let head = good.lines().find(|line| line.starts_with("G17")).unwrap().to_owned();
    let behind_head = |word: &str| good.replace(&head, &format!("{head}\n{word}"));
    let place = [
        ("a", behind_head("G0 X20 Y0 Z-9")),
        ("b", behind_head("G43.1 Z-6")),
        ("c", behind_head("G10 L2 P1 Z-5")),
        ("d", behind_head("G43 H9")),
        ("e", behind_head("G52 X3")),
        ("f", good.replace("M3 S12000", "M4 S1")),
        ("g", behind_head("G92 Z3")),
        ("h", behind_head("G55")),
        ("i", good.replace("T1", "T2")),
        ("j", good.replace("G21 ", "")),
        ("k", behind_head("#5221=3")),
    ]
    .into_iter()
    .fold(place, |place, (name, text)| {
        assert_ne!(text, good, "{name}");
        place.file(&format!("{name}.nc"), text)
    });
    for name in ["a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k"] {
        let verified = place.run(&format!("verify --dialect linuxcnc --against 1234.1P {name}.nc"));
        assert_eq!(verified.status, Some(1), "{name}: {verified}");
    }
}

/// Estlcam waits for the spindle by itself, and `emit` notes that its post does not write the time.
#[test]
fn only_programs_that_can_wait_for_the_spindle_must() {
    let library = LIBRARY.replace("[tool.2mm]", "[machine]\nspin-up = 2\n[tool.2mm]");
    let verified = |post: &str, waits: bool| {
        let place = Place::of(&library);
        let emitted = place.run(&format!("emit 1234.1P --post {post} -o -"));
        assert_eq!(emitted.status, Some(0), "{emitted}");
        let text = emitted.stdout;
        let lines = text.lines().filter(|line| waits || !line.starts_with("G4"));
        let place = place.file("x.nc", lines.collect::<Vec<_>>().join("\n") + "\n");
        place.run(&format!("verify x.nc --against 1234.1P --post {post} --format concise"))
    };
    for (post, waits, status) in [("grbl", true, 0), ("estlcam", false, 0), ("grbl", false, 1)] {
        let verified = verified(post, waits);
        assert_eq!(verified.status, Some(status), "{post}: {verified}");
        let is_reported = verified.stderr.contains("error[PB739] the tool starts cutting less than 2 s");
        assert_eq!(is_reported, status == 1, "{post}: {verified}");
    }
}

#[test]
fn a_joined_program_is_not_compared_with_one_of_its_paths() {
    for post in ["linuxcnc", "grbl", "din", "xpertmill"] {
        let place = Place::of(LIBRARY);
        let emitted = place.run(&format!("emit 1234.1P 1234.1P --join both --post {post} --out-dir out"));
        assert_eq!(emitted.status, Some(0), "{post}: {emitted}");
        let compared = place.run("verify out --against 1234.1P --format concise");
        assert!(
            compared.stderr.contains("error[PB739] the program joins several paths"),
            "{post}: {compared}"
        );
        assert!(compared.stderr.contains("errors: 1, warnings: 0"), "{post}: {compared}");
        let program = std::fs::read_dir(place.path().join("out")).unwrap().next().unwrap().unwrap().path();
        let differing =
            place.run_with(&["diff", program.to_str().unwrap(), "1234.1P", "--format", "concise"]);
        assert!(
            differing.stderr.contains("error[PB739] the program joins several paths"),
            "{post}: {differing}"
        );
        let alone = place.run("verify out --format concise");
        assert!(alone.stderr.contains("errors: 0"), "{post}: {alone}");
    }
}

#[test]
fn a_header_weakens_no_check() {
    let place = Place::of(LIBRARY);
    assert_eq!(place.run("emit 1234.1P --post grbl --out-dir out").status, Some(0));
    let good = place.read("out/1234_Milling.gcode");
    // A narrow cutter in thin material, as the header claims, hits nothing, but the cutter of the drawing does.
    let claims = "(pathbuild 0.1.0 3f2a-09c1 grbl O0.5 T-9)\n";
    let plunge = good.replace("G1 F150.0 Z4.0", "G0 Z4.0\nG1 F150.0 Z4.0");
    assert_ne!(plunge, good);
    let place = place.file("claims.nc", format!("{claims}{plunge}"));
    let verified = place.run("verify --against 1234.1P claims.nc --format concise");
    assert_eq!(verified.status, Some(1), "{verified}");
    assert!(verified.stderr.contains("PB741"), "{verified}");
    // Without a drawing, the header determines dialect, cutter and material.
    let honest = format!("(pathbuild 0.1.0 3f2a-09c1 grbl O2 T5)\n{plunge}");
    let verified = place.file("honest.nc", honest).run("verify honest.nc --format concise");
    assert!(verified.stderr.contains("PB741"), "{verified}");
}

#[test]
fn verify_finds_what_breaks_cutters() {
    let head = "G17 G21 G40 G49 G54 G80 G90 G94\nT1\n";
    let cut = "G0 Z15\nG0 X0 Y0\nG0 X10 Y10\nG0 Z2\nG1 Z-1 F100\n";
    let foot = "G0 Z15\nM5\nM30\n";
    let place = Place::new()
        .file("s0.nc", format!("{head}M3 S0\n{cut}G1 X30\n{foot}"))
        .file("no_s.nc", format!("{head}M3\n{cut}G1 X30\n{foot}"))
        .file("drill.nc", format!("{head}M3 S12000\n{cut}G0 Z15\nG0 X30\nG0 Z2\nG0 Z-3\nG0 Z2\n{foot}"))
        .file("g28.nc", format!("{head}M3 S12000\n{cut}G1 X30\nG28\n{foot}"))
        .file("g92.nc", format!("{head}M3 S12000\n{cut}G1 X30\nG0 Z15\nG92 X0 Y0 Z0\n{foot}"))
        .file("good.nc", format!("{head}M3 S12000\n{cut}G1 X30\nG0 Z15\n{foot}"));
    // If a program has no S, the control may still have the speed of an earlier program.
    let verified = place.run("verify --dialect linuxcnc --cutter 2 --surface 2 no_s.nc");
    assert!(verified.status == Some(0) && verified.stderr.contains("warning[PB745]"), "{verified}");
    for (name, code) in [("s0", "PB745"), ("drill", "PB741"), ("g28", "PB740"), ("g92", "PB774")] {
        let verified = place.run(&format!("verify --dialect linuxcnc --cutter 2 --surface 2 {name}.nc"));
        assert_eq!(verified.status, Some(1), "{name}: {verified}");
        assert!(verified.stderr.contains(code), "{name}: {verified}");
    }
    let verified = place.run("verify --dialect linuxcnc --cutter 2 --surface 2 good.nc");
    assert!(verified.stderr.contains("errors: 0, warnings: 0"), "{verified}");
}

#[test]
fn a_few_lines_with_huge_numbers_are_verified_at_once() {
    let place = Place::new()
        .file("d.gcode", "G0 X0 Y2e9\nG1 F500 Z-1\nG3 X0 Y0 I0 J-1.5\n")
        .file("e.gcode", "G21 G90 G17\nG0 X0 Y2000000000\nG1 F500 Z-1\nG3 X0 Y0 I0 J-1.5\nM30\n")
        .file("f.gcode", "G1 F10.0 Z-0.001\nG2 X-2.8886 Y-92233720368547758080.1787 I0.1401 J0.2718\n");
    let begin = std::time::Instant::now();
    for name in ["d", "e"] {
        let verified = place.run(&format!("verify {name}.gcode --cutter 2 --surface 5 --dialect linuxcnc"));
        assert_eq!(verified.status, Some(1), "{name}: {verified}");
    }
    assert!(place.run("verify f.gcode --cutter 2 --surface 5").stderr.contains("warnings"));
    assert!(place.run("verify e.gcode --cutter 2 --surface 5").stderr.contains("PB005"));
    assert!(begin.elapsed().as_secs() < 60);
}

#[test]
fn ignored_feeds_are_no_error() {
    let place = Place::new().file("if.nc", "%\nG71\nG0 X0 Y0 Z5\nG1 Z-1 F100\nM30\n");
    let verified = place.run("verify --dialect xpertmill --ignore-feed if.nc");
    assert_eq!(verified.status, Some(0), "{verified}");
    assert_eq!(place.run("import --dialect xpertmill --ignore-feed if.nc").status, Some(0));
}

/// A program may be read as another dialect than the user thinks.
#[test]
fn options_of_xpertmill_are_not_ignored_elsewhere() {
    let program = "G17 G21 G90 G94 G91.1\nG0 Z5\nG0 X0 Y0\nG0 Z5\nM30\n";
    let place = Place::new().file("a.nc", program).file("x.nc", "% // a\nG71 // mm\nG0 Z5\nG0 X0 Y0\nM30\n");
    let run = |arguments: &str| place.run(&format!("verify {arguments} --format concise"));
    for option in ["--absolute-arc-centres", "--unit-codes table", "--ignore-feed"] {
        let named = run(&format!("a.nc --dialect mach3 {option}"));
        assert!(named.status == Some(1) && named.stderr.contains("error[PB777]"), "{named}");
        assert!(named.stderr.contains(&format!("`{option}` applies only to xpertmill")), "{named}");
        let guessed = run(&format!("a.nc {option}"));
        assert!(guessed.status == Some(0) && guessed.stderr.contains("warning[PB777]"), "{guessed}");
        let own = run(&format!("x.nc --dialect xpertmill {option}"));
        assert!(!own.stderr.contains("applies only"), "{own}");
    }
    assert_eq!(run("a.nc --dialect mach3 --unit-codes din").status, Some(0), "the default");
}

/// The material reaches up to the higher of `--surface` and what the program states.
#[test]
fn the_last_line_tells_how_high_the_material_is() {
    let place = Place::of(LIBRARY);
    assert_eq!(place.run("emit 1234.1P").status, Some(0));
    for (surface, height) in [("4", "Z 5 (header)"), ("5", "Z 5 (--surface)"), ("6", "Z 6 (--surface)")] {
        let run = place.run(&format!("verify parts/1234_Milling.gcode --surface {surface}"));
        assert!(run.stderr.contains(&format!("material up to {height};")), "{surface}\n{run}");
    }
}

#[test]
fn a_first_move_in_the_plane_does_not_change_the_height() {
    let place = Place::of(LIBRARY);
    assert_eq!(place.run("emit 1234.1P").status, Some(0));
    let text = place.read("parts/1234_Milling.gcode");
    let raised = "G00 Z20.000\nG00 X0.000 Y0.000\n";
    assert!(text.contains(raised), "{text}");
    let native = text.replacen(raised, "G00 X0.000 Y0.000 Z20.000\n", 1);
    let place = place.file("aslant.gcode", native);
    for (options, status, severity) in [("", 0, "warning"), ("--against 1234.1P", 1, "error")] {
        let run = place.run(&format!("verify aslant.gcode {options} --format concise"));
        assert!(run.status == Some(status) && run.stderr.contains(&format!("{severity}[PB742]")), "{run}");
    }
    for (start, is_found) in [
        ("G0 X0 Y0 Z5", true),
        ("G0 Z5\nG0 X0 Y0", false),
        ("G0 Z5\nG0 X0 Y0 Z6", false),
        ("G53 G0 Z0\nG0 X0 Y0 Z5", false),
    ] {
        let program = format!("G17 G21 G40 G54 G90 G94\n{start}\nG1 Z-1 F100\nG0 Z5\nM30\n");
        let place = Place::new().file("a.ngc", program);
        let run = place.run("verify a.ngc --dialect linuxcnc --format concise");
        assert_eq!(run.stderr.contains("PB742"), is_found, "{start}\n{run}");
    }
}
