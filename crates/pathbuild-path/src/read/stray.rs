//! Finds entities that were drawn for a path, a clamp or a finished part, but on a layer that does not belong to it: texts on other layers (PB119),
//! and layers with similar names (PB120). (book: language/layers-and-names, book: language/parameter-texts, book: language/keep-outs)

use std::collections::BTreeMap;

use pathbuild_diagnostic::messages::drawing as messages;
use pathbuild_diagnostic::{Diagnostic, EntityKind, Value};
use pathbuild_dxf::{Drawing, Geometry, Label, OmittedCurve};

use crate::element::{CircleMeaning, Shape, circle_meaning, diagnostic_point};
use crate::language::Language;
use crate::letter::{ElementClass, Letter, Letters};
use crate::line_type::LineType;
use crate::look_alikes;
use crate::names::PathName;
use crate::read::candidates::{Candidate, Owner, SearchBudget, find_shape};
use crate::read::collect::{self, PathCollector, PathLayers};
use crate::read::entities::{AnyText, TextCircle, anchor_of, at_entity, xy};
use crate::read::keep_outs::unread_clamps;
use crate::read::likely_parameters::{
    ESSENTIAL_LETTERS, is_parameter_text, looks_like_parameters, may_be_probe_text, without_mistakes,
};
use crate::read::near_names::{NearLayer, NearNames};
use crate::text::{ParameterText, ParameterTexts, ValueKind};

/// Maximum number of candidates examined for the stray texts of a drawing.
const MAX_EXAMINED_CANDIDATES: usize = 1_000_000;

/// Returns PB119 and PB120 for a drawing that was read with all its layers.
pub fn stray_findings(drawing: &Drawing, language: &Language) -> Vec<Diagnostic> {
    let layers = PathLayers::find(drawing, &language.path_pattern);
    let mut paths = collect::paths(drawing, language);
    paths.retain(|path| path.has_elements);
    for path in &mut paths {
        path.assign_texts(language);
        path.texts.prepare();
    }
    let names = NearNames::new(paths.iter().map(|path| &path.name));
    let is_other: Vec<bool> = (0_u32..)
        .zip(&drawing.layers)
        .map(|(number, layer)| {
            layers.membership(number).is_none() && !layer.hidden && !language.is_keep_out(&layer.name)
        })
        .collect();
    let mut near_layers: Vec<Option<NearLayer<'_>>> = drawing
        .layers
        .iter()
        .zip(&is_other)
        .map(|(layer, is_other)| is_other.then(|| NearLayer::of(&layer.name, &names, language)).flatten())
        .collect();
    add_layers_with_texts(drawing, &names, &is_other, &mut near_layers);
    let budget = SearchBudget::new(MAX_EXAMINED_CANDIDATES);
    let probes = if paths.is_empty() { Vec::new() } else { probe_circles(drawing, language) };
    let mut on_near_layers: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    let mut findings = Vec::new();
    for (number, entity) in drawing.entities.iter().enumerate() {
        if near_layers[entity.layer as usize].is_some() {
            on_near_layers.entry(entity.layer).or_default().push(number);
        } else if let Some(text) = AnyText::of(&entity.geometry)
            && is_other[entity.layer as usize]
        {
            let stray = stray_text_finding(drawing, number, text, &paths, &budget);
            findings.extend(stray.or_else(|| stray_probe_finding(drawing, number, text, &probes, &budget)));
        }
    }
    findings.extend(drawing.labels.iter().filter_map(|label| {
        let layer = label.layer as usize;
        unread_label_finding(label, &drawing.layers[layer].name, is_other[layer], &paths, &budget)
    }));
    let mut left_out: BTreeMap<u32, Vec<&OmittedCurve>> = BTreeMap::new();
    for curve in &drawing.left_out {
        left_out.entry(curve.layer).or_default().push(curve);
    }
    for (layer, near) in (0_u32..).zip(&near_layers) {
        let (entities, left_out) = (on_near_layers.remove(&layer), left_out.remove(&layer));
        let (entities, left_out) = (entities.unwrap_or_default(), left_out.unwrap_or_default());
        findings
            .extend(near.as_ref().and_then(|near| near_layer(drawing, near, layer, &entities, &left_out)));
    }
    findings.extend(unread_clamps(drawing, language, |layer| {
        let is_part = language.is_part(&drawing.layers[layer as usize].name);
        is_other[layer as usize] && !is_part && near_layers[layer as usize].is_none()
    }));
    findings
}

