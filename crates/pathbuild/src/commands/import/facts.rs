//! What is said of a program, before it is said in a language.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::estimate::{self, Kinematics};
use pathbuild_gcode::summary::{Summary, is_guess};

use crate::commands::program::Program;
use crate::context::Context;

/// A program's summary with what the configuration makes of it.
pub(super) struct Facts<'a> {
    pub(super) program: &'a Program,
    pub(super) summary: Summary,
    /// The rapid feed in mm/min, where it is known.
    pub(super) rapid: Option<f64>,
    /// The time on the machine in seconds, where the configuration tells what it can do.
    pub(super) machine_seconds: Option<f64>,
    /// What was taken for granted.
    pub(super) taken: Vec<&'a Diagnostic>,
}

impl<'a> Facts<'a> {
    pub(super) fn new(context: &Context, program: &'a Program) -> Self {
        let steps = &program.read.steps;
        Self {
            program,
            summary: Summary::of(steps, program.dialect == Dialect::Xpertmill),
            rapid: context.settings.general.rapid.value,
            machine_seconds: kinematics(context).map(|machine| estimate::seconds(steps, &machine)),
            taken: program.read.problems.iter().filter(|problem| is_guess(problem)).collect(),
        }
    }

    /// The compatible time in whole minutes; of cutting moves only where the rapid feed is not known. (book: program/gcode)
    /// `None` where a cutting move has no feed.
    pub(super) fn minutes(&self) -> Option<f64> {
        let total = &self.summary.total;
        let minutes = self.rapid.map_or(total.cutting(), |rapid| total.sum(rapid)).minutes();
        Some(minutes).filter(|minutes| minutes.is_finite())
    }
}

/// What `[machine]` says of speeds; all of it must be known. Without rates rapid moves go at `rapid`.
fn kinematics(context: &Context) -> Option<Kinematics> {
    let machine = &context.settings.machine;
    let rapid = context.settings.general.rapid.value;
    Some(Kinematics {
        rates: machine.rates.value.or(rapid.map(|rapid| [rapid; 3]))?,
        accelerations: machine.accelerations.value?,
        junction_deviation: machine.junction_deviation.value,
    })
}
