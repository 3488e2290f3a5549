//! Finds rapid moves that are clear on a straight line, but not on the path taken by a control that moves each axis at its own speed.
//! (book: program/reading)
//!
//! Such a control goes at 45 degrees until the axis with less distance to cover arrives, and then along the other axis. When the tool returns along a
//! slanting slot, this path leads out of the slot.

use std::collections::BTreeSet;

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Code, Diagnostic};
use pathbuild_motion::{Action, Move, MoveShape, Pace, Position, Step};

use super::frames::Frames;
use super::height_map::RESIDUE_HEIGHT;
use super::material::Stock;
use crate::dialect::Dialect;
use crate::interpret::Program;
use crate::read::Problems;

/// Rule that finds slanting rapid moves, which change both X and Y, below the material's surface: pass every step of a program, then call
/// [`finish`](Self::finish).
#[derive(Debug)]
pub struct BentRapidRules<'c> {
    dialect: Dialect,
    stock: &'c Stock,
    /// Indices of the slanting rapid moves below the surface.
    found: BTreeSet<usize>,
    /// Number of moves until now: the index of the next move.
    moves: usize,
    frames: Frames,
}

impl<'c> BentRapidRules<'c> {
    /// Creates the rule for the beginning of a program; `None` if rapid moves of the dialect are straight.
    pub fn new(dialect: Dialect, stock: &'c Stock) -> Option<Self> {
        let rules = Self { dialect, stock, found: BTreeSet::new(), moves: 0, frames: Frames::default() };
        (!dialect.rules().straight_rapids).then_some(rules)
    }

    /// Processes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        self.frames.step(step);
        let Action::Move(movement) = &step.action else { return };
        let surface = self.stock.at(step.order).map(|piece| piece.surface);
        let height = movement.from.z().max(movement.to.z());
        if is_slanting_rapid(movement) && surface.is_some_and(|surface| height < surface - RESIDUE_HEIGHT) {
            self.found.insert(self.moves);
        }
        self.moves += 1;
    }

    /// Reports the found moves whose bent path leads through material. If no moves were found, the program is not processed again.
    pub fn finish(self, program: &(impl Program + ?Sized)) -> Vec<Diagnostic> {
        let Self { dialect, stock, found, frames, .. } = self;
        let mut hits = Problems::default();
        frames.check_rapids(&found, legs, program, stock, &mut hits);
        let mut hits = hits.into_diagnostics();
        hits.retain(|hit| hit.code() != Code::LimitReached);
        let lines: BTreeSet<u32> = hits.iter().filter_map(|hit| hit.place.line).collect();
        let mut problems = Problems::default();
        for line in lines {
            problems.add_at_line(&say::BENT_RAPID, line, |d| d.quoting("dialect", dialect.name()));
        }
        problems.into_diagnostics()
    }
}

fn is_slanting_rapid(movement: &Move) -> bool {
    let [across, up] = displacement_in_plane(movement);
    movement.pace == Pace::Rapid && movement.is_known() && across != 0.0 && up != 0.0
}

fn displacement_in_plane(movement: &Move) -> [f64; 2] {
    [0, 1].map(|axis| movement.to.at[axis] - movement.from.at[axis])
}

/// Returns the two moves that a control makes instead of a slanting rapid move if each axis moves at its own speed.
fn legs(movement: &Move) -> Vec<Move> {
    let way = displacement_in_plane(movement);
    let shorter = libm::fabs(way[0]).min(libm::fabs(way[1]));
    let [x, y] = [0, 1].map(|axis| movement.from.at[axis] + libm::copysign(shorter, way[axis]));
    let corner = Position::known(x, y, movement.from.z().max(movement.to.z()));
    let leg = |from, to| Move { from, to, shape: MoveShape::Line, ..*movement };
    vec![leg(movement.from, corner), leg(corner, movement.to)]
}
