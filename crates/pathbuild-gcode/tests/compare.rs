//! Tests which lists of moves are considered the same program.

mod common;

use common::fault_text;
use pathbuild_diagnostic::Lang;
use pathbuild_gcode::dialect::Dialect::{LinuxCnc, Native};
use pathbuild_gcode::interpret::{Options, interpret};
use pathbuild_gcode::verify::{Difference, DifferenceKind, Ends, Tolerance, compare};
use pathbuild_motion::Move;
use pathbuild_toolpath::{
    Comment, Count, Height, MoveClass, Names, PlannedMove as Emitted, Program, ProgramStep, Xy,
};

fn moves(program: &str) -> Vec<(u32, Move)> {
    let text = format!("G17 G21 G90 G94\nG0 X0 Y0 Z5\nF100\n{program}\nM30\n");
    let result = interpret(text.as_bytes(), LinuxCnc, &Options::default());
    assert!(
        !result.problems.iter().any(pathbuild_diagnostic::Diagnostic::is_error),
        "{:?}",
        result.problems.iter().map(fault_text).collect::<Vec<_>>()
    );
    result.moves()
}

fn differ(found: &str, expected: &str) -> Option<Difference> {
    compare(&moves(found), &moves(expected), &Tolerance::of_decimals(3))
}

/// Returns the kind of the first difference, and the line of the move in each program.
fn kind(found: &str, expected: &str) -> Option<(DifferenceKind, Option<u32>, Option<u32>)> {
    differ(found, expected)
        .map(|it| (it.kind, it.found.map(|found| found.0), it.expected.map(|expected| expected.0)))
}

fn assert_same(found: &str, expected: &str) {
    assert_eq!(differ(found, expected), None);
    assert_eq!(differ(expected, found), None);
}

#[test]
fn a_program_is_the_same_as_itself() {
    for text in [
        include_str!("programs/arcs.ngc"),
        include_str!("programs/cycles.ngc"),
        include_str!("programs/offsets.ngc"),
        include_str!("programs/units.ngc"),
    ] {
        let moves = interpret(text.as_bytes(), LinuxCnc, &Options::default()).moves();
        assert_eq!(compare(&moves, &moves, &Tolerance::of_decimals(3)), None);
    }
}

#[test]
fn ends_agree_within_half_a_unit_of_the_last_digit() {
    assert_same("G1 X10 Y5 Z1", "G1 X10.0005 Y5 Z1.0005");
    assert_eq!(kind("G1 X10 Y5 Z1", "G1 X10.0006 Y5 Z1"), Some((DifferenceKind::Place, Some(4), Some(4))));
    assert_eq!(kind("G1 X10 Y5 Z1", "G1 X10 Y5 Z1.0006"), Some((DifferenceKind::Place, Some(4), Some(4))));
}

#[test]
fn feeds_agree_within_the_tolerance() {
    assert_same("G1 X10 F100", "G1 X10 F100.0005");
    assert_eq!(kind("G1 X10 F100", "G1 X10 F100.0006"), Some((DifferenceKind::Feed, Some(4), Some(4))));
}

#[test]
fn rapid_moves_are_no_cuts() {
    assert_eq!(kind("G1 X10", "G0 X10"), Some((DifferenceKind::Pace, Some(4), Some(4))));
    assert_eq!(kind("G38.2 Z1", "G38.3 Z1"), Some((DifferenceKind::Pace, Some(4), Some(4))));
    assert_same("G38.2 Z1\nG0 Z5", "G38.2 Z1\nG0 Z5");
    assert_eq!(
        kind("G38.2 Z1 F10\nG0 Z5", "G38.2 Z1 F11\nG0 Z5"),
        Some((DifferenceKind::Feed, Some(4), Some(4)))
    );
}

#[test]
fn order_counts() {
    assert_eq!(
        kind("G1 X10\nY10\nX0\nY0", "G1 Y10\nX10\nY0\nX0"),
        Some((DifferenceKind::Place, Some(4), Some(4)))
    );
}

#[test]
fn lines_may_be_cut_into_pieces() {
    assert_same("G1 X10 Y10 Z-1", "G1 X2.5 Y2.5 Z3.5\nX7.5 Y7.5 Z0.5\nX10 Y10 Z-1");
    assert_same("G1 X10 Y10", "G1 X5 Y5.0019\nX10 Y10");
    assert_eq!(kind("G1 X10 Y10", "G1 X5 Y5.0021\nX10 Y10"), Some((DifferenceKind::Place, Some(4), Some(4))));
}

#[test]
fn pieces_have_the_feed_of_the_whole() {
    assert_eq!(kind("G1 X10", "G1 X5\nX10 F90"), Some((DifferenceKind::Feed, Some(4), Some(5))));
}

