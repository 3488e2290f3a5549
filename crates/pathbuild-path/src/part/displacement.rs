//! How far apart two placements move a part. (book: language/part)

use super::Part;
use crate::geometry::{Curve, Placement};

/// Returns the largest distance in mm between the places that two placements give to a point of a part's outermost ring.
pub fn largest_displacement(part: &Part, one: &Placement, other: &Placement) -> f64 {
    // The distance is a convex function of the point, so that of a line is largest at one of its ends. Arcs are sampled.
    let points = part.rings[0].curves.iter().flat_map(Curve::quarters);
    points.map(|at| (one.place(at) - other.place(at)).norm()).fold(0.0, f64::max)
}
