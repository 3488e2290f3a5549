//! Compiles the same library in another place, or from another directory: programs are identical, and so are findings except for directory names;
//! with and without a cache, on one thread and on several.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::support::{Place, Run, dxf};

/// A library of components with and without faults, and of projects: one with probes, and one whose component is missing.
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
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 40,0
end 40,0
layer 1300.2P
start 0,50 "T5 O2 I1 B4"
mill 0,50 40,50
end 40,50
== components/1400.dxf ==
layer 1400.1P
start 0,0 "T5 O2 I1 B4 MPlate Y7"
mill 0,0 40,0
== projects/8001.dxf ==
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
== projects/8003.dxf ==
layer 8003.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">1400.1P"
subpath 40,0 80,0 ">1999.1P"
end 80,0
"#;

/// The results of a run over the library.
#[derive(Debug, PartialEq)]
struct Outcome {
    status: [Option<i32>; 2],
    /// Findings of `check`, and the output of `emit`, without directories.
    said: [Vec<String>; 2],
    programs: BTreeMap<PathBuf, Vec<u8>>,
}

/// Checks and emits the library in `root` from another directory.
fn outcome(place: &Place, root: &str, from: &str, options: &str) -> Outcome {
    let up =
        if from == root { "." } else { &format!("{}{root}", "../".repeat(Path::new(from).iter().count())) };
    let run = |command: &str| {
        let configuration = format!("{up}/pathbuild.toml");
        let arguments = format!("{command} --config {configuration} --format concise {options}");
        place.run_in(from, &arguments.split_whitespace().collect::<Vec<_>>())
    };
    let (check, emit) = (run("check"), run("emit"));
    let bare = |text: String| {
        let mut lines: Vec<String> = text
            .replace("<PLACE>/", "")
            .replace(&format!("{up}/"), "")
            .replace(&format!("{root}/"), "")
            .lines()
            .map(str::to_owned)
            .collect();
        lines.sort();
        lines
    };
    let outcome = Outcome {
        status: [check.status, emit.status],
        said: [check.stdout + &check.stderr, emit.stdout + &emit.stderr].map(bare),
        programs: programs(&place.path().join(root)),
    };
    assert_eq!(outcome.programs.len(), 4, "{:?}", outcome.said);
    for program in outcome.programs.keys() {
        fs::remove_file(place.path().join(root).join(program)).unwrap();
    }
    outcome
}

/// Returns the files of a library other than drawings.
fn programs(root: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let listed = fs::read_dir(root.join("projects")).unwrap().map(|entry| entry.unwrap().path());
    let written = listed.filter(|path| path.extension().is_none_or(|extension| extension != "dxf"));
    written.map(|path| (path.strip_prefix(root).unwrap().to_owned(), fs::read(&path).unwrap())).collect()
}

fn library_at(place: Place, root: &str) -> Place {
    let source = Place::of(LIBRARY);
    let mut open = vec![source.path().to_owned()];
    let mut place = place;
    while let Some(directory) = open.pop() {
        for entry in fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().path()) {
            if entry.is_dir() {
                open.push(entry);
            } else {
                let name = Path::new(root).join(entry.strip_prefix(source.path()).unwrap());
                place = place.file(name.to_str().unwrap(), fs::read(&entry).unwrap());
            }
        }
    }
    place
}

#[test]
fn the_place_decides_nothing() {
    let place = library_at(library_at(Place::new(), "one"), "another/place of it").file("aside/below/x", "");
    let expected = outcome(&place, "one", "one", "--no-cache -j 1");
    assert_eq!(expected.status, [Some(1), Some(1)]);
    for code in ["PB503", "PB202", "1400.dxf"] {
        assert!(expected.said[0].iter().any(|line| line.contains(code)), "{code}: {:#?}", expected.said[0]);
    }
    for (root, from) in [
        ("one", "one"),
        ("another/place of it", "another/place of it"),
        ("one", "aside/below"),
        ("one", "another"),
    ] {
        // Test with an empty cache, with the cache that this creates, and without a cache.
        for options in ["-j 2", "-j 1", "", "--no-cache -j 2"] {
            assert_eq!(outcome(&place, root, from, options), expected, "{root} from {from} {options}");
        }
    }
}

