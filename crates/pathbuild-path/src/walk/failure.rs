//! Explains why a walk cannot continue, with hints for finding the cause.

use std::collections::{BTreeMap, BTreeSet};

use pathbuild_diagnostic::messages::{drawing, paths as messages};
use pathbuild_diagnostic::{Diagnostic, Message, Text, Value, words};

use crate::approx::{coincide, grid_square};
use crate::chain::Item;
use crate::element::{Element, diagnostic_point};
use crate::geometry::{Arc, Curve, PlaceKey, Xy};
use crate::path::{Path, SegmentKind, SubpathName};
use crate::walk::{MAX_SKIPPED_GAP, OpenEnds, Walker};

/// Tolerance in mm within which a point is considered to be on a curve: the offset is invisible on screen.
const ON_CURVE_TOLERANCE: f64 = 0.001;

/// Maximum number of unreached arcs that are checked for being part of a full circle. Each is compared with all others.
const MAX_SEARCHED_CIRCLES: usize = 16;

/// An end of a remaining segment that a small gap separates from the end of a traversed one.
struct NearbyEnd {
    segment: usize,
    end: Xy,
    /// The traversed segment.
    other: usize,
    distance: f64,
}

impl Walker<'_> {
    pub(super) fn empty_path_problem(&self) -> Diagnostic {
        self.path.start_origin.at(Diagnostic::new(&messages::EMPTY_PATH))
    }

    pub(super) fn nothing_continues_problem(&self) -> Diagnostic {
        if let Some(problem) = self.last.and_then(|last| self.runs_back_on_copy_problem(last)) {
            return problem;
        }
        if let Some(problem) = self.stops_beside_end_problem(self.at).filter(|_| self.is_nearest_to_end()) {
            return self.at_end_marker(problem, self.at);
        }
        let last = self.last.map(|segment| self.path.origin(&self.path.segments[segment]));
        let report = |problem: Diagnostic| {
            let origin = last.as_ref().unwrap_or(&self.path.start_origin);
            let mut problem = origin.at(problem.with("left", self.left));
            problem.place.point = Some(diagnostic_point(self.at));
            problem
        };
        let has_passed_branch = self.passed_branch().is_some();
        let is_dead_end = has_passed_branch && self.duplicate_segment().is_none();
        let split =
            || self.ends_on_another_problem(&messages::ENDS_ON_OTHER).filter(|_| !self.has_open_end_beside());
        if let Some(problem) = self.begins_on_another_problem().or_else(split) {
            report(problem)
        } else if let Some((at, distance)) = self.turn_marker_beside().filter(|_| has_passed_branch) {
            let problem = Diagnostic::new(&messages::TURN_MARKER_BESIDE_TIP);
            report(problem.with("point", diagnostic_point(at)).with("distance", distance))
        } else if self.has_open_end_beside() || !is_dead_end {
            self.with_hints(report(Diagnostic::new(&messages::NOTHING_CONTINUES)))
        } else if let Some((segment, end)) = self.traversed_end_beside() {
            report(
                Diagnostic::new(&messages::ENDS_BESIDE_TRAVERSED)
                    .with("element", self.word(segment))
                    .with("point", diagnostic_point(end))
                    .with("distance", (end - self.at).norm()),
            )
        } else {
            self.with_hints(report(Diagnostic::new(&messages::DEAD_END)))
        }
    }

    /// Returns the problem that a segment lies on another one, wholly or in part, so that the path runs back along it.
    fn runs_back_on_copy_problem(&self, segment: usize) -> Option<Diagnostic> {
        let (segment, message) = if self.is_drawn_twice(segment) {
            (segment, &messages::DRAWN_TWICE)
        } else {
            (self.part_drawn_twice(segment)?, &messages::PART_DRAWN_TWICE)
        };
        let problem = Diagnostic::new(message)
            .with("element", self.word(segment))
            .with("point", diagnostic_point(self.ends.of(segment)[0]))
            .with("left", self.left);
        Some(self.with_copies(self.path.origin(&self.path.segments[segment]).at(problem)))
    }

    /// Adds a note with the number of segments that lie on others, if there are several.
    fn with_copies(&self, problem: Diagnostic) -> Diagnostic {
        let count = Curves::new(self.path, 0..self.path.segments.len()).copy_count();
        if count > 1 { problem.note(&messages::COPIES, vec![("count", count.into())]) } else { problem }
    }

    /// Returns the problem that the path ends in the middle of a line or arc that was not reached. Excluded are those that branch off at a point that
    /// the walk passed, to which it may come back, and subpaths, which cannot be split.
    fn ends_on_another_problem(&self, message: &'static Message) -> Option<Diagnostic> {
        let is_meant = |segment: &usize| {
            self.passes_through(*segment, self.at)
                && !matches!(self.path.segments[*segment].kind, SegmentKind::Subpath(_))
                && !self.ends.of(*segment).iter().any(|end| self.is_passed(*end))
        };
        let segment = self.unreached_segments().find(is_meant)?;
        let problem = Diagnostic::new(message).with("element", self.word(segment));
        Some(problem.with("point", diagnostic_point(self.at)))
    }

    /// Returns the problem that the nearest segment that was not reached begins in the middle of a traversed one, unless that is a small gap.
    fn begins_on_another_problem(&self) -> Option<Diagnostic> {
        let (segment, begin, distance) = self.nearest_end(self.at)?;
        let other = self.segment_through(begin)?;
        let is_near = distance <= MAX_SKIPPED_GAP;
        let problem = if !is_near {
            Diagnostic::new(&messages::BEGINS_ON_OTHER)
        } else if Some(other) == self.last {
            Diagnostic::new(&messages::TOO_LONG).with("distance", distance)
        } else {
            return None;
        };
        Some(problem.with("element", self.word(segment)).with("point", diagnostic_point(begin)))
    }

    /// Whether only a small gap separates the current point from a segment that was not reached.
    fn has_open_end_beside(&self) -> bool {
        let nearest = self.nearest_end(self.at);
        nearest.is_some_and(|(_, end, distance)| {
            distance <= MAX_SKIPPED_GAP && !self.is_start_of_short_last_segment(end)
        })
    }

    /// Returns the nearest end of a traversed segment, if only a small gap separates it from the current point. `None` after a short
    /// segment: the ends near it may be those of the segments that led there.
    fn traversed_end_beside(&self) -> Option<(usize, Xy)> {
        self.last.filter(|last| self.length(*last) > MAX_SKIPPED_GAP)?;
        let ends =
            self.traversed_segments().flat_map(|segment| self.ends.of(segment).map(|end| (segment, end)));
        let distance = |(_, end): &(usize, Xy)| (end - self.at).norm();
        let beside = ends.filter(|end| distance(end) <= MAX_SKIPPED_GAP && !coincide(end.1, self.at));
        beside.reduce(|best, other| if distance(&other) < distance(&best) { other } else { best })
    }

    /// Whether the last segment leads from a point to the current one and is as short as a gap.
    fn is_start_of_short_last_segment(&self, point: Xy) -> bool {
        self.last.is_some_and(|last| {
            self.length(last) <= MAX_SKIPPED_GAP && self.ends.of(last).iter().any(|end| coincide(*end, point))
        })
    }

    /// Returns the length of a segment; 0 for holes and circles.
    fn length(&self, segment: usize) -> f64 {
        self.path.curve(&self.path.segments[segment]).map_or(0.0, |curve| curve.length())
    }

    /// Whether a traversed segment ends at a point.
    fn is_passed(&self, point: Xy) -> bool {
        let mut passed = Vec::new();
        self.ends.find_near(point, |segment| self.is_traversed[segment], &mut passed);
        !passed.is_empty()
    }

    /// Returns the first segment that was not reached although it branches off at a point that the walk passed, with that point.
    pub(super) fn passed_branch(&self) -> Option<(usize, Xy)> {
        self.unreached_segments().find_map(|segment| {
            let end = self.ends.of(segment).into_iter().find(|end| self.is_passed(*end))?;
            Some((segment, end))
        })
    }

    pub(super) fn turn_found_nothing_problem(&self, marker: usize) -> Diagnostic {
        let problem = Diagnostic::new(&messages::TURN_FOUND_NOTHING).with("left", self.left);
        let problem = self.path.turns[marker].origin.at(problem);
        match self.end_beside_traversed() {
            Some(NearbyEnd { segment, end, distance, .. }) => problem.note(
                &messages::END_BESIDE_WAY_BACK,
                vec![
                    ("element", self.word(segment).into()),
                    ("point", diagnostic_point(end).into()),
                    ("distance", distance.into()),
                ],
            ),
            None => self.with_hints(problem),
        }
    }

    /// Returns the end of a remaining segment that is nearest to the traversed segments' ends, if only a small gap separates them.
    fn end_beside_traversed(&self) -> Option<NearbyEnd> {
        let passed = OpenEnds::new(self.traversed_segments(), &self.ends);
        let beside = self.unreached_segments().flat_map(|segment| {
            let [one, two] = self.ends.of(segment);
            // The tip of a short branch is near the point where it branches off.
            let is_short_branch = |from| self.length(segment) <= MAX_SKIPPED_GAP && self.is_passed(from);
            let ends = [(one, two), (two, one)].map(|(end, from)| {
                let (other, distance) = passed.nearest(end)?;
                let is_gap = !self.is_passed(end) && distance <= MAX_SKIPPED_GAP && !is_short_branch(from);
                is_gap.then_some(NearbyEnd { segment, end, other, distance })
            });
            ends.into_iter().flatten()
        });
        beside.reduce(|best, other| if other.distance < best.distance { other } else { best })
    }

    /// Returns the nearest turn marker, with its distance, if only a small gap separates it from the current point.
    pub(super) fn turn_marker_beside(&self) -> Option<(Xy, f64)> {
        let distances = self.path.turns.iter().map(|turn| (turn.at, (turn.at - self.at).norm()));
        let nearest = distances.reduce(|best, other| if other.1 < best.1 { other } else { best });
        nearest.filter(|(_, distance)| *distance <= MAX_SKIPPED_GAP)
    }

    pub(super) fn unreached_problem(&self) -> Diagnostic {
        let all = Curves::new(self.path, 0..self.path.segments.len());
        let twice = self.unreached_segments().find(|segment| all.has_duplicate(*segment));
        let first = |segment: usize| (segment, self.ends.of(segment)[0]);
        let branch = self.passed_branch();
        let remaining = branch.or_else(|| self.unreached_segments().next().map(first));
        let part_twice = remaining.and_then(|(segment, _)| self.part_drawn_twice(segment));
        let about = |message, (segment, point): (usize, Xy)| {
            let problem = Diagnostic::new(message).with("element", self.word(segment));
            problem.with("point", diagnostic_point(point))
        };
        let problem = if let Some(segment) = twice {
            about(&messages::UNREACHED_TWICE, first(segment))
        } else if let Some(segment) = part_twice {
            about(&messages::UNREACHED_PART_TWICE, first(segment))
        } else if let Some(arc) = self.unreached_circle() {
            Diagnostic::new(&messages::UNREACHED_CIRCLE)
                .with("diameter", 2.0 * arc.radius)
                .with("point", diagnostic_point(arc.centre))
        } else if let Some(NearbyEnd { segment, end, other, distance }) = self.end_beside_traversed() {
            let [one, two] = self.ends.of(other);
            let beside = if (two - end).norm() < (one - end).norm() { two } else { one };
            about(&messages::UNREACHED_BESIDE, (segment, end))
                .with("other", self.word(other))
                .with("end", diagnostic_point(beside))
                .with("distance", distance)
        } else if let Some(problem) = self.ends_on_another_problem(&messages::UNREACHED_ENDS_ON_OTHER) {
            problem
        } else if let Some(branch) = branch {
            about(&messages::UNREACHED_BRANCH, branch)
        } else if let Some((segment, point)) = remaining {
            match self.segment_through(point).map(|other| self.word(other)) {
                Some(other) if other == self.word(segment) => {
                    about(&messages::NO_END_THERE_ALIKE, (segment, point))
                }
                Some(other) => about(&messages::NO_END_THERE, (segment, point)).with("other", other),
                None => about(&messages::UNREACHED, (segment, point)),
            }
        } else {
            Diagnostic::new(&messages::UNREACHED)
        };
        let is_told = twice.is_some() || part_twice.is_some();
        let problem = self.path.end_origin.at(problem.with("left", self.left));
        if is_told { self.with_copies(problem) } else { self.with_duplicate(problem) }
    }

    /// Returns one of the arcs that were not reached, if they form a full circle around a point that the walk passed.
    fn unreached_circle(&self) -> Option<Arc> {
        let arc = |segment: usize| match self.path.curve(&self.path.segments[segment]) {
            Some(Curve::Arc(arc)) => Some(arc),
            _ => None,
        };
        let arcs: Vec<Arc> = self.unreached_segments().filter_map(arc).collect();
        let is_of = |circle: &Arc, other: &Arc| {
            coincide(circle.centre, other.centre) && (circle.radius - other.radius).abs() < ON_CURVE_TOLERANCE
        };
        let degrees = |circle: &Arc| {
            arcs.iter().filter(|other| is_of(circle, other)).map(|arc| arc.degrees).sum::<f64>()
        };
        let is_full = |circle: &&Arc| (degrees(circle) - 360.0).abs() < 0.1;
        arcs.iter().filter(|arc| self.is_passed(arc.centre)).take(MAX_SEARCHED_CIRCLES).find(is_full).copied()
    }

    /// Returns a traversed segment that passes through a point without ending there.
    fn segment_through(&self, point: Xy) -> Option<usize> {
        self.traversed_segments().find(|segment| self.passes_through(*segment, point))
    }

    /// Whether a line or arc passes through a point without ending there.
    fn passes_through(&self, segment: usize, point: Xy) -> bool {
        let is_on = |curve: Curve| {
            let is_end =
                [curve.start(), curve.end()].iter().any(|end| (end - point).norm() < ON_CURVE_TOLERANCE);
            !is_end && curve.distance_to(point) < ON_CURVE_TOLERANCE
        };
        self.path.curve(&self.path.segments[segment]).is_some_and(is_on)
    }

    pub(super) fn end_not_reached_problem(&self, stopped_at: Xy) -> Diagnostic {
        let part = self.last.and_then(|last| self.part_drawn_twice(last));
        let about_copy = |message, segment: usize| {
            let problem = Diagnostic::new(message).with("element", self.word(segment));
            problem.with("begin", diagnostic_point(self.ends.of(segment)[0]))
        };
        let end = self.path.end;
        let problem = if let Some(segment) = self.duplicate_segment() {
            about_copy(&messages::END_NOT_REACHED_TWICE, segment)
        } else if let Some(segment) = part {
            about_copy(&messages::END_NOT_REACHED_PART_TWICE, segment)
        } else if let Some(problem) = self.stops_beside_end_problem(stopped_at) {
            problem
        } else if self.is_passed(end) && !coincide(end, self.path.start) {
            Diagnostic::new(&messages::END_PASSED)
        } else {
            Diagnostic::new(&messages::END_NOT_REACHED)
        };
        self.with_copies(self.at_end_marker(problem, stopped_at))
    }

    fn at_end_marker(&self, problem: Diagnostic, stopped_at: Xy) -> Diagnostic {
        let problem = problem.with("point", diagnostic_point(stopped_at));
        self.path.end_origin.at(problem.with("end", diagnostic_point(self.path.end)))
    }

    /// Returns the problem that only a small gap separates the path from its end marker.
    fn stops_beside_end_problem(&self, stopped_at: Xy) -> Option<Diagnostic> {
        let distance = (self.path.end - stopped_at).norm();
        let is_beside = distance <= MAX_SKIPPED_GAP && !self.is_start_of_short_last_segment(self.path.end);
        is_beside.then(|| Diagnostic::new(&messages::STOPS_BESIDE_END).with("distance", distance))
    }

    /// Whether the path, after its first segment, stops nearer to its only end marker than to every remaining segment and every turn marker.
    fn is_nearest_to_end(&self) -> bool {
        let distance = (self.path.end - self.at).norm();
        let open_end = self.nearest_end(self.at).map(|(.., other)| other);
        let turn_marker = self.turn_marker_beside().map(|(_, other)| other);
        let uncertainty = self.path.uncertainty.as_ref();
        self.last.is_some()
            && uncertainty.is_none_or(|uncertainty| uncertainty.ends.len() == 1)
            && open_end.into_iter().chain(turn_marker).all(|other| distance < other)
    }

    fn traversed_segments(&self) -> impl Iterator<Item = usize> {
        (0..self.is_traversed.len()).filter(|segment| self.is_traversed[*segment])
    }

    pub(super) fn unreached_segments(&self) -> impl Iterator<Item = usize> {
        let open = self.is_traversed.iter().enumerate().filter(|(_, traversed)| !**traversed);
        open.map(|(segment, _)| segment)
    }

    fn with_hints(&self, problem: Diagnostic) -> Diagnostic {
        let point = problem.place.point.map_or(self.at, |point| Xy::new(point.x.0, point.y.0));
        let problem = self.with_nearest_end(problem, point);
        self.with_left_out(self.with_duplicate(problem), point)
    }

    /// Returns the nearest end of a remaining segment, with its distance.
    pub(super) fn nearest_end(&self, point: Xy) -> Option<(usize, Xy, f64)> {
        self.nearest_end_where(point, |_| true)
    }

    fn nearest_end_where(&self, point: Xy, is_wanted: impl Fn(&Xy) -> bool) -> Option<(usize, Xy, f64)> {
        let ends =
            self.unreached_segments().flat_map(|segment| self.ends.of(segment).map(|end| (segment, end)));
        let ends = ends.filter(|(_, end)| is_wanted(end));
        let distances = ends.map(|(segment, end)| (segment, end, (end - point).norm()));
        distances.reduce(|best, other| if other.2 < best.2 { other } else { best })
    }

    /// Adds a note about the end to which a missing segment probably leads: the nearest one across a small gap, otherwise the nearest one that is not
    /// a corner, if there is any.
    fn with_nearest_end(&self, problem: Diagnostic, point: Xy) -> Diagnostic {
        let Some(nearest) = self.nearest_end(point) else { return problem };
        let open = || {
            let is_line = |segment: &usize| self.path.curve(&self.path.segments[*segment]).is_some();
            let mut line_ends: BTreeMap<[i64; 2], usize> = BTreeMap::new();
            for end in self.unreached_segments().filter(is_line).flat_map(|segment| self.ends.of(segment)) {
                *line_ends.entry(grid_square(end)).or_default() += 1;
            }
            // At a corner, two lines end; at a hole, only the line that leads on.
            let is_open = |end: &Xy| line_ends.get(&grid_square(*end)).is_none_or(|count| *count == 1);
            self.nearest_end_where(point, is_open)
        };
        let nearest = Some(nearest)
            .filter(|(.., distance)| *distance <= MAX_SKIPPED_GAP)
            .or_else(open)
            .unwrap_or(nearest);
        let (segment, end, distance) = nearest;
        problem.note(
            &messages::NEAREST_END,
            vec![
                ("point", diagnostic_point(end).into()),
                ("distance", distance.into()),
                ("element", self.word(segment).into()),
            ],
        )
    }

    /// Whether a segment coincides with a traversed one.
    fn is_drawn_twice(&self, segment: usize) -> bool {
        Curves::new(self.path, self.traversed_segments()).has_duplicate(segment)
    }

    /// Returns the shorter of two segments of which one lies on part of the other: this one and any other. If both have a text, the user cuts that
    /// part twice on purpose.
    fn part_drawn_twice(&self, segment: usize) -> Option<usize> {
        let kind = |segment: usize| std::mem::discriminant(&self.path.segments[segment].kind);
        let has_text = |segment: usize| {
            let element = self.path.segments[segment].element;
            self.path.drawn.elements[element as usize].text.is_some()
        };
        let lies_on = |part: usize, whole: usize| {
            let [Some(part), Some(whole)] =
                [part, whole].map(|segment| self.path.curve(&self.path.segments[segment]))
            else {
                return false;
            };
            let mut points = [part.start(), part.middle(), part.end()].into_iter();
            points.all(|point| whole.distance_to(point) < ON_CURVE_TOLERANCE)
        };
        let others = (0..self.path.segments.len()).filter(|other| {
            *other != segment && kind(*other) == kind(segment) && !(has_text(*other) && has_text(segment))
        });
        let mut shorter = others.filter_map(|other| {
            let is_shorter = self.length(segment) < self.length(other);
            let [part, whole] = if is_shorter { [segment, other] } else { [other, segment] };
            lies_on(part, whole).then_some(part)
        });
        shorter.next()
    }

    /// Returns a segment that lies on a traversed one: either it was not reached, or the walk went along both.
    fn duplicate_segment(&self) -> Option<usize> {
        let curves = Curves::new(self.path, self.traversed_segments());
        self.unreached_segments()
            .chain(self.traversed_segments())
            .find(|segment| curves.has_duplicate(*segment))
    }

    fn with_duplicate(&self, problem: Diagnostic) -> Diagnostic {
        let Some(segment) = self.duplicate_segment() else { return problem };
        let [start, _] = self.ends.of(segment);
        problem.note(
            &messages::DUPLICATE,
            vec![("element", self.word(segment).into()), ("point", diagnostic_point(start).into())],
        )
    }

    fn with_left_out(&self, problem: Diagnostic, point: Xy) -> Diagnostic {
        let distance = |begin: &pathbuild_diagnostic::Point| (Xy::new(begin.x.0, begin.y.0) - point).norm();
        let nearest = self
            .path
            .left_out
            .iter()
            .filter_map(|(kind, begin)| Some((kind, (*begin)?)))
            .reduce(|best, other| if distance(&other.1) < distance(&best.1) { other } else { best });
        let Some((kind, begin)) = nearest else { return problem };
        problem.note(
            &messages::LEFT_OUT_HERE,
            vec![("kind", Value::quoted(kind.name())), ("point", begin.into())],
        )
    }

    fn word(&self, segment: usize) -> &'static Text {
        match &self.path.segments[segment].kind {
            SegmentKind::Cut(number) => self.path.cuts[*number as usize].word(),
            SegmentKind::Hole(_) => &words::DRILLED_HOLE,
            SegmentKind::Helix(_) => &words::HELICAL_CIRCLE,
            SegmentKind::Sweep { .. } => &words::SWEEP,
            SegmentKind::Subpath(_) => &words::SUBPATH,
        }
    }
}

