//! Which segments have an end at a point.

use crate::approx::coincide;
use crate::geometry::Xy;
use crate::path::Segment;

/// The ends of a path's segments, sorted into squares, so that a step of the walk looks at its neighbourhood only.
pub(super) struct Ends(Vec<(Square, u32)>);

/// A column, and a row in it.
type Square = (i64, i64);

/// Side of a square in mm: a few times the distance within which points coincide, so that neighbours of a square suffice.
const SIDE: f64 = 0.0001;

impl Ends {
    pub(super) fn new(segments: &[Segment]) -> Self {
        let mut ends = Vec::with_capacity(2 * segments.len());
        for (index, segment) in segments.iter().enumerate() {
            let index = u32::try_from(index).unwrap_or(u32::MAX);
            let (start, end) = (square(segment.start()), square(segment.end()));
            ends.push((start, index));
            if end != start {
                ends.push((end, index));
            }
        }
        ends.sort_unstable();
        Self(ends)
    }

    /// Segments with an end at a point; one whose ends are close together may be named twice.
    pub(super) fn near<'a>(&'a self, point: Xy, segments: &'a [Segment]) -> impl Iterator<Item = usize> + 'a {
        let (x, y) = square(point);
        let columns = (-1..=1).map(move |dx: i64| x.saturating_add(dx));
        let (low, high) = (y.saturating_sub(1), y.saturating_add(1));
        let named = columns.flat_map(move |column| {
            let first = self.0.partition_point(|(square, _)| *square < (column, low));
            self.0[first..].iter().take_while(move |(square, _)| *square <= (column, high))
        });
        named.map(|(_, index)| *index as usize).filter(move |index| {
            coincide(segments[*index].start(), point) || coincide(segments[*index].end(), point)
        })
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "saturates: all that is so far off falls into one square"
)]
fn square(point: Xy) -> Square {
    ((point.x / SIDE).floor() as i64, (point.y / SIDE).floor() as i64)
}