/// Adds the layers with names that begin with a path's name, if they hold elements and a parameter text: they are probably meant for the path,
/// whatever follows its name.
fn add_layers_with_texts<'n>(
    drawing: &Drawing,
    names: &'n NearNames,
    is_other: &[bool],
    near_layers: &mut [Option<NearLayer<'n>>],
) {
    let layers = drawing.layers.iter().zip(is_other).zip(&*near_layers);
    let beginnings: Vec<Option<&PathName>> = layers
        .map(|((layer, is_other), near)| {
            names.path_at_beginning(&layer.name).filter(|_| *is_other && near.is_none())
        })
        .collect();
    if beginnings.iter().all(Option::is_none) {
        return;
    }
    let mut has_elements = vec![false; beginnings.len()];
    for entity in &drawing.entities {
        has_elements[entity.layer as usize] |= AnyText::of(&entity.geometry).is_none();
    }
    for entity in &drawing.entities {
        let layer = entity.layer as usize;
        if let Some(path) = beginnings[layer].filter(|_| has_elements[layer] && near_layers[layer].is_none())
            && AnyText::of(&entity.geometry).is_some_and(|text| is_parameter_text(text.string()))
        {
            near_layers[layer] = Some(NearLayer::Path(path));
        }
    }
}

/// Returns PB119 if a text would have an effect on the layer of a path.
fn stray_text_finding(
    drawing: &Drawing,
    entity: usize,
    text: AnyText<'_>,
    paths: &[PathCollector<'_>],
    budget: &SearchBudget,
) -> Option<Diagnostic> {
    let circle = text.circle();
    let (path, (layer, candidate)) = intended_element(text.string(), &circle, paths, budget)?;
    let mut texts = ParameterTexts::default();
    let drawn = texts.push_drawn(text.string());
    let drawn = texts.get(drawn)?;
    let problem = Diagnostic::new(&messages::TEXT_ON_OTHER_LAYER)
        .quoting("text", drawn.as_str().replace('\n', " "))
        .quoting("layer", &*drawing.layers[drawing.entities[entity].layer as usize].name)
        .quoting("path_layer", layer)
        .with("element", candidate.word())
        .with("point", diagnostic_point(candidate.shape.point()))
        .with_text(drawn.whole_text_fault());
    Some(at_entity(drawing, entity, text.anchor(), problem.in_path(path.name.as_str())))
}

/// Returns PB119 for the text of a multileader or dimension on the layer of a path, unless a text of the path says the same, and for the text
/// of a multileader on another layer if it would have an effect on the element at the tip of the multileader's arrow.
fn unread_label_finding(
    label: &Label,
    layer: &str,
    is_other: bool,
    paths: &[PathCollector<'_>],
    budget: &SearchBudget,
) -> Option<Diagnostic> {
    let tip = TextCircle { centre: xy(label.tip.centre), radius: label.tip.radius };
    let is_known =
        |path: &PathCollector<'_>| path.texts.given.iter().any(|given| given.text.string() == label.text);
    let path = match paths.iter().find(|path| path.texts.layers.iter().any(|own| own.name == layer)) {
        Some(path) => Some(path).filter(|path| is_parameter_text(&label.text) && !is_known(path))?,
        None if is_other && label.tip.radius > 0.0 => intended_element(&label.text, &tip, paths, budget)?.0,
        None => return None,
    };
    let problem = Diagnostic::new(&messages::LABEL_WITHOUT_EFFECT)
        .quoting("text", label.text.replace('\n', " "))
        .quoting("entity", label.place.entity.map_or("?", EntityKind::name))
        .in_path(path.name.as_str());
    Some(Diagnostic { place: label.place.clone(), ..problem })
}

/// Returns the element on which a text with this circle would have an effect on the layer of a path, with its path and layer.
fn intended_element<'p, 'd>(
    text: &str,
    circle: &'p TextCircle,
    paths: &'p [PathCollector<'d>],
    budget: &'p SearchBudget,
) -> Option<(&'p PathCollector<'d>, (&'p str, &'p Candidate))> {
    let mut texts = ParameterTexts::default();
    let [drawn, meant] = [texts.push_drawn(text), texts.push_drawn(&without_mistakes(text))];
    let (drawn, meant) = (texts.get(drawn)?, texts.get(meant)?);
    let is_read = |read: &ParameterText<'_>| {
        looks_like_parameters(*read) || may_be_probe_text(read.as_str().as_bytes())
    };
    let read = [drawn, meant].into_iter().find(is_read)?;
    let over = paths.iter().find_map(|path| {
        let mut takers = path.texts.free_candidates(circle, budget);
        Some((path, takers.find(|(_, taker)| path.would_apply(read, taker))?))
    });
    let beside = || {
        paths.iter().find_map(|path| {
            let mut missed = path.texts.candidates_beside(circle, circle.radius, budget);
            let is_taker =
                |taker: &Candidate| matches!(taker.owner, Owner::Element(_)) && path.would_apply(read, taker);
            Some((path, missed.find(|(_, taker)| is_taker(taker))?))
        })
    };
    over.or_else(beside)
}