// Segments that are drawn twice. (book: language/chains-and-passes)

/// Lines and arcs of a path, sorted so that curves that lie on each other are neighbours.
pub(super) struct Curves<'a> {
    path: &'a Path,
    known: Vec<(CurveKey, usize)>,
}

/// A key that is equal for segments of the same kind that lie on each other.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct CurveKey(u8, PlaceKey);

impl<'a> Curves<'a> {
    /// Collects the milled curves, sweeps and subpaths among these segments.
    pub(super) fn new(path: &'a Path, segments: impl Iterator<Item = usize>) -> Self {
        let keyed = segments.filter_map(|segment| Some((CurveKey::new(path, segment)?, segment)));
        let mut known: Vec<(CurveKey, usize)> = keyed.collect();
        known.sort_unstable();
        Self { path, known }
    }

    /// Whether another curve lies on this segment.
    pub(super) fn has_duplicate(&self, segment: usize) -> bool {
        let Some(key) = CurveKey::new(self.path, segment) else { return false };
        let first = self.known.partition_point(|(other, _)| *other < key);
        let same = self.known[first..].iter().take_while(|(other, _)| *other == key);
        same.take(2).any(|(_, other)| *other != segment)
    }

    /// Returns the number of curves that lie on others, unless both have a text.
    fn copy_count(&self) -> usize {
        let pairs = self.known.windows(2).filter(|pair| pair[0].0 == pair[1].0);
        pairs.filter(|pair| self.is_mistake([pair[0].1, pair[1].1])).count()
    }

