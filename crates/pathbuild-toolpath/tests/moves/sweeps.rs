//! Tests sweeps, travel and plunges. ("Elementary moves", "Sweeps")

use crate::support::{counts, moves, path};

const P: &str = "T5 O3 I5 B0";

#[test]
fn a_sweep_is_at_its_own_height_or_the_paths() {
    assert_eq!(moves(&path(P, "sweep 0,0 40,0\nend 40,0")), ["L 10", "S 40,0"]);
    assert_eq!(moves(&path(P, "sweep 0,0 40,0 \"S7\"\nend 40,0")), ["L 7", "S 40,0"]);
    assert_eq!(moves(&path(P, "sweep 0,0 40,0 \"S20\"\nend 40,0")), ["L 20", "S 40,0"]);
}

/// The start height S0 is slightly above S, so that the first sweep always states its Z.
#[test]
fn the_first_sweep_writes_its_height() {
    assert_eq!(moves(&path(P, "sweep 0,0 40,0\nend 40,0"))[0], "L 10");
    assert_eq!(moves(&path(&format!("{P} S6"), "sweep 0,0 40,0\nend 40,0"))[0], "L 6");
}

#[test]
fn a_drawn_arc_is_swept_straight() {
    assert_eq!(moves(&path(P, "sweep arc 0,0 40,0 r 30\nend 40,0")), ["L 10", "S 40,0"]);
}

/// Between points that coincide in the plane there is no sweep, only a change of height.
#[test]
fn nothing_is_swept_between_points_that_coincide() {
    let gap = |end: &str| moves(&path(P, &format!("mill 0,0 20,0\nmill {end} 40,0\nend 40,0")));
    assert_eq!(gap("20,0"), ["L 5", "D 0", "M 20,0 0", "M 40,0 0", "L 10"]);
    assert_eq!(gap("20.00003,0"), ["L 5", "D 0", "M 20,0 0", "M 40,0 0", "L 10"]);
}

#[test]
fn above_the_surface_the_tool_comes_down_fast() {
    // The plunge goes to the surface, but not below it, so nothing is drilled.
    assert_eq!(moves(&path("T5 O3 I1 B4 W5", "mill 0,0 40,0\nend 40,0"))[..2], ["L 5", "M 40,0 5"]);
    // The plunge goes below the surface: rapidly to the surface, then by drilling.
    assert_eq!(moves(&path(P, "mill 0,0 40,0\nend 40,0"))[..2], ["L 5", "D 0"]);
    // The plunge starts below the surface, so all of it is drilled.
    assert_eq!(moves(&path("T5 O3 I1 B3", "mill 0,0 40,0\nend 40,0"))[3], "D 3");
}

/// Upward moves are always rapid, even below the surface.
#[test]
fn upwards_the_tool_is_fast() {
    let holes = "circle 0,0 d 3 \"B1\"\ncircle DIVIDE 0,0 d 3 \"D3\"\nsweep 0,0 40,0\nend 40,0";
    assert_eq!(moves(&path(P, holes)), ["L 5", "D 1", "L 3", "L 10", "S 40,0"]);
}

/// Heights with a relative difference of 1e-6 are equal.
#[test]
fn heights_that_are_near_are_the_same() {
    let holes = |depth: &str| {
        moves(&path(
            P,
            &format!("circle 0,0 d 3 \"B1\"\ncircle 0,0 d 3 \"B{depth}\"\nsweep 0,0 40,0\nend 40,0"),
        ))
    };
    assert_eq!(holes("0.999999"), ["L 5", "D 1", "L 10", "S 40,0"]);
    assert_eq!(holes("0.9999"), ["L 5", "D 1", "D 1", "L 10", "S 40,0"]);
}

/// A plunge is counted with its difference in height: as a sweep down to the surface, and as drilling below it.
#[test]
fn what_a_plunge_counts() {
    assert_eq!(
        counts(&path("T5 O3 I5 B0 F200", "mill 0,0 40,0\nend 40,0")),
        ["Sweep 5", "Drilling 5 200", "Milling 40 200", "Sweep 10"]
    );
}
