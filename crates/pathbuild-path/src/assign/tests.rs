//! Searching near a text gives the same results as comparing everything.

use pathbuild_diagnostic::ElementId;
use proptest::prelude::*;

use super::{Candidate, CandidateIndex, SearchBudget, find, gap, nearest_miss, overlap};
use crate::element::Shape;
use crate::geometry::{Arc, Curve, Line, Xy};
use crate::read::Owner;
use crate::text_circle::TextCircle;

fn point() -> impl Strategy<Value = Xy> {
    // Some points are far away, where an f32 cannot represent thousandths, and many are at round numbers, where boxes touch.
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

    /// For lists and for trees.
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
        let expected = overlapped.first().map(|(kind, distance, index)| {
            let rival = overlapped.get(1).filter(|rival| rival.0 == *kind);
            (*index, rival.map(|(_, other, index)| (*index, other - distance)))
        });
        let found = find(&circle, &candidates, &boxes, &SearchBudget::new(1000)).map(|found| (found.candidate, found.rival));
        prop_assert_eq!(found, expected);
        let gaps = free().map(|(index, candidate)| (gap(&circle, &candidate.shape), index));
        let least = gaps.reduce(|best, other| if other < best { other } else { best });
        prop_assert_eq!(nearest_miss(&circle, &candidates, &boxes, &SearchBudget::new(1000)).map(|miss| (miss.distance, miss.candidate)), least);
    }
}

/// A number of lines through one point.
fn bundle(count: usize) -> Vec<Candidate> {
    let line = Shape::Curve(Curve::Line(Line { start: Xy::new(-1.0, 0.0), end: Xy::new(1.0, 0.0) }));
    (0..count).map(|_| candidate((line, false))).collect()
}

/// One unit for each candidate, with one left over.
#[test]
fn what_is_found_when_the_looks_are_over_is_not_trusted() {
    for count in [10, 200] {
        let (circle, candidates) = (TextCircle { centre: Xy::origin(), radius: 0.5 }, bundle(count));
        let boxes = CandidateIndex::new(&candidates);
        let finds = |most: usize| {
            let budget = SearchBudget::new(most);
            (find(&circle, &candidates, &boxes, &budget).is_some(), budget.is_exhausted())
        };
        assert_eq!((finds(count + 1), finds(count), finds(0)), ((true, false), (false, true), (false, true)));
    }
}

/// The first few of 200 candidates are free for each text.
#[test]
fn the_hint_of_the_nearest_is_given_up_when_the_looks_are_over() {
    let (circle, candidates) = (TextCircle { centre: Xy::new(0.0, 9.0), radius: 0.5 }, bundle(200));
    let boxes = CandidateIndex::new(&candidates);
    let misses = |most: usize| nearest_miss(&circle, &candidates, &boxes, &SearchBudget::new(most)).is_some();
    assert_eq!((misses(200 - 128 + 1), misses(200 - 128)), (true, false));
    let few = bundle(128);
    assert!(nearest_miss(&circle, &few, &CandidateIndex::new(&few), &SearchBudget::new(0)).is_some());
}
