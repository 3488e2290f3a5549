//! Tests which programs match their drawing. (book: program/reading, `verify --against`)

mod common;

use common::fault_text;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_gcode::dialect::Dialect::{self, Native, Xpertmill};
use pathbuild_gcode::interpret::{Options, interpret};
use pathbuild_gcode::verify::{ComparisonResult, DrawingComparison, ExpectedProgram, PostWords, ToolUse};
use pathbuild_motion::{Coolant, Position};

const FINE: [&str; 0] = [];

/// Height of S0 in all programs, in mm.
const CLEARANCE: f64 = 5.0;

/// Returns the differences between a program and a drawing. `drawn` are the drawing's moves as G-code, beginning above the zero of the path.
fn differences(dialect: Dialect, program: &str, drawn: &str) -> Vec<String> {
    differences_with_pecks(dialect, program, drawn, None)
}

/// Like [`differences`], for holes that are drilled in pecks of a depth in mm.
fn differences_with_pecks(dialect: Dialect, program: &str, drawn: &str, peck: Option<f64>) -> Vec<String> {
    agreement(dialect, program, drawn, peck, ToolUse::default()).differences.iter().map(fault_text).collect()
}

fn agreement(
    dialect: Dialect,
    program: &str,
    drawn: &str,
    peck: Option<f64>,
    tool: ToolUse,
) -> ComparisonResult {
    let drawn = format!("G17 G21 G90 G94\nG0 X0 Y0 Z5\n{drawn}\nM30\n");
    let moves = interpret(drawn.as_bytes(), Native, &Options::default()).moves();
    let program = format!("{program}\nM30\n");
    let words = PostWords::of_programs([&program], dialect);
    let drawn = ExpectedProgram {
        moves: moves.into_iter().skip(1),
        pecks: vec![(0, peck)],
        start: Position::known(0.0, 0.0, CLEARANCE),
        clearance: CLEARANCE,
        is_probing: false,
        tool,
        number: None,
        spin_up: 0.0,
    };
    let mut comparison = DrawingComparison::new(drawn, dialect, &words);
    for step in &interpret(program.as_bytes(), dialect, &Options::default()).steps {
        comparison.step(step);
    }
    comparison.finish()
}

/// Coolant that the configuration does not mention is not compared, which the result says.
#[test]
fn coolant_is_compared_if_it_is_known() {
    let program = |coolant: &str| {
        format!("G17 G21 G40 G49 G80 G90 G94\nG0 Z5\nG0 X0 Y0\n{coolant}\nG1 Z0 F100\nG0 Z5\nM9")
    };
    let compared = |coolant: Option<Coolant>, words: &str| {
        let tool = ToolUse { coolant, ..ToolUse::default() };
        let found = agreement(Dialect::LinuxCnc, &program(words), "G1 Z0 F100\nG0 Z5", None, tool);
        let differs = found.differences.iter().any(|it| it.message == &say::COOLANT_DIFFERS);
        (differs, found.has_uncompared_coolant)
    };
    assert_eq!(compared(Some(Coolant::FLOOD), "M8"), (false, false));
    assert_eq!(compared(Some(Coolant::OFF), "M8"), (true, false));
    assert_eq!(compared(None, "M8"), (false, true));
    assert_eq!(compared(None, "M9"), (false, false));
}

#[test]
fn a_program_pauses_only_above_the_material() {
    let paused_at = |height: &str| {
        let program = format!("G0 {height}\nM0\nG0 X0 Y0 Z5");
        let found = differences(Native, &format!("G17 G21 G90 G94 F100\nT1\n{program}"), "");
        found.contains(&"4 moves-differ".to_owned())
    };
    assert!(!paused_at("Z5"));
    assert!(!paused_at("Z4.998"));
    assert!(paused_at("Z4.997"));
    assert!(!paused_at("X0"), "the height is unknown");
}

/// Returns the differences of a program with chords from a drawn helix, for a control that supports no helices. The helix has this radius and begins
/// at (radius, 0); `ends` are the directions and heights at which the chords end.
fn chords(radius: f64, [degrees, depth]: [f64; 2], ends: &[[f64; 2]]) -> Vec<String> {
    let place = |degrees: f64| {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        format!("X{:.6} Y{:.6}", radius * cos, radius * sin)
    };
    let start = format!("G0 Z5\nG0 {}\nG1 Z0 F100\n", place(0.0));
    let lines = ends.iter().map(|[degrees, depth]| format!("G1 {} Z{depth} F100\n", place(*degrees)));
    let program = format!("{start}{}G0 Z5", lines.collect::<String>());
    let helix = format!("G3 {} Z{depth} I{:.6} J0", place(degrees), -radius);
    differences(Xpertmill, &program, &format!("{start}{helix}\nG0 Z5"))
}

/// A chord of a circle of 10 mm whose middle is 0.01 mm from the circle covers 5.125 degrees.
#[test]
fn chords_stay_within_a_hundredth_of_their_helix() {
    assert_eq!(chords(10.0, [5.12, -1.0], &[[5.12, -1.0]]), FINE);
    assert_eq!(chords(10.0, [5.14, -1.0], &[[5.14, -1.0]]), ["4 moves-differ"]);
    assert_eq!(chords(10.0, [5.14, -1.0], &[[2.57, -0.5], [5.14, -1.0]]), FINE);
}

