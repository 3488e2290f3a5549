//! Which element a parameter text belongs to. (book: language/parameter-texts)

mod boxes;
#[cfg(test)]
mod tests;

use pathbuild_diagnostic::ElementId;

use crate::element::Shape;
use crate::geometry::Curve;
use crate::read::Owner;
use crate::text_circle::TextCircle;

pub(crate) use boxes::Boxes;

/// Something that a text can belong to.
pub(crate) struct Candidate {
    /// Where to find it in the file.
    pub(crate) id: ElementId,
    /// What is drawn.
    pub(crate) shape: Shape,
    /// Parts of the same polyline take a text together.
    pub(crate) group: Option<u32>,
    /// Where its text is put.
    pub(crate) owner: Owner,
    /// An earlier text has it.
    pub(crate) is_taken: bool,
}

/// A candidate that a text misses, and by how much.
pub(crate) struct Miss {
    pub(crate) candidate: usize,
    pub(crate) distance: f64,
}

/// What is overlapped, in the order in which it is preferred.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum OverlapKind {
    Circle,
    Arc,
    Line,
}

/// A candidate that a text belongs to.
#[derive(Clone, Copy)]
pub(crate) struct Found {
    pub(crate) candidate: usize,
    /// The next one of the same kind, and how much farther away it is in mm.
    pub(crate) rival: Option<(usize, f64)>,
}

/// The candidate that a text with this circle belongs to: the nearest overlapped circle, else arc, else line; the first of several at
/// the same distance.
pub(crate) fn find(circle: &TextCircle, candidates: &[Candidate], boxes: &Boxes) -> Option<Found> {
    let mut nearest: Option<(OverlapKind, f64, usize)> = None;
    let mut second: Option<(OverlapKind, f64, usize)> = None;
    let is_same_group = |one: Option<(OverlapKind, f64, usize)>, other: usize| {
        let group = candidates[other].group;
        group.is_some() && one.is_some_and(|(.., one)| candidates[one].group == group)
    };
    boxes.each_touched(circle, |index| {
        let candidate = &candidates[index];
        if candidate.is_taken {
            return;
        }
        let Some((kind, distance)) = overlap(circle, &candidate.shape) else { return };
        let found = (kind, distance, index);
        if nearest.is_none_or(|nearest| found < nearest) {
            if !is_same_group(nearest, index) {
                second = nearest;
            }
            nearest = Some(found);
        } else if !is_same_group(nearest, index) && second.is_none_or(|second| found < second) {
            second = Some(found);
        }
    });
    nearest.map(|(kind, distance, candidate)| Found {
        candidate,
        rival: second.filter(|second| second.0 == kind).map(|(_, other, rival)| (rival, other - distance)),
    })
}

/// The nearest free candidate to a text that overlaps none; the first of several.
pub(crate) fn nearest_miss(circle: &TextCircle, candidates: &[Candidate], boxes: &Boxes) -> Option<Miss> {
    let mut nearest: Option<Miss> = None;
    for (candidate, at_least) in boxes.nearest(circle.centre) {
        if nearest.as_ref().is_some_and(|nearest| nearest.distance < at_least - circle.radius) {
            break;
        }
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

/// How far a text is from a shape that it overlaps.
fn overlap(text: &TextCircle, shape: &Shape) -> Option<(OverlapKind, f64)> {
    match shape {
        Shape::Circle { centre, radius } => {
            let distance = text.distance_to_centre(*centre);
            (distance < text.radius + radius).then_some((OverlapKind::Circle, distance))
        }
        Shape::Curve(Curve::Arc(arc)) => {
            // Looked at first: it is soon said, and true of few of the arcs around.
            if text.distance_to_circle(arc.centre, arc.radius) > text.radius {
                return None;
            }
            text.distance_to_arc(arc).map(|distance| (OverlapKind::Arc, distance))
        }
        Shape::Curve(Curve::Line(line)) => {
            let distance = text.distance_to_line(line)?;
            (distance < text.radius).then_some((OverlapKind::Line, distance))
        }
    }
}

fn gap(text: &TextCircle, shape: &Shape) -> f64 {
    match shape {
        Shape::Curve(curve) => text.gap_to(curve),
        Shape::Circle { centre, radius } => {
            (text.distance_to_centre(*centre) - text.radius - radius).max(0.0)
        }
    }
}
