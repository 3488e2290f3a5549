//! Tests helical circles. ("Helical circle")

use pathbuild_path::PathOptions;
use pathbuild_toolpath::{PlannedMove, ProgramStep};

use crate::support::{
    COMPATIBLE, OPTIONS, counts, estimate, moves, moves_and_comments, path, program, program_with, short,
    shown,
};

/// Returns a sweep to a helical circle, the circle, and a sweep away from it.
fn helix(circle: &str) -> String {
    format!("sweep 0,0 20,0\n{circle}\nsweep 20,0 40,0\nend 40,0")
}

#[test]
fn half_circles_go_down_by_half_an_infeed_each() {
    assert_eq!(
        moves(&path("T5 O3 I2 B1", &helix("circle 20,0 d 8"))),
        [
            "L 10",
            "S 20,0",
            "L 8",
            "S 20,-2.5",
            "C 20,2.5 4",
            "C 20,-2.5 3",
            "C 20,2.5 2",
            "C 20,-2.5 1",
            "C 20,2.5 1",
            "C 20,-2.5 1",
            "L 10",
            "S 40,0"
        ]
    );
}

/// The last full circle is at the bottom, even if the depth is not a multiple of the infeed.
#[test]
fn the_last_circle_runs_at_the_bottom() {
    let heights = |parameters: &str| {
        let moves = moves(&path(parameters, &helix("circle 20,0 d 8")));
        let arcs = moves.iter().filter_map(|step| step.strip_prefix("C ")?.split(' ').nth(1));
        arcs.collect::<Vec<_>>().join(" ")
    };
    assert_eq!(heights("T5 O3 I2 B1"), "4 3 2 1 1 1");
    assert_eq!(heights("T5 O3 I3 B1"), "3.5 2 1 1 1 1");
    assert_eq!(heights("T5 O3 I3 B1.5"), "3.5 2 1.5 1.5 1.5 1.5");
    assert_eq!(heights("T5 O3 I9 B1"), "1 1 1 1");
    assert_eq!(heights("T5 O3 I2 B1.00001"), "4 3 2 1 1 1");
}

#[test]
fn a_helical_mark_ends_at_d() {
    let mark = moves(&path("T5 O3 I2 B1 D3", &helix("circle DIVIDE 20,0 d 8")));
    assert_eq!(mark[4..8], ["C 20,2.5 4", "C 20,-2.5 3", "C 20,2.5 3", "C 20,-2.5 3"]);
}

/// At the centre of a small circle no core is left, so the cutter is not raised there.
#[test]
fn a_circle_with_a_core_is_left_at_sweep_height() {
    let after = |diameter: &str| {
        moves(&path("T5 O3 I9 B1", &helix(&format!("circle 20,0 d {diameter}"))))[8..].to_vec()
    };
    assert_eq!(after("6"), ["S 20,0", "L 10", "S 40,0"]);
    // Two sweeps at the same height are merged.
    assert_eq!(after("6.1"), ["L 10", "S 40,0"]);
    let ends = moves(&path("T5 O3 I9 B1", "sweep 0,0 20,0\ncircle 20,0 d 6.1\nend 20,0"));
    assert_eq!(ends[8..], ["L 10", "S 20,0"]);
}

#[test]
fn a_comment_stands_after_the_retraction() {
    let moves = moves_and_comments(&path("T5 O3 I9 B1", &helix("circle 20,0 d 8 \"Qx\"")));
    assert_eq!(moves[2..5], ["L 8", "Q x", "S 20,-2.5"]);
}

/// If a circle follows a hole, the tool is raised from the hole first.
#[test]
fn the_tool_is_raised_from_a_hole() {
    let both = path("T5 O3 I9 B1", &helix("circle 20,0 d 3\ncircle 20,0 d 8"));
    assert_eq!(moves(&both)[2..6], ["L 5", "D 1", "L 8", "S 20,-2.5"]);
}

