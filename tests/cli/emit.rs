//! Tests the files that `emit` writes, compares and removes. (book: reference/commands, book: program/gcode)

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use crate::conformance::recorded::{self, Form, Run, What};
use crate::support::{self, Place, dxf, runs, shown};
use insta::assert_snapshot;
use rayon::prelude::*;

/// A library of two components, a project that embeds both, a drawing of two paths, and one with a Z-probe.
const LIBRARY: &str = r#"
== pathbuild.toml ==
library = ["components", "projects"]
search = ["components"]
feed = 150
rapid = 1000
sweep-height = 20
[emit]
targets = ["8*"]
== components/1234.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 40,0
end 40,0
== components/1300.dxf ==
layer 1300.1P
start 0,20 "T5 O2 I1 B4 MPlate"
mill 0,20 40,20
end 40,20
layer 1300.2P
start 0,50 "T5 O2 I1 B4 MPlate"
mill 0,50 40,50
end 40,50
== projects/8001 a b.dxf ==
layer 8001.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">1234.1P"
subpath 40,0 80,0 ">1300.1P"
end 80,0
== projects/8002.dxf ==
layer 8002.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">1234.1P"
probe 20,20 "LA"
end 40,0
"#;

/// Creates the library with a part of it replaced.
fn library(from: &str, to: &str) -> Place {
    assert!(LIBRARY.contains(from), "{from}");
    Place::of(&LIBRARY.replace(from, to))
}

/// Returns the drawing 1234.dxf of the library with another B.
fn changed_component() -> Vec<u8> {
    let changed = library("1234.1P\nstart 0,0 \"T5 O2 I1 B4", "1234.1P\nstart 0,0 \"T5 O2 I1 B3");
    fs::read(changed.path().join("components/1234.dxf")).unwrap()
}

/// Returns the names and contents of all files in a place, except for the cache.
fn files(place: &Place) -> Vec<(String, Vec<u8>)> {
    let mut files = Vec::new();
    let mut open = vec![place.path().to_owned()];
    while let Some(directory) = open.pop() {
        for entry in fs::read_dir(directory).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.extend((!path.ends_with(".pathbuild")).then_some(path));
            } else {
                let name = shown(path.strip_prefix(place.path()).unwrap());
                files.push((name, fs::read(&path).unwrap()));
            }
        }
    }
    files.sort();
    files
}

/// Returns the names of all files except drawings and configurations.
fn written(place: &Place) -> Vec<String> {
    let is_source = |name: &String| has_extension(name, "dxf") || has_extension(name, "toml");
    files(place).into_iter().map(|(name, _)| name).filter(|name| !is_source(name)).collect()
}

fn has_extension(name: &str, extension: &str) -> bool {
    Path::new(name).extension().is_some_and(|found| found.eq_ignore_ascii_case(extension))
}

fn provenance(place: &Place, name: &str) -> String {
    place.read(name).lines().nth(1).unwrap().to_owned()
}

#[test]
fn files_are_written_once() {
    let place = Place::of(LIBRARY);
    assert_snapshot!(runs(
        &place,
        ["emit 1234.1P", "emit 1234.1P", "emit 1234.1P --lang de", "emit 1300.2P 1234.1P -q"]
    ));
    let expected = ["components/1234_Milling.gcode", "components/1300.2P_Milling.gcode"];
    assert_eq!(written(&place), expected);
    assert_snapshot!(place.read(expected[0]));
}

/// A setup sheet contains the provenance of a program, which does not depend on where the program was written.
#[test]
fn provenance_is_that_of_moves_and_options() {
    const PROGRAM: &str = "projects/8001 a b_Milling.gcode";
    let of = |place: &Place, options: &str| {
        let run = place.run(&format!("emit 8001.1P {options}"));
        assert_eq!(run.status, Some(0), "{run}");
        provenance(place, PROGRAM)
    };
    let place = Place::of(LIBRARY);
    let first = of(&place, "");
    assert!(first.starts_with(concat!("(pathbuild ", env!("CARGO_PKG_VERSION"), " ")), "{first}");
    assert!(first.ends_with(" native O2 T5)"), "{first}");
    let moved = Place::of(&LIBRARY.replace("components", "parts").replace("projects/", "x/../projects/"));
    assert_eq!(of(&moved, "-j 1"), first);
    // Drawings that are not embedded, and edits and options without an effect on moves, do not change the provenance.
    assert_eq!(of(&library("probe 20,20", "probe 20,30"), ""), first);
    assert_eq!(of(&library("mill 0,0 40,0", "mill 0,0 40,0 \"F150\""), ""), first);
    assert_eq!(of(&place, "--probe-feed 7"), first);
    let [program, options] = [0, 1].map(|part| first.split('-').nth(part).unwrap().to_owned());
    let changed = of(&library("mill 0,0 40,0", "mill 0,0 40,0 \"F151\""), "");
    assert!(!changed.starts_with(&program) && changed.ends_with(&options), "{first} {changed}");
    let moved = of(&library("B4 MPlate\"\nmill 0,0", "B3.999 MPlate\"\nmill 0,0"), "");
    assert!(!moved.starts_with(&program) && moved.ends_with(&options), "{first} {moved}");
    let faster = of(&place, "--rapid 1200");
    assert!(faster.starts_with(&program) && !faster.ends_with(&options), "{first} {faster}");
}

/// A CAD program may save an unchanged drawing with other bytes, and a newer pathbuild keeps programs that an older one wrote.
#[test]
fn a_program_stays_current_when_only_its_drawing_s_bytes_or_the_version_change() {
    let place = Place::of(LIBRARY);
    assert_eq!(place.run("emit 1234.1P").status, Some(0));
    let saved = place.read("components/1234.dxf").replace("  0\nSECTION", "999\nsaved again\n  0\nSECTION");
    let place = place.file("components/1234.dxf", saved);
    let run = place.run("emit 1234.1P --check");
    assert!(run.status == Some(0) && run.stderr.contains("1 current, 0 not current"), "{run}");
    let version = concat!("pathbuild ", env!("CARGO_PKG_VERSION"), " ");
    let older = place.read("components/1234_Milling.gcode").replace(version, "pathbuild 0.0.9-beta ");
    let place = place.file("components/1234_Milling.gcode", older.clone());
    for command in ["emit 1234.1P --check", "emit 1234.1P --check", "emit . --check"] {
        let run = place.run(command);
        assert!(!run.stdout.contains("1234_Milling.gcode") && run.stderr.contains("1 current"), "{run}");
    }
    let run = place.run("emit 1234.1P");
    assert!(run.stderr.contains("1234_Milling.gcode: unchanged"), "{run}");
    assert_eq!(place.read("components/1234_Milling.gcode"), older);
    // An unchanged header does not make a changed body current.
    let place = place.file("components/1234_Milling.gcode", older.replace("X40.000", "X40.001"));
    assert_eq!(place.run("emit 1234.1P --check").status, Some(1));
    assert_eq!(place.run("emit 1234.1P").status, Some(0));
    assert!(place.read("components/1234_Milling.gcode").contains(version));
}

