//! An index of bounding boxes.

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use crate::geometry::Xy;

type Boxed = GeomWithData<Rectangle<[f64; 2]>, usize>;

/// Boxes, which are numbered from 0.
pub(crate) struct BoxIndex(RTree<Boxed>);

impl BoxIndex {
    pub(crate) fn new(boxes: impl Iterator<Item = AABB<[f64; 2]>>) -> Self {
        let numbered = boxes.enumerate().map(|(n, extent)| Boxed::new(Rectangle::from_aabb(extent), n));
        Self(RTree::bulk_load(numbered.collect()))
    }

    /// The numbers of the boxes that meet another one, in ascending order, so that no result depends on the shape of the tree.
    pub(crate) fn near(&self, extent: AABB<[f64; 2]>) -> Vec<usize> {
        let mut found: Vec<usize> =
            self.0.locate_in_envelope_intersecting(extent).map(|found| found.data).collect();
        found.sort_unstable();
        found
    }
}

/// The square round a point.
pub(crate) fn square(at: Xy, reach: f64) -> AABB<[f64; 2]> {
    AABB::from_corners([at.x - reach, at.y - reach], [at.x + reach, at.y + reach])
}
