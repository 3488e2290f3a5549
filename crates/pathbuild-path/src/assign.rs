//! Which element a parameter text belongs to. (spec/10-drawing.md, "The element a text belongs to")

use pathbuild_diagnostic::ElementId;

use crate::element::Shape;
use crate::geometry::Curve;
use crate::text_circle::TextCircle;

/// Something that a text can belong to.
pub(crate) struct Candidate {
    /// Where to find it in the file.
    pub(crate) id: ElementId,
    /// What is drawn.
    pub(crate) shape: Shape,
    /// Parts of the same polyline take a text together.
    pub(crate) group: Option<u32>,
    /// An earlier text has it.
    pub(crate) is_taken: bool,
}

/// A candidate that a text misses, and by how much.
pub(crate) struct Miss {
    pub(crate) candidate: usize,
    pub(crate) distance: f64,
}

/// The candidate that a text with this circle belongs to: the nearest overlapped circle, else arc, else line; the first of several at
/// the same distance.
pub(crate) fn find(circle: &TextCircle, candidates: &[Candidate]) -> Option<usize> {
    let nearest = |distance: &dyn Fn(&Shape) -> Option<f64>| {
        let mut best: Option<(usize, f64)> = None;
        for (index, candidate) in candidates.iter().enumerate().filter(|(_, candidate)| !candidate.is_taken) {
            if let Some(distance) = distance(&candidate.shape)
                && best.is_none_or(|(_, least)| distance < least)
            {
                best = Some((index, distance));
            }
        }
        best.map(|(index, _)| index)
    };
    nearest(&|shape| overlapped_circle(circle, shape))
        .or_else(|| nearest(&|shape| overlapped_arc(circle, shape)))
        .or_else(|| nearest(&|shape| overlapped_line(circle, shape)))
}

/// The nearest free candidate to a text that overlaps none.
pub(crate) fn nearest_miss(circle: &TextCircle, candidates: &[Candidate]) -> Option<Miss> {
    let free = candidates.iter().enumerate().filter(|(_, candidate)| !candidate.is_taken);
    let misses =
        free.map(|(index, candidate)| Miss { candidate: index, distance: gap(circle, &candidate.shape) });
    misses.reduce(|best, miss| if miss.distance < best.distance { miss } else { best })
}

fn overlapped_circle(text: &TextCircle, shape: &Shape) -> Option<f64> {
    let Shape::Circle { centre, radius } = shape else { return None };
    let distance = text.distance_to_centre(*centre);
    (distance < text.radius + radius).then_some(distance)
}

fn overlapped_arc(text: &TextCircle, shape: &Shape) -> Option<f64> {
    let Shape::Curve(Curve::Arc(arc)) = shape else { return None };
    text.distance_to_arc(arc).filter(|distance| *distance <= text.radius)
}

fn overlapped_line(text: &TextCircle, shape: &Shape) -> Option<f64> {
    let Shape::Curve(Curve::Line(line)) = shape else { return None };
    text.distance_to_line(line).filter(|distance| *distance < text.radius)
}

fn gap(text: &TextCircle, shape: &Shape) -> f64 {
    match shape {
        Shape::Curve(curve) => text.gap_to(curve),
        Shape::Circle { centre, radius } => {
            (text.distance_to_centre(*centre) - text.radius - radius).max(0.0)
        }
    }
}
