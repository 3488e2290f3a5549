//! Tests the approximation of ELLIPSE and SPLINE by arcs within a tolerance. (book: reference/configuration, `approximate-curves`)

use std::f64::consts::TAU;

use pathbuild_diagnostic::{Code, EntityKind, Lang, Point};
use pathbuild_dxf::{Arc, Drawing, Geometry, Options, read};

use crate::support::{entities, faults, file, options};

type XY = [f64; 2];

fn approximated(file: &str, tolerance: f64) -> Drawing {
    read(file.as_bytes(), &Options { approximate_curves: tolerance, ..options() })
}

fn distance(a: XY, b: XY) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

/// Returns the point at a fraction of a piece.
fn at(piece: &Geometry, part: f64) -> XY {
    match piece {
        Geometry::Line(line) => [
            line.start.x + (line.end.x - line.start.x) * part,
            line.start.y + (line.end.y - line.start.y) * part,
        ],
        Geometry::Arc(arc) => {
            let (sin, cos) = libm::sincos((arc.start_angle + sweep(arc) * part).to_radians());
            [arc.centre.x + arc.radius * cos, arc.centre.y + arc.radius * sin]
        }
        other => panic!("{other:?}"),
    }
}

/// Returns the angle from start to end in degrees, negative if clockwise.
fn sweep(arc: &Arc) -> f64 {
    let turn = (arc.end_angle - arc.start_angle).rem_euclid(360.0);
    if arc.clockwise { turn - 360.0 } else { turn }
}

/// Returns the direction of a piece at its start (0) or end (1).
fn direction(piece: &Geometry, part: f64) -> XY {
    const STEP: f64 = 1e-7;
    let [from, to] = if part == 0.0 { [0.0, STEP] } else { [1.0 - STEP, 1.0] };
    let [a, b] = [at(piece, from), at(piece, to)];
    let length = distance(a, b);
    [(b[0] - a[0]) / length, (b[1] - a[1]) / length]
}

fn to_piece(point: XY, piece: &Geometry) -> f64 {
    let to_ends = distance(point, at(piece, 0.0)).min(distance(point, at(piece, 1.0)));
    match piece {
        Geometry::Arc(arc) => {
            let [x, y] = [point[0] - arc.centre.x, point[1] - arc.centre.y];
            let turn = libm::atan2(y, x).to_degrees() - arc.start_angle;
            let turn = if arc.clockwise { -turn } else { turn }.rem_euclid(360.0);
            let beside = (libm::hypot(x, y) - arc.radius).abs();
            if turn <= sweep(arc).abs() { beside } else { to_ends }
        }
        line => to_polygon(point, &[at(line, 0.0), at(line, 1.0)]),
    }
}

/// Returns the maximum distance of the curve's points from the pieces. Points of the pieces must be about as near to the curve, which excludes
/// loops.
fn deviation(pieces: &[Geometry], curve: impl Fn(f64) -> XY) -> f64 {
    let points: Vec<XY> = (0..=1500).map(|step| curve(f64::from(step) / 1500.0)).collect();
    for piece in pieces {
        for part in [0.25, 0.5, 0.75] {
            assert!(to_polygon(at(piece, part), &points) < 1.1, "{piece:?}");
        }
    }
    let to_pieces =
        |point: &XY| pieces.iter().map(|piece| to_piece(*point, piece)).fold(f64::INFINITY, f64::min);
    points.iter().map(to_pieces).fold(0.0, f64::max)
}

fn to_polygon(point: XY, polygon: &[XY]) -> f64 {
    let to_side = |side: &[XY]| {
        let [dx, dy] = [side[1][0] - side[0][0], side[1][1] - side[0][1]];
        let square = dx * dx + dy * dy;
        let part = ((point[0] - side[0][0]) * dx + (point[1] - side[0][1]) * dy) / square;
        let part = if square > 0.0 { part.clamp(0.0, 1.0) } else { 0.0 };
        distance(point, [side[0][0] + dx * part, side[0][1] + dy * part])
    };
    polygon.windows(2).map(to_side).fold(f64::INFINITY, f64::min)
}

