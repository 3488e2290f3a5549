//! Approximates smooth curves by lines and arcs within a tolerance.

use super::biarc::{CurvePiece, Ray, biarc};
use super::vector::Vector;
use crate::Geometry;

/// A curve that is smooth over the interval in question.
pub(crate) trait Curve {
    /// The point at a parameter, and the derivative there.
    fn at(&self, parameter: f64) -> (Vector, Vector);
}

/// Limits of an approximation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tolerance {
    /// Largest distance in mm between the curve and its pieces.
    pub(crate) distance: f64,
    /// Largest number of pieces.
    pub(crate) most_pieces: usize,
}

/// Why a curve cannot be approximated.
pub(crate) enum NoPieces {
    /// It would take more pieces than the limit allows.
    TooMany,
    /// It reaches beyond the largest coordinate of a drawing.
    TooFar,
}

/// Number of sample points per span of two arcs.
const SAMPLES: u32 = 24;

/// Safety factor: between two samples the distance may be slightly larger than at both.
const MARGIN: f64 = 0.9;

/// Number of halvings after which a piece becomes a line whatever its distance: shorter spans differ only by rounding.
const DEEPEST: u32 = 24;

/// Appends the pieces of a curve between two parameters.
pub(crate) fn approximate(
    curve: &impl Curve,
    [from, to]: [f64; 2],
    z: f64,
    tolerance: Tolerance,
    pieces: &mut Vec<Geometry>,
) -> Result<(), NoPieces> {
    let mut steps = tolerance.most_pieces.saturating_mul(2);
    let mut spans = vec![(from, to, 0)];
    while let Some((from, to, depth)) = spans.pop() {
        steps = steps.checked_sub(1).ok_or(NoPieces::TooMany)?;
        if let Some(fitting) = fit(curve, from, to, tolerance.distance) {
            pieces.extend(fitting.iter().filter_map(|piece| piece.geometry(z)));
        } else if depth == DEEPEST {
            pieces.extend(CurvePiece::line(curve.at(from).0, curve.at(to).0).geometry(z));
        } else {
            let middle = f64::midpoint(from, to);
            spans.push((middle, to, depth + 1));
            spans.push((from, middle, depth + 1));
        }
    }
    if pieces.len() > tolerance.most_pieces { Err(NoPieces::TooMany) } else { Ok(()) }
}

/// The biarc that matches the ends and directions of the curve, if it is close enough, or a line if the curve has no direction there.
fn fit(curve: &impl Curve, from: f64, to: f64, distance: f64) -> Option<Vec<CurvePiece>> {
    let width = to - from;
    let rays = ray(curve, from, width).zip(ray(curve, to, -width));
    let fitting = match rays.and_then(|(from, to)| biarc(from, to)) {
        Some(biarc) => biarc.to_vec(),
        None => vec![CurvePiece::line(curve.at(from).0, curve.at(to).0)],
    };
    let is_near = |sample: u32| {
        let point = curve.at(from + width * f64::from(sample) / f64::from(SAMPLES)).0;
        fitting.iter().any(|piece| piece.distance(point) <= distance * MARGIN)
    };
    (1..SAMPLES).all(is_near).then_some(fitting)
}

/// A point of the curve with its direction. If the derivative vanishes at the point, the direction is taken slightly inside the span, on
/// the side of `inwards`.
fn ray(curve: &impl Curve, parameter: f64, inwards: f64) -> Option<Ray> {
    /// Fraction of the span to move inwards for a direction.
    const STEP: f64 = 1e-3;
    /// Derivatives shorter than this fraction of the distance count as zero.
    const NOTHING: f64 = 1e-6;
    let (point, derivative) = curve.at(parameter);
    let way = curve.at(parameter + inwards * STEP).0.minus(point).times(1.0 / (inwards * STEP));
    let has_direction = derivative.length() > NOTHING * way.length();
    let direction = if has_direction { derivative } else { way };
    Some(Ray { point, direction: direction.unit()? })
}
