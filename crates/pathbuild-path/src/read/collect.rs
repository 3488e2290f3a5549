//! Collects the entities of each path and determines their meaning. (book: language/line-types, book: language/markers)

use std::mem::take;
use std::sync;

use pathbuild_diagnostic::messages::{drawing as messages, paths};
use pathbuild_diagnostic::{Diagnostic, ElementId, EntityKind, Message, Point, Value};
use pathbuild_dxf::{Drawing, Entity, Geometry, Layer, Point3};
use smol_str::SmolStr;

use crate::approx::near;
use crate::element::{
    CircleMeaning, Cut, END_RADIUS, Element, IntendedMarker, Marker, MarkerInOtherUnit, Origin, PROBE_RADIUS,
    Role, START_RADIUS, Shape, Source, TURN_RADIUS, circle_meaning, curve_role, has_diameter_of,
};
use crate::geometry::{Curve, Line, Xy};
use crate::language::Language;
use crate::letter::Letter;
use crate::line_type::{LineType, LineTypes};
use crate::names::{PathName, PathPattern};
use crate::raw::{DrawingUncertainty, DrawnElements, Position, RawPath, SourceMap};
use crate::read::candidates::{Candidate, Owner};
use crate::read::entities::{FoundText, plane_arc, xy};
use crate::read::parameters::{PathCheck, StartHints, StartText, Starts};
use crate::read::texts::Texts;
use crate::text::{ParameterText, ParameterTexts, TextId};

/// A path for which entities are being collected.
pub(crate) struct PathCollector<'d> {
    pub(crate) name: PathName,
    pub(crate) start: Option<Marker>,
    /// Circles like a start marker, after the first one.
    other_starts: Vec<Marker>,
    pub(super) ends: Vec<Marker>,
    pub(super) turns: Vec<Marker>,
    pub(crate) probes: Vec<Marker>,
    /// The elements in file order.
    pub(crate) elements: Vec<Element>,
    /// The texts that belong to an element.
    pub(crate) given: ParameterTexts,
    pub(crate) map: SourceMap,
    pub(crate) texts: Texts<'d>,
    left_out: Vec<(EntityKind, Option<Point>)>,
    pub(crate) diagnostics: Vec<Diagnostic>,
    has_broken_circle: bool,
    pub(super) uncertainty: DrawingUncertainty,
    pub(super) unclear: Vec<UnclearCircle>,
    pub(super) shared: Vec<SharedProblem>,
    pub(super) hints: StartHints,
    /// Whether the layers contain anything other than texts: layers with texts alone form no path.
    pub(super) has_elements: bool,
}

/// A circle that means nothing, because of its line type or its diameter.
pub(crate) struct UnclearCircle {
    pub(super) marker: Marker,
    pub(super) shape: Shape,
    /// The marker that the circle was probably meant to be.
    pub(super) meant: IntendedMarker,
}

/// A problem that is reported once for all elements of a path that have it.
pub(super) struct SharedProblem {
    pub(super) line_type: SmolStr,
    pub(super) message: &'static Message,
    index: usize,
    count: usize,
}

/// Collects the paths of a drawing in order of first appearance, before their texts are assigned.
pub(super) fn paths<'d>(drawing: &'d Drawing, language: &Language) -> Vec<PathCollector<'d>> {
    let layers = PathLayers::find(drawing, &language.path_pattern);
    let mut paths: Vec<_> = layers.by_path().map(|layers| PathCollector::new(drawing, layers)).collect();
    if let [path] = &mut paths[..] {
        path.map.0.reserve(drawing.entities.len());
        path.elements.reserve(drawing.entities.len());
    }
    let mut line_types = LineTypes::new(&language.line_types);
    for (entity, origin) in drawing.entities.iter().zip(&drawing.origins) {
        if let Some(Membership { path, layer }) = layers.membership(entity.layer) {
            paths[path].add(entity, layer, *origin, &mut line_types);
        }
    }
    for fault in &drawing.faults {
        if let Some(Membership { path, .. }) = layers.membership(fault.layer) {
            paths[path].add_fault(&fault.diagnostic);
        }
    }
    for left_out in language.left_out(drawing) {
        if let Some(Membership { path, .. }) = layers.membership(left_out.layer) {
            paths[path].left_out.push((left_out.kind, left_out.point));
            paths[path].add_located(&left_out.diagnostic);
        }
    }
    paths
}

