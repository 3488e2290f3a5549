//! Tests the interpreter: the effects of words, and their order. (book: program/reading)

mod common;

use common::{changes, fault_text, faults, faults_with, spelled_out, trace, trace_with};
use pathbuild_diagnostic::{Lang, Severity};
use pathbuild_gcode::dialect::Dialect::{
    self, Estlcam, Fanuc, Grbl, Haas, LinuxCnc, Mach3, Marlin, Native, Rs274, Xpertmill,
};
use pathbuild_gcode::dialect::is_active_comment;
use pathbuild_gcode::interpret::{Heights, MachineOffsets, Options, interpret};

const HEAD: &str = "G17 G21 G90 G94\n";

/// Returns the steps of a program after [`HEAD`], with M30 at its end.
fn run(dialect: Dialect, program: &str) -> Vec<String> {
    trace(dialect, &format!("{HEAD}{program}\nM30\n"))
        .into_iter()
        .filter(|step| !step.ends_with(" end"))
        .collect()
}

/// Returns the problems of a program after [`HEAD`], with M30 at its end.
fn wrong(dialect: Dialect, program: &str) -> Vec<String> {
    faults(dialect, &format!("{HEAD}{program}\nM30\n"))
}

const FINE: [&str; 0] = [];

#[test]
fn coordinates_are_absolute_millimetres() {
    assert_eq!(
        run(Native, "G0 X1 Y2 Z3\nG1 X-4 F100\nY5"),
        ["2 rapid to 1 2 3", "3 feed 100 to -4 2 3", "4 feed 100 to -4 5 3"]
    );
}

#[test]
fn a_position_is_unknown_until_the_program_says_it() {
    assert_eq!(run(Native, "G0 Z3\nG0 X1 Y2"), ["2 rapid to ? ? 3", "3 rapid to 1 2 3"]);
    let moves = interpret(b"G21 G90\nG0 Z3\nG0 X1 Y2\nG0 X2 Y2\nM30\n", Native, &Options::default());
    assert_eq!(moves.moves().iter().map(|(_, it)| it.length()).collect::<Vec<_>>(), [0.0, 0.0, 1.0]);
}

#[test]
fn inches_are_converted() {
    assert_eq!(
        run(Native, "G20 G0 X1 Y0 Z0\nG1 X2 F10\nG21 X3"),
        ["2 rapid to 25.4 0 0", "3 feed 254 to 50.8 0 0", "4 feed 254 to 3 0 0"]
    );
}

#[test]
fn incremental_moves_add_up() {
    assert_eq!(
        run(Native, "G0 X1 Y1 Z1\nG91 G0 X1\nX1 Z-0.5\nG90 X0"),
        ["2 rapid to 1 1 1", "3 rapid to 2 1 1", "4 rapid to 3 1 0.5", "5 rapid to 0 1 0.5"]
    );
}

#[test]
fn words_are_obeyed_in_the_order_of_the_standard_not_of_the_text() {
    assert_eq!(
        run(Rs274, "G0 X1 Y1 Z1\nM5 X3 G1 T1 F100 S500 M3 (note)"),
        ["2 rapid to 1 1 1", "3 (note)", "3 select 1", "3 spindle Off 500", "3 feed 100 to 3 1 1"]
    );
    assert_eq!(run(Native, "X1 Y1 Z1 G0 M9 G20 M30"), ["2 rapid to 25.4 25.4 25.4"]);
}

#[test]
fn a_motion_word_holds_until_the_next() {
    assert_eq!(
        run(Rs274, "G1 X1 Y0 Z0 F10\nX2\nG80\nG0\nX3"),
        ["2 feed 10 to 1 0 0", "3 feed 10 to 2 0 0", "6 rapid to 3 0 0"]
    );
}

#[test]
fn coordinates_need_a_motion() {
    for dialect in [Rs274, LinuxCnc] {
        assert_eq!(wrong(dialect, "X1"), ["2 missing-word"], "{dialect}");
    }
    for dialect in [Native, Grbl] {
        assert_eq!(wrong(dialect, "X1"), FINE, "{dialect}");
        assert_eq!(run(dialect, "X1"), ["2 rapid to 1 ? ?"]);
        assert_eq!(wrong(dialect, "G80\nX1"), ["3 missing-word"], "{dialect}");
    }
}

/// On Fanuc and Haas, cycles are a modal group of their own.
#[test]
fn g80_leaves_the_motion_before_the_cycle() {
    for dialect in [Fanuc, Haas] {
        let after =
            |words: &str| format!("G0 X0. Y0. Z5.\n{words}\nG98 G81 X1. Y2. Z-2. R1. F100.\nG80\nZ15.");
        assert_eq!(wrong(dialect, &after("")), FINE, "{dialect}");
        assert_eq!(run(dialect, &after("")).last().unwrap(), "6 rapid to 1 2 15", "{dialect}");
        assert!(run(dialect, &after("G1 X0. F50.")).last().unwrap().starts_with("6 feed"), "{dialect}");
        assert_eq!(wrong(dialect, "G80\nX1."), ["3 missing-word"], "{dialect}");
    }
    assert_eq!(wrong(LinuxCnc, "G0 X0 Y0 Z5\nG98 G81 X1 Y2 Z-2 R1 F100\nG80\nZ15"), ["5 missing-word"]);
}

#[test]
fn cutting_needs_a_feed() {
    assert_eq!(wrong(Native, "G0 X0 Y0 Z0\nG1 X1\nX2\nX3 F0\nX4 F1"), ["3 missing-feed", "5 missing-feed"]);
    assert_eq!(wrong(Native, "G0 X0 Y0 Z0\nF0.1 G1 X1"), FINE);
}

#[test]
fn g94_clears_the_feed_for_linuxcnc_only() {
    let program = "G17 G21 G90\nG0 X0 Y0 Z0\nF150\nG94\nG1 X1\nM30\n";
    assert_eq!(faults(LinuxCnc, program), ["5 missing-feed"]);
    for dialect in [Native, Rs274, Grbl] {
        assert_eq!(faults(dialect, program), FINE, "{dialect}");
    }
    assert_eq!(faults(LinuxCnc, "G17 G21 G90\nG0 X0 Y0 Z0\nF150 G94\nG1 X1\nM30\n"), FINE);
}

#[test]
fn inverse_time_feeds_are_those_of_the_move() {
    assert_eq!(run(Rs274, "G0 X0 Y0 Z0\nG93 G1 X10 F2"), ["2 rapid to 0 0 0", "3 feed 20 to 10 0 0"]);
    assert_eq!(wrong(Rs274, "G0 X0 Y0 Z0\nG93 G1 X10 F2\nX20\nG94 X30 F5"), ["4 missing-feed"]);
}

#[test]
fn feeds_per_turn_depend_on_the_speed() {
    assert_eq!(run(LinuxCnc, "G0 X0 Y0 Z0\nS1000 M3\nG95 G1 X10 F0.1")[2], "4 feed 100 to 10 0 0");
    assert_eq!(wrong(LinuxCnc, "G0 X0 Y0 Z0\nG95 G1 X10 F0.1"), ["3 missing-feed"]);
}

#[test]
fn arcs_have_their_centre_relative_to_their_beginning() {
    assert_eq!(
        run(Native, "G0 X1 Y0 Z0\nG2 X0 Y-1 I-1 F10\nG3 X1 Y0 I0 J1"),
        [
            "2 rapid to 1 0 0",
            "3 feed 10 to 0 -1 0 cw round 0 0 by 90",
            "4 feed 10 to 1 0 0 ccw round 0 0 by 90"
        ]
    );
}

#[test]
fn arcs_with_equal_ends_are_full_circles() {
    assert_eq!(run(Native, "G0 X1 Y0 Z0\nG2 X1 Y0 I-1 F10")[1], "3 feed 10 to 1 0 0 cw round 0 0 by 360");
}

#[test]
fn arcs_are_helices_when_z_changes() {
    let result =
        interpret(b"G21 G90 G17\nG0 X1 Y0 Z0\nG3 X-1 Y0 Z3 I-1 F10\nM30\n", Native, &Options::default());
    let (_, arc) = result.moves()[1];
    let half_circle = std::f64::consts::PI;
    assert!((arc.length() - libm::hypot(half_circle, 3.0)).abs() < 1e-12);
    assert_eq!(arc.extent().map(Option::unwrap), [(-1.0, 1.0), (0.0, 1.0), (0.0, 3.0)]);
}

#[test]
fn arcs_turn_in_the_other_planes_as_seen_from_their_third_axis() {
    assert_eq!(run(Native, "G0 X0 Y0 Z1\nG18 G2 X1 Z0 K-1 F10")[1], "3 feed 10 to 1 0 0 cw round 0 0 by 270");
    assert_eq!(run(Native, "G0 X0 Y0 Z1\nG18 G3 X1 Z0 K-1 F10")[1], "3 feed 10 to 1 0 0 ccw round 0 0 by 90");
    assert_eq!(run(Native, "G0 X0 Y1 Z0\nG19 G3 Y0 Z1 J-1 F10")[1], "3 feed 10 to 0 0 1 ccw round 0 0 by 90");
}

#[test]
fn arcs_by_radius_are_the_short_ones_unless_it_is_negative() {
    let arc = |words: &str| run(Native, &format!("G0 X1 Y0 Z0\n{words} F10"))[1].clone();
    assert_eq!(arc("G3 X0 Y1 R1"), "3 feed 10 to 0 1 0 ccw round 0 0 by 90");
    assert_eq!(arc("G3 X0 Y1 R-1"), "3 feed 10 to 0 1 0 ccw round 1 1 by 270");
    assert_eq!(arc("G2 X0 Y1 R1"), "3 feed 10 to 0 1 0 cw round 1 1 by 90");
    assert_eq!(arc("G2 X0 Y1 R-1"), "3 feed 10 to 0 1 0 cw round 0 0 by 270");
}

#[test]
fn arcs_by_radius_have_two_ends_and_a_radius_that_reaches() {
    assert_eq!(wrong(Native, "G0 X0 Y0 Z0\nG2 X2 Y0 R1 F10"), ["3 doubtful-arc"]);
    assert_eq!(wrong(Native, "G0 X0 Y0 Z0\nG2 X2 Y0 R0.99 F10"), ["3 invalid-arc"]);
    assert_eq!(wrong(Native, "G0 X0 Y0 Z0\nG2 X0 Y0 R1 F10"), ["3 invalid-arc"]);
}

#[test]
fn linuxcnc_takes_radii_that_are_a_little_too_short() {
    assert_eq!(wrong(LinuxCnc, "G0 X0 Y0 Z0\nG2 X2 Y0 R0.9988 F10"), FINE);
    assert_eq!(wrong(LinuxCnc, "G0 X0 Y0 Z0\nG2 X2 Y0 R0.9987 F10"), ["3 invalid-arc"]);
}

#[test]
fn half_circles_by_radius_are_doubtful() {
    assert_eq!(wrong(Native, "G0 X0 Y0 Z0\nG2 X19.99 Y0 R10.000 F10"), FINE);
    assert_eq!(wrong(Native, "G0 X0 Y0 Z0\nG2 X20 Y0 R10.000 F10"), ["3 doubtful-arc"]);
    assert_eq!(wrong(Native, "G0 X0 Y0 Z0\nG2 X20 Y0 I10 F10"), FINE);
}

#[test]
fn the_last_digit_of_a_radius_is_that_of_the_finest_length() {
    let found = |other: &str| wrong(LinuxCnc, &format!("G0 X0 Y0 Z0\nG2 X9. Y9. R7. F10\nG0 {other}"));
    assert_eq!(found("X5."), ["3 doubtful-arc"]);
    assert_eq!(found("X5.12"), FINE, "this arc of 131° does not depend on hundredths");
    assert_eq!(found("X5.1\nG4 P0.123"), ["3 doubtful-arc"], "a time is no length");
    assert_eq!(found("X[1.23]"), ["3 doubtful-arc"], "a calculated length has any number of digits");
    let half = |other: &str| wrong(LinuxCnc, &format!("G0 X0 Y0 Z{other}\nG2 X20 Y0 R10. F10"));
    assert_eq!([half("0.123"), half("0.1234")], [vec!["3 doubtful-arc".to_owned()], vec![]]);
}

/// The centre of a quarter circle is nearly as exact as the other numbers of the program, even if these are whole.
#[test]
fn rounded_corners_by_radius_are_not_doubtful() {
    let found = |x: &str, y: &str| wrong(LinuxCnc, &format!("G0 X0 Y0 Z0\nG2 X{x} Y{y} R10 F10"));
    assert_eq!(found("10", "-10"), FINE);
    assert_eq!(found("10.5", "-9.5"), FINE);
    assert_eq!(found("17", "0"), FINE, "116°");
    assert_eq!(found("18", "0"), ["3 doubtful-arc"], "128°");
}

#[test]
fn a_radius_that_is_too_short_is_no_half_circle() {
    let found = |radius: &str| wrong(LinuxCnc, &format!("G0 X0 Y0 Z0\nG2 X19.999 Y0 R{radius} F10"));
    assert_eq!(found("10.000"), ["3 doubtful-arc"]);
    // LinuxCNC accepts a radius that is slightly too short.
    assert_eq!(found("9.999"), FINE);
}

/// The number of a layer is a number of its own after M06.
#[test]
fn a_layer_of_xpertmill_is_named_by_a_number_without_a_letter() {
    let layer = |words: &str| faults(Xpertmill, &format!("G71\nM06 02\nS1\nG00 Z5\n{words}\nS1\nM30"));
    assert_eq!(layer("M06 03"), [""; 0]);
    assert_eq!(layer("M06"), ["5 missing-word"]);
    assert_eq!(layer("M06 T3"), ["5 unknown-word", "5 missing-word"]);
    assert_eq!(layer("T3"), ["5 unknown-word"]);
    assert_eq!(layer("m06 03"), ["5 unknown-word"], "a lower-case letter");
}

/// The S of a layer starts its spindle, and nothing stops it: with S0, the tool would cut with the spindle stopped.
#[test]
fn a_layer_of_xpertmill_needs_a_speed_above_zero() {
    let layer = |speed: &str| faults(Xpertmill, &format!("G71\nM06 02 {speed}\nG00 Z5\nM30"));
    assert_eq!(layer("S0"), ["2 value-out-of-range"]);
    assert_eq!(layer("S1"), [""; 0]);
    // In other dialects, S0 before M3 is the initial state of the control.
    assert_eq!(faults(Grbl, "G21\nS0\nM30"), [""; 0]);
}

