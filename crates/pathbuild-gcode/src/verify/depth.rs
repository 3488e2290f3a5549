//! Finds rapid moves at cutting depth in programs whose material has an unknown surface. (book: program/reading)
//!
//! A program that cuts at some depth before or after a rapid move in the plane probably has material all along that move, except where it has cut to
//! that depth before. It may also move beside the stock, as between the passes of facing, so such a move is reported as a doubt and not as an error.

use std::collections::BTreeSet;

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Diagnostic, Message};
use pathbuild_motion::{Action, Axes, Move, Pace, Step};

use super::frames::Frames;
use super::height_map::RESIDUE_HEIGHT;
use super::material::Stock;
use crate::interpret::Program;
use crate::read::Problems;

/// Rule that finds rapid moves with travel in the plane, at or below a height at which the program has just cut or cuts next: pass every step of a
/// program, then call [`finish`](Self::finish).
#[derive(Debug, Default)]
pub struct DepthRules {
    depths: Depths,
    /// Number of moves until now: the index of the next move.
    moves: usize,
    /// Stops and tool changes at cutting depth.
    stops: Problems,
    frames: Frames,
}

impl DepthRules {
    /// Processes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        match &step.action {
            Action::Move(movement) => {
                self.frames.step(step);
                self.depths.add(self.moves, movement);
                self.moves += 1;
            }
            Action::System { .. } => self.forget_cuts_of_frame(step),
            Action::Stop { .. } => self.report_at_cut(&say::STOP_AT_CUT, step.line),
            Action::ChangeTool(_) => self.report_at_cut(&say::CHANGE_AT_CUT, step.line),
            _ => {}
        }
    }

    /// Forgets the cuts so far if the step begins another coordinate system whose position relative to the previous one is not known.
    fn forget_cuts_of_frame(&mut self, step: &Step) {
        if self.frames.step(step) {
            self.depths.cut = None;
            self.depths.at_cut = None;
            self.depths.pending.clear();
        }
    }

    /// Reports a stop or a tool change at the depth of the last cut, at most once until the next move.
    fn report_at_cut(&mut self, message: &'static Message, line: u32) {
        if let Some(z) = self.depths.at_cut.take() {
            self.stops.add_at_line(message, line, |d| d.with("z", z));
        }
    }

    /// Reports the stops and tool changes at cutting depth, and the found moves that lead through a point at which the program has not cut as deep
    /// before. The surface of `stock` is [unknown](Stock::with_unknown_surface). If no moves were found, the program is not processed again.
    pub fn finish(self, program: &(impl Program + ?Sized), stock: &Stock) -> Vec<Diagnostic> {
        let mut problems = self.stops;
        let found = &self.depths.found;
        self.frames.check_rapids(found, |movement| vec![*movement], program, stock, &mut problems);
        problems.into_diagnostics()
    }
}

/// The heights at which a program cuts, updated move by move.
#[derive(Debug, Default)]
struct Depths {
    /// Height in mm from which the tool goes down at feed. Feed moves that stay at or above this height are moves in the air.
    top: Option<f64>,
    /// Height in mm of the lowest point of the last cut.
    cut: Option<f64>,
    /// Indices of the rapid moves in the plane since the last feed move that were above the last cut, each with the height in mm of its higher end.
    pending: Vec<(usize, f64)>,
    found: BTreeSet<usize>,
    /// Height in mm of the tool while it is as deep as the last cut.
    at_cut: Option<f64>,
}

impl Depths {
    fn add(&mut self, index: usize, movement: &Move) {
        self.follow(index, movement);
        let z = movement.to.z();
        let is_deep = movement.is_known() && self.cut.is_some_and(|cut| z <= cut + RESIDUE_HEIGHT);
        self.at_cut = is_deep.then_some(z);
    }

    fn follow(&mut self, index: usize, movement: &Move) {
        let is_known = movement.is_known();
        match movement.pace {
            Pace::Rapid if !is_known => self.top = movement.to.known.has(Axes::Z).then(|| movement.to.z()),
            _ if !is_known => {}
            Pace::Rapid => self.add_rapid(index, movement),
            Pace::Feed(_) => self.add_feed_move(movement),
            Pace::Probe { .. } => {}
        }
    }

    fn add_rapid(&mut self, index: usize, movement: &Move) {
        let height = movement.from.z().max(movement.to.z());
        if !movement.keeps_xy() {
            if self.cut.is_some_and(|cut| height <= cut + RESIDUE_HEIGHT) {
                self.found.insert(index);
            } else {
                self.pending.push((index, height));
            }
        }
        // A rapid move up may end below the surface, as in `G0 Z-2` after a cut at Z-4.
        let to = movement.to.z();
        let is_up = to >= movement.from.z();
        if is_up {
            self.top = Some(self.top.map_or(to, |top| top.max(to)));
        } else if self.cut.is_none_or(|cut| to > cut + RESIDUE_HEIGHT) {
            self.top = Some(to);
        }
    }

    fn add_feed_move(&mut self, movement: &Move) {
        let low = movement.lowest();
        let pending = self.pending.drain(..);
        if self.top.is_some_and(|top| low < top - RESIDUE_HEIGHT) {
            self.found.extend(
                pending.filter(|(_, height)| *height <= low + RESIDUE_HEIGHT).map(|(index, _)| index),
            );
            self.cut = Some(low);
        }
    }
}
