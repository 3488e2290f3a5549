//! Checks whether a program hits the clamps of its drawing. (book: language/keep-outs)

use pathbuild_diagnostic::messages::paths as say;
use pathbuild_diagnostic::{Diagnostic, Point};
use pathbuild_motion::{Action, Step};
use pathbuild_path::{KeepOut, KeepOutMap};
use pathbuild_toolpath::{kind_of_move, way};

use super::cuts::{CHORD, PLACE};
use crate::dialect::Dialect;
use crate::read::Problems;

/// Clamps in program coordinates, and the tool that must not hit them.
#[derive(Debug)]
pub struct Clamps {
    all: Vec<KeepOut>,
    map: KeepOutMap,
    radius: f64,
}

/// Compares the steps of a program with clamps: pass every step, then call [`finish`](Self::finish).
#[derive(Debug)]
pub struct PastClamps<'c> {
    clamps: &'c Clamps,
    /// The effect of rounding in mm. A move that touches a clamp in the drawing may be written slightly inside it.
    slack: f64,
    problems: Problems,
}

impl Clamps {
    /// Creates clamps at their positions, for a cutter with the given diameter in mm.
    pub fn new(clamps: Vec<KeepOut>, cutter: f64) -> Self {
        let map = KeepOutMap::new(clamps.iter().map(|clamp| (clamp.height, &*clamp.outline)));
        Self { all: clamps, map, radius: cutter / 2.0 }
    }
}

impl<'c> PastClamps<'c> {
    /// Starts at the beginning of a program in this dialect.
    pub fn new(clamps: &'c Clamps, dialect: Dialect) -> Self {
        let chord = if dialect.rules().arcs.helix { 0.0 } else { CHORD };
        Self { clamps, slack: PLACE + chord, problems: Problems::default() }
    }

    /// Passes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        let Action::Move(it) = &step.action else { return };
        let Some(way) = way(it) else { return };
        let Clamps { all, map, radius } = self.clamps;
        for clamp in map.entered(&way, *radius, self.slack) {
            let KeepOut { layer, at, height, .. } = &all[clamp];
            self.problems.add_at_line(&say::LINE_INTO_CLAMP, step.line, |found| {
                found
                    .with("tool", 2.0 * radius)
                    .quoting("layer", layer.as_str())
                    .with("clamp", Point::new(at.x, at.y))
                    .with("height", *height)
                    .with("what", kind_of_move(it))
                    .with("z", way.lowest())
            });
        }
    }

    /// Returns the collisions found, ordered by line.
    pub fn finish(self) -> Vec<Diagnostic> {
        self.problems.into_diagnostics()
    }
}