/// J is the radius of the circle that the cutter's centre follows, and I is zero.
#[test]
fn centres_are_straight_above_and_below() {
    let program = program(&path("T5 O3 I9 B1", &helix("circle 20,0 d 8")));
    let centres: Vec<(String, String, bool)> = program
        .steps
        .iter()
        .filter_map(|step| match step {
            ProgramStep::Move { to: PlannedMove::Arc { centre, is_spiral, .. }, .. } => {
                Some((short(centre.x), short(centre.y), *is_spiral))
            }
            _ => None,
        })
        .collect();
    assert_eq!(centres[..2], [("0".into(), "2.5".into(), true), ("0".into(), "-2.5".into(), true)]);
}

#[test]
fn what_a_helical_circle_counts() {
    // The length of the lift is counted from the start of the last full circle, which is at the bottom.
    assert_eq!(
        counts(&path("T5 O3 I2 B1", &helix("circle 20,0 d 8 \"F300\"")))[2..],
        [
            "Sweep 2",
            "Sweep 2.5",
            "Milling 7.854 300",
            "Milling 7.854 300",
            "Milling 7.854 300",
            "Milling 7.854 300",
            "Milling 7.854 300",
            "Milling 7.854 300",
            "Sweep 9",
            "Sweep 20"
        ]
    );
}

/// On the way down, heights are corrected for the centre of the circle, and so is the height of the lift over the core.
#[test]
fn heights_name_the_centre() {
    let program = program(&path("T5 O3 I9 B1", &helix("circle 20,0 d 8")));
    let points: Vec<(f64, f64)> = program
        .steps
        .iter()
        .skip_while(|step| !matches!(step, ProgramStep::Move { to: PlannedMove::Arc { .. }, .. }))
        .filter_map(|step| match step {
            ProgramStep::Move { to: PlannedMove::Arc { z, .. } | PlannedMove::Lift { z }, .. } => {
                Some((z.at.x, z.at.y))
            }
            _ => None,
        })
        .collect();
    assert_eq!(points, [(20.0, 0.0); 5]);
}

/// O3, d 11: the cutter's centre follows a circle with a diameter of 8 mm, which is 25.133 mm long, so there are two bars of 2 mm.
const BARS: &str = "circle BORDER 20,0 d 11";

#[test]
fn below_d_full_circles_leave_bars() {
    let milled = moves(&path("T5 O3 I2 B0 D2 P2 U9", &helix(BARS)));
    // First the circle is milled down to D as usual.
    assert_eq!(milled[4..10], ["C 20,4 4", "C 20,-4 3", "C 20,4 2", "C 20,-4 2", "C 20,4 2", "C 20,-4 2"]);
    // Then follows a full circle at B: bar, down, between, up, bar, down, between, up, bar.
    let circle = &milled[10..19];
    let heights: Vec<&str> = circle.iter().map(|step| step.split(' ').nth(2).unwrap()).collect();
    assert_eq!(heights, ["2", "0", "0", "2", "2", "0", "0", "2", "2"]);
    assert_eq!(circle[8], "C 20,-4 2");
    assert!(circle.iter().all(|step| step.starts_with('C')));
    assert_eq!(milled[19..], ["L 10", "S 40,0"]);
}

