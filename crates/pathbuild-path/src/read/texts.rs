//! The texts of a path's layers, and the elements they are given to.

use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

use pathbuild_diagnostic::messages::drawing as messages;
use pathbuild_diagnostic::{Diagnostic, ElementId, EntityKind};
use pathbuild_dxf::{MText, Text};

use super::collect::{Collected, Owner, candidate_word};
use crate::assign::{Boxes, Candidate, find, nearest_miss};
use crate::element::{Origin, Shape, shown};
use crate::text::{ParameterText, without_percent_codes};
use crate::text_circle::TextCircle;

/// Texts and candidates of the layers of one path, in order of the layers' numbers. Tilde layers are layers of their own: what is on
/// them find only each other.
#[derive(Default)]
pub(crate) struct Texts<'d> {
    layers: Vec<(u32, LayerTexts<'d>)>,
}

struct LayerTexts<'d> {
    name: Arc<str>,
    candidates: Vec<Candidate>,
    /// Where they lie, once that is asked for.
    boxes: Boxes,
    owners: Vec<Owner>,
    texts: Vec<FoundText<'d>>,
}

#[derive(Clone)]
struct FoundText<'d> {
    circle: TextCircle,
    string: Cow<'d, str>,
    origin: Origin,
}

/// A text and what it belongs to.
pub(crate) struct Match<'d> {
    pub(crate) string: Cow<'d, str>,
    pub(crate) circle: TextCircle,
    pub(crate) origin: Origin,
    pub(crate) owners: Vec<(ElementId, Shape)>,
}

/// How many entities there are on a layer.
#[derive(Clone, Copy, Default)]
pub(crate) struct Count {
    pub(crate) texts: usize,
    pub(crate) others: usize,
}

impl<'d> Texts<'d> {
    /// A layer, with how much is on it as far as that is known. All are added before what is on them, in order of their numbers.
    pub(crate) fn add_layer(&mut self, layer: u32, name: &Arc<str>, count: Count) {
        self.layers.push((layer, LayerTexts::new(name, count)));
    }

    pub(crate) fn add_text(&mut self, text: &'d Text, layer: u32, origin: Origin) {
        let circle = TextCircle::of_text(text);
        let string = without_percent_codes(&text.string);
        self.layer(layer).texts.push(FoundText { circle, string, origin });
    }

    pub(crate) fn add_mtext(&mut self, text: &'d MText, layer: u32, origin: Origin) {
        let circle = TextCircle::of_mtext(text);
        let string = without_percent_codes(&text.plain);
        self.layer(layer).texts.push(FoundText { circle, string, origin });
    }

    /// Each text with its circle and the candidates that it belongs to, layer by layer.
    pub(crate) fn matched(mut self) -> Vec<Match<'d>> {
        let mut matched = Vec::new();
        for (_, layer) in &mut self.layers {
            let candidate = |candidate: &Candidate| (candidate.id, candidate.shape);
            layer.each_match(|layer, text, owners| {
                let owners = layer.candidates[owners].iter().map(candidate).collect();
                let FoundText { circle, string, origin } = text.clone();
                matched.push(Match { string, circle, origin, owners });
            });
        }
        matched
    }

    pub(crate) fn add_candidate(&mut self, layer: u32, candidate: Candidate, owner: Owner) {
        let layer = self.layer(layer);
        layer.candidates.push(candidate);
        layer.owners.push(owner);
    }

    fn layer(&mut self, layer: u32) -> &mut LayerTexts<'d> {
        let place = self.layers.binary_search_by_key(&layer, |(number, _)| *number);
        &mut self.layers[place.expect("every layer was added")].1
    }

    /// Gives each text to its element; what finds none is PB107.
    pub(crate) fn assign(mut self, path: &mut Collected<'_>) {
        path.raw.texts.reserve_exact(self.layers.iter().map(|(_, layer)| layer.texts.len()).sum());
        for (_, layer) in &mut self.layers {
            layer.assign(path);
        }
        if self.layers.iter().all(|(_, layer)| layer.texts.is_empty()) {
            return;
        }
        for (_, layer) in &mut self.layers {
            layer.boxes = Boxes::new(&layer.candidates);
        }
        for (number, layer) in &self.layers {
            for text in &layer.texts {
                let elsewhere = self.layers.iter().filter(|(other, _)| other != number);
                let problem = layer.without_element(text, elsewhere.map(|(_, other)| other));
                path.raw.diagnostics.push(problem);
            }
        }
    }
}

