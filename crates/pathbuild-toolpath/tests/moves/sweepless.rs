//! Tests sweepless milling. ("Chains, sweepless milling (W given)")

use crate::support::{moves, path};

#[test]
fn an_open_chain_is_run_to_and_fro_at_each_depth_but_the_last() {
    assert_eq!(
        moves(&path("T5 O3 I1 B3 W5", "mill 0,0 40,0\nend 40,0")),
        ["L 5", "M 40,0 5", "M 0,0 5", "D 4", "M 40,0 4", "M 0,0 4", "D 3", "M 40,0 3"]
    );
}

/// The last pass goes there only, without a sweep or a retract at the end.
#[test]
fn one_run_goes_there_only() {
    assert_eq!(
        moves(&path("T5 O3 I9 B3 W4", "mill 0,0 40,0\nend 40,0")),
        ["L 5", "D 4", "M 40,0 4", "M 0,0 4", "D 3", "M 40,0 3"]
    );
    assert_eq!(moves(&path("T5 O3 I9 B3 W3", "mill 0,0 40,0\nend 40,0")), ["L 5", "D 3", "M 40,0 3"]);
    assert_eq!(moves(&path("T5 O3 I9 B3 W2", "mill 0,0 40,0\nend 40,0")), ["L 5", "D 3", "M 40,0 3"]);
}

#[test]
fn a_closed_chain_is_run_round() {
    let closed = "mill 0,0 40,0 40,30 0,0\nend 0,0";
    assert_eq!(
        moves(&path("T5 O3 I1 B4 W5", closed)),
        ["L 5", "M 40,0 5", "M 40,30 5", "M 0,0 5", "D 4", "M 40,0 4", "M 40,30 4", "M 0,0 4"]
    );
}

/// In every pass, a segment with fewer edges repeats its deepest edge.
#[test]
fn every_run_goes_over_all_segments() {
    let lines = "mill 0,0 20,0\nmark 20,0 40,0\nend 40,0";
    assert_eq!(
        moves(&path("T5 O3 I1 B3 D4 W5", lines)),
        [
            "L 5", "M 20,0 5", "M 40,0 5", "M 20,0 5", "M 0,0 5", "D 4", "M 20,0 4", "M 40,0 4", "M 20,0 4",
            "M 0,0 4", "D 3", "M 20,0 3", "L 4", "M 40,0 4"
        ]
    );
}

/// Segments are run from the position of the tool, regardless of their direction in the drawing.
#[test]
fn segments_are_run_from_where_the_tool_is() {
    let lines = "mill 20,0 0,0\nmill 20,0 40,0\nend 40,0";
    assert_eq!(moves(&path("T5 O3 I9 B3 W3", lines)), ["L 5", "D 3", "M 20,0 3", "M 40,0 3"]);
}

/// The next element retracts the tool.
#[test]
fn what_follows_retracts() {
    let lines = "mill 0,0 20,0 \"W3\"\nsweep 20,0 40,0\nmill 40,0 60,0 \"W3\"\nend 60,0";
    assert_eq!(
        moves(&path("T5 O3 I9 B3", lines)),
        ["L 5", "D 3", "M 20,0 3", "L 10", "S 40,0", "L 5", "D 3", "M 60,0 3"]
    );
}

#[test]
fn the_first_depth_is_raised_by_h() {
    let drawing = format!(
        "layer 8001.1P\nstart 0,0 \"T9 O3 S20\"\nsubpath 0,0 40,0 \">1234.1P T5 H1\"\nend 40,0\n{}",
        path("T5 O3 I9 B3 W4", "mill 0,0 40,0\nend 40,0")
    );
    assert_eq!(moves(&drawing), ["L 6", "D 5", "M 40,0 5", "M 0,0 5", "D 4", "M 40,0 4"]);
}
