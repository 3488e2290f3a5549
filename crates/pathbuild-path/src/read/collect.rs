//! The entities of each path, and what each means.

use std::collections::BTreeMap;
use std::sync::Arc as Shared;

use pathbuild_diagnostic::messages::drawing as messages;
use pathbuild_diagnostic::{Diagnostic, ElementId, EntityKind, Value, words};
use pathbuild_dxf::{Arc as DxfArc, Drawing, Entity, Geometry, Point3};

use super::Starts;
use super::texts::{Count, Texts};
use crate::approx::near;
use crate::assign::Candidate;
use crate::element::{
    CircleMeaning, Element, Marker, Origin, Role, Shape, circle_meaning, curve_role, shown,
};
use crate::geometry::{Arc, Curve, Line, Xy};
use crate::line_type::LineType;
use crate::name::{PathLayer, PathName};
use crate::raw::{Language, Position, RawPath, SourceMap};
use crate::text::ParameterText;

/// A path while its entities are being collected.
pub(crate) struct Collected<'d> {
    pub(crate) raw: RawPath,
    /// In file order until texts are assigned.
    pub(crate) elements: Vec<Element>,
    pub(crate) map: SourceMap,
    pub(crate) texts: Texts<'d>,
    /// A broken entity may be the marker, or the element of a text, that is missing: what may only follow from it is not reported.
    pub(crate) has_broken_circle: bool,
    pub(crate) has_broken_entity: bool,
    has_elements: bool,
}

/// Where a text that finds a candidate is put.
#[derive(Clone, Copy)]
pub(crate) enum Owner {
    Start,
    Probe(usize),
    Element(usize),
    /// An element that is reported anyway.
    Faulty,
}

/// Elements in the order of segments: circles, lines, arcs.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Rank {
    Circle,
    Line,
    Arc,
}

/// The paths of a drawing in order of first appearance, their texts not yet assigned.
pub(crate) fn paths<'d>(drawing: &'d Drawing, language: &Language) -> Vec<Collected<'d>> {
    let names: Vec<Shared<str>> = drawing.layers.iter().map(|layer| Shared::from(&*layer.name)).collect();
    let counts = counts(drawing);
    let mut paths: Vec<Collected<'_>> = Vec::with_capacity(names.len());
    let mut by_name: BTreeMap<PathName, usize> = BTreeMap::new();
    let mut index_of_layer = vec![None; names.len()];
    for (index, layer) in (0_u32..).zip(&drawing.layers) {
        let Some(PathLayer { path: name, .. }) = language.path_pattern.layer(&layer.name) else { continue };
        let at = index as usize;
        let path = *by_name.entry(name).or_insert_with_key(|name| {
            paths.push(Collected::new(name.clone(), &layer.name));
            paths.len() - 1
        });
        index_of_layer[at] = Some(path);
        paths[path].add_layer(index, &names[at], counts[at]);
        if layer.hidden {
            paths[path].hidden_layer(&layer.name);
        }
    }
    for (entity, origin) in drawing.entities.iter().zip(&drawing.origins) {
        if let Some(path) = index_of_layer[entity.layer as usize] {
            let position = Position { line: origin.line, handle: origin.handle };
            paths[path].add(entity, &names[entity.layer as usize], position, language);
        }
    }
    for fault in &drawing.faults {
        if let Some(path) = index_of_layer[fault.layer as usize] {
            paths[path].add_fault(&fault.diagnostic);
        }
    }
    for left_out in &drawing.left_out {
        if let Some(path) = index_of_layer[left_out.layer as usize] {
            paths[path].raw.left_out.extend(left_out.point.map(|point| (left_out.kind, point)));
            paths[path].add_located(&left_out.diagnostic);
        }
    }
    paths
}

