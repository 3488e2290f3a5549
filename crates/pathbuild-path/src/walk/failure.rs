//! Explains why a walk cannot continue, with hints for finding the cause.

use std::collections::BTreeSet;

use pathbuild_diagnostic::messages::{drawing, paths as messages};
use pathbuild_diagnostic::{Diagnostic, Text, Value, words};

use crate::approx::{coincide, grid_square};
use crate::chain::Item;
use crate::element::{Element, diagnostic_point};
use crate::geometry::{Curve, Xy};
use crate::path::{Path, SegmentKind, SubpathName};
use crate::read::TextCircle;
use crate::walk::{MAX_SKIPPED_GAP, OpenEnds, Walker};

/// Tolerance in mm within which a point is considered to be on a curve: the offset is invisible on screen.
const ON_CURVE_TOLERANCE: f64 = 0.001;

impl Walker<'_> {
    pub(super) fn empty_path_problem(&self) -> Diagnostic {
        self.path.start_origin.at(Diagnostic::new(&messages::EMPTY_PATH))
    }

    pub(super) fn nothing_continues(&self) -> Diagnostic {
        if let Some(segment) = self.last.filter(|last| self.is_drawn_twice(*last)) {
            let problem = Diagnostic::new(&messages::DRAWN_TWICE)
                .with("element", self.word(segment))
                .with("point", diagnostic_point(self.ends.of(segment)[0]))
                .with("left", self.left);
            return self.path.origin(&self.path.segments[segment]).at(problem);
        }
        let begin = self.begin_on_another();
        let problem = match begin {
            Some((segment, begin)) => Diagnostic::new(&messages::BEGINS_ON_OTHER)
                .with("element", self.word(segment))
                .with("point", diagnostic_point(begin)),
            None if self.is_dead_end() => Diagnostic::new(&messages::DEAD_END),
            None => Diagnostic::new(&messages::NOTHING_CONTINUES),
        };
        let problem = problem.with("left", self.left);
        let last = self.last.map(|segment| self.path.origin(&self.path.segments[segment]));
        let problem = last.as_ref().unwrap_or(&self.path.start_origin).at(problem);
        let mut problem = self.with_turn_marker_beside(problem);
        problem.place.point = Some(diagnostic_point(self.at));
        if begin.is_some() { problem } else { self.with_hints(problem) }
    }

    /// Returns the nearest segment that was not reached, and the point at which it begins, if that point is in the middle of a traversed segment.
    fn begin_on_another(&self) -> Option<(usize, Xy)> {
        let (segment, begin, _) = self.nearest_end(self.at)?;
        self.segment_through(begin).map(|_| (segment, begin))
    }

    /// Whether the nearest remaining segment branches off at a point that the walk has already passed, and no segment is drawn twice.
    fn is_dead_end(&self) -> bool {
        let Some((_, end, _)) = self.nearest_end(self.at) else { return false };
        self.is_passed(end) && self.duplicate_segment().is_none()
    }

    /// Whether a traversed segment ends at a point.
    fn is_passed(&self, point: Xy) -> bool {
        let mut passed = Vec::new();
        self.ends.find_near(point, |segment| self.is_traversed[segment], &mut passed);
        !passed.is_empty()
    }

    /// Returns the first segment that was not reached although it branches off at a point that the walk passed, with that point.
    fn passed_branch(&self) -> Option<(usize, Xy)> {
        self.unreached_segments().find_map(|segment| {
            let end = self.ends.of(segment).into_iter().find(|end| self.is_passed(*end))?;
            Some((segment, end))
        })
    }

    pub(super) fn turn_found_nothing(&self, marker: usize) -> Diagnostic {
        let problem = Diagnostic::new(&messages::TURN_FOUND_NOTHING).with("left", self.left);
        let problem = self.path.turns[marker].origin.at(problem);
        match self.end_beside_way_back() {
            Some((segment, end, distance)) => problem.note(
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

    /// Returns the end of a remaining segment that is nearest to the traversed segments' ends, with its distance, if that is a small gap.
    fn end_beside_way_back(&self) -> Option<(usize, Xy, f64)> {
        let traversed = (0..self.is_traversed.len()).filter(|segment| self.is_traversed[*segment]);
        let passed = OpenEnds::new(traversed, &self.ends);
        let beside = self.unreached_segments().flat_map(|segment| {
            let ends = self.ends.of(segment).into_iter();
            ends.filter_map(|end| Some((segment, end, passed.distance(end)?))).collect::<Vec<_>>()
        });
        let nearest = beside.reduce(|best, other| if other.2 < best.2 { other } else { best })?;
        (nearest.2 <= MAX_SKIPPED_GAP).then_some(nearest)
    }

    /// Adds a note about the nearest turn marker, if only a small gap separates it from the current point.
    fn with_turn_marker_beside(&self, problem: Diagnostic) -> Diagnostic {
        let distances = self.path.turns.iter().map(|turn| (turn.at, (turn.at - self.at).norm()));
        let nearest = distances.reduce(|best, other| if other.1 < best.1 { other } else { best });
        match nearest.filter(|(_, distance)| *distance <= MAX_SKIPPED_GAP) {
            Some((at, distance)) => problem.note(
                &messages::TURN_MARKER_BESIDE_TIP,
                vec![("point", diagnostic_point(at).into()), ("distance", distance.into())],
            ),
            None => problem,
        }
    }

    pub(super) fn unreached_problem(&self) -> Diagnostic {
        let all = Curves::new(self.path, 0..self.path.segments.len());
        let twice = self.unreached_segments().find(|segment| all.has_duplicate(*segment));
        let one = twice
            .or_else(|| self.unreached_segments().next())
            .map(|segment| (segment, self.ends.of(segment)[0]));
        let mut problem = Diagnostic::new(&messages::UNREACHED);
        let branch = self.passed_branch().filter(|_| twice.is_none());
        if let Some((segment, start)) = branch.or(one) {
            if twice.is_some() {
                problem = Diagnostic::new(&messages::UNREACHED_TWICE);
            } else if branch.is_some() {
                problem = Diagnostic::new(&messages::UNREACHED_BRANCH);
            } else if let Some(other) = self.segment_through(start) {
                problem = if self.word(other) == self.word(segment) {
                    Diagnostic::new(&messages::NO_END_THERE_ALIKE)
                } else {
                    Diagnostic::new(&messages::NO_END_THERE).with("other", self.word(other))
                };
            }
            problem = problem.with("element", self.word(segment)).with("point", diagnostic_point(start));
        }
        let is_told = problem.message == &messages::UNREACHED_TWICE;
        let problem = self.path.end_origin.at(problem.with("left", self.left));
        if is_told { problem } else { self.with_duplicate(problem) }
    }

    /// Returns a traversed segment that passes through a point without ending there.
    fn segment_through(&self, point: Xy) -> Option<usize> {
        let at = TextCircle { centre: point, radius: 0.0 };
        let is_on = |curve: Curve| {
            let beside = match &curve {
                Curve::Line(line) => at.distance_to_line(line),
                Curve::Arc(arc) => at.distance_to_arc(arc),
            };
            let is_end = coincide(curve.start(), point) || coincide(curve.end(), point);
            !is_end && beside.is_some_and(|distance| distance < ON_CURVE_TOLERANCE)
        };
        let mut traversed = (0..self.is_traversed.len()).filter(|segment| self.is_traversed[*segment]);
        traversed.find(|segment| self.path.curve(&self.path.segments[*segment]).is_some_and(is_on))
    }

    pub(super) fn end_not_reached(&self, stopped_at: Xy) -> Diagnostic {
        let problem = match self.duplicate_segment() {
            Some(segment) => Diagnostic::new(&messages::END_NOT_REACHED_TWICE)
                .with("element", self.word(segment))
                .with("begin", diagnostic_point(self.ends.of(segment)[0])),
            None => Diagnostic::new(&messages::END_NOT_REACHED),
        };
        self.path.end_origin.at(problem
            .with("point", diagnostic_point(stopped_at))
            .with("end", diagnostic_point(self.path.end)))
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
        let ends =
            self.unreached_segments().flat_map(|segment| self.ends.of(segment).map(|end| (segment, end)));
        let distances = ends.map(|(segment, end)| (segment, end, (end - point).norm()));
        distances.reduce(|best, other| if other.2 < best.2 { other } else { best })
    }

    fn with_nearest_end(&self, problem: Diagnostic, point: Xy) -> Diagnostic {
        let Some((segment, end, distance)) = self.nearest_end(point) else { return problem };
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
        let traversed = (0..self.is_traversed.len()).filter(|segment| self.is_traversed[*segment]);
        Curves::new(self.path, traversed).has_duplicate(segment)
    }

    /// Returns a segment that lies on a traversed one: either it was not reached, or the walk went along both.
    fn duplicate_segment(&self) -> Option<usize> {
        let traversed = (0..self.is_traversed.len()).filter(|segment| self.is_traversed[*segment]);
        let curves = Curves::new(self.path, traversed.clone());
        self.unreached_segments().chain(traversed).find(|segment| curves.has_duplicate(*segment))
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

/// A key that is equal for curves that lie on each other: the kind of segment, both ends in order of their coordinates, and the midpoint.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct CurveKey(u8, [[i64; 2]; 3]);

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

    /// Returns PB121 for milled segments that lie on each other, unless both have a text: then the user cuts the same curve twice on purpose.
    pub(super) fn milled_twice(&self) -> Vec<Diagnostic> {
        let pairs = self.known.windows(2).filter(|pair| pair[0].0 == pair[1].0);
        let mut twice: Vec<[usize; 2]> =
            pairs.map(|pair| [pair[1].1, pair[0].1]).filter(|pair| self.is_mistake(*pair)).collect();
        twice.sort_unstable();
        twice.into_iter().filter_map(|pair| self.problem(pair)).collect()
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
pub(super) fn embedded_twice(path: &Path, items: &[Item]) -> Vec<Diagnostic> {
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
        let (one, other) = (grid_square(curve.start()), grid_square(curve.end()));
        Some(Self(kind, [one.min(other), one.max(other), grid_square(middle(&curve))]))
    }
}

fn middle(curve: &Curve) -> Xy {
    match curve {
        Curve::Line(line) => nalgebra::center(&line.start, &line.end),
        Curve::Arc(arc) => curve.section(0.0, arc.length() / 2.0).end(),
    }
}