    /// Returns PB121 for milled segments that lie on each other, unless both have a text: then the user cuts the same curve twice on purpose.
    pub(super) fn milled_twice_problems(&self) -> Vec<Diagnostic> {
        let pairs = self.known.windows(2).filter(|pair| pair[0].0 == pair[1].0);
        let mut twice: Vec<[usize; 2]> =
            pairs.map(|pair| [pair[1].1, pair[0].1]).filter(|pair| self.is_mistake(*pair)).collect();
        twice.sort_unstable();
        twice.into_iter().filter_map(|pair| self.problem(pair)).collect()
    }

    /// Returns one PB121 for all milled segments that lie on others, for a path along which other errors prevent the walk.
    pub(super) fn milled_twice_summary(&self) -> Option<Diagnostic> {
        let found = self.milled_twice_problems();
        let count = found.len();
        let first = found.into_iter().next()?;
        if count == 1 {
            return Some(first);
        }
        Some(Diagnostic { message: &drawing::CURVES_TWICE, ..first }.with("count", count))
    }

    fn is_mistake(&self, pair: [usize; 2]) -> bool {
        pair.iter().any(|segment| self.element(*segment).text.is_none())
    }

    /// Returns PB121 for two segments on top of each other, reported at the later one, which is the first of `pair`.
    fn problem(&self, pair: [usize; 2]) -> Option<Diagnostic> {
        let segment = &self.path.segments[pair[0]];
        let SegmentKind::Cut(cut) = &segment.kind else { return None };
        let [element, other] = pair.map(|segment| self.element(segment));
        let problem = if element.role == other.role {
            Diagnostic::new(&drawing::CURVE_TWICE)
        } else {
            let [one, other] = [other, element].map(|element| element.class(None).word());
            Diagnostic::new(&drawing::CURVE_TWICE_OTHERWISE).with("one", one).with("other", other)
        };
        let problem = problem
            .with("element", self.path.cuts[*cut as usize].word())
            .with("point", diagnostic_point(self.path.ends(segment)[0]));
        Some(self.path.origin(segment).at(problem))
    }

