//! Warnings about words of a parsed program that a post writes with another word. (book: program/posts, "Converting programs")

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::gcode;
use pathbuild_motion::{Action, Coolant, Move, Pace, Step};

/// Returns a warning for the first of each kind of word that the output of a post replaces: optional stops, stops with a change of the
/// pallet, probing without an alarm, and mist beside flood.
pub fn altered_words(steps: &[Step]) -> Vec<Diagnostic> {
    let mut found: Vec<Diagnostic> = Vec::new();
    for step in steps {
        let Some((word, written)) = replacement(&step.action) else { continue };
        let warning = Diagnostic::new(&gcode::WORD_ALTERED).quoting("word", word).quoting("written", written);
        if found.iter().all(|other| other.arguments != warning.arguments) {
            found.push(warning.at_line(step.line, None));
        }
    }
    found
}

/// Returns the word of an action and the one with which posts replace it.
fn replacement(action: &Action) -> Option<(&'static str, &'static str)> {
    match action {
        Action::Stop { optional: true } => Some(("M1", "M0")),
        Action::Word(word) if (word.letter, word.code) == ('M', 600) => Some(("M60", "M0")),
        Action::Move(Move { pace: Pace::Probe { toward: true, must_answer: false, .. }, .. }) => {
            Some(("G38.3", "G38.2"))
        }
        Action::Coolant(Coolant { mist: true, flood: true }) => Some(("M7 M8", "M8")),
        _ => None,
    }
}
