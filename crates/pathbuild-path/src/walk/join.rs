//! Ends that do not quite meet, joined within a tolerance. (book: reference/configuration, `join-tolerance`)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::drawing as messages;

use rstar::RTree;
use rstar::primitives::GeomWithData;

use super::Walk;
use super::ends::Ends;
use crate::approx::{above, at_least};
use crate::element::Origin;
use crate::geometry::Xy;

/// The ends of the segments that are left, found by where they are.
pub(super) struct OpenEnds(RTree<End>);

type End = GeomWithData<[f64; 2], usize>;

impl OpenEnds {
    fn new(segments: impl Iterator<Item = usize>, ends: &Ends) -> Self {
        Self(RTree::bulk_load(segments.flat_map(|segment| of(segment, ends)).collect()))
    }

    /// Takes the ends of a segment out.
    pub(super) fn remove(&mut self, segment: usize, ends: &Ends) {
        for end in of(segment, ends) {
            self.0.remove(&end);
        }
    }

    /// The segment whose end is nearest to a point, and how far that is; the first of several.
    fn nearest(&self, point: Xy) -> Option<(usize, f64)> {
        let by_distance = self.0.nearest_neighbor_iter([point.x, point.y]);
        let mut ends = by_distance.map(|end| (end.data, (Xy::from(*end.geom()) - point).norm()));
        let (first, distance) = ends.next()?;
        let others = ends.take_while(|(_, other)| *other <= distance).map(|(segment, _)| segment);
        Some((others.fold(first, usize::min), distance))
    }
}

fn of(segment: usize, ends: &Ends) -> [End; 2] {
    ends.of(segment).map(|end| GeomWithData::new([end.x, end.y], segment))
}

impl Walk<'_> {
    /// The segment with the nearest end, if that is within the tolerance; joining it is reported.
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

    /// Whether the end marker is within the tolerance; the last end is then taken for it, with a warning.
    pub(super) fn joins_end(&mut self) -> bool {
        let distance = (self.path.end - self.at).norm();
        let is_near = self.join_tolerance > 0.0 && at_least(self.join_tolerance, distance);
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
