//! Tests the feeds of plunges and of probing. ("Elementary moves"; book: language/letters, Z)

use pathbuild_path::PathOptions;
use pathbuild_toolpath::{MoveClass, PlannedMove, Program, ProgramStep};

use crate::support::{COMPATIBLE, OPTIONS, path, program, program_with};

/// Returns for each plunge its feed, and the feed used for statistics.
fn plunges(program: &Program) -> Vec<(f64, f64)> {
    let plunge = |step: &ProgramStep| match step {
        ProgramStep::Move { to: PlannedMove::Drill { feed, .. }, count } => {
            Some((*feed, count.feed.unwrap_or(0.0)))
        }
        _ => None,
    };
    program.steps.iter().filter_map(plunge).collect()
}

/// Checks the feeds of plunges by default, and in compatible programs, which plunge at the previous feed but calculate times with another one.
#[track_caller]
fn expect(drawing: &str, default: &[f64], original: &[(f64, f64)]) {
    let default: Vec<(f64, f64)> = default.iter().map(|feed| (*feed, *feed)).collect();
    assert_eq!(plunges(&program(drawing)), default);
    assert_eq!(plunges(&program_with(drawing, COMPATIBLE)), original);
}

#[test]
fn a_hole_is_drilled_at_its_own_feed() {
    let hole = "mill 0,0 20,0 \"F1000\"\nsweep 20,0 30,0\ncircle 30,0 d 3 \"F40\"\nsweep 30,0 40,0\nend 40,0";
    expect(&path("T5 O3 I5 B0 F80", hole), &[80.0, 40.0], &[(150.0, 80.0), (1000.0, 40.0)]);
    // A hole without a feed of its own uses that of the path, or else --feed.
    let plain = "circle 0,0 d 3\nsweep 0,0 40,0\nend 40,0";
    expect(&path("T5 O3 B0 F80", plain), &[80.0], &[(150.0, 80.0)]);
    expect(&path("T5 O3 B0", plain), &[100.0], &[(150.0, 100.0)]);
}

#[test]
fn a_chains_plunge_has_the_lower_feed_of_path_and_segment() {
    let slow = path("T5 O3 I5 B0 F80", "mill 0,0 40,0 \"F30\"\nend 40,0");
    expect(&slow, &[30.0], &[(150.0, 80.0)]);
    let fast = path("T5 O3 I5 B0 F80", "mill 0,0 40,0 \"F300\"\nend 40,0");
    expect(&fast, &[80.0], &[(150.0, 80.0)]);
    let groove = path("T5 O3 I5 W3 B0 F80", "mill 0,0 40,0 \"F30\"\nend 40,0");
    expect(&groove, &[30.0, 30.0], &[(150.0, 80.0), (30.0, 80.0)]);
}

/// Between a segment at B4 and one at B3 the tool descends within the chain.
#[test]
fn a_plunge_between_edges_is_the_next_segments() {
    let drawing = path("T5 O3 I5 F80", "mill 0,0 20,0 \"B4 F20\"\nmill 20,0 40,0 \"B3 F60\"\nend 40,0");
    expect(&drawing, &[20.0, 60.0], &[(150.0, 80.0), (20.0, 80.0)]);
}

#[test]
fn plunges_into_a_bar_run_at_the_segments_feed() {
    // The plunge onto the bar at the start has the segment's feed, which is lower than the path's. Slopes are lines, not plunges.
    let bars = path("T5 O3 D2 B0 P2 U38 I5 F80", "bars 0,0 40,0 \"F30\"\nend 40,0");
    assert_eq!(plunges(&program(&bars)), [(30.0, 30.0)]);
    let counted = |step: &&ProgramStep| matches!(step, ProgramStep::Move { count, .. } if count.class == MoveClass::Drilling);
    assert_eq!(program(&bars).steps.iter().filter(counted).count(), 1);
}

#[test]
fn probing_falls_back_on_the_paths_feed() {
    let feed = |parameters: &str, probe: &str, options: PathOptions| {
        let drawing = path(parameters, &format!("mill 0,0 40,0\nend 40,0\nprobe 20,20 {probe}"));
        program_with(&drawing, options).probes[0].feed
    };
    let with = |options: PathOptions| PathOptions { probe_feed: Some(50.0), ..options };
    assert_eq!(feed("T5 O3 I5 B0 F80 Z60", "\"Z70\"", OPTIONS), 70.0);
    assert_eq!(feed("T5 O3 I5 B0 F80 Z60", "", with(OPTIONS)), 60.0);
    assert_eq!(feed("T5 O3 I5 B0 F80", "", with(OPTIONS)), 50.0);
    assert_eq!(feed("T5 O3 I5 B0 F80", "", OPTIONS), 80.0);
    assert_eq!(feed("T5 O3 I5 B0", "", OPTIONS), 100.0);
    assert_eq!(feed("T5 O3 I5 B0 F80", "", with(COMPATIBLE)), 50.0);
    assert_eq!(feed("T5 O3 I5 B0 F80", "", COMPATIBLE), 100.0);
}
