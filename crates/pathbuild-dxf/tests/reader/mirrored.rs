//! Tests object coordinates, which an extrusion direction defines. (book: reference/dxf)

use pathbuild_dxf::{Arc, Circle, Geometry, HorizontalAlign, Line, Point3};

use crate::support::{entities, faults, only_geometry, read_all};

const MIRRORED: &str = "210 0\n220 0\n230 -1";

fn point(x: f64, y: f64, z: f64) -> Point3 {
    Point3 { x, y, z }
}

fn mirrored(groups: &str) -> Geometry {
    only_geometry(entities(&format!("{groups}\n{MIRRORED}")))
}

#[test]
fn circles_and_arcs_are_mirrored_in_x() {
    let circle = mirrored("0 CIRCLE\n8 A\n10 1\n20 2\n30 3\n40 4");
    assert_eq!(circle, Geometry::Circle(Circle { centre: point(-1.0, 2.0, -3.0), radius: 4.0 }));
    let arc = mirrored("0 ARC\n8 A\n10 1\n20 2\n40 4\n50 10\n51 100");
    let expected = Arc {
        centre: point(-1.0, 2.0, 0.0),
        radius: 4.0,
        start_angle: 170.0,
        end_angle: 80.0,
        clockwise: true,
    };
    assert_eq!(arc, Geometry::Arc(expected));
}

#[test]
fn lines_and_mtexts_are_in_world_coordinates() {
    let line = mirrored("0 LINE\n8 A\n10 1\n20 2\n11 3\n21 4");
    assert_eq!(line, Geometry::Line(Line { start: point(1.0, 2.0, 0.0), end: point(3.0, 4.0, 0.0) }));
    let Geometry::MText(text) = mirrored("0 MTEXT\n8 A\n10 1\n20 2\n40 3\n1 x") else { panic!() };
    assert_eq!(text.anchor, point(1.0, 2.0, 0.0));
}

#[test]
fn a_mirrored_mtext_stands_on_the_other_side_of_its_anchor() {
    let mtext = |groups: &str| match mirrored(&format!("0 MTEXT\n8 A\n10 1\n20 2\n40 3\n1 x\n{groups}")) {
        Geometry::MText(text) => (text.horizontal, text.rotation),
        other => panic!("{other:?}"),
    };
    assert_eq!(mtext("71 1"), (HorizontalAlign::Right, 0.0));
    assert_eq!(mtext("71 9\n50 30"), (HorizontalAlign::Left, -30.0));
    // The text is read from right to left: its direction in world coordinates is that of -x.
    assert_eq!(mtext("71 1\n11 -1\n21 0"), (HorizontalAlign::Right, 0.0));
}

#[test]
fn paragraphs_of_a_mirrored_mtext_change_sides() {
    let mtext = "0 MTEXT\n8 A\n10 1\n20 2\n40 3\n41 60\n71 2";
    for (alignment, side) in
        [("l", HorizontalAlign::Right), ("c", HorizontalAlign::Centre), ("r", HorizontalAlign::Left)]
    {
        let Geometry::MText(text) = mirrored(&format!("{mtext}\n1 \\pxq{alignment};x")) else { panic!() };
        assert_eq!((text.horizontal, text.paragraphs), (HorizontalAlign::Centre, side), "{alignment}");
    }
}

#[test]
fn a_mirrored_text_runs_backwards() {
    let text = |groups: &str| match mirrored(&format!("0 TEXT\n8 A\n10 1\n20 2\n40 3\n1 x\n{groups}")) {
        Geometry::Text(text) => (text.anchor.x, text.rotation.rem_euclid(360.0), text.backwards),
        other => panic!("{other:?}"),
    };
    assert_eq!(text(""), (-1.0, 0.0, true));
    assert_eq!(text("50 30"), (-1.0, 330.0, true));
    assert_eq!(text("71 2"), (-1.0, 0.0, false));
    assert_eq!(text("72 2\n11 5\n21 2"), (-5.0, 0.0, true));
}

#[test]
fn polylines_are_mirrored_with_their_bulges() {
    let drawing = read_all(entities(&format!(
        "0 LWPOLYLINE\n8 A\n10 0\n20 0\n42 1\n10 2\n20 0\n10 2\n20 3\n{MIRRORED}\n0 POLYLINE\n8 A\n{MIRRORED}\n0 VERTEX\n10 0\n20 0\n42 1\n0 VERTEX\n10 2\n20 0\n0 VERTEX\n10 2\n20 3\n0 SEQEND"
    )));
    let shapes: Vec<_> = drawing.entities.iter().map(|entity| &entity.geometry).collect();
    assert_eq!(shapes[..2], shapes[2..]);
    let Geometry::Arc(arc) = shapes[0] else { panic!("{shapes:?}") };
    assert_eq!((arc.centre.x, arc.clockwise), (-1.0, true));
    assert_eq!([arc.start_angle.rem_euclid(360.0), arc.end_angle.rem_euclid(360.0)], [0.0, 180.0]);
    let line = Line { start: point(-2.0, 0.0, 0.0), end: point(-2.0, 3.0, 0.0) };
    assert_eq!(shapes[1], &Geometry::Line(line));
}

#[test]
fn extrusions_that_are_straight_but_for_rounding_or_length_are_straight() {
    for extrusion in ["210 1e-12\n220 -1e-12\n230 1", "230 5", "210 0\n220 0", "230 1.0"] {
        let geometry = only_geometry(entities(&format!("0 CIRCLE\n8 A\n10 1\n20 2\n40 4\n{extrusion}")));
        assert_eq!(
            geometry,
            Geometry::Circle(Circle { centre: point(1.0, 2.0, 0.0), radius: 4.0 }),
            "{extrusion}"
        );
    }
}

#[test]
fn a_tilted_entity_is_off_its_plane() {
    let kinds = [
        "0 LINE\n8 A\n10 1\n20 2\n11 3\n21 4",
        "0 ARC\n8 A\n10 1\n20 2\n40 4\n50 1\n51 2",
        "0 CIRCLE\n8 A\n10 1\n20 2\n40 4",
        "0 TEXT\n8 A\n10 1\n20 2\n40 4\n1 x",
        "0 MTEXT\n8 A\n10 1\n20 2\n40 4\n1 x",
        "0 LWPOLYLINE\n8 A\n10 0\n20 0\n10 2\n20 0",
        "0 POLYLINE\n8 A",
    ];
    for kind in kinds {
        for extrusion in
            ["210 1e-6\n220 0\n230 1", "210 1\n220 0\n230 0", "210 0\n220 -1\n230 1", "210 0\n220 0\n230 0"]
        {
            let drawing = read_all(entities(&format!("{kind}\n{extrusion}")));
            let name = kind.lines().next().and_then(|line| line.strip_prefix("0 ")).expect("a name");
            assert_eq!(
                faults(&drawing),
                [format!("PB110 5 A: {name} lies in a tilted plane")],
                "{extrusion}"
            );
        }
    }
}

#[test]
fn heights_are_given_as_they_are() {
    let Geometry::Circle(circle) = only_geometry(entities("0 CIRCLE\n8 A\n10 1\n20 2\n30 0.5\n40 4")) else {
        panic!()
    };
    assert_eq!(circle.centre.z, 0.5);
    // R10 wrote an elevation instead of z coordinates.
    let Geometry::Line(line) =
        only_geometry(entities("0 LINE\n8 A\n38 0.5\n10 1\n20 2\n11 1\n21 3\n31 0.25"))
    else {
        panic!()
    };
    assert_eq!([line.start.z, line.end.z], [0.5, 0.25]);
}
