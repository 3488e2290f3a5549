//! Reads the file into which the user enters the measured values. (book: language/probes)

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::LazyLock;

use pathbuild_diagnostic::messages::probes as messages;
use pathbuild_diagnostic::{Diagnostic, Message};
use pathbuild_path::{Xy, parse_number};
use regex::bytes::{Captures, Regex};

use super::Source;
use super::lines::{Line, lines};
use super::table::ProbePoint;

/// A probe in the file.
#[derive(Debug)]
pub(super) struct ProbeLine<'a> {
    pub(super) line: Line<'a>,
    /// The number after #.
    pub(super) probe: u32,
    pub(super) place: ProbePoint,
    /// Position in the emitted drawing; missing in programs of the original tool and of old versions of pathbuild.
    pub(super) at: Option<Xy>,
    /// The expected height (th); missing in the older form.
    pub(super) height: Option<f64>,
    pub(super) value: Entered,
    /// Position of the value, present or missing: in this line, or in a line of a log.
    pub(super) value_at: (Line<'a>, Range<usize>),
}

/// What follows the `=`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Entered {
    Nothing,
    Value(f64),
    /// An error that has already been reported.
    Wrong,
}

/// The ASCII text may be surrounded by bytes of any code page.
static LINE: LazyLock<Regex> = LazyLock::new(|| {
    let number = r"\s*(-?[0-9]+(?:[.,][0-9]+)?)\s*";
    let at = format!(r"@\s*\[{number}\|{number}\]");
    let place = format!(r"\(\s*\[{number}\s{number}\](?:/L:.*)?/T={number}(?:{at}\s*)?\)");
    let older = &at;
    Regex::new(&format!(r"(?-u)^\s*(?:{place}|{older})\s*#([0-9]+)\s*=(.*)$")).expect("a constant pattern")
});

/// Reads the lines of probes in order; empty lines are skipped.
pub(super) fn read<'a>(values: Source<'a>, problems: &mut Vec<Diagnostic>) -> Vec<ProbeLine<'a>> {
    let mut found: Vec<ProbeLine<'_>> = Vec::new();
    let mut known: BTreeMap<u32, u32> = BTreeMap::new();
    for line in lines(values).filter(|line| !line.content().trim_ascii().is_empty()) {
        let Some(mut read) = LINE.captures(line.content()).and_then(|parts| probe_line(line, &parts)) else {
            problems.push(line.fault(&messages::NO_PROBE_LINE, 0..line.content().len()));
            continue;
        };
        let first = *known.entry(read.probe).or_insert(line.number);
        if first != line.number {
            let problem = line.fault(&messages::PROBE_TWICE, 0..line.content().len());
            problems.push(problem.with("probe", u64::from(read.probe)).with("first", u64::from(first)));
            read.value = Entered::Wrong;
        } else if read.value == Entered::Wrong {
            let entered = String::from_utf8_lossy(&line.content()[read.value_at.1.clone()]).into_owned();
            problems.push(read.value_fault(&messages::NOT_A_VALUE).quoting("found", entered));
        }
        found.push(read);
    }
    found
}

impl ProbeLine<'_> {
    /// Creates a diagnostic for the value.
    pub(super) fn value_fault(&self, message: &'static Message) -> Diagnostic {
        let (line, at) = &self.value_at;
        line.fault(message, at.clone()).with("probe", u64::from(self.probe))
    }
}

fn probe_line<'a>(line: Line<'a>, parts: &Captures<'_>) -> Option<ProbeLine<'a>> {
    let number = |index: usize| parts.get(index).and_then(|part| parse(part.as_bytes()));
    let (x, y) = number(1).zip(number(2)).or_else(|| number(6).zip(number(7)))?;
    let behind = parts.get(9)?;
    let start = behind.end() - behind.as_bytes().trim_ascii_start().len();
    let entered = behind.as_bytes().trim_ascii();
    let value = match parse(entered) {
        _ if entered.is_empty() => Entered::Nothing,
        Some(value) => Entered::Value(value),
        None => Entered::Wrong,
    };
    Some(ProbeLine {
        line,
        probe: str::from_utf8(&parts[8]).ok()?.parse().ok()?,
        place: [x, y],
        at: number(4).zip(number(5)).map(|(x, y)| Xy::new(x, y)),
        height: number(3),
        value,
        value_at: (line, start..start + entered.len()),
    })
}

/// Parses a number with a decimal point or comma.
pub(super) fn parse(text: &[u8]) -> Option<f64> {
    parse_number(str::from_utf8(text).ok()?)
}
