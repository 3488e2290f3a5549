//! Lengths and times of a program. (book: program/gcode)

use std::ops::Add;

use crate::program::{Class, Count, PlannedMove, Program, ProgramStep};

/// The totals of a program.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Statistics {
    pub milling: Total,
    pub drilling: Total,
    pub sweeps: Total,
    /// Number of moves counted.
    pub commands: u64,
}

/// Total length and time of moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Total {
    /// In mm.
    pub length: f64,
    /// Sum of length / feed in minutes, which ignores acceleration.
    pub time: f64,
}

/// Factor by which a machine is slower than length / feed.
const SLOWER: f64 = 1.4;

impl Statistics {
    /// The statistics that `PathDxf2GCode` writes for a program, with a rapid feed in mm/min. They use planned lengths, which can differ
    /// from those of the moves. Only compatible programs have them.
    pub fn of_reference(program: &Program, rapid: f64) -> Self {
        let mut statistics = Self::default();
        let mut z = program.start_height();
        for step in &program.steps {
            if let ProgramStep::Move { to, count } = step {
                statistics.add(count, rapid);
                z = height_after(to).unwrap_or(z);
            }
        }
        let last = (z - program.start_height()).abs();
        statistics.add(&Count { class: Class::Sweep, length: last, feed: None }, rapid);
        statistics
    }

    /// The sum of all totals.
    pub fn sum(&self) -> Total {
        let totals = [self.milling, self.drilling, self.sweeps];
        totals.into_iter().fold(Total::default(), Add::add)
    }

    fn add(&mut self, count: &Count, rapid: f64) {
        let total = match count.class {
            Class::Milling => &mut self.milling,
            Class::Drilling => &mut self.drilling,
            Class::Sweep => &mut self.sweeps,
        };
        total.length += count.length;
        total.time += count.length / count.feed.unwrap_or(rapid);
        self.commands += 1;
    }
}

impl Add for Total {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { length: self.length + other.length, time: self.time + other.time }
    }
}

impl Total {
    /// Estimated real time in whole minutes, rounded up after discarding less than 0.0000001 s.
    pub fn minutes(&self) -> f64 {
        let seconds = SLOWER * self.time * 60.0;
        ((seconds * 1e7).round() / 1e7 / 60.0).ceil()
    }
}

/// Height at the end of a move, or `None` if it does not change.
fn height_after(to: &PlannedMove) -> Option<f64> {
    match to {
        PlannedMove::Sweep { .. } => None,
        PlannedMove::Lift { z }
        | PlannedMove::Drill { z, .. }
        | PlannedMove::Line { z, .. }
        | PlannedMove::Arc { z, .. } => Some(z.z),
    }
}