#[test]
fn moves_that_go_nowhere_do_not_count() {
    assert_same("G1 X10\nX10\nG0 X10\nG1 Y10", "G1 X10\nY10");
    assert_same("G1 X10\nG0 Z5\nG1 Y10", "G1 X10\nY10");
    // The end of a short arc may be moved by this distance to avoid a full circle.
    assert_same("G1 X10\nX10.0014\nX10 Y10", "G1 X10\nY10");
    assert!(differ("G1 X10\nX10.0016\nX10 Y10", "G1 X10\nY10").is_some());
}

#[test]
fn a_way_back_is_not_a_way() {
    assert!(differ("G1 X10", "G1 X12\nX10").is_some());
    assert!(differ("G1 X10\nX0", "G1 X5\nX0").is_some());
    assert!(differ("G1 X10\nX0\nX10", "G1 X10").is_some());
}

#[test]
fn circles_may_be_halves() {
    assert_same("G2 X0 Y0 I5 J0", "G2 X10 Y0 I5 J0\nX0 Y0 I-5 J0");
    assert_same("G2 X0 Y0 I5 J0 P3", "G2 X0 Y0 I5 J0\nX0 Y0 I5 J0\nX0 Y0 I5 J0");
    assert_same("G2 X10 Y0 I5 J0 Z3", "G2 X5 Y5 I5 J0 Z4\nX10 Y0 I0 J-5 Z3");
    assert_same("G2 X10 Y0 I5 J0", "G2 X10 Y0 R5");
}

#[test]
fn a_circle_is_not_nothing_and_no_two_circles() {
    assert!(differ("G2 X0 Y0 I5 J0\nG1 X1", "G1 X1").is_some());
    assert!(differ("G2 X0 Y0 I5 J0", "G2 X0 Y0 I5 J0 P2").is_some());
    assert!(differ("G2 X0 Y0 I5 J0", "G3 X0 Y0 I5 J0").is_some());
    assert!(differ("G2 X10 Y0 I5 J0", "G3 X10 Y0 I5 J0").is_some());
}

#[test]
fn arcs_have_one_centre() {
    assert_same("G2 X10 Y0 I5 J0", "G2 X10 Y0 I5.0004 J0.0004");
    assert_eq!(
        kind("G2 X10 Y0 I5 J0", "G2 X10 Y0 I5 J-0.01"),
        Some((DifferenceKind::Shape, Some(4), Some(4)))
    );
    assert_eq!(kind("G2 X10 Y0 I5 J0", "G1 X10 Y0"), Some((DifferenceKind::Shape, Some(4), Some(4))));
}

#[test]
fn arcs_may_be_chords_where_that_is_tolerated() {
    let chords = |count: u32| {
        (1..=count).fold("G1".to_owned(), |text, number| {
            let angle = std::f64::consts::PI * f64::from(number) / f64::from(count);
            let z = 5.0 - 2.0 * f64::from(number) / f64::from(count);
            format!("{text} X{:.3} Y{:.3} Z{z:.3}\n", 5.0 - 5.0 * libm::cos(angle), 5.0 * libm::sin(angle))
        })
    };
    let arc = moves("G2 X10 Y0 Z3 I5 J0");
    let tolerance = Tolerance { chord: 0.01, ..Tolerance::of_decimals(3) };
    // For a deviation of 0.01 mm at a radius of 5 mm, chords of up to 7.2 degrees suffice.
    assert_eq!(compare(&moves(&chords(26)), &arc, &tolerance), None);
    assert_eq!(compare(&arc, &moves(&chords(26)), &tolerance), None);
    assert!(compare(&moves(&chords(16)), &arc, &tolerance).is_some());
    assert!(compare(&moves(&chords(26)), &arc, &Tolerance::of_decimals(3)).is_some());
}

#[test]
fn missing_and_surplus_moves_are_told_apart() {
    assert_eq!(kind("G1 X10", "G1 X10\nY10"), Some((DifferenceKind::Place, None, Some(5))));
    assert_eq!(kind("G1 X10\nY10", "G1 X10"), Some((DifferenceKind::Place, Some(5), None)));
    assert_eq!(kind("", "G1 X10"), Some((DifferenceKind::Place, None, Some(4))));
}

