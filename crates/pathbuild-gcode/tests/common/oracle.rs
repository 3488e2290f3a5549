//! Uses LinuxCNC's own interpreter, `rs274`, as an oracle to compare with ours.
//!
//! `tests/tools/fetch-rs274.sh DIR` unpacks it, and `PATHBUILD_RS274=DIR` tells where it is. Without it these tests are skipped with a message,
//! unless `PATHBUILD_REQUIRE` contains `rs274`.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{Options, interpret};
use pathbuild_motion as motion;
use pathbuild_motion::{Action, Pace};

/// Tolerance of the comparison: both interpreters calculate with doubles, but rs274 prints four decimals.
const PRINTED: f64 = 0.000_051;

/// A canonical call of rs274 that moves or dwells.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Call {
    Rapid([f64; 3]),
    Feed([f64; 3], f64),
    /// An arc: end, centre in the plane, signed number of turns begun, feed.
    Arc([f64; 3], [f64; 2], i64, f64),
    Probe([f64; 3], f64),
    Dwell(f64),
    Tool(i64),
}

/// The result of rs274 for a program.
pub(crate) struct Oracle {
    pub(crate) calls: Vec<Call>,
    /// Output of rs274 if it rejected the program.
    pub(crate) refusal: Option<String>,
}

#[expect(clippy::disallowed_methods, reason = "tests ask the environment where their oracles are")]
pub(crate) fn rs274() -> Option<PathBuf> {
    let Ok(dir) = std::env::var("PATHBUILD_RS274") else {
        pathbuild_testkit::skip("rs274", "PATHBUILD_RS274 is not set (tests/tools/fetch-rs274.sh)");
        return None;
    };
    let program = Path::new(&dir).join("rs274");
    assert!(program.is_file(), "{} is missing", program.display());
    Some(program)
}

pub(crate) fn ask(program: &Path, text: &str) -> Oracle {
    let output = run(program, text);
    let refusal = (!output.status.success()).then(|| String::from_utf8_lossy(&output.stderr).into_owned());
    Oracle { calls: calls_of(&String::from_utf8_lossy(&output.stdout)), refusal }
}

/// Runs several programs in one process of rs274, because starting it costs more CPU time than reading a program. The state that one program has set
/// is reset before the next. If the programs do not begin and end alike, or if one of them is refused, each is run by itself.
#[allow(dead_code, reason = "not every test that has this oracle asks for many programs")]
pub(crate) fn ask_all(program: &Path, texts: &[String]) -> Vec<Oracle> {
    let by_itself = || texts.iter().map(|text| ask(program, text)).collect();
    let parts: Vec<(String, Vec<&str>)> = texts.iter().map(|text| without_frame(text)).collect();
    let [(_, frame), ..] = parts.as_slice() else { return Vec::new() };
    if parts.iter().any(|(_, other)| other != frame) {
        return by_itself();
    }
    let (head, foot) = frame.split_at(usize::from(frame.first() == Some(&"%")));
    let bodies: Vec<&str> = parts.iter().map(|(body, _)| body.as_str()).collect();
    let joined = format!("{}\n{}\n{}\n", head.join("\n"), bodies.join(RESET), foot.join("\n"));
    let output = run(program, &joined);
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    let found: Vec<&str> = printed.split("MESSAGE(\"begins\")").collect();
    if !output.status.success() || found.len() != texts.len() {
        return by_itself();
    }
    let calls = |part: &&str| calls_of(part.split("MESSAGE(\"ends\")").next().unwrap_or_default());
    found.iter().map(calls).map(|calls| Oracle { calls, refusal: None }).collect()
}

/// The lines that reset rs274 to its state at the beginning.
const RESET: &str = "(MSG,ends)
G21 G17 G90 G94 G91.1 G97 G98 G54 G40 G49 G64 G80
G92.1
M5 M9
T0 M6
F0 S0
G0 X0 Y0 Z0
G80
(MSG,begins)
";

/// Splits a program into its text and the lines that begin and end it. Block numbers are removed from these lines.
fn without_frame(text: &str) -> (String, Vec<&str>) {
    let is_frame = |line: &&str| matches!(without_number(line), "%" | "M30" | "M2" | "M02");
    let frame = text.lines().filter(is_frame).map(without_number).collect();
    let body = text.lines().filter(|line| !is_frame(line)).flat_map(|line| [line, "\n"]).collect();
    (body, frame)
}

