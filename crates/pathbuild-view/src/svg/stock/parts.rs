//! Defects of finished parts: material left beside them, cuts into them, and parts that nothing holds.

use super::{LEFTOVER_COLOUR, LOOSE_COLOUR, WRONG_COLOUR, rectangle, stroke};
use crate::scene::{FinishedPart, Point, Shape};
use crate::svg::canvas::Canvas;
use crate::svg::frame::{PageTransform, widen};
use crate::svg::symbols;

/// Draws the material left around a part, outside of its outline.
pub(super) fn draw_leftovers(canvas: &mut Canvas, part: &FinishedPart, place: &PageTransform, id: &str) {
    if part.left.is_empty() {
        return;
    }
    let reach = part.left.iter().map(|left| left.reach).fold(0.0, f64::max);
    clip_outside(canvas, part, place, reach, id);
    canvas.open(&format!("clip-path=\"url(#{id})\""));
    for stretch in &part.left {
        let data: String = stretch.outline.iter().map(|shape| symbols::shape(shape, place)).collect();
        stroke(canvas, &data, 2.0 * stretch.reach * place.scale(), LEFTOVER_COLOUR);
    }
    canvas.close();
}

/// Fills the inner corners of a part, outside of its outline. The cuts are drawn over them, so that only the areas that the cutter does not
/// reach remain.
pub(super) fn draw_corners(canvas: &mut Canvas, part: &FinishedPart, place: &PageTransform, id: &str) {
    let sharp = |ring: &Vec<Shape>| {
        let next = ring.iter().cycle().skip(1);
        let corners = ring.iter().zip(next).filter_map(|(shape, next)| {
            let reach = part.radius * corner_reach(shape.directions()[1], next.directions()[0])?;
            part.corners.iter().any(|stretch| touches(stretch, next.start())).then_some((next.start(), reach))
        });
        corners.collect::<Vec<_>>()
    };
    let sharp: Vec<(Point, f64)> = part.rings.iter().flat_map(sharp).collect();
    let reach = sharp.iter().map(|(_, reach)| *reach).fold(0.0, f64::max);
    clip_outside(canvas, part, place, reach, id);
    canvas.open(&format!("clip-path=\"url(#{id})\" fill=\"{LEFTOVER_COLOUR}\""));
    for (corner, reach) in sharp {
        canvas.circle(place.to_page(corner), reach * place.scale(), "");
    }
    canvas.close();
}

/// Distance in mm up to which a stretch of an outline touches a corner.
const CORNER_DISTANCE: f64 = 0.001;

/// Whether a stretch of an outline begins or ends at a corner.
fn touches(stretch: &Shape, [x, y]: Point) -> bool {
    let ends = [stretch.start(), stretch.end()];
    ends.into_iter().any(|end| libm::hypot(end[0] - x, end[1] - y) <= CORNER_DISTANCE)
}

/// Returns the distance from a corner at which a round cutter on the right of the outline touches both sides, in radii of the cutter. The
/// arguments are the directions before and after the corner. Returns `None` if the outline does not turn to the right.
fn corner_reach([x, y]: Point, [next_x, next_y]: Point) -> Option<f64> {
    let (across, along) = (x * next_y - y * next_x, x * next_x + y * next_y);
    let norm = libm::hypot(x, y) * libm::hypot(next_x, next_y);
    (across < -SMOOTH_SINE * norm)
        .then(|| (-across / (norm + along).max(SMOOTH_SINE * norm)).min(MAX_CORNER_REACH))
}

/// Sine of the largest turn at which an outline is still considered smooth.
const SMOOTH_SINE: f64 = 0.01;

/// Maximum extent of a corner, in radii of the cutter.
const MAX_CORNER_REACH: f64 = 10.0;

/// Draws the defects of a part: cuts into it, support bars that are cut away, and a colour if nothing holds the part.
pub(super) fn draw_defects(canvas: &mut Canvas, part: &FinishedPart, place: &PageTransform, id: &str) {
    let material = || -> String {
        // Rings within an opening are left out, because an opening is not filled.
        let rings =
            part.rings.iter().enumerate().zip(&part.nests).filter(|((index, _), nest)| index == *nest);
        rings.map(|((_, ring), _)| symbols::outline(ring, place)).collect()
    };
    if part.is_loose {
        canvas.path(&material(), &format!("fill=\"{LOOSE_COLOUR}\" fill-opacity=\"0.45\""));
    }
    let width = 2.0 * part.radius * place.scale();
    let data = |shapes: &[Shape]| shapes.iter().map(|shape| symbols::shape(shape, place)).collect::<String>();
    if !part.gouges.is_empty() {
        canvas.raw(&format!("<clipPath id=\"{id}\"><path d=\"{}\"/></clipPath>", material()));
        canvas.open(&format!("clip-path=\"url(#{id})\""));
        stroke(canvas, &data(&part.gouges), width, WRONG_COLOUR);
        canvas.close();
    }
    if !part.lost_bars.is_empty() {
        canvas.open("stroke-linecap=\"butt\"");
        stroke(canvas, &data(&part.lost_bars), width, WRONG_COLOUR);
        canvas.close();
    }
}

/// Defines a clip path for the outside of a part: a frame around the rings of the part. The rings run with their material on the left.
fn clip_outside(canvas: &mut Canvas, part: &FinishedPart, place: &PageTransform, reach: f64, id: &str) {
    let mut corners = None;
    for shape in part.rings.iter().flatten() {
        widen(&mut corners, shape.extent());
    }
    let [low, high] = corners.unwrap_or_default();
    let frame = rectangle(place, [low.map(|at| at - reach), high.map(|at| at + reach)]);
    let rings: String = part.rings.iter().map(|ring| symbols::outline(ring, place)).collect();
    canvas.raw(&format!("<clipPath id=\"{id}\"><path d=\"{frame}{rings}\"/></clipPath>"));
}

#[cfg(test)]
mod tests {
    use super::{MAX_CORNER_REACH, corner_reach};

    /// A round cutter touches the sides of a right angle at one radius from the corner, whatever the directions of the sides.
    #[test]
    fn the_reach_of_a_corner_does_not_depend_on_directions() {
        for turned in 0..12 {
            let along = |degrees: f64| {
                let (sin, cos) = libm::sincos((f64::from(turned) * 30.0 + degrees).to_radians());
                [cos, sin]
            };
            let reach = |degrees: f64| corner_reach(along(0.0), along(-degrees));
            assert!(reach(90.0).is_some_and(|reach| (reach - 1.0).abs() < 1e-9), "{turned}");
            assert!(
                reach(60.0).is_some_and(|reach| (reach - libm::sqrt(1.0 / 3.0)).abs() < 1e-9),
                "{turned}"
            );
            assert_eq!(reach(170.0), Some(MAX_CORNER_REACH));
            assert_eq!([reach(0.5), reach(-90.0)], [None; 2], "smooth, or to the other side");
        }
    }
}
