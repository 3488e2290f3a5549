//! Chooses the start and end of a path if no circle, or several, are drawn as its marker.

use pathbuild_diagnostic::messages::drawing as messages;
use pathbuild_diagnostic::{Diagnostic, Message};

use super::collect::PathCollector;
use super::texts::Texts;
use crate::approx::near;
use crate::element::{Cut, Element, Marker, MeantMarker, Role};

/// Radii of the markers, in mm.
const END: f64 = 1.0;
const TURN: f64 = 0.75;
const PROBE: f64 = 3.0;

impl PathCollector<'_> {
    /// Chooses the circles that were probably meant as start and end. Each problem has been reported already, or is reported here.
    pub(super) fn settle_markers(&mut self, texts: &mut Texts<'_>) {
        let mut has_other_line_type = false;
        if self.start.is_none() {
            self.start = self.take_unclear(MeantMarker::Start).or_else(|| self.circle_with_path_text(texts));
            if self.start.is_none() {
                self.start = self.element_with_path_text(texts);
                has_other_line_type = self.start.is_some();
            }
            if let Some(start) = &self.start {
                texts.give_to_start(start);
            }
        }
        if self.ends.is_empty() {
            let end = self.take_unclear(MeantMarker::End);
            let end = end.or_else(|| has_other_line_type.then(|| self.element_like_end(texts)).flatten());
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
        let unclear = self.unclear.iter();
        let unclear = unclear.map(|circle| (&circle.marker, circle.shape.radius().unwrap_or_default()));
        let ends = self.ends.iter().map(|end| (end, END));
        let turns = self.turns.iter().map(|turn| (turn, TURN));
        let probes = self.probes.iter().map(|probe| (probe, PROBE));
        let circles: Vec<(&Marker, f64)> = ends.chain(unclear).chain(turns).chain(probes).collect();
        let (marker, radius) =
            circles.into_iter().find(|(marker, radius)| texts.has_path_text(marker, *radius))?;
        let marker = marker.clone();
        let problem = self.missing(&messages::MISSING_START, &marker).note(
            &messages::MEANT_AS_START,
            vec![("point", marker.origin.point.into()), ("diameter", (2.0 * radius).into())],
        );
        self.report(marker.origin.at(problem));
        for markers in [&mut self.ends, &mut self.turns, &mut self.probes] {
            markers.retain(|other| other.origin.id != marker.origin.id);
        }
        Some(marker)
    }

    /// A circle to mill or drill that has the text of a start: its line type was lost. PB101 is reported there.
    fn element_with_path_text(&mut self, texts: &mut Texts<'_>) -> Option<Marker> {
        let circles = self.elements.iter().enumerate();
        let mut circles = circles.filter_map(|(index, element)| Some((index, element.shape.radius()?)));
        let index = circles
            .find(|(index, radius)| texts.has_path_text(&self.marker_of(*index, texts), *radius))
            .map(|(index, _)| index)?;
        let marker = self.take_element(index, texts);
        let problem = self
            .missing(&messages::MISSING_START, &marker)
            .note(&messages::MEANT_AS_PHANTOM_START, vec![("point", marker.origin.point.into())]);
        self.report(marker.origin.at(problem));
        Some(marker)
    }

    /// The only circle to mill that has the diameter of an end marker, in a path whose start has lost its line type. PB102 is reported there.
    fn element_like_end(&mut self, texts: &mut Texts<'_>) -> Option<Marker> {
        let is_like_end = |element: &Element| {
            element.role == Role::Cut(Cut::Mill)
                && element.shape.radius().is_some_and(|radius| near(radius, END))
        };
        let mut like_end = self.elements.iter().enumerate().filter(|(_, element)| is_like_end(element));
        let (Some((index, _)), None) = (like_end.next(), like_end.next()) else { return None };
        let marker = self.take_element(index, texts);
        let problem = self
            .missing(&messages::MISSING_END, &marker)
            .note(&messages::MEANT_AS_PHANTOM_END, vec![("point", marker.origin.point.into())]);
        self.report(marker.origin.at(problem));
        Some(marker)
    }

    fn missing(&self, message: &'static Message, marker: &Marker) -> Diagnostic {
        Diagnostic::new(message).quoting("name", self.name.as_str()).quoting("layer", &*marker.origin.layer)
    }

    /// The marker that a circle among the elements would be.
    fn marker_of(&self, index: usize, texts: &Texts<'_>) -> Marker {
        let element = &self.elements[index];
        let at = element.shape.point();
        Marker { origin: texts.origin(element.source, at), at, text: None }
    }

    fn take_element(&mut self, index: usize, texts: &mut Texts<'_>) -> Marker {
        let marker = self.marker_of(index, texts);
        self.elements.remove(index);
        texts.forget_element(index);
        marker
    }
}
