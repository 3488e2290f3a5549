//! Matches parameter texts with elements. (book: language/parameter-texts)

use std::cell::Cell;

use pathbuild_diagnostic::{ElementId, Text, words};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, Envelope, RTree};

use crate::approx::{above, near};
use crate::boxes::square;
use crate::element::Shape;
use crate::geometry::{Curve, Xy};
use crate::read::entities::TextCircle;

/// An element that a text may belong to.
pub(crate) struct Candidate {
    /// The element's number in the source map.
    pub(crate) id: ElementId,
    pub(crate) shape: Shape,
    /// Number of the polyline that the element is part of. The parts of a polyline share a text.
    pub(crate) group: Option<u32>,
    pub(crate) owner: Owner,
    /// Whether an earlier text belongs to the element.
    pub(crate) is_taken: bool,
}

/// The part of a path that a candidate represents. It gets the text that is assigned to the candidate.
#[derive(Clone, Copy)]
pub(crate) enum Owner {
    Start,
    Probe(usize),
    /// An element of the path, by its index.
    Element(usize),
    /// An element that takes a text without storing it: one with errors, an ignored probe, or a proxy line.
    Faulty,
}

impl Candidate {
    /// Returns the name of the element for messages.
    pub(super) fn word(&self) -> &'static Text {
        match self.owner {
            Owner::Start => &words::PATH_START,
            Owner::Probe(_) => &words::PROBE,
            Owner::Element(_) | Owner::Faulty => self.shape.word(),
        }
    }
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
    kind: OverlapKind,
    /// The distance in mm from the centre of the text's circle to the centre of a circle, or to the arc or line.
    distance: f64,
    /// The distance in mm that a person sees between the text's centre and the candidate.
    pub(crate) visible_distance: f64,
}

/// A candidate that a person could take for the one that a text belongs to.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(crate) struct Rival {
    pub(crate) doubt: Doubt,
    /// How much farther away the rival is than the text's own candidate, in mm; negative if it is nearer.
    pub(crate) farther: f64,
    pub(crate) candidate: usize,
}

/// The reason why it is doubtful which candidate a text belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Doubt {
    /// The other candidate is nearer and has a text already.
    NearerWithText,
    /// The other candidate is just as near.
    EquallyNear,
    /// The other candidate is hardly farther away.
    HardlyFarther,
    /// The other candidate is nearer, but of a kind that comes later in the order of priority.
    NearerOfLaterKind,
    /// The other candidate is nearer and of the same kind: it is on another layer, or is a circle with a centre farther away.
    NearerOfSameKind,
    /// The other candidate is nearer, but the text does not overlap it.
    NearerBesideText,
}

/// Budget for examining candidates. It bounds the quadratic work if thousands of texts overlap thousands of elements.
pub(crate) struct SearchBudget(Cell<usize>);

impl SearchBudget {
    pub(crate) fn new(units: usize) -> Self {
        Self(Cell::new(units))
    }

    /// Whether the budget is used up, so that the last results are unreliable.
    pub(crate) fn is_exhausted(&self) -> bool {
        self.0.get() == 0
    }

    /// Uses up one unit. Returns whether any units are left.
    fn spend(&self) -> bool {
        self.0.set(self.0.get().saturating_sub(1));
        !self.is_exhausted()
    }
}

/// Returns the candidate that a text with this circle belongs to: the nearest overlapped circle, or else arc, or else line; the first of several at
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
    let nearest = nearest_overlap(circle, candidates, boxes, budget, false);
    nearest.filter(|_| !budget.is_exhausted()).map(|(kind, distance, candidate)| AssignedCandidate {
        candidate,
        kind,
        distance,
        visible_distance: visible_distance(circle, &candidates[candidate].shape),
    })
}

/// Returns the nearest candidate of the first kind that a text overlaps, among those that have a text already, or among the others.
fn nearest_overlap(
    circle: &TextCircle,
    candidates: &[Candidate],
    boxes: &CandidateIndex,
    budget: &SearchBudget,
    is_taken: bool,
) -> Option<(OverlapKind, f64, usize)> {
    let mut nearest: Option<(OverlapKind, f64, usize)> = None;
    boxes.each_touched(circle, |index| {
        let candidate = &candidates[index];
        if budget.spend()
            && candidate.is_taken == is_taken
            && let Some((kind, distance)) = overlap(circle, &candidate.shape)
            && nearest.is_none_or(|nearest| (kind, distance, index) < nearest)
        {
            nearest = Some((kind, distance, index));
        }
    });
    nearest
}

