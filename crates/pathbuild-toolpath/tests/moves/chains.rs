//! Tests milling chains, pass by pass. ("Chains, ordinary milling")

use pathbuild_toolpath::{PlannedMove, ProgramStep, estimated_bytes};

use crate::support::{COMPATIBLE, estimate, moves, moves_and_comments, path, program, program_with, shown};

const LINE: &str = "mill 0,0 40,0\nend 40,0";

#[test]
fn a_line_is_milled_to_and_fro_pass_by_pass() {
    let expected = ["L 5", "D 4", "M 40,0 4", "D 3", "M 0,0 3", "L 10", "S 40,0"];
    assert_eq!(moves(&path("T5 O3 I1 B3", LINE)), expected);
}

#[test]
fn the_first_depth_is_one_infeed_below_the_surface_and_the_last_is_the_bottom() {
    let depths = |infeed: &str, bottom: &str| {
        let moves = moves(&path(&format!("T5 O3 I{infeed} B{bottom}"), LINE));
        let milled = moves.iter().filter_map(|step| step.strip_prefix("M ")?.split(' ').nth(1));
        milled.collect::<Vec<_>>().join(" ")
    };
    assert_eq!(depths("2.5", "0"), "2.5 0");
    assert_eq!(depths("2", "0"), "3 1 0");
    assert_eq!(depths("9", "0"), "0");
    assert_eq!(depths("5", "0"), "0");
    // A depth that is almost at the bottom is treated as the bottom.
    assert_eq!(depths("2.4999999999", "0"), "2.5 0");
    assert_eq!(depths("2.499", "0"), "2.501 0.002 0");
}

/// In binary, 50 times 0.1 is not 5, but the last of fifty subtractions must still give the bottom.
#[test]
fn depths_arise_by_subtracting_again_and_again() {
    let milled = moves(&path("T5 O3 I0.1 B0", LINE));
    assert_eq!(milled.iter().filter(|step| step.starts_with('M')).count(), 50);
}

#[test]
fn marks_end_at_d_and_lines_with_bars_at_b() {
    assert_eq!(
        moves(&path("T5 O3 I1 B0 D3", "mark 0,0 40,0\nend 40,0")),
        ["L 5", "D 4", "M 40,0 4", "D 3", "M 0,0 3", "L 10", "S 40,0"]
    );
    let bars = moves(&path("T5 O3 I5 B0 D3 P50 U50", "bars 0,0 40,0\nend 40,0"));
    assert_eq!(bars, ["L 5", "D 3", "M 40,0 3", "L 10"]);
}

#[test]
fn the_nearest_edge_is_next() {
    let expected = ["L 5", "D 4", "M 40,0 4", "M 40,30 4", "D 3", "M 40,0 3", "M 0,0 3", "L 10", "S 40,30"];
    assert_eq!(moves(&path("T5 O3 I1 B3", "mill 0,0 40,0 40,30\nend 40,30")), expected);
}

/// The next line at the same depth begins where the tool is, and a lower edge is milled only after the edge above it: the tool mills the whole ring
/// before it descends.
#[test]
fn an_edge_waits_for_the_one_above_it() {
    let closed = moves(&path("T5 O3 I1 B3", "mill 0,0 40,0 40,30 0,0\nend 0,0"));
    assert_eq!(
        closed,
        ["L 5", "D 4", "M 40,0 4", "M 40,30 4", "M 0,0 4", "D 3", "M 40,0 3", "M 40,30 3", "M 0,0 3", "L 10"]
    );
}

/// Distances are measured in space: 4 mm down is nearer than 2 mm along and 4 mm down.
#[test]
fn distances_are_in_space() {
    let order =
        |infeed: &str| moves(&path(&format!("T9 O3 I{infeed} B1"), "mill 0,0 2,0\nmill 2,0 4,0\nend 4,0"));
    // After the first edge of the second line, which ends at (4, 0), there is a choice: the next edge of that line, or the next edge of the first
    // line, from (2, 0).
    assert_eq!(order("4")[..5], ["L 9", "D 5", "M 2,0 5", "M 4,0 5", "D 1"]);
    assert_eq!(order("4")[5], "M 2,0 1");
}

/// If several edges are equally near, the first in segment order is chosen, and its end rather than its start.
#[test]
fn ties_go_to_the_first_segment_and_to_its_end() {
    // A full circle begins and ends at the same point. The walk reverses it, and milling reverses it again: it begins at the end of the walked curve.
    let circle = "arc CONTINUOUS centre 10,0 r 10 from 180 to 180\nend 0,0";
    assert_eq!(moves(&path("T5 O3 I5 B0", circle)), ["L 5", "D 0", "A 0,0 0", "L 10"]);
    // Both lines have an end where the tool is, so the first one is chosen.
    let both = "mill 0,0 0,20\nmill 0,20 0,0\nend 0,0";
    assert_eq!(moves(&path("T5 O3 I5 B0", both))[..4], ["L 5", "D 0", "M 0,20 0", "M 0,0 0"]);
}

