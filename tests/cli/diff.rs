//! Tests `diff`, which shows the effect of changed drawings on the moves.

use std::fs;
use std::process::Command;

use insta::assert_snapshot;

use crate::support::{Place, Run};
use pathbuild_testkit::sheet;

fn dxf(name: &str, depth: &str, elements: &str) -> Vec<u8> {
    let text =
        format!("layer {name}\nstart 0,0 \"T5 O2 I9 B{depth} MPlate S10 F200\"\n{elements}\nend 40,0\n");
    sheet(&text).unwrap().to_dxf()
}

const LINE: &str = "mill 0,0 40,0";

/// Creates two directories with one path each.
fn two(old: Vec<u8>, new: Vec<u8>) -> Place {
    let configuration = "rapid = 1000\nlibrary = [\"parts\"]\n";
    Place::new()
        .file("old/pathbuild.toml", configuration)
        .file("new/pathbuild.toml", configuration)
        .file("old/parts/1001.1P.dxf", old)
        .file("new/parts/1001.1P.dxf", new)
}

#[track_caller]
fn assert_prints(run: &Run, status: i32, lines: &[&str]) {
    assert_eq!(run.status, Some(status), "{run}");
    for line in lines {
        assert!(run.stdout.contains(line), "{line:?} not in {run}");
    }
}

#[test]
fn nothing_has_changed() {
    let drawing = dxf("1001.1P", "1", LINE);
    let run = two(drawing.clone(), drawing).run("diff old new");
    assert_prints(&run, 0, &["0 of 1 path changed\n"]);
    assert_eq!(run.stdout.lines().count(), 1, "{run}");
}

#[test]
fn a_drawing_that_lies_elsewhere_on_its_sheet_mills_the_same() {
    let shifted =
        "layer 1001.1P\nstart 100,50 \"T5 O2 I9 B1 MPlate S10 F200\"\nmill 100,50 140,50\nend 140,50\n";
    let place = two(dxf("1001.1P", "1", LINE), sheet(shifted).unwrap().to_dxf());
    assert_prints(&place.run("diff old new"), 0, &["0 of 1 path changed"]);
}

#[test]
fn deeper_faster_added_and_gone() {
    let old = dxf("1001.1P", "1", LINE);
    let deeper = two(old.clone(), dxf("1001.1P", "0.5", LINE)).run("diff old new");
    assert_prints(
        &deeper,
        0,
        &["1001.1P · parts/1001.1P.dxf: changed", "  0.5 mm deeper: ", "1 of 1 path changed"],
    );
    let faster = two(old.clone(), dxf("1001.1P", "1", "mill 0,0 40,0 \"F300\"")).run("diff old new");
    assert_prints(&faster, 0, &["faster: F300 instead of F200"]);
    let place = two(old.clone(), old.clone())
        .file("new/parts/1002.1P.dxf", dxf("1002.1P", "1", LINE))
        .file("old/parts/1003.1P.dxf", dxf("1003.1P", "1", LINE));
    let run = place.run("diff old new");
    assert_prints(
        &run,
        0,
        &["1002.1P · parts/1002.1P.dxf: new", "1003.1P · parts/1003.1P.dxf: gone", ", 1 new, 1 gone"],
    );
    let german = place.run("diff old new --lang de");
    assert_prints(&german, 0, &["0 von 2 Pfaden geändert, 1 neu, 1 weg"]);
}

#[test]
fn what_embeds_a_changed_path_has_changed_as_well() {
    let project = dxf("8001.1P", "1", "subpath 0,0 40,0 \">1001.1P\"");
    let part = |depth| {
        let text = format!("layer 1001.1P\nstart 0,0 \"T5 O2 I9 B{depth} MPlate F200\"\n{LINE}\nend 40,0\n");
        sheet(&text).unwrap().to_dxf()
    };
    let place = two(part("1"), part("0.5"))
        .file("old/parts/8001.1P.dxf", project.clone())
        .file("new/parts/8001.1P.dxf", project);
    assert_prints(&place.run("diff old new"), 0, &["1001.1P · ", "8001.1P · ", "2 of 2 paths changed"]);
}

#[test]
fn errors_are_seen_and_make_the_status() {
    let (fine, broken) = (dxf("1001.1P", "1", LINE), dxf("1001.1P", "1", "mill 0,0 30,0"));
    assert_prints(&two(fine.clone(), broken.clone()).run("diff old new"), 1, &["has errors now"]);
    assert_prints(&two(broken.clone(), fine).run("diff old new"), 0, &["had errors, has none now"]);
    assert_prints(
        &two(broken.clone(), broken.clone()).run("diff old new"),
        1,
        &["has errors, before and now"],
    );
    let place =
        two(dxf("1002.1P", "1", LINE), dxf("1002.1P", "1", LINE)).file("new/parts/1001.1P.dxf", broken);
    assert_prints(&place.run("diff old new"), 1, &["1001.1P · parts/1001.1P.dxf: new, has errors"]);
}

/// A path whose drawing cannot be read is not gone.
#[test]
fn a_drawing_that_cannot_be_read_has_errors() {
    let place = two(dxf("1001.1P", "1", LINE), dxf("1001.1P", "1", LINE));
    fs::write(place.path().join("new/parts/1001.1P.dxf"), "no drawing").unwrap();
    let run = place.run("diff old new");
    assert_prints(&run, 1, &["1001.1P · parts/1001.1P.dxf: has errors now", "1 with errors now\n"]);
    assert_prints(&place.run("diff new old"), 0, &["1001.1P · parts/1001.1P.dxf: had errors, has none now"]);
    fs::remove_file(place.path().join("new/parts/1001.1P.dxf")).unwrap();
    assert!(place.run("diff old new").stdout.contains("1001.1P · parts/1001.1P.dxf: gone"));
}

#[test]
fn a_path_that_moved_to_another_drawing() {
    let drawing = dxf("1001.1P", "1", LINE);
    let place = two(drawing.clone(), drawing.clone());
    fs::rename(place.path().join("new/parts/1001.1P.dxf"), place.path().join("new/parts/1001.1-1001.2P.dxf"))
        .unwrap();
    assert_prints(
        &place.run("diff old new"),
        0,
        &["parts/1001.1P.dxf → parts/1001.1-1001.2P.dxf: the same moves"],
    );
}

#[test]
fn what_is_not_there_is_an_error() {
    let place = two(dxf("1001.1P", "1", LINE), dxf("1001.1P", "1", LINE));
    assert_eq!(place.run("diff old elsewhere").status, Some(2));
    fs::remove_dir_all(place.path().join("new/parts")).unwrap();
    assert_eq!(place.run("diff old new").status, Some(1));
}

#[test]
fn two_drawings() {
    let place = two(dxf("1001.1P", "1", LINE), dxf("1001.1P", "0.5", LINE));
    assert_prints(&place.run("diff old/parts/1001.1P.dxf new/parts/1001.1P.dxf"), 0, &["0.5 mm deeper"]);
}

#[test]
fn a_program_and_the_path_that_it_was_made_from() {
    let place = two(dxf("1001.1P", "1", LINE), dxf("1001.1P", "0.5", LINE));
    let emit = place.run("emit ./old/parts/1001.1P.dxf --config old/pathbuild.toml --out-dir programs");
    assert_eq!(emit.status, Some(0), "{emit}");
    let diff = |config: &str| {
        place.run(&format!("diff programs/1001.1P_Milling.gcode 1001.1P --config {config}/pathbuild.toml"))
    };
    assert_prints(&diff("old"), 0, &["0 of 1 path changed"]);
    assert_prints(&diff("new"), 0, &["0.5 mm deeper"]);
    assert_eq!(place.run("diff programs/1001.1P_Milling.gcode new").status, Some(2));
}

/// The working directory and its configuration do not matter for two directories outside of it.
#[test]
fn directories_are_compared_from_anywhere() {
    let configuration = "library = [\".\"]\nfeed = 150\nrapid = 1000\nsweep-height = 10\n";
    let drawing =
        sheet("layer 1001.1P\nstart 0,0 \"T5 O3 I1 B4\"\nmill 0,0 20,0\nend 20,0").unwrap().to_dxf();
    let place = ["a", "b"].into_iter().fold(Place::new(), |place, side| {
        place
            .file(&format!("{side}/pathbuild.toml"), configuration)
            .file(&format!("{side}/1001.1P.dxf"), &drawing)
    });
    let place = place.file("c/pathbuild.toml", configuration);
    assert_prints(&place.run("diff a b"), 0, &["0 of 1 path changed\n"]);
    assert_prints(&place.run_in("c", &["diff", "../a", "../b"]), 0, &["0 of 1 path changed\n"]);
}

