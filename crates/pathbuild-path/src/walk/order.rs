//! What comes next at a point: the order of the segments that meet there, and turn markers. (book: language/chains-and-passes, book:
//! language/order-and-turns)
//!
//! The segments of crowded points are sorted once, so that the work of a walk is linear in the number of segments.

use std::collections::BTreeMap;

use crate::approx::{coincide, near};
use crate::geometry::Xy;
use crate::path::Path;
use crate::walk::ends::{Crowd, Ends, Square, Squares, square};

/// Whether a segment is taken before another one. Lengths are compared approximately, which is not transitive, so use this for a single
/// scan in segment order.
pub(super) fn comes_before(path: &Path, ends: &Ends, a: usize, b: usize) -> bool {
    let (ranked, other) = (rank(path, a), rank(path, b));
    if ranked != other {
        return ranked < other;
    }
    let (length, other) = (length(ends, a), length(ends, b));
    if near(length, other) { a < b } else { length < other }
}

/// The order and preference of a segment.
fn rank(path: &Path, segment: usize) -> (f64, u8) {
    let segment = &path.segments[segment];
    (segment.order, segment.preference())
}

/// The length of a segment for the order at a star.
pub(super) fn length(ends: &Ends, segment: usize) -> f64 {
    let [start, end] = ends.of(segment);
    (end - start).norm()
}

/// The crowded points that were visited.
#[derive(Default)]
pub(super) struct Stars(BTreeMap<Squares, Star>);

/// A crowded point.
pub(super) struct Star {
    /// The corners of the bounding box of the ends that meet here.
    corners: [Xy; 2],
    /// Groups in reverse order, so that the next one is last.
    groups: Vec<Group>,
}

/// Segments with the same order and preference and with similar lengths.
struct Group {
    /// The segments in file order.
    segments: Vec<usize>,
    /// Number of leading segments that are known to be traversed.
    traversed: usize,
    /// Whether all pairs of lengths are near each other.
    is_level: bool,
}

impl Stars {
    /// The star at a point, if it is known to be crowded.
    pub(super) fn at(&mut self, point: Xy) -> Option<&mut Star> {
        if self.0.is_empty() {
            return None;
        }
        let star = self.0.get_mut(&Squares::around(point))?;
        star.corners.iter().all(|corner| coincide(*corner, point)).then_some(star)
    }

    /// Records that these segments meet at a point.
    pub(super) fn insert(&mut self, point: Xy, crowd: Crowd, path: &Path, ends: &Ends) {
        self.0.insert(Squares::around(point), Star::new(crowd, path, ends));
    }
}

impl Star {
    fn new(crowd: Crowd, path: &Path, ends: &Ends) -> Self {
        let Crowd { corners, mut segments } = crowd;
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

    /// The next segment. Since lengths in different groups are not near each other, scanning the first group gives the same result as
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
    /// For each marker, the first one at exactly the same point.
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

    /// The first marker at a point. Markers at the same point count as one: all of them are marked as used.
    pub(super) fn act(&mut self, path: &Path, at: Xy) -> Option<usize> {
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

    /// The markers that were never used.
    pub(super) fn idle(&self) -> impl Iterator<Item = usize> {
        (0..self.first.len()).filter(|turn| !self.has_acted[self.first[*turn]])
    }
}