/// How much is on each layer.
fn counts(drawing: &Drawing) -> Vec<Count> {
    let mut counts = vec![Count::default(); drawing.layers.len()];
    for entity in &drawing.entities {
        let count = &mut counts[entity.layer as usize];
        match entity.geometry {
            Geometry::Text(_) | Geometry::MText(_) => count.texts += 1,
            _ => count.others += 1,
        }
    }
    counts
}

impl<'d> Collected<'d> {
    fn new(name: PathName, layer: &str) -> Self {
        let raw = RawPath {
            name,
            layer: layer.into(),
            start: None,
            end: None,
            turns: Vec::new(),
            probes: Vec::new(),
            elements: Shared::new([]),
            texts: Vec::new(),
            parameters: ParameterText::default(),
            parameters_at: None,
            definitions: Vec::new(),
            left_out: Vec::new(),
            diagnostics: Vec::new(),
        };
        Self {
            raw,
            elements: Vec::new(),
            map: SourceMap::default(),
            texts: Texts::default(),
            has_broken_circle: false,
            has_broken_entity: false,
            has_elements: false,
        }
    }

    fn add_layer(&mut self, layer: u32, name: &Shared<str>, count: Count) {
        self.texts.add_layer(layer, name, count);
        self.elements.reserve_exact(count.others);
        self.map.reserve(count.texts + count.others);
    }

    /// Whether there is anything but texts: a layer with texts alone is no path.
    pub(crate) fn has_elements(&self) -> bool {
        self.has_elements
    }