/// XpertMILL has no G91 and no helices.
#[test]
fn arcs_that_leave_their_plane_are_doubtful_where_helices_are_unknown() {
    let is_doubtful = |arc: &str| {
        let program = format!("G0 X0 Y0 Z5\n{arc}\nM30\n");
        faults(Xpertmill, &program).contains(&"2 doubtful-arc".to_owned())
    };
    assert!(!is_doubtful("G2 X2 Y0 I1 J0 F10"));
    assert!(!is_doubtful("G2 X2 Y0 Z5 I1 J0 F10"));
    assert!(is_doubtful("G2 X2 Y0 Z4.999 I1 J0 F10"));
}

#[test]
fn arcs_that_nearly_close_are_doubtful() {
    assert_eq!(wrong(Native, "G0 X10 Y0 Z0\nG2 X10 Y0.001 I-10 F10"), ["3 doubtful-arc"]);
    assert_eq!(wrong(Native, "G0 X10 Y0 Z0\nG2 X10 Y0.003 I-10 F10"), FINE);
    assert_eq!(wrong(Native, "G0 X10 Y0 Z0\nG3 X10 Y0.001 I-10 F10"), FINE);
    assert_eq!(wrong(Native, "G0 X10 Y0 Z0\nG2 X10 Y0 I-10 F10"), FINE);
}

#[test]
fn arcs_need_a_centre() {
    assert_eq!(wrong(Native, "G0 X0 Y0 Z0\nG2 X2 Y0 F10"), ["3 invalid-arc"]);
    assert_eq!(wrong(Native, "G0 X0 Y0 Z0\nG2 X2 Y0 I1 R1 F10"), ["3 invalid-arc"]);
    assert_eq!(wrong(Native, "G0 X0 Y0 Z0\nG2 X2 Y0 I0 J0 F10"), ["3 invalid-arc"]);
    assert_eq!(
        run(Native, "G0 X0 Y0 Z0\nG2 X2 Y0 F10\nG1 X3 F10").len(),
        2,
        "the arc is left out, the position kept"
    );
}

/// GRBL reports "Unused words" (error 36) if a value word has no command, "No axis words" (26) and "G43.1 dynamic axis error" (37).
#[test]
fn words_without_a_command_stop_grbl() {
    for words in [
        "G61",
        "G4 P5",
        "G54",
        "G10 L2 P1 X1",
        "G10 L20 P1 Z0",
        "G43.1 Z1",
        "G49",
        "G0 X1",
        "G38.2 Z-1 F10",
        "M3 S1",
        "T1",
    ] {
        assert_eq!(wrong(Grbl, words), FINE, "{words}");
    }
    for words in [
        "G61 P5", "G54 P2", "G49 P1", "G17 R1", "G94 L1", "M3 P1", "M8 I1", "M0 P1", "G0 X1 J2", "G21 K1",
        "P5",
    ] {
        assert_eq!(wrong(Grbl, words), ["2 unused-word"], "{words}");
    }
    for words in ["G38.2 F10", "G43.1", "G43.1 X1", "G43.1 X1 Z1", "G4", "G92", "G10 L2 P1", "G10 L20 P1"] {
        assert_eq!(wrong(Grbl, words), ["2 missing-word"], "{words}");
    }
    assert_eq!(wrong(LinuxCnc, "G43.1 X1"), FINE);
    assert_eq!(wrong(LinuxCnc, "G10 L2 P1"), FINE);
}

/// P0 sets the external offset of Fanuc, L20 the additional systems, and with G91 the numbers are added to the offsets.
#[test]
fn g10_of_fanuc_sets_other_offsets() {
    for words in ["G10 L2 P0 Z-5.", "G10 L20 P1 Z0", "G91\nG10 L2 P1 Z-5.\nG90"] {
        for dialect in [Fanuc, Haas, Mach3] {
            let found = wrong(dialect, words);
            assert!(found.len() == 1 && found[0].ends_with("word-not-followed"), "{words}: {found:?}");
        }
        assert_eq!(wrong(LinuxCnc, words), FINE, "{words}");
    }
    assert_eq!(wrong(Fanuc, "G10 L2 P1 Z-5."), FINE);
}

/// G43.1 replaces the tool length, so that the same coordinate is another position afterwards.
#[test]
fn a_length_given_by_number_moves_the_tip_once_the_tool_has_cut() {
    let cut = "G49\nG0 X0 Y0 Z5\nG1 X1 F100";
    for dialect in [LinuxCnc, Grbl, Native] {
        let moves = |then: &str| run(dialect, &format!("{cut}\n{then}"));
        assert_eq!(
            moves("G43.1 Z-10\nG0 Z5\nG0 X2\nG43.1 Z0\nG0 Z5")[2..],
            ["6 rapid to 1 0 -5", "7 rapid to 2 0 -5", "9 rapid to 2 0 5"]
        );
        assert_eq!(moves("G43.1 Z0\nG0 Z5")[2..], ["6 rapid to 1 0 5"]);
        assert_eq!(moves("G20 G43.1 Z1\nG21 G0 Z5")[2..], ["6 rapid to 1 0 30.4"]);
        assert_eq!(wrong(dialect, &format!("{cut}\nG43.1 Z-10")), FINE);
    }
    // Another length does not move the tip of another tool, or of a tool that has not cut yet: each has a zero of its own.
    let fine = "T1 M6\nG49\nG0 X0 Y0 Z5\nG43.1 Z-9\nG0 Z5\nG1 X1 F100\nT2 M6\nG43.1 Z7\nG0 Z5\nG1 X2";
    assert_eq!(wrong(LinuxCnc, fine), FINE);
    assert_eq!(run(LinuxCnc, fine)[2], "6 rapid to 0 0 5");
    assert_eq!(run(LinuxCnc, fine).last().map(String::as_str), Some("11 feed 100 to 2 0 5"));
}

#[test]
fn a_length_whose_difference_is_unknown_is_not_followed() {
    let found = |length: &str, then: &str| {
        wrong(LinuxCnc, &format!("T1 M6\n{length}\nG0 X0 Y0 Z5\nG1 X1 F100\n{then}\nG0 Z5\nG1 X2"))
    };
    assert_eq!(found("G43 H1", "G43.1 Z5"), ["6 word-not-followed"]);
    assert_eq!(found("", "G43.1 Z5"), ["6 word-not-followed"], "that of the program before");
    assert_eq!(found("G43.1 Z4", "G43.1 Z5"), FINE);
    assert_eq!(found("G43 H1", "T2 M6\nG43.1 Z5"), FINE);
    assert_eq!(found("G43 H1", "M0\nG43.1 Z5"), FINE, "the operator may have changed the tool");
    assert_eq!(found("G43 H1", "G43.2 H2"), ["6 word-not-followed"]);
    // Both words take Z.
    assert_eq!(found("G43.1 Z4", "G0 G43.1 Z5"), ["6 conflicting-words"]);
    assert_eq!(found("G43.1 Z4", "G80 G43.1 Z5"), FINE);
}

/// Fanuc stores H and D, and LinuxCNC refuses them if no word needs them.
#[test]
fn an_offset_beside_a_word_for_the_tool_length() {
    for words in ["G49 H0", "G43 H1 D1"] {
        assert_eq!([Fanuc, Haas, Mach3].map(|dialect| wrong(dialect, words)), [FINE; 3], "{words}");
        assert_eq!(
            [LinuxCnc, Rs274, Native].map(|dialect| wrong(dialect, words)),
            [["2 unused-word"]; 3],
            "{words}"
        );
    }
}

/// GRBL ignores K in the XY plane, LinuxCNC refuses it ("K word given for arc in xy plane").
#[test]
fn a_centre_of_the_third_axis_may_be_0_where_it_is_ignored() {
    let arc = |words: &str| format!("G0 X10 Y0 Z0\nG3 X10 Y0 {words} F10");
    assert_eq!(wrong(Grbl, &arc("I-10 K0.000")), FINE);
    assert_eq!(wrong(Grbl, &arc("I-10 K1")), ["3 unused-word"]);
    assert_eq!(wrong(Grbl, &arc("K0")), ["3 invalid-arc"]);
    assert_eq!(wrong(LinuxCnc, &arc("I-10 K0")), ["3 unused-word"]);
    assert_eq!(wrong(Grbl, "G18\nG0 X10 Y0 Z0\nG3 X10 Z0 I-10 J0 F10"), FINE);
}

/// Programs from Vectric's post for Mach3 begin like this.
#[test]
fn mach3_ends_cycles_beside_a_motion_and_has_two_words_for_each_unit() {
    assert_eq!(wrong(Mach3, "G00G21G17G90G40G49G80\nG71G91.1\nX1Y1"), FINE);
    assert_eq!(run(Mach3, "G80 G0 G20\nX1 Y1 Z1")[0], run(Mach3, "G0 G70\nX1 Y1 Z1")[0]);
    assert_eq!(run(Mach3, "G80 G0 G20\nX1 Y1 Z1")[0], "3 rapid to 25.4 25.4 25.4");
    assert_eq!(wrong(LinuxCnc, "G0 G80 X1 Y1"), ["2 conflicting-words"]);
    assert_eq!(wrong(Mach3, "G0 G1 X1 Y1 F10"), ["2 conflicting-words"]);
}

/// Marlin and XpertMILL are not known to repeat the previous motion, so each line must state its motion.
#[test]
fn a_motion_that_is_not_stated_is_missed_where_it_must_be() {
    let missed = |dialect| {
        let program = "G0 X0 Y0 Z5\nG1 X1 F100\nX2";
        let found = wrong(dialect, program).into_iter();
        found.filter(|found| found.ends_with("motion-not-stated")).collect::<Vec<_>>()
    };
    for dialect in [Native, Grbl, LinuxCnc, Fanuc, Haas, Mach3, Rs274] {
        assert_eq!(missed(dialect), FINE, "{dialect}");
    }
    for dialect in [Marlin, Xpertmill] {
        assert_eq!(missed(dialect), ["4 motion-not-stated"], "{dialect}");
    }
}

#[test]
fn arcs_need_an_axis_word_in_some_dialects() {
    let dialects = [Native, Rs274, Grbl, Mach3, LinuxCnc, Fanuc, Haas, Marlin, Xpertmill];
    let needed = dialects.into_iter().filter(|dialect| {
        let found = wrong(*dialect, "G0 X1 Y0 Z0\nG2 I-1 F10");
        found.iter().any(|found| found.ends_with("invalid-arc"))
    });
    assert_eq!(needed.collect::<Vec<_>>(), [Native, Rs274, Grbl]);
    assert_eq!(run(LinuxCnc, "G0 X1 Y0 Z0\nG2 I-1 F10")[1], "3 feed 10 to 1 0 0 cw round 0 0 by 360");
}

/// LinuxCNC and GRBL have larger tolerances for large arcs.
#[test]
fn radii_agree_within_the_dialects_tolerance() {
    for (dialect, radius, within, beyond) in [
        (Rs274, 10, "10.0019", "10.0021"),
        (LinuxCnc, 10, "10.028", "10.029"),
        (Grbl, 10, "10.0099", "10.0101"),
        (Native, 10, "10.0099", "10.0101"),
        (Rs274, 1000, "1000.0019", "1000.0021"),
        (LinuxCnc, 1000, "1000.9", "1001.1"),
        (Grbl, 1000, "1000.49", "1000.51"),
        (LinuxCnc, 10000, "10002.82", "10002.84"),
    ] {
        let arc = |end: &str| format!("G0 X{radius} Y0 Z0\nG3 X0 Y{end} I-{radius} F10");
        assert_eq!(wrong(dialect, &arc(within)), FINE, "{dialect}");
        assert_eq!(wrong(dialect, &arc(beyond)), ["3 arc-radii-differ"], "{dialect}");
    }
}

#[test]
fn inch_programs_of_the_nist_have_a_tolerance_in_inches() {
    let arc = |end: &str| format!("G20 G0 X1 Y0 Z0\nG3 X0 Y{end} I-1 F10");
    assert_eq!(wrong(Rs274, &arc("1.00019")), FINE);
    assert_eq!(wrong(Rs274, &arc("1.00021")), ["3 arc-radii-differ"]);
}

#[test]
fn linuxcnc_counts_turns_and_takes_absolute_centres() {
    assert_eq!(
        run(LinuxCnc, "G0 X1 Y0 Z0\nG2 X0 Y-1 Z-3 I-1 P3 F10")[1],
        "3 feed 10 to 0 -1 -3 cw round 0 0 by 810"
    );
    assert_eq!(
        run(LinuxCnc, "G0 X1 Y0 Z0\nG90.1 G2 X0 Y-1 I0 J0 F10")[1],
        "3 feed 10 to 0 -1 0 cw round 0 0 by 90"
    );
    // Centres are relative to the origin of the program, wherever the origin is.
    let shifted = run(LinuxCnc, "G0 X11 Y7 Z0\nG92 X1 Y0\nG90.1 G2 X0 Y-1 I0 J0 F10");
    assert_eq!(shifted[1], "4 feed 10 to 10 6 0 cw round 10 7 by 90");
    assert_eq!(wrong(LinuxCnc, "G0 X1 Y0 Z0\nG90.1 G2 X0 Y-1 I0 F10"), ["3 missing-word"]);
    let no_turn = "G0 X1 Y0 Z0\nG2 X0 Y-1 I-1 P0 F10";
    assert_eq!(wrong(LinuxCnc, no_turn), ["3 value-out-of-range"]);
    assert_eq!(run(LinuxCnc, no_turn)[1], "3 feed 10 to 0 -1 0 cw round 0 0 by 90", "as without P");
    assert_eq!(wrong(Grbl, "G0 X1 Y0 Z0\nG2 X0 Y-1 I-1 P3 F10"), ["3 unused-word"]);
}

#[test]
fn words_that_nothing_uses_are_errors() {
    assert_eq!(wrong(LinuxCnc, "G0 X1 I3"), ["2 unused-word"]);
    assert_eq!(wrong(Grbl, "G0 X1\nG1 Y1 R2 F5"), ["3 unused-word"]);
    assert_eq!(wrong(Native, "F10 S20 T3"), FINE);
}

