//! Compares the modes of a program with those of another program by the same post: units, distances, plane, offsets, tool lengths and feed mode.
//! (book: reference/commands, `emit --check --moves`)

use std::collections::BTreeMap;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{Action, Group, StatedWord, Step};

use super::words::{PostWords, WordRules};
use crate::dialect::Dialect;
use crate::interpret::code_name;
use crate::read::Problems;

/// Reports words by which a program may move differently from another program although both state the same positions: unsupported words, other
/// coordinate systems, machine positions, tool lengths and tool changes, and modes that only the other program states before its first move. `words`
/// are the words of the other program.
pub fn foreign_modes(steps: &[Step], words: &PostWords, dialect: Dialect) -> Vec<Diagnostic> {
    let mut rules = WordRules::strict(words, dialect);
    let mut missing = words.lead.clone();
    let mut problems = Problems::default();
    for step in steps {
        rules.step(step);
        match &step.action {
            Action::Move(_) => report_missing(&mut missing, step.line, &mut problems),
            Action::Word(word) => {
                if let Some(group) = word.group {
                    missing.remove(&group);
                }
                if is_beside_moves(*word) && !words.has(word.letter, word.code) {
                    let word = code_name(word.letter, word.code);
                    problems.add_at_line(&say::NOT_IN_DRAWING, step.line, |d| d.quoting("word", word));
                }
            }
            _ => {}
        }
    }
    let mut found = rules.finish();
    found.extend(problems.into_diagnostics());
    found.sort_by_key(|problem| problem.place.line);
    found
}

fn report_missing(missing: &mut BTreeMap<Group, u16>, line: u32, problems: &mut Problems) {
    for code in std::mem::take(missing).into_values() {
        problems.add_at_line(&say::MODE_MISSING, line, |d| d.quoting("word", code_name('G', code)));
    }
}

/// Whether a word changes the tool, its length or the plane, which the positions of straight moves do not show.
fn is_beside_moves(word: StatedWord) -> bool {
    matches!(word.group, Some(Group::ToolLength | Group::Plane)) || (word.letter, word.code) == ('M', 60)
}
