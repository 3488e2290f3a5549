//! The walk: orders the segments of a path from its start to its end. (book: language/chains-and-passes)

mod failure;
mod order;

use std::collections::{BTreeMap, BTreeSet};

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::{drawing as messages, parameters, paths};
use rstar::RTree;

use crate::approx::{above, at_least, coincide};
use crate::bind::group_missing;
use crate::chain::{ChainBuilder, Passage, WalkedPath};
use crate::element::{Origin, diagnostic_point};
use crate::geometry::{Curve, Xy};
use crate::path::{Path, SegmentKind};
use crate::raw::WalkCertainty;
use crate::walk::failure::{Curves, embedded_twice_problems};
use crate::walk::order::{Ends, Junctions, Turns, comes_before};

/// Orders the segments of a path. Where no segment continues, the nearest end within `join_tolerance` mm is joined, with a warning.
pub fn walk(path: &Path, join_tolerance: f64) -> WalkedPath {
    walk_with_checkpoints(path, join_tolerance, &|| {})
}

/// Like [`walk`], but calls `checkpoint` regularly, which may unwind if the result is no longer needed.
pub fn walk_with_checkpoints(path: &Path, join_tolerance: f64, checkpoint: &dyn Fn()) -> WalkedPath {
    let mut walk = Walker::new(path, join_tolerance, checkpoint);
    let result = walk.run();
    let mut walked = walk.finish(result);
    for diagnostic in &mut walked.diagnostics {
        diagnostic.path = Some(path.name.as_str().into());
    }
    walked
}

/// The reason why a walk failed; `None` if it may follow from other errors.
type Failure = Option<Box<Diagnostic>>;

/// Maximum number of segments at a point that are scanned in each step. If there are more, they are sorted once.
const MAX_SCANNED_SEGMENTS: usize = 16;

const SEGMENTS_PER_CHECKPOINT: usize = 256;

struct Walker<'a> {
    path: &'a Path,
    ends: Ends,
    junctions: Junctions,
    /// Index of the ends of segments that are not traversed; `None` until a join is needed.
    open_ends: Option<OpenEnds>,
    is_traversed: Vec<bool>,
    /// Scratch buffer for the segments at the current point, kept to avoid reallocating.
    found: Vec<usize>,
    /// Number of segments that are not traversed.
    left: usize,
    /// The current point.
    at: Xy,
    /// The last traversed segment.
    last: Option<usize>,
    chains: ChainBuilder<'a>,
    /// Segments traversed forwards and not yet retraced. They always lead from the start to `at`. Unused without turn markers.
    way_back: Vec<(usize, Passage)>,
    turns: Turns,
    join_tolerance: f64,
    checkpoint: &'a dyn Fn(),
    /// PB115 for each join.
    joined: Vec<Diagnostic>,
    /// See [`WalkedPath::open_end`].
    open_end: Option<Xy>,
    /// PB401 or PB403 for each small gap that was skipped in order to find further problems.
    gaps: Vec<Diagnostic>,
}

/// Largest gap in mm that is skipped after it was reported: it is still clear where the path continues.
const MAX_SKIPPED_GAP: f64 = 1.0;

/// Maximum number of gaps that are skipped in a walk.
const MAX_GAPS: usize = 10;

impl<'a> Walker<'a> {
    fn new(path: &'a Path, join_tolerance: f64, checkpoint: &'a dyn Fn()) -> Self {
        let count = path.segments.len();
        Self {
            path,
            join_tolerance,
            checkpoint,
            joined: Vec::new(),
            open_end: None,
            gaps: Vec::new(),
            ends: Ends::new(path),
            junctions: Junctions::default(),
            open_ends: None,
            is_traversed: vec![false; count],
            found: Vec::new(),
            left: count,
            at: path.start,
            last: None,
            chains: ChainBuilder::new(path),
            way_back: Vec::new(),
            turns: Turns::new(path),
        }
    }

