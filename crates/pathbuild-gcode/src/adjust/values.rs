//! Reads the measured values from the file into which the user enters them, and from the log of a sender, which has one `[PRB:x,y,z:1]` per probe, as
//! reported by Grbl and similar controls. (book: language/probes)
//!
//! The values of a log are in machine coordinates. If a preceding status report gives the workpiece offset (`WCO:x,y,z`), it is subtracted. Otherwise
//! machine zero must be workpiece zero, which the comparison with the drawn heights will reveal.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::LazyLock;

use camino::Utf8Path;
use pathbuild_diagnostic::messages::probes as messages;
use pathbuild_diagnostic::{Diagnostic, Message, Point};
use pathbuild_path::{Xy, parse_number};
use regex::bytes::{self, Captures};

use super::Source;
use super::scan::{Line, lines};
use crate::native::{ProgramProbe, probe_entry};

/// A line of the file of values, which describes one probe.
#[derive(Debug)]
pub(super) struct ProbeLine<'a> {
    pub(super) line: Line<'a>,
    pub(super) probe: u32,
    /// Position in the coordinates of the drawing that contains the probe.
    pub(super) drawn_at: Xy,
    /// Position in the emitted drawing; missing in files of PathDxf2GCode and of old versions of pathbuild.
    pub(super) at: Option<Xy>,
    /// The expected height in mm, after `T=`; missing in the older form of the file.
    pub(super) height: Option<f64>,
    pub(super) value: EnteredValue,
    /// Position of the value, or of the place where it is missing: in this line, or in a line of a log.
    pub(super) value_at: (Line<'a>, Range<usize>),
}

/// The value after the `=` in a line of the file of values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum EnteredValue {
    Nothing,
    Value(f64),
    /// An error that has already been reported.
    Wrong,
}

/// Pattern of a line in the file of values. Bytes of any code page may surround the ASCII text that the pattern matches.
static VALUE_LINE: LazyLock<bytes::Regex> = LazyLock::new(|| {
    let number = r"\s*(-?[0-9]+(?:[.,][0-9]+)?)\s*";
    let at = format!(r"@\s*\[{number}\|{number}\]");
    let place = format!(r"\(\s*\[{number}\s{number}\](?:/L:.*)?/T={number}(?:{at}\s*)?\)");
    let older = &at;
    bytes::Regex::new(&format!(r"(?-u)^\s*(?:{place}|{older})\s*#([0-9]+)\s*=(.*)$"))
        .expect("a constant pattern")
});

/// Reads the file of values and returns its lines in order; empty lines are skipped.
pub(super) fn read<'a>(values: Source<'a>, problems: &mut Vec<Diagnostic>) -> Vec<ProbeLine<'a>> {
    let mut found: Vec<ProbeLine<'_>> = Vec::new();
    let mut known: BTreeMap<u32, u32> = BTreeMap::new();
    if values.bytes.contains(&0) {
        problems.push(Diagnostic::new(&messages::VALUES_IN_UTF_16).in_file(values.file));
        return found;
    }
    for line in lines(values).filter(|line| !line.content().trim_ascii().is_empty()) {
        let Some(mut read) = VALUE_LINE.captures(line.content()).and_then(|parts| probe_line(line, &parts))
        else {
            problems.push(line.fault(&messages::NO_PROBE_LINE, 0..line.content().len()));
            continue;
        };
        let first = *known.entry(read.probe).or_insert(line.number);
        if first != line.number {
            let problem = line.fault(&messages::PROBE_TWICE, 0..line.content().len());
            problems.push(problem.with("probe", u64::from(read.probe)).with("first", u64::from(first)));
            read.value = EnteredValue::Wrong;
        } else if read.value == EnteredValue::Wrong {
            let entered = String::from_utf8_lossy(&line.content()[read.value_at.1.clone()]).into_owned();
            problems.push(read.value_fault(&messages::NOT_A_VALUE).quoting("found", entered));
        }
        found.push(read);
    }
    found
}

