//! The texts on the layers of a path, and their assignment to elements.

use std::borrow::Cow;
use std::mem::discriminant;
use std::ops::Range;

use pathbuild_diagnostic::messages::drawing as messages;
use pathbuild_diagnostic::{Diagnostic, ElementId, Value};
use pathbuild_dxf::{MText, Text};
use smol_str::SmolStr;

use super::collect::{Owner, PathCollector, candidate_word};
use super::found_text::{AnyText, FoundText};
use crate::approx::near;
use crate::assign::{
    AssignedCandidate, Candidate, CandidateIndex, SearchBudget, find, find_taken, nearest_miss,
};
use crate::element::{Element, Marker, Origin, Shape, Source, shown};
use crate::geometry::Xy;
use crate::letter::{Letter, Letters};
use crate::matrix::Use;
use crate::text::{ParameterText, ParameterTexts, TextId, without_percent_codes};
use crate::text_circle::TextCircle;

/// Texts and candidates on the layers of a path. Tilde layers are separate: their texts and elements only match each other.
#[derive(Default)]
pub(crate) struct Texts<'d> {
    layers: Vec<LayerTexts<'d>>,
}

/// Texts and candidates of one layer.
#[derive(Default)]
struct LayerTexts<'d> {
    name: SmolStr,
    candidates: Vec<Candidate>,
    /// The spatial index of the candidates, built on demand.
    boxes: CandidateIndex,
    texts: Vec<FoundText<'d>>,
}

/// Maximum number of layers to list on which a text would find an element.
const MOST_NAMED: usize = 3;

/// Maximum number of other layers to search for an element. A usual path has a few; with thousands, each stray text would search all of
/// them.
const MOST_ASKED: usize = 100;

/// Maximum number of elements examined for the texts of a path: enough for thousands of texts that each overlap thousands of elements.
const MOST_EXAMINED: usize = 50_000_000;

/// Further elements examined for hints about texts without an element.
const MOST_EXAMINED_FOR_HINTS: usize = 1_000_000;

/// A text with the candidates it belongs to.
pub(crate) struct Match<'d> {
    pub(crate) string: Cow<'d, str>,
    pub(crate) circle: TextCircle,
    pub(crate) origin: Origin,
    pub(crate) owners: Vec<(ElementId, Shape)>,
}

impl<'d> Texts<'d> {
    /// Adds the next layer.
    pub(super) fn add_layer(&mut self, name: &str) {
        self.layers.push(LayerTexts { name: name.into(), ..LayerTexts::default() });
    }

    /// The names of the layers in order.
    pub(super) fn layer_names(self) -> Vec<SmolStr> {
        self.layers.into_iter().map(|layer| layer.name).collect()
    }

    /// The location of an entity that starts, or has its centre, at a point.
    pub(crate) fn origin(&self, source: Source, point: Xy) -> Origin {
        self.layers[source.layer as usize].origin(source, point)
    }

    pub(crate) fn add_text(&mut self, text: &'d Text, source: Source) {
        self.layer(source.layer).texts.push(FoundText { source, text: AnyText::Text(text) });
    }

    pub(crate) fn add_mtext(&mut self, text: &'d MText, source: Source) {
        self.layer(source.layer).texts.push(FoundText { source, text: AnyText::MText(text) });
    }

    pub(crate) fn add_candidate(&mut self, layer: u32, candidate: Candidate) {
        self.layer(layer).candidates.push(candidate);
    }

    /// Lets a marker take the path's text from its own layer.
    pub(super) fn give_to_start(&mut self, start: &Marker) {
        let Some(layer) = self.layers.iter_mut().find(|layer| layer.name == start.origin.layer) else {
            return;
        };
        if let Some(candidate) = layer.candidates.iter_mut().find(|known| known.id == start.origin.id) {
            candidate.owner = Owner::Start;
            return;
        }
        let shape = Shape::Circle { centre: start.at, radius: 0.5 };
        let candidate =
            Candidate { id: start.origin.id, shape, group: None, owner: Owner::Start, is_taken: false };
        layer.candidates.push(candidate);
    }