/// Returns the pieces of the only curve, after asserting that they join, and that they do so without a bend if the curve is smooth.
fn pieces(drawing: &Drawing, is_smooth: bool) -> Vec<Geometry> {
    assert_eq!((faults(drawing), &drawing.left_out, &drawing.diagnostics), (vec![], &vec![], &vec![]));
    let pieces: Vec<Geometry> = drawing.entities.iter().map(|entity| entity.geometry.clone()).collect();
    for pair in pieces.windows(2) {
        assert!(distance(at(&pair[0], 1.0), at(&pair[1], 0.0)) < 1e-8, "{pair:?}");
        let bend = distance(direction(&pair[0], 1.0), direction(&pair[1], 0.0));
        assert!(!is_smooth || bend < 1e-3, "{bend} {pair:?}");
    }
    pieces
}

fn check(drawing: &Drawing, tolerance: f64, curve: impl Fn(f64) -> XY) -> usize {
    let pieces = pieces(drawing, true);
    assert!(distance(at(&pieces[0], 0.0), curve(0.0)) < 1e-8);
    assert!(distance(at(&pieces[pieces.len() - 1], 1.0), curve(1.0)) < 1e-8);
    let deviation = deviation(&pieces, curve);
    assert!(deviation <= tolerance, "{deviation} with {} pieces", pieces.len());
    pieces.len()
}

fn ellipse(groups: &str) -> String {
    entities(&format!("0 ELLIPSE\n8 A\n10 5\n20 6\n11 30\n21 40\n{groups}"))
}

/// Returns the point at a parameter on the ellipse that [`ellipse`] draws.
fn on_ellipse(ratio: f64, parameter: f64) -> XY {
    let (sin, cos) = libm::sincos(parameter);
    [5.0 + 30.0 * cos - 40.0 * ratio * sin, 6.0 + 40.0 * cos + 30.0 * ratio * sin]
}

#[test]
fn without_a_tolerance_curves_are_left_out() {
    for kind in ["ELLIPSE", "SPLINE"] {
        let file = entities(&format!("0 {kind}\n8 A\n10 5\n20 6\n40 x"));
        for tolerance in [0.0, -1.0, f64::NAN] {
            let drawing = approximated(&file, tolerance);
            let [left_out] = &drawing.left_out[..] else { panic!("{drawing:?}") };
            assert_eq!((left_out.kind.name(), left_out.point), (kind, Some(Point::new(5.0, 6.0))));
            assert_eq!(left_out.diagnostic.code(), Code::UnsupportedCurve);
            assert!(drawing.faults.is_empty() && drawing.entities.is_empty());
        }
    }
}

#[test]
fn an_ellipse_stays_within_the_tolerance() {
    for ratio in [0.01, 0.3, 0.9, 1.0, 2.5] {
        let mut counts = Vec::new();
        for tolerance in [1.0, 0.01, 0.001] {
            let drawing = approximated(&ellipse(&format!("40 {ratio}\n41 0\n42 {TAU}")), tolerance);
            counts.push(check(&drawing, tolerance, |part| on_ellipse(ratio, part * TAU)));
        }
        assert!(counts.is_sorted(), "{ratio} {counts:?}");
        assert!(ratio == 1.0 || counts[0] < counts[2], "{ratio} {counts:?}");
        assert!(counts[2] < 500, "{ratio} {counts:?}");
    }
}

#[test]
fn a_part_of_an_ellipse_has_its_ends() {
    for (start, end) in [(0.5, 2.0), (5.0, 1.0), (0.0, 6.0), (-1.0, 1.0), (3.0, 3.2)] {
        let drawing = approximated(&ellipse(&format!("40 0.4\n41 {start}\n42 {end}")), 0.01);
        let sweep = if end > start { end - start } else { end - start + TAU };
        check(&drawing, 0.01, |part| on_ellipse(0.4, start + part * sweep));
    }
}