/// Returns the rival with the first reason for doubt in the order of [`Doubt`], and the nearest of these, among those for which `is_possible` holds.
/// A candidate less than `margin` mm farther away than the text's own is a rival if both are circles, or if each is an arc or a line.
pub(crate) fn find_rival(
    circle: &TextCircle,
    own: &AssignedCandidate,
    margin: f64,
    (candidates, boxes): (&[Candidate], &CandidateIndex),
    budget: &SearchBudget,
    mut is_possible: impl FnMut(&Rival) -> bool,
) -> Option<Rival> {
    let mut most_doubtful: Option<Rival> = None;
    let radius = circle.radius.max(own.visible_distance) + margin;
    boxes.each_touched(&TextCircle { radius, ..*circle }, |candidate| {
        if !budget.spend() {
            return;
        }
        let Some((doubt, farther)) = reason_for_doubt(circle, own, margin, &candidates[candidate]) else {
            return;
        };
        let rival = Rival { doubt, farther, candidate };
        if most_doubtful.is_none_or(|known| rival < known) && is_possible(&rival) {
            most_doubtful = Some(rival);
        }
    });
    most_doubtful.filter(|_| !budget.is_exhausted())
}

/// Returns why another candidate could be the one that a text belongs to, and how much farther away it is in mm.
fn reason_for_doubt(
    circle: &TextCircle,
    own: &AssignedCandidate,
    margin: f64,
    other: &Candidate,
) -> Option<(Doubt, f64)> {
    let overlapped = overlap(circle, &other.shape);
    let visible = visible_distance(circle, &other.shape) - own.visible_distance;
    let is_nearer = above(0.0, visible);
    if other.is_taken {
        return (is_nearer && overlapped.is_some()).then_some((Doubt::NearerWithText, visible));
    }
    let (kind, distance) = overlapped.unwrap_or_else(|| possible_overlap(circle, &other.shape));
    let farther = distance - own.distance;
    if kind == own.kind && overlapped.is_some() && near(farther, 0.0) {
        return Some((Doubt::EquallyNear, 0.0));
    }
    let is_alike = (kind == OverlapKind::Circle) == (own.kind == OverlapKind::Circle);
    // A shift by the margin would let the text overlap the candidate.
    let is_almost_overlapped = circle.gap_to(&other.shape) <= margin;
    if is_alike && is_almost_overlapped && (near(farther, 0.0) || (0.0..margin).contains(&farther)) {
        return Some((Doubt::HardlyFarther, farther.max(0.0)));
    }
    match overlapped {
        _ if !is_nearer => None,
        Some(_) if kind == own.kind => Some((Doubt::NearerOfSameKind, visible)),
        Some(_) => Some((Doubt::NearerOfLaterKind, visible)),
        None => Some((Doubt::NearerBesideText, visible)),
    }
}

/// Returns the nearest candidate that a text overlaps and that has a text already.
pub(crate) fn find_with_text(
    circle: &TextCircle,
    candidates: &[Candidate],
    boxes: &CandidateIndex,
    budget: &SearchBudget,
) -> Option<usize> {
    nearest_overlap(circle, candidates, boxes, budget, true).map(|(.., index)| index)
}

/// Returns the position of the shape that a text overlaps and is nearest to. `None` also if the budget is exhausted.
pub(crate) fn find_shape(
    circle: &TextCircle,
    shapes: impl Iterator<Item = Option<Shape>>,
    budget: &SearchBudget,
) -> Option<usize> {
    let shapes = shapes.enumerate().take_while(|_| budget.spend());
    let overlapped = shapes.filter_map(|(index, shape)| Some((overlap(circle, &shape?)?.1, index)));
    let nearest = overlapped.reduce(|nearest, other| if other < nearest { other } else { nearest });
    nearest.map(|(_, index)| index).filter(|_| !budget.is_exhausted())
}

/// Returns the free candidate nearest to a text that overlaps none; if several are equally near, the first. `None` if the budget is exhausted.
pub(crate) fn nearest_miss(
    circle: &TextCircle,
    candidates: &[Candidate],
    boxes: &CandidateIndex,
    budget: &SearchBudget,
) -> Option<NearMiss> {
    // The first step of a search in a tree examines many nodes, so it is not begun without a budget.
    if candidates.len() > MAX_SCANNED_CANDIDATES && budget.is_exhausted() {
        return None;
    }
    let mut nearest: Option<NearMiss> = None;
    for (number, (candidate, at_least)) in boxes.nearest(circle.centre).enumerate() {
        if nearest.as_ref().is_some_and(|nearest| nearest.distance < at_least - circle.radius) {
            break;
        }
        // The first few candidates of each text do not use up the budget.
        if number >= MAX_SCANNED_CANDIDATES && !budget.spend() {
            return None;
        }
        if candidates[candidate].is_taken {
            continue;
        }
        let distance = circle.gap_to(&candidates[candidate].shape);
        if nearest.as_ref().is_none_or(|best| (distance, candidate) < (best.distance, best.candidate)) {
            nearest = Some(NearMiss { candidate, distance });
        }
    }
    nearest
}

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