    /// Returns the items of the walk, or only diagnostics if it is not complete.
    fn finish(self, result: Result<(), Failure>) -> WalkedPath {
        let idle = self.unused_turn_markers();
        let Self { path, chains, mut joined, open_end, gaps, .. } = self;
        let mut walked = chains.finish();
        walked.open_end = open_end;
        let is_complete = result.is_ok();
        let is_complete = is_complete && gaps.is_empty();
        let is_silent = matches!(result, Err(None)) && gaps.is_empty();
        if !is_complete {
            let problem = gaps.into_iter().chain(result.err().flatten().map(|problem| *problem));
            let missing =
                walked.diagnostics.into_iter().filter(|found| found.is_error() && !path.gives_infeed());
            let diagnostics = problem.chain(missing).collect();
            walked = WalkedPath { diagnostics, ..WalkedPath::default() };
        }
        if path.uncertainty.as_ref().is_some_and(|uncertainty| uncertainty.is_infeed_unknown) {
            walked.diagnostics.retain(|found| found.message != &parameters::MISSING);
        }
        group_missing(&mut walked.diagnostics);
        walked.diagnostics.append(&mut joined);
        if is_complete && !walked.items.is_empty() {
            walked.diagnostics.extend(idle);
            walked.diagnostics.extend(Curves::new(path, 0..path.segments.len()).milled_twice_problems());
            walked.diagnostics.extend(embedded_twice_problems(path, &walked.items));
        } else if is_silent {
            walked.diagnostics.extend(Curves::new(path, 0..path.segments.len()).milled_twice_summary());
        }
        walked
    }

    fn run(&mut self) -> Result<(), Failure> {
        if self
            .path
            .uncertainty
            .as_ref()
            .is_some_and(|uncertainty| uncertainty.walk == WalkCertainty::Unknown)
        {
            return Err(None);
        }
        if self.path.segments.is_empty() {
            return Err(self.failure_unless_uncertain(Self::empty_path_problem));
        }
        while self.left > 0 {
            if self.left.is_multiple_of(SEGMENTS_PER_CHECKPOINT) {
                (self.checkpoint)();
            }
            if let Some(segment) = self.next().or_else(|| self.next_within_tolerance()) {
                self.traverse(segment);
            } else if let Some(marker) = self.turn_marker() {
                self.retrace_until(|walk| walk.next().is_some())
                    .map_err(|()| Some(self.turn_found_nothing_problem(marker).into()))?;
            } else if self.is_at_end() || self.last.is_some() && self.joins_end() {
                return Err(self
                    .failure_unless_uncertain(Self::unreached_problem)
                    .filter(|_| !self.has_several_ends()));
            } else {
                let problem = self.failure_unless_uncertain(Self::nothing_continues_problem);
                match self.point_beyond_gap(problem.as_deref()) {
                    Some(point) => {
                        self.gaps.extend(problem.map(|problem| *problem));
                        self.at = point;
                    }
                    None => return Err(problem),
                }
            }
        }
        if self.is_at_end() || self.joins_end() {
            return Ok(());
        }
        let stopped_at = self.at;
        if self.path.uncertainty.as_ref().is_some_and(|uncertainty| uncertainty.ends.is_empty()) {
            self.open_end = Some(stopped_at);
            return Ok(());
        }
        if self.turn_marker().is_none() || self.retrace_until(|walk| walk.is_at_end()).is_err() {
            let problem = self.failure_unless_uncertain(|walk| walk.end_not_reached_problem(stopped_at));
            return Err(problem.filter(|_| !self.has_several_ends()));
        }
        Ok(())
    }

    /// Returns the point at which the walk continues after a small gap, to find independent problems: the end of a segment, the end marker or a turn
    /// marker.
    fn point_beyond_gap(&self, problem: Option<&Diagnostic>) -> Option<Xy> {
        let message = problem.filter(|_| self.gaps.len() < MAX_GAPS)?.message;
        if [&paths::NOTHING_CONTINUES, &paths::TOO_LONG].contains(&message) {
            let (_, end, distance) = self.nearest_end(self.at)?;
            (distance <= MAX_SKIPPED_GAP).then_some(end)
        } else if message == &paths::TURN_MARKER_BESIDE_TIP {
            self.turn_marker_beside().map(|(at, _)| at)
        } else {
            (message == &paths::STOPS_BESIDE_END).then_some(self.path.end)
        }
    }

    /// Returns a failure, unless there is a circle without a meaning at the current point, where the walk may turn or end, or the walk passed a segment
    /// that an unread N may have put first.
    fn failure_unless_uncertain(&self, problem: impl FnOnce(&Self) -> Diagnostic) -> Failure {
        let is_unclear = self.path.uncertainty.as_ref().is_some_and(|uncertainty| {
            let mut circles = uncertainty.unclear_circles.iter();
            circles.any(|circle| coincide(*circle, self.at) || self.path.segments.is_empty())
                || uncertainty.walk == WalkCertainty::MayHideOrder && self.passed_branch().is_some()
        });
        (!is_unclear).then(|| problem(self).into())
    }