/// A program with two cuts, which also states modes, a tool and its length, spindle, coolant, a dwell and a stop.
const TWO_CUTS: &str = "G21 G90 G17 G94 G54\nT1 M6\nG43 H1\nM3 S12000\nM8\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG4 P1\nG1 X20\nM0\nM3\nG1 X30\nG0 Z5\nM5\nM30\n";

fn programs(old: &str, new: &str) -> Run {
    let place = Place::new().file("a.ngc", old).file("b.ngc", new);
    place.run("diff a.ngc b.ngc --dialect linuxcnc")
}

#[test]
fn what_two_programs_state_besides_moves_is_compared() {
    let edited = |old: &str, new: &str| {
        assert!(TWO_CUTS.contains(old), "{old}");
        programs(TWO_CUTS, &TWO_CUTS.replacen(old, new, 1))
    };
    for (old, new, line) in [
        ("T1 M6", "T2 M6", "  tool: T2 instead of T1 (line 2)\n"),
        ("G43 H1", "G43 H2", "  tool length: G43 H2 instead of G43 H1 (line 3)\n"),
        ("M3 S12000", "M3 S2000", "  spindle: M3 S2000 instead of M3 S12000 (line 4)\n"),
        ("M3 S12000\n", "\n", "  spindle: none instead of M3 S12000\n"),
        ("M8", "M9", "  coolant: none instead of M8\n"),
        ("G54", "G55", "  work offset: G55 instead of G54 (line 1)\n"),
        ("G54", "G54 G64 P0.5", "  corners: G64 P0.5 instead of none (line 1)\n"),
        ("G54", "G54 G61", "  corners: G61 instead of none (line 1)\n"),
        ("M0\n", "", "  stop: none instead of M0\n"),
        ("M0", "M1", "  stop: M1 instead of M0 (line 11)\n"),
        ("G4 P1", "G4 P100", "  dwell: 100 s instead of 1 s (line 9)\n"),
        // The same words before another cut.
        ("G1 X20\nM0", "M0\nG1 X20", "  stop: M0 instead of none (line 10)\n"),
        ("M0\nM3\nG1 X30", "M0\nM3\nG1 X30\nM9", ""),
    ] {
        let run = edited(old, new);
        let changed = u8::from(!line.is_empty());
        assert_prints(&run, 0, &[line, &format!("{changed} of 1 path changed\n")]);
    }
    let german = Place::new().file("a.ngc", TWO_CUTS).file("b.ngc", TWO_CUTS.replace("T1", "T2"));
    let run = german.run("diff a.ngc b.ngc --dialect linuxcnc --lang de");
    assert_prints(&run, 0, &["  Werkzeug: T2 statt T1 (Zeile 2)\n"]);
    let json = german.run("diff a.ngc b.ngc --dialect linuxcnc --format json");
    assert_prints(&json, 0, &[r#""states":[{"kind":"tool","line":2,"now":"T2","was":"T1"}]"#]);
}

/// A cutter of another diameter mills a groove of another width, although the moves of its centre are the same.
#[test]
fn another_cutter_is_a_change() {
    let drawing = |cutter: &str| {
        let text =
            format!("layer 1001.1P\nstart 0,0 \"T5 O{cutter} I9 B1 MPlate S10 F200\"\n{LINE}\nend 40,0\n");
        sheet(&text).unwrap().to_dxf()
    };
    let place = two(drawing("2"), drawing("6"));
    for side in ["old", "new"] {
        let run = place
            .run(&format!("emit ./{side}/parts/1001.1P.dxf --config {side}/pathbuild.toml --out-dir {side}"));
        assert_eq!(run.status, Some(0), "{run}");
    }
    let program = |side: &str| format!("{side}/1001.1P_Milling.gcode");
    let (old, new) = (program("old"), program("new"));
    let wider = "  cutter: O6 instead of O2";
    assert_prints(&place.run("diff old new"), 0, &[wider, "text O2 became O6", "1 of 1 path changed"]);
    assert_prints(&place.run(&format!("diff {old} {new}")), 0, &[wider]);
    assert_prints(&place.run(&format!("diff {old} 1001.1P --config new/pathbuild.toml")), 0, &[wider]);
    assert_prints(
        &place.run(&format!("diff {new} 1001.1P --config new/pathbuild.toml")),
        0,
        &["0 of 1 path changed"],
    );
    let german = place.run("diff old new --lang de -o d.html");
    assert_prints(&german, 0, &["  Fräser: O6 statt O2"]);
    assert!(place.read("d.html").contains("jetzt weggefräst, vorher nicht"));
}

/// Between drawings, what the configured post-processor writes besides the moves is compared as well.
#[test]
fn what_the_post_processor_writes_is_compared() {
    let tool =
        |number: u32, speed: u32| format!("[tool.a]\nnumber = {number}\ndiameter = 2\nspindle = {speed}\n");
    let changes = |[old, new]: [String; 2]| {
        let place = two(dxf("1001.1P", "1", LINE), dxf("1001.1P", "1", LINE));
        for (side, text) in [("old", old), ("new", new)] {
            let text = format!("rapid = 1000\nlibrary = [\"parts\"]\n{text}");
            fs::write(place.path().join(side).join("pathbuild.toml"), text).unwrap();
        }
        place.run("diff old new")
    };
    let post = |name: &str, tool: String| format!("post = \"{name}\"\n{tool}");
    let run = changes([
        post("linuxcnc", tool(3, 18000)),
        post("linuxcnc", tool(4, 3000) + "coolant = \"flood\"\n"),
    ]);
    let lines = [
        "  tool: T4 instead of T3",
        "  spindle: M3 S3000 instead of M3 S18000",
        "  coolant: M8 instead of none",
        "1 of 1 path changed",
    ];
    assert_prints(&run, 0, &lines);
    // A tool that the path does not use changes nothing.
    let unused = "[tool.b]\nnumber = 9\ndiameter = 8\nspindle = 9000\n";
    let run = changes([post("linuxcnc", tool(3, 18000)), post("linuxcnc", tool(3, 18000) + unused)]);
    assert_prints(&run, 0, &["0 of 1 path changed\n"]);
    // Native programs contain neither T nor S.
    assert_prints(&changes([tool(3, 18000), tool(4, 3000)]), 0, &["0 of 1 path changed\n"]);
    let run = changes([post("linuxcnc", tool(3, 18000)), post("grbl", tool(3, 18000))]);
    assert_prints(&run, 0, &["  post-processor: grbl instead of linuxcnc", "1 of 1 path changed"]);
}

/// A program that the post-processor cannot write is an error of the path, not another post-processor.
#[test]
fn a_program_that_cannot_be_written_has_errors() {
    let compare = |[old, new]: [&str; 2], [before, after]: [&str; 2]| {
        let place = two(dxf("1001.1P", before, LINE), dxf("1001.1P", after, LINE));
        for (side, spindle) in [("old", old), ("new", new)] {
            let text =
                "rapid = 1000\nlibrary = [\"parts\"]\npost = \"grbl\"\n[tool.a]\nnumber = 3\ndiameter = 2\n";
            fs::write(place.path().join(side).join("pathbuild.toml"), format!("{text}{spindle}")).unwrap();
        }
        place
    };
    let assert_compared = |sides, depths, status, line: &str, code: &str| {
        let run = compare(sides, depths).run("diff old new");
        assert_prints(&run, status, &[line]);
        assert_eq!(run.stderr.matches("error[").count(), run.stderr.matches(code).count(), "{run}");
        assert!(!run.stdout.contains("post-processor"), "{run}");
    };
    let (speed, low) = ("spindle = 9000\n", "spindle = 9000\n[machine]\nz = [0, 5]\n");
    let faster = "spindle = 9500\n[machine]\nz = [0, 5]\n";
    assert_compared([speed, ""], ["1", "1"], 1, "1001.1P · parts/1001.1P.dxf: has errors now", "PB754");
    assert_compared(["", speed], ["1", "1"], 0, ": had errors, has none now", "PB754");
    assert_compared([low, faster], ["1", "1"], 1, ": has errors, before and now", "PB748");
    assert_compared([speed, low], ["1", "1"], 1, ": has errors now", "PB748");
    // Nothing has changed.
    assert_compared([low, low], ["1", "1"], 0, "0 of 1 path changed", "PB748");
    // The moves are compared nevertheless.
    let not_compared = "  tools, spindle and other lines of the program were not compared";
    for (sides, status) in [(["", ""], 1), (["", speed], 0)] {
        assert_compared(sides, ["1", "0.5"], status, "  0.5 mm deeper: ", "PB754");
        assert_compared(sides, ["1", "0.5"], status, not_compared, "PB754");
    }
    let run = compare([speed, speed], ["1", "0.5"]).run("diff old new");
    assert!(run.stdout.contains("deeper") && !run.stdout.contains(not_compared), "{run}");
    let place = compare([speed, ""], ["1", "1"]);
    assert_prints(&place.run("diff old new -o d.md --lang de"), 1, &["hat jetzt Fehler\n"]);
    assert!(place.read("d.md").contains("PB754"));
    fs::remove_file(place.path().join("old/parts/1001.1P.dxf")).unwrap();
    assert_prints(&place.run("diff old new"), 1, &[": new, has errors\n"]);
    let place = compare([speed, ""], ["1", "1"]);
    assert_eq!(place.run("emit old/parts/1001.1P.dxf --config old/pathbuild.toml").status, Some(0));
    let program = "old/parts/1001.1P_Milling.gcode";
    let against = |side| place.run(&format!("diff {program} 1001.1P --config {side}/pathbuild.toml"));
    assert_prints(&against("old"), 0, &["0 of 1 path changed"]);
    let run = against("new");
    assert_eq!((run.status, run.stderr.contains("error[PB754]")), (Some(1), true), "{run}");
}

#[test]
fn pecks_are_compared_where_they_are_written() {
    for (configuration, is_changed) in [
        ("post = \"linuxcnc\"\ncycles = true\n", true),
        ("post = \"linuxcnc\"\n", false),
        ("cycles = true\n", false),
    ] {
        let hole =
            |text: &str| dxf("1001.1P", "1", &format!("mill circle 0,0 d 2 \"{text}\"\nmill 0,0 40,0"));
        let place = two(hole("B1"), hole("B1 C0.5"));
        let tool = "[tool.a]\nnumber = 3\ndiameter = 2\nspindle = 18000\n";
        for side in ["old", "new"] {
            let text = format!("rapid = 1000\nlibrary = [\"parts\"]\n{configuration}{tool}");
            fs::write(place.path().join(side).join("pathbuild.toml"), text).unwrap();
        }
        let run = place.run("diff old new");
        assert_prints(&run, 0, &[&format!("{} of 1 path changed\n", u8::from(is_changed))]);
        assert_eq!(run.stdout.contains("  peck depth: C0.5 instead of none\n"), is_changed, "{run}");
    }
}

#[test]
fn probes_that_differ_are_a_change() {
    let probed = |text: &str| dxf("1001.1P", "1", &format!("{LINE}\n{text}"));
    let compared = |old: &str, new: &str| two(probed(old), probed(new)).run("diff old new");
    let changes = |old: &str, new: &str, line: &str| {
        let run = compared(old, new);
        assert_prints(&run, 0, &[&format!("  probe: {line}\n"), "1 of 1 path changed\n"]);
    };
    changes("", "probe 10,10 \"Z50\"", "X10 Y10 T5 F50 instead of none");
    changes("probe 10,10 \"Z50\"", "", "none instead of X10 Y10 T5 F50");
    changes("probe 10,10 \"Z50\"", "probe 10,10 \"Z50 T4\"", "X10 Y10 T4 F50 instead of X10 Y10 T5 F50");
    changes("probe 10,10 \"Z50\"", "probe 10,11 \"Z50\"", "X10 Y11 T5 F50 instead of X10 Y10 T5 F50");
    changes("probe 10,10 \"Z50\"", "probe 10,10 \"Z60\"", "X10 Y10 T5 F60 instead of X10 Y10 T5 F50");
    let run = compared("probe 10,10 \"Z50\"", "probe 10,10 \"Z50 LA\"");
    assert_prints(&run, 0, &["0 of 1 path changed\n"]);
}

/// The probes of a program are in its comments, with the heights that its formulas use.
#[test]
fn probes_of_two_programs_are_compared() {
    let probed = |text: &str| dxf("1001.1P", "1", &format!("{LINE}\nprobe 10,10 \"{text}\""));
    let place = two(probed("Z50"), probed("Z50 T4"));
    for side in ["old", "new"] {
        assert_eq!(place.run(&format!("emit {side}/parts/1001.1P.dxf --rapid 1000")).status, Some(0));
    }
    let [old, new] = ["old", "new"].map(|side| format!("{side}/parts/1001.1P_Clean.gcode"));
    let same = place.read(&old);
    let place = place.file("same.gcode", same);
    assert_prints(&place.run(&format!("diff {old} same.gcode")), 0, &["0 of 1 path changed\n"]);
    let run = place.run(&format!("diff {old} {new}"));
    assert_prints(&run, 0, &["  probe: X10 Y10 T4 instead of X10 Y10 T5 (line 4)\n", "1 of 1 path changed"]);
}

/// The moves have another zero point, although they are the same in the coordinates of the program.
#[test]
fn a_zero_set_by_probing_is_a_change() {
    let head = "G21 G90 G17 G94 G54\nG0 Z20\nG0 X0 Y0\n";
    let cuts = "M3 S9000\nG0 Z5\nG1 Z-1 F100\nG1 X20\nG0 Z5\nM5\nM30\n";
    let probed = format!("{head}G38.2 Z-20 F50\nG10 L20 P1 Z0\nG0 Z5\n{cuts}");
    let run = programs(&format!("{head}{cuts}"), &probed);
    let lines = [
        "  zero set by the program: G10 instead of none (line 5)\n",
        "  probe: G38.2 instead of none (line 4)\n",
    ];
    assert_prints(&run, 0, &lines);
    assert_prints(&programs(&probed, &probed), 0, &["0 of 1 path changed\n"]);
    // Without contact, there is no alarm.
    let quiet = probed.replace("G38.2", "G38.3");
    assert_prints(&programs(&probed, &quiet), 0, &["  probe: G38.3 instead of G38.2 (line 4)\n"]);
}

/// On `LinuxCNC`, T only prepares the tool that M6 inserts. Other controls take the tool at T.
#[test]
fn a_missing_tool_change_is_a_change_of_the_tool() {
    let cuts =
        "G21 G90 G17 G94 G54\nG0 Z20\nT3 M6\nM3 S9000\nG0 X0 Y0\nG1 Z-1 F100\nG1 X20\nG0 Z20\nM5\nM30\n";
    let without = cuts.replace(" M6", "");
    let place =
        Place::new().file("old.nc", cuts).file("new.nc", &without).file("other.nc", cuts.replace("T3", "T4"));
    let diff = |arguments: &str| place.run(&format!("diff {arguments}"));
    let lost = ["  tool: none instead of T3", "1 of 1 path changed"];
    assert_prints(&diff("old.nc new.nc --dialect linuxcnc"), 0, &lost);
    assert_prints(&diff("new.nc old.nc --dialect linuxcnc"), 0, &["  tool: T3 instead of none"]);
    assert_prints(&diff("new.nc new.nc --dialect linuxcnc"), 0, &["0 of 1 path changed\n"]);
    let run = diff("old.nc new.nc --dialect marlin");
    assert!(!run.stdout.contains("tool: "), "{run}");
}

/// Every height of the finished program differs.
#[test]
fn another_correction_of_heights_is_a_change() {
    let drawing = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B4\"\nmill 0,0 40,0\nprobe 10,0\nprobe 30,0\nprobe 20,10\nend 40,0\n";
    let drawing = sheet(drawing).unwrap().to_dxf();
    let configuration = "feed = 150\nrapid = 1000\nsweep-height = 20\nprobe-feed = 40\n";
    let mut place = Place::new();
    for (side, model) in [
        ("old", ""),
        ("same", "z-split = 0\n"),
        ("plane", "z-model = \"plane\"\n"),
        ("split", "z-split = 5\n"),
    ] {
        place = place.file(&format!("{side}/pathbuild.toml"), format!("{configuration}{model}"));
        place = place.file(&format!("{side}/1234.1P.dxf"), &drawing);
        let run = place.run(&format!("emit {side}"));
        assert_eq!(run.status, Some(0), "{run}");
    }
    let diff = |new: &str| place.run(&format!("diff old {new}"));
    assert_prints(&diff("same"), 0, &["0 of 1 path changed\n"]);
    let words = "  height correction: z-model plane, z-split 20 instead of z-model idw4, z-split 0";
    assert_prints(&diff("plane"), 0, &[words, "1 of 1 path changed"]);
    assert_prints(
        &diff("split"),
        0,
        &["  height correction: z-model idw4, z-split 5 instead of z-model idw4, z-split 0"],
    );
    let programs = |new: &str| place.run(&format!("diff old/1234.1P_Clean.gcode {new}/1234.1P_Clean.gcode"));
    assert_prints(&programs("same"), 0, &["0 of 1 path changed\n"]);
    for new in ["plane", "split"] {
        assert_prints(&programs(new), 0, &["  height correction: +", "1 of 1 path changed"]);
    }
}

#[test]
fn words_are_compared_in_their_order_where_cuts_differ() {
    let longer = TWO_CUTS.replace("G1 X30", "G1 X30\nG1 X40");
    let run = programs(TWO_CUTS, &longer);
    assert_prints(&run, 0, &["  added: ", "1 of 1 path changed\n"]);
    assert!(!run.stdout.contains("stop"), "{run}");
    let run = programs(TWO_CUTS, &longer.replace("T1", "T2"));
    assert_prints(&run, 0, &["  added: ", "  tool: T2 instead of T1"]);
}

#[test]
fn programs_whose_moves_are_not_known_are_not_said_to_be_equal() {
    let calling = TWO_CUTS.replace("G0 X0", "o100 call\nG0 X0");
    assert_prints(
        &programs(TWO_CUTS, &calling),
        1,
        &["b.ngc · a.ngc → b.ngc: has errors now\n", "0 of 1 path changed, 1 with errors now\n"],
    );
    assert_prints(&programs(&calling, &calling), 1, &["has errors, before and now"]);
    assert_prints(&programs(&calling, TWO_CUTS), 1, &["had errors, has none now"]);
    // An error that hides no moves does not prevent the comparison.
    let without_end = TWO_CUTS.replace("G1 X30", "G1 X30 P-1");
    assert_prints(&programs(TWO_CUTS, &without_end), 1, &["0 of 1 path changed\n"]);
}

/// Native programs have errors, too: moves that the machine cannot make, and warnings that the configuration turns into errors.
#[test]
fn a_native_program_that_is_not_written_has_errors() {
    let compare = |sides: [&str; 2], depths: [&str; 2]| {
        let place = two(dxf("1001.1P", depths[0], LINE), dxf("1001.1P", depths[1], LINE));
        for (side, settings) in ["old", "new"].into_iter().zip(sides) {
            let text = format!("rapid = 1000\nlibrary = [\"parts\"]\n{settings}");
            fs::write(place.path().join(side).join("pathbuild.toml"), text).unwrap();
        }
        place
    };
    let assert_compared = |sides, depths, status, line: &str, code: &str| {
        let run = compare(sides, depths).run("diff old new");
        assert_prints(&run, status, &[line]);
        assert_eq!(run.stderr.contains(&format!("error[{code}]")), status == 1, "{run}");
        assert!(!run.stdout.contains("were not compared"), "{run}");
    };
    let (low, high) = ("[machine]\nz = [0, 9]\n", "[machine]\nz = [0, 11]\n");
    assert_compared([high, high], ["1", "0.5"], 0, "  0.5 mm deeper: ", "PB748");
    assert_compared([low, low], ["1", "0.5"], 1, "  0.5 mm deeper: ", "PB748");
    assert_compared([high, low], ["1", "1"], 1, ": has errors now\n", "PB748");
    assert_compared([high, high], ["1", "1"], 0, "0 of 1 path changed", "PB748");
    // Nothing has changed, so no program is written to find out.
    assert_compared([low, low], ["1", "1"], 0, "0 of 1 path changed", "PB748");
    let (error, useless) = ("[severity]\nPB210 = \"error\"\n", "1 C0.2");
    assert_compared(["", ""], [useless, useless], 0, "0 of 1 path changed", "PB210");
    assert_compared([error, error], [useless, useless], 1, ": has errors, before and now\n", "PB210");
    assert_compared(["", error], [useless, useless], 1, ": has errors now\n", "PB210");
    assert_compared([error, ""], [useless, useless], 0, ": had errors, has none now\n", "PB210");
    assert_compared([error, error], [useless, "0.5 C0.2"], 1, "  0.5 mm deeper: ", "PB210");
    for (settings, depth, outcome) in
        [(high, "1", ": new\n"), (low, "1", ": new, has errors\n"), (error, useless, ": new, has errors\n")]
    {
        let place = compare([settings, settings], ["1", "1"]);
        let place = place.file("new/parts/1002.1P.dxf", dxf("1002.1P", depth, LINE));
        assert_prints(&place.run("diff old new"), i32::from(outcome.contains("errors")), &[outcome]);
    }
    let place = compare([low, low], ["1", "1"]);
    assert_eq!(place.run("emit new/parts/1001.1P.dxf --config old/pathbuild.toml").status, Some(1));
    fs::write(place.path().join("high.toml"), "rapid = 1000\nlibrary = [\"new/parts\"]\n").unwrap();
    assert_eq!(place.run("emit new/parts/1001.1P.dxf --config high.toml").status, Some(0));
    let against =
        |config| place.run(&format!("diff new/parts/1001.1P_Milling.gcode 1001.1P --config {config}"));
    assert_prints(&against("high.toml"), 0, &["0 of 1 path changed"]);
    let run = against("new/pathbuild.toml");
    assert_eq!((run.status, run.stderr.contains("error[PB748]")), (Some(1), true), "{run}");
}

/// A path without a feed has no program, so there is nothing to compare with.
#[test]
fn a_path_that_needs_an_option_is_not_compared() {
    let drawing =
        sheet("layer 1001.1P\nstart 0,0 \"T5 O2 I9 B1 MPlate S10\"\nmill 0,0 40,0\nend 40,0\n").unwrap();
    let place = Place::new().file("1001.1P.dxf", drawing.to_dxf()).file("pathbuild.toml", "rapid = 1000\n");
    assert_eq!(place.run("emit 1001.1P --feed 100").status, Some(0));
    let run = place.run("diff 1001.1P_Milling.gcode 1001.1P");
    assert!(run.status == Some(2) && run.stderr.contains("missing: the milling feed"), "{run}");
    assert_prints(&place.run("diff 1001.1P_Milling.gcode 1001.1P --feed 100"), 0, &["0 of 1 path changed"]);
    let drawing =
        sheet("layer 1001.1P\nstart 0,0 \"T5 O2 I9 B1 MPlate F100\"\nmill 0,0 40,0\nend 40,0\n").unwrap();
    let place = place.file("1001.1P.dxf", drawing.to_dxf());
    assert_eq!(place.run("emit 1001.1P --sweep-height 30").status, Some(0));
    let run = place.run("diff 1001.1P_Milling.gcode 1001.1P");
    assert!(run.status == Some(2) && run.stderr.contains("missing: the sweep height"), "{run}");
    let run = place.run("diff 1001.1P_Milling.gcode 1001.1P --sweep-height 30");
    assert_prints(&run, 0, &["0 of 1 path changed"]);
}

/// GRBL's post writes four decimals, and the native program three. The coordinate differs by half a micrometre between them, which is not a
/// change.
#[test]
fn what_a_post_rounds_is_no_change() {
    let line = |end: &str| dxf("1001.1P", "1", &format!("mill 0,0 20,{end}\nmill 20,{end} 40,0"));
    let configuration = "rapid = 1000\nlibrary = [\"parts\"]\npost = \"grbl\"\nspindle = \"manual\"\n";
    let place = two(line("26.7885"), line("26.7905"));
    for side in ["old", "new"] {
        fs::write(place.path().join(side).join("pathbuild.toml"), configuration).unwrap();
    }
    let emit = place.run("emit ./old/parts/1001.1P.dxf --config old/pathbuild.toml --out-dir programs");
    assert_eq!(emit.status, Some(0), "{emit}");
    let programs = fs::read_dir(place.path().join("programs")).unwrap();
    let program = programs.map(|file| file.unwrap().file_name().into_string().unwrap()).next().unwrap();
    let diff = |config: &str| {
        place.run(&format!("diff programs/{program} 1001.1P --config {config}/pathbuild.toml"))
    };
    assert_eq!(diff("old").stdout, "0 of 1 path changed\n");
    assert_prints(&diff("new"), 0, &["added", "1 of 1 path changed"]);
}

/// Posts write circles in several arcs, slopes on arcs as chords, pecks, and rapid moves of their own. None of this is a change, even if only the
/// command line names the post.
#[test]
fn what_a_built_in_post_writes_is_no_change() {
    let drawn = |depth: &str| {
        let elements = "sweep 0,0 15,-8\nmill circle 15,-8 d 6\nsweep 15,-8 15,-15\ncircle 15,-15 d 2 \"C0.7\"\n\
                        sweep 15,-15 0,5\nmill 0,5 20,6.7885\nbars arc 20,6.7885 40,0 r 15 \"D3 P1 U6\"";
        dxf("1001.1P", depth, elements)
    };
    let place = two(drawn("1"), drawn("0.5"));
    let configuration = "rapid = 1000\nlibrary = [\"parts\"]\nspindle = \"manual\"\ncycles = true\n";
    for side in ["old", "new"] {
        fs::write(place.path().join(side).join("pathbuild.toml"), configuration).unwrap();
    }
    for post in pathbuild_post::BUILT_IN.iter().map(|post| post.name) {
        let emit = place.run(&format!(
            "emit ./old/parts/1001.1P.dxf --config old/pathbuild.toml --out-dir {post} --post {post}"
        ));
        assert_eq!(emit.status, Some(0), "{emit}");
        let program = fs::read_dir(place.path().join(post)).unwrap().next().unwrap().unwrap().path();
        let diff = |side: &str| {
            place.run(&format!("diff {} 1001.1P --config {side}/pathbuild.toml", program.display()))
        };
        assert_eq!(diff("old").stdout, "0 of 1 path changed\n", "{post}");
        assert_prints(&diff("new"), 0, &["0.5 mm deeper"]);
    }
}

/// Programs that `post` writes from native ones have all their rapid moves, and holes without C are the same with a cycle. Only the chords that
/// XpertMILL gets for slopes on arcs are rounded twice, and lie up to 0.002 mm beside those of the drawing.
#[test]
fn what_post_writes_from_a_native_program_is_no_change() {
    let library = crate::support::project().join("fixtures/library");
    let configuration = fs::read_to_string(library.join("pathbuild.toml")).unwrap();
    let mut place = Place::new().file("pathbuild.toml", format!("spindle = \"manual\"\n{configuration}"));
    for folder in ["components", "projects"] {
        for drawing in fs::read_dir(library.join(folder)).unwrap().map(Result::unwrap) {
            let name = format!("{folder}/{}", drawing.file_name().to_str().unwrap());
            place = place.file(&name, fs::read(drawing.path()).unwrap());
        }
    }
    for path in ["2050.1P", "8001.1P", "8104.1P"] {
        let emit = place.run(&format!("emit {path} --out-dir native"));
        assert_eq!(emit.status, Some(0), "{emit}");
        let posts = pathbuild_post::BUILT_IN.iter().map(|post| post.name);
        let is_compared = |name: &&str| *name != "native" && (path, *name) != ("8001.1P", "xpertmill");
        for name in posts.filter(is_compared) {
            let post = place.run(&format!("post native/{path}_Milling.gcode --post {name} -o {name}.nc"));
            assert_eq!(post.status, Some(0), "{post}");
            let diff = place.run(&format!("diff {name}.nc {path}"));
            assert_eq!(diff.stdout, "0 of 1 path changed\n", "{path} {name}: {diff}");
        }
    }
}

/// Programs of a definition that names no dialect are read with that definition.
#[test]
fn what_an_own_definition_writes_is_no_change() {
    let own = pathbuild_post::BUILT_IN.iter().find(|post| post.name == "din").unwrap().text;
    let own = own.replace("dialect = \"din\"\n", "");
    let place = two(dxf("1001.1P", "1", LINE), dxf("1001.1P", "0.5", LINE));
    let configuration = "rapid = 1000\nlibrary = [\"parts\"]\nspindle = \"manual\"\npost = \"own.toml\"\n";
    for side in ["old", "new"] {
        fs::write(place.path().join(side).join("pathbuild.toml"), configuration).unwrap();
        fs::write(place.path().join(side).join("own.toml"), &own).unwrap();
    }
    let emit = place.run("emit ./old/parts/1001.1P.dxf --config old/pathbuild.toml --out-dir programs");
    assert_eq!(emit.status, Some(0), "{emit}");
    let program = fs::read_dir(place.path().join("programs")).unwrap().next().unwrap().unwrap().path();
    let diff =
        |side: &str| place.run(&format!("diff {} 1001.1P --config {side}/pathbuild.toml", program.display()));
    assert_eq!(diff("old").stdout, "0 of 1 path changed\n");
    assert_prints(&diff("new"), 0, &["0.5 mm deeper"]);
}

fn git(place: &Place, arguments: &[&str]) {
    let identity =
        ["-c", "user.name=a", "-c", "user.email=a@example.invalid", "-c", "init.defaultBranch=main"];
    let run = Command::new("git").args(identity).args(arguments).current_dir(place.path()).output().unwrap();
    assert!(run.status.success(), "git {arguments:?}: {}", String::from_utf8_lossy(&run.stderr));
}

#[test]
fn revisions_are_compared_with_each_other_and_with_what_lies_there() {
    let place = Place::new()
        .file("pathbuild.toml", "rapid = 1000\nlibrary = [\"parts\"]\n")
        .file("parts/1001.1P.dxf", dxf("1001.1P", "1", LINE));
    git(&place, &["init", "-q"]);
    git(&place, &["add", "-A"]);
    git(&place, &["commit", "-q", "-m", "all"]);
    fs::write(place.path().join("parts/1001.1P.dxf"), dxf("1001.1P", "0.5", LINE)).unwrap();
    assert_prints(&place.run("diff HEAD"), 0, &["1001.1P · parts/1001.1P.dxf: changed", "0.5 mm deeper"]);
    assert_prints(&place.run("diff HEAD HEAD"), 0, &["0 of 1 path changed"]);
    git(&place, &["commit", "-q", "-a", "-m", "deeper"]);
    assert_prints(&place.run("diff HEAD~1 HEAD"), 0, &["0.5 mm deeper"]);
    // Each revision uses its own configuration.
    fs::write(place.path().join("pathbuild.toml"), "rapid = 1000\nlibrary = [\"gone\"]\n").unwrap();
    let run = place.run("diff HEAD~1 HEAD");
    assert_prints(&run, 0, &["0.5 mm deeper"]);
    let unknown = place.run("diff nothing");
    assert!(unknown.status == Some(2) && unknown.stderr.contains("neither a directory"), "{unknown}");
    assert_eq!(place.run("diff --output=x.html -- --help").status, Some(2));
    let status =
        Command::new("git").args(["status", "--porcelain"]).current_dir(place.path()).output().unwrap();
    assert_eq!(String::from_utf8_lossy(&status.stdout), " M pathbuild.toml\n");
}

/// A revision lacks directories that Git ignores and those outside of the repository. No message names the temporary directory.
#[test]
fn directories_that_a_revision_lacks_are_named_as_in_the_repository() {
    let place = committed(
        Place::new()
            .file(
                "pathbuild.toml",
                "rapid = 1000\nlibrary = [\"parts\", \"own\"]\nsearch = [\"../outside\"]\n",
            )
            .file("parts/1001.1P.dxf", dxf("1001.1P", "1", LINE))
            .file("own/1002.1P.dxf", dxf("1002.1P", "1", LINE))
            .file(".gitignore", "own/\n"),
    );
    let run = place.run("diff HEAD --format concise");
    let expected = "HEAD:pathbuild.toml:2: error[PB003] `library` names HEAD:own, but the revision has no such directory";
    assert!(run.status == Some(1) && run.stderr.contains(expected), "{run}");
    assert!(run.stderr.contains("`search` names HEAD:../outside, but the revision has no"), "{run}");
    // The working directory is no revision.
    let outside = "pathbuild.toml:3: error[PB003] `search` names ../outside, which is not a directory";
    assert!(run.stderr.contains(outside), "{run}");
    assert!(!run.stderr.contains("pathbuild-revision"), "{run}");
    assert_eq!(place.run("diff HEAD --format concise").stderr, run.stderr);
    let place = committed(place.file("pathbuild.toml", "rapid = no\n")).file("pathbuild.toml", "");
    let run = place.run("diff HEAD~1 HEAD --format concise");
    assert!(run.stderr.contains("HEAD:pathbuild.toml:1:") && !run.stderr.contains("revision-"), "{run}");
}

/// The programs of a revision are written with the files that the post-processor inserts.
#[test]
fn a_revision_has_the_files_that_the_post_processor_inserts() {
    let post = pathbuild_post::BUILT_IN.iter().find(|post| post.name == "xpertmill").unwrap().text;
    let inserting = post.replace("program-start = '''\n", "program-start = '''\n\\\\\\~*head.nc*\n");
    assert_ne!(inserting, post);
    let configuration = |speed: u32| {
        format!(
            "feed = 150\nrapid = 1000\nlibrary = [\"parts\"]\npost = \"posts/my.toml\"\n[tool.a]\ndiameter = 2\nspindle = {speed}\n"
        )
    };
    let place = Place::new()
        .file("pathbuild.toml", configuration(10000))
        .file("posts/my.toml", inserting)
        .file("posts/head.nc", "// head\n")
        .file("parts/1001.1P.dxf", dxf("1001.1P", "1", LINE));
    git(&place, &["init", "-q"]);
    git(&place, &["add", "-A"]);
    git(&place, &["commit", "-q", "-m", "all"]);
    assert_prints(&place.run("diff HEAD"), 0, &["0 of 1 path changed\n"]);
    let place = place.file("pathbuild.toml", configuration(24000));
    assert_prints(&place.run("diff HEAD"), 0, &["spindle: S24000 instead of S10000"]);
    git(&place, &["commit", "-q", "-a", "-m", "faster"]);
    assert_prints(&place.run("diff HEAD~1 HEAD"), 0, &["spindle: S24000 instead of S10000"]);
}

/// A drawing is compared with its own state in the revision, and not with all other drawings of that time.
#[test]
fn a_drawing_is_compared_with_its_state_in_a_revision() {
    let place = committed(
        Place::new()
            .file("pathbuild.toml", "rapid = 1000\nlibrary = [\"parts\"]\n")
            .file("parts/1001.1P.dxf", dxf("1001.1P", "1", LINE))
            .file("parts/1002.1P.dxf", dxf("1002.1P", "1", LINE)),
    );
    let file = |name: &str| place.path().join(format!("parts/{name}.1P.dxf"));
    fs::write(file("1001"), dxf("1001.1P", "0.5", LINE)).unwrap();
    fs::write(file("1003"), dxf("1003.1P", "1", LINE)).unwrap();
    let run = place.run("diff HEAD parts/1001.1P.dxf");
    assert_prints(&run, 0, &["1001.1P · 1001.1P.dxf: changed", "0.5 mm deeper", "\n1 of 1 path changed\n"]);
    assert_prints(
        &place.run("diff parts/1001.1P.dxf HEAD"),
        0,
        &["0.5 mm higher", "\n1 of 1 path changed\n"],
    );
    let inside = place.run_in("parts", &["diff", "HEAD", "1001.1P.dxf"]);
    assert_prints(&inside, 0, &["0.5 mm deeper", "\n1 of 1 path changed\n"]);
    assert_prints(&place.run("diff HEAD parts/1002.1P.dxf"), 0, &["0 of 1 path changed\n"]);
    assert_prints(&place.run("diff HEAD parts/1003.1P.dxf"), 0, &["1003.1P · 1003.1P.dxf: new", "1 new\n"]);
    let elsewhere = Place::new().file("1001.1P.dxf", dxf("1001.1P", "1", LINE));
    let outside = elsewhere.path().join("1001.1P.dxf");
    let run = place.run_with(&["diff", "HEAD", outside.to_str().unwrap()]);
    assert!(run.status == Some(2) && run.stderr.contains("not in the repository"), "{run}");
    let run = place.run("diff HEAD 1001.1P");
    assert!(run.status == Some(2) && run.stderr.contains("name its drawing (.dxf)"), "{run}");
}

#[test]
fn json_markdown_and_a_page() {
    let place = two(dxf("1001.1P", "1", LINE), dxf("1001.1P", "0.5", LINE));
    let json = place.run("diff old new --format json");
    let lines: Vec<serde_json::Value> =
        json.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let of = |kind: &str| lines.iter().find(|line| line["type"] == kind).unwrap();
    assert_eq!(of("path_change")["changes"][0]["raised"], -0.5);
    assert_eq!(of("path_change")["new_file"], "parts/1001.1P.dxf");
    assert_eq!(of("comparison")["changed"], 1);
    for name in ["d.md", "d.html"] {
        assert_prints(&place.run(&format!("diff old new -o {name}")), 0, &[]);
    }
    let read = |name: &str| fs::read_to_string(place.path().join(name)).unwrap();
    let markdown = read("d.md");
    assert!(markdown.contains("| ` 1001.1P ` | ` parts/1001.1P.dxf ` | 0.5 mm deeper&#58; "), "{markdown}");
    let page = read("d.html");
    // One picture shows the changes, two show old and new side by side, one shows them overlaid, and the others the removed stock.
    assert_eq!(page.matches("<svg").count(), 6);
    assert!(!page.contains("{{") && page.contains("0.5 mm deeper"));
    assert!(
        !page.contains("http://")
            || page.matches("http://").count()
                == page.matches("xmlns=\"http://www.w3.org/2000/svg\"").count()
    );
    assert_eq!(place.run("diff old new -o d.txt").status, Some(2));
}

/// Tests a deeper cut, an added cut, a removed cut and a hole: the picture of the changes, then the pictures of the old and the new moves.
#[test]
fn changes_are_seen() {
    let [old, new] = [
        ("1", "mill 0,0 20,0\nmill 20,0 30,10\nsweep 30,10 40,0"),
        ("0.5", "mill 0,0 20,0\nsweep 20,0 30,-10\nmill circle 30,-10 d 2\nsweep 30,-10 40,0"),
    ]
    .map(|(depth, elements)| dxf("1001.1P", depth, elements));
    let place = two(old, new);
    assert_prints(&place.run("diff old new -o d.html"), 0, &[]);
    let page = place.read("d.html");
    let pictures = page.split("<svg").skip(1).take(3).map(|text| text.split_once("</svg>").unwrap().0);
    assert_snapshot!(pictures.collect::<Vec<_>>().join("\n\n"));
}

/// Removed moves are visible beneath those that replace them, and the legend formats numbers as its language does.
#[test]
fn removed_moves_are_wider_and_beneath() {
    let drawing = |elements: &str| dxf("1001.1P", "1", elements);
    let place = two(drawing("mill 0,0 40,0"), drawing("mill 0,0 20,1.5\nmill 20,1.5 40,0"));
    assert_prints(&place.run("diff old new -o d.html --lang de"), 0, &[]);
    let page = place.read("d.html");
    let picture = page.split("<svg").nth(1).unwrap().split_once("</svg>").unwrap().0;
    let place_of = |style: &str| picture.find(style).unwrap_or_else(|| panic!("{style} in {picture}"));
    let removed = place_of("stroke=\"#d55e00\" stroke-width=\"6\" stroke-dasharray");
    assert!(removed < place_of("stroke=\"#0072b2\" stroke-width=\"2\""), "{picture}");
    let legend: Vec<&str> = picture.split("</text>").filter(|text| text.ends_with(" mm")).collect();
    assert!(
        legend.len() > 1 && legend.iter().any(|text| text.rsplit(' ').nth(1).unwrap().contains(',')),
        "{picture}"
    );
    assert!(legend.iter().all(|text| !text.rsplit(' ').nth(1).unwrap().contains('.')), "{picture}");
}

#[test]
fn alterations_differ_in_colour_or_dashes() {
    let drawing = |step: f64| {
        let piece = |number: u32| {
            let (from, depth) = (6 * number, 4.0 - step * f64::from(number + 1));
            format!("mill {from},0 {},0 \"B{depth:.1}\"\nsweep {},0 {},0\n", from + 4, from + 4, from + 6)
        };
        dxf("1001.1P", "1", &((0..6).map(piece).collect::<String>() + "mill 36,0 40,0"))
    };
    let place = two(drawing(0.0), drawing(0.1));
    assert_prints(&place.run("diff old new -o d.html"), 0, &["0.6 mm deeper"]);
    let page = place.read("d.html");
    let picture = page.split("<svg").nth(1).unwrap().split_once("</svg>").unwrap().0;
    let legend = picture.lines().filter(|line| line.starts_with("<line x1=\"40\""));
    let mut styles: Vec<&str> = legend.map(|line| line.split_once("stroke=").unwrap().1).collect();
    assert_eq!(styles.len(), 6, "{picture}");
    styles.sort_unstable();
    styles.dedup();
    assert_eq!(styles.len(), 6, "{picture}");
}

/// A deeper cut removes more, a higher one leaves more, and another feed or direction does neither.
#[test]
fn the_stock_shows_what_a_change_removes_or_leaves() {
    let stock = |[old, new]: [(&str, &str); 2]| {
        let place = two(dxf("1001.1P", old.0, old.1), dxf("1001.1P", new.0, new.1));
        assert_prints(&place.run("diff old new -o d.html"), 0, &[]);
        let page = place.read("d.html");
        ["removed now, not before", "left now, removed before"].map(|text| page.contains(text))
    };
    assert_eq!(stock([("1", LINE), ("0.5", LINE)]), [true, false]);
    assert_eq!(stock([("0.5", LINE), ("1", LINE)]), [false, true]);
    assert_eq!(stock([("1", LINE), ("1", "mill 0,0 40,0 \"F130\"")]), [false, false]);
    let forwards = "sweep 0,0 0,10\nmill 0,10 40,10\nsweep 40,10 40,0";
    let backwards = "sweep 0,0 40,10\nmill 40,10 0,10\nsweep 0,10 40,0";
    assert_eq!(stock([("1", forwards), ("1", backwards)]), [false, false]);
}

#[test]
fn names_are_no_markup() {
    let place = two(dxf("1001.1P", "1", LINE), dxf("1001.1P", "0.5", LINE));
    for side in ["old", "new"] {
        let parts = place.path().join(side).join("parts");
        fs::rename(parts.join("1001.1P.dxf"), parts.join("1001.1P [x](y) @z _b_ `&c.dxf")).unwrap();
    }
    for name in ["d.md", "d.html"] {
        place.run(&format!("diff old new -o {name}"));
    }
    let read = |name: &str| fs::read_to_string(place.path().join(name)).unwrap();
    let markdown = read("d.md");
    // Names are formatted as code, which keeps GitHub from turning them into links.
    assert!(markdown.contains("| `` parts/1001.1P [x](y) @z _b_ `&c.dxf `` |"), "{markdown}");
    assert!(read("d.html").contains("@z _b_ `&amp;c.dxf"));
}

/// Names that are printed do not act as commands of CI runners either.
#[test]
fn names_of_what_cannot_be_compared_are_no_markup() {
    let place = two(dxf("1001.1P", "1", LINE), dxf("1001.1P", "0.5", LINE));
    let parts = place.path().join("new/parts");
    fs::rename(parts.join("1001.1P.dxf"), parts.join("1001.1P ##[group] a.dxf")).unwrap();
    fs::write(parts.join("x www.example.com `z.dxf"), "no drawing").unwrap();
    place.run("diff old new -o d.md");
    let markdown = place.read("d.md");
    assert!(markdown.contains("\n- `` new/parts/x www.example.com `z.dxf: PB002: "), "{markdown}");
    assert!(markdown.contains("#\\u{23}[group] a.dxf") && !markdown.contains("##["), "{markdown}");
}

// Extraction of revisions from Git, including hostile and oversized ones.

fn committed(place: Place) -> Place {
    git(&place, &["init", "-q"]);
    git(&place, &["add", "-A"]);
    git(&place, &["commit", "-q", "-m", "all"]);
    place
}

/// Runs the program with another directory for temporary files.
fn run_with_temporary(place: &Place, temporary: &std::path::Path, arguments: &[&str]) -> String {
    let mut program = crate::support::program();
    program.env("TMPDIR", temporary).env("TEMP", temporary).env("TMP", temporary);
    let output = program.args(arguments).current_dir(place.path()).output().unwrap();
    format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr))
}

