//! A call of a control text, before the variables are set.

use pathbuild_motion::Move;

use crate::step::Hole;

/// X, Y, Z in mm.
pub(super) type Point = [f64; 3];

/// One call, and the operation that it belongs to.
#[derive(Debug)]
pub(super) struct Call<'a> {
    pub(super) operation: usize,
    pub(super) what: What<'a>,
}

/// What is called for.
#[derive(Debug)]
pub(super) enum What<'a> {
    /// To the start of a contour at safety height, down to working height by rapid, to depth by feed.
    Start { at: Point, clearance: f64, working: f64, feed: Option<f64> },
    /// A straight element.
    Line { to: Point, feed: Option<f64>, place: ContourPosition },
    /// A circular element.
    Arc { it: Move, place: ContourPosition },
    /// Up from the end of a contour.
    End { clearance: f64 },
    /// A hole.
    Hole { hole: Hole, clearance: f64 },
    /// A rapid move of its own.
    Rapid { to: Point },
    /// Standing still, in seconds.
    Dwell(f64),
    /// Waiting for a person.
    Stop,
    /// A remark.
    Comment(&'a str),
}

/// Where in its contour an element is.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ContourPosition {
    /// The first one, or the first one with another feed.
    pub(super) is_first: bool,
    pub(super) is_last: bool,
}