    /// Whether there are several end markers, so that it is unknown where the path ends.
    fn has_several_ends(&self) -> bool {
        self.path.uncertainty.as_ref().is_some_and(|uncertainty| uncertainty.ends.len() > 1)
    }

    /// Returns the next segment at the current point: the minimum by order, preference and length.
    fn next(&mut self) -> Option<usize> {
        if let Some(junction) = self.junctions.at(self.at) {
            return junction.next(self.path, &self.ends, &self.is_traversed);
        }
        let mut found = std::mem::take(&mut self.found);
        self.ends.find_near(self.at, |segment| !self.is_traversed[segment], &mut found);
        // A single scan in segment order: approximate comparison of lengths is not transitive.
        found.sort_unstable();
        let (path, ends) = (self.path, &self.ends);
        let before = |best, other| if comes_before(path, ends, other, best) { other } else { best };
        let next = found.iter().copied().reduce(before);
        if found.len() > MAX_SCANNED_SEGMENTS
            && let Some(segments) = ends.junction_segments(self.at, |segment| !self.is_traversed[segment])
        {
            self.junctions.insert(self.at, segments, path, ends);
        }
        self.found = found;
        next
    }

    fn traverse(&mut self, segment: usize) {
        self.is_traversed[segment] = true;
        self.left -= 1;
        if let Some(open_ends) = &mut self.open_ends {
            open_ends.remove(segment, &self.ends);
        }
        let passage =
            self.oriented_from_here(segment, Passage::in_drawn_direction(self.ends.of(segment)), false);
        // An arc keeps its centre and radius: the gap before it becomes a short line. To reach a hole, circle or subpath, the tool sweeps.
        if !coincide(passage.start, self.at) {
            if self.is_milled_arc(segment) {
                self.follow_forwards(segment, passage.lead_in(self.at));
            } else {
                self.chains.add_sweep(segment, self.at, passage.start);
            }
        }
        self.follow_forwards(segment, passage);
    }

    fn follow_forwards(&mut self, segment: usize, passage: Passage) {
        if !self.path.turns.is_empty() {
            self.way_back.push((segment, passage.clone()));
        }
        self.follow(segment, passage, false);
    }

    fn is_milled_arc(&self, segment: usize) -> bool {
        let segment = &self.path.segments[segment];
        matches!(segment.kind, SegmentKind::Cut(_)) && matches!(self.path.curve(segment), Some(Curve::Arc(_)))
    }

    #[inline]
    fn follow(&mut self, segment: usize, passage: Passage, is_return: bool) {
        self.at = passage.end;
        self.last = Some(segment);
        self.chains.add(segment, passage, is_return);
    }

    /// Reverses a segment if its end is at the current point. A joined segment is made to begin exactly there.
    #[inline]
    fn oriented_from_here(&self, segment: usize, passage: Passage, is_return: bool) -> Passage {
        let is_end_here = coincide(passage.end, self.at);
        if is_end_here || coincide(passage.start, self.at) {
            passage.reversed_if(is_end_here)
        } else {
            self.joined_passage(segment, passage, is_return)
        }
    }

    /// Returns the passage along a segment that ends near the current point. Holes, circles, subpaths and arcs stay in place.
    fn joined_passage(&self, number: usize, passage: Passage, is_return: bool) -> Passage {
        let segment = &self.path.segments[number];
        let is_nearer_at_end = (passage.end - self.at).norm() < (passage.start - self.at).norm();
        let passage = if is_nearer_at_end { passage.reversed() } else { passage };
        match segment.kind {
            SegmentKind::Hole(_) | SegmentKind::Helix(_) | SegmentKind::Subpath(_) if !is_return => passage,
            SegmentKind::Cut(_) if self.is_milled_arc(number) => passage,
            _ => passage.starting_at(self.at, segment),
        }
    }

    fn turn_marker(&mut self) -> Option<usize> {
        self.turns.use_marker(self.path, self.at)
    }

    /// Retraces the traversed segments until `is_found` returns true; fails if the start is reached first. (book: language/order-and-turns)
    fn retrace_until(&mut self, is_found: impl Fn(&mut Self) -> bool) -> Result<(), ()> {
        loop {
            let (segment, passage) = self.way_back.pop().ok_or(())?;
            if let SegmentKind::Hole(_) = self.path.segments[segment].kind {
                self.last = Some(segment);
                self.chains.finish_chain();
            } else {
                let passage = self.oriented_from_here(segment, passage.reversed(), true);
                self.follow(segment, passage, true);
            }
            if is_found(self) {
                return Ok(());
            }
        }
    }

