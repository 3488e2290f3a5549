//! Tests lengths and times of drawn and of parsed programs.

use std::f64::consts::PI;

use pathbuild_gcode::dialect::Charset;
use pathbuild_gcode::dialect::Dialect::{self, LinuxCnc, Native, Xpertmill};
use pathbuild_gcode::interpret::{Options, interpret};
use pathbuild_gcode::native::{self, WriteOptions};
use pathbuild_gcode::statistics::{Summary, Tally, statistics};
use pathbuild_toolpath::{
    Correction, Count, Height, MoveClass, PlannedMove, Program, ProgramStep, Statistics, Xy,
};

/// Returns the lengths of milling, drilling and sweeps in a text.
fn lengths(text: &str, dialect: Dialect) -> [f64; 3] {
    let tally = tally(text, dialect);
    [tally.milling, tally.drilling, tally.rapid].map(|kind| kind.total.length)
}

fn tally(text: &str, dialect: Dialect) -> Tally {
    let read = interpret(format!("{text}\nM30\n").as_bytes(), dialect, &Options::default());
    Summary::of(&read.steps, dialect == Xpertmill).total
}

fn assert_lengths(text: &str, expected: [f64; 3]) {
    let found = lengths(&format!("G17 G21 G90 G94\n{text}"), LinuxCnc);
    let is_near = found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-6);
    assert!(is_near, "{text}: {found:?}, expected {expected:?}");
}

/// Start of a program after which X, Y and Z are known, so that the next move is the first one with a length.
const START: &str = "G0 X0 Y0\nG0 Z5\nF100\n";

#[test]
fn counting_begins_at_the_first_position_that_is_wholly_known() {
    assert_lengths("G0 Z5\nG0 X30\nG0 X0 Y0\nG0 X7", [0.0, 0.0, 7.0]);
    assert_lengths("G0 X0 Y0 Z5\nG0 X3 Y4", [0.0, 0.0, 5.0]);
    // The program never states Z.
    assert_lengths("G0 X0 Y0\nG0 X3 Y4", [0.0; 3]);
}

#[test]
fn counting_pauses_behind_a_position_that_is_not_known() {
    // G28 goes to the known position Z 8 first, then to the home position.
    assert_lengths(&format!("{START}G28 Z8\nG0 X50\nG0 Z5\nG0 X54"), [0.0, 0.0, 3.0 + 4.0]);
    assert_lengths(&format!("{START}G28\nG0 X0 Y0\nG0 Z5\nG0 Z6"), [0.0, 0.0, 1.0]);
    assert_lengths(&format!("{START}G53 G0 Z0\nG0 X50\nG1 Z5\nG1 X54"), [4.0, 0.0, 0.0]);
    assert_lengths(&format!("{START}G38.2 Z0\nG0 X50\nG0 Z5\nG0 X52"), [0.0, 0.0, 2.0]);
}

/// The machine may have moved the tool anywhere, so all three axes must be stated again, even with the same values.
#[test]
fn counting_pauses_behind_a_tool_change() {
    assert_lengths(&format!("{START}T1 M6\nG0 X0 Y0\nG0 Z5\nG0 Z6"), [0.0, 0.0, 1.0]);
    assert_lengths(&format!("{START}T1 M6\nG0 X40 Y0\nG0 X0\nG1 X9"), [0.0; 3]);
    assert_lengths(&format!("{START}T1 M6\nG0 X40 Y0\nG0 Z5\nG91\nG1 X9"), [9.0, 0.0, 0.0]);
    assert_lengths(&format!("{START}T1 M6\nG91\nG0 X40 Y1 Z1\nG1 X9"), [0.0; 3]);
    // Counting does not pause at T alone, nor at a layer of XpertMILL.
    assert_lengths(&format!("{START}T2\nG0 X6"), [0.0, 0.0, 6.0]);
    let layers = "G0 X0 Y0 Z5\nT5 M6\nG0 X6 Y0 Z5";
    assert_eq!(lengths(layers, Xpertmill)[2], 6.0);
}

#[test]
fn drilling_is_what_goes_less_than_a_two_thousandth_of_a_millimetre_in_the_plane() {
    assert_lengths(&format!("{START}G1 Z1"), [0.0, 4.0, 0.0]);
    assert_lengths(&format!("{START}G1 Z9"), [0.0, 4.0, 0.0]);
    let inside = lengths(&format!("G21 G90 G94 G17\n{START}G1 X0.00049 Z1"), LinuxCnc);
    assert!(inside[0] == 0.0 && (inside[1] - 4.0).abs() < 1e-6, "{inside:?}");
    let outside = lengths(&format!("G21 G90 G94 G17\n{START}G1 X0.00051 Z1"), LinuxCnc);
    assert!(outside[1] == 0.0 && (outside[0] - 4.0).abs() < 1e-6, "{outside:?}");
    // The limit applies to the distance in the plane, not to each axis.
    assert_lengths(&format!("{START}G1 X0.0003 Y0.0003 Z1"), [0.0, libm::hypot(4.0, 0.000_424_264), 0.0]);
    assert_lengths(&format!("{START}G1 X0.0004 Y0.0004 Z1"), [libm::hypot(4.0, 0.000_565_685), 0.0, 0.0]);
    // Rapid moves count as sweeps in any direction.
    assert_lengths(&format!("{START}G0 Z1\nG0 Z5"), [0.0, 0.0, 8.0]);
}