    /// Takes an element out of the path: those behind it move up by one.
    pub(super) fn forget_element(&mut self, index: usize) {
        for candidate in self.layers.iter_mut().flat_map(|layer| &mut layer.candidates) {
            candidate.owner = match candidate.owner {
                Owner::Element(element) if element == index => Owner::Faulty,
                Owner::Element(element) if element > index => Owner::Element(element - 1),
                owner @ (Owner::Element(_) | Owner::Start | Owner::Probe(_) | Owner::Faulty) => owner,
            };
        }
    }

    /// Whether a text with O and T overlaps a circle.
    pub(super) fn has_path_text(&self, marker: &Marker, radius: f64) -> bool {
        let on_layer = self.layers.iter().filter(|layer| layer.name == marker.origin.layer);
        on_layer.flat_map(|layer| &layer.texts).any(|text| {
            let circle = text.circle();
            let texts = ParameterTexts::from(&*without_percent_codes(text.string()));
            circle.distance_to_centre(marker.at) < circle.radius + radius
                && texts
                    .first()
                    .is_some_and(|text| text.letters.contains(Letter::O) && text.letters.contains(Letter::T))
        })
    }

    fn layer(&mut self, layer: u32) -> &mut LayerTexts<'d> {
        &mut self.layers[layer as usize]
    }

    /// Each text with its circle and its candidates, layer by layer.
    pub(crate) fn matched(mut self) -> Vec<Match<'d>> {
        let mut matched = Vec::new();
        let budget = SearchBudget::new(MOST_EXAMINED);
        for layer in &mut self.layers {
            let candidate = |candidate: &Candidate| (candidate.id, candidate.shape);
            layer.each_match(&budget, |layer, text, circle, owners, _| {
                let owners = layer.candidates[owners].iter().map(candidate).collect();
                let origin = layer.origin(text.source, text.anchor());
                matched.push(Match { string: without_percent_codes(text.string()), circle, origin, owners });
                true
            });
        }
        matched
    }

    /// Builds the spatial indexes of all layers for [`takers`](Self::takers).
    pub(crate) fn prepare(&mut self) {
        for layer in &mut self.layers {
            layer.boxes = CandidateIndex::new(&layer.candidates);
        }
    }

    /// The candidates without a text that a text with this circle would belong to, each with its layer name.
    pub(super) fn takers<'t>(
        &'t self,
        circle: &'t TextCircle,
        budget: &'t SearchBudget,
    ) -> impl Iterator<Item = (&'t str, &'t Candidate)> {
        let taker = |layer: &'t LayerTexts<'d>| {
            let found = find(circle, &layer.candidates, &layer.boxes, budget)?;
            Some((&*layer.name, &layer.candidates[found.candidate]))
        };
        self.layers.iter().take(MOST_ASKED).filter_map(taker)
    }

    /// Assigns each text to its element; PB107 if there is none. `margin`: minimum difference in mm between the distances from this element
    /// and from another one; PB116 if it is less.
    pub(crate) fn assign(&mut self, path: &mut PathCollector<'_>, margin: f64) {
        let budget = SearchBudget::new(MOST_EXAMINED);
        for layer in &mut self.layers {
            if let Some(problem) = layer.assign(path, margin, &budget) {
                // The elements of the remaining texts are unknown.
                path.diagnostics.push(problem);
                path.faults.stray_letters = Letters::ALL;
                return;
            }
        }
        if self.layers.iter().all(|layer| layer.texts.is_empty()) {
            return;
        }
        self.prepare();
        let budget = SearchBudget::new(MOST_EXAMINED_FOR_HINTS);
        for (number, layer) in self.layers.iter().enumerate() {
            for text in &layer.texts {
                let others = self.layers.iter().enumerate().filter(|(other, _)| *other != number);
                let problem = layer.without_element(text, others.map(|(_, other)| other), &budget);
                let problem = path.with_left_out(problem);
                path.diagnostics.push(problem);
                let texts = ParameterTexts::from(&*without_percent_codes(text.string()));
                let letters = texts.first().map(ParameterText::meant_letters);
                path.faults.stray_letters = path.faults.stray_letters.and(letters.unwrap_or_default());
            }
        }
    }
}

