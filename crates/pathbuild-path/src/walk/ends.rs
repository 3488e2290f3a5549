//! Which segments have an end at a point.

use nalgebra::Vector2;

use crate::approx::coincide;
use crate::geometry::Xy;
use crate::path::Path;

/// The ends of a path's segments, sorted into squares, so that a step of the walk looks at its neighbourhood only.
pub(super) struct Ends {
    /// Start and end of each segment, as drawn.
    drawn: Vec<[Xy; 2]>,
    squares: Vec<(Square, u32)>,
}

/// A column, and a row in it.
type Square = (i64, i64);

/// Side of a square in mm.
const SIDE: f64 = 0.001;
/// How far squares are shifted, in mm: people draw at round numbers, and where squares meet is looked into two of them.
const SHIFT: f64 = 0.000_37;
/// Around a point is looked so far, in mm: a few times the distance within which points coincide.
const REACH: f64 = 0.0001;

impl Ends {
    pub(super) fn new(path: &Path) -> Self {
        let drawn: Vec<[Xy; 2]> = path.segments.iter().map(|segment| path.ends(segment)).collect();
        let mut squares = Vec::with_capacity(2 * drawn.len());
        for (index, [start, end]) in (0_u32..).zip(&drawn) {
            let (start, end) = (square(*start), square(*end));
            squares.push((start, index));
            if end != start {
                squares.push((end, index));
            }
        }
        squares.sort_unstable();
        Self { drawn, squares }
    }

    /// Where a segment starts and where it ends, as drawn.
    pub(super) fn of(&self, segment: usize) -> [Xy; 2] {
        self.drawn[segment]
    }

    /// Takes the segments with an end at a point; one whose ends are close together may be named twice.
    pub(super) fn each_near(&self, point: Xy, mut take: impl FnMut(usize)) {
        let reach = Vector2::new(REACH, REACH);
        let ((left, low), (right, high)) = (square(point - reach), square(point + reach));
        for column in left..=right {
            let first = self.squares.partition_point(|(square, _)| *square < (column, low));
            for (_, segment) in
                self.squares[first..].iter().take_while(|(square, _)| *square <= (column, high))
            {
                let segment = *segment as usize;
                if self.drawn[segment].iter().any(|end| coincide(*end, point)) {
                    take(segment);
                }
            }
        }
    }
}

fn square(point: Xy) -> Square {
    (floor((point.x + SHIFT) / SIDE), floor((point.y + SHIFT) / SIDE))
}

/// The whole number below. All that is very far off falls into one square.
#[expect(clippy::cast_possible_truncation, reason = "saturates")]
fn floor(number: f64) -> i64 {
    let towards_zero = number as i64;
    towards_zero.saturating_sub(i64::from(number < towards_zero as f64))
}