    fn element(&self, segment: usize) -> &Element {
        &self.path.drawn.elements[self.path.segments[segment].element as usize]
    }
}

/// Returns PB121 for paths that are embedded twice with the same values by segments on top of each other. The walk may run back along the second one.
pub(super) fn embedded_twice_problems(path: &Path, items: &[Item]) -> Vec<Diagnostic> {
    let mut known = BTreeSet::new();
    let is_repeated = |item: &Item| {
        let Item::Subpath(placed) = item else { return None };
        let segment = &path.segments[placed.segment];
        let SegmentKind::Subpath(subpath) = &segment.kind else { return None };
        let SubpathName::Found { name, .. } = &subpath.name else { return None };
        let values: Vec<(Option<char>, &str)> =
            subpath.values.iter().map(|value| (value.variable, value.value.as_str())).collect();
        let height = grid_square(Xy::new(subpath.height, 0.0));
        let (one, other) = (grid_square(placed.start), grid_square(placed.end));
        let is_new = known.insert((name.as_str(), one.min(other), one.max(other), height, values));
        let problem = Diagnostic::new(&drawing::SUBPATH_TWICE).quoting("path", name.as_str());
        (!is_new).then(|| path.origin(segment).at(problem))
    };
    items.iter().filter_map(is_repeated).collect()
}

impl CurveKey {
    fn new(path: &Path, segment: usize) -> Option<Self> {
        let segment = &path.segments[segment];
        let kind = match segment.kind {
            SegmentKind::Cut(_) => 0,
            SegmentKind::Sweep { .. } => 1,
            SegmentKind::Subpath(_) => 2,
            SegmentKind::Hole(_) | SegmentKind::Helix(_) => return None,
        };
        let curve = path.curve(segment)?;
        Some(Self(kind, curve.place_key()))
    }
}
