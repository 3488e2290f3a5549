//! Exceeded limits that prevent comparing, listing, finding or reading are reported, without misleading messages.

use std::fs;
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::support::{Place, Run};
use pathbuild_testkit::sheet;

const CONFIGURATION: &str = "feed = 150\nrapid = 1000\nsweep-height = 20\nspindle = \"manual\"\n";

fn limits(limits: &str) -> String {
    format!("{CONFIGURATION}[limits]\n{limits}\n")
}

/// Returns the drawing of a path. The smaller its infeed, the longer its program.
fn path(infeed: &str) -> Vec<u8> {
    let drawn = format!("layer 1234.1P\nstart 0,0 \"T5 O2 I{infeed} B0 MX\"\nmill 0,0 40,0\nend 40,0");
    sheet(&drawn).unwrap().to_dxf()
}

#[track_caller]
fn assert_exceeds(run: &Run, status: i32, key: &str) {
    assert_eq!(run.status, Some(status), "{run}");
    assert!(run.stderr.contains("PB005") && run.stderr.contains(&format!("`{key}`")), "{run}");
}

fn json(run: &Run) -> Vec<Value> {
    run.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

const FEW: &str = "1";
const OTHERS: &str = "0.9";
const MANY: &str = "0.005";
const STILL_MORE: &str = "0.004";

/// Creates an old and a new side, with a limit of 8 KiB for programs.
fn sides(old: &str, new: &str) -> Place {
    let configuration = limits("output-size = \"8 KiB\"");
    Place::new()
        .file("old/pathbuild.toml", &configuration)
        .file("new/pathbuild.toml", &configuration)
        .file("old/1234.dxf", path(old))
        .file("new/1234.dxf", path(new))
}

#[test]
fn a_side_without_a_program_has_no_moves_that_could_be_gone() {
    for (old, new, outcome, said) in [
        (FEW, MANY, "broken", "has errors now\n"),
        (MANY, FEW, "mended", "had errors, has none now\n"),
        (MANY, STILL_MORE, "still-broken", "has errors, before and now\n"),
    ] {
        let place = sides(old, new);
        let run = place.run("diff old new");
        assert_exceeds(&run, 1, "output-size");
        assert!(run.stdout.contains(said) && !run.stdout.contains("moves"), "{run}");
        let run = place.run("diff old new --format json");
        assert_eq!(run.status, Some(1), "{run}");
        let rows = json(&run);
        assert!(rows.iter().any(|row| row["outcome"] == outcome), "{run}");
        assert!(rows.iter().any(|row| row["code"] == "PB005"), "{run}");
        for file in ["changes.md", "changes.html"] {
            assert_eq!(place.run(&format!("diff old new -o {file}")).status, Some(1));
            let text = place.read(file);
            assert!(text.contains("PB005") && text.contains("output-size"), "{text}");
        }
    }
    let run = sides(FEW, OTHERS).run("diff old new");
    assert_eq!(run.status, Some(0), "{run}");
    assert!(run.stdout.contains(": changed\n") && run.stderr.is_empty(), "{run}");
}

/// Equal moves are recognised without writing the program's text.
#[test]
fn a_program_that_is_too_large_on_both_sides_is_the_same() {
    let run = sides(MANY, MANY).run("diff old new");
    assert_eq!(run.status, Some(0), "{run}");
    assert!(run.stdout.starts_with("0 of 1 path changed"), "{run}");
}

/// Moves are counted before they are generated.
#[test]
fn a_side_with_too_many_moves_says_so() {
    let run = sides(FEW, "0.0000001").run("diff old new");
    assert_eq!(run.status, Some(1), "{run}");
    assert!(run.stdout.contains("has errors now\n") && run.stderr.contains("PB005"), "{run}");
}

#[test]
fn of_a_program_that_cannot_be_made_nobody_knows_whether_it_is_current() {
    let place = Place::new().file("pathbuild.toml", CONFIGURATION).file("1234.dxf", path(FEW));
    assert_eq!(place.run("emit 1234.1P").status, Some(0));
    let files = fs::read_dir(place.path()).unwrap().map(|entry| entry.unwrap());
    let program = files.filter(|file| file.file_name().to_string_lossy().contains("_Milling"));
    let size = program.map(|file| file.metadata().unwrap().len()).next().unwrap();
    let inside = place.file("pathbuild.toml", limits(&format!("output-size = {size}")));
    let run = inside.run("list 1234.1P");
    assert_eq!(run.status, Some(0), "{run}");
    assert!(run.stdout.contains("program current"), "{run}");
    let outside = inside.file("pathbuild.toml", limits(&format!("output-size = {}", size - 1)));
    let run = outside.run("list 1234.1P");
    assert_exceeds(&run, 1, "output-size");
    assert!(run.stdout.contains("1 error") && !run.stdout.contains("not current"), "{run}");
    let run = outside.run("list 1234.1P --format json");
    let row = json(&run).into_iter().find(|row| row["path"] == "1234.1P" && row["type"] == "path").unwrap();
    assert_eq!((&row["state"], &row["program"]), (&Value::from("errors"), &Value::Null), "{run}");
}

#[test]
fn a_path_of_a_drawing_that_cannot_be_read_is_not_nowhere() {
    let place = |most: &str| {
        Place::new().file("pathbuild.toml", limits(&format!("entities = {most}"))).file("1234.dxf", path(FEW))
    };
    let run = place("1").run("emit 1234.1P");
    assert_exceeds(&run, 1, "entities");
    assert!(!run.stderr.contains("PB503"), "{run}");
    assert_eq!(place("1000").run("emit 1234.1P").status, Some(0));
    let run = place("1000").run("emit 1234.2P");
    assert!(run.status == Some(1) && run.stderr.contains("PB503"), "{run}");
    let run = place("1000").file("1234.dxf", "This is no drawing.\n").run("emit 1234.1P");
    assert!(run.status == Some(1) && !run.stderr.contains("PB503"), "{run}");
    assert!(run.stderr.contains("1234.dxf"), "{run}");
}

fn g_code(memory: u64, lines: &str) -> Place {
    let text = format!("G17 G21 G40 G49 G54 G80 G90 G94\nT1 M6\nM3 S1000\nG0 X0 Y0\nG0 Z10\n{lines}M30\n");
    let other = text.replace("G0 Z10", "G0 Z11");
    Place::new()
        .file("pathbuild.toml", limits(&format!("program-memory = {memory}")))
        .file("a.gcode", text)
        .file("b.gcode", other)
}

const READ: [&str; 3] = [
    "import a.gcode --dialect linuxcnc",
    "view a.gcode --dialect linuxcnc -o v.svg",
    "diff a.gcode b.gcode --dialect linuxcnc",
];

#[test]
fn the_steps_of_a_program_that_is_read_are_counted() {
    let lines = "G1 Z0 F100\nG1 X10\nG0 Z10\n";
    let asked = g_code(1, lines).run(READ[0]);
    assert_exceeds(&asked, 1, "program-memory");
    let (_, rest) = asked.stderr.split_once("about ").unwrap();
    let step: u64 = rest.split(' ').next().unwrap().parse().unwrap();
    for command in READ {
        let is_inside = |most: &u64| {
            let run = g_code(most * step, lines).run(command);
            assert!(run.status == Some(0) || run.stderr.contains("`program-memory`"), "{run}");
            run.status == Some(0)
        };
        let most = (1..50).find(is_inside).unwrap();
        assert!(most > 5, "{command}");
        assert_exceeds(&g_code(most * step - 1, lines).run(command), 1, "program-memory");
    }
}

/// Each line of eleven bytes expands to 76,000 moves.
#[test]
fn repeated_cycles_do_not_fill_the_memory() {
    let lines = format!("G91 G81 X.001 Y.001 Z-1 R1 F100 L1\n{}G80\n", "X.001 L19000\n".repeat(5000));
    for command in READ {
        let begun = Instant::now();
        assert_exceeds(&g_code(16 << 20, &lines).run(command), 1, "program-memory");
        assert!(begun.elapsed() < Duration::from_secs(20), "{command}");
    }
}

#[test]
fn an_arc_says_how_many_turns_it_may_have() {
    let run = |turns: u32| {
        let place = g_code(1 << 30, &format!("G1 Z0 F100\nG2 X0 Y0 I10 J0 P{turns}\nG0 Z10\n"));
        place.run("import a.gcode --dialect linuxcnc")
    };
    let inside = run(100_000);
    assert_eq!(inside.status, Some(0), "{inside}");
    let outside = run(100_001);
    assert_eq!(outside.status, Some(1), "{outside}");
    assert!(outside.stderr.contains("a whole number of turns from 1 to 100000"), "{outside}");
}

#[test]
fn a_baseline_is_a_file_of_limited_size() {
    let run = |limit: u32| {
        let place = Place::new()
            .file("pathbuild.toml", limits(&format!("file-size = {limit}")))
            .file("1234.dxf", path(FEW))
            .file("known.txt", format!("#{}\n", " ".repeat(99_998)));
        place.run("check 1234.dxf --baseline known.txt")
    };
    let inside = run(100_000);
    assert_eq!(inside.status, Some(0), "{inside}");
    assert_exceeds(&run(99_999), 2, "file-size");
}

const PROJECT: &str = r#"
== 1234.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I5 B0 MPlate"
mill 0,0 40,0
end 40,0
layer 1234.2P
start 0,20 "T5 O2 I5 B0 MPlate"
mill 0,20 40,20
end 40,20
== 8001.dxf ==
layer 8001.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">1234.1P"
subpath 40,0 80,0 ">1234.2P"
end 80,0
== 8002.dxf ==
layer 8002.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 80,0 ">8001.1P"
end 80,0
"#;

#[test]
fn what_is_beyond_the_limit_of_paths_is_not_too_deep() {
    let run = |most: u32| {
        let place = Place::of(PROJECT).file("pathbuild.toml", limits(&format!("embedded-paths = {most}")));
        place.run("deps 8002.1P")
    };
    let inside = run(4);
    assert_eq!(inside.status, Some(0), "{inside}");
    assert!(!inside.stdout.contains("PB"), "{inside}");
    assert_exceeds(&run(3), 1, "embedded-paths");
    // The paths that the second path embeds are not examined.
    let outside = run(1);
    assert_exceeds(&outside, 1, "embedded-paths");
    assert!(outside.stdout.contains("PB005") && !outside.stdout.contains("PB508"), "{outside}");
}

#[test]
fn a_q_project_is_not_written_into_a_file_named_by_a_dash() {
    let place = Place::of(PROJECT).file("pathbuild.toml", CONFIGURATION);
    let run = place.run("q-project 1234.dxf -o -");
    assert_eq!(run.status, Some(2), "{run}");
    assert!(run.stderr.contains("`-o -`") && !place.path().join("-").exists(), "{run}");
    let run = place.run("q-project 1234.dxf -o q.dxf");
    assert_eq!(run.status, Some(0), "{run}");
    assert!(place.path().join("q.dxf").exists(), "{run}");
}

/// The ends of chords divide each turn of an arc of many turns. Beyond a million pieces, cuts are compared as a whole, which the
/// result says.
#[test]
fn too_many_cuts_to_divide_are_compared_as_a_whole_and_say_so() {
    let program = |turns: u32, depth: &str| {
        // Points on a circle with whole numbers.
        let chords = "G1 X24 Y7\nG1 X20 Y15\nG1 X15 Y20\nG1 X7 Y24\nG1 X0 Y25\nG1 X-7 Y24\nG1 X-15 Y20\nG1 X-20 Y15\nG1 X-24 Y7\nG1 X-25 Y0\nG1 X-24 Y-7\nG1 X25 Y0\n";
        format!(
            "G21 G90 G17 G94\nG0 Z5\nG0 X25 Y0\nG1 Z{depth} F150\n{chords}G1 Z-1\nG3 X25 Y0 I-25 J0 P{turns}\nG0 Z5\nM2\n"
        )
    };
    let sides =
        |turns| Place::new().file("a.ngc", program(turns, "-2")).file("b.ngc", program(turns, "-2.5"));
    let diff = "diff a.ngc b.ngc --dialect linuxcnc";
    let said = "too many cuts end on each other";
    let inside = sides(2).run(diff);
    assert!(inside.stdout.contains("0.5 mm deeper") && !inside.stdout.contains(said), "{inside}");
    assert_eq!(json(&sides(2).run(&format!("{diff} --format json")))[1]["has_undivided_moves"], Value::Null);

    let place = sides(100_000);
    let outside = place.run(&format!("{diff} -o d.html"));
    assert!(outside.stdout.contains("0.5 mm deeper") && outside.stdout.contains(said), "{outside}");
    assert!(!outside.stdout.contains("passes"), "{outside}");
    assert!(fs::read_to_string(place.path().join("d.html")).unwrap().contains(said));
    let german = place.run(&format!("{diff} -o d.md --lang de"));
    assert!(german.stdout.contains("zu viele Schnitte enden aufeinander"), "{german}");
    assert!(fs::read_to_string(place.path().join("d.md")).unwrap().contains("zu viele Schnitte"));
    assert_eq!(json(&place.run(&format!("{diff} --format json")))[1]["has_undivided_moves"], true);
}
