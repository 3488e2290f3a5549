//! Tests TEXT and MTEXT: positions and alignment. (book: language/parameter-texts)

use HorizontalAlign::{Centre, Left, Right};
use VerticalAlign::{Baseline, Bottom, Middle, Top};
use pathbuild_dxf::{Geometry, HorizontalAlign, MText, Point3, Text, VerticalAlign};

use crate::support::{entities, faults, only_geometry, read_all};

fn text(groups: &str) -> Text {
    match only_geometry(entities(&format!("0 TEXT\n8 A\n10 1\n20 2\n40 2.5\n1 T3 O2\n{groups}"))) {
        Geometry::Text(text) => text,
        other => panic!("{other:?}"),
    }
}

fn mtext(groups: &str) -> MText {
    match only_geometry(entities(&format!("0 MTEXT\n8 A\n10 1\n20 2\n40 2.5\n1 T3\\PO2\n{groups}"))) {
        Geometry::MText(text) => text,
        other => panic!("{other:?}"),
    }
}

fn point(x: f64, y: f64) -> Point3 {
    Point3 { x, y, z: 0.0 }
}

#[test]
fn a_text_begins_at_its_first_point() {
    let text = text("50 30");
    assert_eq!(
        (&*text.string, text.anchor, text.height, text.rotation),
        ("T3 O2", point(1.0, 2.0), 2.5, 30.0)
    );
    assert_eq!(
        (text.horizontal, text.vertical, text.backwards, text.upside_down),
        (Left, Baseline, false, false)
    );
}

#[test]
fn blanks_of_a_text_are_kept() {
    let Geometry::Text(text) = only_geometry(entities("0 TEXT\n8 A\n10 1\n20 2\n40 1\n1   T3 ")) else {
        panic!()
    };
    assert_eq!(&*text.string, "  T3 ");
}

#[test]
fn alignment_is_relative_to_the_second_point() {
    for (groups, anchor, horizontal, vertical) in [
        ("11 5\n21 6", point(1.0, 2.0), Left, Baseline),
        ("72 0\n73 0\n11 5\n21 6", point(1.0, 2.0), Left, Baseline),
        ("72 1\n11 5\n21 6", point(5.0, 6.0), Centre, Baseline),
        ("72 2\n11 5\n21 6", point(5.0, 6.0), Right, Baseline),
        ("73 1\n11 5\n21 6", point(5.0, 6.0), Left, Bottom),
        ("73 2\n11 5\n21 6", point(5.0, 6.0), Left, Middle),
        ("72 2\n73 3\n11 5\n21 6", point(5.0, 6.0), Right, Top),
        ("72 4\n11 5\n21 6", point(5.0, 6.0), Centre, Middle),
        ("72 3\n11 5\n21 2", point(3.0, 2.0), Centre, Baseline),
        ("72 5\n11 5\n21 2", point(3.0, 2.0), Centre, Baseline),
    ] {
        let text = text(groups);
        assert_eq!((text.anchor, text.horizontal, text.vertical), (anchor, horizontal, vertical), "{groups}");
    }
}

#[test]
fn texts_between_two_points_have_their_direction() {
    assert_eq!(text("72 3\n11 1\n21 7").rotation, 90.0);
    assert_eq!(text("72 5\n11 1\n21 7\n50 3").rotation, 90.0);
    assert_eq!(text("72 5\n11 1\n21 2\n50 3").rotation, 3.0);
    assert_eq!(text("72 1\n11 1\n21 7\n50 3").rotation, 3.0);
}

#[test]
fn an_aligned_text_needs_its_second_point() {
    let drawing = read_all(entities("0 TEXT\n8 A\n10 1\n20 2\n40 1\n1 x\n72 1"));
    assert_eq!(faults(&drawing), ["PB002 5 A: TEXT: group 11 is missing"]);
}

#[test]
fn generation_flags_mirror_a_text() {
    for (flags, backwards, upside_down) in
        [(0, false, false), (2, true, false), (4, false, true), (6, true, true)]
    {
        let text = text(&format!("71 {flags}"));
        assert_eq!((text.backwards, text.upside_down), (backwards, upside_down), "{flags}");
    }
}

#[test]
fn texts_need_height_and_string() {
    for (groups, fault) in [
        ("0 TEXT\n8 A\n10 1\n20 2\n1 x", "PB002 5 A: TEXT: group 40 is missing"),
        ("0 TEXT\n8 A\n10 1\n20 2\n1 x\n40 0", "PB002 16 A: TEXT: \"0\" in group 40 must be greater than 0"),
        ("0 TEXT\n8 A\n10 1\n20 2\n40 1", "PB002 5 A: TEXT: group 1 is missing"),
        ("0 MTEXT\n8 A\n10 1\n20 2\n40 1", "PB002 5 A: MTEXT: group 1 is missing"),
        ("0 MTEXT\n8 A\n10 1\n40 1\n1 x", "PB002 5 A: MTEXT: group 20 is missing"),
    ] {
        assert_eq!(faults(&read_all(entities(groups))), [fault]);
    }
}

#[test]
fn an_mtext_has_its_attachment() {
    let all = [Left, Centre, Right];
    for code in 1..=9_usize {
        let text = mtext(&format!("71 {code}"));
        let vertical = [Top, Middle, Bottom][(code - 1) / 3];
        assert_eq!((text.horizontal, text.vertical), (all[(code - 1) % 3], vertical), "{code}");
    }
    let text = mtext("");
    assert_eq!((text.horizontal, text.vertical, text.anchor, text.height), (Left, Top, point(1.0, 2.0), 2.5));
    assert_eq!(text.plain, "T3\nO2");
}

#[test]
fn the_later_of_rotation_and_direction_holds() {
    assert_eq!(mtext("").rotation, 0.0);
    assert_eq!(mtext("50 30").rotation, 30.0);
    assert_eq!(mtext("11 0\n21 2\n31 0").rotation, 90.0);
    assert_eq!(mtext("11 0\n21 2\n50 30").rotation, 30.0);
    assert_eq!(mtext("50 30\n11 -1\n21 0").rotation, 180.0);
}

#[test]
fn an_embedded_object_is_no_part_of_an_mtext() {
    // After `Embedded Object`, R2018 repeats groups of the MTEXT with different meanings.
    let text = mtext("71 5\n101 Embedded Object\n70 1\n10 7\n20 8\n11 0\n21 1\n40 99\n71 9");
    assert_eq!(
        (text.anchor, text.height, text.rotation, text.horizontal),
        (point(1.0, 2.0), 2.5, 0.0, Centre)
    );
}
