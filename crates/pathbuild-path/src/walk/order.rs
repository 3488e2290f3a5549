//! Determines the next segment at a point: the segments that end there, their order, and turn markers. (book: language/chains-and-passes, book:
//! language/order-and-turns)
//!
//! The segments of points at which many meet (junctions) are sorted once, so that the work of a walk is linear in the number of segments.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::approx::{coincide, near};
use crate::geometry::Xy;
use crate::path::Path;

/// Whether segment `a` comes before segment `b`. Lengths are compared approximately, which is not transitive, so use this only in a single scan in
/// segment order.
pub(super) fn comes_before(path: &Path, ends: &Ends, a: usize, b: usize) -> bool {
    let (ranked, other) = (rank(path, a), rank(path, b));
    if ranked != other {
        return ranked < other;
    }
    let (length, other) = (length(ends, a), length(ends, b));
    if near(length, other) { a < b } else { length < other }
}

/// Returns the key by which segments that meet at a point are ordered first: the number from the drawing (N), then the preference for its kind.
fn rank(path: &Path, segment: usize) -> (f64, u8) {
    let segment = &path.segments[segment];
    (segment.order, segment.preference())
}

/// Returns the distance between the ends of a segment, by which segments that meet at a point are ordered.
pub(super) fn length(ends: &Ends, segment: usize) -> f64 {
    let [start, end] = ends.of(segment);
    (end - start).norm()
}

/// The junctions that were visited.
#[derive(Default)]
pub(super) struct Junctions(BTreeMap<Squares, Junction>);

/// A point at which many segments meet (more than `MAX_SCANNED_SEGMENTS` untraversed ones), with these segments in groups.
pub(super) struct Junction {
    /// The corners of the bounding box of the ends that meet here.
    corners: [Xy; 2],
    /// Groups in reverse order, so that the next one is last.
    groups: Vec<Group>,
}

/// Segments with the same order and preference and with similar lengths.
struct Group {
    /// The segments in ascending order.
    segments: Vec<usize>,
    /// Number of leading segments that are known to be traversed.
    traversed: usize,
    /// Whether the lengths of any two of these segments are near each other.
    is_level: bool,
}

impl Junctions {
    pub(super) fn at(&mut self, point: Xy) -> Option<&mut Junction> {
        if self.0.is_empty() {
            return None;
        }
        let junction = self.0.get_mut(&Squares::around(point))?;
        junction.corners.iter().all(|corner| coincide(*corner, point)).then_some(junction)
    }

    /// Records that these segments meet at a point.
    pub(super) fn insert(&mut self, point: Xy, segments: JunctionSegments, path: &Path, ends: &Ends) {
        self.0.insert(Squares::around(point), Junction::new(segments, path, ends));
    }
}

impl Junction {
    fn new(segments: JunctionSegments, path: &Path, ends: &Ends) -> Self {
        let JunctionSegments { corners, mut segments } = segments;
        let key = |segment: &usize| {
            let (order, preference) = rank(path, *segment);
            // Adding 0 removes the sign of a negative zero.
            (order + 0.0, preference, length(ends, *segment))
        };
        segments.sort_by(|a, b| {
            let ((order, preference, length), (other_order, other_preference, other_length)) =
                (key(a), key(b));
            let ranks = order.total_cmp(&other_order).then(preference.cmp(&other_preference));
            ranks.then(length.total_cmp(&other_length)).then(a.cmp(b))
        });
        let is_near = |a: &usize, b: &usize| {
            rank(path, *a) == rank(path, *b) && near(length(ends, *a), length(ends, *b))
        };
        let groups = segments.chunk_by(is_near).rev().map(|group| {
            let is_level = is_near(&group[0], &group[group.len() - 1]);
            let mut segments = group.to_vec();
            segments.sort_unstable();
            Group { segments, traversed: 0, is_level }
        });
        Self { corners, groups: groups.collect() }
    }

    /// Returns the next segment. Since lengths in different groups are not near each other, scanning the first group gives the same result as
    /// scanning all segments.
    pub(super) fn next(&mut self, path: &Path, ends: &Ends, is_traversed: &[bool]) -> Option<usize> {
        while let Some(group) = self.groups.last_mut() {
            group.pass(is_traversed);
            let mut open =
                group.segments[group.traversed..].iter().copied().filter(|segment| !is_traversed[*segment]);
            let Some(first) = open.next() else {
                self.groups.pop();
                continue;
            };
            if group.is_level {
                return Some(first);
            }
            return Some(open.fold(
                first,
                |best, other| if comes_before(path, ends, other, best) { other } else { best },
            ));
        }
        None
    }
}

