//! Splits a program into lines, finds the formulas in them, and evaluates these. A formula consists of numbers, probes such as `#51`, the
//! operators + - * / and the brackets ( ) and [ ].

use std::collections::BTreeMap;
use std::ops::Range;

use pathbuild_diagnostic::messages::probes as messages;
use pathbuild_diagnostic::{Diagnostic, Message, TextFault};

use super::Source;
use crate::read::BYTE_ORDER_MARK;

#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    pub(super) source: Source<'a>,
    /// Line number, counted from 1.
    pub(super) number: u32,
    /// The line as bytes, including the line break.
    pub(super) bytes: &'a [u8],
}

/// Returns the byte order mark that some editors write at the start of a file; empty if there is none.
pub(super) fn byte_order_mark(bytes: &[u8]) -> &[u8] {
    if bytes.starts_with(BYTE_ORDER_MARK) { BYTE_ORDER_MARK } else { &[] }
}

/// Returns the lines of a file, without the byte order mark.
pub(super) fn lines(source: Source<'_>) -> impl Iterator<Item = Line<'_>> {
    let bytes = &source.bytes[byte_order_mark(source.bytes).len()..];
    let lines = bytes.split_inclusive(|byte| *byte == b'\n');
    (1..).zip(lines).map(move |(number, bytes)| Line { source, number, bytes })
}

impl<'a> Line<'a> {
    /// Returns the line without its line break.
    pub(super) fn content(self) -> &'a [u8] {
        let content = self.bytes.strip_suffix(b"\n").unwrap_or(self.bytes);
        content.strip_suffix(b"\r").unwrap_or(content)
    }

    pub(super) fn fault(self, message: &'static Message, span: Range<usize>) -> Diagnostic {
        let content = self.content();
        let text = |range: Range<usize>| String::from_utf8_lossy(&content[range]);
        let span = span.start.min(content.len())..span.end.min(content.len());
        let column = u32::try_from(text(0..span.start).chars().count() + 1).unwrap_or(u32::MAX);
        // Of a very long line, only the part around the start of the error is shown.
        let shown = span.start.saturating_sub(EXCERPT_BYTES)..content.len().min(span.start + EXCERPT_BYTES);
        let before = text(shown.start..span.start).len();
        let fault = text(span.start..span.end.min(shown.end)).len();
        Diagnostic::new(message)
            .in_file(self.source.file)
            .at_line(self.number, Some(column))
            .with_text(TextFault::new(&text(shown), before..before + fault))
    }
}

/// Maximum number of bytes of a line shown on either side of the start of an error.
const EXCERPT_BYTES: usize = 500;

/// A number with its formula, as byte ranges of the line.
#[derive(Clone, Debug)]
pub(super) struct FormulaSpan {
    /// Digits with an optional sign and decimal point. If there are several points, this is not a valid number.
    pub(super) number: Range<usize>,
    /// The text between `(=` and the closing bracket.
    pub(super) formula: Range<usize>,
    /// Whether there is a closing bracket; otherwise the formula extends to the end of the line.
    pub(super) is_closed: bool,
}

/// Returns the formulas of a line, in order. Formulas within comments are ignored.
pub(super) fn formula_spans(line: &[u8]) -> impl Iterator<Item = FormulaSpan> {
    let mut rest = 0;
    std::iter::from_fn(move || {
        loop {
            let open = rest + line[rest..].iter().position(|byte| matches!(byte, b'(' | b';'))?;
            if line[open] == b';' {
                return None;
            }
            let number = number_before(line, open);
            if line.get(open + 1) == Some(&b'=') && !number.is_empty() {
                let closed = closing_bracket(line, open);
                let end = closed.unwrap_or(line.len());
                rest = (end + 1).min(line.len());
                return Some(FormulaSpan { number, formula: open + 2..end, is_closed: closed.is_some() });
            }
            rest = open + 1 + line[open..].iter().position(|byte| *byte == b')')?;
        }
    })
}

fn number_before(line: &[u8], end: usize) -> Range<usize> {
    let is_digit = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
    let mut start = end - line[..end].iter().rev().take_while(|byte| is_digit(byte)).count();
    if start < end && start > 0 && matches!(line[start - 1], b'+' | b'-') {
        start -= 1;
    }
    start..end
}

fn closing_bracket(line: &[u8], open: usize) -> Option<usize> {
    let mut depth = 0_usize;
    line.iter().enumerate().skip(open).find_map(|(at, byte)| {
        match byte {
            b'(' => depth += 1,
            b')' => depth -= 1,
            _ => {}
        }
        (depth == 0).then_some(at)
    })
}

/// Returns the number of the first Z word that has no formula, as a byte range of the line.
pub(super) fn plain_height(line: &[u8]) -> Option<Range<usize>> {
    let mut at = 0;
    while let Some(byte) = line.get(at).filter(|byte| **byte != b';') {
        at = match byte {
            b'(' => closing_bracket(line, at)? + 1,
            _ => at + 1,
        };
        if byte.eq_ignore_ascii_case(&b'Z') {
            let start = at + line[at..].iter().take_while(|byte| **byte == b' ').count();
            let length = line[start..].iter().take_while(|byte| b"+-.0123456789".contains(byte)).count();
            let number = start..start + length;
            if !line[number.end..].starts_with(b"(=") {
                return Some(number);
            }
        }
    }
    None
}