impl PathCollector<'_> {
    fn new(drawing: &Drawing, layers: &[FoundLayer]) -> Self {
        let mut path = Self {
            name: layers[0].path.clone(),
            start: None,
            other_starts: Vec::new(),
            ends: Vec::new(),
            turns: Vec::new(),
            probes: Vec::new(),
            elements: Vec::new(),
            given: ParameterTexts::default(),
            map: SourceMap::default(),
            texts: Texts::default(),
            left_out: Vec::new(),
            diagnostics: Vec::new(),
            has_broken_circle: false,
            uncertainty: DrawingUncertainty::default(),
            unclear: Vec::new(),
            shared: Vec::new(),
            hints: StartHints::default(),
            has_elements: false,
        };
        for found in layers {
            let layer = &drawing.layers[found.number];
            path.texts.add_layer(&layer.name);
            if layer.hidden {
                path.report_hidden(&layer.name);
            }
        }
        path
    }

    /// Returns the findings about the texts of layers that have a path name but contain only texts.
    pub(crate) fn orphan_findings(mut self) -> Vec<Diagnostic> {
        take(&mut self.texts).assign(&mut self, 0.0);
        let mut diagnostics = take(&mut self.diagnostics);
        for diagnostic in &mut diagnostics {
            self.map.locate(diagnostic);
            diagnostic.place.element = None;
        }
        diagnostics
    }

    pub(crate) fn assign_texts(&mut self, language: &Language) {
        self.count_shared_problems();
        let mut texts = take(&mut self.texts);
        self.choose_missing_markers(&mut texts);
        let before = self.diagnostics.len();
        texts.assign(self, language.doubts.text_margin);
        self.texts = texts;
        // The text may belong to a broken entity.
        if self.uncertainty.has_broken_entity {
            self.diagnostics.truncate(before);
        }
        let name = self.name.as_str();
        for diagnostic in &mut self.diagnostics[before..] {
            diagnostic.path = Some(name.into());
        }
    }

    /// Sorts the elements into the order of segments, and checks everything that does not depend on values.
    pub(super) fn finish(mut self, starts: &Starts) -> (RawPath, SourceMap) {
        self.elements.sort_by_key(|element| match element.shape {
            Shape::Circle { .. } => 0,
            Shape::Curve(Curve::Line(_)) => 1,
            Shape::Curve(Curve::Arc(_)) => 2,
        });
        let mut ends = self.ends.into_iter();
        let drawn =
            DrawnElements { elements: self.elements, texts: self.given, layers: self.texts.layer_names() };
        let mut raw = RawPath {
            name: self.name.into(),
            start: self.start,
            end: ends.next(),
            turns: self.turns,
            probes: self.probes,
            drawn: sync::Arc::new(drawn),
            parameters: None,
            borrowed_from: None,
            definitions: Vec::new(),
            left_out: self.left_out,
            uncertainty: self.uncertainty,
            diagnostics: self.diagnostics,
        };
        raw.uncertainty.other_ends.extend(ends.map(|end| end.at));
        raw.uncertainty.path_text = self.hints.text.as_ref().map(|text| (text.string.clone(), text.anchor));
        let mut checked = PathCheck { raw: &mut raw, hints: self.hints };
        checked.check_leftovers();
        if !self.has_broken_circle {
            checked.check_markers();
        }
        checked.check_parameters(starts);
        (raw, self.map)
    }

    /// Reports a problem at the first element that has it, and counts the others.
    fn report_shared(&mut self, line_type: &str, diagnostic: Diagnostic) {
        let message = diagnostic.message;
        let is_same = |known: &&mut SharedProblem| known.message == message && known.line_type == line_type;
        if let Some(known) = self.shared.iter_mut().find(is_same) {
            known.count += 1;
            return;
        }
        let index = self.diagnostics.len();
        self.shared.push(SharedProblem { line_type: line_type.into(), message, index, count: 1 });
        self.report(diagnostic);
    }

    /// Fills in the number of elements that share each problem.
    fn count_shared_problems(&mut self) {
        for shared in take(&mut self.shared) {
            self.diagnostics[shared.index].arguments.push(("count", shared.count.into()));
        }
    }

    pub(super) fn text_of(&self, owner: Owner) -> Option<ParameterText<'_>> {
        let text = match owner {
            Owner::Start => self.start.as_ref()?.text?,
            Owner::Probe(probe) => self.probes[probe].text?,
            Owner::Element(element) => self.elements[element].text?,
            Owner::Faulty => return None,
        };
        self.given.get(text)
    }

    /// Keeps the first text that is probably the path's own but does not belong to the start marker.
    pub(super) fn note_start_text(&mut self, text: ParameterText<'_>, drawn: &FoundText<'_>) {
        let has = |letter| text.letters.contains(letter);
        if self.hints.text.is_none() && has(Letter::O) && has(Letter::T) && !has(Letter::Embed) {
            let (anchor, middle) = (drawn.anchor(), drawn.circle().centre);
            self.hints.text = Some(StartText { string: text.as_str().into(), anchor, middle });
        }
    }

    /// Like [`Self::note_start_text`], for a text that belongs to an element.
    pub(super) fn note_given_start_text(&mut self, text: TextId, drawn: &FoundText<'_>) {
        let given = take(&mut self.given);
        if let Some(text) = given.get(text) {
            self.note_start_text(text, drawn);
        }
        self.given = given;
    }

    /// Adds to PB107 the first entity that was left out: a text on such an entity has no element.
    pub(super) fn with_left_out(&self, problem: Diagnostic) -> Diagnostic {
        let first = self.left_out.iter().find_map(|(kind, point)| Some((kind, (*point)?)));
        let Some((kind, point)) = first else { return problem };
        problem.note(
            &messages::TEXT_OF_LEFT_OUT,
            vec![("kind", Value::quoted(kind.name())), ("point", point.into())],
        )
    }

    fn report_hidden(&mut self, layer: &str) {
        let mut diagnostic = Diagnostic::new(&messages::LAYER_NOT_VISIBLE).quoting("layer", layer);
        diagnostic.place.layer = Some(layer.into());
        self.report(diagnostic);
    }

    pub(super) fn report(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic.or_in_path(self.name.as_str()));
    }

    fn next_id(&mut self, position: Position) -> ElementId {
        let id = u32::try_from(self.map.positions().len()).unwrap_or(u32::MAX);
        self.map.push(position);
        ElementId(id)
    }

    /// Adds a diagnostic of the reader. Its line and handle go into the source map, since edits elsewhere may shift them.
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
        self.uncertainty.has_broken_entity = true;
        let is_circle =
            matches!(diagnostic.place.entity, Some(EntityKind::Circle | EntityKind::Other) | None);
        // A finding about elements far from the origin names only the first of them; others may be circles.
        self.has_broken_circle |= is_circle || diagnostic.message == &messages::TOO_LARGE;
        self.add_located(diagnostic);
    }
}