/// Returns the message (PB605) about what would be lost if a file of measured values were written again; `None` if nothing was entered in it.
pub fn lost_values_message(values: Source<'_>) -> Option<&'static Message> {
    let mut problems = Vec::new();
    let lines = read(values, &mut problems);
    if problems.iter().any(hides_probes) {
        return Some(&messages::OTHER_LINES_PRESENT);
    }
    lines.iter().any(|line| line.value != EnteredValue::Nothing).then_some(&messages::VALUES_PRESENT)
}

/// Whether a problem of a file of values hides probes, so that probes which seem to be missing are not reported.
pub(super) fn hides_probes(problem: &Diagnostic) -> bool {
    [&messages::NO_PROBE_LINE, &messages::VALUES_IN_UTF_16].contains(&problem.message)
}

impl ProbeLine<'_> {
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
        _ if entered.is_empty() => EnteredValue::Nothing,
        Some(value) => EnteredValue::Value(value),
        None => EnteredValue::Wrong,
    };
    Some(ProbeLine {
        line,
        probe: str::from_utf8(&parts[8]).ok()?.parse().ok()?,
        drawn_at: Xy::new(x, y),
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

/// The probes listed in a program's header, by number. Programs of PathDxf2GCode list none.
pub(super) type ProbeTable = BTreeMap<u32, ProgramProbe>;

/// Reads the probes listed in a program's header. The first entry with a number applies.
pub(super) fn probe_table(program: &[u8]) -> ProbeTable {
    let mut table = ProbeTable::new();
    for (_, number, probe) in header_entries(program) {
        table.entry(number).or_insert(probe);
    }
    table
}

/// Returns the probes listed in the comments before the first block of a program, each with its line and its number.
pub(super) fn header_entries(program: &[u8]) -> impl Iterator<Item = (u32, u32, ProgramProbe)> {
    let lines = lines(Source { file: Utf8Path::new(""), bytes: program });
    lines.take_while(|line| is_header(line.content())).filter_map(|line| {
        let (number, probe) = entry_of_line(line.content())?;
        Some((line.number, number, probe))
    })
}

/// Whether a line can be part of the header, which ends with the first word of the program.
pub(super) fn is_header(line: &[u8]) -> bool {
    matches!(line.first(), None | Some(b'(' | b'%' | b';'))
}

pub(super) fn entry_of_line(line: &[u8]) -> Option<(u32, ProgramProbe)> {
    let comment = line.trim_ascii_end().strip_prefix(b"(")?.strip_suffix(b")")?;
    probe_entry(str::from_utf8(comment).ok()?)
}

/// Values that differ by no more than this, in mm, are considered equal: users enter three decimals.
const VALUE_TOLERANCE: f64 = 0.0005;

static LOG_REPORT: LazyLock<bytes::Regex> = LazyLock::new(|| {
    bytes::Regex::new(r"(?-u)\[PRB:(?<probe>[^\]\n]*)\]|WCO:(?<offset>[-+0-9.,]*)")
        .expect("a constant pattern")
});

#[derive(Debug)]
struct LoggedHeight<'a> {
    line: Line<'a>,
    at: Range<usize>,
    place: [f64; 3],
}

/// Assigns the results of a log, which must contain one per probe, to the probes in the order of their numbers: the probing program probes in this
/// order. A probe that already has a value keeps it, and a different result is an error.
pub(super) fn fill_from_log<'a>(
    probes: &mut [ProbeLine<'a>],
    values: Source<'_>,
    log: Source<'a>,
    problems: &mut Vec<Diagnostic>,
) {
    let before = problems.len();
    let measured = read_log(log, problems);
    if problems.len() > before {
        return mark_reported(probes);
    }
    if measured.len() != probes.len() {
        let problem = Diagnostic::new(&messages::LOG_COUNT).in_file(log.file).with("found", measured.len());
        let file = values.file.file_name().unwrap_or_default();
        problems.push(problem.quoting("file", file).with("expected", probes.len()));
        return mark_reported(probes);
    }
    let mut in_order: Vec<&mut ProbeLine<'_>> = probes.iter_mut().collect();
    in_order.sort_by_key(|probe| probe.probe);
    if let Some(problem) = misplaced_result(&in_order, &measured) {
        problems.push(problem);
        return mark_reported(probes);
    }
    for (probe, measured) in in_order.into_iter().zip(measured) {
        apply_logged_height(probe, measured, problems);
    }
}

/// Marks missing values as already reported, because the problem is the log and not each single value.
fn mark_reported(probes: &mut [ProbeLine<'_>]) {
    for probe in probes.iter_mut().filter(|probe| probe.value == EnteredValue::Nothing) {
        probe.value = EnteredValue::Wrong;
    }
}

fn apply_logged_height<'a>(
    probe: &mut ProbeLine<'a>,
    measured: LoggedHeight<'a>,
    problems: &mut Vec<Diagnostic>,
) {
    match probe.value {
        EnteredValue::Nothing => {
            probe.value = EnteredValue::Value(measured.place[2]);
            probe.value_at = (measured.line, measured.at);
        }
        EnteredValue::Value(value) if (value - measured.place[2]).abs() > VALUE_TOLERANCE => {
            let problem = probe.value_fault(&messages::VALUE_DIFFERS_FROM_LOG);
            problems.push(problem.with("measured", measured.place[2]));
        }
        EnteredValue::Value(_) | EnteredValue::Wrong => {}
    }
}

fn read_log<'a>(log: Source<'a>, problems: &mut Vec<Diagnostic>) -> Vec<LoggedHeight<'a>> {
    let mut measured = Vec::new();
    let mut offset = [0.0; 3];
    // The offset at the first result. The program is milled in a single coordinate system, so all heights must be measured in that system.
    let mut first_offset: Option<[f64; 3]> = None;
    for line in lines(log) {
        for report in LOG_REPORT.captures_iter(line.content()) {
            if let Some(found) = report.name("offset") {
                offset = first_three(found.as_bytes()).unwrap_or(offset);
                continue;
            }
            let at = report.get_match().range();
            match position(&report) {
                Ok(_) if first_offset.is_some_and(|first| first != offset) => {
                    problems.push(line.fault(&messages::LOG_ZERO_MOVED, at));
                    return measured;
                }
                Ok(machine) => {
                    first_offset = Some(offset);
                    let place = std::array::from_fn(|axis| machine[axis] - offset[axis]);
                    measured.push(LoggedHeight { line, at, place });
                }
                Err(message) => {
                    problems.push(line.fault(message, at));
                    break;
                }
            }
        }
    }
    measured
}

