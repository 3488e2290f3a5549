//! Tests Z-probes: order, positions and heights. (book: language/probes)

use pathbuild_toolpath::ProbePoint;

use crate::support::{path, program, short};

const LINE: &str = "mill 0,0 40,0\nend 40,0";

/// Returns the probes in order, with position and height.
fn probes(drawing: &str) -> Vec<String> {
    let show =
        |probe: &ProbePoint| format!("{},{} {}", short(probe.at.x), short(probe.at.y), short(probe.height));
    program(drawing).probes.iter().map(show).collect()
}

#[test]
fn from_the_start_always_to_the_nearest_not_yet_visited() {
    let statements = format!("{LINE}\nprobe 100,0\nprobe 20,20\nprobe 60,0\nprobe 90,60");
    assert_eq!(probes(&path("T5 O3 I5 B0", &statements)), ["20,20 5", "60,0 5", "100,0 5", "90,60 5"]);
}

#[test]
fn the_first_found_wins_a_tie() {
    let statements = format!("{LINE}\nprobe 30,40\nprobe 50,0\nprobe 0,50");
    assert_eq!(probes(&path("T5 O3 I5 B0", &statements))[0], "30,40 5");
}

#[test]
fn a_probes_height_is_t_and_h() {
    let statements = format!("{LINE}\nprobe 20,20 \"T6 H0.5\"\nprobe 60,20 \"H1\"");
    assert_eq!(probes(&path("T5 O3 I5 B0", &statements)), ["20,20 6.5", "60,20 6"]);
}

/// Each embedding of a path has its own copies of the probes, moved and raised with it.
#[test]
fn embedded_paths_bring_their_probes() {
    let component = path("T5 O3 I5 B0", &format!("{LINE}\nprobe 20,10 \"Lx Z30\""));
    let drawing = format!(
        "layer 8001.1P\nstart 100,100 \"T9 O3 S20\"\nsubpath 100,100 140,100 \">1234.1P T5 H1\"\n\
         subpath 140,100 140,140 \">1234.1P T5\"\nend 140,140\nprobe 100,180\n{component}"
    );
    assert_eq!(probes(&drawing), ["20,10 6", "30,20 5", "0,80 9"]);
    let program = program(&drawing);
    let first = &program.probes[0];
    assert_eq!((first.drawn_at.x, first.drawn_at.y), (20.0, 10.0));
    assert_eq!((first.label.as_deref(), first.feed), (Some("x"), 30.0));
    assert_eq!((program.probes[2].label.as_deref(), program.probes[2].feed), (None, 100.0));
}
