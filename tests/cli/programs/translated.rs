//! A program and its translation by `post` have the same findings about rapid moves, travel, feeds and the spindle.

use std::collections::BTreeMap;

use super::mistakes::{MISTAKES, Program};
use super::{Known, PROGRAMS, counts};
use crate::support::Place;

/// The codes of these findings.
const COMPARED: [&str; 11] =
    ["PB733", "PB740", "PB741", "PB744", "PB745", "PB746", "PB747", "PB748", "PB749", "PB770", "PB781"];

const POSTS: [&str; 3] = ["linuxcnc", "grbl", "mach3"];

/// Programs that no post writes, because they go to positions that only the machine knows, or cut before their position is known.
const REFUSED: [&str; 4] = ["carbide-create.nc", "easel.nc", "fusion-grbl.nc", "fusion-linuxcnc.ngc"];

/// The mistakes that are put into a program, all of them at once. Posts raise the cutter at the end.
const BROKEN: [&str; 4] = [
    "rapid move through stock",
    "spindle speed ten times as high",
    "cutting feed ten times as high",
    "coordinate outside of the travel",
];

impl Known {
    /// The program with several mistakes.
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
    for known in PROGRAMS.iter().filter(|known| !REFUSED.contains(&known.name)) {
        // Written without the machine, which could refuse them.
        let place = Place::new().file("good.nc", known.text()).file("broken.nc", known.broken());
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
    for known in PROGRAMS.iter().filter(|known| REFUSED.contains(&known.name)) {
        let run =
            Place::new().file(known.name, known.text()).run(&format!("post {} --post grbl", known.name));
        assert!(run.stderr.contains("PB765") || run.stdout.contains("PB765"), "{run}");
    }
}
