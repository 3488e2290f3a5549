//! Tests TEXT and MTEXT: positions and alignment. (book: language/parameter-texts)

use HorizontalAlign::{Centre, Left, Right};
use VerticalAlign::{Baseline, Bottom, Middle, Top};
use pathbuild_dxf::{Geometry, HorizontalAlign, LayoutObstacle, MText, Point3, Text, VerticalAlign};

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

/// Reads an MTEXT with a nominal height of 2.5 and these groups and content.
fn formatted(content: &str, groups: &str) -> MText {
    let drawing = entities(&format!("0 MTEXT\n8 A\n10 1\n20 2\n40 2.5\n1 {content}\n{groups}"));
    match only_geometry(drawing) {
        Geometry::MText(text) => text,
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_height_of_an_mtext_is_that_of_its_letters() {
    for (content, height) in [
        (r"B1", 2.5),
        (r"{\H0.5;B1}", 0.5),
        (r"{\H0.2x;B1}", 0.5),
        (r"\H0.5x;{\H0.5x;B1}", 0.625),
        (r"{\H0.5; }B1", 2.5),
        (r"{\H0.5;}B1", 2.5),
        (r"\H0;B1", 2.5),
        (r"\H-1;B1", 2.5),
        (r"\Hx;B1", 2.5),
        (r"\Hinf;B1", 2.5),
        (r"\HNaN;B1", 2.5),
        (r"}\H1;B1", 1.0),
    ] {
        let text = formatted(content, "");
        assert_eq!((text.height, text.obstacle), (height, None), "{content}");
    }
}

#[test]
fn paragraphs_have_an_alignment() {
    for (content, paragraphs) in [
        ("B1", Centre),
        (r"\pxqr;B1", Right),
        (r"\pql;B1", Left),
        (r"\pxqj;B1", Left),
        (r"\pxqc;\PB1", Centre),
        (r"\pi0,l0,r0,xqr;B1", Right),
        (r"\pql,t4,c12,r20;B1", Left),
        (r"\pqr;\pq*;B1", Centre),
        (r"\psm1.5;B1", Centre),
    ] {
        let text = formatted(content, "71 2\n41 60");
        assert_eq!(
            (text.paragraphs, text.horizontal, text.obstacle),
            (paragraphs, Centre, None),
            "{content}"
        );
    }
}

#[test]
fn formatting_that_hides_the_place_of_letters_is_reported() {
    use LayoutObstacle::{Alignment, Columns, EmptyRows, Heights, Indent, Stack, Tab};
    for (content, obstacle) in [
        (r"\H2.5;B1\H2.52;F100", None),
        (r"\H2.5;B1\H2.53;F100", Some(Heights)),
        (r"{\H0.5;B1} F100", Some(Heights)),
        (r"\pqc;B1\PF100", None),
        (r"\pqc;B1\P\pqr;F100", Some(Alignment)),
        (r"\pqd;B1", Some(Alignment)),
        (r"B1\pqr;", None),
        (r"\pi0,l0;B1", None),
        (r"\pi*,l*;B1", None),
        (r"\pi0.1;B1", Some(Indent)),
        (r"\pxl30,t30;B1", Some(Indent)),
        (r"B1^I", None),
        (r"B1^I^I\PF100 ^I ", None),
        (r"^IB1", Some(Tab)),
        (r"B1^IF100", Some(Tab)),
        (r"B1\NF100", Some(Columns)),
        (r"B1\N \P", None),
        (r"B\S1/2;", Some(Stack)),
    ] {
        assert_eq!(formatted(content, "41 60").obstacle, obstacle, "{content}");
    }
    for (groups, content, obstacle) in [
        ("71 3", r"B1\P \P", None),
        ("71 4", r"B1\P \P", Some(EmptyRows)),
        ("71 9", r"B1 \P", Some(EmptyRows)),
        ("71 4", r"\PB1 ", None),
        ("71 4", r" \P", None),
    ] {
        assert_eq!(formatted(content, groups).obstacle, obstacle, "{groups} {content}");
    }
    assert_eq!(formatted(r"\pqc;B1\P\pqr;F100", "").obstacle, None, "the box is as wide as its longest row");
}

#[test]
fn the_columns_of_an_embedded_object_are_counted() {
    let columns = |groups: &str| formatted("B1", groups).obstacle;
    assert_eq!(columns("72 5\n101 Embedded Object\n71 1\n72 1"), None);
    assert_eq!(columns("72 5\n101 Embedded Object\n71 1\n72 2\n44 2"), Some(LayoutObstacle::Columns));
    assert_eq!(columns("72 5\n101 Embedded Object\n71 0"), None);
    assert_eq!(columns("72 5"), None);
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