/// Reports the first result that was measured at a position other than its probe's. A displacement that all results share is ignored, because the
/// log may lack the offset of the workpiece. Probes whose position in the program is not stated are not compared.
fn misplaced_result(probes: &[&mut ProbeLine<'_>], measured: &[LoggedHeight<'_>]) -> Option<Diagnostic> {
    let mut common: Option<[f64; 2]> = None;
    probes.iter().zip(measured).find_map(|(probe, measured)| {
        let at = probe.at?;
        let [x, y, _] = measured.place;
        let [right, up] = *common.get_or_insert([x - at.x, y - at.y]);
        let is_there =
            (x - at.x - right).abs() <= PLACE_TOLERANCE && (y - at.y - up).abs() <= PLACE_TOLERANCE;
        (!is_there).then(|| {
            let problem = measured.line.fault(&messages::LOG_ELSEWHERE, measured.at.clone());
            let problem = problem.with("probe", u64::from(probe.probe)).with("found", Point::new(x, y));
            problem.with("expected", Point::new(at.x + right, at.y + up))
        })
    })
}

/// Distance in mm along each axis within which a result is accepted as measured at its probe: a machine stops at whole steps.
const PLACE_TOLERANCE: f64 = 0.1;

/// Parses the position in `x,y,z:1`.
fn position(report: &Captures<'_>) -> Result<[f64; 3], &'static Message> {
    let text = report.name("probe").map_or(&b""[..], |found| found.as_bytes());
    let colon = text.iter().rposition(|byte| *byte == b':').ok_or(&messages::BROKEN_LOG_LINE)?;
    let place = first_three(&text[..colon]).ok_or(&messages::BROKEN_LOG_LINE)?;
    match &text[colon + 1..] {
        b"1" => Ok(place),
        b"0" => Err(&messages::PROBE_FAILED),
        _ => Err(&messages::BROKEN_LOG_LINE),
    }
}

/// Parses comma-separated numbers and returns the first three, because machines with more axes report more; `None` if there are fewer, or if any is
/// not a number.
fn first_three(text: &[u8]) -> Option<[f64; 3]> {
    let numbers: Option<Vec<f64>> = text.split(|byte| *byte == b',').map(parse).collect();
    numbers?.first_chunk().copied()
}
