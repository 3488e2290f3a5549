//! Checks the measured values before they are put into the program.

use std::collections::{BTreeMap, BTreeSet};

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::probes as messages;
use pathbuild_path::Xy;
use pathbuild_path::approx::above;
use pathbuild_toolpath::odd_probes;

use super::Inputs;
use super::scan::{ProbeUse, ProbeUses};
use super::values::{EnteredValue, ProbeLine, ProbeTable, hides_probes};
use crate::native::{ProgramProbe, push_exact, three_decimals};

/// Measured heights in mm, by probe number.
pub(super) type Values = BTreeMap<u32, f64>;

/// Checker for measured values: compares them with the program's formulas, its table of probes and the permitted correction.
pub(super) struct Check<'c, 'a> {
    pub(super) inputs: &'c Inputs<'a>,
    pub(super) table: &'c ProbeTable,
    pub(super) uses: &'c ProbeUses<'a>,
}

/// Difference in mm beyond which two positions or heights are considered different: both are written with three decimals.
pub(super) const MIN_DIFFERENCE: f64 = 0.000_5;

impl Check<'_, '_> {
    /// Checks every value and returns the usable ones by probe number; errors are added to `problems`.
    pub(super) fn values(&self, lines: &[ProbeLine<'_>], problems: &mut Vec<Diagnostic>) -> Values {
        let mut values = Values::new();
        for line in lines {
            match self.value(line) {
                Ok(value) => values.extend(value.map(|value| (line.probe, value))),
                Err(problem) => problems.push(*problem),
            }
        }
        if !problems.iter().any(hides_probes) {
            problems.extend(self.report_unknown_probes(lines));
        }
        values
    }

    fn value(&self, line: &ProbeLine<'_>) -> Result<Option<f64>, Box<Diagnostic>> {
        self.check_is_listed(line)?;
        let value = match line.value {
            EnteredValue::Nothing => return Err(Box::new(line.value_fault(&messages::NO_VALUE))),
            EnteredValue::Wrong => return Ok(None),
            EnteredValue::Value(value) => value,
        };
        for expected in self.expected_heights(line)? {
            let off = (value - expected).abs();
            if above(off, self.inputs.max_correction) {
                let problem = line.value_fault(&messages::TOO_FAR).with("value", value).with("off", off);
                let problem = problem.with("expected", expected);
                return Err(Box::new(problem.with("limit", self.inputs.max_correction)));
            }
        }
        Ok(Some(rounded_as_stated(value)))
    }

    /// Checks that the program lists this probe, at the same position and height. A program that lists no probes passes.
    fn check_is_listed(&self, line: &ProbeLine<'_>) -> Result<(), Box<Diagnostic>> {
        if self.table.is_empty() {
            return Ok(());
        }
        let fault = |message| {
            let whole_line = 0..line.line.content().len();
            let file = self.inputs.program.file.file_name().unwrap_or_default();
            line.line.fault(message, whole_line).with("probe", u64::from(line.probe)).quoting("file", file)
        };
        let Some(program_probe) = self.table.get(&line.probe) else {
            return Err(Box::new(fault(&messages::PROBE_OF_OTHER_PROGRAM)));
        };
        let is_other = |(a, b): (f64, f64)| (a - b).abs() > MIN_DIFFERENCE;
        let height = line.height.unwrap_or(program_probe.height);
        let pairs = [
            (line.drawn_at.x, program_probe.drawn_at.x),
            (line.drawn_at.y, program_probe.drawn_at.y),
            (height, program_probe.height),
        ];
        let is_moved =
            line.at.zip(program_probe.at).is_some_and(|(a, b)| is_other((a.x, b.x)) || is_other((a.y, b.y)));
        if is_moved || pairs.into_iter().any(is_other) {
            let position = describe_probe(
                program_probe.drawn_at,
                program_probe.height,
                program_probe.at.filter(|_| line.at.is_some()),
            );
            let here = describe_probe(line.drawn_at, height, line.at);
            return Err(Box::new(
                fault(&messages::OTHER_PROBE).quoting("here", here).quoting("there", position),
            ));
        }
        Ok(())
    }

    /// Returns the heights at which the probe was drawn. If neither the line nor the program's list of probes states one, returns the least and the
    /// greatest height in the formulas.
    fn expected_heights(&self, line: &ProbeLine<'_>) -> Result<Vec<f64>, Box<Diagnostic>> {
        let program_probe = self.table.get(&line.probe).map(|program_probe| program_probe.height);
        if let Some(height) = line.height.or(program_probe) {
            return Ok(vec![height]);
        }
        match self.uses.get(&line.probe) {
            None => Ok(Vec::new()),
            Some(ProbeUse { drawn: Some((least, greatest)), .. }) => Ok(vec![*least, *greatest]),
            Some(ProbeUse { drawn: None, .. }) => {
                Err(Box::new(line.value_fault(&messages::NO_EXPECTED_HEIGHT)))
            }
        }
    }

    /// Reports probes that formulas use but the file does not list, each at its first use. At most one per line of the program is reported.
    fn report_unknown_probes(&self, lines: &[ProbeLine<'_>]) -> Vec<Diagnostic> {
        let file = self.inputs.values.file.file_name().unwrap_or_default();
        let known: BTreeSet<u32> = lines.iter().map(|line| line.probe).collect();
        let mut reported_lines = BTreeSet::new();
        let unknown = self.uses.iter().filter(|(probe, _)| !known.contains(probe));
        let unknown =
            unknown.filter(|(_, used)| reported_lines.insert(used.line.number)).map(|(probe, used)| {
                let problem = used.line.fault(&messages::UNKNOWN_PROBE, used.at.clone());
                problem.with("probe", u64::from(*probe)).quoting("file", file)
            });
        unknown.collect()
    }

    /// Reports probes that were measured but are not used by any formula, because formulas were removed or changed.
    pub(super) fn report_unused_probes(&self, lines: &[ProbeLine<'_>]) -> Vec<Diagnostic> {
        let file = self.inputs.program.file.file_name().unwrap_or_default();
        let is_stated = |line: &&ProbeLine<'_>| self.table.is_empty() || self.table.contains_key(&line.probe);
        let unused = lines.iter().filter(|line| !self.uses.contains_key(&line.probe));
        let unused = unused.filter(is_stated).map(|line| {
            let problem = line.line.fault(&messages::UNUSED, 0..line.line.content().len());
            problem.with("probe", u64::from(line.probe)).quoting("file", file)
        });
        unused.collect()
    }

    /// Reports probes whose heights do not fit those of their neighbours. This requires that the program lists the positions of its probes.
    pub(super) fn odd_probes(&self, lines: &[ProbeLine<'_>]) -> Vec<Diagnostic> {
        let measured = lines.iter().map(|line| match (line.value, self.table.get(&line.probe)) {
            (EnteredValue::Value(value), Some(ProgramProbe { at: Some(at), height, .. })) => {
                Some((*at, value - height))
            }
            _ => None,
        });
        let measured: Option<Vec<_>> = measured.collect();
        let odd = odd_probes(&measured.unwrap_or_default());
        let problems = odd.into_iter().map(|odd| {
            let direction = if odd.off > 0.0 { &messages::HIGHER } else { &messages::LOWER };
            let problem = lines[odd.probe].value_fault(&messages::ODD).with("off", odd.off.abs());
            problem.with("direction", direction)
        });
        problems.collect()
    }
}

/// Rounds a measured height to six decimals, as the adjusted program states it, so that evaluating the formulas again gives the same result.
fn rounded_as_stated(value: f64) -> f64 {
    let mut text = String::new();
    push_exact(&mut text, value);
    text.parse().unwrap_or(value)
}

fn describe_probe(drawn_at: Xy, height: f64, at: Option<Xy>) -> String {
    let at =
        at.map(|at| format!(" @ [{}|{}]", three_decimals(at.x), three_decimals(at.y))).unwrap_or_default();
    format!(
        "[{} {}] T={}{at}",
        three_decimals(drawn_at.x),
        three_decimals(drawn_at.y),
        three_decimals(height)
    )
}
