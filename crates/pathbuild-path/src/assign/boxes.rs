//! Boxes around the candidates of a layer, so that a text looks at those around it only.

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::Candidate;
use crate::element::Shape;
use crate::geometry::{Curve, Xy};
use crate::text_circle::TextCircle;

/// Where the candidates of a layer lie.
pub(crate) enum Boxes {
    /// Few are all looked at: that is sooner done than to make a tree of them.
    List(Vec<Box2>),
    Tree(RTree<GeomWithData<Rectangle<[f64; 2]>, usize>>),
}

/// A rectangle along the axes, by its corners.
#[derive(Clone, Copy)]
pub(crate) struct Box2 {
    low: [f64; 2],
    high: [f64; 2],
}

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
        let boxes = candidates.iter().map(|candidate| Box2::around(&candidate.shape));
        if candidates.len() <= FEW {
            return Self::List(boxes.collect());
        }
        let numbered = boxes.zip(0..).map(|(box_, index)| GeomWithData::new(box_.envelope().into(), index));
        Self::Tree(RTree::bulk_load(numbered.collect()))
    }

    /// Takes each candidate whose box a circle touches, in any order.
    pub(super) fn each_touched(&self, circle: &TextCircle, mut take: impl FnMut(usize)) {
        let searched = Box2::square(circle.centre, circle.radius);
        match self {
            Self::List(boxes) => {
                let touched = boxes.iter().enumerate().filter(|(_, box_)| box_.touches(&searched));
                touched.for_each(|(index, _)| take(index));
            }
            Self::Tree(tree) => {
                let found = tree.locate_in_envelope_intersecting(searched.envelope());
                found.for_each(|found| take(found.data));
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

impl Box2 {
    /// A box around a shape; of an arc around its whole circle.
    fn around(shape: &Shape) -> Self {
        match shape {
            Shape::Circle { centre, radius } => Self::square(*centre, *radius),
            Shape::Curve(Curve::Arc(arc)) => Self::square(arc.centre, arc.radius),
            Shape::Curve(Curve::Line(line)) => Self {
                low: [line.start.x.min(line.end.x), line.start.y.min(line.end.y)],
                high: [line.start.x.max(line.end.x), line.start.y.max(line.end.y)],
            },
        }
    }

    fn square(centre: Xy, half: f64) -> Self {
        // Texts may have any height, also one below 0.
        let half = (half + SLACK).abs();
        Self { low: [centre.x - half, centre.y - half], high: [centre.x + half, centre.y + half] }
    }

    #[expect(
        clippy::needless_bitwise_bool,
        reason = "four comparisons at once, none of which has to be guessed"
    )]
    fn touches(&self, other: &Self) -> bool {
        (self.low[0] <= other.high[0])
            & (self.low[1] <= other.high[1])
            & (other.low[0] <= self.high[0])
            & (other.low[1] <= self.high[1])
    }

    fn envelope(&self) -> AABB<[f64; 2]> {
        AABB::from_corners(self.low, self.high)
    }
}
