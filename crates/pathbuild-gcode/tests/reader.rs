//! Tests the reader: how lines become words in each dialect. (book: program/reading)

mod common;

use common::{faults, reading_faults, spelled_out, words};
use pathbuild_gcode::dialect::Dialect::{Grbl, LinuxCnc, Marlin, Native, Rs274, Xpertmill};
use pathbuild_gcode::read::{BlockReader, Op, Value};

/// Returns value and number of decimals of the first word.
fn number(text: &str) -> (f64, u8) {
    let mut reader = BlockReader::new(text.as_bytes(), Rs274.rules());
    let block = reader.next_block().expect("a block");
    match block.words[0].value {
        Value::Number(number) => (number.value, number.decimals),
        Value::Expression(_) => panic!("an expression"),
    }
}

#[test]
fn words_are_letters_and_numbers() {
    assert_eq!(words(Rs274, "G01X-1.5Y+.25 z3.\n"), ["1: G1 X-1.5 Y0.25 Z3"]);
}

#[test]
fn numbers_are_the_nearest_double_of_their_text() {
    for text in
        ["0.1", "16777217", "9007199254740993", "0.12345678901234567890", "-123.456", "999999999999999", "1e"]
    {
        let text = text.trim_end_matches('e');
        assert_eq!(number(&format!("X{text}")).0, text.parse().expect("a number"), "{text}");
    }
}

#[test]
fn numbers_keep_how_many_decimals_they_had() {
    assert_eq!(number("X1.500"), (1.5, 3));
    assert_eq!(number("X1."), (1.0, 0));
    assert_eq!(number("X1"), (1.0, 0));
}

#[test]
fn an_exponent_is_a_word_of_its_own() {
    assert_eq!(words(LinuxCnc, "X1E5"), ["1: X1 E5"]);
}

#[test]
fn a_number_has_one_point_at_most() {
    assert_eq!(reading_faults(Rs274, b"G0 X1.2.3\nG0 X1.2\n"), ["1 invalid-word"]);
    assert_eq!(
        reading_faults(Rs274, b"G0 X.\nG0 X-\nG0 X--1\n"),
        ["1 invalid-word", "2 invalid-word", "3 invalid-word"]
    );
}

#[test]
fn a_broken_line_is_left_out_and_the_next_one_read() {
    assert_eq!(words(Rs274, "G0 X1\nG0 XY\nG0 X3\n"), ["1: G0 X1", "3: G0 X3"]);
    assert_eq!(reading_faults(Rs274, b"G0 X1\nG0 XY\nG0 X3\n"), ["2 invalid-word"]);
}

#[test]
fn a_fault_has_its_line_column_and_text() {
    let mut reader = BlockReader::new("G0 X1\nG0 (ä) Y$\n".as_bytes(), Rs274.rules());
    while reader.next_block().is_some() {}
    let problems = reader.into_problems().into_diagnostics();
    assert_eq!(
        spelled_out(&problems),
        "PB703 (Some(2), Some(8)) `Y` has no number; the line is ignored Some(\"Y\")\n"
    );
}

#[test]
fn blanks_within_a_number_mean_nothing_and_are_doubtful() {
    assert_eq!(words(Rs274, "g0x +0. 12 34y 7"), ["1: G0 X0.1234 Y7"]);
    assert_eq!(reading_faults(Rs274, b"g0x +0. 12 34y 7"), ["1 doubtful-spelling"]);
    assert_eq!(reading_faults(Rs274, b"g0 x 0.1234 y 7"), [""; 0]);
}

#[test]
fn blanks_separate_for_xpertmill() {
    assert_eq!(words(Xpertmill, "M06 05\n"), ["1: M6 T5"]);
    assert_eq!(words(Rs274, "M06 05\n"), ["1: M605"]);
}

#[test]
fn a_bare_number_is_the_tool_behind_m6_only() {
    assert_eq!(reading_faults(Xpertmill, b"M6 5\n"), [""; 0]);
    assert_eq!(reading_faults(Xpertmill, b"M30 5\n1 comment\n"), ["1 invalid-word", "2 invalid-word"]);
    assert_eq!(reading_faults(Rs274, b"X1 (a) 5\n"), ["1 invalid-word"]);
}