#[test]
fn the_way_to_the_first_place_must_be_the_same_if_all_moves_count() {
    let start = |program: &str| {
        interpret(format!("G21 G90 G17\n{program}\nG1 X10 F5\nM30\n").as_bytes(), Native, &Options::default())
            .moves()
    };
    let is_same = |found: &str, expected: &str| {
        compare(&start(found), &start(expected), &Tolerance { ends: Ends::All, ..Tolerance::of_decimals(3) })
            .is_none()
    };
    let usual = "G0 Z5\nG0 X1 Y1";
    assert!(is_same("G0 Z5.0005\nG0 X1 Y1", usual));
    let is_placed_alike =
        |found: &str| compare(&start(found), &start(usual), &Tolerance::of_decimals(3)).is_none();
    assert!(is_placed_alike("G0 X1 Y1\nG0 Z5"));
    assert!(!is_placed_alike("G0 Z5\nG0 X2 Y1"));
    for other in [
        "G0 X1 Y1\nG0 Z5",
        "G0 X1 Y1 Z5",
        "G0 Z-5\nG0 Z5\nG0 X1 Y1",
        "G0 Z5\nG0 X0 Y0\nG0 X1 Y1",
        "G0 Z5\nG0 X2 Y1\nG0 X1",
        "G1 Z5 F100\nG0 X1 Y1",
        "G53 G0 Z-1\nG0 Z5\nG0 X1 Y1",
    ] {
        assert!(!is_same(other, usual), "{other}");
        assert!(!is_same(usual, other), "{other}");
    }
}

/// A position of which no axis is known has the coordinates of the machine.
#[test]
fn a_difference_before_the_position_is_known_names_what_is_known() {
    let said = |found: &str, expected: &str| {
        let read = |text: &str| interpret(text.as_bytes(), LinuxCnc, &Options::default()).moves();
        let all = Tolerance { ends: Ends::All, ..Tolerance::of_decimals(3) };
        compare(&read(found), &read(expected), &all).expect("a difference").diagnostic().text(Lang::En)
    };
    let raised = said("G21 G90\nG0 Z-5\nM30\n", "G21 G90\nG0 Z15\nM30\n");
    assert!(raised.contains("here the tool goes to Z-5.000, but in line 2"), "{raised}");
    let machine = said("G21 G90\nG53 G0 Z-80\nM30\n", "G21 G90\nG53 G0 Z-1\nM30\n");
    assert!(machine.contains("Z-80.000") && machine.contains("Z-1.000"), "{machine}");
}

#[test]
fn heads_and_feet_of_a_post_processor_may_be_left_out() {
    let (found, expected) =
        (moves("G0 X-5\nZ9\nX0 Z5\nG1 X10\nY10\nG0 Z20\nX0 Y0"), moves("G1 X10\nY10\nG0 Z5"));
    assert!(compare(&found, &expected, &Tolerance::of_decimals(3)).is_some());
    let cutting = Tolerance { ends: Ends::Cutting, ..Tolerance::of_decimals(3) };
    assert_eq!(compare(&found, &expected, &cutting), None);
    assert!(compare(&moves("G1 X10\nG0 Y10\nG1 X0"), &moves("G1 X10\nG0 Y11\nG1 X0"), &cutting).is_some());
}

#[test]
fn a_difference_is_said_with_both_lines() {
    let said = |found: &str, expected: &str| differ(found, expected).expect("a difference").diagnostic();
    let diagnostic = said("G1 X10\nX20 Y1", "G1 X10\nX20 Y2");
    assert_eq!(fault_text(&diagnostic), "5 moves-differ");
    assert_eq!(
        diagnostic.text(Lang::En),
        "the moves differ: here the tool goes to X20.000 Y1.000 Z5.000, but in line 5 of the other program to X20.000 Y2.000 Z5.000"
    );
    assert_eq!(
        said("G1 X10", "G0 X10").text(Lang::En),
        "the moves differ: this is a cutting move, but in line 4 of the other program it is a rapid move"
    );
    assert_eq!(
        said("G1 X10", "G1 X10 F7").text(Lang::En),
        "the feeds differ: 100 here, but 7 in line 4 of the other program"
    );
    assert_eq!(
        said("G1 X10", "G1 X10\nY3").text(Lang::En),
        "the moves end here, but the other program goes on in line 5"
    );
    assert_eq!(
        said("G1 X10\nY3", "G1 X10").text(Lang::En),
        "the other program has no more moves, but this program goes on here"
    );
}

fn emitted(to: Emitted) -> ProgramStep {
    // The only arc is a full circle.
    let length =
        if let Emitted::Arc { centre, .. } = to { std::f64::consts::TAU * centre.coords.norm() } else { 0.0 };
    ProgramStep::Move { to, count: Count { class: MoveClass::Milling, length, feed: None } }
}

fn height(z: f64) -> Height {
    Height { z, at: Xy::new(0.0, 0.0) }
}

