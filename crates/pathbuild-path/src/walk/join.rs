//! Joins ends that do not quite meet, within a tolerance. (book: reference/configuration, `join-tolerance`)

use std::collections::{BTreeMap, BTreeSet};

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::drawing as messages;

use rstar::RTree;

use super::Walker;
use super::ends::Ends;
use crate::approx::{above, at_least};
use crate::element::Origin;
use crate::geometry::Xy;

/// A spatial index of the ends of remaining segments.
pub(super) struct OpenEnds {
    /// Each point once: a tree removes one of many equal points by scanning all of them.
    points: RTree<[f64; 2]>,
    /// The segments that end at each point.
    segments: BTreeMap<[u64; 2], BTreeSet<usize>>,
}

impl OpenEnds {
    fn new(open: impl Iterator<Item = usize>, ends: &Ends) -> Self {
        let (mut points, mut segments) = (Vec::new(), BTreeMap::<_, BTreeSet<usize>>::new());
        for (segment, end) in open.flat_map(|segment| of(segment, ends).map(|end| (segment, end))) {
            let at_end = segments.entry(bits(end)).or_default();
            if at_end.is_empty() {
                points.push(end);
            }
            at_end.insert(segment);
        }
        Self { points: RTree::bulk_load(points), segments }
    }

    /// Removes the ends of a segment.
    pub(super) fn remove(&mut self, segment: usize, ends: &Ends) {
        for end in of(segment, ends) {
            let Some(at_end) = self.segments.get_mut(&bits(end)) else { continue };
            at_end.remove(&segment);
            if at_end.is_empty() {
                self.segments.remove(&bits(end));
                self.points.remove(&end);
            }
        }
    }

    /// The segment with the end nearest to a point, and its distance; the first of several.
    fn nearest(&self, point: Xy) -> Option<(usize, f64)> {
        let by_distance = self.points.nearest_neighbor_iter([point.x, point.y]);
        let mut points = by_distance.map(|end| (end, (Xy::from(*end) - point).norm())).peekable();
        let distance = points.peek()?.1;
        let nearest = points.take_while(|(_, other)| *other <= distance);
        let firsts = nearest.filter_map(|(end, _)| self.segments.get(&bits(*end))?.first());
        Some((*firsts.min()?, distance))
    }
}

/// The ends of a segment as keys; zeros get a positive sign, since points are compared by their bits.
fn of(segment: usize, ends: &Ends) -> [[f64; 2]; 2] {
    ends.of(segment).map(|end| [end.x + 0.0, end.y + 0.0])
}

fn bits(point: [f64; 2]) -> [u64; 2] {
    point.map(f64::to_bits)
}

impl Walker<'_> {
    /// The segment with the nearest end, if that is within the tolerance. Reports the join.
    pub(super) fn next_within_tolerance(&mut self) -> Option<usize> {
        if self.join_tolerance <= 0.0 {
            return None;
        }
        let (open, ends) = (|segment: &usize| !self.is_traversed[*segment], &self.ends);
        let open_ends = self
            .open_ends
            .get_or_insert_with(|| OpenEnds::new((0..self.is_traversed.len()).filter(open), ends));
        let (nearest, distance) = open_ends.nearest(self.at)?;
        if above(distance, self.join_tolerance) {
            return None;
        }
        self.report_join(&self.path.origin(&self.path.segments[nearest]), distance);
        Some(nearest)
    }

    /// Whether the end marker is within the tolerance, so that the walk ends there with a warning.
    pub(super) fn joins_end(&mut self) -> bool {
        let distance = (self.path.end - self.at).norm();
        let is_known = self.path.faults.as_ref().is_none_or(|faults| !faults.ends.is_empty());
        let is_near = is_known && self.join_tolerance > 0.0 && at_least(self.join_tolerance, distance);
        if is_near {
            self.report_join(&self.path.end_origin, distance);
        }
        is_near
    }

    fn report_join(&mut self, origin: &Origin, distance: f64) {
        let warning = origin.at(Diagnostic::new(&messages::JOINED_ENDS).with("distance", distance));
        let point = crate::element::shown(self.at);
        self.joined.push(warning.at_point(point));
    }
}