/// Returns the distance between the start of the first and the end of the last piece.
fn gap(drawing: &Drawing) -> f64 {
    let ends = [(drawing.entities.first(), 0.0), (drawing.entities.last(), 1.0)];
    let [start, end] = ends.map(|(entity, part)| at(&entity.expect("there are pieces").geometry, part));
    distance(start, end)
}

#[test]
fn a_full_turn_may_be_rounded() {
    for end in
        ["6.28318530717959", "6.283185307179586", "6.2831853071", "6.283185", "0", "12.566370614359172"]
    {
        let drawing = approximated(&ellipse(&format!("40 0.4\n41 0\n42 {end}")), 0.01);
        check(&drawing, 0.01, |part| on_ellipse(0.4, part * TAU));
        assert!(gap(&drawing) < 1e-9, "{end}");
    }
    let drawing = approximated(&ellipse("40 0.4\n41 0\n42 6.283184"), 0.01);
    assert!(gap(&drawing) > 1e-6);
    let remnant = approximated(&ellipse("40 0.4\n41 1\n42 1.000000001"), 0.01);
    check(&remnant, 0.01, |part| on_ellipse(0.4, 1.0 + part * 1e-9));
}

#[test]
fn a_mirrored_ellipse_runs_the_other_way() {
    let drawing = approximated(&ellipse("40 0.4\n41 0.5\n42 2\n230 -1"), 0.01);
    check(&drawing, 0.01, |part| on_ellipse(-0.4, 0.5 + part * 1.5));
}

#[test]
fn parts_of_a_curve_are_a_group_of_its_kind() {
    let drawing = approximated(&ellipse("40 0.4"), 0.01);
    assert!(drawing.entities.iter().all(|it| (it.kind, it.group) == (EntityKind::Ellipse, Some(0))));
    assert!(drawing.entities.iter().all(|it| matches!(&it.geometry, Geometry::Arc(_))));
}

#[test]
fn broken_ellipses_are_faults() {
    for (groups, code) in [
        ("40 0", Code::InvalidDxf),
        ("40 x", Code::InvalidDxf),
        ("40 1\n210 1\n230 0", Code::OffPlane),
        ("40 1\n31 1", Code::OffPlane),
    ] {
        let drawing = approximated(&ellipse(groups), 0.01);
        assert_eq!(drawing.faults[0].diagnostic.code(), code, "{groups}");
    }
    let drawing = approximated(&entities("0 ELLIPSE\n8 A\n10 5\n20 6\n11 0\n21 0\n40 1"), 0.01);
    assert_eq!(drawing.faults.len(), 1);
}

/// A curve that reaches too far is rejected before it is approximated, which would take too many pieces.
#[test]
fn curves_out_of_bounds_are_faults() {
    let ellipse = |length: &str| entities(&format!("0 ELLIPSE\n8 A\n10 0\n20 0\n11 {length}\n21 0\n40 1"));
    let spline = |y: &str| {
        let control = |x: u32, y: &str| format!("10 {x}\n20 {y}\n");
        let points = [control(0, "0"), control(10, y), control(30, y), control(40, "0")].concat();
        let knots = "40 0\n".repeat(4) + &"40 1\n".repeat(4);
        entities(format!("0 SPLINE\n8 A\n70 8\n71 3\n{knots}{points}").trim_end())
    };
    for (drawn, is_within) in [
        (ellipse("999000"), true),
        (ellipse("1000000.001"), false),
        (ellipse("-1e308"), false),
        (spline("20"), true),
        (spline("1000000.001"), false),
        (spline("1e308"), false),
    ] {
        let drawing = approximated(&drawn, 0.01);
        assert_eq!((drawing.entities.is_empty(), drawing.faults.len()), (!is_within, (!is_within).into()));
        assert!(drawing.diagnostics.is_empty(), "{drawing:?}");
    }
}

