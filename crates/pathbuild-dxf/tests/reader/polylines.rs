//! Tests that LWPOLYLINE and POLYLINE become lines and arcs. (book: language/layers-and-names)

use pathbuild_diagnostic::{Code, EntityKind, Handle};
use pathbuild_dxf::{Arc, Drawing, Geometry, Line, Point3};

use crate::support::{entities, faults, file_faults, read_all};

fn point(x: f64, y: f64) -> Point3 {
    Point3 { x, y, z: 0.0 }
}

fn line(x1: f64, y1: f64, x2: f64, y2: f64) -> Geometry {
    Geometry::Line(Line { start: point(x1, y1), end: point(x2, y2) })
}

fn shapes(drawing: &Drawing) -> Vec<Geometry> {
    assert_eq!((&drawing.faults, &drawing.left_out), (&vec![], &vec![]));
    drawing.entities.iter().map(|entity| entity.geometry.clone()).collect()
}

fn light(groups: &str) -> Drawing {
    read_all(entities(&format!("0 LWPOLYLINE\n5 2F\n8 A\n{groups}")))
}

/// Reads a POLYLINE with these groups and vertices.
fn heavy(groups: &str, vertices: &[&str]) -> Drawing {
    let vertices: Vec<_> = vertices.iter().map(|groups| format!("0 VERTEX\n8 OTHER\n{groups}")).collect();
    let vertices = vertices.join("\n");
    read_all(entities(&format!("0 POLYLINE\n5 2F\n8 A\n66 1\n{groups}\n{vertices}\n0 SEQEND\n8 A")))
}

/// The centre is 2.5 km away. The arc becomes a line if it deviates from one by at most half a micrometre.
#[test]
fn an_arc_that_is_too_large_is_a_line_if_it_is_flat() {
    let shape = |bulge: &str| light(&format!("90 2\n10 0\n20 0\n42 {bulge}\n10 100\n20 0"));
    assert_eq!(shapes(&shape("0.00000999")), [line(0.0, 0.0, 100.0, 0.0)]);
    assert!(!shape("0.0000101").left_out.is_empty() || !shape("0.0000101").faults.is_empty());
}

/// Returns the ends of an arc, computed from its centre, radius and angles.
fn ends(arc: &Arc) -> [[f64; 2]; 2] {
    [arc.start_angle, arc.end_angle].map(|angle| {
        let (sin, cos) = libm::sincos(angle.to_radians());
        [arc.centre.x + arc.radius * cos, arc.centre.y + arc.radius * sin]
    })
}