#[test]
fn words_of_one_group_exclude_each_other() {
    assert_eq!(wrong(Native, "G0 G1 X1 F5"), ["2 conflicting-words"]);
    assert_eq!(wrong(Native, "G0 G17 G20 G90 X1"), FINE);
    assert_eq!(wrong(Native, "G20 G21"), ["2 conflicting-words"]);
    assert_eq!(wrong(Native, "M3 M5"), ["2 conflicting-words"]);
    assert_eq!(wrong(Native, "M7 M8"), ["2 conflicting-words"]);
    assert_eq!(wrong(Native, "M8 M9"), ["2 conflicting-words"]);
    assert_eq!(wrong(Native, "G0 X1 X2"), ["2 conflicting-words"]);
}

#[test]
fn only_one_word_of_a_line_takes_its_coordinates() {
    assert_eq!(wrong(Native, "G0 G92 X1"), ["2 conflicting-words"]);
    assert_eq!(wrong(Native, "G0 G92.1 X1"), FINE);
    assert_eq!(wrong(LinuxCnc, "G28 G1 X1 F10").first().map(String::as_str), Some("2 conflicting-words"));
}

#[test]
fn words_are_those_of_the_dialect() {
    for (words, unknown_to) in [
        ("G43 H1", &[Grbl][..]),
        ("G64", &[Grbl]),
        ("G81 X1 Y1 Z-1 R1 F10", &[Grbl]),
        ("T1 M6", &[Grbl]),
        ("G28.1", &[Rs274]),
        ("G90.1", &[Rs274, Grbl]),
        ("G59.1", &[Grbl]),
        ("G52 X0", &[Rs274, Grbl, Native]),
        ("M60", &[Grbl]),
        ("G71", &[Rs274, Grbl, Native]),
        ("M8", &[]),
        ("G5.1", &[Rs274, Grbl, Native]),
    ] {
        for dialect in [Rs274, LinuxCnc, Grbl, Native] {
            let unknown =
                wrong(dialect, words).iter().filter(|fault| fault.ends_with("unknown-word")).count();
            assert_eq!(unknown > 0, unknown_to.contains(&dialect), "{words} in {dialect}: {unknown}");
        }
    }
}

#[test]
fn letters_are_those_of_the_dialect() {
    assert_eq!(wrong(Grbl, "G0 X1 A5"), ["2 unknown-word"]);
    assert_eq!(wrong(LinuxCnc, "G0 X1 A5"), ["2 word-not-followed"]);
}

#[test]
fn what_is_accepted_and_not_followed_is_an_error() {
    for words in [
        "G41 D1",
        "G33 Z-1 K1",
        "G5 X1 Y1 I1 J1 P1 Q1",
        "G76 P1 Z-1 I1 J1 R1 K1",
        "M98 P100",
        "o1 call",
        "M101 P1 Q2",
        "G10 L1 P1 Z1",
    ] {
        assert_eq!(wrong(LinuxCnc, words), ["2 word-not-followed"], "{words}");
    }
}

#[test]
fn the_position_behind_a_motion_that_is_not_followed_is_its_end() {
    assert_eq!(
        run(LinuxCnc, "G0 X0 Y0 Z0\nG5 X1 Y1 I1 J1 P1 Q1\nG91 G0 X1"),
        ["2 rapid to 0 0 0", "4 rapid to 2 1 0"]
    );
}

#[test]
fn dwells_are_seconds() {
    assert_eq!(run(Native, "G4 P1.5\nG04P4"), ["2 dwell 1.5", "3 dwell 4"]);
    assert_eq!(wrong(Native, "G4"), ["2 missing-word"]);
    assert_eq!(wrong(Native, "G4 P-1"), ["2 value-out-of-range"]);
}

#[test]
fn probes_leave_the_position_open() {
    assert_eq!(
        run(Native, "G0 X1 Y1 Z5\nG38.3 Z0 F50\nG4 P4\nG0 Z20"),
        ["2 rapid to 1 1 5", "3 probe 50 toward=true must=false to 1 1 0", "4 dwell 4", "5 rapid to 1 1 20"]
    );
    assert_eq!(run(Native, "G0 X1 Y1 Z5\nG38.2 Z0 F50\nG91 G0 Z2")[2], "4 rapid to 1 1 ?");
    // Posts state all axes. An axis that does not move is known after the probe.
    assert_eq!(run(Native, "G0 X1 Y1 Z5\nG38.2 X1 Y1 Z0 F50\nG91 G0 Z2")[2], "4 rapid to 1 1 ?");
    assert_eq!(run(Native, "G0 X1 Y1 Z5\nG38.2 X2 Y1 Z0 F50\nG91 G0 Z2")[2], "4 rapid to ? 1 ?");
    assert_eq!(wrong(Native, "G0 X1 Y1 Z5\nG38.2 Z0"), ["3 missing-feed"]);
}

#[test]
fn g92_renames_where_the_tool_is() {
    assert_eq!(
        run(Native, "G0 X1 Y1 Z1\nG92 X0\nG0 X1\nG92.1\nG0 X1"),
        ["2 rapid to 1 1 1", "4 rapid to 2 1 1", "6 rapid to 1 1 1"]
    );
    assert_eq!(run(LinuxCnc, "G0 X1 Y1 Z1\nG92 X0\nG92.2\nG0 X1\nG92.3\nX1")[2], "7 rapid to 2 1 1");
    assert_eq!(
        run(LinuxCnc, "G0 X1 Y1 Z1\nG92 X0\nG92.3\nX1")[1],
        "5 rapid to 2 1 1",
        "it is in effect already"
    );
    // After G92.1, there is no offset that G92.3 could restore.
    assert_eq!(run(LinuxCnc, "G0 X1 Y1 Z1\nG92 X0\nG92.1\nG0 X1\nG92.3\nX1")[2], "7 rapid to 1 1 1");
    assert_eq!(wrong(Native, "G92"), ["2 missing-word"]);
}

#[test]
fn g92_at_the_beginning_makes_the_position_known() {
    assert_eq!(run(Native, "G92 X0 Y0 Z5\nG0 X1"), ["3 rapid to 1 0 5"]);
}

#[test]
fn g52_shifts_and_unshifts() {
    assert_eq!(
        run(LinuxCnc, "G0 X1 Y1 Z1\nG52 X10\nG0 X1\nG52 X0\nG0 X2"),
        ["2 rapid to 1 1 1", "4 rapid to 11 1 1", "6 rapid to 2 1 1"]
    );
}

#[test]
fn other_coordinate_systems_are_named() {
    assert_eq!(
        run(Native, "G0 X1 Y1 Z1\nG55 G0 X2\nG54 X1"),
        ["2 rapid to 1 1 1", "3 system G55", "3 rapid to 2 1 1", "4 system G54", "4 rapid to 1 1 1"]
    );
    assert_eq!(wrong(Native, "G0 X1 Y1 Z1\nG55 G0 X2"), ["3 unknown-offset"]);
    assert_eq!(
        wrong(Native, "G55 G0 X1 Y1 Z1\nG0 X2"),
        FINE,
        "the first system used is the one counted from"
    );
}

#[test]
fn g10_places_coordinate_systems() {
    assert_eq!(run(Native, "G0 X1 Y1 Z1\nG10 L2 P2 X10\nG55 G0 X2")[2], "4 rapid to 12 1 1");
    assert_eq!(run(Native, "G0 X1 Y1 Z1\nG10 L20 P2 X0\nG55 G0 X2")[2], "4 rapid to 3 1 1");
    assert_eq!(run(Native, "G0 X1 Y1 Z1\nG10 L2 P0 X10\nG0 X2")[1], "4 rapid to 12 1 1");
    // G10 L2 is relative to the machine's zero, and the position of G54 is not known.
    assert_eq!(wrong(Native, "G0 X1 Y1 Z1\nG10 L2 P2 X10\nG55 G0 X2"), ["4 unknown-offset"]);
    assert_eq!(wrong(Native, "G10 L2 P9 X10\nG10 L2 P10 X10"), ["3 value-out-of-range"]);
}

#[test]
fn named_places_are_unknown_without_configuration() {
    assert_eq!(
        run(Native, "G0 X1 Y1 Z1\nG28\nG0 Z5"),
        ["2 rapid to 1 1 1", "3 rapid to ? ? ? Home1", "4 rapid to ? ? 5"]
    );
    assert_eq!(
        run(Native, "G0 X1 Y1 Z1\nG91 G28 Z2\nG90 G0 Z5"),
        ["2 rapid to 1 1 1", "3 rapid to 1 1 3", "3 rapid to 1 1 ? Home1", "4 rapid to 1 1 5"]
    );
    // The position does not matter until a cut starts there.
    assert_eq!(wrong(Native, "G0 X1 Y1 Z1\nG30"), FINE);
    assert_eq!(wrong(Native, "G0 X1 Y1 Z1\nG30\nG0 X1 Y1\nG0 Z1\nG1 Z0 F9"), FINE);
    assert_eq!(wrong(Native, "G0 X1 Y1 Z1\nG30\nG0 Z1\nG1 Z0 F9"), ["3 unknown-offset"]);
    assert_eq!(run(Native, "G0 X1 Y1 Z1\nG53 G0 Z0")[1], "3 rapid to 1 1 ? Machine");
    assert_eq!(run(Native, "G0 X1 Y1 Z1\nG28.1\nG0 X9\nG28")[2], "5 rapid to 1 1 1 Home1");
}

#[test]
fn named_places_are_known_from_the_configuration() {
    let mut offsets =
        MachineOffsets { home: [[0.0, 0.0, 0.0], [5.0, 5.0, 0.0]], ..MachineOffsets::default() };
    offsets.systems[0] = [100.0, 50.0, -40.0];
    offsets.systems[1] = [200.0, 50.0, -40.0];
    let options = Options { offsets: Some(offsets), ..Options::default() };
    let program = "G21 G90\nG0 X1 Y1 Z1\nG28\nG53 G0 X100\nG55 G0 X0\nG30 Z0\nM30\n";
    assert_eq!(
        trace_with(Native, program, &options),
        [
            "2 rapid to 1 1 1",
            "3 rapid to -100 -50 40 Home1",
            "4 rapid to 0 -50 40 Machine",
            "5 system G55",
            "5 rapid to 100 -50 40",
            "6 rapid to 100 -50 0",
            "6 rapid to 100 -50 40 Home2",
            "7 end"
        ]
    );
}

#[test]
fn machine_coordinates_go_with_absolute_straight_moves() {
    assert_eq!(wrong(LinuxCnc, "G0 X1 Y1 Z1\nG91 G53 G0 X0"), ["3 conflicting-words"]);
    assert_eq!(wrong(LinuxCnc, "G0 X1 Y1 Z1\nG53 G80\nG90"), ["3 conflicting-words"]);
    // GRBL accepts G53 with G91 as well, and measures from the machine's zero.
    let moved = |words: &str| format!("G0 X1 Y1 Z1\n{words} G53 G0 Z-5\nG90 G0 Z1");
    assert_eq!(wrong(Grbl, &moved("G91")), FINE);
    assert_eq!(run(Grbl, &moved("G91")), run(Grbl, &moved("G90")));
    assert_eq!(wrong(Fanuc, "G0 X1. Y1. Z1.\nG91 G53 G0 Z0.").len(), 1);
}

#[test]
fn cycles_are_the_moves_that_they_stand_for() {
    assert_eq!(
        run(LinuxCnc, "G0 X0 Y0 Z5\nG98 G81 X1 Y2 Z-2 R1 F100\nX3\nG80"),
        [
            "2 rapid to 0 0 5",
            "3 rapid to 1 2 5",
            "3 rapid to 1 2 1",
            "3 feed 100 to 1 2 -2",
            "3 rapid to 1 2 5",
            "4 rapid to 3 2 5",
            "4 rapid to 3 2 1",
            "4 feed 100 to 3 2 -2",
            "4 rapid to 3 2 5"
        ]
    );
}

#[test]
fn g99_stays_at_the_cycles_own_height() {
    assert_eq!(
        run(LinuxCnc, "G0 X0 Y0 Z5\nG99 G82 X1 Y2 Z-2 R1 P0.5 F100\nX3")[3..],
        [
            "3 feed 100 to 1 2 -2",
            "3 dwell 0.5",
            "3 rapid to 1 2 1",
            "4 rapid to 3 2 1",
            "4 feed 100 to 3 2 -2",
            "4 dwell 0.5",
            "4 rapid to 3 2 1"
        ]
    );
}

/// These controls keep G98 or G99 of the program before, so that a program without either may find the lower height.
#[test]
fn a_program_must_say_how_high_the_tool_rises_after_holes() {
    for dialect in [Mach3, Fanuc, Haas] {
        let holes = |words: &str, height: &str| {
            format!("G0 X0. Y0. Z{height}\n{words} G81 X1. Y2. Z-2. R1. F100.\nX3.\nG80")
        };
        assert_eq!(wrong(dialect, &holes("", "5.")), ["3 modes-not-stated"], "{dialect}");
        assert!(run(dialect, &holes("", "5.")).contains(&"4 rapid to 3 2 1".to_owned()), "{dialect}");
        for stated in [holes("G98", "5."), holes("G99", "5."), holes("", "1.")] {
            assert_eq!(wrong(dialect, &stated), FINE, "{dialect}: {stated}");
        }
    }
    // DIN 66025 has neither word.
    let din = run(Dialect::Din, "G0 X0 Y0 Z5\nG81 X1 Y2 Z-2 R1 F100\nX3\nG80");
    assert!(din.contains(&"4 rapid to 3 2 5".to_owned()), "{din:?}");
}

/// LinuxCNC rises on the way to the hole. Fanuc's operation 1 moves in the plane alone, and G98 returns to the initial height after the hole.
#[test]
fn the_first_hole_with_g98_after_g99_is_approached_at_the_present_height() {
    let ways = |dialect: Dialect| {
        let steps = run(dialect, "G0 X0. Y0. Z5.\nG99 G81 X1. Z-3. R-2. F100.\nG98 X9. R-1.\nX12.\nG80");
        steps
            .into_iter()
            .filter(|step| step.starts_with("4 rapid") || step.starts_with("5 rapid"))
            .collect::<Vec<_>>()
    };
    let then = [
        "4 rapid to 9 0 -1",
        "4 rapid to 9 0 5",
        "5 rapid to 12 0 5",
        "5 rapid to 12 0 -1",
        "5 rapid to 12 0 5",
    ];
    for dialect in [Fanuc, Haas] {
        assert_eq!(ways(dialect)[0], "4 rapid to 9 0 -2", "{dialect:?}");
        assert_eq!(ways(dialect)[1..], then, "{dialect:?}");
    }
    assert_eq!(ways(LinuxCnc)[0], "4 rapid to 9 0 5");
    assert_eq!(ways(LinuxCnc)[1..], then);
    // Mach3 first rises to R, as every interpreter of RS274/NGC.
    assert_eq!(ways(Mach3)[0], "4 rapid to 1 0 -1");
    assert_eq!(ways(Mach3)[1..], then);
}