#[test]
fn a_curve_in_a_scaled_block_is_approximated_where_it_ends_up() {
    let block = "0 BLOCK\n2 B\n0 ELLIPSE\n8 A\n10 5\n20 6\n11 30\n21 40\n40 0.4\n0 ENDBLK";
    let text = file("", "", block, "0 INSERT\n8 A\n2 B\n10 100\n20 0\n41 -20\n42 20");
    check(&approximated(&text, 0.01), 0.01, |part| {
        let [x, y] = on_ellipse(0.4, part * TAU);
        [100.0 - 20.0 * x, 20.0 * y]
    });
}

/// Returns a point of a B-spline, computed from the definition of the basis functions.
fn on_spline(degree: usize, knots: &[f64], points: &[[f64; 3]], parameter: f64) -> XY {
    fn basis(index: usize, degree: usize, knots: &[f64], at: f64) -> f64 {
        if degree == 0 {
            let last = knots[index + 1] == knots[knots.len() - 1] && at == knots[index + 1];
            return f64::from(u8::from(
                knots[index] <= at && (at < knots[index + 1] || last) && knots[index] < knots[index + 1],
            ));
        }
        let part = |from: f64, to: f64, up: f64| if to > from { up / (to - from) } else { 0.0 };
        part(knots[index], knots[index + degree], at - knots[index]) * basis(index, degree - 1, knots, at)
            + part(knots[index + 1], knots[index + degree + 1], knots[index + degree + 1] - at)
                * basis(index + 1, degree - 1, knots, at)
    }
    let mut sum = [0.0; 3];
    for (index, [x, y, weight]) in points.iter().enumerate() {
        let share = basis(index, degree, knots, parameter) * weight;
        sum = [sum[0] + x * share, sum[1] + y * share, sum[2] + share];
    }
    [sum[0] / sum[2], sum[1] / sum[2]]
}

fn spline(degree: usize, knots: &[f64], points: &[[f64; 3]], groups: &str) -> String {
    let knots: Vec<_> = knots.iter().map(|knot| format!("40 {knot}")).collect();
    let points: Vec<_> =
        points.iter().map(|[x, y, weight]| format!("41 {weight}\n10 {x}\n20 {y}\n30 0")).collect();
    entities(&format!("0 SPLINE\n8 A\n71 {degree}\n{}\n{}\n{groups}", knots.join("\n"), points.join("\n")))
}

fn check_spline(degree: usize, knots: &[f64], points: &[[f64; 3]], tolerance: f64) -> usize {
    let drawing = approximated(&spline(degree, knots, points, ""), tolerance);
    let [from, to] = [knots[degree], knots[points.len()]];
    // The last basis function of an unclamped spline is 0 at the end of the last knot, so stay slightly before it.
    check(&drawing, tolerance, |part| {
        on_spline(degree, knots, points, (from + (to - from) * part).min(to - (to - from) * 1e-12))
    })
}

const WAVE: [[f64; 3]; 6] = [
    [0.0, 0.0, 1.0],
    [10.0, 30.0, 1.0],
    [30.0, -20.0, 1.0],
    [50.0, 40.0, 1.0],
    [60.0, 0.0, 1.0],
    [90.0, 10.0, 1.0],
];

#[test]
fn a_spline_stays_within_the_tolerance() {
    let cubic = [0.0, 0.0, 0.0, 0.0, 1.0, 2.5, 3.0, 3.0, 3.0, 3.0];
    let counts = [1.0, 0.1, 0.001].map(|tolerance| check_spline(3, &cubic, &WAVE, tolerance));
    assert!(counts.is_sorted() && counts[0] < counts[2] && counts[2] < 300, "{counts:?}");
    check_spline(2, &[0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 4.0], &WAVE, 0.01);
    check_spline(5, &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0], &WAVE, 0.01);
}