impl<'d> LayerTexts<'d> {
    fn new(name: &Arc<str>, count: Count) -> Self {
        Self {
            name: Arc::clone(name),
            candidates: Vec::with_capacity(count.others),
            boxes: Boxes::default(),
            owners: Vec::with_capacity(count.others),
            texts: Vec::with_capacity(count.texts),
        }
    }

    /// Gives each text to its element. What finds no element stays in `texts`.
    fn assign(&mut self, path: &mut Collected<'_>) {
        let mut open = Vec::new();
        self.each_match(|layer, text, owners| {
            if owners.is_empty() {
                open.push(text.clone());
            } else {
                layer.give(text, owners, path);
            }
        });
        self.texts = open;
    }

    /// Takes all TEXT in file order, then all MTEXT, each with the candidate that it belongs to; of a polyline with all its parts.
    fn each_match(&mut self, mut take: impl FnMut(&Self, &FoundText<'d>, Range<usize>)) {
        let texts = std::mem::take(&mut self.texts);
        if texts.is_empty() {
            return;
        }
        self.boxes = Boxes::new(&self.candidates);
        let is_mtext = |text: &&FoundText<'_>| text.origin.entity == EntityKind::MText;
        let in_order = texts.iter().filter(|text| !is_mtext(text)).chain(texts.iter().filter(is_mtext));
        for text in in_order {
            let owners =
                find(&text.circle, &self.candidates, &self.boxes).map_or(0..0, |index| self.parts(index));
            for owner in &mut self.candidates[owners.clone()] {
                owner.is_taken = true;
            }
            take(self, text, owners);
        }
    }

    /// A candidate, and what is part of the same polyline: they were read one after the other.
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

    fn give(&self, text: &FoundText<'_>, owners: Range<usize>, path: &mut Collected<'_>) {
        let raw = &mut path.raw;
        let number = u32::try_from(raw.texts.len()).unwrap_or(u32::MAX);
        raw.texts.push(ParameterText::new(&text.string));
        for owner in &self.owners[owners] {
            let owner = match *owner {
                Owner::Start => raw.start.as_mut().map(|start| &mut start.text),
                Owner::Probe(probe) => Some(&mut raw.probes[probe].text),
                Owner::Element(element) => Some(&mut path.elements[element].text),
                Owner::Faulty => None,
            };
            if let Some(owner) = owner {
                *owner = Some(number);
            }
        }
    }

    fn without_element<'a>(
        &self,
        text: &FoundText<'_>,
        elsewhere: impl Iterator<Item = &'a Self>,
    ) -> Diagnostic
    where
        'd: 'a,
    {
        let mut diagnostic = Diagnostic::new(&messages::TEXT_WITHOUT_ELEMENT)
            .with("text", text.string.replace('\n', " "))
            .with("centre", shown(text.circle.centre))
            .with("diameter", 2.0 * text.circle.radius)
            .with_text(ParameterText::new(&text.string).whole());
        if let Some(miss) = nearest_miss(&text.circle, &self.candidates, &self.boxes) {
            let shape = &self.candidates[miss.candidate].shape;
            diagnostic = diagnostic.note(
                &messages::NEAREST_ELEMENT,
                vec![
                    ("element", candidate_word(shape, self.owners[miss.candidate]).into()),
                    ("point", shown(shape.point()).into()),
                    ("distance", miss.distance.into()),
                ],
            );
        }
        text.origin.at(elsewhere.fold(diagnostic, |diagnostic, layer| layer.would_take(text, diagnostic)))
    }

    /// Notes that a text would have found its element, had it been on this layer.
    fn would_take(&self, text: &FoundText<'_>, diagnostic: Diagnostic) -> Diagnostic {
        let Some(index) = find(&text.circle, &self.candidates, &self.boxes) else { return diagnostic };
        let shape = &self.candidates[index].shape;
        diagnostic.note(
            &messages::ELEMENT_ON_OTHER_LAYER,
            vec![
                ("layer", (&*self.name).into()),
                ("element", candidate_word(shape, self.owners[index]).into()),
                ("point", shown(shape.point()).into()),
            ],
        )
    }
}
