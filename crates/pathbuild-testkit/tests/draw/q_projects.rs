//! Compares the Q-projects that the program draws with the same drawings built by the test kit's writer, for all versions.

use pathbuild_draw::{EmbeddingPath, q_project};
use pathbuild_testkit::{Draft, Entity, Point};

/// Writes the rows that [`q_project`] draws, but as entities of a draft, with the test kit's writer.
fn drafted(paths: &[EmbeddingPath<'_>]) -> Vec<u8> {
    let mut draft = Draft::new();
    let mut start = Point::new(0.0, 0.0);
    for path in paths {
        draft.layer(path.layer);
        let mut at = start;
        draft.add(Entity::start(at).note(&escaped(path.parameters)));
        for (index, (length, text)) in path.segments.iter().enumerate() {
            if index > 0 {
                let next = at + Point::new(20.0, 0.0);
                draft.add(Entity::line(at, next).with_line_type("HIDDEN"));
                at = next;
            }
            let to = at + Point::new(*length, 0.0);
            let circle = || Entity::arc(at + Point::new(0.0, 5.0), 5.0, 270.0, 270.0);
            let segment = if *length < 1e-3 { circle() } else { Entity::line(at, to) };
            draft.add(segment.with_line_type("DASHDOT").note(&escaped(text)));
            at = if *length < 1e-3 { at } else { to };
        }
        draft.add(Entity::end(at));
        start = start - Point::new(0.0, 60.0);
    }
    draft.finish().unwrap().to_dxf()
}

fn escaped(text: &str) -> String {
    text.replace('\\', "\\\\")
        .replace('{', "\\{")
        .replace('}', "\\}")
        .replace('^', "^ ")
        .replace('\u{a0}', "\\~")
}

#[track_caller]
fn assert_same(paths: &[EmbeddingPath<'_>]) {
    let (written, expected) = (q_project(paths).unwrap(), drafted(paths));
    let lines = |bytes: &[u8]| bytes.split(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect::<Vec<_>>();
    for (number, (line, other)) in (1..).zip(lines(&written).iter().zip(&lines(&expected))) {
        assert_eq!(String::from_utf8_lossy(line), String::from_utf8_lossy(other), "line {number}");
    }
    assert_eq!(written.len(), expected.len());
}

fn path<'a>(layer: &'a str, parameters: &'a str, segments: &[(f64, &'a str)]) -> EmbeddingPath<'a> {
    EmbeddingPath { layer, parameters, segments: segments.to_vec() }
}

#[test]
fn a_q_project_has_the_bytes_of_the_same_draft() {
    assert_same(&[]);
    assert_same(&[path(
        "1234.0Q",
        "T6 O2 MPlate",
        &[(40.0, ">1234.1P O2 H2 MPlate T5"), (0.0, ">1234.2P"), (0.4, ">1234.3P")],
    )]);
    // Further layers shift the other handles; layer 0 and names that differ in case are listed once.
    assert_same(&[
        path("1234.0Q", "", &[(60.0, "")]),
        path("1234.1q", "T1", &[(0.0, "")]),
        path("1234.1Q", "", &[]),
        path("0", "O2", &[(1.0, ">1")]),
    ]);
}

#[test]
fn texts_with_foreign_and_special_characters_have_the_same_bytes() {
    assert_same(&[path(
        "Größe.0Q",
        "M\u{a0}{Ω} ^I \\P ä",
        &[(60.0, "<0> ~ \u{20ac} \n second line"), (5.0, "語")],
    )]);
    let long = "N ".repeat(300);
    assert_same(&[path("a.0Q", "", &[(2000.0, long.as_str())])]);
}

/// If the start has no text of its own, any text near the short segment beside it would be assigned to the start.
#[test]
fn a_text_without_room_is_named() {
    assert!(q_project(&[path("1234.0Q", "T5", &[(0.01, ">1234.1P")])]).is_ok());
    let reasons = q_project(&[path("1234.0Q", "", &[(0.01, ">1234.1P")])]).unwrap_err();
    assert!(matches!(&reasons[..], [reason] if reason.contains(">1234.1P")), "{reasons:?}");
}