/// The range of the parameter does not affect the curve.
#[test]
fn knots_may_be_of_any_size() {
    let knots = |size: f64| [0.0, 0.0, 0.0, 0.0, 1.0, 2.5, 3.0, 3.0, 3.0, 3.0].map(|knot| size * knot);
    let count = |size| check_spline(3, &knots(size), &WAVE, 0.01);
    assert_eq!([count(10.0), count(0.125)], [count(1.0); 2]);
}

#[test]
fn a_rational_spline_is_the_circle_that_it_should_be() {
    let w = std::f64::consts::FRAC_1_SQRT_2;
    let points = [[10.0, 0.0, 1.0], [10.0, 10.0, w], [0.0, 10.0, 1.0], [-10.0, 10.0, w], [-10.0, 0.0, 1.0]];
    let knots = [0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0];
    let drawing = approximated(&spline(2, &knots, &points, ""), 0.001);
    for piece in pieces(&drawing, true) {
        let Geometry::Arc(arc) = piece else { panic!("{piece:?}") };
        assert!(
            (arc.radius - 10.0).abs() < 1e-9 && distance([arc.centre.x, arc.centre.y], [0.0, 0.0]) < 1e-9,
            "{arc:?}"
        );
    }
    check_spline(2, &knots, &points, 0.001);
}

#[test]
fn closed_and_periodic_splines_close() {
    let square = [[0.0, 0.0, 1.0], [10.0, 0.0, 1.0], [10.0, 10.0, 1.0], [0.0, 10.0, 1.0]];
    let points: Vec<_> = square.iter().chain(&square[..3]).copied().collect();
    let knots: Vec<f64> = (0..11).map(f64::from).collect();
    let drawing = approximated(&spline(3, &knots, &points, "70 11"), 0.01);
    let pieces = pieces(&drawing, true);
    assert!(distance(at(&pieces[0], 0.0), at(&pieces[pieces.len() - 1], 1.0)) < 1e-8);
    check_spline(3, &knots, &points, 0.01);
}

#[test]
fn straight_splines_are_lines() {
    let points = [[0.0, 0.0, 1.0], [1.0, 2.0, 1.0], [5.0, 2.0, 1.0]];
    let drawing = approximated(&spline(1, &[0.0, 0.0, 1.0, 2.0, 2.0], &points, ""), 0.01);
    let pieces = pieces(&drawing, false);
    assert!(pieces.iter().all(|piece| matches!(piece, Geometry::Line(_))), "{pieces:?}");
    let length: f64 = pieces.iter().map(|piece| distance(at(piece, 0.0), at(piece, 1.0))).sum();
    assert!((length - 4.0 - libm::sqrt(5.0)).abs() < 1e-9);
}

#[test]
fn corners_and_cusps_stay_within_the_tolerance() {
    // A knot repeated as often as the degree gives a corner; this control polygon has a cusp.
    let corner = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 2.0];
    let points = [[0.0, 0.0], [5.0, 9.0], [9.0, 5.0], [10.0, 0.0], [12.0, 9.0], [15.0, 9.0], [20.0, 0.0]]
        .map(|[x, y]| [x, y, 1.0]);
    let cusp = [[0.0, 0.0], [10.0, 10.0], [0.0, 10.0], [10.0, 0.0]].map(|[x, y]| [x, y, 1.0]);
    let clamped = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    for (knots, points) in [(&corner[..], &points[..]), (&clamped[..], &cusp[..])] {
        let pieces = pieces(&approximated(&spline(3, knots, points, ""), 0.01), false);
        let [from, to] = [knots[3], knots[points.len()]];
        let deviation = deviation(&pieces, |part| on_spline(3, knots, points, from + (to - from) * part));
        assert!(deviation <= 0.01, "{deviation}");
        assert!(pieces.len() < 100, "{}", pieces.len());
    }
}