/// The probes that the formulas of a program use, by number.
pub(super) type ProbeUses<'a> = BTreeMap<u32, ProbeUse<'a>>;

/// The first use of a probe in formulas, and the heights at which the probe was drawn.
#[derive(Debug)]
pub(super) struct ProbeUse<'a> {
    pub(super) line: Line<'a>,
    pub(super) at: Range<usize>,
    /// Least and greatest height in mm at which the probe was drawn, according to the formulas.
    pub(super) drawn: Option<(f64, f64)>,
}

/// Checks all formulas and collects the probes that they use. At most one error per line is reported.
pub(super) fn probe_uses<'a>(program: Source<'a>, problems: &mut Vec<Diagnostic>) -> ProbeUses<'a> {
    let mut uses = ProbeUses::new();
    for line in lines(program) {
        for spot in formula_spans(line.content()) {
            let mut reader = ProbeReader { uses: &mut uses, line, start: spot.formula.start };
            if let Err(fault) = check_formula(line.content(), &spot, &mut reader) {
                problems.push(fault_diagnostic(line, &fault));
                break;
            }
        }
    }
    uses
}

pub(super) fn fault_diagnostic(line: Line<'_>, fault: &Fault) -> Diagnostic {
    let found = String::from_utf8_lossy(line.content().get(fault.at.clone()).unwrap_or_default());
    line.fault(fault.message, fault.at.clone()).quoting("found", &*found).with("limit", DEPTH_LIMIT)
}

/// Converts an error in a formula to an error in the line that contains the formula.
pub(super) fn fault_in_line(fault: &Fault, spot: &FormulaSpan) -> Fault {
    let start = spot.formula.start;
    Fault { at: fault.at.start + start..fault.at.end + start, ..*fault }
}

fn check_formula(line: &[u8], spot: &FormulaSpan, probes: &mut impl Probes) -> Result<(), Fault> {
    let formula = &line[spot.formula.clone()];
    if formula.first() == Some(&b'=') {
        let at = spot.formula.start..spot.formula.start + 1;
        return Err(Fault { message: &messages::ADJUSTED_BEFORE, at });
    }
    if number(line, spot).is_none() {
        return Err(Fault { message: &messages::NOT_A_NUMBER, at: spot.number.clone() });
    }
    value_of(formula, probes).map_err(|fault| fault_in_line(&fault, spot))?;
    if !spot.is_closed {
        return Err(Fault { message: &messages::UNCLOSED, at: spot.formula.start - 2..spot.formula.end });
    }
    Ok(())
}

pub(super) fn number(line: &[u8], spot: &FormulaSpan) -> Option<f64> {
    let text = str::from_utf8(&line[spot.number.clone()]).ok()?;
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

struct ProbeReader<'s, 'a> {
    uses: &'s mut ProbeUses<'a>,
    line: Line<'a>,
    start: usize,
}

impl Probes for ProbeReader<'_, '_> {
    fn value(&mut self, probe: u32, at: Range<usize>) -> f64 {
        let at = at.start + self.start..at.end + self.start;
        self.uses.entry(probe).or_insert(ProbeUse { line: self.line, at, drawn: None });
        // No height is known yet. Results computed from NaN are NaN, which this check does not report.
        f64::NAN
    }

    fn record_drawn_height(&mut self, probe: u32, height: f64) {
        if let Some(used) = self.uses.get_mut(&probe) {
            let (least, greatest) = used.drawn.unwrap_or((height, height));
            used.drawn = Some((least.min(height), greatest.max(height)));
        }
    }
}

/// Maximum nesting depth of brackets. Formulas written by pathbuild have depth one.
pub(super) const DEPTH_LIMIT: usize = 100;

/// Source of the measured heights that a formula uses.
pub(super) trait Probes {
    /// Returns the measured height of a probe. `at` is its position in the formula.
    fn value(&mut self, probe: u32, at: Range<usize>) -> f64;

    /// Called for each difference such as `[#51-5.000]`, which gives the height at which the probe was drawn.
    fn record_drawn_height(&mut self, _probe: u32, _height: f64) {}
}

#[derive(Clone, Debug)]
pub(super) struct Fault {
    pub(super) message: &'static Message,
    pub(super) at: Range<usize>,
}

/// Evaluates a formula while parsing it, up to the first error. The result may be infinite or NaN.
pub(super) fn value_of(text: &[u8], probes: &mut impl Probes) -> Result<f64, Fault> {
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

#[derive(Clone, Copy)]
struct Term {
    value: f64,
    form: Form,
}

#[derive(Clone, Copy)]
enum Form {
    Number,
    Probe(u32),
    /// A probe's number, and the height subtracted from its measured height.
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
                (b'-', ..) => other_term(sum.value - term.value),
                _ => other_term(sum.value + term.value),
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
                b'*' => other_term(product.value * factor.value),
                _ if factor.value == 0.0 => return Err(fault(&messages::DIVISION_BY_ZERO, at..self.at)),
                _ => other_term(product.value / factor.value),
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
            _ if signs.is_multiple_of(2) => Ok(other_term(term.value)),
            _ => Ok(other_term(-term.value)),
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
            self.probes.record_drawn_height(probe, height);
        }
        Ok(other_term(inner.value))
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

    /// Skips blanks and returns the next byte without consuming it.
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

fn other_term(value: f64) -> Term {
    Term { value, form: Form::Other }
}

fn fault(message: &'static Message, at: Range<usize>) -> Fault {
    Fault { message, at }
}
