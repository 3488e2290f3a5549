//! Tests how pairs are parsed: line ends, padding, comments, codes. (book: reference/dxf)

use crate::support::{entities, faults, file_faults, only, read_all};

const LINE: &str = "0 LINE\n8 A\n10 1\n20 2\n11 3\n21 4";

#[test]
fn all_line_ends_are_read() {
    let lf = entities(LINE);
    let sound = only(&lf);
    for line_end in ["\r\n", "\r", "\r\r\n"] {
        let file = lf.replace('\n', line_end);
        assert_eq!(only(&file), sound, "{line_end:?}");
    }
}

/// Most programs pad codes to three characters. Others pad them to six or not at all, with any line ends.
#[test]
fn codes_are_read_in_any_width() {
    let lf = entities(&[LINE; 50].join("\n"));
    let sound = read_all(&lf).entities;
    assert_eq!(sound.len(), 50);
    for width in 0..9 {
        let padded = |(number, line): (usize, &str)| match number % 2 {
            0 => format!("{:>width$}\n", line.trim_start()),
            _ => format!("{line}\n"),
        };
        let file: String = lf.lines().enumerate().map(padded).collect();
        for line_end in ["\n", "\r\n", "\r"] {
            let read = read_all(file.replace('\n', line_end)).entities;
            assert!(read == sound, "{width} {line_end:?}: {:?}", read.first());
        }
    }
}

#[test]
fn values_do_not_keep_their_carriage_returns() {
    let file = entities("0 TEXT\n8 A\n10 1\n20 2\n40 1\n1 T3\n").replace('\n', "\r\n");
    assert_eq!(only(file), only(entities("0 TEXT\n8 A\n10 1\n20 2\n40 1\n1 T3")));
}

#[test]
fn codes_and_keywords_may_be_padded() {
    let file = entities(LINE)
        .replace("ENTITIES", "  ENTITIES\t")
        .replace("LINE\n", "LINE  \n")
        .replace(" 10\n", "\t 10 \t\n");
    assert_eq!(only(file), only(entities(LINE)));
}

#[test]
fn a_byte_order_mark_is_skipped() {
    assert_eq!(only(format!("\u{feff}{}", entities(LINE))), only(entities(LINE)));
}

#[test]
fn remarks_are_skipped_anywhere() {
    let file =
        format!("999\nfirst\n{}", entities("999 a\n0 LINE\n8 A\n999 10\n10 1\n20 2\n11 3\n21 4\n999 b"));
    let file = file.replace("  2\nENTITIES", "999\nx\n  2\nENTITIES");
    assert_eq!(only(file), only(entities(LINE)));
}

#[test]
fn unknown_and_negative_codes_are_skipped() {
    let entity = only(entities("0 LINE\n8 A\n83 x\n1072 y\n-5 z\n9999999 z\n10 1\n20 2\n11 3\n21 4"));
    assert_eq!(entity, only(entities(LINE)));
}

#[test]
fn codes_of_applications_are_skipped() {
    let entity =
        only(entities("0 LINE\n8 A\n102 {APP\n10 7\n11 x\n102 }\n10 1\n20 2\n11 3\n21 4\n1001 APP\n1010 9"));
    assert_eq!(entity, only(entities(LINE)));
}

#[test]
fn a_group_of_an_application_that_does_not_end_ends_with_its_entity() {
    let drawing = read_all(entities(
        "0 LINE\n8 A\n10 1\n20 2\n11 3\n21 4\n102 {APP\n10 7\n0 LINE\n8 A\n10 1\n20 2\n11 3\n21 4",
    ));
    assert_eq!((drawing.entities.len(), drawing.faults.len()), (2, 0));
}

#[test]
fn a_blank_line_for_a_code_is_an_error_of_the_file() {
    let file = entities(LINE).replace(" 20\n", "\n");
    let drawing = read_all(file);
    assert!(drawing.entities.is_empty());
    assert_eq!(file_faults(&drawing), ["PB002 11 expected a group code here, not \"\""]);
}

#[test]
fn a_text_with_a_line_break_is_an_error_of_the_file() {
    let file = entities("0 TEXT\n8 A\n10 1\n20 2\n40 1\n1 first").replace("first", "first\nsecond");
    assert_eq!(file_faults(&read_all(file)), ["PB002 17 expected a group code here, not \"second\""]);
}

#[test]
fn a_blank_value_is_a_value() {
    let drawing = read_all(entities("0 LINE\n8 A\n10 \n20 2\n11 3\n21 4"));
    assert_eq!(faults(&drawing), ["PB002 10 A: LINE: group 10 must be a number, not \"\""]);
}

#[test]
fn lines_are_counted_across_skipped_sections() {
    let blocks = crate::support::section("BLOCKS", "0 BLOCK\n2 B\n0 ENDBLK");
    let drawing = read_all(format!("{blocks}{}", entities("0 LINE\n8 A\n10 x")));
    assert_eq!(drawing.faults[0].diagnostic.place.line, Some(22));
    let crlf = format!("{blocks}{}", entities("0 LINE\n8 A\n10 x")).replace('\n', "\r\n");
    assert_eq!(read_all(crlf).faults[0].diagnostic.place.line, Some(22));
}
