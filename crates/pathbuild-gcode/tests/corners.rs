//! Tests the rule for rounded corners, each with a program that violates it and one that just does not.

mod common;

use common::fault_text;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{Options, interpret};
use pathbuild_gcode::verify::CornerRules;

/// Returns the finding about a program for LinuxCNC, and whether the program limits the rounding of corners in all cuts.
#[track_caller]
fn rounded(program: &str, part_tolerance: f64) -> (Option<String>, bool) {
    let text = format!("G17 G21 G90 G94 F100\n{program}\nM30\n");
    let read = interpret(text.as_bytes(), Dialect::LinuxCnc, &Options::default());
    assert!(read.problems.is_empty(), "{:?}", read.problems);
    let mut rules = CornerRules::new(part_tolerance);
    read.steps.iter().for_each(|step| rules.step(step));
    let has_limit = rules.has_limit();
    (rules.finish().map(|problem| fault_text(&problem)), has_limit)
}

fn found(program: &str, part_tolerance: f64) -> Option<String> {
    rounded(program, part_tolerance).0
}

#[test]
fn corners_are_rounded_within_the_tolerance_of_the_part() {
    let at = |line: u32| Some(format!("{line} rounded-corners"));
    assert_eq!(found("G64 P0.02\nG1 X1", 0.02), None);
    assert_eq!(found("G64 P0.021\nG1 X1", 0.02), at(2));
    assert_eq!(found("G20 G64 P0.0008\nG1 X1", 0.021), None);
    assert_eq!(found("G20 G64 P0.0009\nG1 X1", 0.021), at(2));
    // The built-in post writes P0.01.
    assert_eq!(found("G64 P0.01\nG1 X1", 0.005), None);
    assert_eq!(found("G64 P0.011\nG1 X1", 0.005), at(2));
    // Q joins lines that are nearly straight.
    assert_eq!(found("G64 P0.02 Q0.02\nG1 X1", 0.02), None);
    assert_eq!(found("G64 P0.02 Q0.5\nG1 X1", 0.02), at(2));
    assert_eq!(found("G64 P0.1\nG1 X1\nG64 P0.5\nG1 X2\nG64 P0.2\nG1 X3", 0.02), at(4), "the largest");
}

#[test]
fn only_cuts_round_corners_of_parts() {
    assert_eq!(found("G64 P0.5\nG0 X1\nG61\nG1 X2", 0.02), None);
    assert_eq!(found("G64 P0.5\nG0 X1\nG1 X2\nG61\nG1 X3", 0.02), Some("2 rounded-corners".to_owned()));
}

#[test]
fn every_cut_needs_a_limit() {
    for (program, has_limit) in [
        ("G64 P0.5\nG1 X1", true),
        ("G61\nG1 X1", true),
        ("G64\nG0 X1", true),
        ("G64\nG1 X1", false),
        ("G64 P0\nG1 X1", false),
        ("G1 X1\nG61\nG1 X2", false),
        ("G61\nG1 X1\nG64\nG1 X2", false),
    ] {
        assert_eq!(rounded(program, 1.0), (None, has_limit), "{program}");
    }
}
