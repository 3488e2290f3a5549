//! Splits a move into parts, each of which ends at the height that the move has there.

use nalgebra::{Complex, UnitComplex};
use pathbuild_path::Xy;

use crate::program::{Count, Height, Move, Step};

/// Position of the tool.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tool {
    pub(crate) at: Xy,
    pub(crate) z: f64,
}

/// How far a part of an arc may deviate from its chord, as a fraction of the maximum length. Within a part the height changes linearly
/// along the arc, whereas that of a tilted plate changes linearly along the chord. The error is at most the tilt times this deviation.
const DEPARTURE: f64 = 0.01;

/// Relative increase in length that rounding may cause for a move of an exact number of parts.
const ROUNDING: f64 = 1e-9;

/// A move and the number of parts it is split into.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cut {
    from: Tool,
    to: Move,
    count: Count,
    pieces: u64,
}

impl Cut {
    /// Splits a move from `from`; `longest` is in mm, with 0 for not splitting at all.
    pub(crate) fn new(from: Tool, to: Move, count: Count, longest: f64) -> Self {
        let parts = match to {
            _ if longest <= 0.0 => 1.0,
            Move::Line { .. } => count.length / longest,
            Move::Arc { centre, .. } => {
                let radius = centre.coords.norm();
                // The deviation of an arc is radius * (1 - cos(angle / 2)), approximately radius * angle² / 8.
                let angle = libm::sqrt(8.0 * DEPARTURE * longest / radius);
                (count.length / longest).max(count.length / radius / angle)
            }
            Move::Sweep { .. } | Move::Lift { .. } | Move::Drill { .. } => 1.0,
        };
        Self { from, to, count, pieces: whole(parts - ROUNDING) }
    }

    /// Number of parts, at least 1.
    pub(crate) fn pieces(&self) -> u64 {
        self.pieces
    }

    /// End of the move.
    pub(crate) fn end(&self) -> Tool {
        match self.to {
            Move::Sweep { to } => Tool { at: to, ..self.from },
            Move::Lift { z } | Move::Drill { z, .. } => Tool { z: z.z, ..self.from },
            Move::Line { to, z, .. } | Move::Arc { to, z, .. } => Tool { at: to, z: z.z },
        }
    }

    /// A part, counted from 1, corrected at its end.
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
                // Half circles of a spiral are written with I0, but parts of them are not.
                let is_spiral = is_spiral && self.pieces == 1;
                Move::Arc { feed, clockwise, centre, to, z, is_spiral }
            }
        };
        Step::Move {
            to: moved,
            count: Count { length: self.count.length / self.pieces as f64, ..self.count },
        }
    }

    /// Position of the tool after this number of parts.
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

/// Rounds up, to at least 1.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, and is positive")]
fn whole(parts: f64) -> u64 {
    parts.ceil().max(1.0) as u64
}