#[test]
fn a_decimal_comma_is_read_by_xpertmill_with_a_warning() {
    assert_eq!(words(Xpertmill, "G1 Y1,200 Z-5,250"), ["1: G1 Y1.2 Z-5.25"]);
    assert_eq!(reading_faults(Xpertmill, b"G1 Y1,200"), ["1 doubtful-spelling"]);
    assert_eq!(reading_faults(Rs274, b"G1 Y1,200"), ["1 unknown-character"]);
}

#[test]
fn comments_are_kept() {
    assert_eq!(words(LinuxCnc, "G0 (go; there) X1 ; end (of it\n"), ["1: G0 X1 (go; there) ( end (of it)"]);
    assert_eq!(words(Xpertmill, "% //Start\nG0 X1 ! here\n"), ["1: (Start)", "2: G0 X1 ( here)"]);
}

#[test]
fn comments_of_other_dialects_are_errors_or_warnings() {
    assert_eq!(reading_faults(Rs274, b"G0 X1 ; no\n"), ["1 unknown-character"]);
    assert_eq!(
        reading_faults(Xpertmill, b"G0 X1 ; no\nG0 X2 (no)\nG0 X3 ! no\n"),
        ["1 doubtful-spelling", "2 doubtful-spelling", "3 doubtful-spelling"]
    );
    assert_eq!(reading_faults(Grbl, b"G0 X1 // no\n"), ["1 unknown-character"]);
}

#[test]
fn comments_are_closed_in_their_line() {
    assert_eq!(reading_faults(Native, b"G0 X1 (here\nG0 X2 (here)\n"), ["1 invalid-comment"]);
}

#[test]
fn comments_within_comments_are_an_error_where_the_control_says_so() {
    for (dialect, expected) in [(Rs274, 1), (LinuxCnc, 1), (Grbl, 0), (Native, 0), (Xpertmill, 0)] {
        let faults = reading_faults(dialect, b"X1 (a (b)\n");
        assert_eq!(
            faults.iter().filter(|fault| fault.ends_with("invalid-comment")).count(),
            expected,
            "{dialect}"
        );
    }
}

#[test]
fn text_that_is_no_utf8_is_read_as_windows_1252() {
    let mut reader = BlockReader::new(b"(Schl\xFCssel)\n", Native.rules());
    let block = reader.next_block().expect("a block");
    assert_eq!(block.text_of(block.comments[0].text), "Schlüssel");
}

#[test]
fn percent_signs_frame_a_program() {
    assert_eq!(words(Rs274, "(leader)\n%\nG0 X1\n%\nany text\n"), ["1: (leader)", "3: G0 X1"]);
    assert_eq!(reading_faults(Rs274, b"%\nG0 X1\n%\nany text\n"), ["4 after-program-end"]);
    assert_eq!(reading_faults(Rs274, b"%\nG0 X1\n%\n\n  \n"), [""; 0]);
}

#[test]
fn a_percent_sign_behind_words_ends_the_program() {
    assert_eq!(words(Rs274, "G0 X1\n%\nG0 X2\n"), ["1: G0 X1"]);
}

#[test]
fn text_behind_a_percent_sign_is_a_comment() {
    assert_eq!(words(Rs274, "%O1000\nG0 X1\n"), ["1: (O1000)", "2: G0 X1"]);
    assert_eq!(reading_faults(Rs274, b"%O1000\nG0 X1\n"), ["1 doubtful-spelling"]);
}

#[test]
fn grbl_refuses_percent_signs() {
    assert_eq!(reading_faults(Grbl, b"%\nG0 X1\n%\nG0 X2\n"), ["1 unknown-word", "3 unknown-word"]);
}

#[test]
fn block_numbers_are_the_dialects() {
    assert_eq!(
        reading_faults(Rs274, b"N99999 G0 X1\nN100000 G0 X1\nN1.5 X1\nX1 N5\n"),
        ["2 invalid-word", "3 invalid-word", "4 invalid-word"]
    );
    assert_eq!(reading_faults(LinuxCnc, b"N56.78 G0 X1\n"), [""; 0]);
    assert_eq!(reading_faults(Grbl, b"N10000000 X1\nN10000001 X1\n"), ["2 invalid-word"]);
}