/// Returns a line without its block number.
fn without_number(line: &str) -> &str {
    let line = line.trim();
    let rest = line.strip_prefix('N').map(|rest| rest.trim_start_matches(|c: char| c.is_ascii_digit()));
    rest.unwrap_or(line).trim()
}

fn run(program: &Path, text: &str) -> Output {
    let file = tempfile::Builder::new().suffix(".ngc").tempfile().expect("a temporary file");
    std::io::Write::write_all(&mut file.as_file(), text.as_bytes()).expect("it can be written");
    Command::new(program).arg(file.path()).output().expect("rs274 runs")
}

/// Returns the canonical calls that rs274 prints for a program, which may be any bytes, with a tool table; `None` if it rejects the program.
#[allow(dead_code, reason = "not every test that has this oracle asks for its own words")]
pub(crate) fn output(program: &Path, tools: &Path, text: &[u8]) -> Option<String> {
    let file = tempfile::Builder::new().suffix(".ngc").tempfile().expect("a temporary file");
    std::io::Write::write_all(&mut file.as_file(), text).expect("it can be written");
    let output = Command::new(program).arg("-t").arg(tools).arg(file.path()).output().expect("rs274 runs");
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Parses the canonical calls of rs274. Lengths are converted to millimetres in the coordinates of the first move.
fn calls_of(output: &str) -> Vec<Call> {
    let mut unit = 1.0;
    let (mut system, mut origin) = ([0.0; 3], [0.0; 3]);
    let mut base: Option<[f64; 3]> = None;
    let (mut feed, mut plane) = (0.0, [0, 1, 2]);
    let mut calls = Vec::new();
    for line in output.lines() {
        // A line has the form `   12 N..... STRAIGHT_FEED(1.0000, ...)`, with the block number if there is one.
        let Some((front, arguments)) = line.split_once('(') else { continue };
        let name = front.rsplit(' ').next().unwrap_or_default();
        let words: Vec<&str> = arguments.trim_end_matches(')').split(',').map(str::trim).collect();
        let numbers: Vec<f64> = words.iter().map(|word| word.parse().unwrap_or(f64::NAN)).collect();
        let mut place = |at: [f64; 3]| {
            let sum: [f64; 3] = std::array::from_fn(|axis| system[axis] + origin[axis]);
            let base = *base.get_or_insert(sum);
            std::array::from_fn::<f64, 3, _>(|axis| at[axis] * unit + sum[axis] - base[axis])
        };
        match name {
            "USE_LENGTH_UNITS" => unit = if words[0].ends_with("INCHES") { 25.4 } else { 1.0 },
            "SET_G5X_OFFSET" => system = [numbers[1], numbers[2], numbers[3]].map(|offset| offset * unit),
            "SET_G92_OFFSET" => origin = [numbers[0], numbers[1], numbers[2]].map(|offset| offset * unit),
            "SET_FEED_RATE" => feed = numbers[0] * unit,
            "SELECT_PLANE" => {
                plane = match words[0] {
                    "CANON_PLANE_XZ" => [2, 0, 1],
                    "CANON_PLANE_YZ" => [1, 2, 0],
                    _ => [0, 1, 2],
                }
            }
            "STRAIGHT_TRAVERSE" => calls.push(Call::Rapid(place([numbers[0], numbers[1], numbers[2]]))),
            "STRAIGHT_FEED" => calls.push(Call::Feed(place([numbers[0], numbers[1], numbers[2]]), feed)),
            "STRAIGHT_PROBE" => calls.push(Call::Probe(place([numbers[0], numbers[1], numbers[2]]), feed)),
            "ARC_FEED" => {
                let mut end = [0.0; 3];
                let mut middle = [0.0; 3];
                for (slot, (to, centre)) in [(0, 2), (1, 3), (5, 5)].into_iter().enumerate() {
                    end[plane[slot]] = numbers[to];
                    middle[plane[slot]] = numbers[centre];
                }
                let middle = place(middle);
                #[expect(clippy::cast_possible_truncation, reason = "a small whole number")]
                let turns = numbers[4] as i64;
                calls.push(Call::Arc(place(end), [middle[plane[0]], middle[plane[1]]], turns, feed));
            }
            "DWELL" => calls.push(Call::Dwell(numbers[0])),
            #[expect(clippy::cast_possible_truncation, reason = "a small whole number")]
            "CHANGE_TOOL" => calls.push(Call::Tool(numbers[0] as i64)),
            _ => {}
        }
    }
    without_standing(calls)
}

pub(crate) fn our_calls(text: &str, dialect: Dialect) -> Vec<Call> {
    let result = interpret(text.as_bytes(), dialect, &Options::default());
    let calls = result.steps.iter().filter_map(|step| match &step.action {
        Action::Move(it) => Some(match (it.pace, it.shape) {
            (Pace::Rapid, _) => Call::Rapid(it.to.at),
            (Pace::Probe { feed, .. }, _) => Call::Probe(it.to.at, feed),
            (Pace::Feed(feed), motion::MoveShape::Line) => Call::Feed(it.to.at, feed),
            (Pace::Feed(feed), motion::MoveShape::Arc(arc)) => {
                let turns = i64::from(arc.extra_turns) + 1;
                Call::Arc(it.to.at, arc.centre, if arc.clockwise { -turns } else { turns }, feed)
            }
        }),
        Action::Dwell(seconds) => Some(Call::Dwell(*seconds)),
        Action::ChangeTool(tool) => Some(Call::Tool(i64::from(tool.unwrap_or(0)))),
        _ => None,
    });
    without_standing(calls.collect())
}

/// Omits straight moves to the current position, which rs274 prints only in some cases.
fn without_standing(calls: Vec<Call>) -> Vec<Call> {
    let mut here = [0.0; 3];
    calls
        .into_iter()
        .filter(|call| match call {
            Call::Rapid(to) | Call::Feed(to, _) => {
                let before = std::mem::replace(&mut here, *to);
                before.iter().zip(to).any(|(a, b)| (a - b).abs() > PRINTED)
            }
            Call::Arc(to, ..) | Call::Probe(to, _) => {
                here = *to;
                true
            }
            Call::Dwell(_) | Call::Tool(_) => true,
        })
        .collect()
}

fn agree(theirs: &Call, ours: &Call) -> bool {
    let close = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < PRINTED * 26.0);
    match (theirs, ours) {
        (Call::Rapid(a), Call::Rapid(b)) => close(a, b),
        (Call::Feed(a, f), Call::Feed(b, g)) | (Call::Probe(a, f), Call::Probe(b, g)) => {
            close(a, b) && (f - g).abs() < 0.01
        }
        (Call::Arc(a, c, n, f), Call::Arc(b, d, m, g)) => {
            close(a, b) && close(c, d) && n == m && (f - g).abs() < 0.01
        }
        (Call::Dwell(a), Call::Dwell(b)) => close(&[*a], &[*b]),
        (a, b) => a == b,
    }
}

/// Returns the first difference between rs274's reading of a program and ours, or `None` if they agree and the program moves at all. rs274 may get
/// another text (`theirs`) with the same meaning.
#[allow(dead_code, reason = "not every test that has this oracle asks for single programs")]
pub(crate) fn difference(program: &Path, theirs: &str, ours: &str, dialect: Dialect) -> Option<String> {
    difference_from(&ask(program, theirs), ours, dialect)
}

/// Like [`difference`], for a program that rs274 has read already.
pub(crate) fn difference_from(oracle: &Oracle, ours: &str, dialect: Dialect) -> Option<String> {
    if let Some(refusal) = &oracle.refusal {
        return Some(format!("rs274 refuses it: {refusal}"));
    }
    let ours = our_calls(ours, dialect);
    for (index, (theirs, ours)) in oracle.calls.iter().zip(&ours).enumerate() {
        if !agree(theirs, ours) {
            return Some(format!("move {index}: rs274 {theirs:?}, ours {ours:?}"));
        }
    }
    if oracle.calls.len() != ours.len() {
        return Some(format!("{} moves, ours {}: {:?}", oracle.calls.len(), ours.len(), ours.last()));
    }
    ours.is_empty().then(|| "it has no moves".to_owned())
}