#[test]
fn what_lies_above_temporary_files_does_not_hold() {
    let temporary = Place::new().file("pathbuild.toml", "path-pattern = 'X'\n");
    // Test a tree without a configuration, and one with its own.
    for configuration in [None, Some("rapid = 1000\nlibrary = [\".\"]\n")] {
        let mut place = Place::new().file("1001.1P.dxf", dxf("1001.1P", "1", LINE));
        if let Some(configuration) = configuration {
            place = place.file("pathbuild.toml", configuration);
        }
        let place = committed(place);
        fs::write(place.path().join("1001.1P.dxf"), dxf("1001.1P", "0.5", LINE)).unwrap();
        git(&place, &["commit", "-q", "-a", "-m", "deeper"]);
        let said = run_with_temporary(&place, temporary.path(), &["diff", "HEAD~1", "HEAD"]);
        assert!(said.contains("0.5 mm deeper") && said.contains("1 of 1 path changed"), "{said}");
        let left = fs::read_dir(temporary.path()).unwrap().count();
        assert_eq!(left, 1, "nothing of it stays");
    }
}

/// A killed run leaves the drawings of its revision behind. The next run removes them, but not other directories, nor the drawings of a run that is
/// still active.
#[test]
fn what_a_killed_run_left_of_a_revision_is_removed() {
    let place = committed(Place::new().file("1001.1P.dxf", dxf("1001.1P", "1", LINE)));
    let temporary = Place::new()
        .file("pathbuild-revision-killed/lock", "")
        .file("pathbuild-revision-killed/tree/a.dxf", "")
        .file("pathbuild-revision-running/lock", "")
        .file("pathbuild-other/lock", "");
    let lock = fs::File::open(temporary.path().join("pathbuild-revision-running/lock")).unwrap();
    lock.try_lock().unwrap();
    run_with_temporary(&place, temporary.path(), &["diff", "HEAD"]);
    let left = fs::read_dir(temporary.path()).unwrap().map(|entry| entry.unwrap().file_name());
    let mut left: Vec<String> = left.map(|name| name.into_string().unwrap()).collect();
    left.sort();
    assert_eq!(left, ["pathbuild-other", "pathbuild-revision-running"]);
}

