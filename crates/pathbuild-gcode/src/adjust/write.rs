//! The adjusted program.

use std::ops::Range;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::probes as messages;

use super::check::Values;
use super::scan::{Fault, Line, Probes, Spot, in_line, lines, located, mark, number, spots, value_of};
use super::values::{entry_of_line, is_header};
use super::{AdjustedProgram, Inputs};
use crate::native::{f3, push_exact};

/// Factor and amount in mm by which a height may exceed the largest correction, although no probe does: weights with three decimals need
/// not sum to 1.
const SLACK: (f64, f64) = (1.002, 0.002);

/// Evaluates all formulas. Everything else is preserved byte for byte.
///
/// # Errors
/// Formulas that cannot be evaluated, or whose result is too large.
pub(super) fn adjusted(inputs: &Inputs<'_>, values: &Values) -> Result<AdjustedProgram, Vec<Diagnostic>> {
    let bytes = inputs.program.bytes;
    let mut writer = Writer { inputs, values, adjusted: AdjustedProgram::default(), problems: Vec::new() };
    writer.adjusted.program.reserve(bytes.len() + bytes.len() / 32);
    writer.adjusted.program.extend_from_slice(mark(bytes));
    let mut is_in_header = true;
    for line in lines(inputs.program) {
        is_in_header &= is_header(line.content());
        if is_in_header {
            writer.header_line(line);
        } else {
            writer.line(line);
        }
    }
    if writer.problems.is_empty() { Ok(writer.adjusted) } else { Err(writer.problems) }
}

struct Writer<'w> {
    inputs: &'w Inputs<'w>,
    values: &'w Values,
    adjusted: AdjustedProgram,
    problems: Vec<Diagnostic>,
}

impl Writer<'_> {
    /// Copies a line of the header. The line of a probe gets the measured height, so that `verify` can evaluate the formulas again.
    fn header_line(&mut self, line: Line<'_>) {
        let content = line.content();
        let entry = entry_of_line(content);
        let value = entry.and_then(|(probe, _)| self.values.get(&probe));
        let Some((value, end)) = value.zip(content.iter().rposition(|byte| *byte == b')')) else {
            return self.line(line);
        };
        let mut text = String::from(" Z");
        push_exact(&mut text, *value);
        let (before, behind) = line.bytes.split_at(end);
        let before =
            entry.filter(|(_, probe)| probe.measured.is_some()).map_or(before, |_| without_last_word(before));
        self.adjusted.program.extend_from_slice(before);
        self.adjusted.program.extend_from_slice(text.as_bytes());
        self.adjusted.program.extend_from_slice(behind);
    }

    fn line(&mut self, line: Line<'_>) {
        let mut done = 0;
        for spot in spots(line.content()) {
            match self.height(line, &spot) {
                Ok(height) => {
                    let program = &mut self.adjusted.program;
                    program.extend_from_slice(&line.bytes[done..spot.number.start]);
                    program.extend_from_slice(f3(height).as_bytes());
                    program.extend_from_slice(b"(==");
                    done = spot.formula.start;
                }
                Err(problem) => {
                    self.problems.push(*problem);
                    return;
                }
            }
        }
        self.adjusted.program.extend_from_slice(&line.bytes[done..]);
    }

    fn height(&mut self, line: Line<'_>, spot: &Spot) -> Result<f64, Box<Diagnostic>> {
        let formula = &line.content()[spot.formula.clone()];
        let told = |fault: Fault| Box::new(located(line, &fault));
        let height = value_of(formula, &mut MeasuredHeights(self.values))
            .map_err(|fault| told(in_line(&fault, spot)))?;
        if !height.is_finite() {
            return Err(told(Fault { message: &messages::NOT_FINITE, at: spot.formula.clone() }));
        }
        self.adjusted.heights += 1;
        if is_height(line.content(), spot) {
            self.check(line, spot, height - number(line.content(), spot).unwrap_or(height))?;
        }
        Ok(height)
    }

    /// Checks a correction: far outside the probes, a plane can exceed the values of all of them.
    fn check(&mut self, line: Line<'_>, spot: &Spot, correction: f64) -> Result<(), Box<Diagnostic>> {
        let limit = self.inputs.max_correction;
        if correction.abs() > SLACK.0 * limit + SLACK.1 {
            let whole = spot.number.start..spot.formula.end;
            let problem = line.fault(&messages::HEIGHT_TOO_FAR, whole).with("off", correction.abs());
            return Err(Box::new(problem.with("limit", limit)));
        }
        let (lowest, highest) = &mut self.adjusted.corrections;
        if self.adjusted.heights == 1 {
            (*lowest, *highest) = (correction, correction);
        }
        *lowest = lowest.min(correction);
        *highest = highest.max(correction);
        Ok(())
    }
}

/// The text up to its last blank.
fn without_last_word(text: &[u8]) -> &[u8] {
    text.iter().rposition(|byte| *byte == b' ').map_or(text, |end| &text[..end])
}

/// Whether the number belongs to a Z word.
fn is_height(line: &[u8], spot: &Spot) -> bool {
    line[..spot.number.start].trim_ascii_end().last().is_some_and(|letter| letter.eq_ignore_ascii_case(&b'Z'))
}

/// The measured heights. Every probe used by a formula has one, which was checked before.
struct MeasuredHeights<'v>(&'v Values);

impl Probes for MeasuredHeights<'_> {
    fn value(&mut self, probe: u32, _at: Range<usize>) -> f64 {
        self.0.get(&probe).copied().unwrap_or(f64::NAN)
    }
}
