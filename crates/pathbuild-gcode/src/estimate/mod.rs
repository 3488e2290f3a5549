//! How long a program takes on a machine that has to gather speed. (book: program/reading)
//!
//! A planner as GRBL has it: along each move the tool speeds up, keeps its feed and slows down; how fast it may take a corner follows from
//! the junction deviation. It looks ahead as far as it is of use, where a control sees a few moves only.

mod profile;
mod way;

use pathbuild_motion::{Action, Step};
use way::Way;

/// What a machine can do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kinematics {
    /// The fastest that X, Y and Z go, in mm/min; for rapid moves and for feeds.
    pub rates: [f64; 3],
    /// The most that X, Y and Z gain in speed, in mm/s².
    pub accelerations: [f64; 3],
    /// How far in mm a corner could be cut for the speed at which it is taken; 0: the tool stops in each.
    pub junction_deviation: f64,
}

/// The time of a program in seconds: its moves and its dwells, without what waits for a person.
///
/// Axes of which it is not known where they are count as standing. A move without a feed counts as a rapid one: its feed is missing, which
/// the interpreter reports.
pub fn seconds(steps: &[Step], kinematics: &Kinematics) -> f64 {
    let mut seconds = 0.0;
    let mut ways: Vec<Way> = Vec::new();
    for step in steps {
        match &step.action {
            Action::Move(it) => ways.extend(Way::of(it, kinematics)),
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
            | Action::Change(_)
            | Action::Comment(_)
            | Action::End => {}
        }
    }
    seconds + profile::seconds(&ways, kinematics)
}
