//! What becomes of a path's moves when its drawing changes: which are added, removed, deeper, faster, shifted.
//!
//! Moves are compared in the coordinates of the program: a drawing that lies elsewhere on the sheet mills the same. (docs: "Comparing")

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

/// Moves in a row that changed in the same way.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// How.
    pub kind: ChangeKind,
    /// The moves in the old program; empty for those that are added.
    pub old: Range<usize>,
    /// The moves in the new program; empty for those that are removed.
    pub new: Range<usize>,
}

/// How moves change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ChangeKind {
    /// They are only in the new program.
    Added,
    /// They are only in the old program.
    Removed,
    /// They lead along the same lines as before, but what is milled there in the end has changed.
    Altered {
        /// By how many mm the lowest pass is higher; below 0 it is deeper.
        raised: f64,
        /// Its feed in mm/min before and after, where that changed.
        feed: Option<[f64; 2]>,
        /// How often the tool goes along before and after, where that changed.
        passes: Option<[u32; 2]>,
    },
    /// They are the same moves elsewhere, by so many mm in X and Y.
    Shifted(Point),
    /// What is milled along their lines in the end is what it was; when, in which direction or over which heights has changed.
    Reordered,
}