/// The working directory was created after the revision.
#[test]
fn all_is_new_in_a_directory_that_the_revision_lacks() {
    let place = committed(Place::new().file("a.txt", ""));
    fs::create_dir(place.path().join("new")).unwrap();
    fs::write(place.path().join("new/1001.1P.dxf"), dxf("1001.1P", "1", LINE)).unwrap();
    let run = place.run_in("new", &["diff", "HEAD"]);
    assert_prints(&run, 0, &["1001.1P · 1001.1P.dxf: new", "0 of 1 path changed, 1 new"]);
}

/// A revision has the commit of a submodule, but not its drawings. A submodule without drawings, or beside the library, does no harm.
#[test]
fn drawings_in_a_submodule_are_not_said_to_be_new() {
    let library = "library = [\"parts\"]\n";
    for (inside, configuration, status) in
        [("1001.1P.dxf", "", 2), ("1001.1P.dxf", library, 0), ("a.txt", "", 0)]
    {
        let place = Place::new()
            .file("pathbuild.toml", configuration)
            .file("parts/1002.1P.dxf", dxf("1002.1P", "1", LINE))
            .file(&format!("lib/{inside}"), dxf("1001.1P", "1", LINE));
        let directory = place.path().join("lib").to_str().unwrap().to_owned();
        for arguments in [&["init", "-q"][..], &["add", "-A"], &["commit", "-q", "-m", "lib"]] {
            git(&place, &[&["-C", &directory], arguments].concat());
        }
        let run = committed(place).run("diff HEAD");
        assert_eq!(run.status, Some(status), "{run}");
        assert_eq!(run.stderr.contains("does not have the drawings of the submodule"), status == 2, "{run}");
        assert!(!run.stdout.contains("new"), "{run}");
    }
}

