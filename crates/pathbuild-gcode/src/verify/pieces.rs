//! Moves cut into pieces that are straight in the plane and nearly level.

use std::f64::consts::PI;

use crate::interpret::{Move, Path};

/// A piece of a slope is at most so high, in mm.
const STEP: f64 = 0.05;

/// The most pieces of one move.
const MOST: f64 = 4096.0;

/// A straight piece of a move.
#[derive(Clone, Copy, Debug)]
pub(super) struct MovePiece {
    pub(super) from: [f64; 3],
    pub(super) to: [f64; 3],
}

impl MovePiece {
    pub(super) fn lowest(&self) -> f64 {
        self.from[2].min(self.to[2])
    }

    pub(super) fn highest(&self) -> f64 {
        self.from[2].max(self.to[2])
    }
}

/// How many pieces a move has because it is not level, from 1 on.
pub(super) fn slopes(it: &Move) -> f64 {
    let is_plunge = it.from.at[..2] == it.to.at[..2] && matches!(it.path, Path::Line);
    let rise = libm::fabs(it.to.z() - it.from.z());
    if is_plunge { 1.0 } else { (rise / STEP).ceil().clamp(1.0, MOST) }
}

/// How many pieces a move is cut into, from 1 on.
pub(super) fn count(it: &Move, sagitta: f64) -> u32 {
    let slope = slopes(it);
    let count = match it.path {
        Path::Line => slope,
        Path::Arc(arc) => {
            let radius = arc.radius(&it.from).max(sagitta);
            let angle = 2.0 * libm::acos((1.0 - sagitta / radius).max(0.0)).min(PI / 4.0);
            slope.max(arc.sweep(&it.from, &it.to) / angle)
        }
    };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to MOST")]
    let count = count.ceil().clamp(1.0, MOST) as u32;
    count
}

/// The pieces of a move; arcs become chords that leave them by at most `sagitta` mm.
pub(super) fn pieces(it: &Move, sagitta: f64) -> impl Iterator<Item = MovePiece> + use<> {
    let (it, number_of_pieces) = (*it, count(it, sagitta));
    let count = f64::from(number_of_pieces);
    let at = move |number: u32| {
        let share = f64::from(number) / count;
        match it.path {
            _ if share >= 1.0 => it.to.at,
            Path::Line => {
                std::array::from_fn(|axis| it.from.at[axis] + share * (it.to.at[axis] - it.from.at[axis]))
            }
            Path::Arc(arc) => arc.point(&it.from, &it.to, share),
        }
    };
    (0..number_of_pieces).map(move |number| MovePiece { from: at(number), to: at(number + 1) })
}