/// Whether a text is over a shape.
pub(crate) fn is_overlapped(text: &TextCircle, shape: &Shape) -> bool {
    overlap(text, shape).is_some()
}

/// Returns the kind of a shape that a text does not overlap, and the distance that would be compared if the text overlapped it.
fn possible_overlap(text: &TextCircle, shape: &Shape) -> (OverlapKind, f64) {
    match shape {
        Shape::Circle { centre, .. } => (OverlapKind::Circle, text.distance_to_centre(*centre)),
        Shape::Curve(curve @ Curve::Arc(_)) => (OverlapKind::Arc, text.distance_to_curve(curve)),
        Shape::Curve(curve @ Curve::Line(_)) => (OverlapKind::Line, text.distance_to_curve(curve)),
    }
}

/// Returns the distance in mm from the text's centre to what is drawn. The centre of a circle counts as drawn, because its text may be there.
fn visible_distance(text: &TextCircle, shape: &Shape) -> f64 {
    match shape {
        Shape::Circle { centre, radius } => {
            text.distance_to_centre(*centre).min(text.distance_to_circle(*centre, *radius))
        }
        Shape::Curve(curve) => text.distance_to_curve(curve),
    }
}

/// A spatial index of the candidates of a layer.
pub(crate) enum CandidateIndex {
    /// The bounding boxes of a few candidates: scanning all of them is faster than building a tree.
    List(Vec<AABB<[f64; 2]>>),
    Tree(RTree<GeomWithData<Rectangle<[f64; 2]>, usize>>),
}

/// Number of candidates up to which scanning all of them is faster than building a tree.
const MAX_SCANNED_CANDIDATES: usize = 128;

/// Margin in mm around each box, so that rounding does not decide which candidates a text touches.
const BOX_MARGIN: f64 = 1e-6;

impl Default for CandidateIndex {
    fn default() -> Self {
        Self::new(&[])
    }
}

impl CandidateIndex {
    pub(crate) fn new(candidates: &[Candidate]) -> Self {
        let boxes = candidates.iter().map(|candidate| candidate.shape.extent(BOX_MARGIN));
        if candidates.len() <= MAX_SCANNED_CANDIDATES {
            return Self::List(boxes.collect());
        }
        let numbered = boxes.zip(0..).map(|(box_, index)| GeomWithData::new(box_.into(), index));
        Self::Tree(RTree::bulk_load(numbered.collect()))
    }

    /// Calls `take` for each candidate with a box that touches a circle, in any order.
    fn each_touched(&self, circle: &TextCircle, mut take: impl FnMut(usize)) {
        let searched = square(circle.centre, circle.radius + BOX_MARGIN);
        match self {
            Self::List(boxes) => {
                let touched = (0..).zip(boxes).filter(|(_, box_)| box_.intersects(&searched));
                touched.for_each(|(index, _)| take(index));
            }
            Self::Tree(tree) => {
                tree.locate_in_envelope_intersecting(searched).for_each(|found| take(found.data));
            }
        }
    }

    /// Returns the candidates, each with a lower bound for its distance in mm from a point, in ascending order.
    fn nearest(&self, point: Xy) -> Box<dyn Iterator<Item = (usize, f64)> + '_> {
        let at_least = |squared: f64| libm::sqrt(squared) - BOX_MARGIN;
        match self {
            // A few candidates are not sorted: with a lower bound of minus infinity, the caller examines all of them.
            Self::List(boxes) => Box::new((0..boxes.len()).map(|index| (index, f64::NEG_INFINITY))),
            Self::Tree(tree) => {
                let found = tree.nearest_neighbor_iter_with_distance_2([point.x, point.y]);
                Box::new(found.map(move |(found, squared)| (found.data, at_least(squared))))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    //! Searching near a text gives the same results as comparing everything.

    use pathbuild_diagnostic::ElementId;
    use proptest::prelude::*;

    use crate::element::Shape;
    use crate::geometry::{Arc, Curve, Line, Xy};
    use crate::read::candidates::Owner;
    use crate::read::candidates::{
        Candidate, CandidateIndex, Rival, SearchBudget, find, find_rival, nearest_miss, overlap,
        reason_for_doubt,
    };
    use crate::read::entities::TextCircle;

    fn point() -> impl Strategy<Value = Xy> {
        // Some points are far away, and many are at round numbers, where boxes touch.
        let coordinate = || prop_oneof![-20.0..20.0, (-20..20).prop_map(f64::from), 99_990.0..100_010.0];
        (coordinate(), coordinate()).prop_map(|(x, y)| Xy::new(x, y))
    }

    fn shape() -> impl Strategy<Value = Shape> {
        prop_oneof![
            (point(), point()).prop_map(|(start, end)| Shape::Curve(Curve::Line(Line { start, end }))),
            (point(), 0.1..9.0).prop_map(|(centre, radius)| Shape::Circle { centre, radius }),
            (point(), 0.1..9.0, 0.0..360.0, 0.0..360.0).prop_map(|(centre, radius, from, to)| {
                Shape::Curve(Curve::Arc(Arc::from_angles(centre, radius, from, to, false)))
            }),
        ]
    }

    fn candidate((shape, is_taken): (Shape, bool)) -> Candidate {
        Candidate { id: ElementId(0), shape, group: None, owner: Owner::Faulty, is_taken }
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 512, failure_persistence: None, ..ProptestConfig::default() })]

