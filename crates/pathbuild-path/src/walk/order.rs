//! The order of segments that meet at a point. (book: language/chains-and-passes)

use super::ends::Ends;
use crate::approx::near;
use crate::path::Path;

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
pub(super) fn rank(path: &Path, segment: usize) -> (f64, u8) {
    let segment = &path.segments[segment];
    (segment.order, segment.preference())
}

/// The length of a segment for the order at a star.
pub(super) fn length(ends: &Ends, segment: usize) -> f64 {
    let [start, end] = ends.of(segment);
    (end - start).norm()
}
