//! Chooses the printed end of an arc so that rounding to three decimals does not change the arc.
//!
//! A controller only has the printed numbers. If the printed end of an arc equals its start, it is a full circle; if the end is just past
//! the start, the arc is almost a full turn. So a minimal arc could become a circle through the workpiece, and a circle could become
//! nothing.

use std::f64::consts::PI;

use pathbuild_motion::turn;
use pathbuild_toolpath::{LAST_DIGIT, Xy};

use super::number::printed;

/// An arc from the printed position of the tool.
pub(super) struct Printed {
    pub(super) from: Xy,
    /// Relative to `from`.
    pub(super) centre: Xy,
    pub(super) clockwise: bool,
}

impl Printed {
    /// Rounds the values as they are printed.
    pub(super) fn new(from: Xy, centre: Xy, clockwise: bool) -> Self {
        Self { from: rounded(from), centre: rounded(centre), clockwise }
    }

    /// The end to print for an arc of this length in mm: `to`, or the printable point next to it with which the arc sweeps the required
    /// angle.
    pub(super) fn end(&self, to: Xy, length: f64) -> Xy {
        let angle = length / self.centre.coords.norm();
        let fits = |end: &Xy| (self.angle(*end) - angle).abs() <= PI;
        let nearest = rounded(to);
        if fits(&nearest) {
            return to;
        }
        let beside = |middle: Xy| {
            let steps = || [-LAST_DIGIT, 0.0, LAST_DIGIT].into_iter();
            steps().flat_map(move |x| steps().map(move |y| rounded(Xy::new(middle.x + x, middle.y + y))))
        };
        let distance = |end: &Xy| (end - to).norm();
        let candidates = beside(nearest).chain(beside(self.from)).filter(fits);
        candidates.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(to)
    }

    /// The angle in radians that a controller sweeps to an end; 2 pi if it equals the start.
    fn angle(&self, end: Xy) -> f64 {
        let (spoke, other) = (-self.centre.coords, end - (self.from + self.centre.coords));
        turn(spoke.into(), other.into(), self.clockwise)
    }
}

fn rounded(at: Xy) -> Xy {
    Xy::new(printed(at.x), printed(at.y))
}