/// Marlin's messages are "No Checksum with line number", "No Line Number with checksum", and "checksum mismatch".
#[test]
fn marlin_numbers_lines_only_with_a_checksum() {
    assert_eq!(words(Marlin, "N5 G1 X2*103\n"), ["1: G1 X2"]);
    let fine = b"G1 X2\nN5 G1 X2*103\n  N5 G1 X2*103 ; note\nN7 G1 X2 *69\nN6 M117 Hi*35\n";
    assert_eq!(reading_faults(Marlin, fine), [""; 0]);
    assert_eq!(
        reading_faults(Marlin, b"N5 G1 X2*102\nN5 G1 X3*103\nN5 G1 X2*\nN5 G1 X2*x\n"),
        ["1 invalid-word", "2 invalid-word", "3 invalid-word", "4 invalid-word"]
    );
    assert_eq!(
        reading_faults(Marlin, b"N5 G1 X2\nG1 X2*60\n"),
        ["1 doubtful-spelling", "2 doubtful-spelling"]
    );
    assert_eq!(reading_faults(Grbl, b"N5 G1 X2*103\n"), ["1 unknown-character"]);
}

#[test]
fn marlin_reads_a_number_up_to_a_space() {
    assert_eq!(words(Marlin, "G0 X 1 Z  -5\n"), ["1: G0 X1 Z-5"]);
    assert_eq!(reading_faults(Marlin, b"G0 X 1 Z  -5\n"), [""; 0]);
    assert_eq!(
        reading_faults(Marlin, b"G0 Z1 5\nG0 Z1 .5\nG0 Z- 5\n"),
        ["1 invalid-word", "2 invalid-word", "3 invalid-word"]
    );
    assert_eq!(words(Grbl, "G0 Z1 5\n"), ["1: G0 Z15"]);
    assert_eq!(words(Marlin, "M117 2D Contour1\nM0 5 holes\n"), ["1: M117 (2D Contour1)", "2: M0 (5 holes)"]);
}

#[test]
fn marlin_takes_letters_without_a_number_as_options() {
    assert_eq!(words(Marlin, "G28 X Y\nG28 Z\nM84 XY Z\n"), ["1: G28 X0 Y0", "2: G28 Z0", "3: M84 X0 Y0 Z0"]);
    assert_eq!(reading_faults(Marlin, b"G28 XYZ\nM420 V\nM18 X ; off\n"), [""; 0]);
    assert_eq!(
        reading_faults(Marlin, b"G1 X\nM3 S\nG92 X\nM84 Xend\n"),
        ["1 invalid-word", "2 invalid-word", "3 invalid-word", "4 invalid-word"]
    );
    assert_eq!(reading_faults(LinuxCnc, b"G28 X\n"), ["1 invalid-word"]);
}

#[test]
fn a_slash_marks_a_line_that_a_switch_leaves_out() {
    assert_eq!(words(Rs274, "/G0 X1\n"), ["1: G0 X1"]);
    assert_eq!(reading_faults(Rs274, b"/G0 X1\n"), ["1 optional-line"]);
    assert_eq!(reading_faults(Grbl, b"/G0 X1\n"), ["1 optional-line"]);
    assert_eq!(reading_faults(Xpertmill, b"/G0 X1\n"), ["1 unknown-character"]);
}

#[test]
fn lines_are_as_long_as_the_control_takes() {
    let line = |length: usize| format!("G0 X1 ({})\n", "a".repeat(length - 8));
    assert_eq!(reading_faults(LinuxCnc, line(255).as_bytes()), [""; 0]);
    assert_eq!(reading_faults(LinuxCnc, line(256).as_bytes()), ["1 long-line"]);
    assert_eq!(reading_faults(Rs274, line(256).as_bytes()), [""; 0]);
    assert_eq!(reading_faults(Rs274, line(257).as_bytes()), ["1 long-line"]);
}