impl Group {
    fn pass(&mut self, is_traversed: &[bool]) {
        let passed = self.segments[self.traversed..].iter().take_while(|segment| is_traversed[**segment]);
        self.traversed += passed.count();
    }
}

/// The turn markers of a path, as indices into [`Path::turns`].
pub(super) struct Turns {
    /// The markers in each square; of several at exactly the same point only the first.
    squares: BTreeMap<Square, Vec<usize>>,
    /// For each marker, the index of the first one at exactly the same point.
    first: Vec<usize>,
    has_acted: Vec<bool>,
}

impl Turns {
    pub(super) fn new(path: &Path) -> Self {
        let (mut squares, mut known) = (BTreeMap::<_, Vec<usize>>::new(), BTreeMap::new());
        let mut first = |(number, at): (usize, Xy)| {
            *known.entry([at.x.to_bits(), at.y.to_bits()]).or_insert_with(|| {
                squares.entry(square(at)).or_default().push(number);
                number
            })
        };
        let first = path.turns.iter().map(|turn| turn.at).enumerate().map(&mut first).collect();
        Self { squares, first, has_acted: vec![false; path.turns.len()] }
    }

    /// Marks the turn markers at a point as used and returns the first of them. Markers at the same point are treated as one.
    pub(super) fn use_marker(&mut self, path: &Path, at: Xy) -> Option<usize> {
        let mut found: Option<usize> = None;
        for square in Squares::around(at).each() {
            for turn in self.squares.get(&square).into_iter().flatten() {
                if coincide(path.turns[*turn].at, at) {
                    self.has_acted[*turn] = true;
                    found = Some(found.map_or(*turn, |first| first.min(*turn)));
                }
            }
        }
        found
    }

    pub(super) fn unused(&self) -> impl Iterator<Item = usize> {
        (0..self.first.len()).filter(|turn| !self.has_acted[self.first[*turn]])
    }
}

/// The ends of a path's segments in a grid of squares, so that each step of the walk examines only its neighbourhood.
#[derive(Default)]
pub(super) struct Ends {
    segments: Vec<SegmentEnds>,
    /// The first end in each bucket of squares, see [`bucket_of`]. The number of buckets is a power of two.
    buckets: Vec<u32>,
}

/// The ends of a segment, with links to further ends.
struct SegmentEnds {
    drawn: [Xy; 2],
    /// For each end, the next end in the same bucket. An end is numbered by twice its segment's number, plus one for the second end.
    next: [u32; 2],
}

/// A square as column and row, see [`grid_index`].
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Square(u64, u64);

/// The squares around a point: one, or up to four near their borders.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Squares {
    first: Square,
    /// The column and the row after the last ones.
    end: Square,
}

/// Segments that meet at a point. They also meet at every other point that coincides with both corners of the bounding box of their ends.
pub(super) struct JunctionSegments {
    pub(super) corners: [Xy; 2],
    pub(super) segments: Vec<usize>,
}

/// Value that marks the last end in a bucket.
const END_OF_BUCKET: u32 = u32::MAX;
/// Number of buckets per segment. With half as many, more than a few buckets would contain ends from elsewhere.
const BUCKETS_PER_SEGMENT: usize = 4;
/// Number of squares per mm. A square has room for only a few points that do not coincide, which bounds the work of a step.
const SQUARES_PER_MM: f64 = 5000.0;
/// Offset of the grid in squares: drawings mostly use round numbers with up to four decimals, and points on a border between squares need
/// two lookups.
const GRID_OFFSET: f64 = 0.25;
/// Search distance around a point in squares: slightly more than the distance at which points coincide (0.16).
const SEARCH_DISTANCE: f64 = 0.22;
/// Search distance in squares for points that coincide with a point only by way of others, each of which coincides with the next: slightly more
/// than three times the distance at which points coincide.
const WIDE_SEARCH_DISTANCE: f64 = 0.5;
/// Addend so large that adding it rounds to an integer: the low bits of the sum count whole numbers. (1.5 * 2^52)
const ROUNDING_ADDEND: f64 = 6_755_399_441_055_744.0;

