//! Dimensions of the removed material: its size, and the distance of its edges from X0 Y0.

use super::facts::Corners;
use super::flow::breadth;
use crate::scene::Point;
use crate::svg::canvas::{Anchor, Canvas, n};
use crate::svg::frame::PageTransform;
use crate::svg::legend::mm;
use crate::svg::palette::INK;

/// Letter size of the numbers, and the minimum distance between two of them.
const SIZE: f64 = 9.5;
const APART: f64 = 11.0;

/// Distance from the picture to the dimension lines.
const AWAY: f64 = 22.0;

/// Draws the dimensions of a rectangle, to the left of and below a corner of the page.
pub(super) fn draw(canvas: &mut Canvas, [low, high]: Corners, place: &PageTransform, [left, bottom]: Point) {
    let ([x0, y1], [x1, y0]) = (place.at(low), place.at(high));
    canvas.open(&format!("id=\"measures\" fill=\"none\" stroke=\"{INK}\" stroke-width=\"0.7\""));
    canvas.raw(&format!(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" stroke-dasharray=\"5 3\"/>",
        n(x0),
        n(y0),
        n(x1 - x0),
        n(y1 - y0)
    ));
    let y = bottom + AWAY;
    arrows(canvas, [x0, y], [x1, y]);
    extension(canvas, [x0, y1], [x0, y + 4.0]);
    extension(canvas, [x1, y1], [x1, y + 4.0]);
    let x = left - AWAY;
    arrows(canvas, [x, y1], [x, y0]);
    extension(canvas, [x0, y1], [x - 4.0, y1]);
    extension(canvas, [x0, y0], [x - 4.0, y0]);
    canvas.close();
    let number = |axis: usize, value: f64| format!("{}{}", ["X", "Y"][axis], mm(value));
    canvas.open(&format!("id=\"numbers\" fill=\"{INK}\""));
    let size = mm(high[0] - low[0]);
    let has_room = breadth(&size, SIZE) < x1 - x0 - 12.0;
    let down = if has_room { 12.0 } else { 23.0 };
    text(canvas, [f64::midpoint(x0, x1), y + down], Side::Middle, &size);
    text(canvas, [x0 - 3.0, y + 12.0], Side::End, &number(0, low[0]));
    text(canvas, [x1 + 3.0, y + 12.0], Side::Start, &number(0, high[0]));
    let middle = f64::midpoint(y0, y1);
    let third = SIZE / 3.0;
    text(canvas, [x - 4.0, middle + third], Side::End, &mm(high[1] - low[1]));
    text(canvas, [x - 6.0, y0.min(middle - APART) + third], Side::End, &number(1, high[1]));
    text(canvas, [x - 6.0, y1.max(middle + APART) + third], Side::End, &number(1, low[1]));
    canvas.close();
}

#[derive(Clone, Copy)]
enum Side {
    Start,
    Middle,
    End,
}

fn text(canvas: &mut Canvas, at: Point, side: Side, text: &str) {
    let (anchor, style) = match side {
        Side::Start => (Anchor::Start, ""),
        Side::Middle => (Anchor::Middle, ""),
        Side::End => (Anchor::Start, "text-anchor=\"end\""),
    };
    canvas.text(at, SIZE, anchor, style, text);
}

/// A line with arrows at both ends.
fn arrows(canvas: &mut Canvas, from: Point, to: Point) {
    canvas.line(from, to, "");
    let length = libm::hypot(to[0] - from[0], to[1] - from[1]);
    if length < 12.0 {
        return;
    }
    let [dx, dy] = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
    for (tip, sign) in [(from, 1.0), (to, -1.0)] {
        let foot = [tip[0] + sign * dx * 5.0, tip[1] + sign * dy * 5.0];
        let points =
            [tip, [foot[0] - dy * 1.8, foot[1] + dx * 1.8], [foot[0] + dy * 1.8, foot[1] - dx * 1.8]];
        let [tip, left, right] = points.map(|[x, y]| format!("{} {}", n(x), n(y)));
        canvas.path(&format!("M{tip}L{left}L{right}Z"), &format!("fill=\"{INK}\""));
    }
}

fn extension(canvas: &mut Canvas, from: Point, to: Point) {
    canvas.line(from, to, "stroke-width=\"0.4\"");
}
