//! Finds excursions below the material's surface that consist of rapid moves only. (book: program/reading)
//!
//! Such moves would be pointless beside the stock, where they cut nothing. Therefore the program probably lacks the feed of the descent.

use pathbuild_diagnostic::Point;
use pathbuild_motion::{Move, Pace};

use super::height_map::RESIDUE_HEIGHT;

/// The excursion in progress while the moves of a program are processed.
#[derive(Debug, Default)]
pub(super) struct Excursions {
    open: Option<Excursion>,
}

/// Rapid moves below the surface, without any other move between them.
#[derive(Debug)]
pub(super) struct Excursion {
    /// The line of the descent.
    pub(super) line: u32,
    /// Height of the surface in mm.
    pub(super) surface: f64,
    /// The moves from the descent to the ascent; there is at least the descent.
    pub(super) moves: Vec<Move>,
}

impl Excursions {
    /// Processes the next move, and returns the excursion that it ends. An excursion begins only at a place that `may_begin` accepts, below a
    /// known `surface`.
    pub(super) fn step(
        &mut self,
        line: u32,
        movement: &Move,
        surface: Option<f64>,
        may_begin: impl FnOnce(&Move) -> bool,
    ) -> Option<Excursion> {
        let open = self.open.take().filter(|open| open.continues_with(movement));
        if let Some(mut open) = open {
            open.moves.push(*movement);
            if !movement.is_known() || movement.to.z() >= open.surface - RESIDUE_HEIGHT {
                return Some(open);
            }
            self.open = Some(open);
            return None;
        }
        let surface = surface.filter(|surface| surface.is_finite())?;
        let is_descent =
            movement.pace == Pace::Rapid && movement.is_known() && movement.to.z() < movement.from.z();
        if is_descent && movement.to.z() < surface - RESIDUE_HEIGHT && may_begin(movement) {
            self.open = Some(Excursion { line, surface, moves: vec![*movement] });
        }
        None
    }
}

impl Excursion {
    fn continues_with(&self, movement: &Move) -> bool {
        // If only some places are examined, distant moves are left out, so consecutive moves need not be connected.
        let follows = self.moves.last().is_some_and(|last| last.to == movement.from);
        follows && movement.pace == Pace::Rapid
    }

    /// Returns the height in mm to which the tool descends.
    pub(super) fn z(&self) -> f64 {
        self.moves[0].to.z()
    }

    /// Returns the position in the plane at which the tool has descended.
    pub(super) fn place(&self) -> Point {
        let [x, y, _] = self.moves[0].to.at;
        Point::new(x, y)
    }
}
