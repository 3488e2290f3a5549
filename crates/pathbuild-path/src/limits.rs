//! Values against their limits: PB203. (spec/30-parameters.md, "Checks")

use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, Message};

use crate::approx::above;
use crate::letter::{Letter, Letters};
use crate::values::{Given, Values};

/// Letters that must be greater than 0 wherever they stand. (Z is not in the specification's list, but a machine that is to probe at
/// feed 0 never arrives.)
const POSITIVE: [Letter; 8] =
    [Letter::F, Letter::I, Letter::C, Letter::O, Letter::T, Letter::A, Letter::W, Letter::Z];

/// Letters that must be greater than 0 on paths and where there are bars.
const POSITIVE_BARS: [Letter; 2] = [Letter::P, Letter::U];

/// What is wrong with the values that `own` gives, with those of the path where it gives none. `has_bars`: on a path, and on every
/// element with support bars.
pub(crate) fn check(own: &Values<'_>, path: &Values<'_>, has_bars: bool) -> Vec<Diagnostic> {
    let mut limits = Limits { own, path, problems: Vec::new() };
    // Most texts have none of these letters, or of those.
    if own.letters().has_any(const { Letters::of(&POSITIVE) }) {
        for letter in POSITIVE {
            limits.check_positive(letter);
        }
    }
    if own.letters().has_any(const { Letters::of(&[Letter::S, Letter::T, Letter::B, Letter::D]) }) {
        limits.check_above(Letter::S, Letter::T, &messages::NOT_ABOVE);
        limits.check_above(Letter::T, Letter::B, &messages::NOT_BELOW);
        limits.check_above(Letter::T, Letter::D, &messages::NOT_BELOW);
    }
    if has_bars {
        limits.check_above(Letter::D, Letter::B, &messages::NOT_ABOVE);
        for letter in POSITIVE_BARS {
            limits.check_positive(letter);
        }
    }
    limits.problems
}

struct Limits<'a> {
    own: &'a Values<'a>,
    path: &'a Values<'a>,
    problems: Vec<Diagnostic>,
}

impl Limits<'_> {
    #[inline]
    fn check_positive(&mut self, letter: Letter) {
        if self.own.has(letter) {
            self.compare_with_zero(letter);
        }
    }

    fn compare_with_zero(&mut self, letter: Letter) {
        let Given::Number(value) = self.own.number(letter) else { return };
        if !above(value, 0.0) {
            let problem = Diagnostic::new(&messages::NOT_POSITIVE);
            let problem = problem.with("letter", letter.as_char()).with("value", value);
            self.problems.push(self.own.underline(letter, problem));
        }
    }

    /// That `upper` is above `lower`, where the own text gives at least one of them: else it is the path's fault, reported there.
    #[inline]
    fn check_above(&mut self, upper: Letter, lower: Letter, message: &'static Message) {
        if self.own.has(upper) || self.own.has(lower) {
            self.compare(upper, lower, message);
        }
    }

    fn compare(&mut self, upper: Letter, lower: Letter, message: &'static Message) {
        let value = |letter| -> Given { self.own.number(letter).or(self.path.number(letter)) };
        let (Given::Number(high), Given::Number(low)) = (value(upper), value(lower)) else { return };
        if above(high, low) {
            return;
        }
        // The message is about the letter that the person can mend here.
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
