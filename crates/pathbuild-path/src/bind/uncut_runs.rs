//! Runs of connected support segments that are nowhere cut through. (book: language/support-bars)

use std::collections::{BTreeMap, BTreeSet};

use pathbuild_diagnostic::messages::paths;
use pathbuild_diagnostic::{Diagnostic, EntityKind};

use crate::approx::{above, at_least, grid_square};
use crate::disjoint_sets::{root, unite};
use crate::element::Element;
use crate::geometry::Curve;
use crate::path::Bars;

#[derive(Clone, Copy)]
pub(super) struct SupportSegment<'a> {
    pub(super) element: &'a Element,
    pub(super) curve: Curve,
    /// Z of the gaps between the bars.
    pub(super) bottom: f64,
    pub(super) bars: Bars,
}

/// Lowest Z of the cuts without bars that end at a place, by the place's [`grid_square`].
pub(super) type CutDepths = BTreeMap<[i64; 2], f64>;

/// Connected support segments, each too short for a gap.
pub(super) struct UncutRun<'a> {
    pub(super) first: SupportSegment<'a>,
    length: f64,
    count: usize,
}

impl SupportSegment<'_> {
    fn has_gap(&self) -> bool {
        self.bars.count(self.curve.length()) > 0.0
    }

    /// Returns PB408 for a path of which no segment has a gap.
    pub(super) fn problem(&self) -> Diagnostic {
        missing_gap(&self.bars, self.curve.length())
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

/// Returns PB408 for a segment or circle of this length without a gap.
pub(super) fn missing_gap(bars: &Bars, length: f64) -> Diagnostic {
    Diagnostic::new(&paths::NO_GAP_BETWEEN_BARS)
        .with("length", length)
        .with("pitch", bars.length + bars.distance)
        .with("top", bars.top)
}

/// Drops segments that lie on others, which are errors themselves and make no run longer, unless all have gaps.
pub(super) fn drop_copies(segments: &mut Vec<SupportSegment<'_>>) {
    if !segments.iter().all(SupportSegment::has_gap) {
        let mut known = BTreeSet::new();
        segments.retain(|segment| known.insert(segment.curve.place_key()));
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

/// Length of a run beside segments with gaps from which the run is reported, as a multiple of P + U: two bars would have room, so it is no rounded
/// corner.
const MIN_PITCHES_BESIDE_GAPS: f64 = 2.0;

/// Returns the runs of two or more connected segments that are together at least as long as P + U although none of them has a gap. Runs are sought
/// among all segments, within polylines and approximated curves and, if long enough, among the segments without a gap.
pub(super) fn uncut_runs<'a>(segments: &[SupportSegment<'a>]) -> Vec<UncutRun<'a>> {
    if segments.iter().all(SupportSegment::has_gap) {
        return Vec::new();
    }
    let is_compound = |run: &Vec<usize>| segments[run[0]].compound_kind().is_some();
    let all = runs(segments, |_| ()).into_iter().map(|run| (run, 1.0));
    let compound = runs(segments, SupportSegment::compound_kind).into_iter().filter(is_compound);
    let beside_gaps = runs(segments, SupportSegment::has_gap).into_iter();
    let beside_gaps = beside_gaps.map(|run| (run, MIN_PITCHES_BESIDE_GAPS));
    let mut found: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    let mut is_reported = vec![false; segments.len()];
    for (run, least) in all.chain(compound.map(|run| (run, 1.0))).chain(beside_gaps) {
        let is_uncut = run.len() > 1 && !run.iter().any(|segment| segments[*segment].has_gap());
        let pitches: f64 = run.iter().map(|segment| segments[*segment].pitches()).sum();
        if is_uncut && at_least(pitches, least) && !is_reported[run[0]] {
            for segment in &run {
                is_reported[*segment] = true;
            }
            found.insert(run[0], run);
        }
    }
    let length = |run: &[usize]| run.iter().map(|segment| segments[*segment].curve.length()).sum();
    found
        .into_values()
        .map(|run| UncutRun { first: segments[run[0]], length: length(&run), count: run.len() })
        .collect()
}

/// Returns the first segment of a path of which no segment has a gap. A run does not count if cuts at least as deep as its gaps would be lead up to all
/// of its ends: it is a bar as a whole.
pub(super) fn first_uncut<'s, 'a>(
    segments: &'s [SupportSegment<'a>],
    depths: &CutDepths,
) -> Option<&'s SupportSegment<'a>> {
    if segments.iter().any(SupportSegment::has_gap) {
        return None;
    }
    let is_bar = |run: &Vec<usize>| {
        let mut ends: BTreeMap<_, Vec<f64>> = BTreeMap::new();
        for segment in run.iter().map(|number| &segments[*number]) {
            for end in [segment.curve.start(), segment.curve.end()] {
                ends.entry(grid_square(end)).or_default().push(segment.bottom);
            }
        }
        ends.retain(|_, bottoms| bottoms.len() == 1);
        let is_cut =
            |(end, bottoms): (_, &Vec<f64>)| depths.get(end).is_some_and(|depth| !above(*depth, bottoms[0]));
        !ends.is_empty() && ends.iter().all(is_cut)
    };
    let uncut = runs(segments, |_| ()).into_iter().find(|run| !is_bar(run))?;
    Some(&segments[uncut[0]])
}

/// Returns the groups of connected segments of the same kind, each as the segments' indices in ascending order.
fn runs<'a, K: Ord>(
    segments: &[SupportSegment<'a>],
    kind: impl Fn(&SupportSegment<'a>) -> K,
) -> Vec<Vec<usize>> {
    let mut groups: Vec<usize> = (0..segments.len()).collect();
    let mut firsts = BTreeMap::new();
    for (number, segment) in segments.iter().enumerate() {
        for end in [segment.curve.start(), segment.curve.end()] {
            let first = *firsts.entry((kind(segment), grid_square(end))).or_insert(number);
            unite(&mut groups, first, number);
        }
    }
    let mut runs: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for number in 0..segments.len() {
        let first = root(&mut groups, number);
        runs.entry(first).or_default().push(number);
    }
    runs.into_values().collect()
}