    fn is_at_end(&self) -> bool {
        match &self.path.uncertainty {
            None => coincide(self.at, self.path.end),
            Some(uncertainty) => uncertainty.ends.iter().any(|end| coincide(self.at, *end)),
        }
    }

    fn unused_turn_markers(&self) -> Vec<Diagnostic> {
        let origin = |turn: usize| &self.path.turns[turn].origin;
        let idle = self.turns.unused();
        idle.map(|turn| origin(turn).at(Diagnostic::new(&messages::TURN_WITHOUT_EFFECT))).collect()
    }
}

/// A spatial index of the ends of segments.
struct OpenEnds {
    /// Each point once: a tree removes one of many equal points by scanning all of them.
    points: RTree<[f64; 2]>,
    /// The segments that end at each point.
    segments: BTreeMap<[u64; 2], BTreeSet<usize>>,
}

impl OpenEnds {
    fn new(open: impl Iterator<Item = usize>, ends: &Ends) -> Self {
        let (mut points, mut segments) = (Vec::new(), BTreeMap::<_, BTreeSet<usize>>::new());
        for (segment, end) in open.flat_map(|segment| end_keys(segment, ends).map(|end| (segment, end))) {
            let at_end = segments.entry(bits(end)).or_default();
            if at_end.is_empty() {
                points.push(end);
            }
            at_end.insert(segment);
        }
        Self { points: RTree::bulk_load(points), segments }
    }

    fn remove(&mut self, segment: usize, ends: &Ends) {
        for end in end_keys(segment, ends) {
            let Some(at_end) = self.segments.get_mut(&bits(end)) else { continue };
            at_end.remove(&segment);
            if at_end.is_empty() {
                self.segments.remove(&bits(end));
                self.points.remove(&end);
            }
        }
    }

    /// Returns the segment with the end nearest to a point, and its distance; the first of several.
    fn nearest(&self, point: Xy) -> Option<(usize, f64)> {
        let by_distance = self.points.nearest_neighbor_iter([point.x, point.y]);
        let mut points = by_distance.map(|end| (end, (Xy::from(*end) - point).norm())).peekable();
        let distance = points.peek()?.1;
        let nearest = points.take_while(|(_, other)| *other <= distance);
        let firsts = nearest.filter_map(|(end, _)| self.segments.get(&bits(*end))?.first());
        Some((*firsts.min()?, distance))
    }
}

/// Returns the ends of a segment as keys; zeros get a positive sign, since points are compared by their bits.
fn end_keys(segment: usize, ends: &Ends) -> [[f64; 2]; 2] {
    ends.of(segment).map(|end| [end.x + 0.0, end.y + 0.0])
}

fn bits(point: [f64; 2]) -> [u64; 2] {
    point.map(f64::to_bits)
}

impl Walker<'_> {
    /// Returns the segment with the nearest end, if that is within the tolerance. Reports the join.
    fn next_within_tolerance(&mut self) -> Option<usize> {
        if self.join_tolerance <= 0.0 {
            return None;
        }
        let (open, ends) = (|segment: &usize| !self.is_traversed[*segment], &self.ends);
        let open_ends = self
            .open_ends
            .get_or_insert_with(|| OpenEnds::new((0..self.is_traversed.len()).filter(open), ends));
        let (nearest, distance) = open_ends.nearest(self.at)?;
        if above(distance, self.join_tolerance) {
            return None;
        }
        let ends = self.ends.of(nearest);
        let [one, other] = ends.map(|end| (end - self.at).norm());
        let end = ends[usize::from(other < one)];
        self.report_join(&self.path.origin(&self.path.segments[nearest]), end, distance);
        Some(nearest)
    }

    /// Whether the end marker is within the tolerance, so that the tool sweeps there with a warning.
    fn joins_end(&mut self) -> bool {
        let distance = (self.path.end - self.at).norm();
        let is_known = self.path.uncertainty.as_ref().is_none_or(|uncertainty| !uncertainty.ends.is_empty());
        let is_near = is_known && self.join_tolerance > 0.0 && at_least(self.join_tolerance, distance);
        if is_near {
            self.report_join(&self.path.end_origin, self.path.end, distance);
            if let Some(last) = self.last {
                self.chains.add_sweep(last, self.at, self.path.end);
            }
        }
        is_near
    }

    /// Reports a join at the end of the element to which the walk continues.
    fn report_join(&mut self, origin: &Origin, end: Xy, distance: f64) {
        let warning = origin.at(Diagnostic::new(&messages::JOINED_ENDS).with("distance", distance));
        self.joined.push(warning.at_point(diagnostic_point(end)));
    }
}