#[test]
fn without_arguments_the_configured_targets_are_written() {
    let place = Place::of(LIBRARY);
    assert_snapshot!(place.run("emit"));
    let names: Vec<String> = written(&place);
    assert_eq!(
        names,
        [
            "projects/8001 a b_Milling.gcode",
            "projects/8002_Clean.gcode",
            "projects/8002_Probing.gcode",
            "projects/8002_Z.txt"
        ]
    );
}

#[test]
fn a_target_that_nothing_matches_is_a_mistake() {
    let place = library("targets = [\"8*\"]", "targets = [\"8001.1?\", \"9*\"]");
    assert_snapshot!(runs(&place, ["emit", "emit --lang de"]));
    assert_eq!(written(&place), ["projects/8001 a b_Milling.gcode"]);
}

#[test]
fn without_targets_or_arguments_there_is_nothing_to_emit() {
    assert_snapshot!(library("targets = [\"8*\"]", "targets = []").run("emit"));
}

#[test]
fn a_drawing_that_cannot_be_read_may_hold_a_target() {
    let place = Place::of(LIBRARY).file("components/7.dxf", "nothing");
    let run = place.run("emit");
    assert_eq!(run.status, Some(1), "{run}");
    assert!(run.stderr.contains("PB002"), "{run}");
    assert_eq!(written(&place).len(), 4);
}

#[test]
fn check_says_of_each_file_whether_it_is_current_and_writes_nothing() {
    let place = Place::of(LIBRARY);
    place.run("emit 8002.1P");
    let before = files(&place);
    assert_snapshot!("nothing of 8001 is written yet", place.run("emit --check"));
    assert_eq!(files(&place), before);
    place.run("emit");
    let place = place.file("projects/8001 a b_Milling.gcode", "M30\n");
    assert_snapshot!(
        "another file is in its place",
        runs(&place, ["emit --check 8001.1P", "emit --check --lang de"])
    );
    place.run("emit");
    assert_eq!(place.run("emit --check").status, Some(0));
    assert_eq!(place.run("emit --check --rapid 2000").status, Some(1));
}

/// Measured values are the user's: they never make a file outdated.
#[test]
fn measured_values_are_current() {
    let place = Place::of(LIBRARY);
    place.run("emit 8002.1P");
    let values = place.read("projects/8002_Z.txt");
    let place = place.file("projects/8002_Z.txt", values.replace("=\n", "=5.125\r\n"));
    assert_eq!(place.run("emit --check 8002.1P").status, Some(0));
    for option in ["", " --no-cache"] {
        assert_eq!(place.run(&format!("emit 8002.1P{option}")).status, Some(0));
        assert!(place.read("projects/8002_Z.txt").contains("=5.125"));
    }
}

#[test]
fn measured_values_of_other_probes_are_kept_unless_forced() {
    let place = library("probe 20,20", "probe 21,20");
    place.run("emit 8002.1P");
    let nothing_measured = place.read("projects/8002_Z.txt");
    let values = nothing_measured.replace("=\n", "=5.125\n");
    let place = Place::of(LIBRARY).file("projects/8002_Z.txt", &values);
    assert_snapshot!(place.run("emit 8002.1P"));
    assert_eq!(written(&place), ["projects/8002_Z.txt"], "nothing of that path is written");
    // A comparison gives the same advice, also from the cache.
    let values_compared = |place: &Place| {
        let run = place.run("emit 8002.1P --check --format concise");
        ["PB605", "PB528"].map(|code| run.stderr.contains(&format!("8002_Z.txt: error[{code}]")))
    };
    for _ in 0..2 {
        assert_eq!(values_compared(&place), [true, false]);
    }
    assert_eq!(place.read("projects/8002_Z.txt"), values);
    assert_eq!(place.run("emit 8002.1P --force").status, Some(0));
    assert!(!place.read("projects/8002_Z.txt").contains("5.125"));
    assert_eq!(values_compared(&place), [false, false]);
    // If nothing was measured, no values are lost.
    let place = Place::of(LIBRARY).file("projects/8002_Z.txt", &nothing_measured);
    assert_eq!(values_compared(&place), [false, true]);
    assert_eq!(place.run("emit 8002.1P").status, Some(0));
    assert_ne!(place.read("projects/8002_Z.txt"), nothing_measured);
}

/// G-code of the original program has other comments, headers and line ends. (issue 4)
#[test]
fn moves_are_compared_with_a_program_whoever_wrote_it() {
    let place = Place::of(LIBRARY);
    place.run("emit 1234.1P");
    let ours = place.read("components/1234_Milling.gcode");
    let foreign = ours
        .lines()
        .filter(|line| !line.starts_with("(pathbuild") && !line.starts_with("T1"))
        .map(|line| format!("{}  (as drawn)\r\n", line.replace("X40.000", "X40.001")))
        .collect::<Vec<_>>()
        .concat();
    let place = place.file("components/1234_Milling.gcode", &foreign);
    assert_eq!(place.run("emit --check 1234.1P").status, Some(1));
    let lines = ["emit --check --moves 1234.1P", "emit --check --moves 1234.1P --feed 151"];
    assert_snapshot!("one unit of the last digit is nothing", runs(&place, lines));
    let far = foreign.replace("X40.001", "X40.002");
    let place = place.file("components/1234_Milling.gcode", far);
    assert_snapshot!("two are another place", place.run("emit --check --moves 1234.1P"));
    let broken = foreign.replace("G01 F", "G01 F F");
    let place = place.file("components/1234_Milling.gcode", broken);
    assert_snapshot!(
        "what cannot be read is not current",
        place.run("emit --check --moves 1234.1P --lang de")
    );
}

/// Returns the program of 1234.1P, and a function that returns the exit status of comparing its moves with those of another text.
fn comparison_of_moves() -> (String, impl Fn(String) -> Option<i32>) {
    let place = Place::of(LIBRARY);
    assert_eq!(place.run("emit 1234.1P").status, Some(0));
    let name = "components/1234_Milling.gcode";
    let ours = place.read(name);
    let written = ours.clone();
    let compare = move |text: String| {
        assert_ne!(text, written);
        fs::write(place.path().join(name), text).unwrap();
        place.run("emit --check --moves 1234.1P").status
    };
    (ours, compare)
}

