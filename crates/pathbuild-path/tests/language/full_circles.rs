//! Tests arcs that form full circles. (book: language/markers)

use pathbuild_dxf::{Options, Units, read};
use pathbuild_path::{Arc, Curve, Xy, raw_file};

use crate::support::language;

/// Reads the only arc of a drawing with this BLOCKS section and these entities.
fn arc(blocks: &str, entities: &str) -> Arc {
    let section = |name: &str, pairs: &str| format!("0 SECTION\n2 {name}\n{pairs}\n0 ENDSEC\n");
    let text = format!("{}{}0 EOF\n", section("BLOCKS", blocks), section("ENTITIES", entities));
    let lines: Vec<String> = text
        .lines()
        .filter_map(|line| line.split_once(' '))
        .map(|(code, value)| format!("{code}\n{value}\n"))
        .collect();
    let language = language();
    let options = Options {
        keep_layer: &|layer| language.path_pattern.is_layer(layer),
        note_text: None,
        units: Units::Header,
        approximate_curves: 0.0,
        max_entities: 100,
        max_text: 100,
        compatible: false,
    };
    let raw = raw_file(&read(lines.concat().as_bytes(), &options), &language);
    let elements = &raw.paths[0].0.drawn.elements;
    let pathbuild_path::Shape::Curve(Curve::Arc(arc)) = elements[0].shape else { panic!("{elements:?}") };
    arc
}

fn drawn(start: f64, end: f64) -> String {
    format!("0 ARC\n8 1234.1P\n10 10\n20 5\n40 3\n50 {start:?}\n51 {end:?}")
}

/// A turn may deviate from a whole one by 5e-7 radians (2.86e-5 degrees), which makes no difference to the control that runs the program.
#[test]
fn angles_a_whole_turn_or_nothing_apart_make_a_full_circle() {
    for (start, end) in [
        (218.2, 578.2),
        (218.2, 218.2),
        (0.0, 360.0),
        (0.0, 720.0),
        (33.3, -326.7),
        (-360.0, 0.0),
        (0.0, 360.0 + 2.8e-5),
        (0.1, 0.1 - 2.8e-5),
        (0.1, 0.1 + 1e-11),
    ] {
        let arc = arc("0 NONE", &drawn(start, end));
        assert_eq!((arc.degrees, arc.end), (360.0, arc.start), "{start} {end}");
    }
    // The remnant of a trimmed arc is not a full circle.
    for (start, end, degrees) in [
        (0.1, 0.1 + 2.9e-5, 2.9e-5),
        (0.1, 0.1 + 1e-10, 1e-10),
        (360.0 - 1e-7, 0.0, 1e-7),
        (0.1, 0.1 - 2.9e-5, 360.0 - 2.9e-5),
        (350.0, 10.0, 20.0),
    ] {
        let arc = arc("0 NONE", &drawn(start, end));
        assert!((arc.degrees - degrees).abs() < 1e-12, "{start} {end}: {}", arc.degrees);
        assert_ne!(arc.end, arc.start);
    }
}

#[test]
fn full_circles_stay_so_in_insertions() {
    let block = format!("0 BLOCK\n2 B\n10 0\n20 0\n{}\n0 ENDBLK", drawn(218.2, 578.2));
    for placed in
        ["50 33.3", "41 -1", "41 -1\n50 77.7", "42 -1\n50 0.1", "230 -1\n50 12.3", "41 1.7\n42 1.7\n43 1.7"]
    {
        let arc = arc(&block, &format!("0 INSERT\n8 1234.1P\n2 B\n10 1\n20 2\n{placed}"));
        assert_eq!((arc.degrees, arc.end), (360.0, arc.start), "{placed}");
        assert_ne!(arc.start, Xy::origin());
    }
}