/// The layers of a drawing that belong to paths.
pub(super) struct PathLayers {
    /// The path layers in file order, except that the layers of a path follow its first one.
    found: Vec<FoundLayer>,
    /// The memberships by layer number.
    memberships: Vec<Option<Membership>>,
}

/// A layer of the drawing that belongs to a path.
pub(super) struct FoundLayer {
    /// Name of the path to which the layer belongs, in the spelling of the layer.
    pub(super) path: PathName,
    /// Number of the layer among the layers of the drawing.
    pub(super) number: usize,
    /// Number of the first layer of the same path.
    first: usize,
}

/// The place of a layer in a path.
#[derive(Clone, Copy)]
pub(super) struct Membership {
    /// Index of the path in the drawing.
    pub(super) path: usize,
    /// Index of the layer in the path.
    pub(super) layer: u32,
}

impl PathLayers {
    pub(super) fn find(drawing: &Drawing, pattern: &PathPattern) -> Self {
        let layer = |(number, layer): (usize, &Layer)| {
            let path = pattern.layer(&layer.name)?.path;
            Some(FoundLayer { path, number, first: number })
        };
        let mut found: Vec<FoundLayer> = drawing.layers.iter().enumerate().filter_map(layer).collect();
        found.sort_by(|one, other| one.path.cmp(&other.path));
        for of_path in found.chunk_by_mut(|one, other| one.path == other.path) {
            let first = of_path[0].number;
            for layer in of_path {
                layer.first = first;
            }
        }
        found.sort_by_key(|layer| layer.first);
        let mut memberships = vec![None; drawing.layers.len()];
        for (path, layers) in by_path(&found).enumerate() {
            for (layer, found) in (0_u32..).zip(layers) {
                memberships[found.number] = Some(Membership { path, layer });
            }
        }
        Self { found, memberships }
    }

