//! Classifies how the moves of a path change with its drawing: added, removed, deeper, faster, shifted.
//!
//! Moves are compared in the coordinates of the program, so moving a drawing on the sheet changes nothing. (docs: "Comparing")

mod compare;
mod groups;
mod identity;
#[cfg(test)]
mod tests;
mod words;

use std::ops::Range;

use crate::scene::Point;

pub use compare::compare;
pub use groups::{Group, groups};
pub use words::{moves, phrase};

/// Consecutive moves that changed in the same way.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// The kind of change.
    pub kind: ChangeKind,
    /// The moves in the old program; empty if they were added.
    pub old: Range<usize>,
    /// The moves in the new program; empty if they were removed.
    pub new: Range<usize>,
}

/// How moves changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ChangeKind {
    /// Only in the new program.
    Added,
    /// Only in the old program.
    Removed,
    /// They follow the same lines as before, with a different final result.
    Altered {
        /// How many mm the deepest pass is higher; negative if it is deeper.
        raised: f64,
        /// Its feed in mm/min before and after, if that changed.
        feed: Option<[f64; 2]>,
        /// The number of passes before and after, if that changed.
        passes: Option<[u32; 2]>,
    },
    /// The same moves at another place, by this offset in mm.
    Shifted(Point),
    /// The final result is the same, but the order, the direction or the intermediate heights changed.
    Reordered,
}
