//! Collects the entities of each path.

use std::mem::take;
use std::sync::Arc;

use pathbuild_diagnostic::messages::drawing as messages;
use pathbuild_diagnostic::{Diagnostic, ElementId, EntityKind, Message, Point, Value, words};
use pathbuild_dxf::Drawing;
use smol_str::SmolStr;

use super::Starts;
use super::checked::PathCheck;
use super::layers::{FoundLayer, Membership, PathLayers};
use super::texts::Texts;
use crate::assign::Candidate;
use crate::element::{Element, Marker, MeantMarker, Shape};
use crate::faults::DrawingFaults;
use crate::geometry::Curve;
use crate::line_type::LineTypes;
use crate::names::PathName;
use crate::raw::{DrawnElements, Language, Position, RawPath, SourceMap};
use crate::text::ParameterTexts;

/// A path whose entities are being collected.
pub(crate) struct PathCollector<'d> {
    pub(crate) name: PathName,
    pub(crate) start: Option<Marker>,
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
    pub(super) faults: DrawingFaults,
    /// Circles without a meaning.
    pub(super) unclear: Vec<UnclearCircle>,
    /// Problems shared by several elements: their index among the diagnostics, and the number of elements.
    pub(super) shared: Vec<SharedProblem>,
    pub(super) has_elements: bool,
}

/// A circle without a meaning because of its line type or diameter.
pub(crate) struct UnclearCircle {
    pub(super) marker: Marker,
    pub(super) shape: Shape,
    /// The marker that it was probably meant to be.
    pub(super) meant: MeantMarker,
}

/// A problem that is reported once for all elements of a path that have it.
pub(super) struct SharedProblem {
    pub(super) line_type: SmolStr,
    pub(super) message: &'static Message,
    index: usize,
    count: usize,
}

/// The owner of a text that belongs to a candidate.
#[derive(Clone, Copy)]
pub(crate) enum Owner {
    Start,
    Probe(usize),
    /// An element of the path, by its index.
    Element(usize),
    /// An element with errors of its own.
    Faulty,
}

/// The paths of a drawing in order of first appearance, before their texts are assigned.
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
            let position = Position { line: origin.line, handle: origin.handle };
            paths[path].add(entity, layer, position, &mut line_types);
        }
    }
    for fault in &drawing.faults {
        if let Some(Membership { path, .. }) = layers.membership(fault.layer) {
            paths[path].add_fault(&fault.diagnostic);
        }
    }
    for left_out in &drawing.left_out {
        if let Some(Membership { path, .. }) = layers.membership(left_out.layer) {
            paths[path].left_out.push((left_out.kind, left_out.point));
            paths[path].add_located(&left_out.diagnostic);
        }
    }
    paths
}

impl PathCollector<'_> {
    /// Creates a path with these layers.
    fn new(drawing: &Drawing, layers: &[FoundLayer]) -> Self {
        let mut path = Self {
            name: layers[0].path.clone(),
            start: None,
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
            faults: DrawingFaults::default(),
            unclear: Vec::new(),
            shared: Vec::new(),
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

    /// Whether there is anything but texts: layers with texts alone form no path.
    pub(crate) fn has_elements(&self) -> bool {
        self.has_elements
    }

    /// The findings about a group of layers with texts only.
    pub(crate) fn orphans(mut self) -> Vec<Diagnostic> {
        take(&mut self.texts).assign(&mut self, 0.0);
        let mut diagnostics = take(&mut self.diagnostics);
        for diagnostic in &mut diagnostics {
            self.map.locate(diagnostic);
            diagnostic.place.element = None;
        }
        diagnostics
    }

    /// Assigns each text to its element.
    pub(crate) fn assign_texts(&mut self, language: &Language) {
        self.settle_shared();
        let mut texts = take(&mut self.texts);
        self.settle_markers(&mut texts);
        let before = self.diagnostics.len();
        texts.assign(self, language.doubts.text_margin);
        self.texts = texts;
        // The text may belong to a broken entity.
        if self.faults.has_broken_entity {
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
            drawn: Arc::new(drawn),
            parameters: None,
            borrowed_from: None,
            definitions: Vec::new(),
            left_out: self.left_out,
            faults: self.faults,
            diagnostics: self.diagnostics,
        };
        raw.faults.other_ends.extend(ends.map(|end| end.at));
        let mut checked = PathCheck { raw: &mut raw };
        checked.check_leftovers();
        if !self.has_broken_circle {
            checked.check_markers();
        }
        checked.check_parameters(starts);
        (raw, self.map)
    }

    /// Reports a problem at the first element that has it, and counts the others.
    pub(super) fn report_shared(&mut self, line_type: &str, diagnostic: Diagnostic) {
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
    fn settle_shared(&mut self) {
        for shared in take(&mut self.shared) {
            self.diagnostics[shared.index].arguments.push(("count", shared.count.into()));
        }
    }

    /// Adds to PB107 the first entity that was left out: a text on it finds nothing.
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
        let name = self.name.as_str();
        let is_placed = diagnostic.path.is_some();
        self.diagnostics.push(if is_placed { diagnostic } else { diagnostic.in_path(name) });
    }

    pub(super) fn next_id(&mut self, position: Position) -> ElementId {
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
        self.faults.has_broken_entity = true;
        self.has_broken_circle |=
            matches!(diagnostic.place.entity, Some(EntityKind::Circle | EntityKind::Other) | None);
        self.add_located(diagnostic);
    }
}

/// The name of an element that takes texts, for messages.
pub(crate) fn candidate_word(candidate: &Candidate) -> &'static pathbuild_diagnostic::Text {
    match candidate.owner {
        Owner::Start => &words::PATH_START,
        Owner::Probe(_) => &words::PROBE,
        Owner::Element(_) | Owner::Faulty => candidate.shape.word(),
    }
}
