//! Facts about a program, independent of the output language.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::estimate::{self, Kinematics};
use pathbuild_gcode::summary::{Summary, is_guess};

use crate::commands::program::Program;
use crate::context::Context;

/// A program's summary, completed by the configuration.
pub(super) struct Facts<'a> {
    pub(super) program: &'a Program,
    pub(super) summary: Summary,
    /// Feed of rapid moves in mm/min, if known.
    pub(super) rapid: Option<f64>,
    /// Machining time in seconds, if the machine's capabilities are configured.
    pub(super) machine_seconds: Option<f64>,
    /// The first line whose moves are unknown: then lengths, times and the box are unknown as well.
    pub(super) unfollowed: Option<u32>,
    /// Assumptions that were made while reading.
    pub(super) taken: Vec<&'a Diagnostic>,
}

impl<'a> Facts<'a> {
    pub(super) fn new(context: &Context, program: &'a Program) -> Self {
        let steps = &program.read.steps;
        let unfollowed = program.first_unfollowed_line();
        Self {
            program,
            summary: Summary::of(steps, program.dialect == Dialect::Xpertmill),
            rapid: context.settings.general.rapid.value,
            machine_seconds: kinematics(context)
                .filter(|_| unfollowed.is_none())
                .map(|machine| estimate::seconds(steps, &machine)),
            unfollowed,
            taken: program.read.problems.iter().filter(|problem| is_guess(problem)).collect(),
        }
    }

    /// Compatible time in whole minutes; only of cutting moves if the rapid feed is unknown. (book: program/gcode) `None` if a cutting move
    /// has no feed, or a line is not followed.
    pub(super) fn minutes(&self) -> Option<f64> {
        let total = &self.summary.total;
        let minutes = self.rapid.map_or(total.cutting(), |rapid| total.sum(rapid)).minutes();
        Some(minutes).filter(|minutes| minutes.is_finite() && self.unfollowed.is_none())
    }
}

/// Speeds and accelerations from `[machine]`; `None` unless they are complete. Rapid moves default to `rapid`.
fn kinematics(context: &Context) -> Option<Kinematics> {
    let machine = &context.settings.machine;
    let rapid = context.settings.general.rapid.value;
    Some(Kinematics {
        rates: machine.rates.value.or(rapid.map(|rapid| [rapid; 3]))?,
        accelerations: machine.accelerations.value?,
        junction_deviation: machine.junction_deviation.value,
    })
}