/// Returns the circles that would be probes on the layer of a path, each with its layer number.
fn probe_circles(drawing: &Drawing, language: &Language) -> Vec<(u32, Shape)> {
    let circles = drawing.entities.iter().filter_map(|entity| {
        let Geometry::Circle(circle) = &entity.geometry else { return None };
        let line_type = LineType::of(&entity.line_type, &language.line_types)?;
        let is_probe = circle_meaning(line_type, circle.radius) == CircleMeaning::Probe;
        is_probe.then(|| (entity.layer, Shape::Circle { centre: xy(circle.centre), radius: circle.radius }))
    });
    circles.collect()
}

/// Returns PB119 if a text and the circle that it overlaps would be a probe on the layer of a path.
fn stray_probe_finding(
    drawing: &Drawing,
    entity: usize,
    text: AnyText<'_>,
    probes: &[(u32, Shape)],
    budget: &SearchBudget,
) -> Option<Diagnostic> {
    if probes.is_empty() || !may_be_probe_text(text.string().as_bytes()) {
        return None;
    }
    let layer = drawing.entities[entity].layer;
    let on_layer = probes.iter().map(|(other, shape)| (*other == layer).then_some(*shape));
    let (_, circle) = probes[find_shape(&text.circle(), on_layer, budget)?];
    let texts = ParameterTexts::from(text.string());
    let problem = Diagnostic::new(&messages::PROBE_ON_OTHER_LAYER)
        .quoting("text", text.string().replace('\n', " "))
        .quoting("layer", &*drawing.layers[layer as usize].name)
        .with("point", diagnostic_point(circle.point()))
        .with_text(texts.first().map(ParameterText::whole_text_fault));
    Some(at_entity(drawing, entity, text.anchor(), problem))
}

impl PathCollector<'_> {
    /// Whether an element has no text, and this one would have an effect on it without which a part would be spoilt.
    fn would_apply(&self, text: ParameterText<'_>, candidate: &Candidate) -> bool {
        let (class, text_of_owner, essential) = match candidate.owner {
            Owner::Element(element) => {
                let element = &self.elements[element];
                (element.class(self.tool()), element.text, ESSENTIAL_LETTERS)
            }
            // Any letter missing at a probe matters, because its measured height corrects the heights of all cuts.
            Owner::Probe(probe) => (ElementClass::Probe, self.probes[probe].text, Letters::ALL),
            Owner::Start | Owner::Faulty => return false,
        };
        let mut letters = text.pieces().iter().filter_map(|piece| piece.letter);
        let has_effect = |letter| essential.contains(letter) && class.use_of(letter).counts();
        text_of_owner.is_none() && letters.any(has_effect)
    }

    /// The cutter's diameter, if the start text gives it.
    fn tool(&self) -> Option<f64> {
        let text = self.given.get(self.start.as_ref()?.text?)?;
        match text.piece(Letter::O)?.written {
            ValueKind::Number(number) => Some(number),
            _ => None,
        }
    }
}

/// Returns PB120 for a layer with these entities, or with elements that are left out of a path.
fn near_layer(
    drawing: &Drawing,
    near: &NearLayer<'_>,
    layer: u32,
    entities: &[usize],
    left_out: &[&OmittedCurve],
) -> Option<Diagnostic> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    // The pieces of a polyline, which follow each other, are one entity.
    let is_piece = |one: &usize, other: &usize| {
        let [one, other] = [*one, *other].map(|number| drawing.entities[number].group);
        one.is_some() && one == other
    };
    for entity in entities.chunk_by(is_piece) {
        *counts.entry(drawing.entities[entity[0]].kind.name()).or_default() += 1;
    }
    for left_out in left_out {
        *counts.entry(left_out.kind.name()).or_default() += 1;
    }
    let elements: Value = counts.into_iter().map(|(kind, count)| format!("{count} {kind}")).collect();
    let problem = match near {
        NearLayer::Path(path) => Diagnostic::new(&messages::NEARLY_PATH_LAYER)
            .quoting("path", path.as_str())
            .in_path(path.as_str()),
        NearLayer::Clamps => Diagnostic::new(&messages::NEARLY_CLAMP_LAYER),
        NearLayer::Parts => Diagnostic::new(&messages::NEARLY_PART_LAYER),
    };
    let name = &*drawing.layers[layer as usize].name;
    let problem = problem.quoting("layer", name).with("elements", elements);
    let problem = match look_alikes::first_look_alike(name) {
        Some(character) => problem.note(&messages::LOOK_ALIKE_IN_NAME, character),
        None => problem,
    };
    match entities.first() {
        Some(first) => {
            Some(at_entity(drawing, *first, anchor_of(&drawing.entities[*first].geometry), problem))
        }
        None => Some(Diagnostic { place: left_out.first()?.diagnostic.place.clone(), ..problem }),
    }
}
