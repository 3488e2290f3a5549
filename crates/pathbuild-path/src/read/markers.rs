//! Chooses the start and end of a path if no circle, or several, are drawn as its marker.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::drawing as messages;

use super::collect::PathCollector;
use super::texts::Texts;
use crate::element::{Marker, MeantMarker, Shape};

/// Radii of the markers, in mm.
const END: f64 = 1.0;
const TURN: f64 = 0.75;
const PROBE: f64 = 3.0;

impl PathCollector<'_> {
    /// Chooses the circles that were probably meant as start and end. Each problem has been reported already, or is reported here.
    pub(super) fn settle_markers(&mut self, texts: &mut Texts<'_>) {
        if self.start.is_none() {
            self.start = self.take_unclear(MeantMarker::Start).or_else(|| self.circle_with_path_text(texts));
            if let Some(start) = &self.start {
                texts.give_to_start(start);
            }
        }
        if self.ends.is_empty() {
            let end = self.take_unclear(MeantMarker::End);
            self.ends.extend(end);
        }
        let first = self.ends.first().map(|end| end.origin.point);
        for end in self.ends.iter().skip(1).map(|end| end.origin.clone()).collect::<Vec<_>>() {
            let problem = Diagnostic::new(&messages::TWO_ENDS).quoting("name", self.name.as_str());
            self.report(end.at(problem.with("first", first.unwrap_or(end.point))));
        }
    }

    /// The first circle of unknown line type with the diameter of this marker.
    fn take_unclear(&mut self, meant: MeantMarker) -> Option<Marker> {
        let index = self.unclear.iter().position(|circle| circle.meant == meant)?;
        let marker = self.unclear.remove(index).marker;
        self.faults.unclear_circles.retain(|point| *point != marker.at);
        Some(marker)
    }

    /// A circle that is not a start marker but has the text of one. PB101 is reported there.
    fn circle_with_path_text(&mut self, texts: &Texts<'_>) -> Option<Marker> {
        let radius = |shape: &Shape| match shape {
            Shape::Circle { radius, .. } => *radius,
            Shape::Curve(_) => 0.0,
        };
        let unclear = self.unclear.iter().map(|circle| (&circle.marker, radius(&circle.shape)));
        let ends = self.ends.iter().map(|end| (end, END));
        let turns = self.turns.iter().map(|turn| (turn, TURN));
        let probes = self.probes.iter().map(|probe| (probe, PROBE));
        let circles: Vec<(&Marker, f64)> = ends.chain(unclear).chain(turns).chain(probes).collect();
        let (marker, radius) =
            circles.into_iter().find(|(marker, radius)| texts.has_path_text(marker, *radius))?;
        let marker = marker.clone();
        let problem = Diagnostic::new(&messages::MISSING_START)
            .quoting("name", self.name.as_str())
            .quoting("layer", &*marker.origin.layer)
            .note(
                &messages::MEANT_AS_START,
                vec![("point", marker.origin.point.into()), ("diameter", (2.0 * radius).into())],
            );
        self.report(marker.origin.at(problem));
        for markers in [&mut self.ends, &mut self.turns, &mut self.probes] {
            markers.retain(|other| other.origin.id != marker.origin.id);
        }
        Some(marker)
    }
}
