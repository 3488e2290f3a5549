//! The approximate comparisons of book: language/markers.
//!
//! Coordinates come from CAD exports, so equality is approximate. It is not transitive: use these functions to find minima in a single
//! scan, but never to sort.

use nalgebra::Point2;

/// Whether two numbers are equal up to rounding.
pub fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-6 * (a.abs().max(b.abs()) + 0.001)
}

/// Whether `a >= b`, approximately.
pub fn at_least(a: f64, b: f64) -> bool {
    a >= b || near(a, b)
}

/// Whether `a > b`, approximately: false if they are near each other.
pub fn above(a: f64, b: f64) -> bool {
    a > b && !near(a, b)
}

/// Whether `a > b` in a program, that is, with three decimals.
pub fn is_written_above(a: f64, b: f64) -> bool {
    (a * 1000.0).round() > (b * 1000.0).round()
}

/// Whether two points coincide: their distance is at most about 0.0000316 mm. Used for ends of segments, for markers and in the walk.
pub fn coincide(a: Point2<f64>, b: Point2<f64>) -> bool {
    near((b - a).norm_squared(), 0.0)
}

/// Whether a distance in mm is negligible (at most about 1e-9 mm), so that a move of this length can be left out.
pub fn is_negligible(distance: f64) -> bool {
    near(distance, 0.0)
}

/// Number of grid squares per mm: programs have three decimals.
const SQUARES_PER_MM: f64 = 1000.0;
/// Offset of the grid in squares, so that points with few decimals, and the midpoints between them, are not on a border between squares.
const GRID_OFFSET: f64 = 0.37;

/// Returns the grid square that contains a point. Points that coincide are in the same square, unless a border between squares separates them.
#[expect(clippy::cast_possible_truncation, reason = "coordinates beyond i64 share the outermost square")]
pub(crate) fn grid_square(at: Point2<f64>) -> [i64; 2] {
    [at.x, at.y].map(|coordinate| (coordinate * SQUARES_PER_MM + GRID_OFFSET).floor() as i64)
}
