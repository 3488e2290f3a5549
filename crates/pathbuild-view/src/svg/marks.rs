//! Numbers of order, start and end, findings.

use std::collections::BTreeSet;

use super::Shown;
use super::canvas::{Anchor, Canvas, n};
use super::frame::{Frame, PageTransform};
use super::palette::{ERROR, INK, PROBE, WARNING};
use super::room::{Room, around};
use crate::scene::{Element, Point, Scene, ScenePath, Shape};

/// Numbers keep so many px apart; of two that are nearer only the first is shown.
const APART: f64 = 17.0;

/// The radius of a number's circle in px.
const NUMBER: f64 = 7.0;

/// The numbers in which the tool comes to elements.
pub(super) fn order(canvas: &mut Canvas, path: &ScenePath, place: &PageTransform, room: &mut Room) {
    let mut numbered: Vec<(u32, &Element)> =
        path.elements.iter().filter_map(|element| Some((element.order?, element))).collect();
    numbered.sort_by_key(|(order, _)| *order);
    let mut taken = Taken::default();
    canvas.open(&format!("id=\"order\" fill=\"{INK}\""));
    for (order, element) in numbered {
        let places = places(&element.shape, place);
        let at = places[room.choose(&places.iter().map(|at| around(*at, NUMBER)).collect::<Vec<_>>())];
        if taken.take(at) {
            canvas.circle(
                at,
                NUMBER,
                &format!("fill=\"#fff\" fill-opacity=\"0.85\" stroke=\"{INK}\" stroke-width=\"0.6\""),
            );
            let size = if order > 99 { 7.0 } else { 8.5 };
            canvas.text([at[0], at[1] + size * 0.36], size, Anchor::Middle, "", &order.to_string());
        }
    }
    canvas.close();
}

/// The cells of a grid that have a number.
#[derive(Default)]
struct Taken(BTreeSet<(i64, i64)>);

impl Taken {
    /// Takes a place unless a neighbour has it.
    #[expect(clippy::cast_possible_truncation, reason = "px of a page")]
    fn take(&mut self, at: Point) -> bool {
        let (column, row) = ((at[0] / APART).floor() as i64, (at[1] / APART).floor() as i64);
        let near = (-1..=1).flat_map(|x| (-1..=1).map(move |y| (column + x, row + y)));
        let is_free = !near.into_iter().any(|cell| self.0.contains(&cell));
        if is_free {
            self.0.insert((column, row));
        }
        is_free
    }
}

/// Where a shape's number may stand: in the middle, else nearer to an end; of a circle in its centre, else beside it.
fn places(shape: &Shape, place: &PageTransform) -> Vec<Point> {
    let along =
        |point: &dyn Fn(f64) -> Point| [0.5, 0.35, 0.65, 0.2, 0.8].map(|share| place.at(point(share)));
    match shape {
        Shape::Line { from, to } => {
            along(&|share| [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]))).to_vec()
        }
        Shape::Arc(arc) => along(&|share| arc.point(share)).to_vec(),
        Shape::Circle { centre, radius } => {
            let ([x, y], out) = (place.at(*centre), radius * place.scale() + NUMBER + 2.0);
            vec![[x, y], [x, y + out], [x, y - out], [x - out, y], [x + out, y]]
        }
    }
}

/// Where the program's zero lies, where it starts and where it ends.
pub(super) fn ends(
    canvas: &mut Canvas,
    path: &ScenePath,
    place: &PageTransform,
    shown: Shown,
    room: &mut Room,
) {
    let marker = |kind| path.elements.iter().find(|element| element.path == 0 && element.kind == kind);
    let [start, end] = [crate::scene::ElementKind::Start, crate::scene::ElementKind::End].map(marker);
    for marker in [start, end].into_iter().flatten() {
        room.take(around(place.at(marker.shape.start()), 6.0));
    }
    canvas.open("id=\"ends\"");
    if let Some(start) = start {
        let at = place.at(start.shape.start());
        canvas.circle(at, 5.0, &format!("fill=\"{PROBE}\" stroke=\"#fff\" stroke-width=\"1\""));
        label(canvas, room, at, [-8.0, 16.0], shown.either("start X0 Y0", "Start X0 Y0"), PROBE);
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
        label(canvas, room, [x, y], [-8.0, -9.0], shown.either("end", "Ende"), INK);
    }
    canvas.close();
}

fn label(canvas: &mut Canvas, room: &mut Room, at: Point, offset: Point, text: &str, color: &str) {
    let halo = "stroke=\"#fff\" stroke-width=\"2.5\" paint-order=\"stroke\"";
    let at = room.beside(at, offset, 9.5, text);
    canvas.text(at, 9.5, Anchor::Start, &format!("fill=\"{color}\" {halo}"), text);
}

/// What is wrong, circled and numbered. Findings at one place share a circle.
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
