//! Tests that make and Ninja find files with any names that `emit --deps` writes. (book: howto/build-systems)
#![cfg(unix)]

use std::fs::{self, File};
use std::process::Command;
use std::time::{Duration, SystemTime};

use pathbuild_testkit::{sheet, skip};

use crate::support::Place;

const CONFIGURATION: &str = "feed = 150\nrapid = 1000\nsweep-height = 20\nspindle = \"manual\"\n";
const DRAWING: &str = "layer 1301.1P\nstart 0,0 \"T5 O2 I1 B0 MX\"\nmill 0,0 40,0\nend 40,0\n";

/// Path with special characters that both make and Ninja support: a space; the beginnings of comments, variables and rules; backslashes, even
/// before a space; and characters that are escaped for display.
const FOR_BOTH: &str = "a\\b\\ c\\\\ d\u{85}/1301.1P a  b#c$d$$e:f::g \u{2028}\u{202e}ä";
/// Path with special characters that `make` supports, but Ninja does not.
const FOR_MAKE: &str = "a\\#b\\:c\\;d/1301.1P a;touch$IFS$9b;\"'`&<>";

/// A test directory with a drawing, its program, and the make rule for them.
struct EmittedDrawing {
    place: Place,
    drawing: String,
    program: String,
}

impl EmittedDrawing {
    fn new(name: &str) -> Self {
        let drawing = format!("{name}.dxf");
        let place = Place::new().file("pathbuild.toml", CONFIGURATION);
        let place = place.file(&drawing, sheet(DRAWING).unwrap().to_dxf());
        let run = place.run_with(&["emit", &drawing, "--deps", "out.d"]);
        assert_eq!(run.status, Some(0), "{run}");
        Self { place, drawing, program: format!("{name}_Milling.gcode") }
    }

    /// Sets the modification time of the drawing.
    fn save(&self, time: SystemTime) {
        let drawing = File::options().write(true).open(self.place.path().join(&self.drawing)).unwrap();
        drawing.set_modified(time).unwrap();
    }

    /// Checks that a build does nothing for an old drawing, and something for a new one and for one that was removed.
    fn is_found_by(&self, mut is_up_to_date: impl FnMut() -> bool) {
        self.save(SystemTime::now() - Duration::from_hours(1));
        assert!(is_up_to_date(), "{}", self.place.read("out.d"));
        self.save(SystemTime::now() + Duration::from_hours(1));
        assert!(!is_up_to_date(), "{}", self.place.read("out.d"));
        fs::remove_file(self.place.path().join(&self.drawing)).unwrap();
        assert!(!is_up_to_date(), "{}", self.place.read("out.d"));
    }
}

/// Returns a command for a program; `None` if the program is not installed.
fn command(name: &str) -> Option<Command> {
    let is_there = Command::new(name).arg("--version").output().is_ok_and(|it| it.status.success());
    if !is_there {
        skip(name, &format!("{name} is missing"));
    }
    is_there.then(|| Command::new(name))
}

#[test]
fn make_finds_files_of_any_name() {
    for name in [FOR_BOTH, FOR_MAKE] {
        let Some(mut make) = command("make") else { return };
        let emitted = EmittedDrawing::new(name);
        fs::write(emitted.place.path().join("Makefile"), "include out.d\n%.gcode: ; false\n").unwrap();
        make.args(["--question", &emitted.program]).current_dir(emitted.place.path());
        emitted.is_found_by(|| {
            let run = make.output().unwrap();
            assert!(matches!(run.status.code(), Some(0 | 1)), "{run:?}");
            run.status.success()
        });
    }
}

#[test]
fn ninja_finds_files_of_any_name() {
    let Some(mut ninja) = command("ninja") else { return };
    let emitted = EmittedDrawing::new(FOR_BOTH);
    let program = emitted.program.replace('$', "$$").replace(' ', "$ ").replace(':', "$:");
    let build = format!("rule emit\n  command = true\n  depfile = out.d\nbuild {program}: emit\n");
    fs::write(emitted.place.path().join("build.ninja"), build).unwrap();
    ninja.current_dir(emitted.place.path());
    let mut is_up_to_date = || {
        let run = ninja.output().unwrap();
        assert!(run.status.success(), "{run:?}");
        String::from_utf8_lossy(&run.stdout).contains("no work to do")
    };
    // The first build has no record of the files yet.
    assert!(!is_up_to_date());
    emitted.is_found_by(is_up_to_date);
}

/// Names are refused if make would interpret them, for example as an assignment, and run a part of them.
#[test]
fn names_that_no_rule_can_have_are_refused() {
    let names = [
        ("a+1301.1P", true),
        ("A=1301.1P", false),
        ("X!=touch${IFS}b|true 1301.1P", false),
        ("a%1301.1P", false),
        ("a~1301.1P", true),
        ("~/1301.1P", false),
        ("x]/1301.1P", true),
        ("[xy]/1301.1P", false),
        ("a*1301.1P", false),
        ("a?1301.1P", false),
    ];
    for (name, is_right) in names {
        let drawing = format!("{name}.dxf");
        let place = Place::new().file("pathbuild.toml", CONFIGURATION).file("out.d", "of before");
        let place = place.file(&drawing, sheet(DRAWING).unwrap().to_dxf());
        let run = place.run_with(&["emit", &drawing, "--deps", "out.d"]);
        assert_eq!(
            (run.status, run.stderr.contains("PB004")),
            (Some(i32::from(!is_right)), !is_right),
            "{run}"
        );
        assert_eq!(place.read("out.d") == "of before", !is_right, "{run}");
    }
}

/// Names that end with `\` or `)` are refused, although a configuration may have such a name: a backslash would join two lines, and a
/// parenthesis would form an archive member.
#[test]
fn ends_that_no_rule_can_have_are_refused() {
    for (name, is_right) in [("c(x)d", true), ("c(x)", false), ("c\\d", true), ("c\\", false)] {
        let place =
            Place::new().file(name, CONFIGURATION).file("1301.1P.dxf", sheet(DRAWING).unwrap().to_dxf());
        let run = place.run_with(&["emit", "1301.1P.dxf", "--config", name, "--deps", "out.d"]);
        assert_eq!(
            (run.status, run.stderr.contains("PB004")),
            (Some(i32::from(!is_right)), !is_right),
            "{run}"
        );
    }
}

/// Line feeds in a name are escaped: otherwise the rest of the name would become a rule of its own.
#[test]
fn no_name_makes_a_line_of_its_own() {
    let emitted = EmittedDrawing::new("a\nall: ;@echo\u{7f}\r/1301.1P");
    let rule = "a\\nall\\:\\ \\\\\\;@echo\\u{7f}\\r/1301.1P";
    let rules = format!("{rule}_Milling.gcode: {rule}.dxf pathbuild.toml\n{rule}.dxf:\npathbuild.toml:\n");
    assert_eq!(emitted.place.read("out.d"), rules);
}
