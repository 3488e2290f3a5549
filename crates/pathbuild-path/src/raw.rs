//! Raw paths: the elements on a path's layers with their texts, before variables are bound. (book: reference/dxf)

use std::sync::Arc;

use pathbuild_diagnostic::{Diagnostic, EntityKind, Handle, Point};
use smol_str::SmolStr;

use crate::definition::Definition;
use crate::doubts::DoubtThresholds;
use crate::element::{Element, Marker, Origin};
use crate::faults::DrawingFaults;
use crate::keep_out::KeepOutPattern;
use crate::letter::Letter;
use crate::line_type::LineTypeAliases;
use crate::names::{PathName, PathPattern, SpeltName};
use crate::text::{ParameterText, ParameterTexts, TextId, ValueKind};

/// A path as drawn. It contains no lines and handles of the file, see [`SourceMap`].
#[derive(Clone, Debug, PartialEq)]
pub struct RawPath {
    /// Its name as spelt by its first layer in the file.
    pub name: SpeltName,
    /// The start marker. Its text is the path's own, even if @ refers to the text of another path.
    pub start: Option<Marker>,
    /// The end marker.
    pub end: Option<Marker>,
    /// Turn markers, in file order.
    pub turns: Vec<Marker>,
    /// Z-probes, in file order.
    pub probes: Vec<Marker>,
    /// Its elements with their texts.
    pub drawn: Arc<DrawnElements>,
    /// The path's own parameters among the texts: the text of its start, or a copy of that of the path named by @.
    pub(crate) parameters: Option<TextId>,
    /// The path named by @, and its start marker, which has the parameters.
    pub(crate) borrowed_from: Option<Box<(PathName, Origin)>>,
    /// What errors leave unknown.
    pub(crate) faults: DrawingFaults,
    /// Its variables in the order written.
    pub definitions: Vec<Definition>,
    /// Curves on its layers that do not belong to it, with their start points if known.
    pub left_out: Vec<(EntityKind, Option<Point>)>,
    /// Findings about the drawing alone. An error ends the compilation of the path.
    pub diagnostics: Vec<Diagnostic>,
}

/// The elements on a path's layers. Shared between stages, which refer to elements and texts by number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawnElements {
    /// All circles, then all lines, then all arcs, each in file order. (book: language/chains-and-passes)
    pub elements: Vec<Element>,
    /// The texts of elements.
    pub texts: ParameterTexts,
    /// The path's layers in file order; at least one.
    pub layers: Vec<SmolStr>,
}

/// The positions of a path's elements in the file, by [`ElementId`](pathbuild_diagnostic::ElementId).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SourceMap(pub(crate) Vec<Position>);

/// The line and handle of an entity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Position {
    pub line: u32,
    pub handle: Option<Handle>,
}

/// Settings of the drawing language.
#[derive(Clone, Debug)]
pub struct Language {
    /// The names of path layers.
    pub path_pattern: PathPattern,
    /// The names of layers with clamps, if configured.
    pub keep_out: Option<KeepOutPattern>,
    /// Additional names of line types.
    pub line_types: LineTypeAliases,
    /// Largest gap in mm that the walk closes with a warning (PB115); 0 requires ends to coincide.
    pub join_tolerance: f64,
    /// Maximum length in bytes of a value with variables substituted.
    pub text_limit: usize,
    /// Thresholds beyond which something is doubtful.
    pub doubts: DoubtThresholds,
}

/// All paths of a drawing, in order of first appearance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RawFile {
    /// The paths.
    pub paths: Vec<(RawPath, SourceMap)>,
    /// Findings about the file that belong to none of its paths.
    pub diagnostics: Vec<Diagnostic>,
}

impl Language {
    /// Whether a layer holds clamps.
    pub fn is_keep_out(&self, layer: &str) -> bool {
        self.keep_out.as_ref().is_some_and(|pattern| pattern.is_layer(layer))
    }
}

impl RawPath {
    /// Whether the drawing itself has no errors.
    pub fn is_sound(&self) -> bool {
        !self.diagnostics.iter().any(Diagnostic::is_error)
    }

    /// Its first layer.
    pub fn layer(&self) -> &str {
        &self.drawn.layers[0]
    }

    /// The path's own parameters: the text of its start, or that of the path named by @. Empty if there is none.
    pub fn parameters(&self) -> ParameterText<'_> {
        self.drawn.text(self.parameters).unwrap_or_default()
    }

    /// Whether the text of an element is probably the path's own, which is missing from the start.
    pub(crate) fn may_be_of_path(&self, text: ParameterText<'_>) -> bool {
        self.parameters.is_none() && text.letters.contains(Letter::O) && text.letters.contains(Letter::T)
    }

    /// Places a diagnostic about the path's own parameters. Those borrowed by @ are reported with the lending path, so that each problem is
    /// reported only once.
    pub(crate) fn at_parameters(&self, diagnostic: Diagnostic) -> Diagnostic {
        match (&self.borrowed_from, &self.start) {
            (Some(lender), _) => lender.1.at(diagnostic).in_path(lender.0.as_str()),
            (None, Some(start)) => start.origin.at(diagnostic).in_path(self.name.as_str()),
            (None, None) => diagnostic,
        }
    }

    /// The cutter's diameter: O, if it is a literal and valid number.
    pub fn tool(&self) -> Option<f64> {
        let parameters = self.parameters();
        match parameters.piece(Letter::O)?.written {
            ValueKind::Number(number) if number > 0.0 && !parameters.repeats(Letter::O) => Some(number),
            _ => None,
        }
    }
}

impl DrawnElements {
    /// A text, if there is one.
    pub fn text(&self, text: Option<TextId>) -> Option<ParameterText<'_>> {
        self.texts.get(text?)
    }

    /// The location of an element.
    pub fn origin(&self, element: &Element) -> Origin {
        Origin::new(element.source, &self.layers[element.source.layer as usize], element.shape.point())
    }
}

impl SourceMap {
    pub(crate) fn push(&mut self, position: Position) {
        self.0.push(position);
    }

    /// Fills in the line and handle of a diagnostic about an element of this map.
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
