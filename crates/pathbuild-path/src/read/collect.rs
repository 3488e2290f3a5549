//! The entities of each path, and what each means.

use std::sync::Arc as Shared;

use pathbuild_diagnostic::messages::drawing as messages;
use pathbuild_diagnostic::{Diagnostic, ElementId, EntityKind, Point, Value, words};
use pathbuild_dxf::{Arc as DxfArc, Drawing, Entity, Geometry, Point3};

use super::Starts;
use super::checked::Checked;
use super::elements::{Elements, Place};
use super::layers::{Count, Membership, counts, path_layers};
use super::texts::Texts;
use crate::approx::near;
use crate::assign::Candidate;
use crate::element::{
    CircleMeaning, Element, Marker, Origin, Role, Shape, Source, circle_meaning, curve_role,
};
use crate::geometry::{Arc, Curve, Line, Xy};
use crate::line_type::{LineType, LineTypes};
use crate::name::PathName;
use crate::raw::{Drawn, Language, Position, RawPath, SourceMap};
use crate::text::ParameterTexts;

/// A path while its entities are being collected.
pub(crate) struct Collected<'d> {
    pub(crate) name: PathName,
    pub(crate) start: Option<Marker>,
    end: Option<Marker>,
    turns: Vec<Marker>,
    pub(crate) probes: Vec<Marker>,
    pub(crate) elements: Elements,
    /// The texts that found an element.
    pub(crate) given: ParameterTexts,
    pub(crate) map: SourceMap,
    pub(crate) texts: Texts<'d>,
    left_out: Vec<(EntityKind, Point)>,
    pub(crate) diagnostics: Vec<Diagnostic>,
    has_broken_circle: bool,
    has_broken_entity: bool,
    has_elements: bool,
}

/// Where a text that finds a candidate is put.
#[derive(Clone, Copy)]
pub(crate) enum Owner {
    Start,
    Probe(usize),
    Element(Place),
    /// An element that is reported anyway.
    Faulty,
}

/// An entity on one of a path's layers.
#[derive(Clone, Copy)]
struct Found<'d> {
    source: Source,
    entity: &'d Entity,
    line_type: Option<LineType>,
}

/// The paths of a drawing in order of first appearance, their texts not yet assigned.
pub(crate) fn paths<'d>(drawing: &'d Drawing, language: &Language) -> Vec<Collected<'d>> {
    let layers = path_layers(drawing, &language.path_pattern);
    let mut by_path: Vec<&[(PathName, usize)]> = layers.chunk_by(|one, other| one.0 == other.0).collect();
    by_path.sort_by_key(|layers| layers[0].1);
    let counts = counts(drawing);
    let mut paths = Vec::with_capacity(by_path.len());
    let mut memberships = vec![None; drawing.layers.len()];
    for (path, layers) in by_path.into_iter().enumerate() {
        for (layer, (_, number)) in (0_u32..).zip(layers) {
            memberships[*number] = Some(Membership { path, layer });
        }
        paths.push(Collected::new(drawing, layers, &counts));
    }
    let mut line_types = LineTypes::new(&language.line_types);
    for (entity, origin) in drawing.entities.iter().zip(&drawing.origins) {
        if let Some(Membership { path, layer }) = memberships[entity.layer as usize] {
            let position = Position { line: origin.line, handle: origin.handle };
            paths[path].add(entity, layer, position, &mut line_types);
        }
    }
    for fault in &drawing.faults {
        if let Some(Membership { path, .. }) = memberships[fault.layer as usize] {
            paths[path].add_fault(&fault.diagnostic);
        }
    }
    for left_out in &drawing.left_out {
        if let Some(Membership { path, .. }) = memberships[left_out.layer as usize] {
            paths[path].left_out.extend(left_out.point.map(|point| (left_out.kind, point)));
            paths[path].add_located(&left_out.diagnostic);
        }
    }
    paths
}

impl<'d> Collected<'d> {
    /// A path with these layers, with room for what is on them.
    fn new(drawing: &Drawing, layers: &[(PathName, usize)], counts: &[Count]) -> Self {
        let mut path = Self {
            name: layers[0].0.clone(),
            start: None,
            end: None,
            turns: Vec::new(),
            probes: Vec::new(),
            elements: Elements::default(),
            given: ParameterTexts::default(),
            map: SourceMap::default(),
            texts: Texts::with_capacity(layers.len()),
            left_out: Vec::new(),
            diagnostics: Vec::new(),
            has_broken_circle: false,
            has_broken_entity: false,
            has_elements: false,
        };
        for (_, number) in layers {
            let (layer, count) = (&drawing.layers[*number], counts[*number]);
            path.texts.add_layer(&layer.name, count);
            path.elements.reserve(count);
            path.map.reserve(count.texts + count.others());
            if layer.hidden {
                path.report_hidden(&layer.name);
            }
        }
        path
    }

