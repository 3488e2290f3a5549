//! Where an arc is said to end, so that three decimals do not make another arc of it.
//!
//! A controller has only the printed numbers. An arc that ends, as printed, where it begins is a full circle to it; one that ends just
//! behind its beginning goes nearly all the way round. So an arc that is nearly nothing may become a circle through the work, and a
//! circle may become nothing.

use std::f64::consts::{PI, TAU};

use pathbuild_motion::turn;
use pathbuild_toolpath::Xy;

use super::number::printed;

/// One unit of the last printed digit, in mm.
pub(super) const LAST_DIGIT: f64 = 0.001;

/// Whether the radius of an arc is printed as nothing, which no controller takes for an arc: it is written as a line.
pub(crate) fn is_point(centre: Xy) -> bool {
    rounded(centre) == Xy::origin()
}

/// Whether an arc of this length in mm is so short, or so near to a whole turn, that three decimals may make another of it.
pub(crate) fn is_doubtful(centre: Xy, length: f64) -> bool {
    length < DOUBTFUL || length > TAU * centre.coords.norm() - DOUBTFUL
}

/// Several times what rounding moves an end along the arc, in mm.
const DOUBTFUL: f64 = 10.0 * LAST_DIGIT;

/// An arc from wherever the tool was said to be.
pub(super) struct Printed {
    pub(super) from: Xy,
    /// Relative to `from`.
    pub(super) centre: Xy,
    pub(super) clockwise: bool,
}

impl Printed {
    /// As a controller reads it.
    pub(super) fn new(from: Xy, centre: Xy, clockwise: bool) -> Self {
        Self { from: rounded(from), centre: rounded(centre), clockwise }
    }

    /// The end to print for an arc of this length in mm: `to`, or the printable point next to it with which the arc goes round as far as
    /// it should.
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

    /// How far a controller goes round to an end, in radians; 2 pi where it ends as it begins.
    fn angle(&self, end: Xy) -> f64 {
        let (spoke, other) = (-self.centre.coords, end - (self.from + self.centre.coords));
        turn(spoke.into(), other.into(), self.clockwise)
    }
}

fn rounded(at: Xy) -> Xy {
    Xy::new(printed(at.x), printed(at.y))
}