    /// Returns the layers of each path, in order of first appearance.
    fn by_path(&self) -> impl Iterator<Item = &[FoundLayer]> {
        by_path(&self.found)
    }

    /// Returns the membership of a layer; `None` if it is not a path layer.
    pub(super) fn membership(&self, layer: u32) -> Option<Membership> {
        self.memberships[layer as usize]
    }
}

fn by_path(found: &[FoundLayer]) -> impl Iterator<Item = &[FoundLayer]> {
    found.chunk_by(|one, other| one.first == other.first)
}

/// An entity on one of a path's layers.
#[derive(Clone, Copy)]
struct LayerEntity<'d> {
    source: Source,
    entity: &'d Entity,
    line_type: Option<LineType>,
}

impl<'d> PathCollector<'d> {
    /// Adds the next entity in file order.
    pub(super) fn add(
        &mut self,
        entity: &'d Entity,
        layer: u32,
        position: Position,
        line_types: &mut LineTypes<'_, 'd>,
    ) {
        let source = Source { id: self.next_id(position), entity: entity.kind, layer };
        let found = |line_type| LayerEntity { source, entity, line_type };
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
        // Nearly all entities lie in the plane.
        if points.iter().all(|point| point.z == 0.0) {
            return;
        }
        if let Some(point) = points.iter().find(|point| !near(point.z, 0.0)) {
            let problem = Diagnostic::new(&messages::OFF_PLANE).with("z", point.z);
            self.report_shared("", self.origin(source, begin).at(problem));
        }
    }

    fn add_curve(&mut self, found: &LayerEntity<'_>, curve: Curve) {
        let shape = Shape::Curve(curve);
        let Some(role) = found.line_type.and_then(curve_role) else {
            self.add_unknown(found, shape);
            let element = Element { source: found.source, shape, role: Role::SilentSweep, text: None };
            return self.uncertainty.unclear_curves.push(element);
        };
        self.add_element(found, shape, role);
    }