impl Ends {
    pub(super) fn new(path: &Path) -> Self {
        Self::of_segments(path.segments.iter().map(|segment| path.ends(segment)))
    }

    fn of_segments(drawn: impl ExactSizeIterator<Item = [Xy; 2]>) -> Self {
        let count = (BUCKETS_PER_SEGMENT * drawn.len()).next_power_of_two();
        let mut buckets = vec![END_OF_BUCKET; count];
        let segment = |(number, drawn): (u32, [Xy; 2])| {
            let mut enter = |end: u32| {
                let bucket = bucket_of(square(drawn[end as usize]), count);
                std::mem::replace(&mut buckets[bucket], 2 * number + end)
            };
            SegmentEnds { drawn, next: [enter(0), enter(1)] }
        };
        let segments = (0_u32..).zip(drawn).map(segment).collect();
        Self { segments, buckets }
    }

    /// Returns the start and end of a segment as drawn.
    pub(super) fn of(&self, segment: usize) -> [Xy; 2] {
        self.segments[segment].drawn
    }

    /// Finds the wanted segments with an end at a point, in any order and possibly with duplicates.
    pub(super) fn find_near(&self, point: Xy, is_wanted: impl Fn(usize) -> bool, found: &mut Vec<usize>) {
        found.clear();
        for square in Squares::around(point).each() {
            self.each_in(square, |segment, end| {
                if coincide(self.segments[segment].drawn[end], point) && is_wanted(segment) {
                    found.push(segment);
                }
            });
        }
    }

    /// Returns the wanted segments with an end at a point; `None` if there are other ends so close that another nearby point may have different
    /// segments.
    pub(super) fn junction_segments(
        &self,
        point: Xy,
        is_wanted: impl Fn(usize) -> bool,
    ) -> Option<JunctionSegments> {
        let ([mut low, mut high], mut segments, mut is_alone) = ([point; 2], Vec::new(), true);
        for square in Squares::within(WIDE_SEARCH_DISTANCE, point).each() {
            self.each_in(square, |segment, end| {
                let end = self.segments[segment].drawn[end];
                if coincide(end, point) && is_wanted(segment) {
                    (low, high) = (low.inf(&end), high.sup(&end));
                    segments.push(segment);
                } else if is_wanted(segment) {
                    is_alone &= !coincide(point + (end - point) / 3.0, point);
                }
            });
        }
        segments.sort_unstable();
        segments.dedup();
        (is_alone && coincide(low, high)).then_some(JunctionSegments { corners: [low, high], segments })
    }

    /// Calls `take` for the ends in a square, and for all other ends in the same bucket.
    fn each_in(&self, square: Square, mut take: impl FnMut(usize, usize)) {
        let mut at = self.buckets[bucket_of(square, self.buckets.len())];
        while at != END_OF_BUCKET {
            let (segment, end) = (at as usize / 2, at as usize % 2);
            take(segment, end);
            at = self.segments[segment].next[end];
        }
    }
}

impl Squares {
    pub(super) fn around(point: Xy) -> Self {
        Self::within(SEARCH_DISTANCE, point)
    }

    fn within(reach: f64, point: Xy) -> Self {
        let (columns, rows) = (grid_indices_around(point.x, reach), grid_indices_around(point.y, reach));
        Self { first: Square(columns.start, rows.start), end: Square(columns.end, rows.end) }
    }

    pub(super) fn each(self) -> impl Iterator<Item = Square> {
        let Self { first, end } = self;
        (first.0..end.0).flat_map(move |column| (first.1..end.1).map(move |row| Square(column, row)))
    }
}

pub(super) fn square(point: Xy) -> Square {
    Square(grid_index(in_squares(point.x)), grid_index(in_squares(point.y)))
}

/// Returns the columns or rows near a coordinate: one, or two near a border.
fn grid_indices_around(coordinate: f64, reach: f64) -> Range<u64> {
    let place = in_squares(coordinate);
    let from_middle = place - (place + ROUNDING_ADDEND - ROUNDING_ADDEND);
    let (is_first, is_last) = (from_middle < reach - 0.5, from_middle > 0.5 - reach);
    let index = grid_index(place);
    index.wrapping_sub(is_first.into())..index.wrapping_add(is_last.into()).wrapping_add(1)
}

