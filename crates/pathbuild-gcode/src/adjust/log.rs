//! Values from what a sender logged: one `[PRB:x,y,z:1]` a probe, as Grbl and its kin report them.
//!
//! They report machine coordinates. Where a status report before has told the offset of the workpiece (`WCO:x,y,z`), it is taken off;
//! else the machine's zero must be the workpiece's, which the check against the drawn heights will show.

use std::sync::LazyLock;

use pathbuild_diagnostic::messages::probes as messages;
use pathbuild_diagnostic::{Diagnostic, Message};
use regex::bytes::{Captures, Regex};

use super::Source;
use super::lines::{Line, lines};
use super::values::{Entered, ProbeLine, parse};

/// Values as far apart as this, in mm, are the same: a person enters three decimals.
const SAME: f64 = 0.0005;

static REPORT: LazyLock<Regex> = LazyLock::new(|| {
    Regex::new(r"(?-u)\[PRB:(?<probe>[^\]\n]*)\]|WCO:(?<offset>[-+0-9.,]*)").expect("a constant pattern")
});

/// A result of a probe.
#[derive(Debug)]
struct Measured<'a> {
    line: Line<'a>,
    at: std::ops::Range<usize>,
    z: f64,
}

/// Gives the probes that have no value theirs of the log, in the order of their numbers, which is that of the probing run.
pub(super) fn fill<'a>(
    probes: &mut [ProbeLine<'a>],
    values: Source<'_>,
    log: Source<'a>,
    problems: &mut Vec<Diagnostic>,
) {
    let before = problems.len();
    let measured = read(log, problems);
    if problems.len() > before {
        return give_up(probes);
    }
    if measured.len() != probes.len() {
        let problem = Diagnostic::new(&messages::LOG_COUNT).in_file(log.file).with("found", measured.len());
        let file = values.file.file_name().unwrap_or_default();
        problems.push(problem.quoting("file", file).with("expected", probes.len()));
        return give_up(probes);
    }
    let mut in_order: Vec<&mut ProbeLine<'_>> = probes.iter_mut().collect();
    in_order.sort_by_key(|probe| probe.probe);
    for (probe, measured) in in_order.into_iter().zip(measured) {
        take(probe, measured, problems);
    }
}

/// Without the log's values nothing can be said about those that are missing.
fn give_up(probes: &mut [ProbeLine<'_>]) {
    for probe in probes.iter_mut().filter(|probe| probe.value == Entered::Nothing) {
        probe.value = Entered::Wrong;
    }
}

fn take<'a>(probe: &mut ProbeLine<'a>, measured: Measured<'a>, problems: &mut Vec<Diagnostic>) {
    match probe.value {
        Entered::Nothing => {
            probe.value = Entered::Value(measured.z);
            probe.value_at = (measured.line, measured.at);
        }
        Entered::Value(value) if (value - measured.z).abs() > SAME => {
            problems.push(probe.value_fault(&messages::VALUE_DIFFERS_FROM_LOG).with("measured", measured.z));
        }
        Entered::Value(_) | Entered::Wrong => {}
    }
}

fn read<'a>(log: Source<'a>, problems: &mut Vec<Diagnostic>) -> Vec<Measured<'a>> {
    let mut measured = Vec::new();
    let mut offset = 0.0;
    for line in lines(log) {
        for report in REPORT.captures_iter(line.content()) {
            if let Some(found) = report.name("offset") {
                offset = third(found.as_bytes()).unwrap_or(offset);
                continue;
            }
            let at = report.get_match().range();
            match height(&report) {
                Ok(z) => measured.push(Measured { line, at, z: z - offset }),
                Err(message) => {
                    problems.push(line.fault(message, at));
                    break;
                }
            }
        }
    }
    measured
}

/// The height in `x,y,z:1`.
fn height(report: &Captures<'_>) -> Result<f64, &'static Message> {
    let text = report.name("probe").map_or(&b""[..], |found| found.as_bytes());
    let colon = text.iter().rposition(|byte| *byte == b':').ok_or(&messages::BROKEN_LOG_LINE)?;
    let z = third(&text[..colon]).ok_or(&messages::BROKEN_LOG_LINE)?;
    match &text[colon + 1..] {
        b"1" => Ok(z),
        b"0" => Err(&messages::PROBE_FAILED),
        _ => Err(&messages::BROKEN_LOG_LINE),
    }
}

/// The third of some numbers with commas between; machines with more axes tell more.
fn third(text: &[u8]) -> Option<f64> {
    let numbers: Option<Vec<f64>> = text.split(|byte| *byte == b',').map(parse).collect();
    numbers?.get(2).copied()
}
