//! Takes measured values from the log of a sender: one `[PRB:x,y,z:1]` per probe, as reported by Grbl and similar controls.
//!
//! The values are in machine coordinates. If a preceding status report gives the workpiece offset (`WCO:x,y,z`), it is subtracted.
//! Otherwise machine zero must be workpiece zero, which the comparison with the drawn heights will reveal.

use std::sync::LazyLock;

use pathbuild_diagnostic::messages::probes as messages;
use pathbuild_diagnostic::{Diagnostic, Message};
use regex::bytes::{Captures, Regex};

use super::Source;
use super::scan::{Line, lines};
use super::values::{Entered, ProbeLine, parse};

/// Values that differ by no more than this, in mm, are considered equal: users enter three decimals.
const SAME: f64 = 0.0005;

static REPORT: LazyLock<Regex> = LazyLock::new(|| {
    Regex::new(r"(?-u)\[PRB:(?<probe>[^\]\n]*)\]|WCO:(?<offset>[-+0-9.,]*)").expect("a constant pattern")
});

/// A probing result.
#[derive(Debug)]
struct Measured<'a> {
    line: Line<'a>,
    at: std::ops::Range<usize>,
    z: f64,
}

/// Assigns the values of the log to the probes that have none, in the order of their numbers, which is that of the probing program.
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

/// Marks the missing values as faulty, because without the log nothing can be said about them.
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

/// The third of several comma-separated numbers; machines with more axes report more.
fn third(text: &[u8]) -> Option<f64> {
    let numbers: Option<Vec<f64>> = text.split(|byte| *byte == b',').map(parse).collect();
    numbers?.get(2).copied()
}
