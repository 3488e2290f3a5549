//! Walks along a list of moves, part by part.

use pathbuild_motion::{Axes, Course, Move, MoveShape, Pace};

use super::compare::is_near;

/// A position in a list of moves.
pub(super) struct Walker<'m> {
    moves: &'m [(u32, Move)],
    index: usize,
    /// The fraction of the current move that has been done.
    done: f64,
}

/// The rest of a move.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub(super) movement: Move,
    /// The fraction of the move at which it begins.
    pub(super) begin: f64,
    /// Its length in mm; 0 for a move from an unknown position.
    pub(super) length: f64,
}

impl<'m> Walker<'m> {
    pub(super) fn new(moves: &'m [(u32, Move)]) -> Self {
        Self { moves, index: 0, done: 0.0 }
    }

    /// The current move with its line.
    pub(super) fn current(&self) -> Option<(u32, Move)> {
        self.moves.get(self.index).copied()
    }

    /// The last move of the list with its line.
    pub(super) fn last(&self) -> Option<(u32, Move)> {
        self.moves.last().copied()
    }

    /// Whether a part of the current move has been done.
    pub(super) fn is_within(&self) -> bool {
        self.done > 0.0
    }

    /// The rest of the current move.
    pub(super) fn stretch(&self) -> Option<Stretch> {
        let (_, movement) = self.current()?;
        Some(Stretch { movement, begin: self.done, length: movement.length() * (1.0 - self.done) })
    }

    /// The current position, unless there are no moves.
    pub(super) fn place(&self) -> Option<[f64; 3]> {
        match self.stretch() {
            Some(stretch) if stretch.movement.from.known == Axes::ALL => Some(stretch.point(stretch.begin)),
            Some(stretch) => Some(stretch.end()),
            None => self.last().map(|(_, movement)| movement.to.at),
        }
    }

    pub(super) fn finish_move(&mut self) {
        self.index += 1;
        self.done = 0.0;
    }

    /// Advances to this fraction of the current move.
    pub(super) fn go_to(&mut self, share: f64) {
        self.done = share;
    }

    /// Advances over rapid moves to the first position that satisfies the condition. If there is none, it stays. Returns whether it moved.
    pub(super) fn skip_rapids_to(&mut self, will_do: impl Fn(&[f64; 3]) -> bool) -> bool {
        let rapids = self.moves[self.index..].iter().take_while(|(_, movement)| movement.pace == Pace::Rapid);
        let found = rapids.clone().position(|(_, movement)| will_do(&movement.to.at));
        self.index += found.map_or(0, |passed| passed + 1);
        found.is_some()
    }
}

impl Stretch {
    pub(super) fn whole(movement: Move) -> Self {
        Self { movement, begin: 0.0, length: movement.length() }
    }

    pub(super) fn end(&self) -> [f64; 3] {
        self.movement.to.at
    }

    pub(super) fn is_arc(&self) -> bool {
        matches!(self.movement.shape, MoveShape::Arc(_))
    }

    /// The place at a share of the whole move.
    pub(super) fn point(&self, share: f64) -> [f64; 3] {
        self.movement.point(share)
    }

    /// Whether both end at the same position, and not one of them a full turn later.
    pub(super) fn end_together(&self, other: &Self, slack: f64) -> bool {
        let from_unknown = self.movement.from.known != Axes::ALL || other.movement.from.known != Axes::ALL;
        is_near(&self.end(), &other.end(), slack)
            && (from_unknown || are_alike(self.length, other.length, slack))
    }

    /// The fraction of the move at which it is nearest to a position about `along` mm ahead; `None` if the move has no length.
    pub(super) fn nearest(&self, place: &[f64; 3], along: f64) -> Option<f64> {
        let whole = self.movement.length();
        if whole <= 0.0 {
            return None;
        }
        let share = match self.movement.shape {
            MoveShape::Line => {
                let way: [f64; 3] =
                    std::array::from_fn(|axis| self.movement.to.at[axis] - self.movement.from.at[axis]);
                (0..3).map(|axis| (place[axis] - self.movement.from.at[axis]) * way[axis]).sum::<f64>()
                    / (whole * whole)
            }
            MoveShape::Arc(arc) => {
                let guess = (self.begin + along / whole).min(1.0);
                let course = Course::new(arc, &self.movement.from, &self.movement.to);
                guess + arc.angle_ahead(&course.point(guess), place) / course.sweep()
            }
        };
        Some(share.clamp(self.begin, 1.0))
    }

    /// Rise or fall of an arc per mm in its plane; 0 for a line.
    pub(super) fn steepness(&self) -> f64 {
        let rise = libm::fabs(self.movement.to.z() - self.movement.from.z());
        let way = libm::sqrt((self.movement.length() * self.movement.length() - rise * rise).max(0.0));
        if self.is_arc() && way > 0.0 { rise / way } else { 0.0 }
    }
}

/// Whether two lengths differ only by rounding, and not by a full turn.
pub(super) fn are_alike(one: f64, other: f64, slack: f64) -> bool {
    one.max(other) <= 1.25 * one.min(other) + 10.0 * slack
}
