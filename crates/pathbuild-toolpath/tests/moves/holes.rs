//! Tests drilled holes. ("Drilled hole")

use pathbuild_toolpath::{Comment, ElementKind, ProgramStep};

use crate::support::{counts, moves, moves_and_comments, path, program};

/// Returns a sweep to a hole, the hole, and a sweep away from it.
fn hole(circle: &str) -> String {
    format!("sweep 0,0 20,0\n{circle}\nsweep 20,0 40,0\nend 40,0")
}

const P: &str = "T5 O3 I1 B0 D3";

/// The tool stays at the bottom of the hole, and the next element retracts it.
#[test]
fn a_hole_is_drilled_at_once_to_its_bottom() {
    assert_eq!(moves(&path(P, &hole("circle 20,0 d 3"))), ["L 10", "S 20,0", "L 5", "D 0", "L 10", "S 40,0"]);
}

#[test]
fn a_drilled_mark_ends_at_d() {
    assert_eq!(moves(&path(P, &hole("circle DIVIDE 20,0 d 3")))[2..4], ["L 5", "D 3"]);
}

#[test]
fn a_hole_has_its_own_feed() {
    let feed = |circle: &str, parameters: &str| {
        counts(&path(&format!("{P} {parameters}"), &hole(circle)))[3].clone()
    };
    assert_eq!(feed("circle 20,0 d 3", ""), "Drilling 5 100");
    assert_eq!(feed("circle 20,0 d 3", "F200"), "Drilling 5 200");
    assert_eq!(feed("circle 20,0 d 3 \"F300\"", "F200"), "Drilling 5 300");
}

#[test]
fn a_comment_stands_before_the_plunge() {
    let moves = moves_and_comments(&path(P, &hole("circle 20,0 d 3 \"Qx\"")));
    assert_eq!(moves, ["L 10", "S 20,0", "Q x", "L 5", "D 0", "L 10", "S 40,0"]);
}

/// C does not affect the moves, but is passed on for the cycles of other machines.
#[test]
fn the_peck_depth_is_handed_on() {
    let with = program(&path(P, &hole("circle 20,0 d 3 \"C2\"")));
    let peck = with.steps.iter().find_map(|step| match step {
        ProgramStep::Comment(Comment::Element {
            kind: ElementKind::DrilledHole,
            peck,
            bottom,
            surface,
            ..
        }) => Some((*peck, *bottom, *surface)),
        _ => None,
    });
    assert_eq!(peck, Some((Some(2.0), 0.0, 5.0)));
    assert_eq!(moves(&path(P, &hole("circle 20,0 d 3 \"C2\""))), moves(&path(P, &hole("circle 20,0 d 3"))));
}

#[test]
fn a_hole_is_raised_by_h() {
    let drawing = format!(
        "layer 8001.1P\nstart 0,0 \"T9 O3 S20\"\nsubpath 0,0 40,0 \">1234.1P T5 H1.5\"\nend 40,0\n{}",
        path("T5 O3 I1 B1 S10", &hole("circle 20,0 d 3"))
    );
    assert_eq!(moves(&drawing), ["L 11.5", "S 20,0", "L 6.5", "D 2.5", "L 11.5", "S 40,0"]);
}
