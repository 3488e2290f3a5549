//! Which segments have an end at a point.

use nalgebra::Vector2;

use crate::approx::coincide;
use crate::geometry::Xy;
use crate::path::Path;

/// The ends of a path's segments, sorted into squares, so that a step of the walk looks at its neighbourhood only.
pub(super) struct Ends {
    /// Start and end of each segment, as drawn.
    drawn: Vec<[Xy; 2]>,
    /// The first end in the squares of a bucket, by the square's [`hash`]; their number is a power of two.
    buckets: Vec<u32>,
    /// The next end in the same bucket, for each start and end in turn.
    next: Vec<[u32; 2]>,
}

/// Its column and row.
#[derive(Clone, Copy)]
struct Square(i64, i64);

/// There is no further end in a bucket.
const NONE: u32 = u32::MAX;
/// Squares in a mm.
const SQUARES: f64 = 100.0;
/// How far squares are shifted, in mm: people draw at round numbers, and where squares meet is looked into two of them.
const SHIFT: f64 = 0.003_7;
/// Around a point is looked so far, in mm: a few times the distance within which points coincide.
const REACH: f64 = 0.0001;

impl Ends {
    pub(super) fn new(path: &Path) -> Self {
        let drawn: Vec<[Xy; 2]> = path.segments.iter().map(|segment| path.ends(segment)).collect();
        let mut buckets = vec![NONE; (2 * drawn.len()).next_power_of_two()];
        let mut next = Vec::with_capacity(drawn.len());
        for (index, ends) in (0_u32..).zip(&drawn) {
            let mut enter = |end: usize| {
                let bucket = bucket_of(square(ends[end]), buckets.len());
                std::mem::replace(&mut buckets[bucket], 2 * index + u32::from(end == 1))
            };
            next.push([enter(0), enter(1)]);
        }
        Self { drawn, buckets, next }
    }

    /// Where a segment starts and where it ends, as drawn.
    pub(super) fn of(&self, segment: usize) -> [Xy; 2] {
        self.drawn[segment]
    }

    /// Takes those of the wanted segments that have an end at a point, in any order; one may be named several times.
    pub(super) fn each_near(
        &self,
        point: Xy,
        is_wanted: impl Fn(usize) -> bool,
        mut take: impl FnMut(usize),
    ) {
        let reach = Vector2::new(REACH, REACH);
        let (Square(left, low), Square(right, high)) = (square(point - reach), square(point + reach));
        for column in left..=right {
            for row in low..=high {
                self.each_in(Square(column, row), |segment, end| {
                    if is_wanted(segment) && coincide(self.drawn[segment][end], point) {
                        take(segment);
                    }
                });
            }
        }
    }

    /// Takes the ends in a square, and those of others that share its bucket.
    fn each_in(&self, square: Square, mut take: impl FnMut(usize, usize)) {
        let mut at = self.buckets[bucket_of(square, self.buckets.len())];
        while at != NONE {
            let (segment, end) = (at as usize / 2, at as usize % 2);
            take(segment, end);
            at = self.next[segment][end];
        }
    }
}

fn square(point: Xy) -> Square {
    Square(floor((point.x + SHIFT) * SQUARES), floor((point.y + SHIFT) * SQUARES))
}

/// The whole number below. All that is very far off falls into one square.
#[expect(clippy::cast_possible_truncation, reason = "saturates")]
fn floor(number: f64) -> i64 {
    let towards_zero = number as i64;
    towards_zero.saturating_sub(i64::from(number < towards_zero as f64))
}

/// The bucket of a square among so many. The upper bits of a product depend on all bits of its factors.
#[expect(clippy::cast_sign_loss, reason = "any bits are as good")]
fn bucket_of(Square(column, row): Square, count: usize) -> usize {
    const ODD: u64 = 0x9E37_79B9_7F4A_7C15;
    let mixed = (column as u64).wrapping_mul(ODD).rotate_left(32) ^ row as u64;
    (mixed.wrapping_mul(ODD) >> 32) as usize & (count - 1)
}