/// A moved cache is either used or rebuilt; the results are the same.
#[test]
fn a_library_that_moves_with_its_cache_says_the_same() {
    let place = library_at(Place::new(), "one");
    let expected = outcome(&place, "one", "one", "");
    fs::rename(place.path().join("one"), place.path().join("two")).unwrap();
    assert_eq!(outcome(&place, "two", "two", ""), expected);
    assert_eq!(outcome(&place, "two", "two", "--no-cache"), expected);
}

/// A library with its own output directory, next to a tree without a configuration.
const WORKSHOP: &str = r#"
== lib/pathbuild.toml ==
feed = 150
rapid = 1000
sweep-height = 20
library = ["parts"]
out-dir = "out"
[tool.2mm]
diameter = 2
number = 1
spindle = 12000
== lib/parts/1234.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 40,0
end 40,0
== lib/parts/1300.dxf ==
layer 1300.1P
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 40,0
probe 20,15 "LA"
end 40,0
== stick/2000.dxf ==
layer 2000.1P
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 40,0
end 40,0
"#;

impl Place {
    /// Runs the program in the library's directory.
    fn at_work(&self, line: &str) -> Run {
        self.run_in("lib", &line.split_whitespace().collect::<Vec<_>>())
    }
}

/// Creates the trees of [`WORKSHOP`], and copies a program and the files of a program with probes out of the library.
fn carried() -> Place {
    let place = Place::of(WORKSHOP);
    assert_eq!(place.at_work("emit 1234.1P 1300.1P").status, Some(0));
    let program = place.read("lib/out/1234_Milling.gcode");
    let clean = place.read("lib/out/1300_Clean.gcode");
    let values = place.read("lib/out/1300_Z.txt").replace("#51=", "#51=5.1");
    place
        .file("stick/1234.gcode", program)
        .file("stick/1300_Clean.gcode", clean)
        .file("stick/1300_Z.txt", values)
}

#[test]
fn the_working_directory_s_configuration_holds_for_a_program_from_elsewhere() {
    let place = carried();
    let verified = place.at_work("verify ../stick/1234.gcode --against 1234.1P");
    assert_eq!(verified.status, Some(0), "{verified}");
    assert!(
        verified.stderr.contains("1234.gcode: 5 of 5 moves as in path 1234.1P of parts/1234.dxf"),
        "{verified}"
    );
    let posted = place.at_work("post ../stick/1234.gcode --post linuxcnc");
    assert!(posted.status == Some(0) && posted.stdout.contains("S12000"), "{posted}");
    let adjusted = place.at_work("adjust ../stick/1300_Clean.gcode --max-correction 1");
    assert_eq!(adjusted.status, Some(0), "{adjusted}");
    assert!(!adjusted.stderr.contains("not compared"), "{adjusted}");
    assert!(place.path().join("lib/out/1300_Milling.gcode").exists(), "out-dir is the library's: {adjusted}");
    // The bare name of a program refers to the one in out-dir or, if there is none, to the given path.
    assert_eq!(place.at_work("adjust ../stick/1300 --max-correction 1").status, Some(1), "no values in out");
    fs::remove_file(place.path().join("lib/out/1300_Clean.gcode")).unwrap();
    let adjusted = place.at_work("adjust ../stick/1300 --max-correction 1");
    assert_eq!(adjusted.status, Some(0), "{adjusted}");
    let diff = place.at_work("diff ../stick/1234.gcode 1234.1P");
    assert!(diff.status == Some(0) && diff.stdout.contains("0 of 1 path changed"), "{diff}");
}

/// Each command that reads a program uses the limits of the working directory or, if the program is in another tree, those of that tree.
#[test]
fn a_program_in_another_tree_has_the_configuration_of_that() {
    let small = "[limits]\nfile-size = 100\n";
    let place = carried().file("lib/pathbuild.toml", small);
    let commands =
        ["verify {}", "import {}", "post {} --post grbl", "view {} -o x.svg", "adjust {} --max-correction 1"];
    for command in commands {
        let file = if command.starts_with("adjust") { "1300_Clean.gcode" } else { "1234.gcode" };
        let run = place.at_work(&command.replace("{}", &format!("../stick/{file}")));
        assert!(run.stderr.contains("PB005"), "{run}");
    }
    let place = place.file("stick/pathbuild.toml", "");
    for command in commands {
        let file = if command.starts_with("adjust") { "1300_Clean.gcode" } else { "1234.gcode" };
        let run = place.at_work(&command.replace("{}", &format!("../stick/{file}")));
        assert!(!run.stderr.contains("PB005"), "{run}");
    }
}

