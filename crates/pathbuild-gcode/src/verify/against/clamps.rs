//! Checks whether a program hits the clamps of its drawing. (book: language/keep-outs)

use pathbuild_diagnostic::messages::paths as say;
use pathbuild_diagnostic::{Diagnostic, Point};
use pathbuild_motion::{Action, Step};
use pathbuild_path::{KeepOut, KeepOutMap};
use pathbuild_toolpath::{kind_of_move, tip_move};

use super::cuts::{CHORD_TOLERANCE, POSITION_TOLERANCE};
use crate::dialect::Dialect;
use crate::interpret::{Program, Text};
use crate::read::Problems;

/// Clamps in program coordinates, and the tool that must not hit them.
#[derive(Debug)]
pub struct Clamps {
    all: Vec<KeepOut>,
    map: KeepOutMap,
    radius: f64,
}

/// The collisions of a program with clamps that were found so far.
struct ClampCollisions<'c> {
    clamps: &'c Clamps,
    /// Maximum error in mm due to rounding, and to chords that replace helices. A move that touches a clamp in the drawing may be written slightly
    /// inside it.
    slack: f64,
    problems: Problems,
}

impl Clamps {
    /// Creates clamps at their positions, for a cutter with the given diameter in mm.
    pub fn new(clamps: Vec<KeepOut>, cutter: f64) -> Self {
        let map = KeepOutMap::new(clamps.iter().map(|clamp| (clamp.height, &*clamp.outline)));
        Self { all: clamps, map, radius: cutter / 2.0 }
    }

    /// Returns the moves of a program that hit the clamps, ordered by line.
    pub fn collisions(&self, program: &Text<'_>) -> Vec<Diagnostic> {
        let mut collisions = ClampCollisions::new(self, program.dialect);
        program.each(&mut |step| collisions.step(step));
        collisions.problems.into_diagnostics()
    }
}

impl<'c> ClampCollisions<'c> {
    fn new(clamps: &'c Clamps, dialect: Dialect) -> Self {
        let chord = if dialect.rules().arcs.helix { 0.0 } else { CHORD_TOLERANCE };
        Self { clamps, slack: POSITION_TOLERANCE + chord, problems: Problems::default() }
    }

    fn step(&mut self, step: &Step) {
        let Action::Move(movement) = &step.action else { return };
        let Some(way) = tip_move(movement) else { return };
        let Clamps { all, map, radius } = self.clamps;
        for clamp in map.entered_clamps(&way, *radius, self.slack) {
            let KeepOut { layer, at, height, .. } = &all[clamp];
            self.problems.add_at_line(&say::LINE_INTO_CLAMP, step.line, |found| {
                found
                    .with("tool", 2.0 * radius)
                    .quoting("layer", layer.as_str())
                    .with("clamp", Point::new(at.x, at.y))
                    .with("height", *height)
                    .with("what", kind_of_move(movement))
                    .with("z", way.lowest())
            });
        }
    }
}
