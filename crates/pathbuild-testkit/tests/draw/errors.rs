//! Tests the errors of the text form, each with its position and the expected input.

use pathbuild_testkit::sheet;

#[track_caller]
fn assert_error(text: &str, expected: &str) {
    let errors = sheet(text).unwrap_err();
    let all: Vec<String> = errors.iter().map(ToString::to_string).collect();
    assert!(all[0].starts_with(expected), "{text:?}\n  says {all:?}\n  not  {expected:?}");
}

#[test]
fn every_wrong_line_is_reported_with_its_place() {
    let errors = sheet("line 0,0 x\nend 0,0\nlnie 0,0 1,1\n  circle 0,0 d").unwrap_err();
    let places: Vec<(u32, u32)> = errors.iter().map(|error| (error.line, error.column)).collect();
    assert_eq!(places, [(1, 10), (3, 1), (4, 14)]);
}

#[test]
fn errors_of_points_and_numbers() {
    assert_error(
        "end 4O,0",
        "line 1, column 5: \"4O,0\" is no point; expected the marker's centre as x,y such as 40,12.5",
    );
    assert_error("end 40", "line 1, column 5: \"40\" is no point");
    assert_error("end 1,2,3,4", "line 1, column 5: \"1,2,3,4\" is no point");
    assert_error("end nan,0", "line 1, column 5: \"nan,0\" is no point");
    assert_error("end 1e999,0", "line 1, column 5: \"1e999,0\" is no point");
    assert_error("end", "line 1, column 1: the line ends here; expected the marker's centre");
    assert_error("end @1,1", "line 1, column 5: there is no point before this that @ could be counted from");
    assert_error("line to 9,0", "line 1, column 6: nothing was drawn before this that `to` could go on from");
    assert_error("circle 0,0 d 0", "line 1, column 14: the diameter must be more than 0");
    assert_error(
        "circle 0,0 d 1,5",
        "line 1, column 14: \"1,5\" is no number; expected the diameter, with a decimal point",
    );
}

#[test]
fn errors_of_words_and_strings() {
    assert_error("lnie 0,0 1,1", "line 1, column 1: \"lnie\" is no element and no option");
    assert_error(
        "line DAHSED 0,0 1,1",
        "line 1, column 6: \"DAHSED\" is no known line type; list it with `linetype DAHSED`",
    );
    assert_error("layer L DAHSED", "line 1, column 9: \"DAHSED\" is no known line type");
    assert_error("mill 0,0 9,0 \"B0", "line 1, column 14: this quotation mark is never closed");
    assert_error("mill 0,0 9,0 \"B0\" \"I1\"", "line 1, column 19: an element has one text");
    assert_error("mill 0,0 9,0 height 3", "line 1, column 14: this is said behind the text it is about");
    assert_error(
        "mill 0,0 9,0 hidden",
        "line 1, column 14: \"hidden\" is not expected here; behind an element may stand",
    );
    assert_error("text 0,0 B0", "line 1, column 10: expected the text in quotation marks, found \"B0\"");
    assert_error("layer L frozen 3", "line 1, column 16: \"3\" is no known line type");
    assert_error(
        "text 0,0 \"x\" align up",
        "line 1, column 20: \"up\" is none of left, centre, right, middle, aligned, fit",
    );
    assert_error("mtext 0,0 \"x\" align up", "line 1, column 21: \"up\" is none of top, middle, bottom");
}

#[test]
fn errors_of_shapes() {
    assert_error(
        "arc 0,0 20,0 r 9",
        "line 1, column 16: no arc of radius 9 joins these ends, which are 20 apart",
    );
    assert_error("arc 0,0 20,0 via 10,0", "line 1, column 18: these three points lie on a straight line");
    assert_error("arc 0,0 20,0 bulge 0", "line 1, column 20: this arc is straight or has no length");
    assert_error(
        "arc 0,0 20,0 9",
        "line 1, column 14: expected r, via, bulge or centre behind the ends of an arc",
    );
    assert_error(
        "spline control 0,0 1,1 2,2",
        "line 1, column 24: a spline of degree 3 needs at least 4 control points",
    );
    assert_error("solid 0,0 1,0", "line 1, column 11: a solid has three or four corners");
    assert_error(
        "line 0,0 1,1 2,2 handle 1F",
        "line 1, column 25: several entities cannot have the same handle",
    );
    assert_error(
        "line 0,0 1,1 handle 0",
        "line 1, column 21: \"0\" is no handle; expected a hexadecimal number",
    );
}

#[test]
fn errors_of_blocks_and_raw_entities() {
    assert_error("block B\nline 0,0 1,1", "line 1, column 1: this `block` has no `endblock`");
    assert_error("endblock", "line 1, column 1: there is no `block` to end");
    assert_error("block B\nblock C", "line 2, column 7: block \"B\" of line 1 is still open");
    assert_error("block B\nendblock\nblock b", "line 3, column 7: there is a block \"b\" already");
    assert_error("insert B at 0,0", "line 1: there is no block \"B\" in this drawing");
    assert_error("raw\n0 LINE", "line 1, column 1: this `raw` has no `endraw`");
    assert_error(
        "raw\nLINE 0\nendraw",
        "line 2, column 1: \"LINE\" is no group code; expected `code value` or `endraw`",
    );
    assert_error("set 10 1", "line 1, column 1: `set` changes the entity before it, and there is none");
    assert_error(
        "block B\nline 0,0 1,1\nendblock\nunset 10",
        "line 4, column 1: `unset` changes the entity before it",
    );
}

#[test]
fn errors_of_options() {
    assert_error("version R11", "line 1, column 9: \"R11\" is none of R10, R12, R13,");
    assert_error("units furlong", "line 1, column 7: \"furlong\" is none of none, inch, mm, cm, m, missing");
    assert_error(
        "no entities",
        "line 1, column 4: \"entities\" is none of header, tables, blocks, objects, handles, eof",
    );
    assert_error("binary yes", "line 1, column 8: \"yes\" is not expected here");
}

#[test]
fn what_a_version_does_not_know_is_an_error() {
    assert_error(
        "version R12\nmtext 0,0 \"x\"",
        "line 2: MTEXT does not exist in R12: write `text`, or `version R2000`",
    );
    assert_error("version R12\nmill 0,0 9,0 \"B0\" as mtext", "line 2: MTEXT does not exist in R12");
    assert_error(
        "version R12\nellipse centre 0,0 major 1,0 ratio 1",
        "line 2: ELLIPSE does not exist in R12",
    );
    assert_error("version R12\nspline control 0,0 1,1 2,0 3,1", "line 2: SPLINE does not exist in R12");
    assert_error("version R10\nline 0,0 1,1 paper", "line 2: paper space does not exist in R10");
    for least in ["version R13\nmtext 0,0 \"x\"", "version R12\nline 0,0 1,1 paper"] {
        assert!(sheet(least).is_ok(), "{least}");
    }
}

#[test]
fn a_text_without_room_is_an_error() {
    let inside = "circle 0,0 d 40\nline -9,0 9,0 \"B0\"";
    assert_error(
        inside,
        "line 2: no place found where the text \"B0\" would belong to this element and to no other",
    );
    assert_error("line 0,0 9,0\nline 0,0 9,0 \"B0\"", "line 2: no place found");
    assert_error("raw\n0 POINT\nendraw\nsolid 0,0 1,0 1,1 \"B0\"", "line 4: no place found");
}