#[test]
fn pecking_lifts_out_and_chip_breaking_lifts_a_little() {
    assert_eq!(
        run(LinuxCnc, "G0 X0 Y0 Z1\nG99 G83 Z-2 R1 Q2 F100")[2..],
        [
            "3 feed 100 to 0 0 -1",
            "3 rapid to 0 0 1",
            "3 rapid to 0 0 -0.746",
            "3 feed 100 to 0 0 -2",
            "3 rapid to 0 0 1"
        ]
    );
    assert_eq!(
        run(LinuxCnc, "G0 X0 Y0 Z1\nG99 G73 Z-2 R1 Q2 F100")[2..],
        ["3 feed 100 to 0 0 -1", "3 rapid to 0 0 -0.746", "3 feed 100 to 0 0 -2", "3 rapid to 0 0 1"]
    );
}

#[test]
fn boring_lifts_at_the_feed() {
    assert_eq!(
        run(LinuxCnc, "G0 X0 Y0 Z1\nG99 G85 Z-2 R1 F100")[2..4],
        ["3 feed 100 to 0 0 -2", "3 feed 100 to 0 0 1"]
    );
    assert_eq!(
        run(LinuxCnc, "G0 X0 Y0 Z1\nG99 G89 Z-2 R1 P2 F100")[2..],
        ["3 feed 100 to 0 0 -2", "3 dwell 2", "3 feed 100 to 0 0 1"]
    );
}

#[test]
fn cycles_are_repeated_by_l() {
    let steps = run(LinuxCnc, "G0 X0 Y0 Z5\nG91 G81 X1 Y0 Z-2 R-4 L3 F100");
    assert_eq!(
        steps.iter().filter(|step| step.contains("feed")).cloned().collect::<Vec<_>>(),
        ["3 feed 100 to 1 0 -1", "3 feed 100 to 2 0 -1", "3 feed 100 to 3 0 -1"]
    );
    assert_eq!(wrong(LinuxCnc, "G0 X0 Y0 Z5\nG81 X1 Y0 Z-2 R1 L0 F100"), ["3 value-out-of-range"]);
}

#[test]
fn cycles_drill_along_the_axis_across_the_plane() {
    assert_eq!(
        run(LinuxCnc, "G0 X0 Y0 Z5\nG18 G81 X1 Y-3 Z2 R1 F10"),
        [
            "2 rapid to 0 0 5",
            "3 rapid to 0 1 5",
            "3 rapid to 1 1 2",
            "3 feed 10 to 1 -3 2",
            "3 rapid to 1 1 2"
        ]
    );
}

#[test]
fn cycles_begin_above_r() {
    assert_eq!(
        run(LinuxCnc, "G0 X0 Y0 Z0.5\nG81 X1 Y0 Z-2 R1 F100")[1..3],
        ["3 rapid to 0 0 1", "3 rapid to 1 0 1"]
    );
}

#[test]
fn cycles_have_all_their_words() {
    let start = "G0 X0 Y0 Z5\n";
    for missing in ["G81 X1 Z-2 F10", "G81 X1 R1 F10", "G83 X1 Z-2 R1 F10", "G82 X1 Z-2 R1 F10"] {
        assert_eq!(wrong(LinuxCnc, &format!("{start}{missing}")), ["3 missing-word"], "{missing}");
    }
    for beyond in ["G83 X1 Z-2 R1 Q0 F10", "G81 X1 Z2 R1 F10", "G83 X1 Z-2 R1 Q0.000001 F10"] {
        assert_eq!(wrong(LinuxCnc, &format!("{start}{beyond}")), ["3 value-out-of-range"], "{beyond}");
    }
    assert_eq!(wrong(LinuxCnc, &format!("{start}G83 X1 Z-2 R1 Q0.1 F10\nX2\nG83 X3")), FINE);
    assert_eq!(wrong(LinuxCnc, &format!("{start}G83 X1 Z-2 R1 Q0.1 F10\nX2\nG82 X3 P1")), ["5 missing-word"]);
}

#[test]
fn a_series_of_cycles_ends_with_another_motion() {
    assert_eq!(wrong(LinuxCnc, "G0 X0 Y0 Z5\nG81 X1 Z-2 R1 F10\nG0 X5\nG81 X1"), ["5 missing-word"]);
}

#[test]
fn values_are_read_before_parameters_are_set() {
    assert_eq!(
        run(LinuxCnc, "#3=15\nG0 X0 Y0 Z0\n#3=6 G0 X#3\nG0 X#3"),
        ["3 rapid to 0 0 0", "4 rapid to 15 0 0", "5 rapid to 6 0 0"]
    );
}

#[test]
fn operators_bind_as_in_the_dialect() {
    for (expression, nist, linuxcnc) in [
        ("1+2*3", 7.0, 7.0),
        ("2**3**2", 64.0, 64.0),
        ("[0-2]**3", -8.0, -8.0),
        ("-2**2", 4.0, 4.0),
        ("- 2**2", 4.0, 4.0),
        ("0 AND 1 + 1", 1.0, 0.0),
        ("10-2/4", 9.5, 9.5),
        ("10-3-2", 5.0, 5.0),
        ("7 MOD 4", 3.0, 3.0),
        ("-7 MOD 4", 1.0, 1.0),
        ("1 XOR 1", 0.0, 0.0),
        ("3 OR 0", 1.0, 1.0),
    ] {
        let run = |dialect| run(dialect, &format!("G0 X[{expression}] Y0 Z0"))[0].clone();
        assert_eq!(run(Rs274), format!("2 rapid to {nist} 0 0"), "{expression}");
        assert_eq!(run(LinuxCnc), format!("2 rapid to {linuxcnc} 0 0"), "{expression}");
    }
}

#[test]
fn functions_take_degrees() {
    for (expression, value) in [
        ("SIN[30]", "0.5"),
        ("COS[60]", "0.5"),
        ("TAN[45]", "1"),
        ("ASIN[0.5]", "30"),
        ("ACOS[0.5]", "60"),
        ("ATAN[1]/[-1]", "135"),
        ("ABS[-2]", "2"),
        ("SQRT[9]", "3"),
        ("EXP[0]", "1"),
        ("LN[1]", "0"),
        ("ROUND[2.5]", "3"),
        ("ROUND[-2.5]", "-3"),
        ("FIX[-2.5]", "-3"),
        ("FUP[-2.5]", "-2"),
    ] {
        assert_eq!(
            run(Rs274, &format!("G0 X{expression} Y0 Z0")),
            [format!("2 rapid to {value} 0 0")],
            "{expression}"
        );
    }
}

#[test]
fn linuxcnc_compares_and_has_names() {
    assert_eq!(
        run(LinuxCnc, "#<a b>=2\n#<c>=[1 LT #<AB>]\nG0 X#<c> Y[1 EQ 1.0000001] Z[EXISTS[#<nil>]]"),
        ["4 rapid to 1 1 0"]
    );
    for (expression, value) in [("1 NE 2", 1), ("2 LE 2", 1), ("2 LT 2", 0), ("2 GE 2", 1), ("2 GT 2", 0)] {
        assert_eq!(run(LinuxCnc, &format!("G0 X[{expression}] Y0 Z0")), [format!("2 rapid to {value} 0 0")]);
    }
}

#[test]
fn parameters_refer_to_parameters() {
    assert_eq!(run(LinuxCnc, "#1=2\n#2=5\nG0 X##1 Y#[1+1] Z-#1"), ["4 rapid to 5 5 -2"]);
}

#[test]
fn expressions_without_a_value_leave_out_their_line() {
    for expression in [
        "1/0",
        "SQRT[-1]",
        "ACOS[2]",
        "LN[0]",
        "[0-1]**0.5",
        "#0",
        "#6000",
        "#1.5",
        "#<never>",
        "#5",
        "#100",
        "#5000",
        "EXP[1000]",
        "1 MOD 0",
    ] {
        let program = format!("G0 X0 Y0 Z0\nX[{expression}]\nX1");
        assert_eq!(wrong(LinuxCnc, &program), ["3 cannot-evaluate"], "{expression}");
        assert_eq!(run(LinuxCnc, &program).len(), 2, "{expression}");
    }
}

/// Numbered parameters above 5000 belong to the control, and only the control knows their values.
#[test]
fn a_parameter_that_only_the_machine_sets_is_said() {
    assert_eq!(wrong(LinuxCnc, "G0 X0 Y0 Z0\nX[#5001]"), ["3 machine-value"]);
    assert_eq!(run(LinuxCnc, "G0 X0 Y0 Z0\nX[#5001+2]")[1], "3 rapid to 2 0 0", "0 is assumed");
    assert_eq!(wrong(LinuxCnc, "G0 X0 Y0 Z0\n#5001=2\nX[#5001]"), [""; 0]);
}

#[test]
fn parameters_end_where_the_dialects_do() {
    assert_eq!(wrong(Rs274, "#5399=1\n#5400=1"), ["3 cannot-evaluate"]);
    assert_eq!(wrong(LinuxCnc, "#5602=1\n#5603=1"), ["3 cannot-evaluate"]);
}

#[test]
fn what_only_the_machine_knows_is_said() {
    assert_eq!(wrong(LinuxCnc, "G0 X0 Y0 Z5\nG38.2 Z0 F10\nG0 Z[#5063+1]"), ["4 machine-value"]);
}

/// LinuxCNC, "Numbered Parameters": 5420 to 5428 are the current position in the active coordinate system and in the program's unit.
#[test]
fn the_present_position_and_system_are_known() {
    let last = |program: &str| {
        assert_eq!(wrong(LinuxCnc, program), FINE, "{program}");
        run(LinuxCnc, program).pop().expect("a move")
    };
    let start = "G0 X20 Y-2 Z5\nG52 X1";
    assert_eq!(last(&format!("{start}\nX[#5420+5]")), "4 rapid to 25 -2 5");
    assert_eq!(last(&format!("{start}\nG20\nX0 Y[#5421] Z[#<_z>+1]")), "5 rapid to 1 -2 30.4");
    assert_eq!(last(&format!("{start}\nX[#<_x>+#5220] Y[#<_metric>-#<_incremental>]")), "4 rapid to 21 1 5");
    assert_eq!(wrong(LinuxCnc, "G0 Z5\nG0 X[#5420+5]"), ["3 machine-value"], "X is not known yet");
    assert_eq!(
        wrong(LinuxCnc, "G0 X0 Y0 Z5\nT1 M6\nG0 X[#5420]"),
        ["4 machine-value"],
        "moved by the change"
    );
    assert_eq!(wrong(LinuxCnc, "G0 X0 Y0 Z5\nG38.2 Z0 F10\nG0 Z[#5422+1]"), ["4 machine-value"]);
    assert_eq!(wrong(LinuxCnc, "G0 X[#5423]"), ["2 machine-value"]);
}

#[test]
fn names_that_linuxcnc_defines_are_values_of_the_machine() {
    for name in ["_task", "_abs_z", "_ini[axis_z]max_limit", "_hal[axis.0.pos]", "_VMAJOR"] {
        assert_eq!(wrong(LinuxCnc, &format!("#1=#<{name}>")), ["2 machine-value"], "{name}");
        assert_eq!(wrong(LinuxCnc, &format!("#1=EXISTS[#<{name}>]\nG0 X#1 Y[1/#1]")), FINE, "{name}");
    }
    assert_eq!(wrong(LinuxCnc, "#1=#<_tasks>"), ["2 cannot-evaluate"]);
    assert_eq!(wrong(LinuxCnc, "#<_task>=2\n#1=#<_task>"), FINE, "what the program has set");
}

/// Outputs, overrides and look-ahead take values of their own, and do not change the path.
#[test]
fn words_beside_the_path_have_their_values() {
    for words in [
        "M62 P0",
        "M63 P1",
        "M64 P0",
        "M65 P0",
        "M66 P0 L3 Q5",
        "M66 E0 L0",
        "M67 E0 Q5",
        "M68 E0 Q5",
        "M50 P0",
        "M51 P0",
        "M52 P1",
        "M53 P1",
        "M19 R45",
    ] {
        assert_eq!(wrong(LinuxCnc, words), FINE, "{words}");
    }
    for words in ["M62 E0", "M67 P0 Q5", "M50 Q0", "M48 P1"] {
        assert!(wrong(LinuxCnc, words).contains(&"2 unused-word".to_owned()), "{words}");
    }
    for words in ["G05 P10000", "G05 P0", "G05.1 Q1", "G05.1 Q0", "G08 P1", "G08 P0"] {
        assert_eq!(wrong(Fanuc, words), FINE, "{words}");
    }
    // P10001 runs stored data, and Q2 smooths the path.
    for words in ["G05 P10001", "G05", "G05.1 Q2", "G08 P2"] {
        assert_eq!(wrong(Fanuc, words), ["2 word-not-followed"], "{words}");
    }
    for words in ["G187 P1 E0.5", "G187 P3", "G187", "G103 P1", "G103"] {
        assert_eq!(wrong(Haas, words), FINE, "{words}");
    }
    assert_eq!(wrong(Haas, "G103 E1"), ["2 unused-word"]);
    assert_eq!(wrong(Fanuc, "G187 P1")[0], "2 unknown-word");
}