        /// Searching in lists and in trees gives the same results as comparing everything.
        #[test]
        fn boxes_hide_nothing(
            shapes in prop_oneof![
                prop::collection::vec((shape(), prop::bool::weighted(0.1)), 0..60),
                prop::collection::vec((shape(), prop::bool::weighted(0.1)), 129..200),
            ],
            centre in point(),
            radius in 0.1..6.0,
        ) {
            let (circle, candidates) = (TextCircle { centre, radius }, shapes.into_iter().map(candidate).collect::<Vec<_>>());
            let boxes = CandidateIndex::new(&candidates);
            let free = || candidates.iter().enumerate().filter(|(_, candidate)| !candidate.is_taken);
            let overlapped = free().filter_map(|(index, candidate)| overlap(&circle, &candidate.shape).map(|(kind, distance)| (kind, distance, index)));
            let mut overlapped: Vec<_> = overlapped.collect();
            overlapped.sort_by(|one, other| one.partial_cmp(other).expect("distances are numbers"));
            let expected = overlapped.first().map(|(.., index)| *index);
            let budget = SearchBudget::new(1000);
            let found = find(&circle, &candidates, &boxes, &budget);
            prop_assert_eq!(found.map(|found| found.candidate), expected);
            if let Some(own) = found {
                let others = (0..).zip(&candidates).filter(|(other, _)| *other != own.candidate);
                let rivals = others.filter_map(|(candidate, other)| {
                    let (doubt, farther) = reason_for_doubt(&circle, &own, 0.1, other)?;
                    Some(Rival { doubt, farther, candidate })
                });
                let expected = rivals.reduce(|first, other| if other < first { other } else { first });
                let is_other = |rival: &Rival| rival.candidate != own.candidate;
                prop_assert_eq!(find_rival(&circle, &own, 0.1, (&candidates, &boxes), &budget, is_other), expected);
            }
            let gaps = free().map(|(index, candidate)| (circle.gap_to(&candidate.shape), index));
            let least = gaps.reduce(|best, other| if other < best { other } else { best });
            prop_assert_eq!(nearest_miss(&circle, &candidates, &boxes, &SearchBudget::new(1000)).map(|miss| (miss.distance, miss.candidate)), least);
        }
    }

    /// Returns this number of lines through one point.
    fn bundle(count: usize) -> Vec<Candidate> {
        let line = Shape::Curve(Curve::Line(Line { start: Xy::new(-1.0, 0.0), end: Xy::new(1.0, 0.0) }));
        (0..count).map(|_| candidate((line, false))).collect()
    }

    /// A result is only trusted if the budget has more units than there are candidates.
    #[test]
    fn what_is_found_when_the_looks_are_over_is_not_trusted() {
        for count in [10, 200] {
            let (circle, candidates) = (TextCircle { centre: Xy::origin(), radius: 0.5 }, bundle(count));
            let boxes = CandidateIndex::new(&candidates);
            let finds = |most: usize| {
                let budget = SearchBudget::new(most);
                (find(&circle, &candidates, &boxes, &budget).is_some(), budget.is_exhausted())
            };
            assert_eq!(
                (finds(count + 1), finds(count), finds(0)),
                ((true, false), (false, true), (false, true))
            );
        }
    }

    /// The first few of the 200 candidates do not use up the budget of a text.
    #[test]
    fn the_hint_of_the_nearest_is_given_up_when_the_looks_are_over() {
        let (circle, candidates) = (TextCircle { centre: Xy::new(0.0, 9.0), radius: 0.5 }, bundle(200));
        let boxes = CandidateIndex::new(&candidates);
        let misses =
            |most: usize| nearest_miss(&circle, &candidates, &boxes, &SearchBudget::new(most)).is_some();
        assert_eq!((misses(200 - 128 + 1), misses(200 - 128)), (true, false));
        let few = bundle(128);
        assert!(nearest_miss(&circle, &few, &CandidateIndex::new(&few), &SearchBudget::new(0)).is_some());
    }
}
