//! Finds segments that are drawn twice. (book: language/chains-and-passes)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::drawing as messages;

use crate::element::shown;
use crate::geometry::{Curve, Xy};
use crate::path::{Path, SegmentKind};

/// Lines and arcs of a path, sorted so that those that lie on each other are neighbours.
pub(super) struct Curves<'a> {
    path: &'a Path,
    known: Vec<(CurveKey, usize)>,
}

/// Equal for curves that lie on each other: the kind of segment, both ends in order of their coordinates, and the middle.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct CurveKey(u8, [[i64; 2]; 3]);

/// Number of grid squares per mm: programs have three decimals.
const SQUARES: f64 = 1000.0;
/// Offset of the grid in squares, so that points with few decimals, and the middles between them, are not on a border between squares.
const SHIFT: f64 = 0.37;

impl<'a> Curves<'a> {
    /// Collects the milled curves, sweeps and subpaths among these segments.
    pub(super) fn new(path: &'a Path, segments: impl Iterator<Item = usize>) -> Self {
        let keyed = segments.filter_map(|segment| Some((CurveKey::new(path, segment)?, segment)));
        let mut known: Vec<(CurveKey, usize)> = keyed.collect();
        known.sort_unstable();
        Self { path, known }
    }

    /// Whether another curve lies on this segment.
    pub(super) fn have_another(&self, segment: usize) -> bool {
        let Some(key) = CurveKey::new(self.path, segment) else { return false };
        let first = self.known.partition_point(|(other, _)| *other < key);
        let same = self.known[first..].iter().take_while(|(other, _)| *other == key);
        same.take(2).any(|(_, other)| *other != segment)
    }

    /// PB121 for milled segments on top of another of their kind, unless both have a text: then the user milled the same curve twice on
    /// purpose.
    pub(super) fn milled_twice(&self) -> Vec<Diagnostic> {
        let pairs = self.known.windows(2).filter(|pair| pair[0].0 == pair[1].0);
        let mut twice: Vec<usize> =
            pairs.filter(|pair| self.is_mistake(pair[0].1, pair[1].1)).map(|pair| pair[1].1).collect();
        twice.sort_unstable();
        twice.into_iter().filter_map(|segment| self.problem(segment)).collect()
    }

    fn is_mistake(&self, one: usize, other: usize) -> bool {
        let [one, other] = [one, other].map(|segment| {
            let segment = &self.path.segments[segment];
            &self.path.drawn.elements[segment.element as usize]
        });
        one.role == other.role && (one.text.is_none() || other.text.is_none())
    }

    fn problem(&self, segment: usize) -> Option<Diagnostic> {
        let segment = &self.path.segments[segment];
        let SegmentKind::Cut(cut) = &segment.kind else { return None };
        let problem = Diagnostic::new(&messages::CURVE_TWICE)
            .with("element", self.path.cuts[*cut as usize].word())
            .with("point", shown(self.path.ends(segment)[0]));
        Some(self.path.origin(segment).at(problem))
    }
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
        let (one, other) = (square(curve.start()), square(curve.end()));
        Some(Self(kind, [one.min(other), one.max(other), square(middle(&curve))]))
    }
}

fn middle(curve: &Curve) -> Xy {
    match curve {
        Curve::Line(line) => nalgebra::center(&line.start, &line.end),
        Curve::Arc(arc) => curve.section(0.0, arc.length() / 2.0).end(),
    }
}

#[expect(clippy::cast_possible_truncation, reason = "far outside, all squares are one")]
fn square(at: Xy) -> [i64; 2] {
    [at.x, at.y].map(|coordinate| (coordinate * SQUARES + SHIFT).floor() as i64)
}