fn assert_near(a: [f64; 2], b: [f64; 2]) {
    assert!((a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9, "{a:?} {b:?}");
}

#[test]
fn straight_pieces_become_lines() {
    let expected = [line(0.0, 0.0, 3.0, 0.0), line(3.0, 0.0, 3.0, 4.0)];
    assert_eq!(
        shapes(&light("90 3\n70 0\n43 0.5\n10 0\n20 0\n10 3\n20 0\n40 1\n41 2\n10 3\n20 4")),
        expected
    );
    assert_eq!(
        shapes(&heavy("10 0\n20 0\n30 0", &["10 0\n20 0", "10 3\n20 0\n40 1", "10 3\n20 4"])),
        expected
    );
}

/// Only the centre line is read, so a width is reported, once for each layer.
#[test]
fn a_width_is_reported() {
    let wide = |name: &str| [format!("PB111 5 the width of {name} is ignored: only its centre line counts")];
    let light_width =
        |widths: &str| file_faults(&light(&format!("{widths}10 0\n20 0\n40 0\n41 0\n10 3\n20 0")));
    assert_eq!(light_width(""), [""; 0]);
    assert_eq!(light_width("43 0\n"), [""; 0]);
    assert_eq!(light_width("43 3\n"), [""; 0], "the widths of the vertices count");
    assert_eq!(file_faults(&light("43 0.001\n10 0\n20 0\n10 3\n20 0")), wide("LWPOLYLINE"));
    assert_eq!(file_faults(&light("10 0\n20 0\n40 0\n41 2\n10 3\n20 0")), wide("LWPOLYLINE"));
    let heavy_width = |own: &str, vertex: &str| {
        file_faults(&heavy(own, &[&format!("10 0\n20 0{vertex}"), &format!("10 3\n20 0{vertex}")]))
    };
    assert_eq!(heavy_width("40 0\n41 0", ""), [""; 0]);
    assert_eq!(heavy_width("40 2\n41 2", ""), wide("POLYLINE"));
    assert_eq!(heavy_width("40 2\n41 2", "\n40 0\n41 0"), [""; 0]);
    assert_eq!(heavy_width("", "\n40 2"), wide("POLYLINE"));
    let two = "0 LWPOLYLINE\n8 A\n43 1\n10 0\n20 0\n10 1\n20 0\n";
    assert_eq!(
        file_faults(&read_all(entities(&format!("{two}{two}{}", two.replace("8 A", "8 B"))))).len(),
        2
    );
}

#[test]
fn the_stated_number_of_vertices_is_that_of_the_vertices() {
    let stated = |count: &str| faults(&light(&format!("90 {count}\n10 0\n20 0\n10 3\n20 0")));
    assert_eq!(stated("2"), [""; 0]);
    for other in ["1", "3", "-2"] {
        let expected =
            format!("PB002 12 A: LWPOLYLINE: group 90 says that there are {other} vertices, but there are 2");
        assert_eq!(stated(other), [expected]);
    }
    assert_eq!(faults(&light("10 0\n20 0\n10 3\n20 0")), [""; 0], "it may be missing");
}

#[test]
fn a_polyline_of_a_single_point_is_reported() {
    let pointlike = |name: &str| {
        [format!("PB121 5 {name} has no length: all of its points coincide, so it draws nothing")]
    };
    assert_eq!(file_faults(&light("90 2\n10 5\n20 5\n10 5\n20 5")), pointlike("LWPOLYLINE"));
    assert_eq!(file_faults(&light("90 1\n10 5\n20 5")), pointlike("LWPOLYLINE"));
    assert_eq!(file_faults(&heavy("", &[])), pointlike("POLYLINE"));
    assert_eq!(file_faults(&heavy("", &["10 5\n20 5"])), pointlike("POLYLINE"));
    assert_eq!(file_faults(&light("90 3\n10 5\n20 5\n10 5\n20 5\n10 5\n20 5.001")), [""; 0]);
}

/// The polyline becomes two half circles, neither of which is lost.
#[test]
fn a_closed_polyline_of_two_corners_goes_there_and_back() {
    let halves = "10 0\n20 0\n42 1\n10 4\n20 0\n42 1";
    assert_eq!(shapes(&light(&format!("70 1\n{halves}"))).len(), 2);
    assert_eq!(shapes(&light(&format!("70 0\n{halves}"))).len(), 1);
    assert_eq!(shapes(&heavy("70 1", &["10 0\n20 0\n42 1", "10 4\n20 0\n42 1"])).len(), 2);
    assert_eq!(shapes(&light("70 1\n10 0\n20 0\n10 4\n20 0")).len(), 2, "a line there and back");
}

#[test]
fn a_closed_polyline_returns_to_its_start() {
    let expected = [line(0.0, 0.0, 3.0, 0.0), line(3.0, 0.0, 3.0, 4.0), line(3.0, 4.0, 0.0, 0.0)];
    for flags in [1, 129] {
        assert_eq!(shapes(&light(&format!("70 {flags}\n10 0\n20 0\n10 3\n20 0\n10 3\n20 4"))), expected);
    }
    assert_eq!(shapes(&heavy("70 1", &["10 0\n20 0", "10 3\n20 0", "10 3\n20 4"])), expected);
    assert_eq!(shapes(&light("70 128\n10 0\n20 0\n10 3\n20 0\n10 3\n20 4")), expected[..2]);
}

#[test]
fn pieces_without_length_are_dropped() {
    let expected = [line(0.0, 0.0, 3.0, 0.0), line(3.0, 0.0, 0.0, 0.0)];
    let groups = "70 1\n10 0\n20 0\n10 0\n20 0\n42 1\n10 3\n20 0\n10 0\n20 0";
    assert_eq!(shapes(&light(&groups.replace("42 1\n", ""))), expected);
    assert_eq!(shapes(&light("10 1\n20 1")), []);
    assert_eq!(shapes(&light("70 1\n10 1\n20 1\n42 1")), []);
    assert_eq!(shapes(&light("90 0")), []);
}

#[test]
fn bulges_become_arcs() {
    for (bulge, centre, radius, clockwise) in [
        (1.0, [1.0, 0.0], 1.0, false),
        (-1.0, [1.0, 0.0], 1.0, true),
        (0.5, [1.0, 0.75], 1.25, false),
        (-0.5, [1.0, -0.75], 1.25, true),
        (2.0, [1.0, -0.75], 1.25, false),
    ] {
        let drawing = light(&format!("10 0\n20 0\n42 {bulge}\n10 2\n20 0"));
        let [Geometry::Arc(arc)] = shapes(&drawing)[..] else { panic!("{drawing:?}") };
        assert_near([arc.centre.x, arc.centre.y], centre);
        assert_eq!((arc.radius, arc.clockwise), (radius, clockwise), "{bulge}");
        let [start, end] = ends(&arc);
        assert_near(start, [0.0, 0.0]);
        assert_near(end, [2.0, 0.0]);
    }
}

#[test]
fn the_bulge_is_that_of_the_piece_that_begins_at_its_vertex() {
    let drawing = light("70 1\n10 0\n20 0\n10 2\n20 0\n42 1\n10 2\n20 2\n42 -1");
    let kinds: Vec<_> = shapes(&drawing).iter().map(|shape| matches!(shape, Geometry::Arc(_))).collect();
    assert_eq!(kinds, [false, true, true]);
    let drawing = heavy("", &["10 0\n20 0\n42 1", "10 2\n20 0\n42 1"]);
    assert_eq!(shapes(&drawing).len(), 1);
}

#[test]
fn a_hardly_bulged_piece_is_straight() {
    assert_eq!(shapes(&light("10 0\n20 0\n42 1e-9\n10 2\n20 0")), [line(0.0, 0.0, 2.0, 0.0)]);
    assert!(matches!(shapes(&light("10 0\n20 0\n42 1e-6\n10 2\n20 0"))[..], [Geometry::Arc(_)]));
}

#[test]
fn parts_share_origin_and_group() {
    let drawing = read_all(entities(
        "0 LWPOLYLINE\n5 2F\n8 A\n10 0\n20 0\n10 3\n20 0\n10 3\n20 4\n0 LINE\n8 A\n10 0\n20 0\n11 1\n21 0\n0 LWPOLYLINE\n8 A\n10 0\n20 0\n10 3\n20 0",
    ));
    let parts: Vec<_> = drawing.entities.iter().map(|it| (it.kind, it.group)).collect();
    let polyline = EntityKind::LwPolyline;
    assert_eq!(
        parts,
        [(polyline, Some(0)), (polyline, Some(0)), (EntityKind::Line, None), (polyline, Some(1))]
    );
    assert_eq!(drawing.origins[0], drawing.origins[1]);
    assert_eq!((drawing.origins[0].line, drawing.origins[0].handle), (5, Some(Handle(0x2F))));
    assert_eq!(heavy("", &["10 0\n20 0", "10 1\n20 0"]).entities[0].kind, EntityKind::Polyline);
}

#[test]
fn the_layer_is_that_of_the_polyline_and_not_of_its_vertices() {
    let drawing = heavy("", &["10 0\n20 0", "10 1\n20 0"]);
    assert_eq!(&*drawing.layers[0].name, "A");
    assert_eq!(drawing.layers.len(), 1);
}

#[test]
fn a_polyline_ends_without_seqend_as_well() {
    let drawing = read_all(entities(
        "0 POLYLINE\n8 A\n0 VERTEX\n10 0\n20 0\n0 VERTEX\n10 1\n20 0\n0 LINE\n8 A\n10 0\n20 0\n11 1\n21 0\n0 VERTEX\n10 9\n20 9",
    ));
    assert_eq!(shapes(&drawing), [line(0.0, 0.0, 1.0, 0.0), line(0.0, 0.0, 1.0, 0.0)]);
}

#[test]
fn elevations_are_given() {
    let heights = |drawing: &Drawing| match shapes(drawing)[0] {
        Geometry::Line(line) => [line.start.z, line.end.z],
        _ => panic!("{drawing:?}"),
    };
    assert_eq!(heights(&light("38 5\n10 0\n20 0\n10 1\n20 0")), [5.0, 5.0]);
    assert_eq!(heights(&heavy("10 0\n20 0\n30 5", &["10 0\n20 0\n30 0", "10 1\n20 0"])), [5.0, 5.0]);
    assert_eq!(heights(&heavy("", &["10 0\n20 0\n30 2", "10 1\n20 0"])), [2.0, 0.0]);
}

#[test]
fn the_frame_of_a_smoothed_polyline_is_no_part_of_it() {
    let vertices = ["70 16\n10 9\n20 9", "70 8\n10 0\n20 0", "70 8\n10 1\n20 0"];
    assert_eq!(shapes(&heavy("70 4", &vertices)), [line(0.0, 0.0, 1.0, 0.0)]);
    assert_eq!(shapes(&heavy("70 0", &vertices)).len(), 2);
}

#[test]
fn three_dimensional_polylines_and_meshes_are_left_out() {
    for flags in [8, 9, 16, 64] {
        let drawing = heavy(&format!("70 {flags}\n10 0\n20 0"), &["10 1\n20 x", "10 1\n20 0"]);
        let [left_out] = &drawing.left_out[..] else { panic!("{drawing:?}") };
        assert_eq!(left_out.diagnostic.code(), Code::UnsupportedCurve);
        assert_eq!(left_out.kind, EntityKind::Polyline);
        assert_eq!(
            (left_out.diagnostic.place.line, left_out.diagnostic.place.handle),
            (Some(5), Some(Handle(0x2F)))
        );
        assert!(drawing.entities.is_empty() && drawing.faults.is_empty());
    }
}

#[test]
fn broken_vertices_break_the_polyline() {
    for (groups, fault) in [
        ("10 0\n20 0\n10 x\n20 0", "PB002 16 A: LWPOLYLINE: group 10 must be a number, not \"x\""),
        ("10 0\n20 0\n10 1\n10 2\n20 0", "PB002 5 A: LWPOLYLINE: group 20 is missing"),
        ("10 0\n20 0\n10 1", "PB002 5 A: LWPOLYLINE: group 20 is missing"),
        ("10 0\n42 1\n10 1\n20 0", "PB002 5 A: LWPOLYLINE: group 20 is missing"),
        ("42 1\n10 0\n20 0\n10 1\n20 0", "PB002 5 A: LWPOLYLINE: group 10 is missing"),
        ("20 1\n10 0\n20 0", "PB002 5 A: LWPOLYLINE: group 10 is missing"),
        ("10 0\n20 0\n42 x", "PB002 16 A: LWPOLYLINE: group 42 must be a number, not \"x\""),
    ] {
        let drawing = light(groups);
        assert_eq!(faults(&drawing), [fault], "{groups}");
        assert!(drawing.entities.is_empty());
    }
    let drawing = heavy("", &["10 0\n20 0", "10 1\n20 x", "10 y\n20 0"]);
    assert_eq!(faults(&drawing), ["PB002 28 A: POLYLINE: group 20 must be a number, not \"x\""]);
    assert!(drawing.entities.is_empty());
}