#[test]
fn additional_systems_are_places_of_their_own() {
    let begun = |first: &str, then: &str| format!("{first}\nG0 X0. Y0. Z5.\n{then}\nG0 X1.");
    let systems = [(Haas, "G154 P"), (Fanuc, "G54.1 P"), (Mach3, "G59 P")];
    for (dialect, word) in systems {
        let [seven, eight] = [7, 8].map(|number| format!("{word}{number}"));
        assert_eq!(wrong(dialect, &begun(&seven, "")), FINE, "{dialect}");
        assert_eq!(wrong(dialect, &begun(&seven, &seven)), FINE, "{dialect}");
        assert_eq!(wrong(dialect, &begun(&seven, &eight)), ["4 unknown-offset"], "{dialect}");
        assert_eq!(wrong(dialect, &begun("G54", &seven)), ["4 unknown-offset"], "{dialect}");
        assert_eq!(wrong(dialect, &begun(&seven, "G54")), ["4 unknown-offset"], "{dialect}");
        assert_eq!(wrong(dialect, &format!("{word}0")), ["2 value-out-of-range"], "{dialect}");
    }
    assert_eq!(wrong(Haas, &begun("G110", "G154 P1")), FINE, "the same");
    assert_eq!(wrong(Haas, &begun("G129", "G154 P20")), FINE, "the same");
    assert_eq!(wrong(Mach3, &begun("G54", "G59 P1")), FINE, "the same");
    assert_eq!([wrong(Haas, "G154 P99"), wrong(Mach3, "G59 P253"), wrong(Mach3, "G59")], [FINE; 3]);
    assert_eq!(wrong(Haas, "G154 P100"), ["2 value-out-of-range"]);
    assert_eq!(wrong(Mach3, "G59 P254"), ["2 value-out-of-range"]);
    assert_eq!(wrong(Haas, "G154"), ["2 missing-word"]);
    assert_eq!(wrong(Grbl, "G59 P7"), ["2 unused-word"]);
}

/// G10 L2 is relative to the machine's zero, and earlier positions are not known relative to that zero.
#[test]
fn g10_l2_after_the_first_move_is_doubtful() {
    let found = |words: &str| wrong(LinuxCnc, words);
    assert_eq!(found("G10 L2 P1 Z-3\nG0 X0 Y0 Z5"), FINE);
    assert_eq!(found("G0 X0 Y0 Z5\nG10 L2 P1 Z-3\nG0 Z4"), ["3 unknown-offset"]);
    assert_eq!(found("G10 L2 P1 X0 Y0 Z0\nG0 X0 Y0 Z5\nG10 L2 P1 Z-3\nG0 Z4"), FINE);
    assert_eq!(found("G0 X0 Y0 Z5\nG10 L2 P2 X9\nG0 Z4\nG55\nG0 X0"), ["5 unknown-offset"]);
    assert_eq!(found("G10 L2 P1 X0 Y0 Z0\nG10 L2 P2 X9\nG0 X0 Y0 Z5\nG55\nG0 X0"), FINE);
    assert_eq!(found("G0 X0 Y0 Z5\nG10 L20 P2 X9\nG55\nG0 X0"), FINE);
}

#[test]
fn fanuc_and_haas_know_the_words_of_their_manuals() {
    let codes = |words: &str| words.split(' ').map(str::to_owned).collect::<Vec<_>>();
    let found = |dialect, word: &str| {
        let mut kinds = wrong(dialect, &format!("G0 X0. Y0. Z5.\n{word}"));
        kinds.retain(|kind| kind != "3 missing-word" && kind != "3 missing-feed");
        kinds
    };
    let not_followed = [
        (Haas, "G47 G101 G107 G136 G141 G143 G150 G153 G155 G161 G166 G169 G174 G184 G188 G234 G254 M16 M96"),
        (Fanuc, "G07.1 G33 G39 G45 G46 G47 G48 G51.1 G60"),
    ];
    for (dialect, words) in not_followed {
        for word in codes(words) {
            assert_eq!(found(dialect, &word), ["3 word-not-followed"], "{dialect} {word}");
        }
    }
    let harmless = [
        (
            Haas,
            "G100 G255 M10 M13 M21 M25 M34 M36 M39 M51 M59 M61 M69 M73 M74 M75 M78 M80 M81 M82 M86 M95 M109 M138",
        ),
        (Fanuc, "G22 G23 G50.1 G93"),
    ];
    for (dialect, words) in harmless {
        for word in codes(words) {
            assert_eq!(found(dialect, &word), FINE, "{dialect} {word}");
        }
    }
    assert_eq!(run(Fanuc, "G0 X0. Y0. Z5.\nG22 X9. Y9. Z9. I1. J1. K1.\nG50.1 X0."), ["2 rapid to 0 0 5"]);
    assert_eq!(wrong(Fanuc, "G24"), ["2 unknown-word"]);
    assert_eq!(wrong(Haas, "G256\nM17"), ["2 unknown-word", "3 unknown-word"]);
}

#[test]
fn macros_of_fanuc_and_haas_are_not_followed() {
    let statements = [
        "#1=0",
        "WHILE[#1LT3]DO1",
        "#1=#1+1",
        "END1",
        "IF[#1LT3]GOTO10",
        "IF [#1 EQ 3] THEN #2=5",
        "GOTO10",
        "G0 X#1",
        "G0 X-#1",
        "G0 X[#1+2.]",
        "N10 goto 20",
        "DPRNT[X]",
    ];
    for dialect in [Fanuc, Haas] {
        for statement in statements {
            assert_eq!(wrong(dialect, statement), ["2 word-not-followed"], "{dialect} {statement}");
        }
        assert_eq!(wrong(dialect, "GX1."), ["2 invalid-word"]);
    }
    assert_eq!(wrong(Grbl, "#1=0\nG0 X#1"), ["2 unknown-word", "3 unknown-word"]);
    assert_eq!(wrong(Grbl, "GOTO10"), ["2 invalid-word"]);
}

#[test]
fn fanuc_numbers_its_switches_for_block_delete() {
    let lines = "G0 X0. Y0. Z5.\n/2 G0 Z6.\n/G0 Z7.";
    assert_eq!(wrong(Fanuc, lines), ["3 optional-line", "4 optional-line"]);
    assert_eq!(run(Fanuc, lines)[1..], ["3 rapid to 0 0 6", "4 rapid to 0 0 7"]);
    assert_eq!(wrong(LinuxCnc, "G0 X0 Y0 Z5\n/2 G0 Z6").len(), 2);
}

/// The spindle may never start if M8 is the only M code of the line that an older Fanuc obeys.
#[test]
fn haas_takes_one_m_code_per_line_and_some_fanucs_obey_one() {
    assert_eq!(wrong(Haas, "S900 M3 M8"), ["2 conflicting-words"]);
    assert_eq!(wrong(Fanuc, "S900 M3 M8"), ["2 ignored-word"]);
    for dialect in [Haas, Fanuc] {
        assert_eq!(wrong(dialect, "S900 M3\nM8"), FINE);
        assert_eq!(wrong(dialect, "M3 M5"), ["2 conflicting-words"], "once");
    }
    assert_eq!(wrong(LinuxCnc, "S900 M3 M8"), FINE);
}

/// With K0 (Haas: L0) the cycle is stored without drilling, and the next position is drilled.
#[test]
fn a_cycle_may_be_stored_without_drilling() {
    for (dialect, zero) in [(Fanuc, "K0"), (Haas, "L0")] {
        let program = |words: &str| format!("G0 X0. Y0. Z5.\nG98 G81 Z-2. R1. F100. {words}\nX3.\nG80");
        assert_eq!(wrong(dialect, &program(zero)), FINE);
        assert_eq!(
            run(dialect, &program(zero))[1..],
            ["4 rapid to 3 0 5", "4 rapid to 3 0 1", "4 feed 100 to 3 0 -2", "4 rapid to 3 0 5"]
        );
        // If the line has X or Y, the tool moves there without drilling, for example around a clamp.
        let around = program(&format!("X1. {zero}"));
        assert_eq!(wrong(dialect, &around), FINE);
        assert_eq!(run(dialect, &around)[1..3], ["3 rapid to 1 0 5", "4 rapid to 3 0 5"]);
        let below = format!("G0 X0. Y0. Z5.\nG99 G81 X1. Z-2. R1. F100.\nX2. {zero}\nX3.\nG80");
        assert_eq!(
            run(dialect, &below)[5..],
            ["4 rapid to 2 0 1", "5 rapid to 3 0 1", "5 feed 100 to 3 0 -2", "5 rapid to 3 0 1"]
        );
    }
    let program = "G0 X0 Y0 Z5\nG98 G81 Z-2 R1 F100 L0";
    assert_eq!([LinuxCnc, Rs274].map(|dialect| wrong(dialect, program)), [["3 value-out-of-range"]; 2]);
}

#[test]
fn g30_of_fanuc_numbers_its_reference_points() {
    let offsets = MachineOffsets { home: [[0.0; 3], [7.0, 8.0, 9.0]], ..MachineOffsets::default() };
    let options = Options { offsets: Some(offsets), ..Options::default() };
    let last = |words: &str| {
        let program = format!("{HEAD}G0 X1. Y2. Z3.\n{words}\nM30\n");
        assert_eq!(faults_with(Fanuc, &program, &options), FINE, "{words}");
        trace_with(Fanuc, &program, &options).iter().rev().nth(1).cloned()
    };
    assert_eq!(last("G91 G30 Z0.").as_deref(), Some("3 rapid to 1 2 9 Home2"));
    assert_eq!(last("G91 G30 P2 Z0.").as_deref(), Some("3 rapid to 1 2 9 Home2"));
    assert_eq!(last("G91 G30 P3 Z0.").as_deref(), Some("3 rapid to 1 2 ? Home2"));
    assert_eq!(wrong(Fanuc, "G91 G30 P1 Z0."), ["2 value-out-of-range"]);
    assert_eq!(wrong(Mach3, "G91 G30 P2 Z0"), ["2 unused-word"]);
}

#[test]
fn mach3_has_the_parameters_and_expressions_of_rs274() {
    assert_eq!(run(Mach3, "#100=5\nG0 X#100 Y[10+20] Z0"), ["3 rapid to 5 30 0"]);
    assert_eq!(wrong(Mach3, "#10320=1\nG0 X[2**3]"), FINE);
    assert_eq!(wrong(Mach3, "#10321=1"), ["2 cannot-evaluate"]);
    assert_eq!(wrong(Mach3, "G0 X#100"), ["2 cannot-evaluate"]);
}

/// Controls such as Beckhoff's take F and S in the line of G04 as the time, and keep feed and speed.
#[test]
fn dwells_of_din_have_seconds_or_turns() {
    let din = |program: &str| {
        trace(Dialect::Din, &format!("G17 G71 G90\nS1200 M03\nG00 X+0 Y+0 Z+5\n{program}\nM05\nM30\n"))
    };
    assert_eq!(din("G04 F2")[2], "4 dwell 2");
    assert_eq!(din("G04 S10")[2], "4 dwell 0.5");
    assert_eq!(din("G04 X1.5")[2], "4 dwell 1.5");
    assert_eq!(
        din("G01 Z+4 F100\nG04 F2\nG01 Z+3").into_iter().filter(|step| step.contains("feed 100")).count(),
        2
    );
    assert_eq!(faults(Dialect::Din, "G17 G71 G90\nG04 S2\nM30\n"), ["2 missing-word"]);
    assert_eq!(faults(Dialect::Din, "G17 G71 G90\nG04\nM30\n"), ["2 missing-word"]);
    assert_eq!(wrong(LinuxCnc, "G4 F2"), ["2 missing-word"]);
}

#[test]
fn m5_in_the_line_of_a_move_comes_before_it() {
    let after = |cut: &str, last: &str| wrong(Native, &format!("G0 X0 Y0 Z5\n{cut}\n{last}"));
    assert_eq!(after("G1 Z0 F9", "G0 Z9 M5"), ["4 stop-before-motion"]);
    assert_eq!(after("G1 Z0 F9", "G0 Z9 M9"), ["4 stop-before-motion"]);
    assert_eq!(after("G1 Z0 F9", "G0 Z9 M3\nM5"), FINE);
    assert_eq!(after("G1 Z0 F9\nG0 X9", "G91 G28 Z0 M9"), ["5 stop-before-motion"]);
}

#[test]
fn m5_may_be_in_the_line_of_a_move_of_a_raised_tool() {
    let after = |cut: &str, last: &str| wrong(Native, &format!("G0 X0 Y0 Z5\n{cut}\n{last}"));
    assert_eq!(after("G1 Z0 F9\nG0 Z5", "G91 G28 Z0 M9"), FINE);
    assert_eq!(after("G1 Z0 F9\nG53 G0 Z0", "G0 X9 M5"), FINE);
    assert_eq!(after("G0 X9", "G0 Z9 M5"), FINE, "nothing has been cut");
    assert_eq!(after("G1 Z0 F9\nG0 Z5", "G1 Z0 M5"), ["5 stop-before-motion"], "the move of the line cuts");
}

#[test]
fn units_and_modes_are_said_before_the_first_move() {
    assert_eq!(faults(Native, "G90\nG0 X1\nG0 X2\nM30\n"), ["2 units-not-stated"]);
    assert_eq!(faults(Native, "G21\nG0 X1\nG0 X2\nM30\n"), ["2 modes-not-stated"]);
    assert_eq!(faults(Native, "G21 G90\nG0 X1 Y0 Z0\nG2 X0 Y-1 I-1 F5\nM30\n"), ["3 modes-not-stated"]);
    assert_eq!(faults(Native, "G21 G90\nG0 X1\nM30\n"), FINE);
}

#[test]
fn tools_are_changed_by_m6() {
    assert_eq!(run(Native, "T3\nM6\nT4 M6"), ["2 select 3", "3 tool 3", "4 tool 4"]);
    assert_eq!(run(Native, "M6"), ["2 tool 0"]);
    assert_eq!(run(Native, "M3 S9\nT1 M6")[1..], ["3 tool 1", "3 spindle Off 9"]);
    assert_eq!(wrong(Native, "T-1"), ["2 value-out-of-range"]);
    assert_eq!(wrong(Native, "T1.5"), ["2 value-out-of-range"]);
}

#[test]
fn stops_and_ends_are_steps() {
    assert_eq!(
        trace(Native, "M0\nM1\nM60\nM2\nG0 X1\n"),
        ["1 stop optional=false", "2 stop optional=true", "3 stop optional=false", "4 end"]
    );
    assert_eq!(faults(Grbl, "M1\nM30\n"), ["1 ignored-word"]);
}