/// A file larger than the limit for drawings is not extracted, but rejected by its size.
#[cfg(unix)]
#[test]
fn large_files_of_a_revision_are_not_written_whole() {
    let place = Place::new().file("pathbuild.toml", "rapid = 1000\nlibrary = [\".\"]\n");
    // A sparse file takes no space on disk.
    fs::File::create(place.path().join("1001.1P.dxf")).unwrap().set_len((1 << 30) + 1).unwrap();
    let (run, time) = committed(place).run_timed("diff HEAD HEAD");
    assert!(run.stderr.contains("the file's size of 1073741825 bytes"), "{run}");
    assert!(time < std::time::Duration::from_secs(2), "{time:?}");
}

/// A revision is read with the limits of its own configuration, which may differ from today's.
#[test]
fn the_limits_of_a_revision_are_its_own() {
    let configuration = "rapid = 1000\nlibrary = [\".\"]\n";
    let place =
        Place::new().file("pathbuild.toml", configuration).file("1001.1P.dxf", dxf("1001.1P", "1", LINE));
    let place = committed(place).file("1001.1P.dxf", dxf("1001.1P", "0.5", LINE));
    git(&place, &["commit", "-q", "-a", "-m", "deeper"]);
    let place = place.file("pathbuild.toml", format!("{configuration}[limits]\nfile-size = 100\n"));
    assert_prints(&place.run("diff HEAD~1 HEAD"), 0, &["0.5 mm deeper"]);
}

