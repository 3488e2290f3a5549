//! Corners of parts that the cutter does not reach.

use crate::scene::{Corner, Point, Shape};

/// Returns the inner corners of rings at which an unreached stretch of the outline begins or ends. `radius` is that of the cutter, in mm.
pub(super) fn unreached_corners(rings: &[Vec<Shape>], stretches: &[Shape], radius: f64) -> Vec<Corner> {
    let of_ring = |ring: &Vec<Shape>| {
        let next = ring.iter().cycle().skip(1);
        let corners = ring.iter().zip(next).filter_map(|(shape, next)| {
            let reach = radius * corner_reach(shape.directions()[1], next.directions()[0])?;
            let at = next.start();
            stretches.iter().any(|stretch| touches(stretch, at)).then_some(Corner { at, reach })
        });
        corners.collect::<Vec<_>>()
    };
    rings.iter().flat_map(of_ring).collect()
}

/// Distance in mm up to which a stretch of an outline touches a corner.
const CORNER_DISTANCE: f64 = 0.001;

/// Whether a stretch of an outline begins or ends at a corner.
fn touches(stretch: &Shape, [x, y]: Point) -> bool {
    let ends = [stretch.start(), stretch.end()];
    ends.into_iter().any(|end| libm::hypot(end[0] - x, end[1] - y) <= CORNER_DISTANCE)
}

/// Returns the distance from a corner at which a round cutter on the right of the outline touches both sides, in radii of the cutter. The
/// arguments are the directions before and after the corner. Returns `None` if the outline does not turn to the right.
fn corner_reach([x, y]: Point, [next_x, next_y]: Point) -> Option<f64> {
    let (across, along) = (x * next_y - y * next_x, x * next_x + y * next_y);
    let norm = libm::hypot(x, y) * libm::hypot(next_x, next_y);
    (across < -SMOOTH_SINE * norm)
        .then(|| (-across / (norm + along).max(SMOOTH_SINE * norm)).min(MAX_CORNER_REACH))
}

/// Sine of the largest turn at which an outline is still considered smooth.
const SMOOTH_SINE: f64 = 0.01;

/// Maximum extent of a corner, in radii of the cutter.
const MAX_CORNER_REACH: f64 = 10.0;

#[cfg(test)]
mod tests {
    use super::{MAX_CORNER_REACH, corner_reach};

    /// A round cutter touches the sides of a right angle at one radius from the corner, whatever the directions of the sides.
    #[test]
    fn the_reach_of_a_corner_does_not_depend_on_directions() {
        for turned in 0..12 {
            let along = |degrees: f64| {
                let (sin, cos) = libm::sincos((f64::from(turned) * 30.0 + degrees).to_radians());
                [cos, sin]
            };
            let reach = |degrees: f64| corner_reach(along(0.0), along(-degrees));
            assert!(reach(90.0).is_some_and(|reach| (reach - 1.0).abs() < 1e-9), "{turned}");
            assert!(
                reach(60.0).is_some_and(|reach| (reach - libm::sqrt(1.0 / 3.0)).abs() < 1e-9),
                "{turned}"
            );
            assert_eq!(reach(170.0), Some(MAX_CORNER_REACH));
            assert_eq!([reach(0.5), reach(-90.0)], [None; 2], "smooth, or to the other side");
        }
    }
}
