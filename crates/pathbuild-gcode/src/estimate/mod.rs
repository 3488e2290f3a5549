//! Estimates the duration of a program on a machine with limited acceleration. (book: program/reading)
//!
//! The planner is similar to that of GRBL: along each move the tool accelerates, moves at its feed and decelerates; the speed in corners
//! follows
//! from the junction deviation. It looks ahead as far as useful, whereas a control only sees a few moves.

mod profile;
mod way;

use pathbuild_motion::{Action, Step};
use way::Way;

/// The limits of a machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kinematics {
    /// Maximum speeds of X, Y and Z in mm/min, for rapid moves and for feeds.
    pub rates: [f64; 3],
    /// Maximum accelerations of X, Y and Z, in mm/s².
    pub accelerations: [f64; 3],
    /// Distance in mm by which a corner could be cut at the speed at which it is taken. With 0, the tool stops in every corner.
    pub junction_deviation: f64,
}

/// The duration of a program in seconds, consisting of moves and dwells, without stops for the operator.
///
/// Axes with unknown positions count as not moving. A move without a feed counts as a rapid; the interpreter reports the missing
/// feed.
pub fn seconds(steps: &[Step], kinematics: &Kinematics) -> f64 {
    let mut seconds = 0.0;
    let mut ways: Vec<Way> = Vec::new();
    for step in steps {
        match &step.action {
            Action::Move(movement) => ways.extend(Way::of(movement, kinematics)),
            Action::Dwell(pause) => {
                seconds += profile::seconds(&ways, kinematics) + pause;
                ways.clear();
            }
            Action::ChangeTool(_) | Action::Stop { .. } | Action::Spindle(_) => {
                seconds += profile::seconds(&ways, kinematics);
                ways.clear();
            }
            Action::SelectTool(_)
            | Action::Coolant(_)
            | Action::System(_)
            | Action::Word(_)
            | Action::ProgramNumber(_)
            | Action::Change(_)
            | Action::Comment(_)
            | Action::End => {}
        }
    }
    seconds + profile::seconds(&ways, kinematics)
}
