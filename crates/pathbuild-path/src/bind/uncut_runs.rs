//! Runs of connected support segments of which nothing is cut through. (book: language/support-bars)

use std::collections::BTreeMap;

use pathbuild_diagnostic::messages::paths;
use pathbuild_diagnostic::{Diagnostic, EntityKind};
use rstar::RTree;
use rstar::primitives::GeomWithData;

use crate::approx::{at_least, coincide};
use crate::disjoint_sets::{root, unite};
use crate::element::Element;
use crate::geometry::{Curve, Xy};
use crate::path::Bars;

/// A segment with support bars.
#[derive(Clone, Copy)]
pub(super) struct SupportSegment<'a> {
    pub(super) element: &'a Element,
    pub(super) curve: Curve,
    pub(super) bars: Bars,
}

/// Connected support segments, each too short for a gap.
pub(super) struct UncutRun<'a> {
    /// The first of the segments.
    pub(super) first: SupportSegment<'a>,
    length: f64,
    count: usize,
}

impl SupportSegment<'_> {
    fn has_gap(&self) -> bool {
        self.bars.count(self.curve.length()) > 0.0
    }

    /// The segment's length as a multiple of P + U.
    fn pitches(&self) -> f64 {
        self.curve.length() / (self.bars.length + self.bars.distance)
    }

    /// The kind of an entity that consists of several segments; `None` for lines and arcs.
    fn compound_kind(&self) -> Option<EntityKind> {
        let kind = self.element.source.entity;
        (!matches!(kind, EntityKind::Line | EntityKind::Arc)).then_some(kind)
    }
}

impl UncutRun<'_> {
    /// Returns PB408 about this run.
    pub(super) fn problem(&self) -> Diagnostic {
        let bars = self.first.bars;
        Diagnostic::new(&paths::NO_GAP_IN_RUN)
            .with("length", self.length)
            .with("count", self.count)
            .with("pitch", bars.length + bars.distance)
            .with("top", bars.top)
    }
}

/// Returns the connected groups of several segments that are together at least as long as P + U although none of them has a gap: among all
/// segments, and among those of polylines and of approximated curves.
pub(super) fn uncut_runs<'a>(segments: &[SupportSegment<'a>]) -> Vec<UncutRun<'a>> {
    if segments.iter().all(SupportSegment::has_gap) {
        return Vec::new();
    }
    let all = runs(segments, |_, _| true);
    let is_compound = |run: &&Vec<usize>| segments[run[0]].compound_kind().is_some();
    let compound = runs(segments, |one, other| one.compound_kind() == other.compound_kind());
    let mut found: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    let mut is_reported = vec![false; segments.len()];
    for run in all.iter().chain(compound.iter().filter(is_compound)) {
        let is_uncut = run.len() > 1 && !run.iter().any(|segment| segments[*segment].has_gap());
        let pitches: f64 = run.iter().map(|segment| segments[*segment].pitches()).sum();
        if is_uncut && at_least(pitches, 1.0) && !is_reported[run[0]] {
            run.iter().for_each(|segment| is_reported[*segment] = true);
            found.insert(run[0], run.clone());
        }
    }
    let length = |run: &[usize]| run.iter().map(|segment| segments[*segment].curve.length()).sum();
    found
        .into_values()
        .map(|run| UncutRun { first: segments[run[0]], length: length(&run), count: run.len() })
        .collect()
}

/// Search distance in mm for ends that coincide.
const SEARCH_DISTANCE: f64 = 0.0001;

/// Returns the groups of segments whose ends coincide, each in ascending order, if `may_join` permits both.
fn runs<'a>(
    segments: &[SupportSegment<'a>],
    may_join: impl Fn(&SupportSegment<'a>, &SupportSegment<'a>) -> bool,
) -> Vec<Vec<usize>> {
    let ends = |segment: &SupportSegment<'_>| [segment.curve.start(), segment.curve.end()];
    let numbered = segments
        .iter()
        .enumerate()
        .flat_map(|(number, segment)| ends(segment).map(|end| GeomWithData::new([end.x, end.y], number)));
    let tree = RTree::bulk_load(numbered.collect());
    let mut groups: Vec<usize> = (0..segments.len()).collect();
    for (number, segment) in segments.iter().enumerate() {
        for end in ends(segment) {
            let near = tree.locate_within_distance([end.x, end.y], SEARCH_DISTANCE * SEARCH_DISTANCE);
            let meets = |other: &&GeomWithData<[f64; 2], usize>| {
                coincide(Xy::from(*other.geom()), end) && may_join(segment, &segments[other.data])
            };
            for other in near.filter(meets) {
                unite(&mut groups, number, other.data);
            }
        }
    }
    let mut runs: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for number in 0..segments.len() {
        let first = root(&mut groups, number);
        runs.entry(first).or_default().push(number);
    }
    runs.into_values().collect()
}
