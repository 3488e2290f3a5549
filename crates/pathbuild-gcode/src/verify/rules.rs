//! Rules that look at where the tool is and what is switched on.

use pathbuild_diagnostic::messages::gcode as say;

use super::stock::Stock;
use crate::interpret::{Action, Axes, Move, Pace, Position, Step, Turning};
use crate::read::Problems;

/// Heights that differ by less, in mm, are one.
const SAME_HEIGHT: f64 = 0.002;

/// Reports what no machine should be asked to do.
pub(super) fn check(steps: &[Step], stock: Option<&Stock>, problems: &mut Problems) {
    let switches =
        |step: &Step| matches!(step.action, Action::Spindle(spindle) if spindle.turning != Turning::Unstated);
    let spindle = if steps.iter().any(switches) { Turning::Off } else { Turning::Unstated };
    let mut watch = Watch {
        stock,
        at: Position::default(),
        line: 0,
        is_raised: false,
        spindle,
        spindle_said: false,
        spindle_line: 0,
        has_probed: false,
    };
    for step in steps {
        watch.step(step, problems);
    }
    watch.end(problems);
}

struct Watch<'s> {
    stock: Option<&'s Stock>,
    at: Position,
    /// The last line that moved.
    line: u32,
    /// The height has been known, or it has been said that it was not.
    is_raised: bool,
    spindle: Turning,
    /// It has been said that the spindle stands.
    spindle_said: bool,
    /// Where it was switched last.
    spindle_line: u32,
    /// The last move probed downwards.
    has_probed: bool,
}

impl Watch<'_> {
    fn step(&mut self, step: &Step, problems: &mut Problems) {
        match &step.action {
            Action::Move(it) => {
                self.line = step.line;
                self.first_move(step.line, it, problems);
                self.diagonal(step.line, it, problems);
                probe(step.line, it, problems);
                self.after_probe(step.line, it, problems);
                self.spindle(step.line, it, problems);
                self.at = it.to;
            }
            Action::Spindle(spindle) if spindle.turning != Turning::Unstated => {
                self.spindle = spindle.turning;
                self.spindle_said = false;
                self.spindle_line = step.line;
            }
            Action::End => self.spindle = Turning::Unstated,
            Action::ChangeTool(_) => self.tool_change(step.line, problems),
            _ => {}
        }
    }

    /// The surface that the tool's tip is below.
    fn surface_above(&self, line: u32, z: f64) -> Option<f64> {
        let surface = self.stock?.at(line)?.surface;
        (z < surface - SAME_HEIGHT).then_some(surface)
    }

    fn first_move(&mut self, line: u32, it: &Move, problems: &mut Problems) {
        if self.is_raised {
            return;
        }
        self.is_raised = it.to.known.has(Axes::Z);
        let moves_in_plane = !it.to.known.and(Axes::XY).is_empty();
        if moves_in_plane && !self.is_raised {
            self.is_raised = true;
            problems.add_at_line(&say::START_NOT_RAISED, line, |d| d);
        }
    }

    fn diagonal(&self, line: u32, it: &Move, problems: &mut Problems) {
        let is_known = it.from.known.and(it.to.known) == Axes::ALL;
        let is_diagonal = it.from.at[..2] != it.to.at[..2] && it.to.z() < it.from.z();
        if it.pace == Pace::Rapid && is_known && is_diagonal && self.surface_above(line, it.to.z()).is_some()
        {
            problems.add_at_line(&say::DIAGONAL_RAPID, line, |d| d.with("z", it.to.z()));
        }
    }

    /// Only a program that switches the spindle is asked for it: on many machines that is done by hand.
    fn spindle(&mut self, line: u32, it: &Move, problems: &mut Problems) {
        let is_off = self.spindle == Turning::Off;
        if matches!(it.pace, Pace::Feed(_)) && !it.is_nothing() && is_off && !self.spindle_said {
            self.spindle_said = true;
            problems.add_at_line(&say::SPINDLE_OFF, line, |d| d);
        }
    }

    /// What was met is still under the tool.
    fn after_probe(&mut self, line: u32, it: &Move, problems: &mut Problems) {
        let stays_in_plane = it.from.at[..2] == it.to.at[..2];
        let is_known = it.from.known.and(it.to.known).and(Axes::XY) == Axes::XY;
        if self.has_probed && is_known && !stays_in_plane {
            problems.add_at_line(&say::PROBE_NOT_RAISED, line, |d| d);
        }
        self.has_probed = matches!(it.pace, Pace::Probe { toward: true, .. }) && stays_in_plane;
    }

    fn tool_change(&self, line: u32, problems: &mut Problems) {
        let z = self.at.z();
        if !self.at.known.has(Axes::Z) {
            return;
        }
        if let Some(surface) = self.surface_above(line, z) {
            problems
                .add_at_line(&say::TOOL_CHANGE_AT_DEPTH, line, |d| d.with("z", z).with("surface", surface));
        }
    }

    fn end(&self, problems: &mut Problems) {
        if !matches!(self.spindle, Turning::Off | Turning::Unstated) {
            problems.add_at_line(&say::SPINDLE_LEFT_ON, self.spindle_line, |d| d);
        }
        let z = self.at.z();
        if !self.at.known.has(Axes::Z) {
            return;
        }
        if let Some(surface) = self.surface_above(self.line, z) {
            problems
                .add_at_line(&say::END_NOT_RAISED, self.line, |d| d.with("z", z).with("surface", surface));
        }
    }
}

/// A probe goes towards the material, which is below.
fn probe(line: u32, it: &Move, problems: &mut Problems) {
    let Pace::Probe { toward: true, .. } = it.pace else { return };
    let stays_in_plane = it.from.at[..2] == it.to.at[..2];
    if it.from.known.and(it.to.known) != Axes::ALL || !stays_in_plane {
        return;
    }
    if it.to.z() == it.from.z() {
        problems.add_at_line(&say::PROBE_WITHOUT_WAY, line, |d| d);
    } else if it.to.z() > it.from.z() {
        problems.add_at_line(&say::USELESS_PROBE, line, |d| d);
    }
}