#[test]
fn at_last_the_tool_is_at_the_end_of_the_last_segment_at_sweep_height() {
    let even = moves(&path("T5 O3 I1 B3", LINE));
    assert_eq!(even[even.len() - 2..], ["L 10", "S 40,0"]);
    let odd = moves(&path("T5 O3 I1 B4", LINE));
    assert_eq!(odd, ["L 5", "D 4", "M 40,0 4", "L 10"]);
}

/// Between edges that do not meet, the tool goes up to the sweep height, across, and down again.
#[test]
fn the_tool_travels_over_the_material() {
    // The second line is shallower, so the lower edges of the first and the third do not meet.
    let lines = "mill 0,0 40,0\nmill 40,0 80,0 \"B4\"\nmill 80,0 120,0\nend 120,0";
    assert_eq!(
        moves(&path("T5 O3 I1 B3", lines)),
        [
            "L 5",
            "D 4",
            "M 40,0 4",
            "M 80,0 4",
            "M 120,0 4",
            "D 3",
            "M 80,0 3",
            "L 10",
            "S 40,0",
            "L 5",
            "D 3",
            "M 0,0 3",
            "L 10",
            "S 120,0"
        ]
    );
}

/// The chains of a path use the path's own S or, if it has none, that of the option.
#[test]
fn the_sweep_height_is_the_paths_or_the_options() {
    let last = |parameters: &str| moves(&path(parameters, LINE)).iter().rev().nth(1).unwrap().clone();
    assert_eq!(last("T5 O3 I1 B3 S8"), "L 8");
    assert_eq!(last("T5 O3 I1 B3"), "L 10");
}

#[test]
fn a_comment_stands_before_each_pass_of_its_segment() {
    let lines = "mill 0,0 40,0 \"Qx\"\nmill 40,0 40,30\nend 40,30";
    assert_eq!(
        moves_and_comments(&path("T5 O3 I1 B3", lines)),
        [
            "L 5",
            "D 4",
            "Q x",
            "M 40,0 4",
            "M 40,30 4",
            "D 3",
            "M 40,0 3",
            "Q x",
            "M 0,0 3",
            "L 10",
            "S 40,30"
        ]
    );
    assert_eq!(moves_and_comments(&path("T5 O3 I5 B0", "mill 0,0 40,0 \"Q\"\nend 40,0"))[2], "Q ");
    // The comment also follows the plunge if the segment begins with a bar.
    let bars = path("T5 O3 I5 B0 D3 P50 U50", "bars 0,0 40,0 \"Qx\"\nend 40,0");
    assert_eq!(moves_and_comments(&bars)[..4], ["L 5", "D 3", "Q x", "M 40,0 3"]);
    assert_eq!(shown(&program_with(&bars, COMPATIBLE), true)[..4], ["L 5", "D 0", "Q x", "L 3"]);
}

/// Z is corrected for the start of the move.
#[test]
fn heights_name_the_point_where_the_move_begins() {
    let program = program(&path("T5 O3 I1 B4", "mill 0,0 40,0 40,30\nend 40,30"));
    let points: Vec<(f64, f64)> = program
        .steps
        .iter()
        .filter_map(|step| match step {
            ProgramStep::Move {
                to: PlannedMove::Line { z, .. } | PlannedMove::Lift { z } | PlannedMove::Drill { z, .. },
                ..
            } => Some((z.at.x, z.at.y)),
            _ => None,
        })
        .collect();
    assert_eq!(points, [(0.0, 0.0), (0.0, 0.0), (0.0, 0.0), (40.0, 0.0), (40.0, 30.0)]);
}

/// The start of the emitted path becomes X0 Y0.
#[test]
fn coordinates_count_from_the_start() {
    let drawing = "layer 1234.1P\nstart 100,50 \"T5 O3 I5 B0\"\nmill 100,50 140,80\nend 140,80";
    assert_eq!(moves(drawing), ["L 5", "D 0", "M 40,30 0", "L 10"]);
}

/// A dead end is milled there and back at each depth.
#[test]
fn returns_have_edges_of_their_own() {
    let dead_end = "mill 0,0 20,0\nturn 20,0\nend 0,0";
    assert_eq!(
        moves(&path("T5 O3 I1 B3", dead_end)),
        ["L 5", "D 4", "M 20,0 4", "M 0,0 4", "D 3", "M 20,0 3", "M 0,0 3", "L 10"]
    );
}

/// Each line has its own depth: 5 mm require six passes of two moves, 2 mm require three.
#[test]
fn moves_are_estimated_line_by_line() {
    let with_depth = |depth: &str| {
        let lines = format!("mill 0,0 20,0\nmill 20,0 40,0 \"{depth}\"\nmill 40,0 60,0\nend 60,0");
        estimate(&path("T5 O2 I1 B0", &lines))
    };
    assert_eq!([with_depth("B0"), with_depth("B3")], [36, 30]);
}

/// A move and a comment take 208 bytes, as stated in docs/reliability.md.
#[test]
fn memory_is_estimated_with_a_comment_for_each_move() {
    assert_eq!(
        [estimated_bytes(1), estimated_bytes(1000), estimated_bytes(u64::MAX)],
        [208, 208_000, u64::MAX]
    );
}
