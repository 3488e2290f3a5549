//! How far apart two placements move a part. (book: language/part)

use super::Part;
use super::intervals::at as at_along;
use crate::geometry::{Curve, Placement};

/// Returns the largest distance in mm between the places that two placements give to a point of a part's outermost ring.
pub fn largest_displacement(part: &Part, one: &Placement, other: &Placement) -> f64 {
    // The distance is a convex function of the point, so the corners suffice; arcs are sampled.
    let samples = |curve: &Curve| {
        let shares: &[f64] = if matches!(curve, Curve::Line(_)) { &[0.0] } else { &[0.0, 0.25, 0.5, 0.75] };
        let (curve, length) = (*curve, curve.length());
        shares.iter().map(move |share| at_along(&curve, share * length))
    };
    let points = part.rings[0].curves.iter().flat_map(samples);
    points.map(|at| (one.place(at) - other.place(at)).norm()).fold(0.0, f64::max)
}
