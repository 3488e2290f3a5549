//! Tests the lengths and times that PathDxf2GCode counts.

use pathbuild_toolpath::{
    Count, Height, MoveClass, PlannedMove, Program, ProgramStep, Statistics, Total, Xy,
};

use crate::support::{counts, path, program};

#[test]
fn milling_counts_with_the_segments_feed_and_coming_down_with_the_paths() {
    let line = "mill 0,0 40,0 \"F300\"\nend 40,0";
    assert_eq!(
        counts(&path("T5 O3 I5 B0 F200", line)),
        ["Sweep 5", "Drilling 5 200", "Milling 40 300", "Sweep 10"]
    );
    // If the path has no feed, --feed is used.
    assert_eq!(counts(&path("T5 O3 I5 B0", line))[1], "Drilling 5 100");
    // Sweepless milling is counted in the same way, with a descent to W first.
    assert_eq!(counts(&path("T5 O3 I5 B0 F200 W1", line))[1..3], ["Drilling 4 200", "Milling 40 300"]);
}

#[test]
fn slopes_count_with_their_length_in_the_plane() {
    let found = counts(&path("T5 O3 D2 B0 P2 U38 I5", "bars 0,0 40,0\nend 40,0"));
    assert_eq!(
        found[2..7],
        ["Milling 2.5 100", "Milling 1 100", "Milling 33 100", "Milling 1 100", "Milling 2.5 100"]
    );
}

/// The length of a sweep is the distance in space to its target, including the target's height.
#[test]
fn a_sweep_counts_with_the_height_of_its_aim() {
    assert_eq!(counts(&path("T5 O3 I5 B0", "sweep 0,0 40,0\nend 40,0"))[1], "Sweep 40");
    // The tool travels at a height of 10 mm from (80, 0) to (40, 0), where the next edge is at 3 mm.
    let travel = "mill 0,0 40,0\nmill 40,0 80,0 \"B4\"\nmill 80,0 120,0\nend 120,0";
    let found = counts(&path("T5 O3 I1 B3", travel));
    assert!(found.contains(&"Sweep 40.608".to_owned()), "{found:?}");
}

fn drill(z: f64, length: f64, feed: Option<f64>) -> ProgramStep {
    let class = if feed.is_some() { MoveClass::Drilling } else { MoveClass::Sweep };
    ProgramStep::Move {
        to: PlannedMove::Drill { feed: 100.0, z: Height { z, at: Xy::origin() } },
        count: Count { class, length, feed },
    }
}

#[test]
fn totals_add_up_with_the_last_lift() {
    let program = Program {
        sweep_height: 10.0,
        steps: vec![drill(2.0, 8.0, Some(100.0)), drill(4.0, 6.0, None)],
        ..Program::default()
    };
    let statistics = Statistics::of_reference(&program, 1000.0);
    let start = program.start_height();
    assert_eq!(statistics.commands, 3);
    assert_eq!((statistics.drilling.length, statistics.drilling.time), (8.0, 0.08));
    assert_eq!(statistics.sweeps.length, 6.0 + (start - 4.0));
    assert_eq!(statistics.sweeps.time, 6.0 / 1000.0 + (start - 4.0) / 1000.0);
    let sum = statistics.sum();
    assert!((sum.length - 20.0).abs() < 1e-4 && (sum.time - 0.092).abs() < 1e-4);
}

/// A program without moves still lifts the tool once.
#[test]
fn a_program_without_moves_is_one_command() {
    assert_eq!(Statistics::of_reference(&Program::default(), 1000.0).commands, 1);
}

#[test]
fn every_move_counts_once() {
    let drawing = path("T5 O3 I1 B3", "mill 0,0 40,0\nend 40,0");
    assert_eq!(Statistics::of_reference(&program(&drawing), 1000.0).commands, 7 + 1);
}

/// The start is slightly above S, so that the first sweep states its Z.
#[test]
fn the_start_is_a_little_above_the_sweep_height() {
    let program = Program { sweep_height: 10.0, ..Program::default() };
    assert_eq!(program.start_height(), 10.0 * (1.0 + 0.000_002));
}

/// The minutes are 1.4 times the calculated time, rounded up to whole minutes after rounding to 0.0000001 s.
#[test]
fn minutes_are_rounded_up() {
    let minutes = |time: f64| Total { length: 0.0, time }.minutes();
    assert_eq!(minutes(0.0), 0.0);
    assert_eq!(minutes(0.01), 1.0);
    assert_eq!(minutes(5.0 / 1.4), 5.0);
    assert_eq!(minutes(5.0 / 1.4 + 1e-12), 5.0);
    assert_eq!(minutes(5.0 / 1.4 + 1e-8), 6.0);
}

/// The minutes of the sum are calculated from the total time, and not by adding minutes.
#[test]
fn the_sum_is_rounded_once() {
    let total = |time| Total { length: 0.0, time };
    let statistics =
        Statistics { milling: total(0.1), drilling: total(0.1), sweeps: total(0.1), commands: 3 };
    assert_eq!(statistics.sum().minutes(), 1.0);
}
