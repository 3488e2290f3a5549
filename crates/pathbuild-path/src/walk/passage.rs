//! A segment as it is gone along.

use crate::geometry::{Curve, Line, Xy};
use crate::path::{Path, Segment, SegmentKind};

/// From where the tool is to where it comes.
#[derive(Clone, Debug)]
pub(crate) struct Passage {
    pub(crate) start: Xy,
    pub(crate) end: Xy,
    /// Whether it is gone along against the direction in which it is drawn.
    pub(crate) is_turned: bool,
    /// What is milled, where that is not what is drawn: a gap before it is closed by moving its start.
    pub(crate) moved: Option<Box<Curve>>,
}

impl Passage {
    /// From start to end as drawn.
    pub(super) fn drawn([start, end]: [Xy; 2]) -> Self {
        Self { start, end, is_turned: false, moved: None }
    }

    /// The other way. A subpath is then embedded the other way round: its start comes to lie where the walk comes from.
    pub(super) fn turned_round(self) -> Self {
        self.turned_if(true)
    }

    /// The other way if so. Ends are chosen by number: which way segments are drawn can not be foreseen.
    #[inline]
    pub(super) fn turned_if(mut self, is_turned: bool) -> Self {
        let (ends, first) = ([self.start, self.end], usize::from(is_turned));
        (self.start, self.end) = (ends[first], ends[1 - first]);
        self.is_turned ^= is_turned;
        if let Some(moved) = self.moved.as_mut().filter(|_| is_turned) {
            **moved = moved.reversed();
        }
        self
    }

    /// The same from a point close to its start: the end of a line is moved there.
    pub(super) fn starting_at(self, start: Xy, segment: &Segment) -> Self {
        let line = Curve::Line(Line { start, end: self.end });
        let moved = matches!(segment.kind, SegmentKind::Cut(_)).then(|| Box::new(line));
        Self { start, moved, ..self }
    }

    /// A short line from a point close to its start to its start.
    pub(super) fn lead_in(&self, from: Xy) -> Self {
        let line = Curve::Line(Line { start: from, end: self.start });
        Self { start: from, end: self.start, is_turned: false, moved: Some(Box::new(line)) }
    }
}

/// The curve of a segment in the direction in which it is gone along; `None` for circles.
pub(crate) fn curve(path: &Path, segment: &Segment, is_turned: bool, moved: Option<&Curve>) -> Option<Curve> {
    if let Some(moved) = moved {
        return Some(*moved);
    }
    let drawn = path.curve(segment)?;
    Some(if is_turned { drawn.reversed() } else { drawn })
}
