//! Checks that a program and its translation by `post` have the same findings about rapid moves, travel, feeds and the spindle.

use std::collections::BTreeMap;

use super::mistakes::{MISTAKES, Program};
use super::{Known, PROGRAMS, counts};
use crate::support::Place;

/// Codes of the findings that must be the same.
const COMPARED: [&str; 11] =
    ["PB733", "PB740", "PB741", "PB744", "PB745", "PB746", "PB747", "PB748", "PB749", "PB770", "PB781"];

const POSTS: [&str; 3] = ["linuxcnc", "grbl", "mach3"];

/// A program that `post` refuses to translate.
struct Refused {
    name: &'static str,
    /// Lines that go to positions that only the machine knows, or may cut before the position is known, each with a replacement. The first of them
    /// is the one that is reported.
    lines: &'static [(&'static str, &'static str)],
}

/// The programs that are refused. (book: program/posts)
const REFUSED: [Refused; 4] = [
    Refused { name: "carbide-create.nc", lines: &[("G53G0Z-5.000", "")] },
    Refused { name: "easel.nc", lines: &[("G1 Z0.15000 F9.0", "G0 Z0.15000 F9.0")] },
    Refused { name: "fusion-grbl.nc", lines: &[("G28 G91 Z0", ""), ("G28 G91 X0 Y0", "")] },
    Refused { name: "fusion-linuxcnc.ngc", lines: &[("G53 G0 Z0.", "")] },
];

fn is_refused(known: &Known) -> bool {
    REFUSED.iter().any(|refused| refused.name == known.name)
}

/// The mistakes that are put into a program, all of them at once. Posts raise the cutter at the end.
const BROKEN: [&str; 4] = [
    "rapid move through stock",
    "spindle speed ten times as high",
    "cutting feed ten times as high",
    "coordinate outside of the travel",
];

impl Known {
    /// Returns the program with these mistakes.
    fn broken(&self) -> String {
        let program = Program::new(self);
        let mistakes = MISTAKES.iter().filter(|([name, _], _)| BROKEN.contains(name));
        let mut changes = BTreeMap::new();
        for (line, text) in mistakes.filter_map(|(_, mistake)| mistake(&program)).flatten() {
            changes.entry(line).or_insert(text);
        }
        program.text(changes.into_iter().collect())
    }
}

#[test]
fn a_translation_has_the_findings_of_its_program() {
    let mut different = Vec::new();
    for known in PROGRAMS.iter().filter(|known| !is_refused(known)) {
        // The programs are written in spite of their rapid moves, and without the settings of the machine, which might cause them to be refused.
        let lowered = "[severity]\nPB740 = \"warning\"\nPB741 = \"warning\"\n";
        let place = Place::new().file("good.nc", known.text()).file("broken.nc", known.broken());
        let place = place.file("pathbuild.toml", lowered);
        let mut files = vec!["good.nc".to_owned(), "broken.nc".to_owned()];
        for (name, post) in ["good", "broken"].into_iter().flat_map(|name| POSTS.map(|post| (name, post))) {
            let file = format!("{name}-{post}.nc");
            let surface = known.surface;
            let run = place.run(&format!("post {name}.nc --post {post} -o {file} --surface {surface}"));
            assert_eq!(run.status, Some(0), "{}: {run}", known.name);
            files.push(file);
        }
        let place = place.file("pathbuild.toml", known.configuration());
        let found = counts(&place, &format!("{} {}", files.join(" "), known.options()));
        let compared = |file: &str| {
            let mut found = found.get(file).cloned().unwrap_or_default();
            found.retain(|code, _| COMPARED.contains(&code.trim_end_matches('!')));
            found
        };
        for file in &files[2..] {
            let original = format!("{}.nc", file.split('-').next().unwrap());
            let (before, after) = (compared(&original), compared(file));
            if before != after {
                different.push(format!("{} {file}: {before:?} {after:?}", known.name));
            }
        }
    }
    assert_eq!(different, [""; 0], "{different:#?}");
}

#[test]
fn no_post_writes_moves_to_unknown_positions() {
    for Refused { name, lines } in REFUSED {
        let text = PROGRAMS.iter().find(|known| known.name == name).unwrap().text();
        let post = |text: &str| Place::new().file(name, text).run(&format!("post {name} --post grbl"));
        let run = post(&text);
        assert!(run.status == Some(1) && run.stderr.contains("PB765"), "{run}");
        assert!(run.stderr.contains(lines[0].0), "{run}");
        let run = post(&lines.iter().fold(text, |text, (line, instead)| text.replace(line, instead)));
        assert_eq!(run.status, Some(0), "{run}");
    }
}