    /// What is wrong with a group of layers that holds texts only.
    pub(crate) fn orphans(mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.texts).assign(&mut self);
        let mut diagnostics = std::mem::take(&mut self.raw.diagnostics);
        for diagnostic in &mut diagnostics {
            self.map.locate(diagnostic);
            diagnostic.place.element = None;
        }
        diagnostics
    }

    /// Checks what needs no values.
    pub(crate) fn finish(mut self, starts: &Starts) -> (RawPath, SourceMap) {
        self.raw.elements = std::mem::take(&mut self.elements).into();
        self.check_markers();
        self.check_parameters(starts);
        (self.raw, self.map)
    }

    fn hidden_layer(&mut self, layer: &str) {
        let mut diagnostic = Diagnostic::new(&messages::LAYER_NOT_VISIBLE).with("layer", layer);
        diagnostic.place.layer = Some(layer.into());
        self.report(diagnostic);
    }

    pub(crate) fn report(&mut self, diagnostic: Diagnostic) {
        let name = self.raw.name.as_str();
        self.raw.diagnostics.push(if diagnostic.path.is_none() {
            diagnostic.in_path(name)
        } else {
            diagnostic
        });
    }

    fn next_id(&mut self, position: Position) -> ElementId {
        let id = u32::try_from(self.map.positions().len()).unwrap_or(u32::MAX);
        self.map.push(position);
        ElementId(id)
    }

    /// Takes a diagnostic of the reader: its line and handle go into the source map, where an edit elsewhere may shift them.
    fn add_located(&mut self, diagnostic: &Diagnostic) {
        let mut diagnostic = diagnostic.clone();
        let position = Position {
            line: diagnostic.place.line.take().unwrap_or_default(),
            handle: diagnostic.place.handle.take(),
        };
        diagnostic.place.element = Some(self.next_id(position));
        self.report(diagnostic);
    }

    fn add_fault(&mut self, diagnostic: &Diagnostic) {
        self.has_elements = true;
        self.has_broken_entity = true;
        self.has_broken_circle |=
            matches!(diagnostic.place.entity, Some(EntityKind::Circle | EntityKind::Other) | None);
        self.add_located(diagnostic);
    }

    fn add(&mut self, entity: &'d Entity, layer: &Shared<str>, position: Position, language: &Language) {
        let id = self.next_id(position);
        let origin =
            |point: Xy| Origin { id, entity: entity.kind, layer: layer.clone(), point: shown(point) };
        match &entity.geometry {
            Geometry::Text(text) => self.texts.add_text(text, entity.layer, origin(xy(text.anchor))),
            Geometry::MText(text) => self.texts.add_mtext(text, entity.layer, origin(xy(text.anchor))),
            Geometry::Circle(circle) => {
                let origin = origin(xy(circle.centre));
                self.check_plane(&origin, &[circle.centre]);
                self.add_circle(entity, origin, xy(circle.centre), circle.radius, language);
            }
            Geometry::Line(line) => {
                let origin = origin(xy(line.start));
                self.check_plane(&origin, &[line.start, line.end]);
                let curve = Curve::Line(Line { start: xy(line.start), end: xy(line.end) });
                self.add_curve(entity, origin, curve, language);
            }
            Geometry::Arc(arc) => {
                let curve = Curve::Arc(plane_arc(arc));
                let origin = origin(curve.start());
                self.check_plane(&origin, &[arc.centre]);
                self.add_curve(entity, origin, curve, language);
            }
        }
    }

    fn check_plane(&mut self, origin: &Origin, points: &[Point3]) {
        self.has_elements = true;
        if let Some(point) = points.iter().find(|point| !near(point.z, 0.0)) {
            self.report(origin.at(Diagnostic::new(&messages::OFF_PLANE).with("z", point.z)));
        }
    }

    fn add_curve(&mut self, entity: &Entity, origin: Origin, curve: Curve, language: &Language) {
        let shape = Shape::Curve(curve);
        let line_type = LineType::of(&entity.line_type, &language.line_types);
        match line_type.and_then(curve_role) {
            Some(role) => self.add_element(entity, origin, shape, role),
            None => self.add_unknown(entity, &origin, shape, line_type.is_some()),
        }
    }

    fn add_circle(&mut self, entity: &Entity, origin: Origin, centre: Xy, radius: f64, language: &Language) {
        let shape = Shape::Circle { centre, radius };
        let line_type = LineType::of(&entity.line_type, &language.line_types);
        let Some(meaning) = line_type.map(|line_type| circle_meaning(line_type, radius)) else {
            return self.add_unknown(entity, &origin, shape, false);
        };
        let marker = |origin| Marker { origin, at: centre, text: None };
        match meaning {
            CircleMeaning::Cut(cut) => self.add_element(entity, origin, shape, Role::Cut(cut)),
            CircleMeaning::Start => self.add_start(entity, marker(origin), shape),
            CircleMeaning::End => self.add_end(marker(origin)),
            CircleMeaning::Turn => self.raw.turns.push(marker(origin)),
            CircleMeaning::IgnoredProbe => self.candidate(entity, &origin, shape, Owner::Faulty),
            CircleMeaning::Probe => {
                self.candidate(entity, &origin, shape, Owner::Probe(self.raw.probes.len()));
                self.raw.probes.push(marker(origin));
            }
            CircleMeaning::UnknownLineType => self.add_unknown(entity, &origin, shape, true),
            CircleMeaning::UnknownDiameter => {
                let diagnostic = Diagnostic::new(&messages::UNKNOWN_SPECIAL_CIRCLE)
                    .with("line_type", &*entity.line_type)
                    .with("diameter", 2.0 * radius);
                self.report(origin.at(diagnostic));
                self.candidate(entity, &origin, shape, Owner::Faulty);
            }
        }
    }

    fn add_start(&mut self, entity: &Entity, marker: Marker, shape: Shape) {
        if let Some(first) = &self.raw.start {
            let diagnostic = Diagnostic::new(&messages::TWO_STARTS)
                .with("name", self.raw.name.as_str())
                .with("first", first.origin.point);
            self.candidate(entity, &marker.origin, shape, Owner::Faulty);
            return self.report(marker.origin.at(diagnostic));
        }
        self.candidate(entity, &marker.origin, shape, Owner::Start);
        self.raw.start = Some(marker);
    }

    fn add_end(&mut self, marker: Marker) {
        if let Some(first) = &self.raw.end {
            let diagnostic = Diagnostic::new(&messages::TWO_ENDS)
                .with("name", self.raw.name.as_str())
                .with("first", first.origin.point);
            return self.report(marker.origin.at(diagnostic));
        }
        self.raw.end = Some(marker);
    }

    /// A line type that means nothing here. The element still takes its text, which would else be reported as belonging to nothing.
    fn add_unknown(&mut self, entity: &Entity, origin: &Origin, shape: Shape, is_known_name: bool) {
        let known: Value = LineType::NAMES.iter().map(|(name, _)| *name).collect();
        let message =
            if is_known_name { &messages::LINE_TYPE_ON_ENTITY } else { &messages::UNKNOWN_LINE_TYPE };
        let diagnostic = Diagnostic::new(message)
            .with("line_type", &*entity.line_type)
            .with("element", shape.word())
            .with("known", known);
        self.report(origin.at(diagnostic));
        self.candidate(entity, origin, shape, Owner::Faulty);
    }

    fn add_element(&mut self, entity: &Entity, origin: Origin, shape: Shape, role: Role) {
        if role != Role::SilentSweep {
            self.candidate(entity, &origin, shape, Owner::Element(self.elements.len()));
        }
        self.elements.push(Element { origin, shape, role, text: None });
    }

    fn candidate(&mut self, entity: &Entity, origin: &Origin, shape: Shape, owner: Owner) {
        let candidate = Candidate { id: origin.id, shape, group: entity.group, is_taken: false };
        self.texts.add_candidate(entity.layer, candidate, owner);
    }

    /// Gives each text to its element, then puts the elements into the order of segments.
    pub(crate) fn assign_texts(&mut self) {
        let texts = std::mem::take(&mut self.texts);
        // A broken entity may be what the text belongs to.
        let is_blamed_on_text = !self.has_broken_entity;
        let before = self.raw.diagnostics.len();
        texts.assign(self);
        if !is_blamed_on_text {
            self.raw.diagnostics.truncate(before);
        }
        let name = self.raw.name.as_str();
        for diagnostic in &mut self.raw.diagnostics[before..] {
            diagnostic.path = Some(name.into());
        }
        self.elements.sort_by_cached_key(|element| match element.shape {
            Shape::Circle { .. } => Rank::Circle,
            Shape::Curve(Curve::Line(_)) => Rank::Line,
            Shape::Curve(Curve::Arc(_)) => Rank::Arc,
        });
    }

    /// A marker that is missing because its circle is broken is not reported twice.
    fn check_markers(&mut self) {
        if self.has_broken_circle {
            return;
        }
        let missing = |message| {
            Diagnostic::new(message).with("name", self.raw.name.as_str()).with("layer", &*self.raw.layer)
        };
        let start = self.raw.start.is_none().then(|| missing(&messages::MISSING_START));
        let end = self.raw.end.is_none().then(|| missing(&messages::MISSING_END));
        let somewhere = self.raw.elements.first().map(|element| element.origin.clone());
        for diagnostic in start.into_iter().chain(end) {
            let placed = match &somewhere {
                Some(origin) => origin.at(diagnostic),
                None => diagnostic,
            };
            self.report(placed);
        }
    }
}

pub(super) fn xy(point: Point3) -> Xy {
    Xy::new(point.x, point.y)
}

pub(super) fn plane_arc(arc: &DxfArc) -> Arc {
    Arc::from_angles(xy(arc.centre), arc.radius, arc.start_angle, arc.end_angle, arc.clockwise)
}

/// What an element that takes texts is called.
pub(crate) fn candidate_word(shape: &Shape, owner: Owner) -> &'static pathbuild_diagnostic::Word {
    match owner {
        Owner::Start => &words::PATH_START,
        Owner::Probe(_) => &words::PROBE,
        Owner::Element(_) | Owner::Faulty => shape.word(),
    }
}
