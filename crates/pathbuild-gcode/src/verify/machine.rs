//! Checks that a machine is capable of the moves and speeds of a program. (book: reference/configuration, `[machine]`)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{Action, Move, Step, Turning};

use crate::read::Problems;

/// The limits of a machine. Unknown limits are not checked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Machine {
    /// Travel of the machine's axes.
    pub travel: Option<Travel>,
    /// Maximum cutting feed, in mm/min.
    pub feed: Option<f64>,
    /// Maximum cutting feed of each axis, in mm/min.
    pub rates: [Option<f64>; 3],
    /// Minimum and maximum spindle speed, in 1/min.
    pub spindle: Option<(f64, f64)>,
}

/// The travel of the axes, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Travel {
    /// Least and greatest coordinates of X, Y, Z in program coordinates, for parts clamped at a fixed position. Unlimited ends are
    /// infinite.
    Placed([(f64, f64); 3]),
    /// The length of travel in X, Y, Z, if the part may be clamped anywhere.
    Size([f64; 3]),
}

/// Amount in mm by which rounding to three decimals may move a coordinate of a program. `emit` compares the exact coordinates, and `verify` those of the
/// text; both must come to the same result.
const ROUNDING: f64 = 0.0005 + 1e-9;

const AXES: [char; 3] = ['X', 'Y', 'Z'];

/// Rule that finds moves and speeds beyond the limits of a machine: pass every step of a program, then call [`finish`](Self::finish).
#[derive(Debug)]
pub struct MachineRules<'m> {
    machine: &'m Machine,
    reach: ReportedExtent,
    last_feed: Option<f64>,
    last_speed: Option<f64>,
    problems: Problems,
}

impl<'m> MachineRules<'m> {
    /// Creates the rule for the beginning of a program.
    pub fn new(machine: &'m Machine) -> Self {
        Self {
            machine,
            reach: ReportedExtent::default(),
            last_feed: None,
            last_speed: None,
            problems: Problems::default(),
        }
    }

    /// Processes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        match &step.action {
            Action::Move(movement) => {
                if let Some(travel) = &self.machine.travel {
                    self.reach.check(step.line, movement, travel, &mut self.problems);
                }
                self.check_feed(step.line, movement);
            }
            // The speed is checked with M3 as well, because S and M3 may be in different lines.
            Action::Spindle(spindle)
                if spindle.turning != Turning::Off
                    && std::mem::replace(&mut self.last_speed, spindle.speed) != spindle.speed =>
            {
                self.check_speed(step.line, spindle.speed.unwrap_or_default());
            }
            _ => {}
        }
    }

    /// Returns all problems, ordered by line.
    pub fn finish(self) -> Vec<Diagnostic> {
        self.problems.into_diagnostics()
    }

    /// Reports a feed that exceeds the limit, or has a component that exceeds the limit of its axis. A feed is reported once, until it changes.
    fn check_feed(&mut self, line: u32, movement: &Move) {
        let Some(feed) = movement.pace.feed().filter(|feed| Some(*feed) != self.last_feed) else { return };
        if let Some(most) = self.machine.feed.filter(|most| feed > *most) {
            self.last_feed = Some(feed);
            return self
                .problems
                .add_at_line(&say::FEED_ABOVE_MOST, line, |d| d.with("feed", feed).with("most", most));
        }
        for (axis, share) in movement.axis_shares().into_iter().enumerate() {
            if let Some(most) = self.machine.rates[axis].filter(|most| feed * share > most * (1.0 + 1e-9)) {
                self.last_feed = Some(feed);
                return self.problems.add_at_line(&say::FEED_TOO_HIGH, line, |d| {
                    d.with("feed", feed).with("axis", AXES[axis]).with("most", most)
                });
            }
        }
    }

    fn check_speed(&mut self, line: u32, speed: f64) {
        let Some((least, most)) = self.machine.spindle else { return };
        if speed != 0.0 && !(least..=most).contains(&speed) {
            self.problems.add_at_line(&say::SPINDLE_SPEED, line, |d| {
                d.with("speed", speed).with("least", least).with("most", most)
            });
        }
    }
}

/// The extent of the moves so far, and the ends of axes that have been reported as exceeded.
#[derive(Debug, Default)]
struct ReportedExtent {
    extent: [Option<(f64, f64)>; 3],
    said: [[bool; 2]; 3],
}

impl ReportedExtent {
    fn check(&mut self, line: u32, movement: &Move, travel: &Travel, problems: &mut Problems) {
        for (axis, extent) in movement.extent().into_iter().enumerate() {
            let Some((low, high)) = extent else { continue };
            let known = self.extent[axis].get_or_insert((low, high));
            *known = (known.0.min(low), known.1.max(high));
            match travel {
                Travel::Placed(limits) => self.check_placed(line, axis, (low, high), limits[axis], problems),
                Travel::Size(sizes) => self.check_size(line, axis, sizes[axis], problems),
            }
        }
    }

    fn check_placed(
        &mut self,
        line: u32,
        axis: usize,
        extent: (f64, f64),
        limits: (f64, f64),
        problems: &mut Problems,
    ) {
        for (end, value, is_outside) in
            [(0, extent.0, extent.0 < limits.0 - ROUNDING), (1, extent.1, extent.1 > limits.1 + ROUNDING)]
        {
            if is_outside && !std::mem::replace(&mut self.said[axis][end], true) {
                problems.add_at_line(&say::OUTSIDE_MACHINE, line, |d| {
                    d.with("axis", AXES[axis])
                        .with("value", value)
                        .with("least", limits.0)
                        .with("most", limits.1)
                });
            }
        }
    }

    fn check_size(&mut self, line: u32, axis: usize, most: f64, problems: &mut Problems) {
        let size = self.extent[axis].map_or(0.0, |(low, high)| high - low);
        if size > most + 2.0 * ROUNDING && !std::mem::replace(&mut self.said[axis][0], true) {
            problems.add_at_line(&say::LARGER_THAN_MACHINE, line, |d| {
                d.with("axis", AXES[axis]).with("size", size).with("most", most)
            });
        }
    }
}
