//! Which segments have an end at a point.

use std::collections::HashMap;

use crate::approx::coincide;
use crate::geometry::Xy;
use crate::path::Segment;

/// The ends of a path's segments, sorted into squares, so that a step of the walk looks at its neighbourhood only.
///
/// The map is only looked up, never iterated, so its order reaches nothing.
pub(super) struct Ends(HashMap<(i64, i64), Vec<u32>>);

/// Side of a square in mm: a few times the distance within which points coincide, so that neighbours of a square suffice.
const SIDE: f64 = 0.0001;

impl Ends {
    pub(super) fn new(segments: &[Segment]) -> Self {
        let mut squares: HashMap<_, Vec<u32>> = HashMap::with_capacity(segments.len());
        for (index, segment) in segments.iter().enumerate() {
            let index = u32::try_from(index).unwrap_or(u32::MAX);
            let (start, end) = (square(segment.start()), square(segment.end()));
            squares.entry(start).or_default().push(index);
            if end != start {
                squares.entry(end).or_default().push(index);
            }
        }
        Self(squares)
    }

    /// Segments with an end at a point; one whose ends are close together may be named twice.
    pub(super) fn near<'a>(&'a self, point: Xy, segments: &'a [Segment]) -> impl Iterator<Item = usize> + 'a {
        let (x, y) = square(point);
        let squares = (-1..=1).flat_map(move |dx: i64| {
            (-1..=1).map(move |dy: i64| (x.saturating_add(dx), y.saturating_add(dy)))
        });
        let named = squares.filter_map(|square| self.0.get(&square)).flatten().map(|index| *index as usize);
        named.filter(move |index| {
            coincide(segments[*index].start(), point) || coincide(segments[*index].end(), point)
        })
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "saturates: all that is so far off falls into one square"
)]
fn square(point: Xy) -> (i64, i64) {
    ((point.x / SIDE).floor() as i64, (point.y / SIDE).floor() as i64)
}