/// A circle of 0.005 mm is within 0.01 mm of its diameter, but a chord does not replace it.
#[test]
fn a_chord_replaces_less_than_half_a_turn() {
    assert_eq!(chords(0.005, [270.0, -3.0], &[[90.0, -1.0], [180.0, -2.0], [270.0, -3.0]]), FINE);
    assert_eq!(chords(0.005, [270.0, -3.0], &[[180.0, -2.0], [270.0, -3.0]]), ["4 moves-differ"]);
}

/// A helix of 10 mm falls by 5 mm in 5 degrees, at 5.73 mm per mm, so its height is known to 0.0202 mm.
#[test]
fn heights_of_chords_are_those_of_their_places_on_a_steep_helix() {
    let middle = |depth: f64| chords(10.0, [5.0, -5.0], &[[2.5, depth], [5.0, -5.0]]);
    assert_eq!(middle(-2.5), FINE);
    assert_eq!(middle(-2.52), FINE);
    assert_eq!(middle(-2.48), FINE);
    assert_eq!(middle(-2.5205), ["4 moves-differ"]);
    assert_eq!(middle(-2.4795), ["4 moves-differ"]);
}

/// Returns the differences of a program that drills a hole from Z2 to Z-1 with these moves.
fn drilled(moves: &str) -> Vec<String> {
    let program = format!("G17 G21 G40 G49 G80 G90 G94\nG0 Z5\nG0 X3 Y0\nG0 Z2\n{moves}\nG0 Z5");
    differences(Dialect::LinuxCnc, &program, "G0 X3 Y0\nG0 Z2\nG1 Z-1 F100\nG0 Z5")
}

#[test]
fn a_hole_may_be_drilled_in_pecks() {
    assert_eq!(drilled("G1 Z-1 F100"), FINE);
    assert_eq!(drilled("G1 Z1 F100\nG0 Z2\nG0 Z1.01\nG1 Z0\nG0 Z5\nG0 Z0.3\nG1 Z-1"), FINE);
    assert_eq!(drilled("G1 Z1 F100\nG1 Z-1"), FINE);
}

#[test]
fn pecks_stay_in_the_hole_and_reach_its_bottom() {
    let differs = |moves: &str| assert_ne!(drilled(moves), FINE, "{moves}");
    differs("G1 Z1 F100\nG0 Z2\nG0 Z0.9\nG1 Z-1");
    differs("G1 Z1 F100\nG0 Z2\nG0 X3.01\nG0 X3\nG0 Z1.1\nG1 Z-1");
    differs("G1 Z1 F100\nG0 Z2\nG0 Z1.1\nG1 Z-0.9");
    differs("G1 Z1 F100\nG0 Z2\nG0 Z1.1\nG1 Z-1.1");
    differs("G1 Z1 F100\nG0 Z2\nG0 Z1.1\nG1 Z-1 F200");
    differs("G1 Z1 F100\nG0 Z5");
}

/// The hole is 4 mm deep, from Z1 to Z-3.
#[test]
fn holes_with_c_are_drilled_in_pecks() {
    let drilled = |hole: &str, peck: Option<f64>| {
        let head = "G17 G21 G90 G94\nG0 Z5\nG0 X0 Y0\nG0 X9 Y0";
        let drawn = "G0 X9 Y0\nG0 Z1\nG1 Z-3 F100\nG0 Z5";
        let cycle = hole.starts_with("G98").then(|| format!("{head}\n{hole}\nG80"));
        let program = cycle.unwrap_or_else(|| format!("{head}\nG0 Z1\n{hole}\nG0 Z5"));
        let mut found = differences_with_pecks(Dialect::Rs274, &program, drawn, peck);
        found.retain(|fault| fault.ends_with("moves-differ"));
        found.len()
    };
    let by_hand = |first: &str, gap: &str| format!("G1 Z{first} F100\nG0 Z{gap}\nG0 Z{first}\nG1 Z-3");
    assert_eq!(drilled("G1 Z-3 F100", None), 0);
    assert_eq!(drilled("G1 Z-3 F100", Some(4.0)), 0);
    assert_eq!(drilled("G1 Z-3 F100", Some(3.9)), 1);
    assert_eq!(drilled("G1 Z-1 F100\nG1 Z-3", Some(2.0)), 1, "the tool does not leave the hole");
    assert_eq!(drilled(&by_hand("-1", "1"), Some(2.0)), 0);
    assert_eq!(drilled(&by_hand("-1.01", "1"), Some(2.0)), 1);
    assert_eq!(drilled(&by_hand("-1", "-1"), Some(2.0)), 1, "the tool does not rise");
    assert_eq!(drilled(&by_hand("-1", "0.9"), Some(2.0)), 1, "the tool rises inside the hole");
    assert_eq!(drilled("G98 G83 X9 Y0 Z-3 R1 Q2 F100", Some(2.0)), 0);
    assert_eq!(drilled("G98 G83 X9 Y0 Z-3 R1 Q3 F100", Some(2.0)), 1);
    assert_eq!(drilled("G98 G81 X9 Y0 Z-3 R1 F100", Some(2.0)), 1);
    assert_eq!(drilled("G98 G83 X9 Y0 Z-3 R1 Q4 F100", Some(4.0)), 0);
    assert_eq!(drilled("G98 G83 X9 Y0 Z-3 R1 Q1.3333333333 F100", Some(2.0)), 0, "the last peck is nothing");
    assert_eq!(drilled("G98 G83 X9 Y0 Z-3 R1 Q1.3333333333 F100", None), 0);
}