#[test]
fn coolant_and_spindle_are_steps() {
    assert_eq!(
        run(Native, "M3 S1000 M7\nM8\nM9\nM5\nS2000"),
        [
            "2 spindle Clockwise 1000",
            "2 coolant mist=true flood=false",
            "3 coolant mist=true flood=true",
            "4 coolant mist=false flood=false",
            "5 spindle Off 1000",
            "6 spindle Off 2000"
        ]
    );
    // M19 turns the spindle to an angle and stops it there.
    for dialect in [LinuxCnc, Fanuc, Haas] {
        assert_eq!(
            run(dialect, "M3 S9\nM19").last().map(String::as_str),
            Some("3 spindle Off 9"),
            "{dialect}"
        );
    }
}

#[test]
fn heights_are_as_written_or_as_drawn() {
    let program = "G21 G90\nG0 Z1.023(==1.000+0.441*[#51-2.000])\nG0 Z5.000(=5.000+1.000*[#51-2.000])\nM30\n";
    assert_eq!(trace(Native, program)[..2], ["2 rapid to ? ? 1.023", "3 rapid to ? ? 5"]);
    let nominal = Options { heights: Heights::Nominal, ..Options::default() };
    assert_eq!(trace_with(Native, program, &nominal)[..2], ["2 rapid to ? ? 1", "3 rapid to ? ? 5"]);
}

#[test]
fn a_fault_says_what_and_where() {
    let result = interpret(b"G21 G90 G17\nG0 X0 Y0 Z0\nG2 X10 Y0 I6 F10\nM30\n", Rs274, &Options::default());
    assert_eq!(
        spelled_out(&result.problems),
        "PB734 (Some(3), Some(1)) the arc begins with the radius 6 and ends with 4: the difference is 1.998 mm more than rs274 accepts \
         Some(\"G2 X10 Y0 I6 F10\")\n"
    );
    let vertical =
        interpret(b"G21 G90 G18\nG0 X0 Y0 Z0\nG2 X10 Z0 I6 K0 F10\nM30\n", Rs274, &Options::default());
    let help = vertical.problems[0].help(Lang::En);
    assert_eq!(help.as_deref(), Some("write I, K with more decimals, or check the centre"));
}

#[test]
fn what_changes_beside_the_moves_is_a_step() {
    assert_eq!(
        changes(LinuxCnc, "G21 G90\nG43 H2\nG49\nG43.1 Z3"),
        ["2 ToolLength(OfTool(Some(2)))", "3 ToolLength(Off)", "4 ToolLength(Other(431))"]
    );
    assert_eq!(
        changes(LinuxCnc, "G64 P0.5\nG61\nG64\nG20 G64 P1"),
        [
            "1 Corners(Rounded(Some(0.5)))",
            "2 Corners(Exact)",
            "3 Corners(Rounded(None))",
            "4 Corners(Rounded(Some(25.4)))"
        ]
    );
    assert_eq!(
        changes(LinuxCnc, "#5221=3\nM48\nM51 P1\nG18\nG17"),
        ["1 Parameter", "2 Switch(480)", "3 Switch(510)", "4 Plane(Zx)", "5 Plane(Xy)"]
    );
    assert_eq!(
        changes(LinuxCnc, "G10 L2 P1 X1\nG52 X0\nG52 X1\nG92 X1\nG92.1"),
        [
            "1 Offsets { code: 100, are_shifted: None, is_followed: false }",
            "2 Offsets { code: 520, are_shifted: Some(false), is_followed: true }",
            "3 Offsets { code: 520, are_shifted: Some(true), is_followed: false }",
            "4 Offsets { code: 920, are_shifted: Some(true), is_followed: false }",
            "5 Offsets { code: 921, are_shifted: Some(false), is_followed: true }"
        ]
    );
}

#[test]
fn g52_moves_the_zero_that_g92_has_set() {
    assert_eq!(
        run(LinuxCnc, "G0 X10 Y0 Z5\nG92 X0\nG52 X3\nG0 X1\nG92 X0\nG0 X1\nG52 X0\nG0 X1"),
        ["2 rapid to 10 0 5", "5 rapid to 14 0 5", "7 rapid to 15 0 5", "9 rapid to 12 0 5"]
    );
}

#[test]
fn g10_l20_says_where_the_tool_is_whatever_moves_the_zero_beside() {
    for beside in ["", "G92 X0", "G52 X3", "G92 X0\nG52 X3"] {
        let lines = run(LinuxCnc, &format!("G0 X10 Y0 Z5\n{beside}\nG10 L20 P1 X2\nG0 X3"));
        assert!(lines.last().is_some_and(|line| line.ends_with(" rapid to 11 0 5")), "{beside}: {lines:?}");
    }
}

#[test]
fn fanuc_and_haas_number_their_programs() {
    assert_eq!(wrong(Fanuc, "O1000"), FINE);
    assert_eq!(wrong(Haas, "O01000 (PLATE)"), FINE);
    assert_eq!(wrong(Fanuc, "O1000\nO1001"), ["3 word-not-followed"]);
    assert_eq!(wrong(Fanuc, "O0"), ["2 value-out-of-range"]);
    assert_eq!(wrong(Native, "O1000"), ["2 unknown-word"]);
}

#[test]
fn each_control_counts_a_dwell_in_its_own_units() {
    assert_eq!(run(LinuxCnc, "G4 P2.5"), ["2 dwell 2.5"]);
    assert_eq!(run(Fanuc, "G4 P2500"), ["2 dwell 2.5"]);
    assert_eq!(run(Fanuc, "G4 X2.5"), ["2 dwell 2.5"]);
    assert_eq!(run(Haas, "G4 P2500"), ["2 dwell 2.5"]);
    assert_eq!(run(Haas, "G4 P2.5"), ["2 dwell 2.5"]);
    assert_eq!(run(Mach3, "G4 P2.5"), ["2 dwell 2.5"]);
    assert_eq!(trace(Marlin, "G21\nG90\nG4 P2500\nG4 S2.5"), ["3 dwell 2.5", "4 dwell 2.5"]);
}

#[test]
fn skips_are_probes_that_need_no_answer() {
    for dialect in [Fanuc, Haas, Mach3] {
        assert_eq!(
            run(dialect, "G0 X0.0 Y0.0 Z5.0\nG31 Z0.0 F40.0")[1],
            "3 probe 40 toward=true must=false to 0 0 0"
        );
    }
    assert_eq!(wrong(LinuxCnc, "G31 Z0 F40")[0], "2 unknown-word");
}

#[test]
fn a_motion_word_without_coordinates_is_doubtful_where_it_does_nothing() {
    let found = |dialect, line: &str| wrong(dialect, line).contains(&"2 missing-word".to_owned());
    for dialect in [Marlin, Xpertmill] {
        assert!(found(dialect, "G1"), "{dialect}");
        assert!(!found(dialect, "G1 X1 F100"), "{dialect}");
    }
    assert!(!found(Marlin, "G1 F100") && found(Xpertmill, "G1 F100 !X1"));
    assert!(!found(LinuxCnc, "G1") && !found(Fanuc, "G1"));
}

#[test]
fn a_code_has_at_most_one_decimal() {
    for word in ["G1.0", "G01.", "G1.00"] {
        assert_eq!(
            run(LinuxCnc, &format!("G0 X0 Y0 Z5\n{word} X1 F100"))[1],
            "3 feed 100 to 1 0 5",
            "{word}"
        );
    }
    for word in ["G0.9999", "G1.01", "G0.999999"] {
        assert_eq!(wrong(LinuxCnc, &format!("G0 X0 Y0 Z5\n{word} X1 F100"))[0], "3 unknown-word", "{word}");
    }
}

#[test]
fn a_stop_switches_the_spindle_off_where_it_does() {
    let spindle =
        |dialect| run(dialect, "M3 S100\nM0").iter().filter(|step| step.contains("spindle")).count();
    assert_eq!([Haas, Fanuc, LinuxCnc, Grbl].map(spindle), [2, 1, 1, 1]);
}

#[test]
fn percent_begins_a_program_for_xpertmill_and_stands_nowhere_else() {
    let found = |program: &str| faults(Xpertmill, program).contains(&"3 doubtful-spelling".to_owned());
    assert!(!found("// a\n\n% // b\nG71\nG00 X1 Y1 Z1\nM30\n"));
    assert!(found("%\nG71\n%\nG00 X1 Y1 Z1\nM30\n"));
}

/// Returns the problems of a program that ends itself, preceded by a line with its modes.
fn wrong_of(dialect: Dialect, program: &str) -> Vec<String> {
    faults(dialect, &format!("G17 G21 G90\n{program}\n"))
}

/// Returns the X positions of a program's moves, without the moves before and after the calls.
fn places(dialect: Dialect, program: &str) -> String {
    let text = format!("G21 G90\nG0 X0. Y0. Z5.\n{program}\n");
    let moves = interpret(text.as_bytes(), dialect, &Options::default()).moves();
    moves[1..].iter().map(|(_, it)| it.to.x().to_string()).collect::<Vec<_>>().join(" ")
}

#[test]
fn subprograms_run_where_they_are_called() {
    for (dialect, program, expected) in [
        (LinuxCnc, "o1 sub\nG0 X1\no1 endsub\nG0 X2\no1 call\nG0 X3\no01 call\nM2", "2 1 3 1"),
        (
            LinuxCnc,
            "O<Slot> sub\nG0 X[#1+#2]\nO<slot> endsub\no<slot> call [1] [2]\no<SLOT> call [4]\nM2",
            "3 4",
        ),
        // The definition may come after the end of the program.
        (LinuxCnc, "o1 call\nG0 X2\nM2\no1 sub\nG0 X1\no1 endsub", "1 2"),
        (
            LinuxCnc,
            "o1 sub\no2 call\nG0 X1\no1 endsub\no2 sub\nG0 X2\no2 return\nG0 X9\no2 endsub\no1 call\nM2",
            "2 1",
        ),
        (LinuxCnc, "#1=7\n#<a>=8\no1 sub\n#1=2\n#<a>=3\no1 endsub\no1 call\nG0 X#1\nX#<a>\nM2", "7 8"),
        (LinuxCnc, "#5=0\no1 repeat [3]\n#5=[#5+1]\nG0 X#5\no1 endrepeat\nG0 X9\nM2", "1 2 3 9"),
        (LinuxCnc, "o1 repeat [0]\nG0 X1\no1 endrepeat\nG0 X9\nM2", "9"),
        (
            LinuxCnc,
            "o1 sub\no2 repeat [5]\nG0 X1\no1 return\no2 endrepeat\no1 endsub\no1 call\nG0 X9\nM2",
            "1 9",
        ),
        (LinuxCnc, "#5=0\no1 while [#5 lt 3]\n#5=[#5+1]\nG0 X#5\no1 endwhile\nG0 X9\nM2", "1 2 3 9"),
        (LinuxCnc, "o1 while [0]\nG0 X1\no1 endwhile\nG0 X9\nM2", "9"),
        (LinuxCnc, "#5=0\no1 do\n#5=[#5+1]\nG0 X#5\no1 while [#5 lt 2]\nG0 X9\nM2", "1 2 9"),
        (LinuxCnc, "o1 do\nG0 X1\no1 while [0]\nM2", "1"),
        (LinuxCnc, "o1 if [1]\nG0 X1\no1 else\nG0 X2\no1 endif\nG0 X9\nM2", "1 9"),
        (LinuxCnc, "o1 if [0]\nG0 X1\no1 elseif [0]\nG0 X2\no1 else\nG0 X3\no1 endif\nM2", "3"),
        (LinuxCnc, "o1 if [0]\nG0 X1\no1 elseif [1]\nG0 X2\no1 elseif [1]\nG0 X3\no1 endif\nM2", "2"),
        // The condition of a branch that is not reached is not evaluated, so it may be invalid.
        (LinuxCnc, "o1 if [1]\nG0 X1\no1 elseif [#<none>]\nG0 X2\no1 endif\nM2", "1"),
        (
            LinuxCnc,
            "#5=0\no1 while [1]\n#5=[#5+1]\no2 if [#5 eq 2]\no1 continue\no2 endif\no3 if [#5 gt 3]\no1 break\no3 endif\nG0 X#5\no1 endwhile\nM2",
            "1 3",
        ),
        (
            LinuxCnc,
            "#5=0\no1 do\n#5=[#5+1]\no2 if [#5 eq 2]\no1 continue\no2 endif\nG0 X#5\no1 while [#5 lt 3]\nM2",
            "1 3",
        ),
        // A condition that is false ends the effect of an earlier `continue`; a `do` loop with a single pass ends the effect of an earlier `break`.
        (
            LinuxCnc,
            "o1 do\no1 continue\no1 while [0]\no2 while [0]\no2 endwhile\no3 repeat [2]\nG0 X1\no3 endrepeat\nM2",
            "1 1",
        ),
        (LinuxCnc, "o1 while [1]\no1 break\no1 endwhile\no2 do\nG0 X1\no2 while [0]\nM2", "1"),
        // `break` may leave an outer loop.
        (LinuxCnc, "o1 while [1]\no2 while [1]\nG0 X1\no1 break\no2 endwhile\no1 endwhile\nG0 X9\nM2", "1 9"),
        (
            LinuxCnc,
            "o1 sub\no2 while [1]\nG0 X1\no1 return\no2 endwhile\no1 endsub\no3 do\no1 call\no3 while [0]\nM2",
            "1",
        ),
        (Fanuc, "M98 P2000 L2\nG0 X9.\nM30\nO2000\nG0 X1.\nM99", "1 1 9"),
        (Fanuc, "M98 P32000\nG0 X9.\nM30\nO2000 G0 X1.\nM99", "1 1 1 9"),
        (Haas, "M97 P7 L2\nG0 X9.\nM30\nN7 G0 X1.\nM99", "1 1 9"),
        (Mach3, "M98 P5\nG0 X9\nM30\nO5\nG0 X1\nM98 P6 L2\nM99\nO6\nG0 X2\nM99", "1 2 2 9"),
        (Mach3, "M98 P5 L0\nG0 X9\nM30\nO5\nG0 X1\nM99", "9"),
    ] {
        assert_eq!(places(dialect, program), expected, "{dialect}\n{program}");
        assert_eq!(wrong_of(dialect, program), FINE, "{dialect}\n{program}");
    }
}