fn in_squares(coordinate: f64) -> f64 {
    coordinate * SQUARES_PER_MM + GRID_OFFSET
}

/// Returns the number of the column or row that contains a coordinate; adjacent ones differ by one. Very far from the origin they are wider, but
/// there only equal points coincide.
fn grid_index(place: f64) -> u64 {
    (place + ROUNDING_ADDEND).to_bits()
}

/// Returns the bucket of a square. The upper bits of a product depend on all bits of its factors.
fn bucket_of(Square(column, row): Square, count: usize) -> usize {
    const MULTIPLIER: u64 = 0x9E37_79B9_7F4A_7C15;
    let mixed = column.wrapping_mul(MULTIPLIER).rotate_left(32) ^ row;
    (mixed.wrapping_mul(MULTIPLIER) >> 32) as usize & (count - 1)
}

#[cfg(test)]
mod tests {
    //! Tests of the number of ends examined, and of the search distance.

    use nalgebra::Vector2;
    use proptest::prelude::*;

    use super::{Ends, Squares};
    use crate::approx::coincide;
    use crate::geometry::Xy;

    /// Counts the ends that are examined when each end is queried for its neighbours.
    fn examined_ends(points: &[Xy]) -> usize {
        let ends = Ends::of_segments(points.iter().map(|point| [*point; 2]));
        let mut count = 0;
        for point in points {
            for square in Squares::around(*point).each() {
                ends.each_in(square, |_, _| count += 1);
            }
        }
        count
    }

    /// Returns points in a grid of 0.00004 mm, none of which coincide.
    fn crowd(side: u32) -> Vec<Xy> {
        const APART: f64 = 0.000_04;
        let at = |number: u32| APART * f64::from(number);
        let point = |number: u32| Xy::new(at(number % side), at(number / side));
        let points: Vec<Xy> = (0..side * side).map(point).collect();
        assert!(!coincide(points[0], points[1]));
        points
    }

    /// The number of comparisons must grow in proportion to the number of ends, even if all ends are less than 0.1 mm apart.
    #[test]
    fn ends_that_lie_close_but_do_not_meet_are_not_compared() {
        let (one, four) = (examined_ends(&crowd(50)), examined_ends(&crowd(100)));
        assert!(four <= 5 * one, "{one}, {four}");
        assert!(one <= 100 * 2500, "{one}");
    }

    /// Generates a point, and another one at this distance in a random direction.
    fn apart(distance: f64) -> impl Strategy<Value = [Xy; 2]> {
        let coordinate = || {
            prop_oneof![-0.01..0.01, -9000.0..9000.0, (-90..90).prop_map(|tenths| f64::from(tenths) / 10.0)]
        };
        (coordinate(), coordinate(), 0.0..360.0_f64).prop_map(move |(x, y, angle)| {
            let direction = Vector2::new(libm::cos(angle.to_radians()), libm::sin(angle.to_radians()));
            [Xy::new(x, y), Xy::new(x, y) + direction * distance]
        })
    }

    /// Approximate distance in mm below which points coincide.
    const COINCIDENCE_DISTANCE: f64 = 0.000_031_6;

    fn ends([one, other]: [Xy; 2]) -> Ends {
        Ends::of_segments([[one; 2], [other; 2]].into_iter())
    }

    fn found(points: [Xy; 2]) -> Vec<usize> {
        let mut found = Vec::new();
        ends(points).find_near(points[0], |_| true, &mut found);
        found.sort_unstable();
        found.dedup();
        found
    }

    fn is_alone(points: [Xy; 2]) -> bool {
        ends(points).junction_segments(points[0], |_| true).is_some_and(|found| found.segments == [0])
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 512, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn ends_that_meet_are_found_whatever_square_they_are_in(
            inside in apart(0.999 * COINCIDENCE_DISTANCE),
            outside in apart(1.003 * COINCIDENCE_DISTANCE),
        ) {
            prop_assert_eq!(found(inside), [0, 1]);
            prop_assert_eq!(found(outside), [0]);
        }

        #[test]
        fn who_may_meet_a_third_at_a_point_is_seen(
            inside in apart(2.99 * COINCIDENCE_DISTANCE),
            outside in apart(3.01 * COINCIDENCE_DISTANCE),
        ) {
            prop_assert!(!is_alone(inside));
            prop_assert!(is_alone(outside));
        }
    }
}
