//! Records which probes the formulas of a program use.

use std::collections::BTreeMap;
use std::ops::Range;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::probes as messages;

use super::Source;
use super::formula::{self, DEPTH_LIMIT, Fault, Probes};
use super::lines::{Line, lines};
use super::scan::{Spot, spots};

/// The probes used by the formulas of a program.
#[derive(Debug, Default)]
pub(super) struct Survey<'a> {
    pub(super) probes: BTreeMap<u32, Used<'a>>,
}

/// A probe used by formulas.
#[derive(Debug)]
pub(super) struct Used<'a> {
    /// The line of its first use.
    pub(super) line: Line<'a>,
    pub(super) at: Range<usize>,
    /// Least and greatest height at which it was drawn, according to the formulas.
    pub(super) drawn: Option<(f64, f64)>,
}

impl<'a> Survey<'a> {
    /// Checks all formulas. At most one error per line is reported.
    pub(super) fn of(program: Source<'a>, problems: &mut Vec<Diagnostic>) -> Self {
        let mut survey = Self::default();
        for line in lines(program) {
            for spot in spots(line.content()) {
                let mut reader = ProbeReader { survey: &mut survey, line, start: spot.formula.start };
                if let Err(fault) = check(line.content(), &spot, &mut reader) {
                    problems.push(located(line, &fault));
                    break;
                }
            }
        }
        survey
    }
}

/// Converts an error in a line to a diagnostic.
pub(super) fn located(line: Line<'_>, fault: &Fault) -> Diagnostic {
    let found = String::from_utf8_lossy(line.content().get(fault.at.clone()).unwrap_or_default());
    line.fault(fault.message, fault.at.clone()).quoting("found", &*found).with("limit", DEPTH_LIMIT)
}

/// Converts the position of an error from the formula to the line.
pub(super) fn in_line(fault: &Fault, spot: &Spot) -> Fault {
    let start = spot.formula.start;
    Fault { at: fault.at.start + start..fault.at.end + start, ..*fault }
}

fn check(line: &[u8], spot: &Spot, probes: &mut impl Probes) -> Result<(), Fault> {
    let formula = &line[spot.formula.clone()];
    if formula.first() == Some(&b'=') {
        let at = spot.formula.start..spot.formula.start + 1;
        return Err(Fault { message: &messages::ADJUSTED_BEFORE, at });
    }
    if number(line, spot).is_none() {
        return Err(Fault { message: &messages::NOT_A_NUMBER, at: spot.number.clone() });
    }
    formula::value(formula, probes).map_err(|fault| in_line(&fault, spot))?;
    if !spot.is_closed {
        return Err(Fault { message: &messages::UNCLOSED, at: spot.formula.start - 2..spot.formula.end });
    }
    Ok(())
}

/// The number before a formula.
pub(super) fn number(line: &[u8], spot: &Spot) -> Option<f64> {
    let text = str::from_utf8(&line[spot.number.clone()]).ok()?;
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

struct ProbeReader<'s, 'a> {
    survey: &'s mut Survey<'a>,
    line: Line<'a>,
    start: usize,
}

impl Probes for ProbeReader<'_, '_> {
    fn value(&mut self, probe: u32, at: Range<usize>) -> f64 {
        let at = at.start + self.start..at.end + self.start;
        self.survey.probes.entry(probe).or_insert(Used { line: self.line, at, drawn: None });
        // With NaN as height, results computed from it are not reported as errors yet.
        f64::NAN
    }

    fn drawn(&mut self, probe: u32, height: f64) {
        if let Some(used) = self.survey.probes.get_mut(&probe) {
            let (least, greatest) = used.drawn.unwrap_or((height, height));
            used.drawn = Some((least.min(height), greatest.max(height)));
        }
    }
}
