//! Parses formulas: numbers, `#51` and so on, + - * /, ( ) and [ ].

use std::ops::Range;

use pathbuild_diagnostic::Message;
use pathbuild_diagnostic::messages::probes as messages;

/// Maximum nesting depth of brackets. Formulas written by pathbuild have depth one.
pub(super) const DEPTH_LIMIT: usize = 100;

/// Provides the probes for a formula.
pub(super) trait Probes {
    /// Returns the measured height of a probe. `at` is its position in the formula.
    fn value(&mut self, probe: u32, at: Range<usize>) -> f64;

    /// Called for each `[#51-5.000]`, which tells at which height the probe was drawn.
    fn drawn(&mut self, _probe: u32, _height: f64) {}
}

/// An error in a formula, and its position.
#[derive(Clone, Debug)]
pub(super) struct Fault {
    pub(super) message: &'static Message,
    pub(super) at: Range<usize>,
}

/// Evaluates a formula while parsing it. The result may be infinite or NaN.
///
/// # Errors
/// The first error.
pub(super) fn value(text: &[u8], probes: &mut impl Probes) -> Result<f64, Fault> {
    let mut parser = Parser { text, at: 0, depth: 0, probes };
    let term = parser.sum()?;
    match parser.peek() {
        None => Ok(term.value),
        Some(_) => Err(parser.unexpected(&messages::OPERATOR_EXPECTED)),
    }
}

struct Parser<'a, P> {
    text: &'a [u8],
    at: usize,
    depth: usize,
    probes: &'a mut P,
}

/// An evaluated part of a formula.
#[derive(Clone, Copy)]
struct Term {
    value: f64,
    form: Form,
}

/// The syntactic form of a term.
#[derive(Clone, Copy)]
enum Form {
    Number,
    Probe(u32),
    /// A probe minus a number.
    Difference(u32, f64),
    Other,
}

impl<P: Probes> Parser<'_, P> {
    fn sum(&mut self) -> Result<Term, Fault> {
        let mut sum = self.product()?;
        while let Some(operator @ (b'+' | b'-')) = self.peek() {
            self.at += 1;
            let term = self.product()?;
            sum = match (operator, sum.form, term.form) {
                (b'-', Form::Probe(probe), Form::Number) => {
                    Term { value: sum.value - term.value, form: Form::Difference(probe, term.value) }
                }
                (b'-', ..) => other(sum.value - term.value),
                _ => other(sum.value + term.value),
            };
        }
        Ok(sum)
    }

    fn product(&mut self) -> Result<Term, Fault> {
        let mut product = self.factor()?;
        while let Some(operator @ (b'*' | b'/')) = self.peek() {
            let at = self.at;
            self.at += 1;
            let factor = self.factor()?;
            product = match operator {
                b'*' => other(product.value * factor.value),
                _ if factor.value == 0.0 => return Err(fault(&messages::DIVISION_BY_ZERO, at..self.at)),
                _ => other(product.value / factor.value),
            };
        }
        Ok(product)
    }

    fn factor(&mut self) -> Result<Term, Fault> {
        let mut signs = 0_u64;
        while self.peek() == Some(b'-') {
            self.at += 1;
            signs += 1;
        }
        let term = self.primary()?;
        match signs {
            0 => Ok(term),
            _ if signs.is_multiple_of(2) => Ok(other(term.value)),
            _ => Ok(other(-term.value)),
        }
    }

    fn primary(&mut self) -> Result<Term, Fault> {
        match self.peek() {
            Some(b'0'..=b'9' | b'.') => self.number(),
            Some(b'#') => self.probe(),
            Some(b'(') => self.bracket(b')'),
            Some(b'[') => self.bracket(b']'),
            _ => Err(self.unexpected(&messages::VALUE_EXPECTED)),
        }
    }

    fn bracket(&mut self, closing: u8) -> Result<Term, Fault> {
        if self.depth == DEPTH_LIMIT {
            return Err(self.unexpected(&messages::TOO_DEEP));
        }
        self.at += 1;
        self.depth += 1;
        let inner = self.sum()?;
        self.depth -= 1;
        if self.peek() != Some(closing) {
            return Err(self.unexpected(&messages::OPERATOR_EXPECTED));
        }
        self.at += 1;
        if let Form::Difference(probe, height) = inner.form {
            self.probes.drawn(probe, height);
        }
        Ok(other(inner.value))
    }

    fn number(&mut self) -> Result<Term, Fault> {
        let start = self.at;
        self.skip(|byte| byte.is_ascii_digit() || byte == b'.');
        let text = str::from_utf8(&self.text[start..self.at]).unwrap_or_default();
        let number = text.parse().ok().filter(|number: &f64| number.is_finite());
        let value = number.ok_or_else(|| fault(&messages::NOT_A_NUMBER, start..self.at))?;
        Ok(Term { value, form: Form::Number })
    }

    fn probe(&mut self) -> Result<Term, Fault> {
        let start = self.at;
        self.at += 1;
        self.skip(|byte| byte.is_ascii_digit());
        let text = str::from_utf8(&self.text[start + 1..self.at]).unwrap_or_default();
        let probe = text.parse().map_err(|_| fault(&messages::VALUE_EXPECTED, start..self.at))?;
        Ok(Term { value: self.probes.value(probe, start..self.at), form: Form::Probe(probe) })
    }

    /// The next byte that is not blank.
    fn peek(&mut self) -> Option<u8> {
        self.skip(|byte| matches!(byte, b' ' | b'\t'));
        self.text.get(self.at).copied()
    }

    fn skip(&mut self, is_skipped: impl Fn(u8) -> bool) {
        let rest = &self.text[self.at..];
        self.at += rest.iter().position(|byte| !is_skipped(*byte)).unwrap_or(rest.len());
    }

    fn unexpected(&self, message: &'static Message) -> Fault {
        fault(message, self.at..self.at + 1)
    }
}

fn other(value: f64) -> Term {
    Term { value, form: Form::Other }
}

fn fault(message: &'static Message, at: Range<usize>) -> Fault {
    Fault { message, at }
}
