//! Raw paths: what is drawn on a path's layers, with the texts found, whatever the variables are. (book: reference/dxf)

use std::sync::Arc;

use pathbuild_diagnostic::{Diagnostic, EntityKind, Handle, Point};
use smol_str::SmolStr;

use crate::definition::Definition;
use crate::doubts::Doubts;
use crate::element::{Element, Marker, Origin};
use crate::faults::DrawingFaults;
use crate::keep_out::KeepOutPattern;
use crate::letter::Letter;
use crate::line_type::LineTypeAliases;
use crate::name::{PathName, PathPattern, SpeltName};
use crate::text::{ParameterText, ParameterTexts, TextId, Written};

/// A path as it is drawn. It knows no lines and handles of the file: see [`SourceMap`].
#[derive(Clone, Debug, PartialEq)]
pub struct RawPath {
    /// Its name, as its first layer in the file spells it.
    pub name: SpeltName,
    /// The start marker. Its text is that of the path itself, also where @ refers to another's.
    pub start: Option<Marker>,
    /// The end marker.
    pub end: Option<Marker>,
    /// Turn markers, in file order.
    pub turns: Vec<Marker>,
    /// Z-probes, in file order.
    pub probes: Vec<Marker>,
    /// Its elements and texts.
    pub drawn: Arc<Drawn>,
    /// The path's own parameters among the texts: its start's, or a copy of those of the path that @ names.
    pub(crate) parameters: Option<TextId>,
    /// The path that @ names, and its start marker, where the parameters stand.
    pub(crate) borrowed_from: Option<Box<(PathName, Origin)>>,
    /// What its faults leave unknown.
    pub(crate) faults: DrawingFaults,
    /// The variables that it defines, in the order written.
    pub definitions: Vec<Definition>,
    /// Curves on its layers that are no part of it, with where they begin, if that is known.
    pub left_out: Vec<(EntityKind, Option<Point>)>,
    /// What is wrong with the drawing alone. When one is an error the path goes no further.
    pub diagnostics: Vec<Diagnostic>,
}

/// What is drawn on a path's layers. Shared by the stages, which know elements and texts by number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawn {
    /// All circles, then all lines, then all arcs, each in file order. (book: language/chains-and-passes)
    pub elements: Vec<Element>,
    /// The texts that elements have.
    pub texts: ParameterTexts,
    /// The path's layers, in the order in which they appear in the file; at least one.
    pub layers: Vec<SmolStr>,
}

/// Where the elements of a path are in the file: by [`ElementId`](pathbuild_diagnostic::ElementId).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SourceMap(pub(crate) Vec<Position>);

/// Line and handle of an entity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Position {
    pub line: u32,
    pub handle: Option<Handle>,
}

/// What the language needs to know of the configuration to read a drawing.
#[derive(Clone, Debug)]
pub struct Language {
    /// Which layers are path layers.
    pub path_pattern: PathPattern,
    /// Which layers hold clamps, where somebody says so.
    pub keep_out: Option<KeepOutPattern>,
    /// Names of line types.
    pub line_types: LineTypeAliases,
    /// How far apart ends may be, in mm, that the walk joins with a warning (PB115); 0: only ends that coincide meet.
    pub join_tolerance: f64,
    /// Longest value that variables may make, in bytes.
    pub text_limit: usize,
    /// From where on something is doubtful.
    pub doubts: Doubts,
}

/// All paths of a drawing, in order of first appearance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RawFile {
    /// The paths.
    pub paths: Vec<(RawPath, SourceMap)>,
    /// What belongs to the file and to none of its paths.
    pub diagnostics: Vec<Diagnostic>,
}

impl Language {
    /// Whether a layer holds clamps.
    pub fn is_keep_out(&self, layer: &str) -> bool {
        self.keep_out.as_ref().is_some_and(|pattern| pattern.is_layer(layer))
    }
}

impl RawPath {
    /// Whether the drawing alone is in order.
    pub fn is_sound(&self) -> bool {
        !self.diagnostics.iter().any(Diagnostic::is_error)
    }

    /// The first of its layers.
    pub fn layer(&self) -> &str {
        &self.drawn.layers[0]
    }

    /// The path's own parameters: its start's text, or that of the path that @ names. Empty where there is none.
    pub fn parameters(&self) -> ParameterText<'_> {
        self.drawn.text(self.parameters).unwrap_or_default()
    }

    /// Whether a text of an element is probably the path's own, which its start lacks: nothing is wrong with its letters.
    pub(crate) fn may_be_of_path(&self, text: ParameterText<'_>) -> bool {
        self.parameters.is_none() && text.letters.contains(Letter::O) && text.letters.contains(Letter::T)
    }

    /// A diagnostic about the path's own parameters. Those that @ borrows are reported with the path they belong to, so that what is wrong
    /// with them is said once.
    pub(crate) fn at_parameters(&self, diagnostic: Diagnostic) -> Diagnostic {
        match (&self.borrowed_from, &self.start) {
            (Some(lender), _) => lender.1.at(diagnostic).in_path(lender.0.as_str()),
            (None, Some(start)) => start.origin.at(diagnostic).in_path(self.name.as_str()),
            (None, None) => diagnostic,
        }
    }

    /// The cutter's diameter: the literal O, when it is a number that can be one.
    pub fn tool(&self) -> Option<f64> {
        let parameters = self.parameters();
        match parameters.piece(Letter::O)?.written {
            Written::Number(number) if number > 0.0 && !parameters.repeats(Letter::O) => Some(number),
            _ => None,
        }
    }
}

impl Drawn {
    /// A text, where there is one.
    pub fn text(&self, text: Option<TextId>) -> Option<ParameterText<'_>> {
        self.texts.get(text?)
    }

    /// Where an element is drawn.
    pub fn origin(&self, element: &Element) -> Origin {
        Origin::new(element.source, &self.layers[element.source.layer as usize], element.shape.point())
    }
}

impl SourceMap {
    pub(crate) fn push(&mut self, position: Position) {
        self.0.push(position);
    }

    /// Fills in the line and handle of a diagnostic whose element is in this map.
    pub fn locate(&self, diagnostic: &mut Diagnostic) {
        let element = diagnostic.place.element.and_then(|id| self.0.get(id.0 as usize));
        if let Some(position) = element {
            diagnostic.locate(position.line, position.handle);
        }
    }

    /// The position of each element.
    pub fn positions(&self) -> &[Position] {
        &self.0
    }
}
