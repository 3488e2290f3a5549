//! Speeds along consecutive moves, and the resulting time.

use super::Kinematics;
use super::way::Way;

/// Time in seconds for consecutive moves from standstill to standstill.
pub(super) fn seconds(ways: &[Way], kinematics: &Kinematics) -> f64 {
    let squares = entry_squares(ways, kinematics);
    ways.iter().zip(squares.windows(2)).map(|(way, ends)| duration(way, ends[0], ends[1])).sum()
}

/// The squared speeds between moves, including those before the first and after the last.
fn entry_squares(ways: &[Way], kinematics: &Kinematics) -> Vec<f64> {
    let mut squares = vec![0.0; ways.len() + 1];
    for (index, pair) in ways.windows(2).enumerate() {
        squares[index + 1] = corner_square(&pair[0], &pair[1], kinematics);
    }
    // The speed is limited by what can be reached from before and by what can be decelerated afterwards.
    for (index, way) in ways.iter().enumerate().rev() {
        squares[index] = squares[index].min(squares[index + 1] + 2.0 * way.acceleration * way.length);
    }
    for (index, way) in ways.iter().enumerate() {
        squares[index + 1] = squares[index + 1].min(squares[index] + 2.0 * way.acceleration * way.length);
    }
    squares
}

/// Squared speed permitted in the corner between two moves: that of a circle which touches both and passes the corner at the junction
/// deviation.
fn corner_square(before: &Way, behind: &Way, kinematics: &Kinematics) -> f64 {
    if before.stops {
        return 0.0;
    }
    let slower = before.speed.min(behind.speed);
    // Cosine of the angle between the moves as seen from the corner: 1 is a reversal, -1 is straight on.
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

/// Time in seconds for a move whose speeds at both ends are given as squares.
fn duration(way: &Way, from: f64, to: f64) -> f64 {
    let (speed, acceleration) = (way.speed, way.acceleration);
    // Square of the speed that would be reached if only the length limited it.
    let peak = 0.5 * (from + to) + acceleration * way.length;
    let top = speed.min(libm::sqrt(peak));
    let (from, to) = (libm::sqrt(from), libm::sqrt(to));
    let ramp = |end: f64| (top - end).max(0.0) / acceleration;
    let ramps = 0.5 * ((top + from) * ramp(from) + (top + to) * ramp(to));
    ramp(from) + ramp(to) + (way.length - ramps).max(0.0) / top
}