    fn add_circle(&mut self, found: &LayerEntity<'_>, centre: Xy, radius: f64) {
        let shape = Shape::Circle { centre, radius };
        let Some(line_type) = found.line_type else {
            let like = LineType::guess(&found.entity.line_type).unwrap_or(LineType::Phantom);
            self.add_unclear(found, shape, IntendedMarker::of(like, radius));
            return self.add_unknown(found, shape);
        };
        match circle_meaning(line_type, radius) {
            CircleMeaning::Cut(cut) => self.add_element(found, shape, Role::Cut(cut)),
            CircleMeaning::Start => self.add_start(found, shape),
            CircleMeaning::End => self.ends.push(self.marker(found, centre)),
            CircleMeaning::Turn => self.turns.push(self.marker(found, centre)),
            CircleMeaning::IgnoredProbe => self.candidate(found, shape, Owner::Faulty),
            CircleMeaning::Probe => {
                self.candidate(found, shape, Owner::Probe(self.probes.len()));
                self.probes.push(self.marker(found, centre));
            }
            CircleMeaning::UnknownLineType => self.add_unknown(found, shape),
            CircleMeaning::UnknownDiameter => {
                let is_phantom = line_type == LineType::Phantom;
                let scaled = MarkerInOtherUnit::of_radius(radius).filter(|_| is_phantom);
                let diagnostic = match scaled {
                    None if line_type == LineType::Dashdot => {
                        Diagnostic::new(&messages::UNKNOWN_DASHDOT_CIRCLE)
                    }
                    None => Diagnostic::new(&messages::UNKNOWN_SPECIAL_CIRCLE),
                    Some(scaled) => Diagnostic::new(&messages::SPECIAL_CIRCLE_IN_OTHER_UNIT)
                        .with("unit", scaled.unit)
                        .with("factor", scaled.factor)
                        .with("meant", 2.0 * scaled.radius),
                };
                let diagnostic = diagnostic
                    .quoting("line_type", &*found.entity.line_type)
                    .with("diameter", exact_length(2.0 * radius));
                self.report(self.origin(found.source, centre).at(diagnostic));
                self.uncertainty.is_in_other_unit |= scaled.is_some();
                let radius = scaled.map_or(radius, |scaled| scaled.radius);
                let meant =
                    if is_phantom { IntendedMarker::of_radius(radius) } else { IntendedMarker::Other };
                self.add_unclear(found, shape, meant);
                self.candidate(found, shape, Owner::Faulty);
            }
        }
    }

    fn add_unclear(&mut self, found: &LayerEntity<'_>, shape: Shape, meant: IntendedMarker) {
        let marker = self.marker(found, shape.point());
        self.uncertainty.unclear_circles.push(marker.at);
        self.unclear.push(UnclearCircle { marker, shape, meant });
    }

    fn marker(&self, found: &LayerEntity<'_>, at: Xy) -> Marker {
        Marker { origin: self.origin(found.source, at), at, text: None }
    }

    fn add_start(&mut self, found: &LayerEntity<'_>, shape: Shape) {
        let marker = self.marker(found, shape.point());
        if self.start.is_some() {
            self.candidate(found, shape, Owner::Faulty);
            return self.other_starts.push(marker);
        }
        self.candidate(found, shape, Owner::Start);
        self.start = Some(marker);
    }

    /// Adds an element with a meaningless line type. It still takes its text, which would otherwise be reported as belonging to no element.
    fn add_unknown(&mut self, found: &LayerEntity<'_>, shape: Shape) {
        let known: Value = LineType::NAMES.iter().map(|(name, _)| *name).collect();
        let name = &*found.entity.line_type;
        let like = LineType::guess(name);
        let (message, shown) = match (found.line_type, like) {
            (Some(_), _) => (&messages::LINE_TYPE_ON_ENTITY, None),
            (None, Some(like)) => (&messages::LINE_TYPE_LIKE_ANOTHER, Some(like.name())),
            (None, None) => (&messages::UNKNOWN_LINE_TYPE, None),
        };
        let mut diagnostic = Diagnostic::new(message)
            .quoting("line_type", name)
            .with("element", shape.word())
            .with("known", known);
        if let Some(like) = shown {
            diagnostic = diagnostic.quoting("like", like);
        }
        self.report_shared(name, self.origin(found.source, shape.point()).at(diagnostic));
        self.candidate(found, shape, Owner::Faulty);
    }