/// From D, the circle is milled in steps of I; the last step is at B.
#[test]
fn circles_with_bars_go_down_by_infeeds() {
    let lowest = |parameters: &str, options: PathOptions| {
        let moves = shown(&program_with(&path(parameters, &helix(BARS)), options), false);
        let below = moves
            .iter()
            .filter_map(|step| step.strip_prefix("C ")?.split(' ').nth(1))
            .filter(|z| z.parse::<f64>().unwrap() < 2.0);
        let mut heights: Vec<&str> = below.collect();
        heights.dedup();
        heights.join(" ")
    };
    let of_default = |parameters: &str| lowest(parameters, OPTIONS);
    assert_eq!(of_default("T5 O3 I0.5 B1 D2 P2 U21"), "1.5 1");
    assert_eq!(of_default("T5 O3 I0.4 B1 D2 P2 U21"), "1.6 1.2 1");
    assert_eq!(of_default("T5 O3 I5 B1 D2 P2 U21"), "1");
    // A remainder that is only a rounding error is not a separate pass.
    assert_eq!(of_default("T5 O3 I0.3333333333 B1 D2 P2 U21"), "1.667 1.333 1");
    // PathDxf2GCode continues the infeeds of the spiral (with I0.7: 4.3 to 1.5), although the spiral stops at D.
    let of_original = |parameters: &str| lowest(parameters, COMPATIBLE);
    assert_eq!(of_original("T5 O3 I0.5 B1 D2 P2 U21"), "1.5 1");
    assert_eq!(of_original("T5 O3 I0.4 B1 D2 P2 U21"), "1.4 1");
    assert_eq!(of_original("T5 O3 I0.7 B1 D2 P2 U21"), "1");
    // The next infeeds are below B, so the ring between D and B remains.
    assert_eq!(of_original("T5 O3 I5 B1 D2 P2 U21"), "");
}

/// Bars are counted along the circle of the cutter's centre, which is 25.133 mm long and not 28 mm: there are two sweeps, 6 moves down to D, and
/// two passes with two bars.
#[test]
fn bars_of_a_circle_are_estimated_by_where_the_centre_runs() {
    assert_eq!(estimate(&path("T5 O3 I2 B0 D2 P2 U7", &helix(BARS))), 2 * 4 + 6 + 2 * 9);
}

#[test]
fn without_room_for_a_bar_nothing_below_d_is_milled() {
    let milled = moves(&path("T5 O3 I5 B0 D2 P2 U25", &helix(BARS)));
    assert_eq!(milled[4..], ["C 20,4 2.5", "C 20,-4 2", "C 20,4 2", "C 20,-4 2", "L 10", "S 40,0"]);
}

/// Returns the moves of a project that embeds a path with this circle, turned by a right angle to the left.
fn turned_moves(circle: &str, options: PathOptions) -> Vec<String> {
    let drawing = format!(
        "layer 8001.1P\nstart 0,0 \"T9 O3 S20\"\nsubpath 0,0 0,40 \">1234.1P T5\"\nend 0,40\n{}",
        path("T5 O3 I2 B0 D2 P2 U21", &helix(circle))
    );
    shown(&program_with(&drawing, options), false)
}

/// Circles begin below their centre, where the half circles end and the first bar stands, even if the embedding rotates the path.
#[test]
fn circles_begin_below_the_centre_however_the_path_is_turned() {
    let turned = [("circle 20,0 d 11", OPTIONS), (BARS, OPTIONS), (BARS, COMPATIBLE)];
    for milled in turned.map(|(circle, options)| turned_moves(circle, options)) {
        let first = milled.iter().position(|step| step.starts_with('C')).unwrap();
        assert_eq!(milled[first - 1..first + 2], ["S 0,16", "C 0,24 4", "C 0,16 3"], "{milled:?}");
        assert!(
            milled.iter().rfind(|step| step.starts_with('C')).unwrap().starts_with("C 0,16 "),
            "{milled:?}"
        );
    }
}

#[test]
fn a_helical_circle_is_raised_by_h() {
    let drawing = format!(
        "layer 8001.1P\nstart 0,0 \"T9 O3 S20\"\nsubpath 0,0 40,0 \">1234.1P T5 H1\"\nend 40,0\n{}",
        path("T5 O3 I2 B0 D2 P2 U21", &helix(BARS))
    );
    let milled = moves(&drawing);
    assert_eq!(milled[..6], ["L 9", "S 20,0", "S 20,-4", "C 20,4 5", "C 20,-4 4", "C 20,4 3"]);
    assert!(milled.iter().any(|step| step.ends_with(" 1")), "{milled:?}");
    assert!(!milled.iter().any(|step| step.ends_with(" 0") && step.starts_with('C')), "{milled:?}");
}