impl<'d> LayerTexts<'d> {
    fn origin(&self, source: Source, point: Xy) -> Origin {
        Origin::new(source, &self.name, point)
    }

    /// Assigns each text to its element. Texts without an element stay in `texts`. PB005 if the budget is exhausted.
    fn assign(
        &mut self,
        path: &mut PathCollector<'_>,
        margin: f64,
        budget: &SearchBudget,
    ) -> Option<Diagnostic> {
        let last = self.each_match(budget, |layer, text, _, owners, found| {
            let has_owner = !owners.is_empty();
            path.diagnostics.extend(found.and_then(|found| layer.doubt(text, found, margin, &path.elements)));
            if has_owner {
                let text = path.given.push_drawn(text.string());
                layer.give(text, owners, path);
            }
            has_owner
        });
        let problem = Diagnostic::new(&messages::TEXTS_IN_A_CROWD).with("limit", MOST_EXAMINED);
        last.map(|last| self.origin(last.source, last.anchor()).at(problem))
    }

    /// Calls the closure for each TEXT in file order, then for each MTEXT, with its candidate; for a polyline, with all its parts. Texts
    /// that are not taken stay. Stops at the text that exhausts the budget, and returns it.
    fn each_match(
        &mut self,
        budget: &SearchBudget,
        mut is_taken: impl FnMut(
            &Self,
            &FoundText<'d>,
            TextCircle,
            Range<usize>,
            Option<AssignedCandidate>,
        ) -> bool,
    ) -> Option<FoundText<'d>> {
        if self.texts.is_empty() {
            return None;
        }
        self.boxes = CandidateIndex::new(&self.candidates);
        let mut texts = std::mem::take(&mut self.texts);
        texts.sort_by_key(FoundText::is_mtext);
        let mut last = None;
        texts.retain(|text| {
            let circle = text.circle();
            let found = find(&circle, &self.candidates, &self.boxes, budget);
            if budget.is_exhausted() {
                last.get_or_insert(*text);
                return false;
            }
            let owners = found.map_or(0..0, |found| self.parts(found.candidate));
            for owner in &mut self.candidates[owners.clone()] {
                owner.is_taken = true;
            }
            !is_taken(self, text, circle, owners, found)
        });
        self.texts = texts;
        last
    }

    /// A candidate, and the other parts of its polyline, which are consecutive.
    fn parts(&self, index: usize) -> Range<usize> {
        let group = self.candidates[index].group;
        if group.is_none() {
            return index..index + 1;
        }
        let is_part = |other: &usize| self.candidates[*other].group == group;
        let first = (0..index).rev().take_while(is_part).last().unwrap_or(index);
        let behind = (index..self.candidates.len()).take_while(is_part).last().unwrap_or(index) + 1;
        first..behind
    }

    fn give(&self, text: TextId, owners: Range<usize>, path: &mut PathCollector<'_>) {
        for owner in &self.candidates[owners] {
            let owner = match owner.owner {
                Owner::Start => path.start.as_mut().map(|start| &mut start.text),
                Owner::Probe(probe) => Some(&mut path.probes[probe].text),
                Owner::Element(element) => Some(&mut path.elements[element].text),
                Owner::Faulty => None,
            };
            if let Some(owner) = owner {
                *owner = Some(text);
            }
        }
    }

    /// PB116 if another element of the same kind is about as near, or one of another kind is nearer. Not if the text would be an error
    /// there: between markers and elements, and if the other element does not know one of its letters.
    fn doubt(
        &self,
        text: &FoundText<'_>,
        found: AssignedCandidate,
        margin: f64,
        elements: &[Element],
    ) -> Option<Diagnostic> {
        if found.rival.is_none() && found.nearer.is_none() {
            return None;
        }
        let rival = found.rival.filter(|(_, farther)| *farther < margin || near(*farther, 0.0));
        let rival = rival.map(|(rival, farther)| {
            let is_equal = near(farther, 0.0);
            let message = if is_equal { &messages::FIRST_OF_EQUALS } else { &messages::NEARLY_OTHER_ELEMENT };
            (message, rival, farther)
        });
        let nearer = found.nearer.map(|(other, nearer)| (&messages::NEARER_OF_OTHER_KIND, other, nearer));
        let doubts = rival.into_iter().chain(nearer);
        let element = &self.candidates[found.candidate];
        let string = without_percent_codes(text.string());
        let texts = ParameterTexts::from(&*string);
        let is_possible = |other: &Candidate| {
            let refuses = |text: ParameterText<'_>| refuses(other.owner, text, elements);
            discriminant(&element.owner) == discriminant(&other.owner) && !texts.first().is_some_and(refuses)
        };
        let (message, other, farther) = doubts
            .map(|(message, other, farther)| (message, &self.candidates[other], farther))
            .find(|(_, other, _)| is_possible(other))?;
        let mut doubt = Diagnostic::new(message)
            .quoting("text", string.replace('\n', " "))
            .with("element", candidate_word(element))
            .with("point", shown(element.shape.point()))
            .with("other", candidate_word(other))
            .with("other_point", shown(other.shape.point()))
            .with("margin", farther);
        doubt.text = texts.first().map(ParameterText::whole);
        Some(self.origin(text.source, text.anchor()).at(doubt))
    }

    fn without_element<'a>(
        &self,
        text: &FoundText<'_>,
        elsewhere: impl Iterator<Item = &'a Self>,
        budget: &SearchBudget,
    ) -> Diagnostic
    where
        'd: 'a,
    {
        let (string, circle) = (without_percent_codes(text.string()), text.circle());
        let mut diagnostic = Diagnostic::new(&messages::TEXT_WITHOUT_ELEMENT)
            .quoting("text", string.replace('\n', " "))
            .with("centre", shown(circle.centre))
            .with("diameter", 2.0 * circle.radius);
        diagnostic.text = ParameterTexts::from(&*string).first().map(ParameterText::whole);
        let taken = find_taken(&circle, &self.candidates, &self.boxes, budget);
        if let Some(taken) = taken.map(|taken| &self.candidates[taken]) {
            diagnostic = diagnostic.note(
                &messages::HAS_A_TEXT,
                vec![("element", candidate_word(taken).into()), ("point", shown(taken.shape.point()).into())],
            );
        } else if let Some(miss) = nearest_miss(&circle, &self.candidates, &self.boxes, budget) {
            let candidate = &self.candidates[miss.candidate];
            diagnostic = diagnostic.note(
                &messages::NEAREST_ELEMENT,
                vec![
                    ("element", candidate_word(candidate).into()),
                    ("point", shown(candidate.shape.point()).into()),
                    ("distance", miss.distance.into()),
                ],
            );
        }
        let takers = elsewhere.take(MOST_ASKED).filter_map(|layer| layer.would_take(&circle, budget));
        let note = |diagnostic: Diagnostic, taker| diagnostic.note(&messages::ELEMENT_ON_OTHER_LAYER, taker);
        let diagnostic = takers.take(MOST_NAMED).fold(diagnostic, note);
        self.origin(text.source, text.anchor()).at(diagnostic)
    }

    /// The element that a text with this circle would belong to on this layer.
    fn would_take(&self, circle: &TextCircle, budget: &SearchBudget) -> Option<Vec<(&'static str, Value)>> {
        let found = find(circle, &self.candidates, &self.boxes, budget)?;
        let candidate = &self.candidates[found.candidate];
        Some(vec![
            ("layer", Value::quoted(&self.name)),
            ("element", candidate_word(candidate).into()),
            ("point", shown(candidate.shape.point()).into()),
        ])
    }
}

/// Whether a letter of a text is unknown to an element (PB202).
fn refuses(owner: Owner, text: ParameterText<'_>, elements: &[Element]) -> bool {
    let Owner::Element(element) = owner else { return false };
    let class = elements[element].class(None);
    let mut letters = text.pieces().iter().filter_map(|piece| piece.letter);
    letters.any(|letter| matches!(class.use_of(letter), Use::Unknown | Use::PathOnly))
}