#[test]
fn slanted_moves_and_helices_count_in_space() {
    assert_lengths(&format!("{START}G1 X3 Y4 Z-7"), [13.0, 0.0, 0.0]);
    assert_lengths(&format!("{START}G0 X3 Y4 Z-7"), [0.0, 0.0, 13.0]);
    assert_lengths(&format!("{START}G2 X0 Y0 I5 Z2"), [libm::hypot(10.0 * PI, 3.0), 0.0, 0.0]);
    assert_lengths(&format!("{START}G3 X10 Y0 I5 Z2 P2"), [libm::hypot(15.0 * PI, 3.0), 0.0, 0.0]);
}

/// A cycle moves down and up again; its rapid moves count as sweeps.
#[test]
fn cycles_count_as_the_moves_that_they_stand_for() {
    assert_lengths(&format!("{START}G98 G81 X3 Y4 Z-1 R2 F100"), [0.0, 3.0, 5.0 + 3.0 + 6.0]);
    assert_lengths(&format!("{START}G98 G85 X3 Y4 Z-1 R2 F100"), [0.0, 3.0 + 3.0, 5.0 + 3.0 + 3.0]);
}

#[test]
fn probing_counts_nowhere() {
    let found = tally(&format!("G17 G21 G90 G94\n{START}G38.2 Z0\n"), LinuxCnc);
    assert_eq!((found.probing, found.sum(100.0).length, found.cutting().time), (1, 0.0, 0.0));
}

#[test]
fn times_are_those_of_counted_lengths() {
    let found = tally(&format!("G17 G21 G90 G94\n{START}G1 X30 F60\nG1 X0 F120\nG0 X50"), LinuxCnc);
    assert!((found.cutting().time - (30.0 / 60.0 + 30.0 / 120.0)).abs() < 1e-9);
    assert!((found.sum(500.0).time - found.cutting().time - 50.0 / 500.0).abs() < 1e-9);
}

/// Returns a program whose planned lengths differ from those of its moves.
fn drawn() -> Program {
    let height = |z| Height { z, at: Xy::origin() };
    let count = |class, feed| Count { class, length: 1000.0, feed };
    let step = |to, class, feed| ProgramStep::Move { to, count: count(class, feed) };
    let centre = Xy::new(-10.0, 0.0);
    let helix = PlannedMove::Arc {
        feed: 100.0,
        clockwise: true,
        centre,
        to: Xy::new(3.0, 4.0),
        z: height(2.0),
        is_spiral: false,
    };
    Program {
        path: "1234.1P".into(),
        sweep_height: 10.0,
        steps: vec![
            step(PlannedMove::Sweep { to: Xy::new(3.0, 4.0) }, MoveClass::Sweep, None),
            step(PlannedMove::Lift { z: height(6.0) }, MoveClass::Sweep, None),
            step(PlannedMove::Drill { feed: 50.0, z: height(4.0) }, MoveClass::Drilling, Some(50.0)),
            // The tool descends by a move that is planned as milling, like half circles without a radius.
            step(
                PlannedMove::Line { feed: 100.0, to: Xy::new(3.0, 4.0), z: height(3.0) },
                MoveClass::Milling,
                Some(100.0),
            ),
            step(helix, MoveClass::Milling, Some(100.0)),
        ],
        ..Program::default()
    }
}

#[test]
fn a_drawn_program_counts_its_own_moves() {
    let found = statistics(&drawn(), 1000.0);
    let milling = libm::hypot(20.0 * PI, 1.0);
    let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-3, "{found}, {expected}");
    near(found.milling.length, milling);
    near(found.drilling.length, 2.0 + 1.0);
    // The length contains the sweep, the move down, and the final lift to S0.
    near(found.sweeps.length, 5.0 + 4.0 + 8.0);
    near(found.milling.time, milling / 100.0);
    near(found.drilling.time, 2.0 / 50.0 + 1.0 / 100.0);
    near(found.sweeps.time, 17.0 / 1000.0);
    assert_eq!(found.commands, 6);
}

#[test]
fn a_compatible_program_has_the_planned_lengths() {
    let program = Program { compatible: true, ..drawn() };
    let found = statistics(&program, 1000.0);
    assert_eq!(found, Statistics::of_reference(&program, 1000.0));
    assert_eq!((found.milling.length, found.drilling.length), (2000.0, 1000.0));
}

/// The statistics in the comments of a program agree with those of its parsed text.
#[test]
fn a_programs_comments_are_what_its_text_comes_to() {
    let program = drawn();
    let options = WriteOptions {
        lang: pathbuild_diagnostic::Lang::En,
        charset: Charset::Ascii,
        rapid: 1000.0,
        correction: Correction::default(),
    };
    let text = native::write_program(&program, "", &options, usize::MAX).unwrap();
    let (own, read) = (statistics(&program, 1000.0), tally(&text, Native));
    for (own, read) in [(own.milling, read.milling), (own.drilling, read.drilling)] {
        assert!((own.length - read.total.length).abs() < 0.01 && (own.time - read.total.time).abs() < 1e-4);
    }
    assert!((own.sum().length - read.sum(1000.0).length).abs() < 0.01);
}
