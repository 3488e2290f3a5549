//! Boxes around the candidates of a layer, so that a text looks at those around it only.

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};
use wide::f32x4;

use super::Candidate;
use crate::element::Shape;
use crate::geometry::{Curve, Xy};
use crate::text_circle::TextCircle;

/// Where the candidates of a layer lie.
pub(crate) enum Boxes {
    /// Few are all looked at: that is sooner done than to make a tree of them.
    List(Vec<Sides>),
    Tree(RTree<GeomWithData<Rectangle<[f64; 2]>, usize>>),
}

/// The left and lower side of a box, and its right and upper one, negated, so that all four are compared at once. Rounded outwards.
#[derive(Clone, Copy)]
pub(crate) struct Sides(f32x4);

/// How many candidates are few.
const FEW: usize = 128;

/// Boxes are larger by this than what they hold, in mm: rounding must not decide what a text touches.
const SLACK: f64 = 1e-6;

impl Default for Boxes {
    fn default() -> Self {
        Self::List(Vec::new())
    }
}

impl Boxes {
    pub(crate) fn new(candidates: &[Candidate]) -> Self {
        let boxes = candidates.iter().map(|candidate| around(&candidate.shape));
        if candidates.len() <= FEW {
            return Self::List(boxes.map(|box_| Sides::of(&box_)).collect());
        }
        let numbered = boxes.zip(0..).map(|(box_, index)| GeomWithData::new(box_.into(), index));
        Self::Tree(RTree::bulk_load(numbered.collect()))
    }

    /// Takes each candidate whose box a circle touches, in any order; in a list also some that it nearly touches.
    pub(super) fn each_touched(&self, circle: &TextCircle, mut take: impl FnMut(usize)) {
        let searched = square(circle.centre, circle.radius);
        match self {
            Self::List(boxes) => {
                let limits = Sides::limits(&searched);
                let touched = boxes.iter().enumerate().filter(|(_, sides)| sides.are_within(limits));
                touched.for_each(|(index, _)| take(index));
            }
            Self::Tree(tree) => {
                tree.locate_in_envelope_intersecting(searched).for_each(|found| take(found.data));
            }
        }
    }

    /// The candidates with a distance of a point in mm that none of them is nearer than; the least distances first.
    pub(super) fn nearest(&self, point: Xy) -> Box<dyn Iterator<Item = (usize, f64)> + '_> {
        let at_least = |squared: f64| libm::sqrt(squared) - SLACK;
        match self {
            // Nothing is gained by sorting a few.
            Self::List(boxes) => Box::new((0..boxes.len()).map(|index| (index, f64::NEG_INFINITY))),
            Self::Tree(tree) => {
                let found = tree.nearest_neighbor_iter_with_distance_2([point.x, point.y]);
                Box::new(found.map(move |(found, squared)| (found.data, at_least(squared))))
            }
        }
    }
}

impl Sides {
    fn of(box_: &AABB<[f64; 2]>) -> Self {
        let ([left, low], [right, high]) = (box_.lower(), box_.upper());
        Self(f32x4::from([left, low, -right, -high].map(|side| rounded(side, -ROUNDING))))
    }

    /// Up to where the sides of boxes are that touch this one.
    fn limits(box_: &AABB<[f64; 2]>) -> f32x4 {
        let ([left, low], [right, high]) = (box_.lower(), box_.upper());
        f32x4::from([right, high, -left, -low].map(|side| rounded(side, ROUNDING)))
    }

    fn are_within(self, limits: f32x4) -> bool {
        self.0.simd_le(limits).all()
    }
}

/// More than a number changes, as part of itself, when it becomes an `f32`.
const ROUNDING: f64 = 1e-7;

#[expect(clippy::cast_possible_truncation, reason = "what is lost is made up for before")]
fn rounded(side: f64, by: f64) -> f32 {
    (side + by * side.abs()) as f32
}

/// A box around a shape; of an arc around its whole circle.
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