/// Words that set units, distances, plane, offsets, tool length or feed mode belong to the moves, even where all positions are as before.
#[test]
fn a_program_whose_modes_differ_has_other_moves() {
    let (ours, is_current) = comparison_of_moves();
    let heads = [
        ("G21", "G20"),
        ("G90", "G91"),
        ("G94", "G93"),
        ("G40", "G41"),
        ("G54", "G55"),
        ("G17", "G18"),
        (" G54", ""),
        ("G01 ", "/G01 "),
    ];
    for (from, to) in heads {
        assert_eq!(is_current(ours.replacen(from, to, 1)), Some(1), "{from} {to}");
    }
    for line in ["G91", "M2", "G28", "T2 M6", "G51 P2", "G43.1 Z5", "G10 L2 P1 Z1", "G92 Z0", "G55", "M98 P5"]
    {
        assert_eq!(is_current(ours.replacen("G01 ", &format!("{line}\nG01 "), 1)), Some(1), "{line}");
    }
    for line in ["G90", "G21", "(a comment)", "S9000"] {
        assert_eq!(is_current(ours.replacen("G01 ", &format!("{line}\nG01 "), 1)), Some(0), "{line}");
    }
}

/// The way to the first cut counts from the first move, as do lines that say nothing of a position.
#[test]
fn a_program_that_begins_otherwise_has_other_moves() {
    let (ours, is_current) = comparison_of_moves();
    let lines = [
        "G92 Z5",
        "G92 Z0",
        "G10 L2 P1 Z-5",
        "G10 L20 P1 Z0",
        "G00 Z-20",
        "G00 Z0",
        "G01 Z-1 F100",
        "G00 X50",
        "G00 X50 Y50",
        "G38.2 Z-5 F10",
        "%",
        "#1=5",
        "O100",
    ];
    for line in lines {
        assert_eq!(is_current(ours.replacen("G00 ", &format!("{line}\nG00 "), 1)), Some(1), "{line}");
    }
    for line in ["%", "#1=5", "M30"] {
        assert_eq!(is_current(ours.replacen("G01 ", &format!("{line}\nG01 "), 1)), Some(1), "{line}");
    }
    let lines: Vec<&str> = ours.lines().collect();
    let first = lines.iter().position(|line| line.starts_with("G00 ")).unwrap();
    let without_retract = [&lines[..first], &lines[first + 1..]].concat().join("\n");
    assert_eq!(is_current(without_retract), Some(1));
}

#[test]
fn comparing_moves_needs_no_rapid_feed() {
    let place = library("rapid = 1000", "");
    assert_snapshot!(runs(&place, ["emit 1234.1P", "emit --check 1234.1P", "emit --check --moves 1234.1P"]));
}

