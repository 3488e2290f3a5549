//! A call of a control text before its variables are set.

use pathbuild_motion::Move;

use crate::step::Hole;

/// X, Y, Z in mm.
pub(super) type Point = [f64; 3];

/// A call and the operation it belongs to.
#[derive(Debug)]
pub(super) struct Call<'a> {
    pub(super) operation: usize,
    pub(super) what: What<'a>,
}

/// What the called text has to write.
#[derive(Debug)]
pub(super) enum What<'a> {
    /// Moves to the start of a contour at safety height, down to working height by rapid, and down to depth at feed.
    Start { at: Point, clearance: f64, working: f64, feed: Option<f64> },
    /// A straight element.
    Line { to: Point, feed: Option<f64>, place: ContourPosition },
    /// A circular element.
    Arc { movement: Move, place: ContourPosition },
    /// Retracts from the end of a contour.
    End { clearance: f64 },
    /// A hole.
    Hole { hole: Hole, clearance: f64 },
    /// A rapid move that does not lead to a contour.
    Rapid { to: Point },
    /// A dwell, in seconds.
    Dwell(f64),
    /// A stop that waits for the operator.
    Stop,
    /// A comment.
    Comment(&'a str),
}

/// The position of an element within its contour.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ContourPosition {
    /// Whether it is the first element, or the first one after a change of feed.
    pub(super) is_first: bool,
    pub(super) is_last: bool,
}
