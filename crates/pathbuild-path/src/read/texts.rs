//! The texts of a path's layers, and the elements they are given to.

use std::collections::BTreeMap;

use pathbuild_diagnostic::messages::drawing as messages;
use pathbuild_diagnostic::{Diagnostic, ElementId, EntityKind};
use pathbuild_dxf::{MText, Text};

use super::collect::{Owner, candidate_word};
use crate::assign::{Boxes, Candidate, find, nearest_miss};
use crate::element::{Origin, Shape, shown};
use crate::raw::RawPath;
use crate::text::{ParameterText, without_percent_codes};
use crate::text_circle::TextCircle;

/// Texts and candidates of the layers of one path. Tilde layers are layers of their own: what is on them find only each other.
#[derive(Default)]
pub(crate) struct Texts {
    layers: BTreeMap<u32, LayerTexts>,
}

#[derive(Default)]
struct LayerTexts {
    name: Box<str>,
    candidates: Vec<Candidate>,
    /// Where they lie, once all are there.
    boxes: Boxes,
    owners: Vec<Owner>,
    texts: Vec<FoundText>,
}

struct FoundText {
    circle: TextCircle,
    string: String,
    origin: Origin,
}

/// A text and what it belongs to.
pub(crate) struct Match {
    pub(crate) string: String,
    pub(crate) circle: TextCircle,
    pub(crate) origin: Origin,
    pub(crate) owners: Vec<(ElementId, Shape)>,
}

impl Texts {
    pub(crate) fn add_text(&mut self, text: &Text, layer: u32, origin: Origin) {
        let found = FoundText {
            circle: TextCircle::of_text(text),
            string: without_percent_codes(&text.string),
            origin,
        };
        self.layer(layer, &found.origin.layer.clone()).texts.push(found);
    }

    pub(crate) fn add_mtext(&mut self, text: &MText, layer: u32, origin: Origin) {
        let found = FoundText {
            circle: TextCircle::of_mtext(text),
            string: without_percent_codes(&text.plain),
            origin,
        };
        self.layer(layer, &found.origin.layer.clone()).texts.push(found);
    }

    /// Each text with its circle and the candidates that it belongs to, layer by layer.
    pub(crate) fn matched(mut self) -> Vec<Match> {
        let layers = self.layers.values_mut();
        let matched = layers.flat_map(|layer| {
            let matched = layer.matched();
            let owned = |owners: Vec<usize>| owners.iter().map(|index| layer.owned(*index)).collect();
            matched.into_iter().map(|(text, owners)| (text, owned(owners))).collect::<Vec<_>>()
        });
        let shown = |(text, owners): (FoundText, Vec<(ElementId, Shape)>)| Match {
            string: text.string,
            circle: text.circle,
            origin: text.origin,
            owners,
        };
        matched.map(shown).collect()
    }

    pub(crate) fn add_candidate(&mut self, layer: u32, name: &str, candidate: Candidate, owner: Owner) {
        let layer = self.layer(layer, name);
        layer.candidates.push(candidate);
        layer.owners.push(owner);
    }

    fn layer(&mut self, layer: u32, name: &str) -> &mut LayerTexts {
        self.layers.entry(layer).or_insert_with(|| LayerTexts { name: name.into(), ..LayerTexts::default() })
    }

    /// Gives each text to its element; what finds none is PB107.
    pub(crate) fn assign(mut self, raw: &mut RawPath) {
        for layer in self.layers.values_mut() {
            layer.assign(raw);
        }
        for (number, layer) in &self.layers {
            for text in &layer.texts {
                let elsewhere = self.layers.iter().filter(|(other, _)| *other != number);
                raw.diagnostics.push(layer.without_element(text, elsewhere.map(|(_, other)| other)));
            }
        }
    }
}

impl LayerTexts {
    /// Gives each text to its element. What finds no element stays in `texts`.
    fn assign(&mut self, raw: &mut RawPath) {
        for (text, owners) in self.matched() {
            if owners.is_empty() {
                self.texts.push(text);
            } else {
                self.give(&text, &owners, raw);
            }
        }
    }

    /// All TEXT in file order, then all MTEXT, each with the candidate that it belongs to; of a polyline with all its parts.
    fn matched(&mut self) -> Vec<(FoundText, Vec<usize>)> {
        self.boxes = Boxes::new(&self.candidates);
        let mut texts = std::mem::take(&mut self.texts);
        texts.sort_by_key(|text| text.origin.entity == EntityKind::MText);
        let mut matched = Vec::with_capacity(texts.len());
        for text in texts {
            let owners = find(&text.circle, &self.candidates, &self.boxes)
                .map_or_else(Vec::new, |index| self.parts(index));
            for owner in &owners {
                self.candidates[*owner].is_taken = true;
            }
            matched.push((text, owners));
        }
        matched
    }

    /// A candidate, and what is part of the same polyline.
    fn parts(&self, index: usize) -> Vec<usize> {
        match self.candidates[index].group {
            None => vec![index],
            group => {
                // They were read one after the other.
                let is_part = |other: &usize| self.candidates[*other].group == group;
                let before = (0..index).rev().take_while(is_part).last().unwrap_or(index);
                (before..self.candidates.len()).take_while(is_part).collect()
            }
        }
    }

    fn owned(&self, index: usize) -> (ElementId, Shape) {
        let candidate = &self.candidates[index];
        (candidate.id, candidate.shape)
    }

    fn give(&self, text: &FoundText, owners: &[usize], raw: &mut RawPath) {
        let number = u32::try_from(raw.texts.len()).unwrap_or(u32::MAX);
        raw.texts.push(ParameterText::new(&text.string));
        for owner in owners {
            let owner = match self.owners[*owner] {
                Owner::Start => raw.start.as_mut().map(|start| &mut start.text),
                Owner::Probe(probe) => Some(&mut raw.probes[probe].text),
                Owner::Element(element) => Some(&mut raw.elements[element].text),
                Owner::Faulty => None,
            };
            if let Some(owner) = owner {
                *owner = Some(number);
            }
        }
    }

    fn without_element<'a>(&self, text: &FoundText, elsewhere: impl Iterator<Item = &'a Self>) -> Diagnostic {
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
    fn would_take(&self, text: &FoundText, diagnostic: Diagnostic) -> Diagnostic {
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