/// The library contains the G-code that the original program made of it: all of it is current, and nothing is written.
#[test]
fn gcode_of_the_original_tool_is_current() {
    let cases = support::project().join("fixtures/conformance/cases");
    let runs = recorded::runs(&[cases]);
    let emitting: Vec<&Run> =
        runs.iter().filter(|run| run.form == Form::Recorded && !expected_files(run).is_empty()).collect();
    assert!(emitting.len() > 200, "{} runs", emitting.len());
    let faults: Vec<String> = emitting.par_iter().filter_map(|run| fault(run)).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// A drawing with G-code of the original program is edited: the comparison reports the line at which the program begins to differ.
#[test]
fn a_changed_drawing_is_not_current() {
    let cases = support::project().join("fixtures/conformance/cases");
    let runs = recorded::runs(&[cases]);
    let run = runs.iter().find(|run| run.case.ends_with("line") && run.number == 0).unwrap();
    let What::Compile(arguments) = &run.what else { panic!("{run} compiles nothing") };
    let place = with_expected_files(run);
    assert_eq!(check_moves(&place, arguments).status, Some(0));
    let drawing = place.read("1234.1P.dxf");
    assert!(drawing.contains(" B-0,2 "));
    let place = place.file("1234.1P.dxf", drawing.replace(" B-0,2 ", " B-0,25 "));
    assert_snapshot!(check_moves(&place, arguments));
}

/// Without `--compatible`, a program that the original tool wrote has different moves. A note names the missing option, but only if nothing else
/// differs.
#[test]
fn a_program_as_the_original_tool_writes_it_is_named_so() {
    let cases = support::project().join("fixtures/conformance/cases");
    let runs = recorded::runs(&[cases]);
    let is_meant = |run: &&Run| run.case.ends_with("support_line_two") && run.number == 0;
    let run = runs.iter().find(is_meant).unwrap();
    let What::Compile(arguments) = &run.what else { panic!("{run} compiles nothing") };
    let place = with_expected_files(run);
    let arguments: Vec<&str> = arguments[1..].iter().map(String::as_str).collect();
    let check = |place: &Place| place.run_with(&[&["emit", "--check", "--moves"], &*arguments].concat());
    assert_snapshot!(check(&place));
    let program = place.read("1234.1P_Milling.gcode");
    let place = place.file("1234.1P_Milling.gcode", program.replacen("Y0.000 Z", "Y1.000 Z", 1));
    let changed = check(&place);
    assert!(changed.status == Some(1) && !changed.stderr.contains("--compatible"), "{changed}");
}

/// Returns the files that the original program wrote in a successful run.
fn expected_files(run: &Run) -> Vec<(String, Vec<u8>)> {
    let folder = run.case.join("expected").join(run.number.to_string());
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let named =
        files.map(|path| (path.file_name().unwrap().to_str().unwrap().to_owned(), fs::read(&path).unwrap()));
    named.filter(|(name, _)| has_extension(name, "gcode")).collect()
}

/// Returns the problem with comparing the outputs of a run with the files of the original program.
fn fault(run: &Run) -> Option<String> {
    let What::Compile(arguments) = &run.what else { return None };
    let place = with_expected_files(run);
    let before = files(&place);
    let checked = check_moves(&place, arguments);
    let is_right = checked.status == Some(0) && files(&place) == before;
    (!is_right).then(|| format!("{run} is not current, or was changed:\n{checked}"))
}

fn check_moves(place: &Place, arguments: &[String]) -> support::Run {
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    place.run_with(&[&["emit", "--check", "--moves", "--compatible"], &arguments[1..]].concat())
}

/// Creates a place with the drawings of a case and the files that the original program wrote.
fn with_expected_files(run: &Run) -> Place {
    let sources = fs::read_dir(&run.case).unwrap().map(|entry| entry.unwrap().path());
    let mut place = Place::new();
    for source in sources.filter(|path| path.file_name().is_some_and(|name| name != "expected")) {
        place = with_source(place, &source, "");
    }
    for (name, content) in expected_files(run) {
        place = place.file(&name, content);
    }
    place
}

fn with_source(mut place: Place, source: &Path, below: &str) -> Place {
    let name = format!("{below}{}", source.file_name().unwrap().to_str().unwrap());
    if !source.is_dir() {
        return place.file(&name, fs::read(source).unwrap());
    }
    for entry in fs::read_dir(source).unwrap() {
        place = with_source(place, &entry.unwrap().path(), &format!("{name}/"));
    }
    place
}

#[test]
fn a_program_is_printed() {
    let place = Place::of(LIBRARY);
    let run = place.run("emit 1234.1P -o -");
    assert_eq!(written(&place), Vec::<String>::new());
    assert_eq!((run.status, run.stderr.as_str()), (Some(0), ""));
    place.run("emit 1234.1P");
    assert_eq!(run.stdout, place.read("components/1234_Milling.gcode"));
}

#[test]
fn only_one_program_is_printed() {
    let lines =
        ["emit 1234.1P 1300.1P -o -", "emit 8002.1P -o -", "emit 1234.1P -o - --check", "emit 1234.1P -o x"];
    assert_snapshot!(runs(&Place::of(LIBRARY), lines));
}

#[test]
fn deps_are_rules_for_make() {
    let place = Place::of(LIBRARY);
    let run = place.run("emit --deps out.d --out-dir g$#");
    assert_eq!(run.status, Some(0), "{run}");
    assert_snapshot!(place.read("out.d"));
}

/// The drawing was searched because its name admits an embedded path; an edit may add a second definition of that path to it.
#[test]
fn deps_have_drawings_that_were_searched_in_vain() {
    let other = LIBRARY.split("== components/1300.dxf ==").nth(1).unwrap().split("== ").next().unwrap();
    let other = other.replace("1300.", "1299.");
    let place = Place::of(&format!("{LIBRARY}== components/1200-1299.dxf =={other}"));
    let run = place.run("emit 8001.1P --deps out.d");
    assert_eq!(run.status, Some(0), "{run}");
    assert_snapshot!(place.read("out.d"));
}

#[test]
fn deps_are_told_without_writing_programs() {
    let place = Place::of(LIBRARY);
    place.run("emit --deps written.d --out-dir g");
    let run = place.run("emit --check --deps out.d --out-dir other");
    assert_eq!(run.status, Some(1), "{run}");
    assert!(!place.path().join("other").exists());
    assert_eq!(place.read("out.d"), place.read("written.d").replace("g/", "other/"));
}

/// Without its rule, make would take the program of a path that had errors once for up to date.
#[test]
fn deps_stay_as_they_were_if_a_path_has_errors() {
    let place = || Place::of(LIBRARY).file("out.d", "of before");
    let faulty = Place::of(&LIBRARY.replacen("O2", "Ox2", 1)).file("out.d", "of before");
    let unreadable = place().file("components/1300.dxf", "no drawing");
    for (place, arguments, status) in [(place(), "8001.1P", 0), (faulty, "8001.1P", 1), (unreadable, ".", 1)]
    {
        let run = place.run(&format!("emit {arguments} --deps out.d"));
        assert_eq!((run.status, place.read("out.d") == "of before"), (Some(status), status == 1), "{run}");
    }
}

#[test]
fn deps_that_cannot_be_written_are_an_error() {
    assert_snapshot!(Place::of(LIBRARY).run("emit 1234.1P -q --deps components"));
}

#[test]
fn two_outputs_of_one_name_are_both_refused() {
    let both = Place::of(LIBRARY).run("emit 1300.1P 1300.2P --out-dir all");
    assert_eq!(both.status, Some(0), "outputs of a drawing of several paths have the paths' names: {both}");
    let same = Place::of(
        &LIBRARY
            .replace(
                "T5 O2 MPlate\"\nsubpath 0,0 40,0 \">1234.1P\"\nprobe 20,20 \"LA\"",
                "T5 O2 MPlate R_x\"\nsubpath 0,0 40,0 \">1234.1P\"",
            )
            .replace("8001 a b", "8002_x")
            .replace("8001.1P", "8003.1P"),
    );
    assert_snapshot!(same.run("emit --out-dir all"));
}

/// If file names ignore case, as on Windows, two files with names that differ only in case cannot exist.
#[cfg(not(windows))]
#[test]
fn outputs_whose_names_differ_in_case_are_both_refused() {
    let same = Place::of(
        &LIBRARY
            .replace("8001 a b.dxf", "8002.DXF")
            .replace("8001.1P", "8002.2P")
            .replace("\nprobe 20,20 \"LA\"", ""),
    );
    assert_snapshot!("of drawings whose names differ in case", same.run("emit"));
    assert_eq!(written(&same), Vec::<String>::new());
}

#[test]
fn what_nothing_writes_any_more_is_stale() {
    let place = Place::of(LIBRARY)
        .file("projects/other.gcode", "%\n(other)\n(Path 8001.1P, drawing 8001 a b.dxf)\nM30\n");
    place.run("emit");
    fs::rename(place.path().join("projects/8001 a b.dxf"), place.path().join("projects/8001.dxf")).unwrap();
    let listed = ["emit -q", "emit --check --lang de", "emit projects -q", "emit 8001.1P -q"];
    assert_snapshot!(runs(&place, listed));
    let before: BTreeSet<String> = written(&place).into_iter().collect();
    assert_snapshot!("removed only when asked", place.run("emit --remove-stale"));
    let after: BTreeSet<String> = written(&place).into_iter().collect();
    let gone: Vec<&String> = before.difference(&after).collect();
    assert_eq!(gone, ["projects/8001 a b_Milling.gcode"]);
}

#[test]
fn copies_of_programs_are_never_removed() {
    let place = Place::of(LIBRARY);
    place.run("emit");
    let text = place.read("projects/8001 a b_Milling.gcode");
    let copies = [
        "old.gcode",
        "8001 a b_Milling (copy).gcode",
        "8001 a b_old_Milling.gcode",
        "Copy of 8001 a b_Milling.gcode",
    ];
    let place = copies
        .iter()
        .fold(place, |place, name| place.file(&format!("projects/{name}"), text.replace("F150", "F120")));
    // Test while the drawing is there, and after it was removed.
    for is_there in [true, false] {
        if !is_there {
            fs::remove_file(place.path().join("projects/8001 a b.dxf")).unwrap();
        }
        let run = place.run("emit --remove-stale --format concise");
        for name in copies {
            assert!(run.stderr.contains(&format!("{name}: warning[PB520]")), "{name}: {run}");
            assert!(place.path().join("projects").join(name).exists(), "{name}: {run}");
        }
        assert_eq!(place.path().join("projects/8001 a b_Milling.gcode").exists(), is_there, "{run}");
    }
    // The program has the name of its path, as programs of drawings with several paths do.
    let place = place.file("projects/8001.1P_Milling.gcode", text);
    let run = place.run("emit --remove-stale");
    assert!(run.stderr.contains("8001.1P_Milling.gcode: stale, removed"), "{run}");
}

/// An operator who is told that a copy is outdated may throw the good program away.
#[test]
fn a_copy_of_the_current_program_is_not_called_outdated() {
    let place = Place::of(LIBRARY);
    place.run("emit");
    let text = place.read("projects/8001 a b_Milling.gcode");
    let place = place
        .file("projects/copy.gcode", &*text)
        .file("projects/edited.gcode", text.replace("F150", "F120"))
        .file("projects/8001 a b_old_Milling.gcode", &*text);
    let run = place.run("emit --check --format concise");
    assert_eq!(run.status, Some(1), "{run}");
    for name in ["copy.gcode", "8001 a b_old_Milling.gcode"] {
        let told = format!("{name}: error[PB520] {name} contains the current program of path 8001.1P");
        assert!(run.stderr.contains(&told), "{run}");
    }
    assert!(run.stderr.contains("edited.gcode: error[PB520] edited.gcode contains an outdated"), "{run}");
}

/// The operator finds the program in the directory of the current ones.
#[test]
fn the_old_program_of_a_path_that_is_no_target_is_named() {
    let place = Place::of(LIBRARY);
    assert_eq!(place.run("emit 1234.1P --out-dir all").status, Some(0));
    let findings = |place: &Place, command: &str| {
        let run = place.run(&format!("emit --out-dir all {command} --format concise"));
        assert!(place.path().join("all/1234_Milling.gcode").exists(), "{run}");
        let told = "1234_Milling.gcode: warning[PB520] 1234_Milling.gcode is out of date: path 1234.1P";
        (run.stderr.matches(told).count(), run.stderr.matches("1234_Milling").count())
    };
    for command in ["", "--check"] {
        assert_eq!(findings(&place, command), (0, 0), "{command}");
    }
    let drawing = fs::read_to_string(place.path().join("components/1234.dxf")).unwrap();
    let place = place.file("components/1234.dxf", drawing.replace("I1 B4", "I1 B3"));
    for command in ["", "--check", "--remove-stale"] {
        assert_eq!(findings(&place, command), (1, 2), "{command}");
    }
    // So is that of a path with errors.
    let place = place.file("components/1234.dxf", drawing.replace("I1 B4", "B4"));
    for command in ["", "--check", "--remove-stale"] {
        let run = place.run(&format!("emit --out-dir all {command} --format concise"));
        let told =
            "1234_Milling.gcode: warning[PB520] 1234_Milling.gcode was written earlier, but its path 1234.1P";
        assert_eq!(run.stderr.matches(told).count(), 1, "{command}: {run}");
        assert!(place.path().join("all/1234_Milling.gcode").exists(), "{run}");
    }
    let place = place.file("components/1234.dxf", drawing);
    assert_eq!(place.run("emit 1234.1P --out-dir all").status, Some(0));
    assert_eq!(findings(&place, "--check"), (0, 0));
    // A missing option is no error: it was given when the program was written.
    let place = Place::of(&LIBRARY.replace("sweep-height = 20\n", "").replace("O2 MPlate", "O2 S20 MPlate"));
    assert_eq!(place.run("emit 1234.1P --out-dir all --sweep-height 20").status, Some(0));
    assert_eq!(findings(&place, ""), (0, 0));
}

/// A drawing in a search directory is found by its name, so its program is not stale although the drawing is not in the library.
#[test]
fn programs_of_drawings_that_the_search_finds_are_not_stale() {
    let emitted = |search: &str| {
        let place = Place::of(LIBRARY);
        assert_eq!(place.run("emit 1234.1P --out-dir all").status, Some(0));
        let smaller = LIBRARY.lines().find(|line| line.starts_with("library")).unwrap();
        let text = place.read("pathbuild.toml").replace(smaller, "library = [\"projects\"]");
        let place = place.file("pathbuild.toml", text.replace("search = [\"components\"]", search));
        let run = place.run("emit --out-dir all --remove-stale");
        (place.path().join("all/1234_Milling.gcode").exists(), run)
    };
    let (is_there, run) = emitted("search = [\"components\"]");
    assert!(is_there && !run.stderr.contains("PB520"), "{run}");
    let (is_there, run) = emitted("");
    assert!(!is_there, "{run}");
}

/// A file is not stale if a path or a command may write it again.
#[test]
fn what_may_be_written_again_is_not_stale() {
    let place = Place::of(LIBRARY);
    place.run("emit");
    // The files belong to a path that has errors at the moment, a path that is not a target, `adjust`, and an ignored drawing.
    place.run("emit 1234.1P");
    let values = place.read("projects/8002_Z.txt").replace("=\n", "=5.125\n");
    let place = place.file("projects/8002_Z.txt", values);
    assert_eq!(place.run("adjust projects/8002.dxf --max-correction 0.9").status, Some(0));
    let ignored = place.read("projects/8001 a b_Milling.gcode").replace("8001 a b.dxf", "8009.dxf");
    let broken =
        Place::of("== 8001 a b.dxf ==\nlayer 8001.1P\nstart 0,0 \"T5 O2\"\nmill 0,0 40,0\nend 40,0\n");
    let place = place
        .file("projects/8009_Milling.gcode", ignored)
        .file("projects/8009.dxf", "nothing")
        .file("projects/.ignore", "8009.dxf\n")
        .file("projects/8001 a b.dxf", fs::read(broken.path().join("8001 a b.dxf")).unwrap());
    let run = place.run("emit --remove-stale");
    assert_eq!(run.status, Some(1), "{run}");
    assert!(!run.stderr.contains("stale, removed"), "{run}");
    assert_eq!(run.stderr.matches("PB520").count(), 1, "{run}");
    assert!(run.stderr.contains("8009.dxf, which is ignored"), "{run}");
}

/// A drawing that an ignore file excludes still exists, but not one in an ignored directory.
#[test]
fn programs_of_ignored_drawings_are_reported_and_kept() {
    for (rule, is_kept) in [("8001*", true), ("old", false)] {
        let place = Place::of(LIBRARY);
        assert_eq!(place.run("emit --out-dir all").status, Some(0));
        let drawing = place.path().join("projects/8001 a b.dxf");
        if !is_kept {
            fs::create_dir(place.path().join("projects/old")).unwrap();
            fs::rename(&drawing, place.path().join("projects/old/8001 a b.dxf")).unwrap();
        }
        let place = place.file("projects/.ignore", rule);
        let run = place.run("emit --out-dir all --remove-stale");
        assert_eq!(place.path().join("all/8001 a b_Milling.gcode").exists(), is_kept, "{run}");
        assert_eq!(run.stderr.contains("stale, removed"), !is_kept, "{run}");
        assert_eq!(run.stderr.contains("8001 a b.dxf, which is ignored"), is_kept, "{run}");
    }
    // It may have been emitted by its name, so it is no error in a comparison.
    let place = Place::of(LIBRARY).file("projects/.ignore", "8001*");
    assert_eq!(place.run("emit").status, Some(0));
    assert_eq!(place.run("emit 8001.1P").status, Some(0));
    for (arguments, count) in [("", 1), ("projects ", 1), ("components ", 0), ("8002.1P ", 0)] {
        let run = place.run(&format!("emit {arguments}--check --format concise"));
        assert_eq!(run.stderr.matches("8001 a b_Milling.gcode: warning[PB520]").count(), count, "{run}");
    }
    // Another library that shares the output directory may have a drawing of the same name.
    let place = Place::of(LIBRARY).file("projects/.ignore", "8001*").file("lib/none", "");
    place.run("emit 8001.1P --out-dir ../all");
    let run = place.run("emit --out-dir ../all --check");
    assert!(!run.stderr.contains("PB520"), "{run}");
}

/// Programs that were written beside their drawings remain there if `out-dir` is configured later.
#[test]
fn programs_beside_drawings_are_stale_if_an_output_directory_is_configured() {
    let place = Place::of(LIBRARY);
    assert_eq!(place.run("emit").status, Some(0));
    let other = place.read("projects/8001 a b_Milling.gcode").replace("8001 a b.dxf", "8009.dxf");
    let configuration = place.read("pathbuild.toml");
    let place = place.file("projects/8009_Milling.gcode", other);
    // An output directory on the command line is for one run only.
    let once = place.run("emit --out-dir gcode");
    assert!(!once.stderr.contains("PB520"), "{once}");
    let place = place.file("pathbuild.toml", format!("out-dir = \"gcode\"\n{configuration}"));
    assert_snapshot!(runs(
        &place,
        ["emit --check -q", "emit 8001.1P --check --lang de", "emit 8002.1P --check --format concise"]
    ));
    let before: BTreeSet<String> = written(&place).into_iter().collect();
    // A program without a successor stays.
    fs::remove_file(place.path().join("gcode/8002_Clean.gcode")).unwrap();
    let broken = place.file("projects/8002.dxf", "cut off");
    let run = broken.run("emit --remove-stale");
    assert!(run.stderr.contains("8001 a b_Milling.gcode: stale, removed"), "{run}");
    let after: BTreeSet<String> = written(&broken).into_iter().collect();
    let gone: Vec<&String> = before.difference(&after).collect();
    assert_eq!(
        gone,
        ["gcode/8002_Clean.gcode", "projects/8001 a b_Milling.gcode", "projects/8002_Probing.gcode"]
    );
}

/// A drawing takes its directory's program along only if the user moves that, too.
#[test]
fn the_former_program_of_a_drawing_that_was_moved_is_stale_once_the_path_is_changed() {
    let place = Place::of(LIBRARY);
    assert_eq!(place.run("emit").status, Some(0));
    fs::create_dir(place.path().join("projects/new")).unwrap();
    let [from, to] =
        ["projects/8001 a b.dxf", "projects/new/8001 a b.dxf"].map(|file| place.path().join(file));
    fs::rename(from, to).unwrap();
    let unchanged = place.run("emit");
    assert!(unchanged.status == Some(0) && !unchanged.stderr.contains("PB520"), "{unchanged}");
    let place = place.file("components/1234.dxf", changed_component());
    assert_snapshot!(runs(&place, ["emit -q --format concise --remove-stale", "emit --check -q --lang de"]));
    assert!(place.path().join("projects/8001 a b_Milling.gcode").exists());
    // Beside a drawing of the same name it may be that drawing's program.
    let place = place.file("projects/8001 a b.dxf", "cut off");
    assert!(!place.run("emit --check").stderr.contains("older program"));
}

/// Programs remain in the former output directory if `out-dir` is changed.
#[test]
fn programs_in_a_former_output_directory_are_stale_once_the_path_is_changed() {
    let place = Place::of(LIBRARY);
    let configuration = place.read("pathbuild.toml");
    let unchanged = fs::read(place.path().join("components/1234.dxf")).unwrap();
    for (former, now, reported) in [
        ("nc", Some("gcode"), true),
        ("nc", None, true),
        ("nc", Some("nc"), false),
        ("projects/a/nc", Some("nc"), true),
        // Only the library is searched recursively, and otherwise the directories beside that of the programs and above it.
        ("other/nc", Some("nc"), false),
        ("other/nc", Some("other/gcode"), true),
        ("other/a/nc", Some("other/gcode"), false),
        (".nc", Some("nc"), false),
        ("../nc", Some("nc"), false),
    ] {
        let place = Place::of(LIBRARY).file("components/1234.dxf", &unchanged);
        let with = |directory: Option<&str>| match directory {
            Some(directory) => format!("out-dir = \"{directory}\"\n{configuration}"),
            None => configuration.clone(),
        };
        let place = place.file("pathbuild.toml", with(Some(former)));
        assert_eq!(place.run("emit").status, Some(0));
        let place = place.file("pathbuild.toml", with(now));
        let same = place.run("emit");
        assert!(same.status == Some(0) && !same.stderr.contains("PB520"), "{former} {now:?}: {same}");
        let place = place.file("components/1234.dxf", changed_component());
        let other = place.run("emit --remove-stale");
        assert_eq!(
            other.stderr.contains("is an older program of its path"),
            reported,
            "{former} {now:?}: {other}"
        );
        assert!(place.path().join(former).join("8001 a b_Milling.gcode").exists(), "{former} {now:?}");
        let checked = place.run("emit --check");
        assert_eq!(checked.status, Some(i32::from(reported)), "{former} {now:?}: {checked}");
        let place = place.file(".ignore", "nc/\n");
        assert_eq!(place.run("emit --check").status, Some(0), "{former} {now:?}");
    }
}

/// The output directory and the directory of the drawings may be the same under two names.
#[cfg(unix)]
#[test]
fn programs_in_an_output_directory_with_another_name_are_current() {
    let place = Place::of(LIBRARY);
    std::os::unix::fs::symlink("projects", place.path().join("gcode")).unwrap();
    let configuration = place.read("pathbuild.toml");
    let place = place.file("pathbuild.toml", format!("out-dir = \"gcode\"\n{configuration}"));
    assert_eq!(place.run("emit").status, Some(0));
    for arguments in ["", "8001.1P "] {
        let run = place.run(&format!("emit {arguments}--remove-stale"));
        assert!(!run.stderr.contains("PB520") && !run.stderr.contains("stale"), "{run}");
    }
    assert!(place.path().join("projects/8001 a b_Milling.gcode").exists());
}

/// A drawing of the library with the same name would write the same file in another run.
#[test]
fn programs_of_other_drawings_are_not_overwritten() {
    let drawing =
        |text: &str| format!("layer 8001.1P\nstart 0,0 \"T5 O2 I1 B4 {text}\"\nmill 0,0 40,0\nend 40,0\n");
    let place = |other: &str| {
        let configuration =
            "library = [\"a\", \"b\"]\nfeed = 150\nrapid = 1000\nsweep-height = 20\nout-dir = \"out\"\n";
        Place::of(&format!("== a/8001.dxf ==\n{}== b/8001.dxf ==\n{other}", drawing("")))
            .file("pathbuild.toml", configuration)
            .file("other/none", "")
    };
    for arguments in ["a", "a/8001.dxf", "a/8001.dxf --check", "a/8001.dxf --no-cache"] {
        let run = place(&drawing("")).run(&format!("emit {arguments} --format concise"));
        let expected = "a/8001.dxf: error[PB514] 8001_Milling.gcode would be written by 8001.1P (a/8001.dxf) and by 8001.1P (b/8001.dxf)";
        assert!(run.status == Some(1) && run.stderr.contains(expected), "{run}");
        assert_eq!(run.stderr.matches("PB514").count(), 1, "{run}");
    }
    let both = place(&drawing("")).run("emit a b --format concise");
    assert_eq!(both.stderr.matches("PB514").count(), 1, "{both}");
    // Another file, another output directory, no file, a drawing with errors.
    let is_written = |other: &str, arguments: &str| {
        let run = place(other).run(&format!("emit a/8001.dxf {arguments}"));
        assert_eq!(run.status, Some(0), "{run}");
    };
    is_written(&drawing("R_b"), "");
    is_written(&drawing(""), "--out-dir other");
    is_written(&drawing(""), "-o -");
    is_written(&drawing("X"), "");
    // The same drawing may have two names.
    #[cfg(unix)]
    {
        let place = place(&drawing(""));
        fs::remove_file(place.path().join("b/8001.dxf")).unwrap();
        std::os::unix::fs::symlink("../a/8001.dxf", place.path().join("b/8001.dxf")).unwrap();
        assert_eq!(place.run("emit a/8001.dxf").status, Some(0));
    }
}

/// A drawing that cannot be read at the moment may still contain the paths of its programs.
#[test]
fn programs_of_a_drawing_that_cannot_be_read_are_not_stale() {
    for arguments in ["", "projects ", "--out-dir all ", "projects --out-dir all "] {
        let place = Place::of(LIBRARY);
        assert_eq!(place.run(&format!("emit {arguments}")).status, Some(0));
        let before: BTreeSet<String> = written(&place).into_iter().collect();
        let place = place.file("projects/8001 a b.dxf", "cut off");
        let run = place.run(&format!("emit {arguments}--remove-stale"));
        assert!(run.status == Some(1) && !run.stderr.contains("stale"), "{run}");
        assert_eq!(written(&place).into_iter().collect::<BTreeSet<String>>(), before, "{run}");
    }
}

#[test]
fn outputs_of_a_path_that_changed_its_name_are_stale() {
    let place = Place::of(LIBRARY);
    place.run("emit --out-dir all");
    let changed = library(
        "start 0,0 \"T5 O2 MPlate\"\nsubpath 0,0 40,0 \">1234.1P\"\nsubpath",
        "start 0,0 \"T5 O2 MPlate R_b\"\nsubpath 0,0 40,0 \">1234.1P\"\nsubpath",
    );
    let drawing = fs::read(changed.path().join("projects/8001 a b.dxf")).unwrap();
    let place = place.file("projects/8001 a b.dxf", drawing);
    assert_snapshot!(runs(
        &place,
        ["emit --out-dir all", "emit projects --out-dir all -q", "emit components --out-dir all -q"]
    ));
}

/// In an output directory that is shared with other drawings, a run knows only the library's own files.
#[test]
fn other_drawings_of_a_shared_output_directory_are_left_alone() {
    let place = library("library = [\"components\", \"projects\"]", "");
    place.run("emit 8001.1P projects/8002.dxf --search components --out-dir all");
    let run = place.run("emit components --out-dir all --remove-stale");
    assert_eq!(run.status, Some(0), "{run}");
    assert!(!run.stderr.contains("stale"), "{run}");
}

#[test]
fn a_missing_subpath_that_the_library_has_says_where() {
    let place = library("search = [\"components\"]", "search = []");
    assert_snapshot!(runs(&place, ["emit 8002.1P", "check projects/8002.dxf --lang de --format concise -q"]));
    let check = place.run_in("projects", &["check", "8002.dxf"]);
    assert!(check.stderr.contains("add components to `search`"), "{check}");
}

/// Ends that are joined are milled through without leaving the groove; larger distances are gaps.
#[test]
fn ends_within_the_tolerance_are_milled_through() {
    let place = |gap: &str| {
        Place::of(&format!(
            "
== pathbuild.toml ==
feed = 150
rapid = 1000
sweep-height = 20
join-tolerance = 0.01
== 1234.1P.dxf ==
layer 1234.1P
start 0,0 \"T5 O3 I5 B0\"
mill 0,0 20,0
mill {gap},0 40,0
end 40,0.01
"
        ))
    };
    let joined = place("20.01");
    assert_snapshot!(joined.run("emit 1234.1P.dxf --format concise"));
    let program = joined.read("1234.1P_Milling.gcode");
    let moves: Vec<&str> =
        program.lines().filter(|line| line.starts_with('G') && line.contains('Z')).collect();
    assert_eq!(
        moves,
        [
            "G00 Z20.000",
            "G00 Z5.000",
            "G01 F150.000 Z0.000",
            "G01 F150.000 X20.000 Y0.000 Z0.000",
            "G01 F150.000 X40.000 Y0.000 Z0.000",
            "G00 Z20.000",
            "G00 Z20.000"
        ]
    );
    assert_snapshot!("farther apart is a gap", place("20.011").run("emit 1234.1P.dxf"));
}

/// The remnant of a trimmed arc is not a full circle. (PB121)
#[test]
fn the_remnant_of_an_arc_is_not_milled_as_a_circle() {
    let drawing = |end: &str| {
        dxf(&format!(
            "layer 1234.1P\nstart 0,0 \"T5 O2 I5 B0 S10 MAl\"\nmill 0,0 20,0\nmill arc 20,0 to 20,{end} centre 30,0\nmill 20,{end} 40,0\nend 40,0"
        ))
    };
    for (end, is_circle) in [("0", true), ("-0.0000001745", false), ("-0.00000001745", false)] {
        let place = Place::new()
            .file("pathbuild.toml", "feed = 150\nrapid = 1000\n")
            .file("1234.1P.dxf", drawing(end));
        let run = place.run("emit 1234.1P --format concise");
        assert_eq!(run.stderr.contains("PB121"), !is_circle, "{run}");
        let program = place.read("1234.1P_Milling.gcode");
        // The end of a full circle is its start.
        let closes = |line: &str| line.starts_with("G03") && line.contains("X20.000 Y0.000");
        assert_eq!(program.lines().any(closes), is_circle, "{end}: {program}");
    }
}

/// A directory on a network drive may be missing for a while.
#[test]
fn nothing_is_stale_while_a_directory_of_the_library_is_missing() {
    let place = Place::of(LIBRARY);
    place.run("emit --out-dir all");
    fs::rename(place.path().join("projects"), place.path().join("away")).unwrap();
    for arguments in ["--out-dir all --remove-stale", "--out-dir all --check"] {
        let run = place.run(&format!("emit {arguments}"));
        assert!(run.stderr.contains("PB003") && !run.stderr.contains("stale"), "{run}");
        assert!(!run.stderr.contains("PB513"), "the paths may lie in the missing directory: {run}");
    }
}

/// Two libraries may write into one directory.
#[test]
fn programs_of_another_library_are_not_removed() {
    let in_directory = |library: &str, directory: &str| {
        let file = |line: &str| line.strip_prefix("== ").map(|name| format!("== {directory}/{name}\n"));
        library.lines().map(|line| file(line).unwrap_or_else(|| format!("{line}\n"))).collect::<String>()
    };
    let other = ["1234", "1300", "8001", "8002"]
        .iter()
        .fold(LIBRARY.to_owned(), |text, name| text.replace(name, &format!("{}7{}", &name[..1], &name[2..])));
    let place = Place::of(&(in_directory(LIBRARY, "one") + &in_directory(&other, "two")));
    place.run_in("one", &["emit", "--out-dir", "../all"]);
    let run = place.run_in("two", &["emit", "--out-dir", "../all", "--remove-stale", "--format", "concise"]);
    assert!(run.stderr.contains("PB520") && !run.stderr.contains("removed"), "{run}");
    let within = place.run_in("two", &["emit", "--out-dir", "all", "--format", "concise"]);
    assert!(!within.stderr.contains("PB520"), "{within}");
}

/// Joined paths are milled from one plate. In the program, the part of 1234.1P lies between (1, 1) and (41, 21), and its upper bars are at X14 and
/// X28.
#[test]
fn joined_paths_cut_into_no_parts_of_each_other() {
    let options = "feed = 150\nrapid = 1000\nsweep-height = 20\npart = 'Part'\nspindle = \"manual\"\n";
    let plate = "layer 1234.1P\nstart -1,-1 \"T2 O2 I2 B0 D0.8 P3 U8\"\nbars -1,-1 41,-1\nbars to 41,21 -1,21 -1,-1\n\
                 sweep -1,-1 50,-1\nend 50,-1\nlayer Part\npolyline 0,0 40,0 40,20 0,20 closed\n";
    let emit = |x: f64, y: f64, paths: &str| {
        let to = x + 2.0;
        let other = format!(
            "layer 1300.1P\nstart 0,0 \"T2 O2 I2 B0\"\nsweep 0,0 {x},{y}\nmill {x},{y} {to},{y}\n\
             sweep {to},{y} 60,0\nend 60,0\n"
        );
        let place = Place::new().file("pathbuild.toml", options);
        let place = place.file("1234.1P.dxf", dxf(plate)).file("1300.1P.dxf", dxf(&other));
        let run = place.run(&format!("emit {paths} --join both --post linuxcnc --format concise"));
        assert_eq!(place.path().join("both_Milling.ngc").exists(), run.status == Some(0), "{run}");
        run
    };
    for paths in ["1234.1P 1300.1P", "1300.1P 1234.1P"] {
        let gouged = emit(20.0, 21.97, paths);
        assert!(gouged.stderr.contains("error[PB214]") && gouged.stderr.contains("path 1300.1P"), "{gouged}");
        let within_tolerance = emit(20.0, 21.99, paths);
        assert_eq!(within_tolerance.status, Some(0), "{within_tolerance}");
        let bar = emit(13.0, 22.0, paths);
        assert!(bar.stderr.contains("error[PB218]"), "{bar}");
    }
}

/// The probing program is the first that runs, and goes where no cut does.
#[test]
fn the_probing_program_stays_within_the_limits_of_the_machine() {
    let drawing = dxf("layer 1234.1P\nstart 0,0 \"T2 O2 I1 B0 MX\"\nmill 0,0 20,0\nprobe 80,20\nend 20,0");
    let run = |machine: &str| {
        let configuration =
            format!("feed = 150\nprobe-feed = 200\nrapid = 1000\nsweep-height = 10\n[machine]\n{machine}\n");
        let place = Place::new().file("pathbuild.toml", configuration).file("1234.1P.dxf", drawing.clone());
        let emitted = place.run("emit 1234.1P");
        let is_written = place.path().join("1234.1P_Probing.gcode").exists();
        let codes = ["PB747", "PB748"].map(|code| emitted.stderr.contains(code));
        assert!(codes == [false, false] || emitted.stderr.contains("1234.1P_Probing.gcode"), "{emitted}");
        (codes, is_written)
    };
    assert_eq!(run("x = [0, 80]\nrates = [1000, 1000, 200]"), ([false, false], true));
    assert_eq!(run("x = [0, 79.9]"), ([false, true], false));
    assert_eq!(run("rates = [1000, 1000, 199]"), ([true, false], true));
}

/// `emit` and `verify` apply the same rules, although `emit` knows coordinates with more than three decimals.
#[test]
fn emit_and_verify_agree_on_the_limits_of_a_machine() {
    let drawing = dxf("layer 1234.1P\nstart 0,0 \"T2 O2 I1 B0 MX\"\nmill 0,0 20,0\nend 20,0");
    let run = |machine: &str| {
        let configuration = format!("feed = 150\nrapid = 1000\nsweep-height = 10\n[machine]\n{machine}\n");
        let place = Place::new().file("pathbuild.toml", configuration).file("1234.1P.dxf", drawing.clone());
        let emitted = place.run("emit 1234.1P --format concise");
        let verified = place.run("verify 1234.1P_Milling.gcode --format concise");
        ["PB747", "PB748"].map(|code| {
            let [emitted, verified] = [&emitted, &verified].map(|run| run.stderr.contains(code));
            // With PB748 no program is written, so there is none to verify.
            assert!(emitted == verified || code == "PB748", "{machine}");
            emitted
        })
    };
    assert_eq!(run("z = [0, 10]\nrates = [150, 150, 150]"), [false, false]);
    assert_eq!(run("rates = [149, 150, 150]"), [true, false]);
    assert_eq!(run("z = [0, 9.999]"), [false, true]);
}
