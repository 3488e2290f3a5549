//! Defects of finished parts: material left beside them, cuts into them, and parts that nothing holds.

use super::{LEFTOVER_COLOUR, LOOSE_COLOUR, WRONG_COLOUR, rectangle, stroke};
use crate::extent::{bounding_box, with_margin};
use crate::scene::{FinishedPart, Shape};
use crate::svg::canvas::Canvas;
use crate::svg::frame::PageTransform;
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
        let data: String =
            stretch.outline.iter().map(|shape| symbols::shape_path_data(shape, place)).collect();
        stroke(canvas, &data, 2.0 * stretch.reach * place.scale(), LEFTOVER_COLOUR);
    }
    canvas.close();
}

/// Fills the inner corners of a part, outside of its outline. The cuts are drawn over them, so that only the areas that the cutter does not
/// reach remain.
pub(super) fn draw_corners(canvas: &mut Canvas, part: &FinishedPart, place: &PageTransform, id: &str) {
    let reach = part.corners.iter().map(|corner| corner.reach).fold(0.0, f64::max);
    clip_outside(canvas, part, place, reach, id);
    canvas.open(&format!("clip-path=\"url(#{id})\" fill=\"{LEFTOVER_COLOUR}\""));
    for corner in &part.corners {
        canvas.circle(place.to_page(corner.at), corner.reach * place.scale(), "");
    }
    canvas.close();
}

/// Draws the defects of a part: cuts into it, support bars that are cut away, and a colour if nothing holds the part.
pub(super) fn draw_defects(canvas: &mut Canvas, part: &FinishedPart, place: &PageTransform, id: &str) {
    let material = || -> String {
        // Rings within an opening are left out, because an opening is not filled.
        let rings =
            part.rings.iter().enumerate().zip(&part.nests).filter(|((index, _), nest)| index == *nest);
        rings.map(|((_, ring), _)| symbols::outline_path_data(ring, place)).collect()
    };
    if part.is_loose {
        canvas.path(&material(), &format!("fill=\"{LOOSE_COLOUR}\" fill-opacity=\"0.45\""));
    }
    let width = 2.0 * part.radius * place.scale();
    let data = |shapes: &[Shape]| {
        shapes.iter().map(|shape| symbols::shape_path_data(shape, place)).collect::<String>()
    };
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
    let corners = bounding_box(part.rings.iter().flatten().map(Shape::extent)).unwrap_or_default();
    let frame = rectangle(place, with_margin(corners, reach));
    let rings: String = part.rings.iter().map(|ring| symbols::outline_path_data(ring, place)).collect();
    canvas.raw(&format!("<clipPath id=\"{id}\"><path d=\"{frame}{rings}\"/></clipPath>"));
}
