//! A move as seen by the planner.

use pathbuild_motion::{Move, MoveShape, Pace};

use super::Kinematics;

/// A move without interruption, in mm and seconds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    pub(super) length: f64,
    /// Target speed in mm/s.
    pub(super) speed: f64,
    /// Maximum acceleration in mm/s².
    pub(super) acceleration: f64,
    /// Directions at the start and at the end, as unit vectors.
    pub(super) begin: [f64; 3],
    pub(super) end: [f64; 3],
    /// Whether the tool stops at the end, because it is unknown where a probe stops.
    pub(super) stops: bool,
}

impl Way {
    /// Converts a move; `None` if it does not move.
    pub(super) fn of(movement: &Move, kinematics: &Kinematics) -> Option<Self> {
        let length = movement.length();
        if !(length > 0.0 && length.is_finite()) {
            return None;
        }
        let shares = movement.axis_shares();
        let limit = |limits: &[f64; 3]| {
            let along = limits.iter().zip(shares).filter(|(_, share)| *share > 0.0);
            along.map(|(limit, share)| limit / share).fold(f64::INFINITY, f64::min)
        };
        let acceleration = limit(&kinematics.accelerations);
        let fastest = limit(&kinematics.rates) / 60.0;
        let wanted = movement.pace.feed().filter(|feed| *feed > 0.0).map_or(fastest, |feed| feed / 60.0);
        let (begin, end) = directions(movement, length);
        Some(Self {
            length,
            speed: wanted.min(fastest).min(turning_speed(movement, kinematics)),
            acceleration,
            begin,
            end,
            stops: matches!(movement.pace, Pace::Probe { .. }),
        })
    }
}

/// Speed in mm/s at which the axes of an arc's plane can still keep the tool on it.
fn turning_speed(movement: &Move, kinematics: &Kinematics) -> f64 {
    let MoveShape::Arc(arc) = movement.shape else { return f64::INFINITY };
    let weakest =
        arc.plane.axes().map(|axis| kinematics.accelerations[axis]).into_iter().fold(f64::INFINITY, f64::min);
    libm::sqrt(weakest * arc.radius(&movement.from).max(arc.radius(&movement.to)))
}

fn directions(movement: &Move, length: f64) -> ([f64; 3], [f64; 3]) {
    let known = movement.from.known.and(movement.to.known);
    let way: [f64; 3] = std::array::from_fn(|axis| {
        let is_known = known.has(pathbuild_motion::Axes::of(axis));
        if is_known { movement.to.at[axis] - movement.from.at[axis] } else { 0.0 }
    });
    let MoveShape::Arc(arc) = movement.shape else {
        let direction = way.map(|axis| axis / length);
        return (direction, direction);
    };
    let across = way[arc.plane.third()] / length;
    let along = libm::sqrt((1.0 - across * across).max(0.0));
    let tangent = |at: &[f64; 3]| {
        let mut direction = [0.0; 3];
        for (axis, part) in arc.plane.axes().into_iter().zip(arc.tangent(at)) {
            direction[axis] = part * along;
        }
        direction[arc.plane.third()] = across;
        direction
    };
    (tangent(&movement.from.at), tangent(&movement.to.at))
}
