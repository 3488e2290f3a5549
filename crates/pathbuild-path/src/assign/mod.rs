//! Matches parameter texts with elements. (book: language/parameter-texts)

mod boxes;
#[cfg(test)]
mod tests;

use std::cell::Cell;

use pathbuild_diagnostic::ElementId;

use crate::approx::above;
use crate::element::Shape;
use crate::geometry::Curve;
use crate::read::Owner;
use crate::text_circle::TextCircle;

pub(crate) use boxes::CandidateIndex;

/// An element that a text may belong to.
pub(crate) struct Candidate {
    /// Its number in the source map.
    pub(crate) id: ElementId,
    /// The drawn shape.
    pub(crate) shape: Shape,
    /// Number of the polyline that it is part of. The parts of a polyline share a text.
    pub(crate) group: Option<u32>,
    /// The owner of its text.
    pub(crate) owner: Owner,
    /// Whether an earlier text belongs to it.
    pub(crate) is_taken: bool,
}

/// A candidate that a text does not reach, with the distance between them.
pub(crate) struct NearMiss {
    pub(crate) candidate: usize,
    pub(crate) distance: f64,
}

/// The kind of shape that a text overlaps, in order of priority.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum OverlapKind {
    Circle,
    Arc,
    Line,
}

/// The candidate that a text belongs to.
#[derive(Clone, Copy)]
pub(crate) struct AssignedCandidate {
    pub(crate) candidate: usize,
    /// The second best candidate of the same kind, and how much farther away it is in mm.
    pub(crate) rival: Option<(usize, f64)>,
    /// A candidate of another kind that is nearer, and by how much in mm.
    pub(crate) nearer: Option<(usize, f64)>,
}

/// Budget for examining candidates. It bounds the quadratic work if thousands of texts overlap thousands of elements.
pub(crate) struct SearchBudget(Cell<usize>);

impl SearchBudget {
    pub(crate) fn new(most: usize) -> Self {
        Self(Cell::new(most))
    }

    /// Whether the budget was exceeded, so that results since then are unreliable.
    pub(crate) fn is_exhausted(&self) -> bool {
        self.0.get() == 0
    }

    /// Uses up one unit, if that does not exhaust the budget.
    fn take(&self) -> bool {
        self.0.set(self.0.get().saturating_sub(1));
        !self.is_exhausted()
    }
}

/// The candidate that a text with this circle belongs to: the nearest overlapped circle, or else arc, or else line; the first of several at
/// the same distance. `None` if the budget is exhausted.
pub(crate) fn find(
    circle: &TextCircle,
    candidates: &[Candidate],
    boxes: &CandidateIndex,
    budget: &SearchBudget,
) -> Option<AssignedCandidate> {
    if budget.is_exhausted() {
        return None;
    }
    let mut nearest: Option<(OverlapKind, f64, usize)> = None;
    let mut second: Option<(OverlapKind, f64, usize)> = None;
    let mut closest: Option<(f64, usize)> = None;
    let is_same_group = |one: Option<(OverlapKind, f64, usize)>, other: usize| {
        let group = candidates[other].group;
        group.is_some() && one.is_some_and(|(.., one)| candidates[one].group == group)
    };
    boxes.each_touched(circle, |index| {
        let candidate = &candidates[index];
        if !budget.take() || candidate.is_taken {
            return;
        }
        let Some((kind, distance)) = overlap(circle, &candidate.shape) else { return };
        let found = (kind, distance, index);
        if closest.is_none_or(|closest| (distance, index) < closest) {
            closest = Some((distance, index));
        }
        if nearest.is_none_or(|nearest| found < nearest) {
            if !is_same_group(nearest, index) {
                second = nearest;
            }
            nearest = Some(found);
        } else if !is_same_group(nearest, index) && second.is_none_or(|second| found < second) {
            second = Some(found);
        }
    });
    nearest.filter(|_| !budget.is_exhausted()).map(|(kind, distance, candidate)| AssignedCandidate {
        candidate,
        rival: second.filter(|second| second.0 == kind).map(|(_, other, rival)| (rival, other - distance)),
        nearer: closest
            .filter(|(closest, other)| above(distance, *closest) && !is_same_group(nearest, *other))
            .map(|(closest, other)| (other, distance - closest)),
    })
}

/// The nearest candidate that a text overlaps and that has a text already.
pub(crate) fn find_taken(
    circle: &TextCircle,
    candidates: &[Candidate],
    boxes: &CandidateIndex,
    budget: &SearchBudget,
) -> Option<usize> {
    let mut nearest: Option<(OverlapKind, f64, usize)> = None;
    boxes.each_touched(circle, |index| {
        let candidate = &candidates[index];
        if budget.take()
            && candidate.is_taken
            && let Some((kind, distance)) = overlap(circle, &candidate.shape)
            && nearest.is_none_or(|nearest| (kind, distance, index) < nearest)
        {
            nearest = Some((kind, distance, index));
        }
    });
    nearest.map(|(.., index)| index)
}

/// The nearest free candidate to a text that overlaps none; the first of several. `None` if the budget is exhausted.
pub(crate) fn nearest_miss(
    circle: &TextCircle,
    candidates: &[Candidate],
    boxes: &CandidateIndex,
    budget: &SearchBudget,
) -> Option<NearMiss> {
    // A tree examines more nodes initially than it yields candidates.
    if candidates.len() > boxes::FEW && budget.is_exhausted() {
        return None;
    }
    let mut nearest: Option<NearMiss> = None;
    for (number, (candidate, at_least)) in boxes.nearest(circle.centre).enumerate() {
        if nearest.as_ref().is_some_and(|nearest| nearest.distance < at_least - circle.radius) {
            break;
        }
        // The first few candidates are free for each text.
        if number >= boxes::FEW && !budget.take() {
            return None;
        }
        if candidates[candidate].is_taken {
            continue;
        }
        let distance = gap(circle, &candidates[candidate].shape);
        if nearest.as_ref().is_none_or(|best| (distance, candidate) < (best.distance, best.candidate)) {
            nearest = Some(NearMiss { candidate, distance });
        }
    }
    nearest
}

/// The kind of overlap and the distance if a text overlaps a shape.
fn overlap(text: &TextCircle, shape: &Shape) -> Option<(OverlapKind, f64)> {
    match shape {
        Shape::Circle { centre, radius } => {
            let distance = text.distance_to_centre(*centre);
            (distance < text.radius + radius).then_some((OverlapKind::Circle, distance))
        }
        Shape::Curve(Curve::Arc(arc)) => {
            // A cheap test first, which rules out most of the nearby arcs.
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
