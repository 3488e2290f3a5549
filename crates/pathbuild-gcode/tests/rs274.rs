//! Our interpreter against LinuxCNC's own, `rs274`: the same moves, the same refusals.
//!
//! `tests/tools/fetch-rs274.sh DIR` unpacks it; `PATHBUILD_RS274=DIR` says where. Without it these tests skip with a message, unless
//! `PATHBUILD_REQUIRE` contains `rs274`.

mod common;

use std::path::{Path, PathBuf};
use std::process::Command;

use pathbuild_gcode::dialect::Dialect::LinuxCnc;
use pathbuild_gcode::interpret::{self, Action, Options, Pace, interpret};

/// Both print, or compute, in doubles; rs274 shows four decimals.
const PRINTED: f64 = 0.000_051;

/// One canonical call that moves or waits.
#[derive(Clone, Debug, PartialEq)]
enum Call {
    Rapid([f64; 3]),
    Feed([f64; 3], f64),
    /// Ends, centre in the plane, signed number of turns begun, feed.
    Arc([f64; 3], [f64; 2], i64, f64),
    Probe([f64; 3], f64),
    Dwell(f64),
    Tool(i64),
}

/// What rs274 makes of a program.
struct Oracle {
    calls: Vec<Call>,
    /// What it printed when it refused.
    refusal: Option<String>,
}

#[expect(
    clippy::disallowed_methods,
    clippy::print_stderr,
    reason = "tests ask the environment where their oracles are"
)]
fn rs274() -> Option<PathBuf> {
    let found = std::env::var("PATHBUILD_RS274").ok().map(|dir| Path::new(&dir).join("rs274"));
    let required =
        std::env::var("PATHBUILD_REQUIRE").is_ok_and(|names| names.split(',').any(|name| name == "rs274"));
    match found {
        Some(program) => {
            assert!(program.is_file(), "{} is missing", program.display());
            Some(program)
        }
        None if required => {
            panic!("PATHBUILD_REQUIRE has rs274, and PATHBUILD_RS274 is not set (tests/tools/fetch-rs274.sh)")
        }
        None => {
            eprintln!("skipped: PATHBUILD_RS274 is not set (tests/tools/fetch-rs274.sh)");
            None
        }
    }
}

fn ask(program: &Path, text: &str) -> Oracle {
    let file = tempfile::Builder::new().suffix(".ngc").tempfile().expect("a temporary file");
    std::io::Write::write_all(&mut file.as_file(), text.as_bytes()).expect("it can be written");
    let output = Command::new(program).arg(file.path()).output().expect("rs274 runs");
    let refusal = (!output.status.success()).then(|| String::from_utf8_lossy(&output.stderr).into_owned());
    Oracle { calls: calls_of(&String::from_utf8_lossy(&output.stdout)), refusal }
}