/// A tree contains an empty Git object under so many names that these exceed 4 GiB together.
#[cfg(unix)]
#[test]
fn a_revision_has_an_end() {
    let large = 256 << 20;
    let place =
        Place::new().file("pathbuild.toml", "rapid = 1000\nlibrary = [\".\"]\n").file("1001.1P.dxf", "");
    let file = fs::File::options().write(true).open(place.path().join("1001.1P.dxf")).unwrap();
    file.set_len(large).unwrap();
    let place = committed(place);
    let id = Command::new("git").args(["rev-parse", "HEAD:1001.1P.dxf"]).current_dir(place.path()).output();
    let id = String::from_utf8(id.unwrap().stdout).unwrap().trim().to_owned();
    for number in 1002..1018 {
        let entry = format!("100644,{id},{number}.1P.dxf");
        git(&place, &["update-index", "--add", "--cacheinfo", &entry]);
    }
    git(&place, &["commit", "-q", "-m", "many"]);
    let run = place.run("diff HEAD HEAD");
    assert_eq!((run.status, run.stderr.contains("more than 4 GiB")), (Some(2), true), "{run}");
    let german = place.run("diff HEAD HEAD --lang de");
    assert!(german.stderr.contains("mehr als 4 GiB") && !german.stderr.contains("git:"), "{german}");
}

