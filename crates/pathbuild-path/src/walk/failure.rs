//! Why a walk does not arrive, and what helps to see it.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::walk as messages;

use super::Walk;
use crate::approx::coincide;
use crate::element::shown;
use crate::geometry::Xy;
use crate::path::{Segment, SegmentKind};

impl Walk<'_> {
    pub(super) fn empty(&self) -> Diagnostic {
        self.path.start_origin.at(Diagnostic::new(&messages::EMPTY_PATH))
    }

    pub(super) fn nothing_continues(&self) -> Diagnostic {
        let problem = Diagnostic::new(&messages::NOTHING_CONTINUES).with("left", self.left);
        let last = self.steps.last().map(|step| &self.path.segments[step.segment].origin);
        let mut problem = last.unwrap_or(&self.path.start_origin).at(problem);
        problem.place.point = Some(shown(self.at));
        self.with_hints(problem)
    }

    pub(super) fn turn_found_nothing(&self, marker: usize) -> Diagnostic {
        let problem = Diagnostic::new(&messages::TURN_FOUND_NOTHING).with("left", self.left);
        self.with_hints(self.path.turns[marker].origin.at(problem))
    }

    pub(super) fn unreached(&self) -> Diagnostic {
        let one = self.open().next();
        let mut problem = Diagnostic::new(&messages::UNREACHED).with("left", self.left);
        if let Some(segment) = one {
            problem = problem.with("element", word(segment)).with("point", shown(segment.start()));
        }
        self.with_duplicate(self.path.end_origin.at(problem))
    }

    pub(super) fn end_not_reached(&self, stopped_at: Xy) -> Diagnostic {
        let problem = Diagnostic::new(&messages::END_NOT_REACHED)
            .with("point", shown(stopped_at))
            .with("end", shown(self.path.end));
        self.path.end_origin.at(problem)
    }

    fn open(&self) -> impl Iterator<Item = &Segment> {
        self.path
            .segments
            .iter()
            .zip(&self.is_traversed)
            .filter(|(_, traversed)| !**traversed)
            .map(|(open, _)| open)
    }

    fn with_hints(&self, problem: Diagnostic) -> Diagnostic {
        let point = problem.place.point.map_or(self.at, |point| Xy::new(point.x.0, point.y.0));
        let problem = self.with_nearest_end(problem, point);
        self.with_left_out(self.with_duplicate(problem), point)
    }

    fn with_nearest_end(&self, problem: Diagnostic, point: Xy) -> Diagnostic {
        let ends = self.open().flat_map(|segment| [(segment, segment.start()), (segment, segment.end())]);
        let distances = ends.map(|(segment, end)| (segment, end, (end - point).norm()));
        let nearest = distances.reduce(|best, other| if other.2 < best.2 { other } else { best });
        let Some((segment, end, distance)) = nearest else { return problem };
        problem.note(
            &messages::NEAREST_END,
            vec![
                ("point", shown(end).into()),
                ("distance", distance.into()),
                ("element", word(segment).into()),
            ],
        )
    }

    /// A segment drawn twice is left over, and looks just like the one that was traversed.
    fn with_duplicate(&self, problem: Diagnostic) -> Diagnostic {
        let segments = &self.path.segments;
        let duplicate = self.open().find(|open| {
            let mut beside = self.ends.near(open.start(), segments);
            beside.any(|other| self.is_traversed[other] && is_same_curve(open, &segments[other]))
        });
        let Some(segment) = duplicate else { return problem };
        problem.note(
            &messages::DUPLICATE,
            vec![("element", word(segment).into()), ("point", shown(segment.start()).into())],
        )
    }

    fn with_left_out(&self, problem: Diagnostic, point: Xy) -> Diagnostic {
        let distance = |begin: &pathbuild_diagnostic::Point| (Xy::new(begin.x.0, begin.y.0) - point).norm();
        let nearest = self
            .path
            .left_out
            .iter()
            .reduce(|best, other| if distance(&other.1) < distance(&best.1) { other } else { best });
        let Some((kind, begin)) = nearest else { return problem };
        problem.note(&messages::LEFT_OUT_HERE, vec![("kind", kind.name().into()), ("point", (*begin).into())])
    }
}

fn is_same_curve(a: &Segment, b: &Segment) -> bool {
    let (SegmentKind::Cut(first), SegmentKind::Cut(second)) = (&a.kind, &b.kind) else { return false };
    let ends = |segment: &Segment| (segment.start(), segment.end());
    let ((a, b), (c, d)) = (ends(a), ends(b));
    let is_between_same = (coincide(a, c) && coincide(b, d)) || (coincide(a, d) && coincide(b, c));
    is_between_same && crate::approx::near(first.curve.length(), second.curve.length())
}

fn word(segment: &Segment) -> &'static pathbuild_diagnostic::Word {
    use pathbuild_diagnostic::words;
    match &segment.kind {
        SegmentKind::Cut(cut) => match cut.cut {
            crate::Cut::Mill => &words::MILLING_SEGMENT,
            crate::Cut::Mark => &words::MARKING_SEGMENT,
            crate::Cut::Support => &words::SUPPORT_SEGMENT,
        },
        SegmentKind::Hole(_) => &words::DRILLED_HOLE,
        SegmentKind::Helix(_) => &words::HELICAL_CIRCLE,
        SegmentKind::Sweep(_) => &words::SWEEP,
        SegmentKind::Subpath(_) => &words::SUBPATH,
    }
}