/// Returns a program with every kind of move and coordinates that need more than three decimals.
fn program() -> Program {
    let third = 1.0 / 3.0;
    let mut names = Names::default();
    let question = Comment::Question(names.intern("ready"));
    Program {
        sweep_height: 20.0,
        thickness: 5.0,
        tool: 2.0,
        names,
        steps: vec![
            emitted(Emitted::Sweep { to: Xy::new(third, -third) }),
            emitted(Emitted::Lift { z: height(5.0) }),
            emitted(Emitted::Drill { feed: 150.0, z: height(4.0 + third) }),
            ProgramStep::Comment(question),
            emitted(Emitted::Line { feed: 80.0, to: Xy::new(10.0 + third, 0.0), z: height(4.0) }),
            emitted(Emitted::Drill { feed: 80.0, z: height(3.0) }),
            emitted(Emitted::Arc {
                feed: 60.0,
                clockwise: true,
                centre: Xy::new(-third, third),
                to: Xy::new(10.0 + third, 0.0),
                z: height(2.0),
                is_spiral: false,
            }),
        ],
        ..Program::default()
    }
}

const NATIVE: &str = "%\nG17 G21 G40 G49 G54 G80 G90 G94\nT1\nG00 Z20.000\nG00 X0.000 Y0.000\nG00 X0.333 Y-0.333\nG00 Z5.000\n\
    G01 F150.000 Z4.333\n(Q:ready)\nG01 F80.000 X10.333 Y0.000 Z4.000\nG01 F80.000 Z3.000\nG02 F60.000 I-0.333 J0.333 X10.333 Y0.000 Z2.000\n\
    G00 Z20.000\nM30\n%\n";

#[test]
fn a_program_is_the_same_as_its_own_text() {
    let read = interpret(NATIVE.as_bytes(), Native, &Options::default());
    assert_eq!(read.problems.len(), 0);
    assert_eq!(
        compare(&read.moves(), &program().moves().collect::<Vec<_>>(), &Tolerance::of_decimals(3)),
        None
    );
}

#[test]
fn every_number_of_a_programs_text_counts() {
    let expected: Vec<_> = program().moves().collect();
    let lines: Vec<&str> = NATIVE.lines().collect();
    // Lines 7 to 14 belong to the program itself. Each digit of each coordinate and feed, except the last, is changed in turn.
    for (index, line) in lines.iter().enumerate().take(14).skip(6) {
        for (at, digit) in line.char_indices().filter(|(at, letter)| letter.is_ascii_digit() && *at > 3) {
            if line.starts_with('(') {
                continue;
            }
            let mut changed = (*line).to_owned();
            changed.replace_range(at..=at, if digit == '9' { "7" } else { "9" });
            let mut text = lines.clone();
            text[index] = &changed;
            let read = interpret(format!("{}\n", text.join("\n")).as_bytes(), Native, &Options::default());
            assert!(compare(&read.moves(), &expected, &Tolerance::of_decimals(3)).is_some(), "{changed}");
        }
    }
}

/// Comments are ignored, even in the middle of a line; words that may change how the moves are read are not.
#[test]
fn lines_are_alike_by_their_words() {
    let same = pathbuild_gcode::verify::same_move_lines;
    assert!(same("G01 X1.000 Y2.000\nG00 Z5.000\n", "g1(to the left)x1(=1.0) Y2;down\nS9\nG0 Z5\n"));
    for word in ["M5", "G91", "G20"] {
        let with_word = format!("G1 X1 Y2\n{word}\nG0 Z5\n");
        assert!(!same("G01 X1.000 Y2.000\nG00 Z5.000\n", &with_word), "{word}");
    }
    assert!(!same("G01 X1.000 Y2.000\n", "G1 (to the left) X1 Y3\n"));
    assert!(!same("G01 X1.000 Y2.000\n", "G1 (to the left) X1\n"));
    assert!(same("G01 X1.000\n", "G1 X1.001\n") && !same("G01 X1.000\n", "G1 X1.0011\n"));
}

/// If an arc consists of rounded numbers, the radii at its ends differ, and its centre is known no better than this difference.
#[test]
fn an_arc_is_compared_as_exactly_as_its_radii_agree() {
    let half_circle = |end: &str, centre: &str| moves(&format!("G0 X0 Y0 Z0\nG2 X{end} Y0 {centre} F100"));
    let tolerance = Tolerance { place: 0.00005, ..Tolerance::of_decimals(3) };
    let is_same =
        |found: &[(u32, Move)], expected: &[(u32, Move)]| compare(found, expected, &tolerance).is_none();
    let rounded = half_circle("20.002", "I10 J0");
    assert!(is_same(&half_circle("20.002", "I10.001 J0.002"), &rounded));
    assert!(!is_same(&half_circle("20.002", "I10.001 J0.01"), &rounded));
    let exact = half_circle("20", "I10 J0");
    assert!(!is_same(&half_circle("20", "I10 J0.002"), &exact));
}