/// The path of a file is as long as the system permits.
#[cfg(unix)]
#[test]
fn names_of_a_revision_have_an_end() {
    for (depth, is_right) in [(15, true), (25, false)] {
        let place = committed(Place::new().file("a.txt", ""));
        let tree =
            hostile_tree(&place, &format!("{}1001.1P.dxf", format!("{}/", "a".repeat(200)).repeat(depth)));
        let run = place.run_with(&["diff", &tree, &tree]);
        assert_eq!(run.status, Some(if is_right { 0 } else { 2 }), "{run}");
        assert_eq!(run.stderr.contains("the name of a file in the revision is too long"), !is_right, "{run}");
    }
}

#[test]
fn ignore_files_and_empty_directories_of_a_revision_hold() {
    let place = Place::new()
        .file("pathbuild.toml", "library = [\"parts\", \"empty\"]\n")
        .file("empty/a.txt", "")
        .file("parts/.gitignore", "1002*\n")
        .file("parts/1001.1P.DXF", dxf("1001.1P", "1", LINE))
        .file("parts/1002.1P.dxf", dxf("1002.1P", "1", LINE));
    git(&place, &["init", "-q"]);
    git(&place, &["add", "-f", "-A"]);
    git(&place, &["commit", "-q", "-m", "all"]);
    assert_prints(&place.run("diff HEAD HEAD"), 0, &["0 of 1 path changed"]);
}

