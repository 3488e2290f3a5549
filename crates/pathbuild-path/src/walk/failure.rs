//! Why a walk does not arrive, and what helps to see it.

use pathbuild_diagnostic::messages::walk as messages;
use pathbuild_diagnostic::{Diagnostic, Word, words};

use super::Walk;
use super::twice::Curves;
use crate::element::shown;
use crate::geometry::Xy;
use crate::path::SegmentKind;

impl Walk<'_> {
    pub(super) fn empty(&self) -> Diagnostic {
        self.path.start_origin.at(Diagnostic::new(&messages::EMPTY_PATH))
    }

    pub(super) fn nothing_continues(&self) -> Diagnostic {
        let problem = Diagnostic::new(&messages::NOTHING_CONTINUES).with("left", self.left);
        let last = self.last.map(|segment| self.path.origin(&self.path.segments[segment]));
        let mut problem = last.as_ref().unwrap_or(&self.path.start_origin).at(problem);
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
            let [start, _] = self.ends.of(segment);
            problem = problem.with("element", self.word(segment)).with("point", shown(start));
        }
        self.with_duplicate(self.path.end_origin.at(problem))
    }

    pub(super) fn end_not_reached(&self, stopped_at: Xy) -> Diagnostic {
        let problem = Diagnostic::new(&messages::END_NOT_REACHED)
            .with("point", shown(stopped_at))
            .with("end", shown(self.path.end));
        self.path.end_origin.at(problem)
    }

    /// The segments that were not reached.
    pub(super) fn open(&self) -> impl Iterator<Item = usize> {
        let open = self.is_traversed.iter().enumerate().filter(|(_, traversed)| !**traversed);
        open.map(|(segment, _)| segment)
    }

    fn with_hints(&self, problem: Diagnostic) -> Diagnostic {
        let point = problem.place.point.map_or(self.at, |point| Xy::new(point.x.0, point.y.0));
        let problem = self.with_nearest_end(problem, point);
        self.with_left_out(self.with_duplicate(problem), point)
    }

    fn with_nearest_end(&self, problem: Diagnostic, point: Xy) -> Diagnostic {
        let ends = self.open().flat_map(|segment| self.ends.of(segment).map(|end| (segment, end)));
        let distances = ends.map(|(segment, end)| (segment, end, (end - point).norm()));
        let nearest = distances.reduce(|best, other| if other.2 < best.2 { other } else { best });
        let Some((segment, end, distance)) = nearest else { return problem };
        problem.note(
            &messages::NEAREST_END,
            vec![
                ("point", shown(end).into()),
                ("distance", distance.into()),
                ("element", self.word(segment).into()),
            ],
        )
    }

    /// A segment drawn twice is left over, and looks just like the one that was traversed.
    fn with_duplicate(&self, problem: Diagnostic) -> Diagnostic {
        let traversed = (0..self.is_traversed.len()).filter(|segment| self.is_traversed[*segment]);
        let curves = Curves::new(self.path, &self.ends, traversed.clone());
        // There and back over a line that is drawn twice nothing is left over.
        let Some(segment) = self.open().chain(traversed).find(|segment| curves.have_another(*segment)) else {
            return problem;
        };
        let [start, _] = self.ends.of(segment);
        problem.note(
            &messages::DUPLICATE,
            vec![("element", self.word(segment).into()), ("point", shown(start).into())],
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

    fn word(&self, segment: usize) -> &'static Word {
        match &self.path.segments[segment].kind {
            SegmentKind::Cut(number) => self.path.cuts[*number as usize].word(),
            SegmentKind::Hole(_) => &words::DRILLED_HOLE,
            SegmentKind::Helix(_) => &words::HELICAL_CIRCLE,
            SegmentKind::Sweep { .. } => &words::SWEEP,
            SegmentKind::Subpath(_) => &words::SUBPATH,
        }
    }
}