    /// Whether there is anything but texts: a layer with texts alone is no path.
    pub(crate) fn has_elements(&self) -> bool {
        self.has_elements
    }

    /// What is wrong with a group of layers that holds texts only.
    pub(crate) fn orphans(mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.texts).assign(&mut self);
        let mut diagnostics = std::mem::take(&mut self.diagnostics);
        for diagnostic in &mut diagnostics {
            self.map.locate(diagnostic);
            diagnostic.place.element = None;
        }
        diagnostics
    }

    /// Gives each text to its element.
    pub(crate) fn assign_texts(&mut self) {
        let mut texts = std::mem::take(&mut self.texts);
        let before = self.diagnostics.len();
        texts.assign(self);
        self.texts = texts;
        // A broken entity may be what the text belongs to.
        if self.has_broken_entity {
            self.diagnostics.truncate(before);
        }
        let name = self.name.as_str();
        for diagnostic in &mut self.diagnostics[before..] {
            diagnostic.path = Some(name.into());
        }
    }

    /// Puts the elements into the order of segments, and checks what needs no values.
    pub(crate) fn finish(self, starts: &Starts) -> (RawPath, SourceMap) {
        let drawn = Drawn {
            elements: self.elements.in_order(),
            texts: self.given,
            layers: self.texts.into_layer_names(),
        };
        let raw = RawPath {
            name: self.name,
            start: self.start,
            end: self.end,
            turns: self.turns,
            probes: self.probes,
            drawn: Shared::new(drawn),
            parameters: None,
            borrowed_from: None,
            definitions: Vec::new(),
            left_out: self.left_out,
            diagnostics: self.diagnostics,
        };
        let (has_broken_circle, has_broken_entity) = (self.has_broken_circle, self.has_broken_entity);
        let mut checked = Checked { raw, has_broken_circle, has_broken_entity };
        checked.check_markers();
        checked.check_parameters(starts);
        (checked.raw, self.map)
    }

    fn report_hidden(&mut self, layer: &str) {
        let mut diagnostic = Diagnostic::new(&messages::LAYER_NOT_VISIBLE).with("layer", layer);
        diagnostic.place.layer = Some(layer.into());
        self.report(diagnostic);
    }

    fn report(&mut self, diagnostic: Diagnostic) {
        let name = self.name.as_str();
        let is_placed = diagnostic.path.is_some();
        self.diagnostics.push(if is_placed { diagnostic } else { diagnostic.in_path(name) });
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

    fn add(
        &mut self,
        entity: &'d Entity,
        layer: u32,
        position: Position,
        line_types: &mut LineTypes<'d, '_>,
    ) {
        let source = Source { id: self.next_id(position), entity: entity.kind, layer };
        let found = |line_type| Found { source, entity, line_type };
        match &entity.geometry {
            Geometry::Text(text) => self.texts.add_text(text, source),
            Geometry::MText(text) => self.texts.add_mtext(text, source),
            Geometry::Circle(circle) => {
                self.check_plane(source, &[circle.centre], xy(circle.centre));
                let found = found(line_types.get(&entity.line_type));
                self.add_circle(&found, xy(circle.centre), circle.radius);
            }
            Geometry::Line(line) => {
                let curve = Curve::Line(Line { start: xy(line.start), end: xy(line.end) });
                self.check_plane(source, &[line.start, line.end], curve.start());
                self.add_curve(&found(line_types.get(&entity.line_type)), curve);
            }
            Geometry::Arc(arc) => {
                let curve = Curve::Arc(plane_arc(arc));
                self.check_plane(source, &[arc.centre], curve.start());
                self.add_curve(&found(line_types.get(&entity.line_type)), curve);
            }
        }
    }

    fn origin(&self, source: Source, point: Xy) -> Origin {
        self.texts.origin(source, point)
    }

    fn check_plane(&mut self, source: Source, points: &[Point3], begin: Xy) {
        self.has_elements = true;
        if let Some(point) = points.iter().find(|point| !near(point.z, 0.0)) {
            let problem = Diagnostic::new(&messages::OFF_PLANE).with("z", point.z);
            self.report(self.origin(source, begin).at(problem));
        }
    }

    fn add_curve(&mut self, found: &Found<'_>, curve: Curve) {
        let shape = Shape::Curve(curve);
        match found.line_type.and_then(curve_role) {
            Some(role) => self.add_element(found, shape, role),
            None => self.add_unknown(found, shape),
        }
    }

    fn add_circle(&mut self, found: &Found<'_>, centre: Xy, radius: f64) {
        let shape = Shape::Circle { centre, radius };
        let Some(line_type) = found.line_type else { return self.add_unknown(found, shape) };
        match circle_meaning(line_type, radius) {
            CircleMeaning::Cut(cut) => self.add_element(found, shape, Role::Cut(cut)),
            CircleMeaning::Start => self.add_start(found, shape),
            CircleMeaning::End => self.add_end(found, centre),
            CircleMeaning::Turn => self.turns.push(self.marker(found, centre)),
            CircleMeaning::IgnoredProbe => self.candidate(found, shape, Owner::Faulty),
            CircleMeaning::Probe => {
                self.candidate(found, shape, Owner::Probe(self.probes.len()));
                self.probes.push(self.marker(found, centre));
            }
            CircleMeaning::UnknownLineType => self.add_unknown(found, shape),
            CircleMeaning::UnknownDiameter => {
                let diagnostic = Diagnostic::new(&messages::UNKNOWN_SPECIAL_CIRCLE)
                    .with("line_type", &*found.entity.line_type)
                    .with("diameter", 2.0 * radius);
                self.report(self.origin(found.source, centre).at(diagnostic));
                self.candidate(found, shape, Owner::Faulty);
            }
        }
    }

    fn marker(&self, found: &Found<'_>, at: Xy) -> Marker {
        Marker { origin: self.origin(found.source, at), at, text: None }
    }

    fn add_start(&mut self, found: &Found<'_>, shape: Shape) {
        let marker = self.marker(found, shape.point());
        if let Some(first) = &self.start {
            let diagnostic = Diagnostic::new(&messages::TWO_STARTS)
                .with("name", self.name.as_str())
                .with("first", first.origin.point);
            self.candidate(found, shape, Owner::Faulty);
            return self.report(marker.origin.at(diagnostic));
        }
        self.candidate(found, shape, Owner::Start);
        self.start = Some(marker);
    }

    fn add_end(&mut self, found: &Found<'_>, at: Xy) {
        let marker = self.marker(found, at);
        if let Some(first) = &self.end {
            let diagnostic = Diagnostic::new(&messages::TWO_ENDS)
                .with("name", self.name.as_str())
                .with("first", first.origin.point);
            return self.report(marker.origin.at(diagnostic));
        }
        self.end = Some(marker);
    }

    /// A line type that means nothing here. The element still takes its text, which would else be reported as belonging to nothing.
    fn add_unknown(&mut self, found: &Found<'_>, shape: Shape) {
        let known: Value = LineType::NAMES.iter().map(|(name, _)| *name).collect();
        let message = match found.line_type {
            Some(_) => &messages::LINE_TYPE_ON_ENTITY,
            None => &messages::UNKNOWN_LINE_TYPE,
        };
        let diagnostic = Diagnostic::new(message)
            .with("line_type", &*found.entity.line_type)
            .with("element", shape.word())
            .with("known", known);
        self.report(self.origin(found.source, shape.point()).at(diagnostic));
        self.candidate(found, shape, Owner::Faulty);
    }

    fn add_element(&mut self, found: &Found<'_>, shape: Shape, role: Role) {
        if role != Role::SilentSweep {
            self.candidate(found, shape, Owner::Element(self.elements.next(&shape)));
        }
        self.elements.push(Element { source: found.source, shape, role, text: None });
    }

    fn candidate(&mut self, found: &Found<'_>, shape: Shape, owner: Owner) {
        let Found { source, entity, .. } = *found;
        let candidate = Candidate { id: source.id, shape, group: entity.group, owner, is_taken: false };
        self.texts.add_candidate(source.layer, candidate);
    }
}

pub(super) fn xy(point: Point3) -> Xy {
    Xy::new(point.x, point.y)
}

pub(super) fn plane_arc(arc: &DxfArc) -> Arc {
    Arc::from_angles(xy(arc.centre), arc.radius, arc.start_angle, arc.end_angle, arc.clockwise)
}

/// What an element that takes texts is called.
pub(crate) fn candidate_word(candidate: &Candidate) -> &'static pathbuild_diagnostic::Word {
    match candidate.owner {
        Owner::Start => &words::PATH_START,
        Owner::Probe(_) => &words::PROBE,
        Owner::Element(_) | Owner::Faulty => candidate.shape.word(),
    }
}