#[test]
fn grbl_counts_lines_without_blanks_and_comments() {
    let line = |digits: usize| format!("G0 X1.{} (remark) Y2\n", "1".repeat(digits));
    assert_eq!(reading_faults(Grbl, line(72).as_bytes()), [""; 0]);
    assert_eq!(reading_faults(Grbl, line(73).as_bytes()), ["1 long-line"]);
}

#[test]
fn a_line_without_end_is_not_kept() {
    let mut text = "G0 X1\n".to_owned();
    text.push_str(&"X1".repeat(40_000));
    text.push_str("\nG0 X2\n");
    assert_eq!(words(Native, &text), ["1: G0 X1", "3: G0 X2"]);
    assert_eq!(reading_faults(Native, text.as_bytes()), ["2 long-line"]);
}

#[test]
fn grbl_obeys_some_bytes_wherever_they_stand() {
    assert_eq!(reading_faults(Grbl, b"(Hallo!)\n"), ["1 real-time-character"]);
    assert_eq!(reading_faults(Grbl, "(Ä)\n".as_bytes()), ["1 real-time-character"]);
    // An ä consists of the bytes C3 A4, which are both removed.
    assert_eq!(reading_faults(Grbl, "(ä)\n".as_bytes()), [""; 0]);
    assert_eq!(reading_faults(LinuxCnc, "(Ä!)\n".as_bytes()), [""; 0]);
}

#[test]
fn every_line_end_is_one() {
    for text in ["G0 X1\nG0 X2\n", "G0 X1\r\nG0 X2\r\n", "G0 X1\rG0 X2\r", "\u{feff}G0 X1\n\n  \nG0 X2"] {
        assert_eq!(words(Native, text).len(), 2, "{text:?}");
    }
}

#[test]
fn line_numbers_count_blank_and_broken_lines() {
    assert_eq!(words(Native, "\r\n?\r\nG0 X1\r\n"), ["3: G0 X1"]);
}

#[test]
fn formulas_are_kept_as_data() {
    let mut reader = BlockReader::new(b"G0 Z1.000(=1.000+0.5*[#51-5.000]) X2\n", Native.rules());
    let block = reader.next_block().expect("a block");
    let formula = block.formula(1).expect("the formula of Z");
    assert!(!formula.applied);
    assert_eq!(block.text_of(formula.span), "(=1.000+0.5*[#51-5.000])");
    assert_eq!(block.code(formula.code)[0], Op::Number(1.0));
    assert_eq!(block.code(formula.code).len(), 8);
    assert_eq!(block.words.len(), 3);
}

#[test]
fn applied_formulas_are_told_apart() {
    let mut reader = BlockReader::new(b"G0 Z1.023(==1.000+0.441*[#51-2.000])\n", Native.rules());
    assert!(reader.next_block().expect("a block").formulas[0].applied);
}

#[test]
fn formulas_have_both_kinds_of_brackets() {
    assert_eq!(reading_faults(Native, b"G0 Z1(=1+2*(-#51/(3-[4])))\n"), [""; 0]);
    assert_eq!(reading_faults(Native, b"G0 Z1(=1+2*(3)\n"), ["1 invalid-expression"]);
    assert_eq!(reading_faults(Native, b"G0 Z1(=1+)\n"), ["1 invalid-expression"]);
}

#[test]
fn an_equals_sign_in_a_comment_of_its_own_is_no_formula() {
    assert_eq!(reading_faults(Native, b"(= heading =)\nG0 (=x) Z1\n"), ["2 invalid-expression"]);
    assert_eq!(reading_faults(Rs274, b"G0 Z1(=what)\n"), [""; 0]);
}

#[test]
fn expressions_are_refused_where_there_are_none() {
    assert_eq!(
        reading_faults(Grbl, b"G0 X[1]\n#1=2\nG0 X#1\n"),
        ["1 unknown-word", "2 unknown-word", "3 unknown-word"]
    );
    assert_eq!(reading_faults(Rs274, b"G0 X[1]\n#1=2\nG0 X#1\n"), [""; 0]);
}

