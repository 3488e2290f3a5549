//! Tests which ways through the air a program may use instead of those of the job.

use pathbuild_gcode::dialect::Dialect::LinuxCnc;
use pathbuild_gcode::interpret::{Options, interpret};
use pathbuild_gcode::verify::Tolerance;
use pathbuild_motion::Move;

use super::check;

/// Height above everything, in mm.
const CLEARANCE: f64 = 20.0;

/// Value of the last digit; a way may deviate by two roundings of it.
const DIGIT: f64 = 0.001;

fn moves(program: &str) -> Vec<(u32, Move)> {
    interpret(program.as_bytes(), LinuxCnc, &Options::default()).moves()
}

/// Two cuts of 10 mm at Z0, the second from (X50, Y0), with the given ways to the first, between them, and away.
fn program([to, between, away]: [&str; 3]) -> String {
    let line = |words: &str| words.replace(", ", "\n") + "\n";
    format!("G21 G90 G17 G94\n{}G1 Z0 F100\nX10\n{}G1 Z0\nX60\n{}M2\n", line(to), line(between), line(away))
}

/// After the first cut up to Z10, to X30, up to Z12, to X50, down to Z5; after the second up to Z20, to X80.
const JOB: [&str; 3] = ["G0 Z20, G0 X0 Y0, G0 Z5", "G0 Z10, G0 X30, G0 Z12, G0 X50, G0 Z5", "G0 Z20, G0 X80"];

#[track_caller]
fn is_allowed(ways: [&str; 3]) -> bool {
    let check = |ways| {
        check(&moves(&program(ways)), &moves(&program(JOB)), CLEARANCE, &Tolerance::of_decimals(3)).is_ok()
    };
    assert!(check(JOB), "the job itself");
    check(ways)
}

/// With a different way from the first cut to the second.
#[track_caller]
fn may_go(between: &str) -> bool {
    is_allowed([JOB[0], between, JOB[2]])
}

#[test]
fn a_way_may_be_higher_or_leave_out_steps() {
    assert!(may_go("G0 Z20, G0 X50, G0 Z5"));
    assert!(may_go("G0 Z12, G0 X50, G0 Z5"));
    assert!(may_go("G0 Z12, G0 X20, G0 X45, G0 X50, G0 Z5"));
    // Above the clearance plane there is no material.
    assert!(may_go("G0 Z20, G0 X20 Y30, G0 X50 Y0, G0 Z5"));
    assert!(!may_go("G0 Z19.9, G0 X20 Y30, G0 X50 Y0, G0 Z5"));
}

#[test]
fn a_way_runs_nowhere_below_the_jobs() {
    let low = 10.0 - DIGIT;
    assert!(may_go(&format!("G0 Z{:.4}, G0 X30, G0 Z12, G0 X50, G0 Z5", low + DIGIT / 10.0)));
    assert!(!may_go(&format!("G0 Z{:.4}, G0 X30, G0 Z12, G0 X50, G0 Z5", low - DIGIT / 10.0)));
    // Between X30 and X50 the job is at Z12.
    assert!(!may_go("G0 Z11.9, G0 X50, G0 Z5"));
    assert!(!may_go("G0 Z10, G0 X50 Z12, G0 Z5"));
    assert!(may_go("G0 Z10, G0 X30 Z12, G0 X50, G0 Z5"));
}

#[test]
fn a_way_runs_nowhere_beside_the_jobs() {
    assert!(!may_go("G0 Z12, G0 X30 Y0.1, G0 X50 Y0, G0 Z5"));
    assert!(may_go(&format!("G0 Z12, G0 X30 Y{:.4}, G0 X50 Y0, G0 Z5", 0.9 * DIGIT)));
    assert!(!may_go("G0 Z12, G0 X55, G0 X50, G0 Z5"));
    // An arc whose ends are on a way of the job runs beside that way.
    assert!(may_go("G0 Z12, G1 X50 F100, G0 Z5"));
    assert!(!may_go("G0 Z12, G2 X50 I20 J0 F100, G0 Z5"));
    assert!(!may_go("G0 Z12, G0 X5, G0 X50, G0 Z5"));
}

#[test]
fn a_way_down_ends_where_the_job_has_been() {
    assert!(may_go("G0 Z12, G0 X40, G0 Z12, G0 X50, G0 Z5"));
    assert!(!may_go("G0 Z20, G0 X40, G0 Z11.9, G0 Z12, G0 X50, G0 Z5"));
    assert!(!may_go("G0 Z12, G0 X50, G0 Z4.9, G0 Z5"));
    // A feed instead of a rapid is slower, but not dangerous.
    assert!(may_go("G0 Z12, G0 X50, G1 Z5 F100"));
}

/// The tool moves straight up to a machine position, and is above everything afterwards.
#[test]
fn a_place_of_the_machine_is_above_everything() {
    assert!(is_allowed(["G53 G0 Z0, G0 X0 Y0, G0 Z5", JOB[1], JOB[2]]));
    assert!(may_go("G53 G0 Z0, G0 X50, G0 Z5"));
    assert!(!may_go("G53 G0 Z0, G0 X40, G0 Z5, G0 X50"));
    assert!(!may_go("G53 G0 X0 Z0, G0 X50 Y0, G0 Z5"));
}

#[test]
fn the_tool_ends_as_high_as_in_the_job() {
    assert!(is_allowed([JOB[0], JOB[1], "G0 Z20"]));
    assert!(is_allowed([JOB[0], JOB[1], "G0 Z25, G0 X90"]));
    assert!(!is_allowed([JOB[0], JOB[1], "G0 Z19.9"]));
    assert!(!is_allowed([JOB[0], JOB[1], "G0 Z20, G1 X70"]));
}

/// A rapid straight up from a cut and back again.
#[test]
fn the_tool_may_be_lifted_from_a_cut() {
    let lifted = |lift: &str| {
        let text = program(JOB);
        let first = text.find("X10\n").expect("the end of the first cut");
        format!("{}X4\n{lift}\nG1 {}", &text[..first], &text[first..])
    };
    let is_same = |text: &str| {
        check(&moves(text), &moves(&program(JOB)), CLEARANCE, &Tolerance::of_decimals(3)).is_ok()
    };
    for lift in ["G0 Z3\nG0 Z0", "G0 Z3\nG0 X4.0005\nG0 Z0.0005", "G0 Z30\nG0 Z-0.0005"] {
        assert!(is_same(&lifted(lift)), "{lift}");
    }
    for lift in ["G0 Z3", "G0 Z3\nG0 Z0.0015", "G0 X4.0015\nG0 X4", "G0 Z-0.0015\nG0 Z0"] {
        assert!(!is_same(&lifted(lift)), "{lift}");
    }
}