/// The configuration of the path applies if neither the program nor the working directory has one.
#[test]
fn the_configuration_of_the_path_holds_for_a_program_from_elsewhere() {
    let place = carried();
    let run = place.run("verify stick/1234.gcode --against lib/parts/1234.dxf");
    assert_eq!(run.status, Some(0), "{run}");
    let place = place.file("stick/pathbuild.toml", "");
    let run = place.run("verify stick/1234.gcode --against lib/parts/1234.dxf");
    assert!(run.status == Some(2) && run.stderr.contains("PB003"), "two configurations: {run}");
}

#[test]
fn a_drawing_outside_of_the_tree_is_told_that_no_configuration_holds() {
    let place = carried();
    let outside = place.at_work("emit ../stick/2000.dxf");
    assert_eq!(outside.status, Some(2), "{outside}");
    let reason =
        "it lies outside the tree of pathbuild.toml; give --config pathbuild.toml, or move the drawing";
    assert!(outside.stderr.contains(reason), "{outside}");
    let note = "note: pathbuild.toml does not apply to files outside its tree";
    assert!(place.at_work("check ../stick/2000.dxf").stderr.contains(note));
    assert!(
        place
            .run_in("lib/parts", &["check", "../../stick/2000.dxf"])
            .stderr
            .contains("../pathbuild.toml does not")
    );
    assert_eq!(place.at_work("emit ../stick/2000.dxf --config pathbuild.toml").status, Some(0));
    let nowhere = place.run("emit stick/2000.dxf");
    assert!(nowhere.stderr.contains("there is no pathbuild.toml beside or above the drawing"), "{nowhere}");
    for inside in ["check parts/1234.dxf", "verify ../stick/1234.gcode --against 1234.1P"] {
        assert!(!place.at_work(inside).stderr.contains("does not apply"));
    }
}

/// Windows hides the end of `pathbuild.toml.txt`, and other systems distinguish `Pathbuild.toml` from `pathbuild.toml`.
#[test]
fn a_configuration_with_a_wrong_name_is_named() {
    let drawing = dxf("layer 1234.1P\nstart 0,0 \"T2 O2 I1 B0\"\nmill 0,0 20,0\nend 20,0\n");
    let note = |file: &str, from: &str, argument: &str| {
        let place = Place::new().file(file, "feed = 150\n").file("parts/1234.1P.dxf", &drawing);
        let run = place.run_in(from, &["check", argument]);
        run.stderr.lines().find(|line| line.contains("no configuration applies")).map(str::to_owned)
    };
    let named = |file: &str| {
        format!(
            "note: no configuration applies: {file} must be named pathbuild.toml (Windows may hide the end of its name)"
        )
    };
    let txt = "pathbuild.toml.txt";
    assert_eq!(note(txt, ".", "parts/1234.1P.dxf"), Some(named(txt)));
    assert_eq!(note(txt, "parts", "1234.1P.dxf"), Some(named("../pathbuild.toml.txt")));
    assert_eq!(note("parts/pathbuild.toml.toml", ".", "parts"), Some(named("parts/pathbuild.toml.toml")));
    // The search begins at the drawing.
    assert_eq!(note("other/pathbuild.toml.txt", ".", "parts/1234.1P.dxf"), None);
    assert_eq!(note("pathbuild.toml.bak", ".", "parts/1234.1P.dxf"), None);
    assert_eq!(note("pathbuild.toml", ".", "parts/1234.1P.dxf"), None);
    if cfg!(target_os = "linux") {
        assert_eq!(note("Pathbuild.toml", ".", "parts/1234.1P.dxf"), Some(named("Pathbuild.toml")));
    }
    let place = Place::new().file(txt, "").file("pathbuild.toml", "").file("1234.1P.dxf", &drawing);
    let run = place.run("check 1234.1P.dxf");
    assert!(!run.stderr.contains(txt), "there is a configuration: {run}");
}
