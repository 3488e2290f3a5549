//! The passage of the tool along a segment.

use crate::geometry::{Curve, Line, Xy};
use crate::path::{Path, Segment, SegmentKind};

/// A segment in walking direction.
#[derive(Clone, Debug)]
pub(crate) struct Passage {
    pub(crate) start: Xy,
    pub(crate) end: Xy,
    /// Whether it runs against the drawn direction.
    pub(crate) is_turned: bool,
    /// The milled curve if it differs from the drawn one, because the start was moved to close a gap.
    pub(crate) moved: Option<Box<Curve>>,
}

impl Passage {
    /// The passage in the drawn direction.
    pub(super) fn drawn([start, end]: [Xy; 2]) -> Self {
        Self { start, end, is_turned: false, moved: None }
    }

    /// The passage in the opposite direction. A subpath is then embedded the other way round, so that its start is where the walk comes
    /// from.
    pub(super) fn turned_round(self) -> Self {
        self.turned_if(true)
    }

    /// The passage in the opposite direction if `is_turned`. Ends are selected by index, since the direction is unpredictable for a branch.
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

    /// The passage from a point close to its start, for which the end of a line is moved.
    pub(super) fn starting_at(self, start: Xy, segment: &Segment) -> Self {
        let line = Curve::Line(Line { start, end: self.end });
        let moved = matches!(segment.kind, SegmentKind::Cut(_)).then(|| Box::new(line));
        Self { start, moved, ..self }
    }

    /// A short line from a nearby point to the start of the passage.
    pub(super) fn lead_in(&self, from: Xy) -> Self {
        let line = Curve::Line(Line { start: from, end: self.start });
        Self { start: from, end: self.start, is_turned: false, moved: Some(Box::new(line)) }
    }
}

/// The curve of a segment in walking direction; `None` for circles.
pub(crate) fn curve(path: &Path, segment: &Segment, is_turned: bool, moved: Option<&Curve>) -> Option<Curve> {
    if let Some(moved) = moved {
        return Some(*moved);
    }
    let drawn = path.curve(segment)?;
    Some(if is_turned { drawn.reversed() } else { drawn })
}
