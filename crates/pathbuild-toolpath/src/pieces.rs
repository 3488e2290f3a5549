//! Cutting a move into pieces, each of which ends on the move's way at the height that it has there.

use nalgebra::{Complex, UnitComplex};
use pathbuild_path::Xy;

use crate::program::{Count, Height, Move, Step};

/// Where the tool is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tool {
    pub(crate) at: Xy,
    pub(crate) z: f64,
}

/// How far a piece of an arc may depart from its chord, as a part of the longest piece. Between its ends the height changes evenly along
/// the arc, that of a tilted plate evenly along the chord: the error is at most the tilt times this departure.
const DEPARTURE: f64 = 0.01;

/// What rounding may make a move longer that is to be exactly so many pieces.
const ROUNDING: f64 = 1e-9;

/// A move with the number of its pieces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cut {
    from: Tool,
    to: Move,
    count: Count,
    pieces: u64,
}

impl Cut {
    /// Cuts a move from `from`; `longest` is in mm, 0: it stays whole.
    pub(crate) fn new(from: Tool, to: Move, count: Count, longest: f64) -> Self {
        let parts = match to {
            _ if longest <= 0.0 => 1.0,
            Move::Line { .. } => count.length / longest,
            Move::Arc { centre, .. } => {
                let radius = centre.coords.norm();
                // The departure of an arc of an angle is radius * (1 - cos(angle / 2)), about radius * angle² / 8.
                let angle = libm::sqrt(8.0 * DEPARTURE * longest / radius);
                (count.length / longest).max(count.length / radius / angle)
            }
            Move::Sweep { .. } | Move::Lift { .. } | Move::Drill { .. } => 1.0,
        };
        Self { from, to, count, pieces: whole(parts - ROUNDING) }
    }

    /// How many pieces there are, 1 or more.
    pub(crate) fn pieces(&self) -> u64 {
        self.pieces
    }

    /// Where the move ends.
    pub(crate) fn end(&self) -> Tool {
        match self.to {
            Move::Sweep { to } => Tool { at: to, ..self.from },
            Move::Lift { z } | Move::Drill { z, .. } => Tool { z: z.z, ..self.from },
            Move::Line { to, z, .. } | Move::Arc { to, z, .. } => Tool { at: to, z: z.z },
        }
    }

    /// A piece, counted from 1, corrected where it ends.
    pub(crate) fn piece(&self, number: u64) -> Step {
        let Tool { at: to, z } = self.after(number);
        let z = Height { z, at: to };
        let moved = match self.to {
            Move::Sweep { .. } => Move::Sweep { to },
            Move::Lift { .. } => Move::Lift { z },
            Move::Drill { feed, .. } => Move::Drill { feed, z },
            Move::Line { feed, .. } => Move::Line { feed, to, z },
            Move::Arc { feed, clockwise, centre, is_spiral, .. } => {
                let centre = (self.from.at + centre.coords - self.after(number - 1).at).into();
                // A half circle of a spiral has I0; what is cut off it has not.
                let is_spiral = is_spiral && self.pieces == 1;
                Move::Arc { feed, clockwise, centre, to, z, is_spiral }
            }
        };
        Step::Move {
            to: moved,
            count: Count { length: self.count.length / self.pieces as f64, ..self.count },
        }
    }

    /// Where the tool is after so many pieces.
    fn after(&self, number: u64) -> Tool {
        let end = self.end();
        if number == self.pieces {
            return end;
        }
        let part = number as f64 / self.pieces as f64;
        let at = match self.to {
            Move::Arc { centre, clockwise, .. } => self.along_arc(centre, clockwise, part),
            _ => self.from.at + (end.at - self.from.at) * part,
        };
        Tool { at, z: self.from.z + (end.z - self.from.z) * part }
    }

    fn along_arc(&self, centre: Xy, clockwise: bool, part: f64) -> Xy {
        let angle = self.count.length / centre.coords.norm() * part;
        let (sin, cos) = libm::sincos(if clockwise { -angle } else { angle });
        self.from.at + centre.coords + UnitComplex::new_unchecked(Complex::new(cos, sin)) * -centre.coords
    }
}

/// Rounded up, at least 1.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, and is positive")]
fn whole(parts: f64) -> u64 {
    parts.ceil().max(1.0) as u64
}
