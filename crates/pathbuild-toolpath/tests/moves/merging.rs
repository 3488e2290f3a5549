//! Sweeps that follow each other. ("Merging sweeps")

use crate::support::{counts, moves, moves_and_comments, path};

const P: &str = "T5 O3 I5 B0 F200";

#[test]
fn of_sweeps_that_follow_each_other_the_last_is_kept() {
    assert_eq!(moves(&path(P, "sweep 0,0 10,0 20,0 20,30\nend 20,30")), ["L 10", "S 20,30"]);
}

/// The others neither move nor count: the length is that of the last alone.
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

/// A comment stays where it stands.
#[test]
fn comments_do_not_keep_them_apart() {
    let drawing = "layer 8001.1P\nstart 0,0 \"T9 O3 S8\"\nsweep 0,0 10,0\nsubpath 10,0 20,0 \">1234.1P T5\"\nend 20,0\n\
                   layer 1234.1P\nstart 0,0 \"T5 O3\"\nsweep 0,0 10,0\nend 10,0";
    assert_eq!(
        moves_and_comments(&drawing.replace("T9 O3 S8", "T5 O3 S8")),
        ["L 8", "START 1234.1P", "S 20,0", "END 1234.1P"]
    );
}