#[test]
fn expressions_are_checked_for_their_form() {
    for wrong in [
        "X[1+]",
        "X[1",
        "X[1 2]",
        "X[SIN 1]",
        "X[ATAN[1]]",
        "X[1 EQ 1]",
        "X#",
        "#1",
        "X[FOO[1]]",
        "X-[1]",
        "X#<a>",
    ] {
        assert_eq!(reading_faults(Rs274, wrong.as_bytes()).len(), 1, "{wrong}");
    }
    for right in ["X[1+2]", "X[SIN[1]]", "X[ATAN[1]/[2]]", "X##1", "#1=#2", "XABS[-1]", "X[-1--1]"] {
        assert_eq!(reading_faults(Rs274, right.as_bytes()), [""; 0], "{right}");
    }
    for right in ["X[1 EQ 1]", "X-[1]", "X-#1", "X#<a>", "#<a b>=1", "X[-SIN[1]]", "X[EXISTS[#<a>]]"] {
        assert_eq!(reading_faults(LinuxCnc, right.as_bytes()), [""; 0], "{right}");
    }
}

#[test]
fn brackets_are_nested_so_deep() {
    let nested = |depth: usize| format!("X{}1{}\n", "[".repeat(depth), "]".repeat(depth));
    assert_eq!(reading_faults(Rs274, nested(40).as_bytes()), [""; 0]);
    assert_eq!(reading_faults(Rs274, nested(41).as_bytes()), ["1 invalid-expression"]);
    assert_eq!(reading_faults(Rs274, nested(10_000).as_bytes()), ["1 invalid-expression"]);
    assert_eq!(
        reading_faults(LinuxCnc, format!("X{}1\n", "-#".repeat(10_000)).as_bytes()),
        ["1 invalid-expression"]
    );
}

#[test]
fn o_words_take_the_rest_of_their_line() {
    let mut reader = BlockReader::new(b"o100 call [1] [2]\nG0 X1\n", LinuxCnc.rules());
    let block = reader.next_block().expect("a block");
    assert_eq!(block.text_of(block.o_word.expect("an O word").span), "o100 call [1] [2]");
    assert_eq!(words(LinuxCnc, "o100 call [1] [2]\nG0 X1\n"), ["1:", "2: G0 X1"]);
}

#[test]
fn one_message_is_said_so_often_and_then_counted() {
    let said = |lines: usize| {
        let many = "?\n".repeat(lines);
        let mut reader = BlockReader::new(many.as_bytes(), Native.rules());
        while reader.next_block().is_some() {}
        reader.into_problems().into_diagnostics()
    };
    assert!(said(20).iter().all(|problem| problem.notes.is_empty()));
    assert_eq!(
        said(21)[19].notes[0].text(pathbuild_diagnostic::Lang::En),
        "the same applies to one more line, which is not shown"
    );
    let problems = said(50);
    assert_eq!(problems.len(), 20);
    assert_eq!(
        problems[19].notes[0].text(pathbuild_diagnostic::Lang::En),
        "the same applies to 30 more lines, which are not shown"
    );
    assert!(problems[..19].iter().all(|problem| problem.notes.is_empty()));
}

#[test]
fn a_file_that_just_ends_is_reported() {
    assert_eq!(faults(Native, "G21 G90\nG0 X1\nM30\n"), [""; 0]);
    assert_eq!(faults(Native, "%\nG21 G90\nG0 X1\n%\n"), [""; 0]);
    assert_eq!(faults(Native, "G21 G90\nG0 X1\n"), ["2 no-program-end"]);
    assert_eq!(faults(Native, "%\nG21 G90\nG0 X1\n"), ["3 no-program-end"]);
    assert_eq!(faults(Native, "G21 G90\nM30\nG0 X1\n"), ["3 after-program-end"]);
    assert_eq!(faults(Native, "G21 G90\nM30\n(end)\n; end\n%\n"), [""; 0]);
    assert_eq!(faults(Native, "G21 G90\nM30\n(end)\n(now) G0 X1 (back)\n"), ["4 after-program-end"]);
}
