//! Markers: cutting order, start and end, findings.

use super::VisibleParts;
use super::canvas::{Anchor, Canvas, n};
use super::frame::{Frame, PageTransform};
use super::palette::{ERROR, INK, PROBE, WARNING};
use super::room::{Rectangle, Room, around};
use crate::scene::{Element, ElementKind, Point, Scene, ScenePath, Shape};

/// The radius in px of the circle around a number.
const NUMBER: f64 = 7.0;

/// Reserves the space of symbols with fixed positions.
pub(super) fn reserve(path: &ScenePath, place: &PageTransform, room: &mut Room) {
    for marker in markers(path).into_iter().flatten() {
        room.take(around(place.at(marker.shape.start()), 5.0));
    }
    for probe in &path.probes {
        room.take(around(place.at(probe.at), probe_radius(place)));
    }
}

/// The start and end marker of a path.
fn markers(path: &ScenePath) -> [Option<&Element>; 2] {
    let marker = |kind| path.elements.iter().find(|element| element.path == 0 && element.kind == kind);
    [marker(ElementKind::Start), marker(ElementKind::End)]
}

/// The radius of a probe's symbol in px.
pub(super) fn probe_radius(place: &PageTransform) -> f64 {
    (3.0 * place.scale()).clamp(5.0, 16.0)
}

/// Draws the cutting order of the elements, as far as there is room.
pub(super) fn order(canvas: &mut Canvas, path: &ScenePath, place: &PageTransform, room: &mut Room) {
    let mut numbered: Vec<(u32, &Element)> =
        path.elements.iter().filter_map(|element| Some((element.order?, element))).collect();
    numbered.sort_by_key(|(order, _)| *order);
    let kerf = path.tool.unwrap_or(0.0) / 2.0 * place.scale();
    canvas.open(&format!("id=\"order\" fill=\"{INK}\""));
    for (order, element) in numbered {
        let places = places(&element.shape, place, kerf);
        let taken: Vec<Rectangle> = places.iter().map(|at| around(*at, NUMBER + 1.0)).collect();
        let Some(at) = room.find(&taken).map(|found| places[found]) else { continue };
        canvas.circle(
            at,
            NUMBER,
            &format!("fill=\"#fff\" fill-opacity=\"0.85\" stroke=\"{INK}\" stroke-width=\"0.6\""),
        );
        let size = if order > 99 { 7.0 } else { 8.5 };
        canvas.text([at[0], at[1] + size * 0.36], size, Anchor::Middle, "", &order.to_string());
    }
    canvas.close();
}

/// Possible positions for the number of a shape: at the middle, or nearer to an end. For a circle, the centre if the circle is visible
/// around the number, otherwise beside it. The cutter removes `kerf` px on either side.
fn places(shape: &Shape, place: &PageTransform, kerf: f64) -> Vec<Point> {
    let along =
        |point: &dyn Fn(f64) -> Point| [0.5, 0.35, 0.65, 0.2, 0.8].map(|share| place.at(point(share)));
    match shape {
        Shape::Line { from, to } => {
            along(&|share| [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]))).to_vec()
        }
        Shape::Arc(arc) => along(&|share| arc.point(share)).to_vec(),
        Shape::Circle { centre, radius } => {
            let ([x, y], radius) = (place.at(*centre), radius * place.scale());
            let out = radius.max(kerf) + NUMBER + 3.0;
            // A drilled hole is a disc; a number inside would make it look like a ring.
            let is_seen = radius > NUMBER + 4.0 && radius > kerf * 1.05;
            let centre = is_seen.then_some([x, y]);
            centre.into_iter().chain([[x + out, y], [x, y + out], [x, y - out], [x - out, y]]).collect()
        }
    }
}

/// Draws the program's zero point, start and end.
pub(super) fn ends(
    canvas: &mut Canvas,
    path: &ScenePath,
    place: &PageTransform,
    shown: VisibleParts,
    room: &mut Room,
) {
    let [start, end] = markers(path);
    canvas.open("id=\"ends\"");
    if let Some(start) = start {
        let at = place.at(start.shape.start());
        canvas.circle(at, 5.0, &format!("fill=\"{PROBE}\" stroke=\"#fff\" stroke-width=\"1\""));
        label(canvas, room, at, [-8.0, 17.0], shown.either("start X0 Y0", "Start X0 Y0"), PROBE);
    } else if path.elements.is_empty() && !path.moves.is_empty() {
        let at = place.at([0.0, 0.0]);
        canvas.line([at[0] - 7.0, at[1]], [at[0] + 7.0, at[1]], &format!("stroke=\"{PROBE}\""));
        canvas.line([at[0], at[1] - 7.0], [at[0], at[1] + 7.0], &format!("stroke=\"{PROBE}\""));
        label(canvas, room, at, [4.0, 13.0], "X0 Y0", PROBE);
    }
    if let Some(end) = end {
        let [x, y] = place.at(end.shape.start());
        canvas.raw(&format!(
            "<rect x=\"{}\" y=\"{}\" width=\"9\" height=\"9\" fill=\"{INK}\" stroke=\"#fff\"/>",
            n(x - 4.5),
            n(y - 4.5)
        ));
        label(canvas, room, [x, y], [-8.0, -11.0], shown.either("end", "Ende"), INK);
    }
    canvas.close();
}

fn label(canvas: &mut Canvas, room: &mut Room, at: Point, offset: Point, text: &str, color: &str) {
    let halo = "stroke=\"#fff\" stroke-width=\"2.5\" paint-order=\"stroke\"";
    let at = room.beside(at, offset, 9.5, text);
    canvas.text(at, 9.5, Anchor::Start, &format!("fill=\"{color}\" {halo}"), text);
}

/// Circles and numbers findings. Findings at the same place share a circle.
pub(super) fn findings(canvas: &mut Canvas, scene: &Scene, frame: &Frame, room: &mut Room) {
    let place = frame.of_drawing();
    let mut circles: Vec<(Point, Vec<usize>, bool)> = Vec::new();
    for finding in &scene.findings {
        let Some(at) = finding.at else { continue };
        let at = place.at(at);
        let is_same = |known: &&mut (Point, Vec<usize>, bool)| {
            libm::hypot(known.0[0] - at[0], known.0[1] - at[1]) < 6.0
        };
        match circles.iter_mut().find(is_same) {
            Some((_, numbers, is_error)) => {
                numbers.push(finding.number);
                *is_error |= finding.is_error;
            }
            None => circles.push((at, vec![finding.number], finding.is_error)),
        }
    }
    canvas.open("id=\"findings\"");
    for (at, numbers, is_error) in circles {
        let color = if is_error { ERROR } else { WARNING };
        canvas.circle(at, 13.0, &format!("fill=\"none\" stroke=\"{color}\" stroke-width=\"2.4\""));
        let numbers = numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        let halo = "stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\" font-weight=\"bold\"";
        let style = format!("fill=\"{color}\" {halo}");
        let at = room.beside(at, [12.0, -11.0], 13.0, &numbers);
        canvas.text(at, 13.0, Anchor::Start, &style, &numbers);
    }
    canvas.close();
}
