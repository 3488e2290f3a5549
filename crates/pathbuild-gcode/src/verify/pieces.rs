//! Divides moves into parts that are straight in the plane and almost level.

use pathbuild_motion::{Move, MoveShape, widest_chord};

/// Maximum height of a part of a slope, in mm.
const STEP: f64 = 0.05;

/// Maximum number of parts per move.
const MOST: f64 = 4096.0;

/// A straight part of a move.
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

/// Number of parts required because a move is not level, at least 1.
pub(super) fn slopes(movement: &Move) -> f64 {
    let is_plunge = movement.from.at[..2] == movement.to.at[..2] && matches!(movement.shape, MoveShape::Line);
    let rise = libm::fabs(movement.to.z() - movement.from.z());
    if is_plunge { 1.0 } else { (rise / STEP).ceil().clamp(1.0, MOST) }
}

/// Number of parts into which a move is divided, at least 1.
pub(super) fn count(movement: &Move, sagitta: f64) -> u32 {
    let slope = slopes(movement);
    let count = match movement.shape {
        MoveShape::Line => slope,
        MoveShape::Arc(arc) => slope
            .max(arc.sweep(&movement.from, &movement.to) / widest_chord(arc.radius(&movement.from), sagitta)),
    };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to MOST")]
    let count = count.ceil().clamp(1.0, MOST) as u32;
    count
}

/// The parts of a move. Arcs become chords at a distance of at most `sagitta` mm.
pub(super) fn pieces(movement: &Move, sagitta: f64) -> impl Iterator<Item = MovePiece> + use<> {
    movement.split(count(movement, sagitta)).map(|piece| MovePiece { from: piece.from.at, to: piece.to.at })
}
