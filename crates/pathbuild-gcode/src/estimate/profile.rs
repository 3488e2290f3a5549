//! Speeds along ways that follow each other, and the time that they take.

use super::Kinematics;
use super::way::Way;

/// The seconds that ways take one after the other, from standing to standing.
pub(super) fn seconds(ways: &[Way], kinematics: &Kinematics) -> f64 {
    let squares = entry_squares(ways, kinematics);
    ways.iter().zip(squares.windows(2)).map(|(way, ends)| duration(way, ends[0], ends[1])).sum()
}

/// The squares of the speeds between ways, the first and the last being those before and behind all of them.
fn entry_squares(ways: &[Way], kinematics: &Kinematics) -> Vec<f64> {
    let mut squares = vec![0.0; ways.len() + 1];
    for (index, pair) in ways.windows(2).enumerate() {
        squares[index + 1] = corner_square(&pair[0], &pair[1], kinematics);
    }
    // No faster than it can slow down for what follows, nor than it has gathered speed before.
    for (index, way) in ways.iter().enumerate().rev() {
        squares[index] = squares[index].min(squares[index + 1] + 2.0 * way.acceleration * way.length);
    }
    for (index, way) in ways.iter().enumerate() {
        squares[index + 1] = squares[index + 1].min(squares[index] + 2.0 * way.acceleration * way.length);
    }
    squares
}

/// The square of the speed at which the corner between two ways may be taken: that of a circle which touches both and leaves the corner by
/// the junction deviation.
fn corner_square(before: &Way, behind: &Way, kinematics: &Kinematics) -> f64 {
    if before.stops {
        return 0.0;
    }
    let slower = before.speed.min(behind.speed);
    // Of the angle between the ways as seen from the corner: 1 goes back, -1 straight on.
    let cosine: f64 = -before.end.iter().zip(behind.begin).map(|(a, b)| a * b).sum::<f64>();
    let half_sine = libm::sqrt((0.5 * (1.0 - cosine)).clamp(0.0, 1.0));
    let square = if half_sine >= 1.0 - 1e-9 {
        f64::INFINITY
    } else {
        let acceleration = before.acceleration.min(behind.acceleration);
        acceleration * kinematics.junction_deviation * half_sine / (1.0 - half_sine)
    };
    square.min(slower * slower)
}

/// The seconds of one way that begins and ends at speeds of which these are the squares.
fn duration(way: &Way, from: f64, to: f64) -> f64 {
    let (speed, acceleration) = (way.speed, way.acceleration);
    // The speed that would be reached if there were no limit but the length.
    let peak = 0.5 * (from + to) + acceleration * way.length;
    let top = speed.min(libm::sqrt(peak));
    let (from, to) = (libm::sqrt(from), libm::sqrt(to));
    let ramp = |end: f64| (top - end).max(0.0) / acceleration;
    let ramps = 0.5 * ((top + from) * ramp(from) + (top + to) * ramp(to));
    ramp(from) + ramp(to) + (way.length - ramps).max(0.0) / top
}