#[test]
fn steps_are_numbered_as_they_are_executed() {
    let places = |dialect, program: &str| {
        let steps = interpret(program.as_bytes(), dialect, &Options::default()).steps;
        let moves = steps.iter().filter(|step| step.as_move().is_some());
        moves.map(|step| (step.line, step.order)).collect::<Vec<_>>()
    };
    assert_eq!(places(LinuxCnc, "G0 X1\n\n(a)\nG0 X2\nM2"), [(1, 1), (4, 4)]);
    let program = "o1 sub\nG0 X1\no1 endsub\n\n\nG0 X2\no1 call\no1 call\nG0 X3\nM2";
    assert_eq!(places(LinuxCnc, program), [(6, 2), (2, 4), (2, 7), (9, 9)]);
    let program = "G0 X1.\nM98 P2000 L2\nG0 X9.\nM30\n\nO2000\nG0 X2.\nM99";
    assert_eq!(places(Fanuc, program), [(1, 1), (7, 4), (7, 7), (3, 9)]);
}

#[test]
fn calls_that_cannot_be_followed_are_reported() {
    let sub = |name: u32, body: &str| format!("o{name} sub\n{body}\no{name} endsub\n");
    let nested = |depth: u32| {
        let all: String = (1..depth).map(|name| sub(name, &format!("o{} call", name + 1))).collect();
        format!("{all}{}o1 call\nM2", sub(depth, "G0 X1"))
    };
    let unfollowed = |dialect, program: &str| {
        wrong_of(dialect, program).iter().filter(|it| it.ends_with("word-not-followed")).count()
    };
    assert_eq!([10, 11].map(|depth| unfollowed(LinuxCnc, &nested(depth))), [0, 1]);
    for program in [
        "o1 call\nM2",
        "o1 sub\no1 call\no1 endsub\no1 call\nM2",
        "o1 sub\nG0 X1\nM2",
        "o1 repeat [3]\nG0 X1\nM2",
        "G0 X1\no1 endsub\nM2",
        "G0 X1\no1 endrepeat\nM2",
        "o1 repeat [-1]\nG0 X1\nM2",
        "o[1] call\nM2",
        "o1 while [1]\nG0 X1\nM2",
        "o1 while [1]\no1 endwhile\nM2",
        "o1 do\no1 continue\no1 while [0]\no2 repeat [1]\no2 endrepeat\nM2",
        "o1 do\no1 continue\no1 while [0]\no2 while [1]\no2 break\no2 endwhile\nM2",
        "#5=0\no1 while [1]\no1 break\no1 endwhile\no2 do\n#5=[#5+1]\no2 while [#5 lt 2]\nM2",
        "o1 if [0]\nG0 X1\nM2",
        "o1 if\no1 endif\nM2",
        "o1 break\nM2",
        "o1 repeat [2]\no1 break\no1 endrepeat\nM2",
        "o1 sub\no2 break\no1 endsub\no2 do\no1 call\no2 while [0]\nM2",
        "o1 for [1]\nM2",
        "o1 repeat [1000]\no2 repeat [1001]\n(a)\no2 endrepeat\no1 endrepeat\nM2",
    ] {
        assert_eq!(unfollowed(LinuxCnc, program), 1, "{program}");
    }
    for program in ["M98 P5\nM30", "G0 X1\nM99", "M98 P5\nM30\nO5\nG0 X1", "M98 P5\nM30\nO5\nM99 P3\nM99"] {
        assert_eq!(unfollowed(Mach3, program), 1, "{program}");
    }
    assert_eq!(unfollowed(Fanuc, "O7\nG0 X1.\nM98 P7\nM30"), 1, "the main program");
    // A subprogram that is never called is treated as text after the end of the program.
    assert_eq!(wrong_of(Mach3, "M30\nO5\nG0 X1\nM99").len(), 1);
}

/// Only lines executed by calls and loops count toward the limit.
#[test]
fn a_long_program_without_calls_is_followed_to_its_end() {
    let program = "(a)\n".repeat(1_000_001);
    assert_eq!(wrong_of(LinuxCnc, &format!("{program}M2")), FINE);
}

#[test]
fn a_line_that_is_executed_repeatedly_has_its_problem_once() {
    let found = wrong_of(LinuxCnc, "o1 repeat [50]\nG0 X1 R1\no1 endrepeat\nM2");
    assert_eq!(found, ["3 unused-word"]);
}

#[test]
fn marlin_obeys_one_command_a_line() {
    let wrong = |program: &str| faults(Marlin, &format!("G21\nG90\n{program}"));
    assert_eq!(wrong("M3 S12000"), FINE);
    assert_eq!(wrong("S12000"), ["3 unknown-word", "3 unused-word"]);
    assert_eq!(wrong("G0 Z5\nG1 X1 S5 F10"), ["4 unused-word"]);
    assert_eq!(wrong("G21 G90"), ["3 conflicting-words"]);
    assert_eq!(wrong("G0 Z5\nX5"), ["4 unknown-word", "4 motion-not-stated"]);
    assert_eq!(wrong("(a)"), ["3 unknown-character"]);
    assert_eq!(wrong("M117 Hello (world) G1\nM0 Insert T2: 3 mm ; by hand\nM0 S5 Wait"), FINE);
    assert_eq!(wrong("M2201"), ["3 unknown-word"]);
    assert_eq!(wrong("M220 S50"), ["3 word-not-followed"]);
}

#[test]
fn marlin_moves_only_in_lines_whose_command_moves() {
    let program = |line: &str| format!("G21\nG90\nG0 X0 Y0 Z5 F1000\nG1 Z-1 F100\n{line}\nG1 X9");
    let moves = |line: &str| {
        let found = interpret(program(line).as_bytes(), Marlin, &Options::default());
        found.moves().into_iter().skip(2).map(|(line, to)| (line, to.to.at)).collect::<Vec<_>>()
    };
    let values_of_commands =
        ["M203 X50 Y50 Z10", "M205 Z0.4 F5", "M204 Z10", "M117 X5 Y5 Z10", "M0 Z10", "M0 S5 X1"];
    for line in values_of_commands {
        assert_eq!(moves(line), [(6, [9.0, 0.0, -1.0])], "{line}");
        assert_eq!(faults(Marlin, &program(line)), FINE, "{line}");
    }
    for line in ["M3 Z10", "G4 P100 Z10", "G90 Z10", "G21 Z10", "M8 F50"] {
        assert_eq!(moves(line), [(6, [9.0, 0.0, -1.0])], "{line}");
        assert_eq!(faults(Marlin, &program(line)), ["5 unused-word"], "{line}");
    }
    assert_eq!(moves("G0 Z10"), [(5, [0.0, 0.0, 10.0]), (6, [9.0, 0.0, 10.0])]);
}

#[test]
fn common_words_of_marlin_are_accepted_with_their_values() {
    let wrong = |line: &str| faults(Marlin, &format!("G21\nG90\n{line}"));
    let lines = [
        "M84 S0",
        "M18 S0",
        "M204 S500",
        "M204 T500",
        "M300 S440 P200",
        "M280 P0 S10",
        "M42 P3 S255",
        "M226 P1",
        "M117 2D Contour1",
        "M118 E1 x",
        "G28 X Y",
        "G28 Z",
        "M84 X Y Z",
        "M106 S255",
        "M107",
        "M92 X80 A400",
        "M420 S1 V",
        "M211 S0",
        "M500",
        "M104 S0",
        "M205 B5 H-1 F-2",
        "M900 K0 K1",
        "M73 P10 R5",
    ];
    for line in lines {
        assert_eq!(wrong(line), FINE, "{line}");
    }
    for line in ["G29", "G30 X5 Y5", "G61 X5 F100", "M206 Z1", "M600"] {
        assert_eq!(wrong(line), ["3 word-not-followed"], "{line}");
    }
    let selects = |line: &str| trace(Marlin, line).iter().any(|step| step.contains("select"));
    assert!(selects("T2") && !selects("M204 T500") && !selects("M104 T0 S0"));
    assert_eq!(wrong("M999"), ["3 unknown-word"]);
}

#[test]
fn moves_of_an_unknown_cycle_are_not_made_up() {
    let estlcam = "G90\nG21\nG0 Z5\nG0 X0 Y0\nG83 X5 Y5 Z-5 R2 Q1 F100\nX10\nG0 X20\nM30";
    assert_eq!(faults(Estlcam, estlcam), ["5 unknown-word"]);
    let moves = |dialect, program: &str| {
        let found = interpret(program.as_bytes(), dialect, &Options::default());
        found.moves().into_iter().map(|(line, to)| (line, to.to.at)).collect::<Vec<_>>()
    };
    assert_eq!(moves(Estlcam, estlcam)[2..], [(7, [20.0, 5.0, 5.0])]);
    let fanuc = "G90 G21 G94\nG0 X0. Y0. Z5.\nG84 X5. Y5. Z-5. R2. F100.\nG0 X20.";
    assert_eq!(moves(Fanuc, fanuc)[1..], [(4, [20.0, 5.0, 5.0])], "a cycle that is not followed");
}

#[test]
fn numbers_without_a_point_are_doubtful_where_they_may_count_thousandths() {
    assert_eq!(wrong(Fanuc, "G0 X10"), ["2 doubtful-spelling"]);
    assert_eq!(wrong(Fanuc, "G0 X10.\nG0 X0\nG1 X5.0 F100"), FINE);
    assert_eq!(wrong(Haas, "G0 Z10"), ["2 doubtful-spelling"]);
    assert_eq!(wrong(Mach3, "G0 Z10"), FINE);
}

#[test]
fn linuxcnc_obeys_some_comments() {
    assert_eq!(wrong(LinuxCnc, "(LOGOPEN,a.txt)"), ["2 active-comment"]);
    assert_eq!(wrong(LinuxCnc, ";py,run()"), ["2 active-comment"]);
    assert_eq!(wrong(LinuxCnc, "(PROBEOPEN a.txt)"), ["2 active-comment"]);
    assert_eq!(wrong(LinuxCnc, "( probeopen , a)"), ["2 active-comment"]);
    for obeyed in ["PYRUN,a.py", "PYRELOAD", "LOG,a", "LOGAPPEND,a", "LOGCLOSE", "PROBECLOSE", "ABORT,a"] {
        assert_eq!(wrong(LinuxCnc, &format!("({obeyed})")), ["2 active-comment"], "{obeyed}");
        assert!(is_active_comment(obeyed), "{obeyed}");
    }
    assert_eq!(wrong(LinuxCnc, "(Pyramid)\n(Logo, abortive)\n(Preview)"), FINE);
    assert_eq!(wrong(LinuxCnc, "(drawing LOGOPEN,a)\n(LOGOPENING)\n(MSG, hello)"), FINE);
    assert_eq!(wrong(Native, "(LOGOPEN,a.txt)"), ["2 active-comment"], "LinuxCNC runs native programs");
    assert_eq!(wrong(Grbl, "(LOGOPEN,a.txt)"), FINE);
}

#[test]
fn ignored_feeds_are_not_missing() {
    let options = Options { ignore_feed: true, ..Options::default() };
    let program = "%\nG71\nG0 X0 Y0 Z5\nG1 Z-1 F100\nG1 X5\nM30\n";
    assert_eq!(faults_with(Xpertmill, program, &options), ["4 ignored-word"]);
    assert_eq!(
        faults_with(Xpertmill, &program.replace(" F100", ""), &Options::default()),
        ["4 missing-feed"]
    );
}

/// Tangents are unit vectors along the direction of travel; at the centre of the arc, the result is zero.
#[test]
fn an_arc_begins_and_ends_along_its_tangents() {
    for (code, ends) in [("G3", [[0.0, 1.0], [-1.0, 0.0]]), ("G2", [[0.0, -1.0], [1.0, 0.0]])] {
        let program = format!("{HEAD}G0 X5 Y0 Z0\n{code} X0 Y5 I-5 F10\nM30\n");
        let interpreted = interpret(program.as_bytes(), LinuxCnc, &Options::default());
        let arc = interpreted.moves().into_iter().find_map(|(_, it)| match it.shape {
            pathbuild_motion::MoveShape::Arc(arc) => Some((arc, it)),
            pathbuild_motion::MoveShape::Line => None,
        });
        let (arc, it) = arc.expect("there is an arc");
        let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-12;
        assert!(near(arc.tangent(&it.from.at), ends[0]) && near(arc.tangent(&it.to.at), ends[1]), "{code}");
        assert_eq!(arc.tangent(&[arc.centre[0], arc.centre[1], 0.0]), [0.0, 0.0]);
    }
}

#[test]
fn a_number_of_holes_names_its_letter() {
    for (dialect, letter) in [(LinuxCnc, "L"), (Haas, "L"), (Fanuc, "K")] {
        let program = format!("{HEAD}G0 X0 Y0 Z5\nG98 G81 X2. Z-3. R1. {letter}-1 F60\nG80\nM30\n");
        let problems = interpret(program.as_bytes(), dialect, &Options::default()).problems;
        let texts: Vec<String> = problems.iter().map(|it| it.text(Lang::En)).collect();
        assert!(
            texts.iter().any(|text| text.contains(&format!("{letter}-1")) || text.starts_with(letter)),
            "{texts:?}"
        );
    }
}

/// A message contains words of one language only.
#[test]
fn limits_of_values_are_said_in_both_languages() {
    let help = |program: &str, lang| {
        let program = format!("{HEAD}{program}\nM30\n");
        let faults = interpret(program.as_bytes(), LinuxCnc, &Options::default()).problems;
        faults.iter().find(|fault| fault.code().name() == "value-out-of-range").unwrap().help(lang).unwrap()
    };
    for (program, en, de) in [
        ("G1 X1 F-5", "the value must be 0 or more", "erlaubt: 0 oder mehr"),
        ("T-1 M6", "the value must be a whole number, 0 or more", "erlaubt: eine ganze Zahl ab 0"),
        ("G4 P-1", "the value must be 0 seconds or more", "erlaubt: 0 Sekunden oder mehr"),
        (
            "G0 X0 Y0 Z0\nG81 X1 Z-1 R1 L0 F9",
            "the value must be a whole number of holes, 1 or more",
            "erlaubt: eine ganze Zahl von Bohrungen ab 1",
        ),
        ("G0 X0 Y0 Z0\nG83 X1 Z-1 R1 Q0 F9", "the value must be more than 0", "erlaubt: größer als 0"),
        ("G0 X0 Y0 Z0\nG82 X1 Z-1 R1 P-1 F9", "the value must be 0 or more", "erlaubt: 0 oder mehr"),
        ("G0 X0 Y0 Z0\nG81 X1 Z1 R0 F9", "the value must be at least Z", "erlaubt: mindestens Z"),
        ("G10 L2 P11 X0", "the value must be 0 to 9", "erlaubt: 0 bis 9"),
    ] {
        assert_eq!(help(program, Lang::En), en, "{program}");
        assert_eq!(help(program, Lang::De), de, "{program}");
    }
}