/// Drawings are links: one to another file of the tree, and one to a file outside.
#[cfg(unix)]
#[test]
fn links_of_a_revision_stay_in_its_tree() {
    use std::os::unix::fs::symlink;

    for (target, is_inside) in [
        ("../store/a.bin", true),
        ("./../store/../store/a.bin", false),
        ("../../tree/store/a.bin", false),
        ("../link/a.bin", true),
        ("../../outside.dxf", false),
        ("/outside.dxf", false),
    ] {
        let place = Place::new()
            .file("pathbuild.toml", "rapid = 1000\nlibrary = [\"parts\"]\n")
            .file("store/a.bin", dxf("1001.1P", "1", LINE))
            .file("parts/1002.1P.dxf", dxf("1002.1P", "1", LINE));
        symlink("store", place.path().join("link")).unwrap();
        symlink(target, place.path().join("parts/1001.1P.dxf")).unwrap();
        let place = committed(place);
        let run = place.run("diff HEAD HEAD");
        assert_eq!(run.stderr.contains("left out"), !is_inside, "{target}: {run}");
        assert_eq!(run.stderr.contains("parts/1001.1P.dxf"), !is_inside, "{target}: {run}");
    }
}

/// Creates a tree with one drawing, under a name that Git itself may reject.
#[cfg(unix)]
fn hostile_tree(place: &Place, name: &str) -> String {
    use std::io::Write;
    use std::process::Stdio;

    let said = |arguments: &[&str], bytes: &[u8]| {
        let mut command = Command::new("git");
        command.args(arguments).current_dir(place.path()).stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().unwrap();
        child.stdin.take().unwrap().write_all(bytes).unwrap();
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success(), "{arguments:?}");
        String::from_utf8(output.stdout).unwrap().trim().to_owned()
    };
    let blob = said(&["hash-object", "-w", "--stdin"], &dxf("1001.1P", "1", LINE));
    let names: Vec<&str> = name.split('/').collect();
    let id = |hex: &str| {
        (0..20).map(|at| u8::from_str_radix(&hex[2 * at..2 * at + 2], 16).unwrap()).collect::<Vec<u8>>()
    };
    let mut below = (b"100644 ".to_vec(), blob);
    for name in names.iter().rev() {
        let tree = [&below.0[..], name.as_bytes(), b"\0", &id(&below.1)].concat();
        let tree = said(&["hash-object", "-w", "-t", "tree", "--literally", "--stdin"], &tree);
        below = (b"40000 ".to_vec(), tree);
    }
    below.1
}

#[cfg(unix)]
#[test]
fn names_of_a_revision_stay_in_its_tree() {
    let temporary = Place::new();
    for (name, is_plain) in [
        ("a/1001.1P.dxf", true),
        ("a..b/1001.1P.dxf", true),
        ("../1001.1P.dxf", false),
        ("a/../../../1001.1P.dxf", false),
        (".GIT/1001.1P.dxf", false),
        (".git/1001.1P.dxf", false),
    ] {
        let place = committed(Place::new().file("a.txt", ""));
        let tree = hostile_tree(&place, name);
        let said = run_with_temporary(&place, temporary.path(), &["diff", &tree, &tree]);
        assert_eq!(said.contains("left out"), !is_plain, "{name}: {said}");
        assert_eq!(said.contains("0 of 1 path changed"), is_plain, "{name}: {said}");
        assert_eq!(fs::read_dir(temporary.path()).unwrap().count(), 0, "{name}");
    }
}