    fn add_element(&mut self, found: &LayerEntity<'_>, shape: Shape, role: Role) {
        if role != Role::SilentSweep {
            self.candidate(found, shape, Owner::Element(self.elements.len()));
        }
        if role == Role::Subpath && found.entity.is_mirrored {
            let problem = Diagnostic::new(&paths::MIRRORED_SUBPATH);
            self.report(self.origin(found.source, shape.point()).at(problem));
        }
        self.elements.push(Element { source: found.source, shape, role, text: None });
    }

    fn candidate(&mut self, found: &LayerEntity<'_>, shape: Shape, owner: Owner) {
        let LayerEntity { source, entity, .. } = *found;
        let candidate = Candidate { id: source.id, shape, group: entity.group, owner, is_taken: false };
        self.texts.add_candidate(source.layer, candidate);
    }
}

/// Returns a length with enough digits to distinguish it from a similar length: 1.0001, not 1.
fn exact_length(length: f64) -> Value {
    let is_shown = (length * 1000.0 - (length * 1000.0).round()).abs() <= 1e-6;
    if is_shown { length.into() } else { Value::quoted(format!("{length:.9}").trim_end_matches('0')) }
}

impl PathCollector<'_> {
    /// Chooses the circles that were probably meant as start and end. Each problem has been reported already, or is reported here.
    fn choose_missing_markers(&mut self, texts: &mut Texts<'_>) {
        let mut has_other_line_type = false;
        if self.start.is_none() {
            self.start =
                self.take_unclear(IntendedMarker::Start).or_else(|| self.take_circle_with_path_text(texts));
            if self.start.is_none() {
                self.start = self.take_element_with_path_text(texts);
                has_other_line_type = self.start.is_some();
            }
            if let Some(start) = &self.start {
                texts.give_to_start(start);
            }
        }
        if let Some(start) = &self.start
            && !texts.has_path_text(start, START_RADIUS)
        {
            let mut ends = self.ends.iter();
            let end = ends.find(|end| texts.has_path_text(end, END_RADIUS));
            self.hints.swapped = end.map(|end| end.origin.point);
        }
        if self.ends.is_empty() {
            let end = self.take_unclear(IntendedMarker::End);
            let end =
                end.or_else(|| has_other_line_type.then(|| self.take_element_like_end(texts)).flatten());
            self.ends.extend(end);
        }
        self.report_other_starts(texts);
        let first = self.ends.first().map(|end| end.origin.point);
        for end in self.ends.iter().skip(1).map(|end| end.origin.clone()).collect::<Vec<_>>() {
            let problem = Diagnostic::new(&messages::TWO_ENDS).quoting("name", self.name.as_str());
            self.report(end.at(problem.with("first", first.unwrap_or(end.point))));
        }
    }

    /// Reports circles like a second start marker. Without a start's text they were probably meant as another marker.
    fn report_other_starts(&mut self, texts: &Texts<'_>) {
        let Some(start) = self.start.clone() else { return };
        let has_text = texts.has_path_text(&start, START_RADIUS);
        for marker in take(&mut self.other_starts) {
            let is_start = !has_text || texts.has_path_text(&marker, START_RADIUS);
            if is_start {
                self.uncertainty.has_second_start = true;
            } else {
                self.uncertainty.unclear_circles.push(marker.at);
            }
            if !is_start && self.ends.is_empty() && self.hints.meant_as_end.is_none() {
                self.hints.meant_as_end = Some(marker.origin.point);
                continue;
            }
            let message = if is_start { &messages::TWO_STARTS } else { &messages::SECOND_START_WITHOUT_TEXT };
            let problem = Diagnostic::new(message).quoting("name", self.name.as_str());
            self.report(marker.origin.at(problem.with("first", start.origin.point)));
        }
    }

    /// Removes and returns the first circle without a meaning that was probably meant as this marker.
    fn take_unclear(&mut self, meant: IntendedMarker) -> Option<Marker> {
        let index = self.unclear.iter().position(|circle| circle.meant == meant)?;
        let marker = self.unclear.remove(index).marker;
        self.uncertainty.unclear_circles.retain(|point| *point != marker.at);
        Some(marker)
    }

    /// Returns a circle that is another marker or has no meaning, but has the text of a start marker. It then no longer counts as the other marker.
    /// Reports PB101 at the circle.
    fn take_circle_with_path_text(&mut self, texts: &Texts<'_>) -> Option<Marker> {
        let unclear = self.unclear.iter();
        let unclear = unclear.map(|circle| (&circle.marker, circle.shape.radius().unwrap_or_default()));
        let ends = self.ends.iter().map(|end| (end, END_RADIUS));
        let turns = self.turns.iter().map(|turn| (turn, TURN_RADIUS));
        let probes = self.probes.iter().map(|probe| (probe, PROBE_RADIUS));
        let circles: Vec<(&Marker, f64)> = ends.chain(unclear).chain(turns).chain(probes).collect();
        let (marker, radius) =
            circles.into_iter().find(|(marker, radius)| texts.has_path_text(marker, *radius))?;
        let marker = marker.clone();
        let problem = self.missing_marker(&messages::MISSING_START, &marker).note(
            &messages::MEANT_AS_START,
            vec![("point", marker.origin.point.into()), ("diameter", (2.0 * radius).into())],
        );
        self.report(marker.origin.at(problem));
        for markers in [&mut self.ends, &mut self.turns, &mut self.probes] {
            markers.retain(|other| other.origin.id != marker.origin.id);
        }
        self.unclear.retain(|other| other.marker.origin.id != marker.origin.id);
        self.uncertainty.unclear_circles.retain(|point| *point != marker.at);
        Some(marker)
    }

    /// Removes and returns a circle to mill or drill that has the text of a start, because its line type was lost. Reports PB101 at the circle.
    fn take_element_with_path_text(&mut self, texts: &mut Texts<'_>) -> Option<Marker> {
        let circles = self.elements.iter().enumerate();
        let mut circles = circles.filter_map(|(index, element)| Some((index, element.shape.radius()?)));
        let index = circles
            .find(|(index, radius)| texts.has_path_text(&self.marker_of(*index, texts), *radius))
            .map(|(index, _)| index)?;
        let marker = self.take_element(index, texts);
        let problem = self
            .missing_marker(&messages::MISSING_START, &marker)
            .note(&messages::MEANT_AS_PHANTOM_START, vec![("point", marker.origin.point.into())]);
        self.report(marker.origin.at(problem));
        Some(marker)
    }

    /// Removes and returns the only circle to mill with the diameter of an end marker, in a path with a start that has lost its line type. Reports
    /// PB102 at the circle.
    fn take_element_like_end(&mut self, texts: &mut Texts<'_>) -> Option<Marker> {
        let is_like_end = |element: &Element| {
            element.role == Role::Cut(Cut::Mill)
                && element.shape.radius().is_some_and(|radius| has_diameter_of(radius, END_RADIUS))
        };
        let mut like_end = self.elements.iter().enumerate().filter(|(_, element)| is_like_end(element));
        let (Some((index, _)), None) = (like_end.next(), like_end.next()) else { return None };
        let marker = self.take_element(index, texts);
        let problem = self
            .missing_marker(&messages::MISSING_END, &marker)
            .note(&messages::MEANT_AS_PHANTOM_END, vec![("point", marker.origin.point.into())]);
        self.report(marker.origin.at(problem));
        Some(marker)
    }

    fn missing_marker(&self, message: &'static Message, marker: &Marker) -> Diagnostic {
        Diagnostic::new(message).quoting("name", self.name.as_str()).quoting("layer", &*marker.origin.layer)
    }

    /// Returns the marker that a circle among the elements would be.
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
