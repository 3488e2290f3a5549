//! Tests embedded paths: position, height and surrounding moves. (book: language/embedding)

use crate::support::{moves, moves_and_comments, path};

/// Returns a project from (0, 0) that embeds a component of 40 mm, together with the component.
fn project(segment: &str, end: &str, component: &str) -> String {
    format!("layer 8001.1P\nstart 0,0 \"T9 O3 S20\"\n{segment}\nend {end}\n{component}")
}

fn component() -> String {
    path("T5 O3 I5 B0", "mill 0,0 40,0\nend 40,0")
}

#[test]
fn a_subpath_is_marked_at_both_ends() {
    let moves = moves_and_comments(&project("subpath 0,0 40,0 \">1234.1P\"", "40,0", &component()));
    assert_eq!(moves, ["START 1234.1P", "L 5", "D 0", "M 40,0 0", "L 8", "END 1234.1P"]);
}

/// The S of an embedded path is its own or T + O, regardless of the embedding path's S.
#[test]
fn an_embedded_path_has_its_own_sweep_height() {
    let last = |parameters: &str| {
        let component = path(parameters, "mill 0,0 40,0\nend 40,0");
        moves(&project("subpath 0,0 40,0 \">1234.1P\"", "40,0", &component)).pop().unwrap()
    };
    assert_eq!(last("T5 O3 I5 B0"), "L 8");
    assert_eq!(last("T5 O3 I5 B0 S12"), "L 12");
}

#[test]
fn a_path_is_turned_and_moved() {
    let component = path("T5 O3 I5 B0", "mill 0,0 40,10 40,0\nend 40,0");
    let there = moves(&project("sweep 0,0 10,0\nsubpath 10,0 10,40 \">1234.1P\"", "10,40", &component));
    assert_eq!(there[4..6], ["M 0,40 0", "M 10,40 0"]);
    let back = moves(&project("sweep 0,0 50,0\nsubpath 50,0 10,0 \">1234.1P\"", "10,0", &component));
    assert_eq!(back[4..6], ["M 10,-10 0", "M 10,0 0"]);
}

/// If the segment is run from its end, the start of the embedded path is there.
#[test]
fn the_start_lies_where_the_walk_comes_from() {
    let component = path("T5 O3 I5 B0", "mill 0,0 40,10 40,0\nend 40,0");
    let moves = moves(&project("subpath 40,0 0,0 \">1234.1P\"", "40,0", &component));
    assert_eq!(moves[2..4], ["M 40,10 0", "M 40,0 0"]);
}

/// Embedded paths are not scaled. They may miss the end of the segment by 0.001 mm, but the next element begins at the end of the segment.
#[test]
fn what_follows_begins_at_the_segments_end() {
    let lines = "subpath 0,0 40.0009,0 \">1234.1P\"\nmill 40.0009,0 60,0 \"I5 B0\"";
    let moves = moves(&project(lines, "60,0", &component()).replace("T9 O3 S20", "T5 O3 S20"));
    assert_eq!(moves, ["L 5", "D 0", "M 40,0 0", "L 8", "L 5", "D 0", "M 60,0 0", "L 20"]);
}

/// Heights accumulate over nested embeddings.
#[test]
fn heights_add_up() {
    let middle = "layer 8002.1P\nstart 0,0 \"T7 O3 S15\"\nsubpath 0,0 40,0 \">1234.1P T5 H1\"\nend 40,0";
    let drawing =
        project("subpath 0,0 40,0 \">8002.1P T7 H2\"", "40,0", &format!("{middle}\n{}", component()));
    assert_eq!(moves(&drawing), ["L 8", "D 3", "M 40,0 3", "L 11"]);
}

#[test]
fn a_sweeps_own_height_is_raised_too() {
    let component = path("T5 O3", "sweep 0,0 40,0 \"S7\"\nend 40,0");
    let moves = moves(&project("subpath 0,0 40,0 \">1234.1P H2\"", "40,0", &component));
    assert_eq!(moves, ["L 9", "S 40,0"]);
}

/// A path whose start and end coincide has no direction, so it is not rotated.
#[test]
fn a_path_without_direction_is_not_turned() {
    let component = path("T5 O3 I5 B0", "mill 0,0 10,0 0,0\nend 0,0");
    let drawing = project(
        "sweep 0,0 0,40\nsubpath arc centre 10,40 r 10 from 180 to 180 \">1234.1P\"",
        "0,40",
        &component,
    );
    assert_eq!(moves(&drawing)[4], "M 10,40 0");
}

/// A path without a direction keeps its orientation relative to the embedding path, however that is rotated.
#[test]
fn a_path_without_direction_is_turned_with_what_embeds_it() {
    let closed = path("T5 O3 I5 B0", "mill 0,0 10,0 0,0\nend 0,0");
    let middle = "layer 8002.1P\nstart 0,0 \"T5 O3 S15\"\nsweep 0,0 20,0\n\
        subpath arc centre 30,0 r 10 from 180 to 180 \">1234.1P T5\"\nsweep 20,0 40,0\nend 40,0";
    let drawing = project("subpath 0,0 0,40 \">8002.1P T5\"", "0,40", &format!("{middle}\n{closed}"));
    assert_eq!(moves(&drawing)[4..6], ["M 0,30 0", "M 0,20 0"]);
}
