//! Walking along a list of moves, piece by piece.

use pathbuild_motion::{Axes, Course, Move, Pace, Path};

use super::compare::is_near;

/// Somewhere on a list of moves.
pub(super) struct Walker<'m> {
    moves: &'m [(u32, Move)],
    index: usize,
    /// The share of the current move that is behind us.
    done: f64,
}

/// What is left of a move.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub(super) it: Move,
    /// The share of the move where it begins.
    pub(super) begin: f64,
    /// What is left of its length in mm; of a move from an unknown place 0.
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

    /// The last move of all with its line.
    pub(super) fn last(&self) -> Option<(u32, Move)> {
        self.moves.last().copied()
    }

    /// Whether a part of the current move is behind us.
    pub(super) fn is_within(&self) -> bool {
        self.done > 0.0
    }

    /// What is left of the current move.
    pub(super) fn stretch(&self) -> Option<Stretch> {
        let (_, it) = self.current()?;
        Some(Stretch { it, begin: self.done, length: it.length() * (1.0 - self.done) })
    }

    /// Where the tool is, if there are moves at all.
    pub(super) fn place(&self) -> Option<[f64; 3]> {
        match self.stretch() {
            Some(stretch) if stretch.it.from.known == Axes::ALL => Some(stretch.point(stretch.begin)),
            Some(stretch) => Some(stretch.end()),
            None => self.last().map(|(_, it)| it.to.at),
        }
    }

    pub(super) fn finish_move(&mut self) {
        self.index += 1;
        self.done = 0.0;
    }

    /// Goes on to this share of the current move.
    pub(super) fn go_to(&mut self, share: f64) {
        self.done = share;
    }

    /// Goes over rapid moves to the first place that will do; if there is none, stays.
    pub(super) fn skip_rapids_to(&mut self, will_do: impl Fn(&[f64; 3]) -> bool) -> bool {
        let rapids = self.moves[self.index..].iter().take_while(|(_, it)| it.pace == Pace::Rapid);
        let found = rapids.clone().position(|(_, it)| will_do(&it.to.at));
        self.index += found.map_or(0, |passed| passed + 1);
        found.is_some()
    }
}

impl Stretch {
    pub(super) fn whole(it: Move) -> Self {
        Self { it, begin: 0.0, length: it.length() }
    }

    pub(super) fn end(&self) -> [f64; 3] {
        self.it.to.at
    }

    pub(super) fn is_arc(&self) -> bool {
        matches!(self.it.path, Path::Arc(_))
    }

    /// The place at a share of the whole move.
    pub(super) fn point(&self, share: f64) -> [f64; 3] {
        self.it.point(share)
    }

    /// Whether both end at one place, not one a whole turn later than the other.
    pub(super) fn end_together(&self, other: &Self, slack: f64) -> bool {
        let from_unknown = self.it.from.known != Axes::ALL || other.it.from.known != Axes::ALL;
        is_near(&self.end(), &other.end(), slack)
            && (from_unknown || are_alike(self.length, other.length, slack))
    }

    /// The share of the move at which it comes nearest to a place about `along` mm ahead; `None` if it has no length.
    pub(super) fn nearest(&self, place: &[f64; 3], along: f64) -> Option<f64> {
        let whole = self.it.length();
        if whole <= 0.0 {
            return None;
        }
        let share = match self.it.path {
            Path::Line => {
                let way: [f64; 3] = std::array::from_fn(|axis| self.it.to.at[axis] - self.it.from.at[axis]);
                (0..3).map(|axis| (place[axis] - self.it.from.at[axis]) * way[axis]).sum::<f64>()
                    / (whole * whole)
            }
            Path::Arc(arc) => {
                let guess = (self.begin + along / whole).min(1.0);
                let course = Course::new(arc, &self.it.from, &self.it.to);
                guess + arc.angle_ahead(&course.point(guess), place) / course.sweep()
            }
        };
        Some(share.clamp(self.begin, 1.0))
    }

    /// How much an arc rises or falls in each mm of its plane; 0 of a line.
    pub(super) fn steepness(&self) -> f64 {
        let rise = libm::fabs(self.it.to.z() - self.it.from.z());
        let way = libm::sqrt((self.it.length() * self.it.length() - rise * rise).max(0.0));
        if self.is_arc() && way > 0.0 { rise / way } else { 0.0 }
    }
}

/// Whether two lengths are of one way, which may be rounded, and not of that and a whole turn more.
pub(super) fn are_alike(one: f64, other: f64, slack: f64) -> bool {
    one.max(other) <= 1.25 * one.min(other) + 10.0 * slack
}
