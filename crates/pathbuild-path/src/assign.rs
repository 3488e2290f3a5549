//! Which element a parameter text belongs to. (spec/10-drawing.md, "The element a text belongs to")

use pathbuild_diagnostic::ElementId;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{RTree, RTreeObject};

use crate::element::Shape;
use crate::geometry::{Curve, Xy};
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

/// Where the candidates of a layer lie, so that a text looks at those around it only.
#[derive(Default)]
pub(crate) struct Boxes(RTree<GeomWithData<Rectangle<[f64; 2]>, usize>>);

impl Boxes {
    pub(crate) fn new(candidates: &[Candidate]) -> Self {
        let boxes = candidates.iter().enumerate();
        let boxes = boxes.map(|(index, candidate)| GeomWithData::new(around(&candidate.shape), index));
        Self(RTree::bulk_load(boxes.collect()))
    }

    /// The candidates whose boxes a circle touches, in file order.
    fn touched(&self, circle: &TextCircle) -> Vec<usize> {
        let touched = self.0.locate_in_envelope_intersecting(square(circle.centre, circle.radius).envelope());
        let mut touched: Vec<usize> = touched.map(|found| found.data).collect();
        touched.sort_unstable();
        touched
    }
}

/// The candidate that a text with this circle belongs to: the nearest overlapped circle, else arc, else line; the first of several at
/// the same distance.
pub(crate) fn find(circle: &TextCircle, candidates: &[Candidate], boxes: &Boxes) -> Option<usize> {
    let mut touched = boxes.touched(circle);
    touched.retain(|index| !candidates[*index].is_taken);
    let nearest = |distance: fn(&TextCircle, &Shape) -> Option<f64>| {
        let overlapped =
            touched.iter().filter_map(|index| Some((*index, distance(circle, &candidates[*index].shape)?)));
        let nearest = overlapped.reduce(|best, other| if other.1 < best.1 { other } else { best });
        nearest.map(|(index, _)| index)
    };
    nearest(overlapped_circle).or_else(|| nearest(overlapped_arc)).or_else(|| nearest(overlapped_line))
}

/// The nearest free candidate to a text that overlaps none; the first of several.
pub(crate) fn nearest_miss(circle: &TextCircle, candidates: &[Candidate], boxes: &Boxes) -> Option<Miss> {
    let mut nearest: Option<Miss> = None;
    for (found, squared) in boxes.0.nearest_neighbor_iter_with_distance_2([circle.centre.x, circle.centre.y])
    {
        let least = libm::sqrt(squared) - circle.radius - SLACK;
        if nearest.as_ref().is_some_and(|nearest| nearest.distance < least) {
            break;
        }
        let candidate = found.data;
        if candidates[candidate].is_taken {
            continue;
        }
        let distance = gap(circle, &candidates[candidate].shape);
        if nearest.as_ref().is_none_or(|it| (distance, candidate) < (it.distance, it.candidate)) {
            nearest = Some(Miss { candidate, distance });
        }
    }
    nearest
}

/// Boxes are larger by this than what they hold, in mm: rounding must not decide what a text touches.
const SLACK: f64 = 1e-6;

/// A box around a shape; of an arc around its whole circle.
fn around(shape: &Shape) -> Rectangle<[f64; 2]> {
    match shape {
        Shape::Circle { centre, radius } => square(*centre, *radius),
        Shape::Curve(Curve::Arc(arc)) => square(arc.centre, arc.radius),
        Shape::Curve(Curve::Line(line)) => {
            Rectangle::from_corners([line.start.x, line.start.y], [line.end.x, line.end.y])
        }
    }
}

fn square(centre: Xy, half: f64) -> Rectangle<[f64; 2]> {
    let half = half + SLACK;
    Rectangle::from_corners([centre.x - half, centre.y - half], [centre.x + half, centre.y + half])
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
