//! Tests merging consecutive sweeps. ("Merging sweeps")

use crate::support::{COMPATIBLE, counts, moves, moves_and_comments, path, program_with, shown};

const P: &str = "T5 O3 I5 B0 F200";

#[test]
fn of_sweeps_that_follow_each_other_the_last_is_kept() {
    assert_eq!(moves(&path(P, "sweep 0,0 10,0 20,0 20,30\nend 20,30")), ["L 10", "S 20,30"]);
}

/// Omitted sweeps are not counted: the length is that of the remaining sweep.
#[test]
fn what_is_left_out_does_not_count() {
    assert_eq!(counts(&path(P, "sweep 0,0 10,0 20,0 20,30\nend 20,30")), ["Sweep 0", "Sweep 30"]);
}

#[test]
fn a_change_of_height_keeps_them_apart() {
    let lines = "line DASHED 0,0 10,0\nline DASHED 10,0 20,0 \"S8\"\nend 20,0";
    assert_eq!(moves(&path(P, lines)), ["L 10", "S 10,0", "L 8", "S 20,0"]);
}

#[test]
fn milling_keeps_them_apart() {
    let lines = "sweep 0,0 10,0\nmill 10,0 20,0\nsweep 20,0 30,0\nend 30,0";
    assert_eq!(moves(&path(P, lines)), ["L 10", "S 10,0", "L 5", "D 0", "M 20,0 0", "L 10", "S 30,0"]);
}

/// Sweeps are merged across comments, which keep their position.
#[test]
fn comments_do_not_keep_them_apart() {
    let drawing = "layer 8001.1P\nstart 0,0 \"T9 O3 S8\"\nsweep 0,0 10,0\nsubpath 10,0 20,0 \">1234.1P T5\"\nend 20,0\n\
                   layer 1234.1P\nstart 0,0 \"T5 O3\"\nsweep 0,0 10,0\nend 10,0";
    assert_eq!(
        moves_and_comments(&drawing.replace("T9 O3 S8", "T5 O3 S8")),
        ["L 8", "START 1234.1P", "S 20,0", "END 1234.1P"]
    );
}

/// Below the S of the emitted path there may be obstacles, so there the rapid moves follow the drawing.
#[test]
fn only_sweeps_at_or_above_s_are_merged() {
    let around = |s: &str| {
        let way = format!(
            "sweep 0,0 0,20 \"S{s}\"\nsweep 0,20 40,20 \"S{s}\"\nsweep 40,20 40,0 \"S{s}\"\nend 40,0"
        );
        path("T5 O3 S12", &way)
    };
    let low = ["L 11.9", "S 0,20", "S 40,20", "S 40,0"];
    assert_eq!(moves(&around("11.9")), low);
    assert_eq!(moves(&around("12")), ["L 12", "S 40,0"]);
    // Heights that differ within the tolerance for numbers are equal.
    assert_eq!(moves(&around("11.999999")), ["L 12", "S 40,0"]);
    assert_eq!(moves(&around("12.5")), ["L 12.5", "S 40,0"]);
    assert_eq!(shown(&program_with(&around("11.9"), COMPATIBLE), false), ["L 11.9", "S 40,0"]);
}

/// Embedded paths sweep at their own S, usually T + O. Obstacles are only known to be absent above the S of the emitted path.
#[test]
fn what_embedded_paths_sweep_below_s_stays() {
    let component = path("T5 O3 I5 B0 S10", "sweep 0,0 10,0\nmill 10,0 20,0\nsweep 20,0 40,0\nend 40,0");
    let project = |s: &str| {
        format!(
            "layer 8001.1P\nstart 0,0 \"T5 O3 S{s}\"\nsubpath 0,0 40,0 \">1234.1P\"\n\
             subpath 40,0 40,40 \">1234.1P\"\nend 40,40\n{component}"
        )
    };
    let sweeps = |s: &str| moves(&project(s)).iter().filter(|step| step.starts_with('S')).count();
    assert_eq!((sweeps("10"), sweeps("20")), (3, 4));
}
