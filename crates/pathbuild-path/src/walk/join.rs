//! Ends that do not quite meet, joined within a tolerance. (spec/06-configuration.md, `join-tolerance`)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::drawing as messages;

use super::Walk;
use crate::approx::{above, at_least};
use crate::element::Origin;

impl Walk<'_> {
    /// The segment with the nearest end, if that is within the tolerance; joining it is reported.
    pub(super) fn next_within_tolerance(&mut self) -> Option<usize> {
        if self.join_tolerance <= 0.0 {
            return None;
        }
        let distances = self.open().map(|segment| {
            let [to_start, to_end] = self.ends.of(segment).map(|end| (end - self.at).norm());
            (segment, to_start.min(to_end))
        });
        let (nearest, distance) =
            distances.reduce(|best, other| if other.1 < best.1 { other } else { best })?;
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
