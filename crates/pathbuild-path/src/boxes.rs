//! Bounding boxes of curves, and an index of them.

use std::iter;

use either::Either;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, Envelope as _, RTree};

use crate::geometry::{Curve, Xy};

type IndexedBox = GeomWithData<Rectangle<[f64; 2]>, usize>;

/// A spatial index of boxes, which are numbered from 0.
#[derive(Clone, Debug)]
pub(crate) enum BoxIndex {
    /// The boxes themselves, if they are so few that comparing all of them takes less time than building and searching a tree.
    Few(GroupedBoxes),
    Many(RTree<IndexedBox>),
}

/// Boxes in the order of their numbers. Neighbours often belong to one segment or outline, so the boxes around groups of them exclude most.
#[derive(Clone, Debug)]
pub(crate) struct GroupedBoxes {
    boxes: Vec<AABB<[f64; 2]>>,
    /// The box around each group.
    groups: Vec<AABB<[f64; 2]>>,
}

/// Number of boxes up to which all are compared.
const MAX_COMPARED_BOXES: usize = 500;

/// Number of boxes in a group.
const GROUP_SIZE: usize = 8;

impl BoxIndex {
    pub(crate) fn new(boxes: impl Iterator<Item = AABB<[f64; 2]>>) -> Self {
        let boxes: Vec<AABB<[f64; 2]>> = boxes.collect();
        if boxes.len() <= MAX_COMPARED_BOXES {
            return Self::Few(GroupedBoxes::new(boxes));
        }
        let numbered = boxes.into_iter().enumerate();
        let boxed = numbered.map(|(n, extent)| IndexedBox::new(Rectangle::from_aabb(extent), n));
        Self::Many(RTree::bulk_load(boxed.collect()))
    }

    /// Returns the numbers of the boxes that intersect `extent`, in ascending order, so that no result depends on the shape of the tree.
    pub(crate) fn near(&self, extent: AABB<[f64; 2]>) -> impl Iterator<Item = usize> {
        match self {
            Self::Few(boxes) => Either::Left(boxes.near(extent)),
            Self::Many(tree) => {
                let near = tree.locate_in_envelope_intersecting(extent);
                let mut found: Vec<usize> = near.map(|found| found.data).collect();
                found.sort_unstable();
                Either::Right(found.into_iter())
            }
        }
    }
}

impl GroupedBoxes {
    fn new(boxes: Vec<AABB<[f64; 2]>>) -> Self {
        let merged =
            |group: &[AABB<[f64; 2]>]| group[1..].iter().fold(group[0], |all, next| all.merged(next));
        Self { groups: boxes.chunks(GROUP_SIZE).map(merged).collect(), boxes }
    }

    fn near(&self, extent: AABB<[f64; 2]>) -> impl Iterator<Item = usize> {
        let mut next = 0;
        iter::from_fn(move || {
            loop {
                let number = next;
                let own = self.boxes.get(number)?;
                let is_far = number.is_multiple_of(GROUP_SIZE)
                    && !self.groups[number / GROUP_SIZE].intersects(&extent);
                next += if is_far { GROUP_SIZE } else { 1 };
                if !is_far && own.intersects(&extent) {
                    return Some(number);
                }
            }
        })
    }
}

/// Returns the bounding box of a curve, or of the whole circle for an arc, widened by `margin`.
pub(crate) fn widened_box(curve: &Curve, margin: f64) -> AABB<[f64; 2]> {
    let (a, b) = match curve {
        Curve::Line(line) => (line.start, line.end),
        Curve::Arc(arc) => {
            let out = nalgebra::Vector2::new(arc.radius, arc.radius);
            (arc.centre - out, arc.centre + out)
        }
    };
    let low = [a.x.min(b.x) - margin, a.y.min(b.y) - margin];
    AABB::from_corners(low, [a.x.max(b.x) + margin, a.y.max(b.y) + margin])
}

/// Whether two curves may be nearer to each other than `reach` mm. For most pairs the boxes rule that out, faster than computing the distance.
pub(crate) fn may_be_near(one: &Curve, other: &Curve, reach: f64) -> bool {
    widened_box(one, reach).intersects(&widened_box(other, 0.0))
}

/// Returns a box with its sides moved outwards by `reach` mm.
pub(crate) fn widened(extent: &AABB<[f64; 2]>, reach: f64) -> AABB<[f64; 2]> {
    let ([left, low], [right, high]) = (extent.lower(), extent.upper());
    AABB::from_corners([left - reach, low - reach], [right + reach, high + reach])
}

/// Returns the square around a point, with sides `reach` mm away from the point.
pub(crate) fn square(at: Xy, reach: f64) -> AABB<[f64; 2]> {
    AABB::from_corners([at.x - reach, at.y - reach], [at.x + reach, at.y + reach])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_and_many_boxes_are_found_alike() {
        let place = |number: usize| Xy::new((number * 37 % 101) as f64, (number * 53 % 97) as f64);
        let boxes = |count: usize| (0..count).map(move |number| square(place(number), 1.5));
        let (few, many) =
            (BoxIndex::new(boxes(MAX_COMPARED_BOXES)), BoxIndex::new(boxes(MAX_COMPARED_BOXES + 1)));
        assert!(matches!((&few, &many), (BoxIndex::Few(_), BoxIndex::Many(_))));
        let mut count = 0;
        for number in 0..200 {
            let extent = square(place(number * 7 + 3), 2.0);
            let found: Vec<usize> = many.near(extent).filter(|number| *number < MAX_COMPARED_BOXES).collect();
            count += found.len();
            assert_eq!(few.near(extent).collect::<Vec<_>>(), found, "{number}");
        }
        assert!(count > 100, "{count}");
    }
}
