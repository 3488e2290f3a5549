//! Tests the check of tool lengths: the length in effect must be that of the tool that cuts.

use pathbuild_gcode::dialect::Dialect::LinuxCnc;
use pathbuild_gcode::interpret::{Options, interpret};
use pathbuild_gcode::verify::LengthRules;

/// Returns the lines of the findings about a program, in which `cut` stands for a cut.
fn found(program: &str) -> Vec<u32> {
    let text = format!("G17 G21 G90 G94 F100\n{program}\nM30\n").replace("cut", "G1 X1\nX0");
    let mut rules = LengthRules::new(LinuxCnc, None);
    interpret(text.as_bytes(), LinuxCnc, &Options::default()).steps.iter().for_each(|step| rules.step(step));
    rules.finish().iter().filter_map(|problem| problem.place.line).collect()
}

const NOTHING: [u32; 0] = [];

#[test]
fn h_is_the_number_of_the_tool_in_the_spindle() {
    assert_eq!(found("T1 M6\nG43 H1\ncut"), NOTHING);
    assert_eq!(found("T1 M6\nG43\ncut"), NOTHING);
    assert_eq!(found("T1 M6\nG43 H2\ncut"), [3]);
    // The tool in the spindle at the start is not known.
    assert_eq!(found("G43 H2\ncut"), NOTHING);
    assert_eq!(found("T1 M6\nG43 H2\nG43 H1\ncut"), NOTHING);
}

#[test]
fn a_new_tool_needs_its_length() {
    assert_eq!(found("T1 M6\nG43 H1\ncut\nT2 M6\nG43 H2\ncut"), NOTHING);
    assert_eq!(found("T1 M6\nG43 H1\ncut\nT2 M6\nG0 Z5\ncut"), [8]);
    assert_eq!(found("T1 M6\nG43 H1\ncut\nT1 M6\ncut"), NOTHING);
    // A program without G43 leaves the lengths to the operator.
    assert_eq!(found("T1 M6\ncut\nT2 M6\ncut"), NOTHING);
}

#[test]
fn a_cut_without_the_length_is_reported() {
    assert_eq!(found("G49\nT1 M6\nG43 H1\ncut\nG49"), NOTHING);
    assert_eq!(found("T1 M6\nG43 H1\ncut\nG49\ncut\ncut"), [7]);
    assert_eq!(found("T1 M6\nG43 H1\nG49\nG43 H1\ncut"), NOTHING);
}

/// M6 and G49 leave the tool where it is, so that only a move that states Z goes to an unknown height.
#[test]
fn a_rapid_move_that_states_z_has_the_length_of_its_tool() {
    let second = |words: &str| found(&format!("T1 M6\nG43 H1\ncut\nT2 M6\n{words}\nG43 H2 Z5\ncut"));
    assert_eq!(second("G0 X0 Y0"), NOTHING);
    assert_eq!(second("G53 G0 Z0"), NOTHING);
    assert_eq!(second("G0 X0 Y0\nG0 Z5\nG0 Z2"), [8], "once");
    let end = |words: &str| found(&format!("T1 M6\nG43 H1 G0 Z5\ncut\nG0 Z5\n{words}"));
    assert_eq!(end("G49\nG0 X50"), NOTHING);
    assert_eq!(end("G49 G0 Z5"), [7], "the same number, but for the spindle nose");
    assert_eq!(end("G43 H0 G0 Z5"), [7]);
    assert_eq!(end("G49\nG53 G0 Z0"), NOTHING);
    let first = |words: &str| found(&format!("G49\nG0 Z50\nT1 M6\n{words}\ncut"));
    assert_eq!(first("G0 X0 Y0\nG43 H1 G0 Z5"), NOTHING, "the first Z is that of the tool before");
    assert_eq!(first("G0 X0 Y0\nG0 Z5\nG43 H1"), [6]);
    assert_eq!(first("G0 X0 Y0\nG0 Z5"), NOTHING, "a program without lengths");
}

/// The length of the next tool must not apply before M6 inserts it, nor that of a third one after it.
#[test]
fn a_rapid_move_with_the_length_of_another_tool_is_reported() {
    let change = |words: &str| found(&format!("T1 M6\nG43 H1\ncut\n{words}\ncut"));
    assert_eq!(change("G0 Z5\nT2 M6\nG43 H2 G0 Z5"), NOTHING);
    assert_eq!(change("G0 Z5\nG43 H2\nG0 X5\nT2 M6\nG0 Z5"), NOTHING, "no Z before the change");
    assert_eq!(change("G43 H2 G0 Z5\nG0 Z9\nT2 M6"), [6], "once");
    assert_eq!(change("T2 M6\nG43 H7\nG0 X0\nG0 Z1\nG43 H2 G0 Z1"), [9]);
    assert_eq!(change("T2 M6\nG43 H1 G0 Z1\nG43 H12 G0 Z1"), [7, 8], "H1 is that of T1");
    // H is numbered independently of T.
    assert_eq!(found("T1 M6\nG43 H11 G0 Z5\ncut\nT2 M6\nG43 H12 G0 Z5\ncut"), [3, 7]);
    assert_eq!(found("T1 M6\nG43 H11 G0 Z5\nG0 Z9\nM30"), NOTHING);
}

#[test]
fn a_selected_tool_is_inserted_before_it_cuts() {
    assert_eq!(found("T1 M6\ncut\nT2\nG0 Z5\ncut"), [5]);
    assert_eq!(found("T1 M6\nT2\ncut\nM6\ncut"), NOTHING, "prepared for the next change");
    assert_eq!(found("T1 M6\nT2\ncut\nT2 M6\ncut\nT1"), NOTHING);
    assert_eq!(found("T1 M6\ncut\nT2\ncut\nT3 M6\ncut"), [5]);
    assert_eq!(found("T1 M6\ncut\nT2\ncut\nT3\nM6\ncut"), [5]);
    assert_eq!(found("T1 M6\nT1\ncut"), NOTHING);
    assert_eq!(found("T1 M6\ncut\nT2 M6\nT1\ncut\ncut"), NOTHING, "prepared for the next run");
    assert_eq!(found("T1 M6\ncut\nT2 M6\ncut\nT1\ncut"), [8], "a forgotten M6");
    assert_eq!(found("T1 M6\ncut\nT2 M6\nT3\ncut"), [6], "not the tool of the first operation");
    assert_eq!(found("T1 M6\ncut\nT2 M6\nT1\ncut\nT3 M6\ncut"), [6], "in the middle");
    // Without any M6, the operator changes the tool at a stop.
    assert_eq!(found("T1\ncut\nM0\nT2\ncut"), NOTHING);
    assert_eq!(found("T1\ncut\nT2\ncut"), [5]);
}
