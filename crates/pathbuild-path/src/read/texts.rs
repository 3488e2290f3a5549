//! The texts on the layers of a path, and the elements that they may belong to. (book: language/parameter-texts)

use std::borrow::Cow;
use std::ops::Range;

use pathbuild_diagnostic::ElementId;
use pathbuild_dxf::{MText, Text};
use smol_str::SmolStr;

use crate::element::{Marker, Origin, Shape, Source};
use crate::geometry::Xy;
use crate::letter::Letter;
use crate::read::candidates::{
    AssignedCandidate, Candidate, CandidateIndex, Owner, SearchBudget, find, find_with_text, nearest_miss,
};
use crate::read::entities::{AnyText, FoundText, TextCircle};
use crate::text::{ParameterTexts, without_percent_codes};

/// Texts and candidates on the layers of a path. A text only matches elements on exactly its own layer.
#[derive(Default)]
pub(crate) struct Texts<'d> {
    pub(super) layers: Vec<LayerTexts<'d>>,
    /// The texts that belong to an element.
    pub(super) given: Vec<TextWithCandidate<'d>>,
}

/// A text with the candidate of its layer that it belongs to.
pub(super) struct TextWithCandidate<'d> {
    pub(super) text: FoundText<'d>,
    pub(super) found: AssignedCandidate,
}

/// The texts of one layer, and the elements that they may belong to.
#[derive(Default)]
pub(super) struct LayerTexts<'d> {
    pub(super) name: SmolStr,
    pub(super) candidates: Vec<Candidate>,
    /// The spatial index of the candidates, built on demand.
    pub(super) boxes: CandidateIndex,
    pub(super) texts: Vec<FoundText<'d>>,
}

/// Maximum number of other layers to search for an element. A usual path has a few; with thousands, each stray text would search all of
/// them.
pub(super) const MAX_SEARCHED_LAYERS: usize = 100;

/// Maximum number of elements examined for the texts of a path: enough for thousands of texts that each overlap thousands of elements.
pub(super) const MAX_EXAMINED_ELEMENTS: usize = 50_000_000;

/// A text with the candidates it belongs to.
pub(crate) struct TextMatch<'d> {
    pub(crate) string: Cow<'d, str>,
    pub(crate) circle: TextCircle,
    pub(crate) origin: Origin,
    pub(crate) owners: Vec<(ElementId, Shape)>,
}

impl<'d> Texts<'d> {
    pub(super) fn add_layer(&mut self, name: &str) {
        self.layers.push(LayerTexts { name: name.into(), ..LayerTexts::default() });
    }

    pub(super) fn layer_names(self) -> Vec<SmolStr> {
        self.layers.into_iter().map(|layer| layer.name).collect()
    }

    /// Returns the location of an entity that starts, or has its centre, at a point.
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

    /// Makes a circle the start marker, so that the path's text on its layer is assigned to it.
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

    /// Removes an element of the path. The indices of the elements after it decrease by one.
    pub(super) fn forget_element(&mut self, index: usize) {
        for candidate in self.layers.iter_mut().flat_map(|layer| &mut layer.candidates) {
            candidate.owner = match candidate.owner {
                Owner::Element(element) if element == index => Owner::Faulty,
                Owner::Element(element) if element > index => Owner::Element(element - 1),
                owner @ (Owner::Element(_) | Owner::Start | Owner::Probe(_) | Owner::Faulty) => owner,
            };
        }
    }

    /// Whether a text that gives O and T overlaps the circle of a marker, which has this radius in mm.
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

    /// Returns each text with its circle and its candidates, layer by layer.
    pub(crate) fn match_texts(mut self) -> Vec<TextMatch<'d>> {
        let mut matched = Vec::new();
        let budget = SearchBudget::new(MAX_EXAMINED_ELEMENTS);
        for layer in &mut self.layers {
            let candidate = |candidate: &Candidate| (candidate.id, candidate.shape);
            layer.each_match(&budget, |layer, text, circle, owners, _| {
                let owners = layer.candidates[owners].iter().map(candidate).collect();
                let origin = layer.origin(text.source, text.anchor());
                matched.push(TextMatch {
                    string: without_percent_codes(text.string()),
                    circle,
                    origin,
                    owners,
                });
                true
            });
        }
        matched
    }

    /// Builds the spatial indexes of all layers.
    pub(crate) fn prepare(&mut self) {
        for layer in &mut self.layers {
            layer.boxes = CandidateIndex::new(&layer.candidates);
        }
    }

    /// Returns the candidates without a text that a text with this circle would belong to, each with its layer name.
    pub(super) fn free_candidates<'t>(
        &'t self,
        circle: &'t TextCircle,
        budget: &'t SearchBudget,
    ) -> impl Iterator<Item = (&'t str, &'t Candidate)> {
        let taker = |layer: &'t LayerTexts<'d>| {
            let found = find(circle, &layer.candidates, &layer.boxes, budget)?;
            Some((&*layer.name, &layer.candidates[found.candidate]))
        };
        self.layers.iter().take(MAX_SEARCHED_LAYERS).filter_map(taker)
    }
}

impl<'d> Texts<'d> {
    /// Returns the candidates without a text that a text with this circle, which overlaps none on their layer, misses by at most `reach` mm, each with
    /// its layer name.
    pub(super) fn candidates_beside<'t>(
        &'t self,
        circle: &'t TextCircle,
        reach: f64,
        budget: &'t SearchBudget,
    ) -> impl Iterator<Item = (&'t str, &'t Candidate)> {
        let missed = move |layer: &'t LayerTexts<'d>| {
            let (candidates, boxes) = (&layer.candidates, &layer.boxes);
            if find_with_text(circle, candidates, boxes, budget).is_some() {
                return None;
            }
            let miss = nearest_miss(circle, candidates, boxes, budget)?;
            (miss.distance <= reach).then(|| (&*layer.name, &candidates[miss.candidate]))
        };
        self.layers.iter().take(MAX_SEARCHED_LAYERS).filter_map(missed)
    }
}

impl<'d> LayerTexts<'d> {
    pub(super) fn origin(&self, source: Source, point: Xy) -> Origin {
        Origin::new(source, &self.name, point)
    }

    /// Calls `is_taken` for each TEXT in file order, then for each MTEXT, with its candidate; for a polyline, with all its parts. Texts for which
    /// `is_taken` returns false stay in `texts`. Stops at the text that exhausts the budget, and returns that text.
    pub(super) fn each_match(
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

    /// Returns the range of indices of a candidate and the other parts of its polyline, which are consecutive.
    pub(super) fn parts(&self, index: usize) -> Range<usize> {
        let group = self.candidates[index].group;
        if group.is_none() {
            return index..index + 1;
        }
        let is_part = |other: &usize| self.candidates[*other].group == group;
        let first = (0..index).rev().take_while(is_part).last().unwrap_or(index);
        let behind = (index..self.candidates.len()).take_while(is_part).last().unwrap_or(index) + 1;
        first..behind
    }
}
