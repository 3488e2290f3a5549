//! Bounding boxes of the candidates of a layer, so that a text is only compared with nearby ones.

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};
use wide::f32x4;

use super::Candidate;
use crate::element::Shape;
use crate::geometry::{Curve, Xy};
use crate::text_circle::TextCircle;

/// A spatial index of the candidates of a layer.
pub(crate) enum CandidateIndex {
    /// For a few candidates: scanning all of them is faster than building a tree.
    List(List),
    Tree(RTree<GeomWithData<Rectangle<[f64; 2]>, usize>>),
}

/// The bounding boxes of a few candidates.
pub(crate) struct List {
    fours: Vec<BoxGroup>,
    count: usize,
}

/// The left, lower, right and upper sides of four boxes, the last two negated, so that all four boxes are compared at once. Rounded
/// outwards.
struct BoxGroup([f32x4; 4]);

/// The sides of one box, in the same order.
type Sides = [f32; 4];

/// Maximum number of candidates in a list.
pub(super) const FEW: usize = 128;

/// Number of boxes compared before those that are touched are processed.
const BITS: usize = u64::BITS as usize;

/// Margin in mm around each box, so that rounding does not decide which candidates a text touches.
const SLACK: f64 = 1e-6;

impl Default for CandidateIndex {
    fn default() -> Self {
        Self::new(&[])
    }
}

impl CandidateIndex {
    pub(crate) fn new(candidates: &[Candidate]) -> Self {
        let boxes = candidates.iter().map(|candidate| around(&candidate.shape));
        if candidates.len() <= FEW {
            return Self::List(List::new(boxes));
        }
        let numbered = boxes.zip(0..).map(|(box_, index)| GeomWithData::new(box_.into(), index));
        Self::Tree(RTree::bulk_load(numbered.collect()))
    }

    /// Calls `take` for each candidate whose box touches a circle, in any order. A list also yields some near misses.
    pub(super) fn each_touched(&self, circle: &TextCircle, mut take: impl FnMut(usize)) {
        let searched = square(circle.centre, circle.radius);
        match self {
            Self::List(list) => list.each_within(limits(&searched), take),
            Self::Tree(tree) => {
                tree.locate_in_envelope_intersecting(searched).for_each(|found| take(found.data));
            }
        }
    }

    /// The candidates, each with a lower bound for its distance in mm from a point, in ascending order.
    pub(super) fn nearest(&self, point: Xy) -> Box<dyn Iterator<Item = (usize, f64)> + '_> {
        let at_least = |squared: f64| libm::sqrt(squared) - SLACK;
        match self {
            // Sorting a few candidates is not worth the effort.
            Self::List(list) => Box::new((0..list.count).map(|index| (index, f64::NEG_INFINITY))),
            Self::Tree(tree) => {
                let found = tree.nearest_neighbor_iter_with_distance_2([point.x, point.y]);
                Box::new(found.map(move |(found, squared)| (found.data, at_least(squared))))
            }
        }
    }
}

impl List {
    fn new(boxes: impl Iterator<Item = AABB<[f64; 2]>>) -> Self {
        let (mut fours, mut count) = (Vec::new(), 0);
        let mut sides = boxes.map(|box_| sides(&box_));
        while let Some(first) = sides.next() {
            // Missing boxes of the last group never match, even if the limits are infinite.
            let mut four = [first, [f32::NAN; 4], [f32::NAN; 4], [f32::NAN; 4]];
            count += 1;
            for (place, next) in four[1..].iter_mut().zip(&mut sides) {
                *place = next;
                count += 1;
            }
            fours.push(BoxGroup(std::array::from_fn(|side| f32x4::from(four.map(|sides| sides[side])))));
        }
        Self { fours, count }
    }

    fn each_within(&self, limits: Sides, mut take: impl FnMut(usize)) {
        let limits = limits.map(f32x4::splat);
        let mut first = 0;
        for fours in self.fours.chunks(BITS / 4) {
            // First all matches are collected as bits, then processed, since matches are rare and unpredictable for the branch predictor.
            let found = |BoxGroup(sides): &BoxGroup| {
                let [left, low, right, high] = std::array::from_fn(|side| sides[side].simd_le(limits[side]));
                ((left & low) & (right & high)).to_bitmask()
            };
            let mut all = fours.iter().rev().fold(0, |all, four| all << 4 | u64::from(found(four)));
            while all != 0 {
                take(first + all.trailing_zeros() as usize);
                all &= all - 1;
            }
            first += BITS;
        }
    }
}

fn sides(box_: &AABB<[f64; 2]>) -> Sides {
    let ([left, low], [right, high]) = (box_.lower(), box_.upper());
    [left, low, -right, -high].map(|side| rounded(side, -ROUNDING))
}

/// Upper limits for the sides of boxes that touch this one.
fn limits(box_: &AABB<[f64; 2]>) -> Sides {
    let ([left, low], [right, high]) = (box_.lower(), box_.upper());
    [right, high, -left, -low].map(|side| rounded(side, ROUNDING))
}

/// Relative error bound for the conversion of a number to `f32`.
const ROUNDING: f64 = 1e-7;

#[expect(clippy::cast_possible_truncation, reason = "what is lost is made up for before")]
fn rounded(side: f64, by: f64) -> f32 {
    (side + by * side.abs()) as f32
}

/// The bounding box of a shape; an arc gets that of its whole circle.
fn around(shape: &Shape) -> AABB<[f64; 2]> {
    match shape {
        Shape::Circle { centre, radius } => square(*centre, *radius),
        Shape::Curve(Curve::Arc(arc)) => square(arc.centre, arc.radius),
        Shape::Curve(Curve::Line(line)) => {
            AABB::from_corners([line.start.x, line.start.y], [line.end.x, line.end.y])
        }
    }
}

fn square(centre: Xy, half: f64) -> AABB<[f64; 2]> {
    let half = half + SLACK;
    AABB::from_corners([centre.x - half, centre.y - half], [centre.x + half, centre.y + half])
}
