//! Estimates the duration of a program on a machine with limited acceleration. (book: program/reading)
//!
//! The planner is similar to that of GRBL: along each move the tool accelerates, moves at its feed and decelerates; the speed in corners
//! follows from the junction deviation. It looks ahead as far as useful, whereas a control only sees a few moves.

use pathbuild_motion::{Action, Move, MoveShape, Pace, Step};

/// The speed and acceleration limits of a machine's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kinematics {
    /// Maximum speeds of X, Y and Z in mm/min, for rapid moves and for feeds.
    pub rates: [f64; 3],
    /// Maximum accelerations of X, Y and Z, in mm/s².
    pub accelerations: [f64; 3],
    /// Distance in mm by which a corner could be cut at the speed at which the tool passes it. With 0, the tool stops in every corner.
    pub junction_deviation: f64,
}

/// Estimates the duration of a program in seconds: moves and dwells, without stops for the operator.
///
/// Axes with unknown positions are treated as not moving, and a move without a feed as a rapid move; the interpreter reports the missing feed.
pub fn seconds(steps: &[Step], kinematics: &Kinematics) -> f64 {
    let mut seconds = 0.0;
    let mut moves: Vec<TimedMove> = Vec::new();
    for step in steps {
        match &step.action {
            Action::Move(movement) => moves.extend(TimedMove::of(movement, kinematics)),
            Action::Dwell(pause) => {
                seconds += seconds_of(&moves, kinematics) + pause;
                moves.clear();
            }
            Action::ChangeTool(_) | Action::Stop { .. } | Action::Spindle(_) => {
                seconds += seconds_of(&moves, kinematics);
                moves.clear();
            }
            Action::SelectTool(_)
            | Action::Coolant(_)
            | Action::System { .. }
            | Action::Word(_)
            | Action::ProgramNumber(_)
            | Action::Change(_)
            | Action::Comment(_)
            | Action::End => {}
        }
    }
    seconds + seconds_of(&moves, kinematics)
}

/// A move with the data that the planner needs; lengths are in mm and times in seconds.
#[derive(Clone, Copy, Debug)]
struct TimedMove {
    length: f64,
    /// Target speed in mm/s.
    speed: f64,
    /// Maximum acceleration in mm/s².
    acceleration: f64,
    /// Directions at the start and at the end, as unit vectors.
    begin: [f64; 3],
    end: [f64; 3],
    /// Whether the tool stops after the move, as after a probing move, because its end is unknown.
    stops: bool,
}

impl TimedMove {
    /// Converts a move; `None` if its length is zero or not finite.
    fn of(movement: &Move, kinematics: &Kinematics) -> Option<Self> {
        let length = movement.length();
        if !(length > 0.0 && length.is_finite()) {
            return None;
        }
        let shares = movement.axis_speed_fractions();
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
            speed: wanted.min(fastest).min(max_arc_speed(movement, kinematics)),
            acceleration,
            begin,
            end,
            stops: matches!(movement.pace, Pace::Probe { .. }),
        })
    }
}

/// Returns the speed in mm/s at which the axes of an arc's plane can still keep the tool on the arc.
fn max_arc_speed(movement: &Move, kinematics: &Kinematics) -> f64 {
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

/// Returns the time in seconds for consecutive moves from standstill to standstill.
fn seconds_of(moves: &[TimedMove], kinematics: &Kinematics) -> f64 {
    let squares = entry_squares(moves, kinematics);
    moves.iter().zip(squares.windows(2)).map(|(way, ends)| duration(way, ends[0], ends[1])).sum()
}

/// Computes the squared speeds at the start of each move and at the end of the last, in mm²/s².
fn entry_squares(moves: &[TimedMove], kinematics: &Kinematics) -> Vec<f64> {
    let mut squares = vec![0.0; moves.len() + 1];
    for (index, pair) in moves.windows(2).enumerate() {
        squares[index + 1] = corner_square(&pair[0], &pair[1], kinematics);
    }
    // The speed is limited both by the acceleration before this point and by the distance left to decelerate after it.
    for (index, way) in moves.iter().enumerate().rev() {
        squares[index] = squares[index].min(squares[index + 1] + 2.0 * way.acceleration * way.length);
    }
    for (index, way) in moves.iter().enumerate() {
        squares[index + 1] = squares[index + 1].min(squares[index] + 2.0 * way.acceleration * way.length);
    }
    squares
}

/// Returns the squared speed permitted in the corner between two moves. It is the speed permitted on a circle that touches both moves and passes the
/// corner at the junction deviation.
fn corner_square(before: &TimedMove, behind: &TimedMove, kinematics: &Kinematics) -> f64 {
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

/// Returns the time in seconds for a move, given the squares of the speeds at both ends.
fn duration(way: &TimedMove, from: f64, to: f64) -> f64 {
    let (speed, acceleration) = (way.speed, way.acceleration);
    // Square of the speed that would be reached if only the length limited it.
    let peak = 0.5 * (from + to) + acceleration * way.length;
    let top = speed.min(libm::sqrt(peak));
    let (from, to) = (libm::sqrt(from), libm::sqrt(to));
    let ramp = |end: f64| (top - end).max(0.0) / acceleration;
    let ramps = 0.5 * ((top + from) * ramp(from) + (top + to) * ramp(to));
    ramp(from) + ramp(to) + (way.length - ramps).max(0.0) / top
}