#[test]
fn coinciding_control_points_do_no_harm() {
    let clamped = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    let all_one = [[1.0, 1.0, 1.0]; 4];
    assert_eq!(approximated(&spline(3, &clamped, &all_one, ""), 0.01).entities, []);
    let doubled = [[0.0, 0.0], [0.0, 0.0], [10.0, 10.0], [10.0, 10.0]].map(|[x, y]| [x, y, 1.0]);
    let pieces = pieces(&approximated(&spline(3, &clamped, &doubled, ""), 0.01), false);
    assert!(distance(at(&pieces[pieces.len() - 1], 1.0), [10.0, 10.0]) < 1e-9);
    assert!(pieces.len() < 10, "{}", pieces.len());
}

/// The place of the finding is the first fit point, because waivers compare places.
#[test]
fn a_spline_of_fit_points_is_left_out_at_the_first_of_them() {
    let file = entities("0 SPLINE\n8 A\n70 8\n71 3\n74 1\n11 3\n21 4\n31 0");
    for tolerance in [0.0, 0.01] {
        let left_out = &approximated(&file, tolerance).left_out[0];
        assert_eq!(left_out.point, Some(Point::new(3.0, 4.0)));
    }
    let reason = |file: &str| approximated(file, 0.01).left_out[0].diagnostic.text(Lang::En);
    assert_eq!(reason(&file), "SPLINE is left out: it has fit points, but no control points");
    let with_control_point = file.replace(" 11\n3\n", " 10\n3\n 20\n4\n 11\n3\n");
    assert_eq!(
        reason(&with_control_point),
        "SPLINE is left out: its control points and knots do not describe a curve"
    );
}

#[test]
fn splines_that_are_no_curve_are_left_out() {
    let clamped = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    let points = [[0.0, 0.0, 1.0], [1.0, 2.0, 1.0], [3.0, 2.0, 1.0], [5.0, 0.0, 1.0]];
    let fit_points_only = entities("0 SPLINE\n8 A\n70 8\n71 3\n74 2\n11 0\n21 0\n31 0\n11 5\n21 5\n31 0");
    let zero_weight = [[0.0, 0.0, 1.0], [1.0, 2.0, 0.0], [3.0, 2.0, 1.0], [5.0, 0.0, 1.0]];
    for file in [
        fit_points_only,
        spline(3, &clamped[..7], &points, ""),
        spline(4, &clamped, &points, ""),
        spline(0, &clamped, &points, ""),
        spline(3, &[0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 1.0], &points, ""),
        spline(3, &[0.0; 8], &points, ""),
        spline(3, &clamped, &zero_weight, ""),
        spline(3, &clamped, &points, "41 1"),
    ] {
        let drawing = approximated(&file, 0.01);
        assert_eq!(
            (drawing.left_out.len(), drawing.faults.len(), drawing.entities.len()),
            (1, 0, 0),
            "{file}"
        );
    }
    assert_eq!(approximated(&spline(3, &clamped, &points, ""), 0.01).left_out, []);
}

#[test]
fn broken_splines_are_faults() {
    let clamped = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    let points = [[0.0, 0.0, 1.0], [1.0, 2.0, 1.0], [3.0, 2.0, 1.0], [5.0, 0.0, 1.0]];
    let sound = spline(3, &clamped, &points, "");
    for (from, to, code) in [
        (" 10\n3\n", " 10\n3x\n", Code::InvalidDxf),
        (" 20\n2\n", "  7\n2\n", Code::InvalidDxf),
        (" 30\n0\n", " 30\n1\n", Code::OffPlane),
        (" 71\n3\n", " 71\nx\n", Code::InvalidDxf),
    ] {
        let drawing = approximated(&sound.replacen(from, to, 1), 0.01);
        assert_eq!(drawing.faults.first().map(|it| it.diagnostic.code()), Some(code), "{to:?}");
    }
}
