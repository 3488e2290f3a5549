//! Checks values against their limits: PB203. (book: language/letters)

use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, Message};

use crate::approx::above;
use crate::letter::Letter;
use crate::matrix::{ElementClass, Use};
use crate::values::{GivenNumber, Values};

/// Letters that must always be positive. (Z is not in the list of the specification, but a machine probing at feed 0 never arrives.)
const POSITIVE: [Letter; 8] =
    [Letter::F, Letter::I, Letter::C, Letter::O, Letter::T, Letter::A, Letter::W, Letter::Z];

/// Letters that must be positive on paths and on elements with bars.
const POSITIVE_BARS: [Letter; 2] = [Letter::P, Letter::U];

/// Problems with the values that `own` gives; other values come from the path.
pub(crate) fn check(own: &Values<'_>, path: &Values<'_>, class: ElementClass) -> Vec<Diagnostic> {
    let mut limits = Limits { own, path, problems: Vec::new() };
    limits.check_positive(&POSITIVE);
    limits.check_above(Letter::S, Letter::T, &messages::NOT_ABOVE);
    // T of a probe or a subpath is the thickness there, which is unrelated to the path's depths.
    for depth in [Letter::B, Letter::D].into_iter().filter(|depth| class.use_of(*depth) != Use::Unknown) {
        limits.check_above(Letter::T, depth, &messages::NOT_BELOW);
    }
    if class.has_bars() {
        limits.check_above(Letter::D, Letter::B, &messages::NOT_ABOVE);
        limits.check_positive(&POSITIVE_BARS);
    }
    limits.problems
}

/// A usual value for a letter that must be positive.
fn example(letter: Letter) -> &'static str {
    match letter {
        Letter::F => "F150",
        Letter::I => "I0.5",
        Letter::C => "C1",
        Letter::O => "O2",
        Letter::T => "T5",
        Letter::A => "A8",
        Letter::W => "W4",
        Letter::Z => "Z50",
        Letter::P => "P1",
        _ => "U5",
    }
}

struct Limits<'a> {
    own: &'a Values<'a>,
    path: &'a Values<'a>,
    problems: Vec<Diagnostic>,
}

impl Limits<'_> {
    fn check_positive(&mut self, letters: &[Letter]) {
        for letter in letters {
            let GivenNumber::Number(value) = self.own.number(*letter) else { continue };
            if !above(value, 0.0) {
                let problem = Diagnostic::new(&messages::NOT_POSITIVE)
                    .with("letter", letter.as_char())
                    .with("value", value)
                    .quoting("example", example(*letter));
                self.problems.push(self.own.underline(*letter, problem));
            }
        }
    }

    /// Checks that `upper` is greater than `lower`, if the element's own text gives either; otherwise the problem is reported at the path.
    fn check_above(&mut self, upper: Letter, lower: Letter, message: &'static Message) {
        if !self.own.has(upper) && !self.own.has(lower) {
            return;
        }
        let value = |letter| -> GivenNumber { self.own.number(letter).or(self.path.number(letter)) };
        let (GivenNumber::Number(high), GivenNumber::Number(low)) = (value(upper), value(lower)) else {
            return;
        };
        if above(high, low) {
            return;
        }
        // The message concerns the letter that can be corrected here.
        let says_upper = *message == messages::NOT_ABOVE;
        let (subject, limit) = if says_upper { (upper, lower) } else { (lower, upper) };
        let (subject_value, limit_value) = if says_upper { (high, low) } else { (low, high) };
        let problem = Diagnostic::new(message)
            .with("letter", subject.as_char())
            .with("value", subject_value)
            .with("limit_letter", limit.as_char())
            .with("limit", limit_value);
        let underlined = if self.own.has(subject) { subject } else { limit };
        self.problems.push(self.own.underline(underlined, problem));
    }
}