/// Reads rs274's canonical calls; lengths become millimetres in the coordinates of the first move.
fn calls_of(output: &str) -> Vec<Call> {
    let mut unit = 1.0;
    let (mut system, mut origin) = ([0.0; 3], [0.0; 3]);
    let mut base: Option<[f64; 3]> = None;
    let (mut feed, mut plane) = (0.0, [0, 1, 2]);
    let mut calls = Vec::new();
    for line in output.lines() {
        // `   12 N..... STRAIGHT_FEED(1.0000, ...)`, with the block number where there is one.
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

/// Our steps as calls.
fn our_calls(text: &str) -> Vec<Call> {
    let result = interpret(text.as_bytes(), LinuxCnc, &Options::default());
    let calls = result.steps.iter().filter_map(|step| match &step.action {
        Action::Move(it) => Some(match (it.pace, it.path) {
            (Pace::Rapid, _) => Call::Rapid(it.to.at),
            (Pace::Probe { feed, .. }, _) => Call::Probe(it.to.at, feed),
            (Pace::Feed(feed), interpret::Path::Line) => Call::Feed(it.to.at, feed),
            (Pace::Feed(feed), interpret::Path::Arc(arc)) => {
                let turns = i64::from(arc.extra_turns) + 1;
                Call::Arc(it.to.at, arc.centre, if arc.clockwise { -turns } else { turns }, feed)
            }
        }),
        Action::Dwell(seconds) => Some(Call::Dwell(*seconds)),
        Action::ChangeTool(tool) => Some(Call::Tool(i64::from(*tool))),
        _ => None,
    });
    without_standing(calls.collect())
}

/// Leaves out straight moves to where the tool is: some of them rs274 prints, and some it does not.
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

fn assert_same(program: &Path, name: &str, text: &str) {
    let oracle = ask(program, text);
    assert_eq!(oracle.refusal, None, "{name}");
    let ours = our_calls(text);
    for (index, (theirs, ours)) in oracle.calls.iter().zip(&ours).enumerate() {
        assert!(agree(theirs, ours), "{name}: move {index}: rs274 {theirs:?}, ours {ours:?}");
    }
    assert_eq!(oracle.calls.len(), ours.len(), "{name}: {:?}\n{:?}", oracle.calls.last(), ours.last());
    assert!(!ours.is_empty(), "{name} has no moves");
}

#[test]
fn programs_move_as_linuxcnc_moves_them() {
    let Some(rs274) = rs274() else { return };
    for (name, text) in [
        ("arcs", include_str!("programs/arcs.ngc")),
        ("cycles", include_str!("programs/cycles.ngc")),
        ("expressions", include_str!("programs/expressions.ngc")),
        ("offsets", include_str!("programs/offsets.ngc")),
        ("units", include_str!("programs/units.ngc")),
    ] {
        assert_same(&rs274, name, text);
        assert_eq!(
            interpret(text.as_bytes(), LinuxCnc, &Options::default())
                .problems
                .iter()
                .filter(|d| d.is_error())
                .count(),
            0,
            "{name}"
        );
    }
}

/// Lines that LinuxCNC refuses, each behind a fine beginning, and the names of our codes.
const REFUSED: &[(&str, &str)] = &[
    ("G1 X1", "missing-feed"),
    ("F100\nG94\nG1 X1", "missing-feed"),
    ("G93 G1 X1 F2\nX2", "missing-feed"),
    ("G38.2 Z-1", "missing-feed"),
    ("G80\nX1", "missing-word"),
    ("G0 G1 X1 F10", "conflicting-words"),
    ("G20 G21", "conflicting-words"),
    ("M3 M5", "conflicting-words"),
    ("M7 M8", "conflicting-words"),
    ("G81 X1 Z-2 R1 F10\nG82 X2 P1", "missing-word"),
    ("G83 X1 Z-2 R1 Q1 F10\nG73 X2 R1 Z-2", "missing-word"),
    ("G0 X1 X2", "conflicting-words"),
    ("G0 G92 X1", "conflicting-words"),
    ("G91 G53 G0 X1", "conflicting-words"),
    ("G53 G2 X1 I.5 F10", "conflicting-words"),
    ("G0 X1 I3", "unused-word"),
    ("G0 X1 R3", "unused-word"),
    ("G0 X1 Q3", "unused-word"),
    ("G2 X2 Y0 R0.9987 F10", "invalid-arc"),
    ("G2 X0 Y0 R1 F10", "invalid-arc"),
    ("G2 X2 Y0 F10", "invalid-arc"),
    ("G2 X2 Y0 I1 R1 F10", "invalid-arc"),
    ("G90.1 G2 X2 Y0 I1 F10", "missing-word"),
    ("G2 X2 Y0 I1 P0 F10", "value-out-of-range"),
    ("G0 X10 Y0\nG3 X0 Y10.029 I-10 F10", "arc-radii-differ"),
    ("G0 X10000 Y0\nG3 X0 Y10002.84 I-10000 F10", "arc-radii-differ"),
    ("G4", "missing-word"),
    ("G4 P-1", "value-out-of-range"),
    ("F-5", "value-out-of-range"),
    ("S-5", "value-out-of-range"),
    ("T1.5", "value-out-of-range"),
    ("G10 L2 P10 X1", "value-out-of-range"),
    ("G81 X1 Z-2 F10", "missing-word"),
    ("G81 X1 R1 F10", "missing-word"),
    ("G83 X1 Z-2 R1 F10", "missing-word"),
    ("G82 X1 Z-2 R1 F10", "missing-word"),
    ("G83 X1 Z-2 R1 Q0 F10", "value-out-of-range"),
    ("G81 X1 Z-2 R1 L0 F10", "value-out-of-range"),
    ("G81 X1 Z2 R1 F10", "value-out-of-range"),
    ("G92", "missing-word"),
    ("G12 X1", "unknown-word"),
    ("G38.6 X1", "unknown-word"),
    ("M12", "unknown-word"),
    ("X[1/0]", "cannot-evaluate"),
    ("X[SQRT[0-1]]", "cannot-evaluate"),
    ("X[ACOS[2]]", "cannot-evaluate"),
    ("X[LN[0]]", "cannot-evaluate"),
    ("X#<never>", "cannot-evaluate"),
    ("X#0", "cannot-evaluate"),
    ("#5603=1", "cannot-evaluate"),
    ("X[1+]", "invalid-expression"),
    ("X[1", "invalid-expression"),
    ("X[SIN 1]", "invalid-expression"),
    ("X[ATAN[1]]", "invalid-expression"),
    ("#1", "invalid-expression"),
    ("X1.2.3", "invalid-word"),
    ("XY1", "invalid-word"),
    ("X1 (a (b)", "invalid-comment"),
    ("X1 (a", "invalid-comment"),
    ("?", "unknown-character"),
];

#[test]
fn what_linuxcnc_refuses_is_an_error_here() {
    let rs274 = rs274();
    for (lines, name) in REFUSED {
        let text = format!("G17 G21 G90 G94 G54\nG0 X0 Y0 Z5\n{lines}\nM2\n");
        let faults = common::faults(LinuxCnc, &text);
        assert!(faults.iter().any(|fault| fault.ends_with(name)), "{lines:?} gives {faults:?}");
        if let Some(rs274) = &rs274 {
            let oracle = ask(rs274, &text);
            assert!(oracle.refusal.is_some(), "rs274 takes {lines:?}");
        }
    }
}

/// Lines that are odd and that LinuxCNC takes.
const TAKEN: &[&str] = &[
    "g0 x 1 0 y +0.5",
    "G2 X2 Y0 R0.9988 F10",
    "G0 X10 Y0\nG3 X0 Y10.028 I-10 F10",
    "G2 I1 F10",
    "G90.1 G2 X2 Y0 I1 J0 F10",
    "G0 X-[1+2] Y-#1 Z[-SIN[30]]",
    "#1=2 #2=#1\nG0 X#2",
    "N10 G0 X1",
    "N56.78 G0 X1",
    "G0 G92.1 X1",
    "G0 X1 ; (not closed",
    "M6",
    "G10 L20 P1 X5\nG0 X1",
    "G81 X1 Z-2 R1 F10\nX2\nG80",
    "G0 X[1 EQ 1.0000005] Y[2 GE 3]",
    "G1 F100 X1 M5",
];

#[test]
fn what_linuxcnc_takes_is_no_error_here() {
    let rs274 = rs274();
    for lines in TAKEN {
        let text = format!("G17 G21 G90 G94 G54\nG0 X0 Y0 Z5\n{lines}\nM2\n");
        let result = interpret(text.as_bytes(), LinuxCnc, &Options::default());
        assert!(
            !result.problems.iter().any(pathbuild_diagnostic::Diagnostic::is_error),
            "{lines:?}: {:?}",
            common::faults(LinuxCnc, &text)
        );
        if let Some(rs274) = &rs274 {
            assert_same(rs274, lines, &text);
        }
    }
}

#[test]
fn recorded_programs_move_as_linuxcnc_moves_them() {
    let Some(rs274) = rs274() else { return };
    for name in ["drill", "helix", "bars", "probing"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/programs/native/{name}.gcode"));
        #[expect(clippy::disallowed_methods, reason = "a fixture")]
        let text = std::fs::read_to_string(path).expect("the fixture");
        // LinuxCNC forgets the feed at G94, so it is said again behind it.
        assert_same(&rs274, name, &text.replace(" G94\n", " G94\nF150\n"));
    }
}
