//! A spatial index of clamps, for finding those that a move hits.

use rstar::RTree;
use rstar::primitives::{GeomWithData, Rectangle};

use super::outline::{Outline, around};
use crate::approx::above;
use crate::geometry::Curve;

/// The path of the tool tip in one move: along a curve in the plane, with a constant slope. A vertical move is a line without length.
/// Lengths are in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Way {
    pub curve: Curve,
    pub from_z: f64,
    pub to_z: f64,
}

/// A spatial index of clamps.
#[derive(Clone, Debug)]
pub struct KeepOutMap {
    clamps: Vec<Clamp>,
    boxes: RTree<GeomWithData<Rectangle<[f64; 2]>, usize>>,
}

#[derive(Clone, Debug)]
struct Clamp {
    height: f64,
    outline: Outline,
}

impl KeepOutMap {
    /// Creates a map from the heights and outlines of clamps.
    pub fn new<'k>(clamps: impl IntoIterator<Item = (f64, &'k [Curve])>) -> Self {
        let clamp = |(height, outline)| Clamp { height, outline: Outline::new(outline) };
        let clamps: Vec<Clamp> = clamps.into_iter().map(clamp).collect();
        let boxes = clamps
            .iter()
            .zip(0..)
            .map(|(clamp, number)| GeomWithData::new(Rectangle::from_aabb(clamp.outline.extent()), number));
        Self { boxes: RTree::bulk_load(boxes.collect()), clamps }
    }

    /// Whether there are no clamps.
    pub fn is_empty(&self) -> bool {
        self.clamps.is_empty()
    }

    /// The numbers of the clamps that a tool of this radius hits on its way, in ascending order. `slack`: tolerance in mm for rounding
    /// errors.
    pub fn entered(&self, way: &Way, radius: f64, slack: f64) -> Vec<usize> {
        let radius = (radius - slack).max(0.0);
        let near = self.boxes.locate_in_envelope_intersecting(around(&way.curve, radius));
        let is_entered = |number: &usize| {
            let clamp = &self.clamps[*number];
            let below = way.below(clamp.height - slack);
            below.is_some_and(|curve| clamp.outline.is_entered(&curve, radius))
        };
        let mut entered: Vec<usize> = near.map(|clamp| clamp.data).filter(is_entered).collect();
        entered.sort_unstable();
        entered
    }
}

impl Way {
    /// The lowest height.
    pub fn lowest(&self) -> f64 {
        self.from_z.min(self.to_z)
    }

    /// The part of the way below a height.
    pub(crate) fn below(&self, height: f64) -> Option<Curve> {
        let (from, to) = (above(height, self.from_z), above(height, self.to_z));
        let length = self.curve.length();
        if from == to || length == 0.0 {
            return (from || to).then_some(self.curve);
        }
        let cut = length * ((height - self.from_z) / (self.to_z - self.from_z)).clamp(0.0, 1.0);
        let (begin, end) = if from { (0.0, cut) } else { (cut, length) };
        Some(self.curve.section(begin, end))
    }
}