#[test]
fn marlin_counts_from_the_switches_after_g28() {
    let program =
        |words: &str| format!("G21\nG90\nG28\nG0 X0 Y0 Z5 F1000\nG1 Z-1 F100\nG0 Z5 F1000\n{words}\n");
    assert_eq!(faults(Marlin, &program("G0 X1 F1000")), FINE, "before the first cut");
    let found = |words: &str| severities(Marlin, &program(words));
    let parked = found("G28 X0 Y0\nG0 X10 Y10 Z5 F1000");
    assert_eq!(parked, warned("7 word-not-followed"), "it may park the machine");
    assert_eq!(found("G28 Z0\nG0 X10 Y10 Z5 F1000\nG1 Z-1 F100"), refused("7 word-not-followed"));
    assert_eq!(trace(Marlin, "G21\nG90\nG0 X1 Y2 Z3 F100\nG28 Z0")[1..], ["4 rapid to 1 2 ? Home1"]);
}

#[test]
fn mach3_references_at_g28_1_and_others_store_the_position() {
    let program = "G21 G90\nG0 X1 Y2 Z3\nG28.1 Z0\nG0 Z5\nM30";
    let moves = ["3 rapid to 1 2 ? Home1", "4 rapid to 1 2 5", "4 end"];
    assert_eq!(trace(Mach3, program)[1..3], moves[..2]);
    assert_eq!(
        trace(LinuxCnc, "G21 G90\nG0 X1 Y2 Z3\nG28.1\nG0 Z5\nM30")[1..],
        ["4 rapid to 1 2 5", "5 end"]
    );
}

#[test]
fn a_stored_home_position_is_reported() {
    let told = |dialect, word: &str| {
        let program = format!("G21 G90 G17\nG0 X1 Y2 Z3\n{word}\nG0 Z5\nM30");
        faults(dialect, &program).iter().any(|text| text.ends_with("offset-left-on"))
    };
    assert!(told(LinuxCnc, "G28.1") && told(LinuxCnc, "G30.1") && told(Grbl, "G28.1"));
    assert!(!told(LinuxCnc, "G28") && !told(Mach3, "G28.1 Z0"));
}

/// Mach3's configuration says what I and J count from.
#[test]
fn centres_of_arcs_are_stated_where_a_setting_decides() {
    let told = |dialect, words: &str, arc: &str| {
        let program = format!("G21 G90 G17 G94 F100 {words}\nG0 X0 Y0 Z0\n{arc}\nM30");
        faults(dialect, &program).iter().any(|text| text.ends_with("modes-not-stated"))
    };
    let arc = "G2 X10 Y0 I5 J0";
    assert!(told(Mach3, "", arc));
    assert!(!told(Mach3, "G91.1", arc) && !told(Mach3, "", "G2 X10 Y0 R5") && !told(Mach3, "", "G1 X10"));
    assert!(!told(LinuxCnc, "", arc) && !told(Grbl, "", arc));
}

#[test]
fn words_that_common_builds_of_marlin_lack_are_doubtful() {
    let ignored = |word: &str| {
        let found = faults(Marlin, &format!("G21\nG90\nG17\nG0 X5 Y0 Z0 F1000\n{word}"));
        found.iter().any(|fault| fault == "5 ignored-word")
    };
    assert!(["G20", "G18", "G19", "G2 I-5 J0 P2 F100"].into_iter().all(ignored));
    assert!(!["G21", "G17", "G2 I-5 J0 F100"].into_iter().any(ignored));
}

#[test]
fn a_called_subprogram_that_is_there_twice_is_an_error() {
    let program = |number: u32| {
        format!("O1\nG21 G90\nG0 X1. Y1. Z1.\nM98 P2000\nM30\nO2000\nG0 X2.\nM99\nO{number}\nG0 X3.\nM99\n")
    };
    for dialect in [Fanuc, Haas, Mach3] {
        assert_eq!(faults(dialect, &program(2001)), FINE, "{dialect:?}");
        assert_eq!(faults(dialect, &program(2000)), ["9 word-not-followed"], "{dialect:?}");
    }
}

#[test]
fn grbl_runs_what_follows_m30() {
    let after = |dialect, rest: &str| severities(dialect, &format!("G21 G90\nM30\n{rest}"));
    assert_eq!(after(Grbl, "G0 Z-5\nG1 X1"), refused("3 after-program-end"));
    assert_eq!(after(LinuxCnc, "G0 Z-5\nG1 X1"), warned("3 after-program-end"));
    assert_eq!(after(Grbl, "(end)\n\n; end\n"), []);
}

/// A cycle that begins below R rises first, but on Fanuc the tool goes to the hole first.
#[test]
fn a_cycle_below_its_level_rises_before_or_above_the_hole() {
    let program = "G0 X0. Y0. Z-1.\nG81 X5. Y0. Z-2. R1. F80.";
    assert_eq!(run(LinuxCnc, program)[1..3], ["3 rapid to 0 0 1", "3 rapid to 5 0 1"]);
    assert_eq!(run(Fanuc, program)[1..3], ["3 rapid to 5 0 -1", "3 rapid to 5 0 1"]);
}

/// Returns the findings of a program as text and severity, after a head of two lines.
fn judged(dialect: Dialect, program: &str) -> Vec<(String, Severity)> {
    let text = format!("G17 G21 G90 G94\nG0 X0. Y0. Z5.\n{program}\nM30\n");
    let mut found = severities(dialect, &text);
    found.retain(|(text, _)| !text.ends_with("doubtful-spelling"));
    found
}

/// Returns the findings of a whole program as text and severity.
fn severities(dialect: Dialect, program: &str) -> Vec<(String, Severity)> {
    let found = interpret(program.as_bytes(), dialect, &Options::default()).problems;
    found.iter().map(|found| (fault_text(found), found.severity)).collect()
}

fn warned(text: &str) -> Vec<(String, Severity)> {
    vec![(text.to_owned(), Severity::Warning)]
}

fn refused(text: &str) -> Vec<(String, Severity)> {
    vec![(text.to_owned(), Severity::Error)]
}

#[test]
fn a_feed_is_stated_again_after_a_change_of_the_unit() {
    let cut = |dialect, words: &str| judged(dialect, &format!("G1 Z-1. F300\nX40.\nG20\n{words}\nX2."));
    for dialect in [Fanuc, Mach3, Rs274] {
        assert_eq!(cut(dialect, "G1 X1."), warned("6 unit-changed"), "{dialect:?}");
        assert_eq!(cut(dialect, "G1 X1. F10"), [], "{dialect:?}");
        assert_eq!(cut(dialect, "G21"), [], "{dialect:?}");
        assert_eq!(cut(dialect, "G0 X1."), [], "{dialect:?}");
    }
    for dialect in [LinuxCnc, Grbl] {
        assert_eq!(cut(dialect, "G1 X1."), [], "{dialect:?}");
    }
}

#[test]
fn the_unit_of_a_haas_is_a_setting() {
    assert_eq!(judged(Haas, "G1 Z-1. F300\nG20\nX1.\nG21"), refused("4 unit-changed"));
    assert_eq!(judged(Haas, "G21"), []);
    assert_eq!(judged(Fanuc, "G20"), []);
}

#[test]
fn an_offset_is_set_again_after_a_change_of_the_unit() {
    for offset in ["G52", "G92"] {
        let moved = |dialect, words: &str| judged(dialect, &format!("{offset} X10. Y0.\nG20\n{words}"));
        for dialect in [Fanuc, Mach3] {
            assert_eq!(moved(dialect, "G0 X1.\nX2."), warned("5 unit-changed"), "{dialect:?}");
            assert_eq!(moved(dialect, "G21\nG0 X1."), [], "{dialect:?}");
            assert_eq!(moved(dialect, &format!("{offset} X0. Y0.\nG0 X1.")), [], "{dialect:?}");
        }
    }
    assert_eq!(judged(LinuxCnc, "G92 X10\nG20\nG0 X1"), []);
}

#[test]
fn the_heights_of_a_cycle_are_stated_again_after_a_change_of_the_unit() {
    let drilled = |dialect, words: &str| {
        judged(dialect, &format!("G98 G83 X10. Y0. Z-2. R2. Q1. F100\nG20\nF4\n{words}\nX1.\nG80"))
    };
    for dialect in [LinuxCnc, Fanuc, Mach3] {
        assert_eq!(drilled(dialect, "X.5"), refused("6 unit-changed"), "{dialect:?}");
        assert_eq!(drilled(dialect, "X.5 Z-.1 R.1"), refused("6 unit-changed"), "{dialect:?}");
        assert_eq!(drilled(dialect, "X.5 Z-.1 R.1 Q.05"), [], "{dialect:?}");
        assert_eq!(drilled(dialect, "G21 F100"), [], "{dialect:?}");
    }
}

#[test]
fn a_cycle_does_not_outlive_a_tool_change() {
    let drilled = |dialect, words: &str| {
        judged(dialect, &format!("G98 G81 X10. Y0. Z-2. R2. F100\n{words}\nX30.\nX40.\nG80"))
    };
    for dialect in [LinuxCnc, Fanuc, Haas, Mach3] {
        assert_eq!(drilled(dialect, "T2 M6\nG43 H2"), warned("6 cycle-left-on"), "{dialect:?}");
        assert_eq!(drilled(dialect, "G80\nT2 M6\nG0"), [], "{dialect:?}");
        assert_eq!(drilled(dialect, "T2 M6\nG81 X20. Z-3. R1."), [], "{dialect:?}");
        assert_eq!(drilled(dialect, "T2 M6\nG0 Z5."), [], "{dialect:?}");
        assert_eq!(drilled(dialect, "T2"), [], "{dialect:?}");
    }
}

#[test]
fn a_low_height_of_the_machine_is_doubtful_over_the_part() {
    assert_eq!(judged(LinuxCnc, "G53 G0 Z-10\nG0 X1\nG53 G0 Z-10"), []);
    assert_eq!(judged(LinuxCnc, "G53 G0 Z-10.1\nG0 X1\nG53 G0 Z-50"), warned("3 unknown-offset"));
    assert_eq!(judged(LinuxCnc, "G53 G0 X0 Y0 Z-10.1"), warned("3 unknown-offset"));
    // At a machine position away from the part there may be a tool setter, so a low height is not reported.
    assert_eq!(judged(LinuxCnc, "G53 G0 X0 Y0\nG53 G0 Z-50"), []);
    let offsets = Some(MachineOffsets::default());
    let text = "G17 G21 G90 G94\nG0 X0 Y0 Z5\nG53 G0 Z-50\nM30\n";
    assert_eq!(faults_with(LinuxCnc, text, &Options { offsets, ..Options::default() }), FINE);
}

#[test]
fn g10_l20_after_a_probe_says_where_the_tool_is() {
    let rises = |zero: &str| {
        run(LinuxCnc, &format!("G0 X0 Y0 Z30\nG38.2 Z-20 F50\n{zero}\nG0 Z20\nG0 X5"))[2..].to_vec()
    };
    for zero in ["G10 L20 P1 Z15", "G10 L20 P0 Z15", "G92 Z15"] {
        assert_eq!(rises(zero), ["5 rapid to 0 0 20", "6 rapid to 5 0 20"], "{zero}");
    }
    // The zero of another system becomes unknown, but the tool stays where it is.
    assert_eq!(rises("G10 L20 P2 Z15")[0], "5 rapid to 0 0 20");
}

/// The operator touches off after a stop. Where the zero was before is only known to the machine.
#[test]
fn what_follows_a_cleared_touch_off_is_not_known() {
    let after = |zero: &str, rest: &str| {
        let program = format!("G1 X1 F100\n{zero}\nG0 Z5\nG1 X2\nG0 Z5\n{rest}");
        let mut found = judged(LinuxCnc, &program);
        found.retain(|(text, _)| text.ends_with("word-not-followed"));
        found.into_iter().map(|(_, severity)| severity).collect::<Vec<_>>()
    };
    let touched_off = |rest: &str| after("M0\nG92 Z0", rest);
    assert_eq!(touched_off("G92.1"), []);
    assert_eq!(touched_off("G92.1\nG0 X9"), [], "Z stays");
    assert_eq!(touched_off("G92.1\nG53 G0 Z0"), []);
    assert_eq!(touched_off("G92.1\nG0 Z9"), [Severity::Warning]);
    assert_eq!(touched_off("G92.1\nG0 Z9\nG1 X1"), [Severity::Error]);
    assert_eq!(touched_off("G92.2\nG1 X1"), [Severity::Error]);
    assert_eq!(touched_off("G92.2\nG92.3\nG1 X1"), []);
    assert_eq!(touched_off("G92.1\nM0\nG92 Z0\nG0 Z5\nG1 X1"), []);
    assert_eq!(touched_off("G92.1\nM0\nG10 L20 P1 Z0\nG0 Z5\nG1 X1"), []);
    assert_eq!(after("G92 Z5", "G92.1\nG0 Z9\nG1 X1"), [], "the program knows where the tool is");
    assert_eq!(after("M0\nG10 L20 P1 Z0", "G92.1\nG1 X1"), [], "G92.1 does not clear G10");
}

#[test]
fn m_codes_of_a_haas_take_effect_after_the_move() {
    let in_order = |dialect| run(dialect, "G0 X0. Y0. Z5.\nG1 Z-1. F100. S9000 M3\nG1 X9. M5");
    assert_eq!(
        in_order(Haas),
        [
            "2 rapid to 0 0 5",
            "3 feed 100 to 0 0 -1",
            "3 spindle Clockwise 9000",
            "4 feed 100 to 9 0 -1",
            "4 spindle Off 9000"
        ]
    );
    assert_eq!(in_order(Fanuc)[1], "3 spindle Clockwise 9000");
}

#[test]
fn places_that_the_control_keeps_are_not_set_by_parameters() {
    let set = |number: u32| wrong(LinuxCnc, &format!("#{number}=7\nG0 X1"));
    for number in [5161, 5223, 5390] {
        assert_eq!(set(number), ["2 word-not-followed"], "{number}");
    }
    for number in [5160, 5391, 100] {
        assert_eq!(set(number), FINE, "{number}");
    }
}
