//! Raw paths: the elements on a path's layers with their texts, before variables are bound. (book: reference/dxf)

use std::sync::Arc;

use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Code, Diagnostic, EntityKind, Point};
pub use pathbuild_dxf::Origin as Position;
use smol_str::SmolStr;

use crate::element::{Element, Marker, Origin};
use crate::geometry::Xy;
use crate::letter::{Letter, Letters};
use crate::names::{CaseSensitiveName, PathName};
use crate::text::{ParameterText, ParameterTexts, TextId, ValueKind};
use crate::variables::{Bindings, Definition};

/// A path as drawn. The line numbers and handles of its elements in the file are in the [`SourceMap`].
#[derive(Clone, Debug, PartialEq)]
pub struct RawPath {
    /// Name of the path, in the spelling of its first layer in the file.
    pub name: CaseSensitiveName,
    /// The start marker. Its text is the path's own, even if @ refers to the text of another path.
    pub start: Option<Marker>,
    /// The end marker; `None` if it is missing.
    pub end: Option<Marker>,
    /// Turn markers, in file order.
    pub turns: Vec<Marker>,
    /// Z-probes, in file order.
    pub probes: Vec<Marker>,
    /// The path's elements with their texts.
    pub drawn: Arc<DrawnElements>,
    /// The text with the parameters of the whole path: that of its start marker, or a copy of that of the path named by @.
    pub(crate) parameters: Option<TextId>,
    /// The path named by @, and its start marker, which has the parameters.
    pub(crate) borrowed_from: Option<Box<(PathName, Origin)>>,
    pub(crate) uncertainty: DrawingUncertainty,
    /// The definitions of the path's variables, in the order written.
    pub definitions: Vec<Definition>,
    /// Curves on the path's layers that do not belong to it, with their start points if known.
    pub left_out: Vec<(EntityKind, Option<Point>)>,
    /// Findings about the drawing alone. A path with an error gives no program.
    pub diagnostics: Vec<Diagnostic>,
}

/// The elements on a path's layers. Shared between stages, which refer to elements and texts by number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawnElements {
    /// All circles, then all lines, then all arcs, each in file order. (book: language/chains-and-passes)
    pub elements: Vec<Element>,
    /// The parameter texts, to which elements and markers refer by number.
    pub texts: ParameterTexts,
    /// The path's layers in file order; at least one.
    pub layers: Vec<SmolStr>,
}

/// The positions of a path's elements in the file, by [`ElementId`](pathbuild_diagnostic::ElementId).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SourceMap(pub(crate) Vec<Position>);

/// All paths of a drawing, in order of first appearance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RawFile {
    /// The paths, each with the positions of its elements in the file.
    pub paths: Vec<(RawPath, SourceMap)>,
    /// Findings about the file that belong to none of its paths.
    pub diagnostics: Vec<Diagnostic>,
}

impl RawPath {
    /// Whether the drawing itself has no errors.
    pub fn is_sound(&self) -> bool {
        !self.diagnostics.iter().any(Diagnostic::is_error)
    }

    /// Returns the findings about the drawing, except for letters without effect (PB210) about which there is also a finding in `problems`: a value
    /// outside its limits (PB203), or another reason why the letter has no effect. It is a single mistake of the user.
    pub fn findings_except(&self, problems: &[Diagnostic]) -> Vec<Diagnostic> {
        let is_same = |found: &Diagnostic, problem: &Diagnostic| {
            matches!(problem.code(), Code::ParameterOutOfRange | Code::ParameterWithoutEffect)
                && (&problem.text, &problem.place) == (&found.text, &found.place)
        };
        let is_repeated = |found: &Diagnostic| {
            found.code() == Code::ParameterWithoutEffect
                && problems.iter().any(|problem| is_same(found, problem))
        };
        self.diagnostics.iter().filter(|found| !is_repeated(found)).cloned().collect()
    }

    /// Returns the name of the path's first layer in the file.
    pub fn layer(&self) -> &str {
        &self.drawn.layers[0]
    }

    /// The path's own parameters: the text of its start, or that of the path named by @. Empty if there is none.
    pub fn parameters(&self) -> ParameterText<'_> {
        self.drawn.text(self.parameters).unwrap_or_default()
    }

    /// Whether the text of an element is probably the path's own, which is missing from the start. A text that embeds a path
    /// may have O and T as well.
    pub(crate) fn may_be_start_text(&self, text: ParameterText<'_>) -> bool {
        let has = |letter| text.letters.contains(letter);
        self.parameters.is_none() && has(Letter::O) && has(Letter::T) && !has(Letter::Embed)
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

    /// Returns PB302 for each variable without a value, since a path with variables cannot be emitted on its own.
    pub fn missing_values(&self, bindings: &Bindings) -> Vec<Diagnostic> {
        let missing = self.definitions.iter().filter(|definition| bindings.get(definition.name).is_none());
        let report = |definition: &Definition| {
            let problem = Diagnostic::new(&messages::MISSING_VALUE)
                .with("variable", definition.name)
                .quoting("definition", definition.to_string());
            let piece = self.parameters().pieces().iter().find(|piece| {
                piece.letter == Some(Letter::Variable)
                    && self.parameters().value(piece).starts_with(definition.name)
            });
            let problem = match piece {
                Some(piece) => problem.with_text(self.parameters().fault(piece)),
                None => problem,
            };
            self.at_parameters(problem)
        };
        missing.map(report).collect()
    }

    /// Lines and arcs of line types without a meaning.
    pub fn unclear_curves(&self) -> &[Element] {
        &self.uncertainty.unclear_curves
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
    /// Returns the text with this number; `None` if there is no number.
    pub fn text(&self, text: Option<TextId>) -> Option<ParameterText<'_>> {
        self.texts.get(text?)
    }

    /// Returns the location of an element.
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

/// Properties of a path that errors in its drawing leave unknown.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct DrawingUncertainty {
    /// Letters in texts without an element: any element may lack them for that reason.
    pub(crate) stray_letters: Letters,
    /// Whether there is an unreadable entity, which may be anything.
    pub(crate) has_broken_entity: bool,
    /// Whether there are two starts, either of which may have the path's text.
    pub(crate) has_second_start: bool,
    /// End markers after the first.
    pub(crate) other_ends: Vec<Xy>,
    /// Circles without a meaning: the walk may turn or end there.
    pub(crate) unclear_circles: Vec<Xy>,
    /// Whether the lengths are probably in another unit, so that they cannot be compared with those of texts.
    pub(crate) is_in_other_unit: bool,
    /// Lines and arcs of unknown line types: the path runs along them in an unknown way.
    pub(crate) unclear_curves: Vec<Element>,
    /// Variables with an erroneous definition.
    pub(crate) variables: Vec<char>,
    /// A text with O and T that does not belong to the start marker, and its position.
    pub(crate) path_text: Option<(SmolStr, Xy)>,
}

/// How certain the walk along a path with errors is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WalkCertainty {
    Known,
    /// A text that is not read may give N to a segment, which then comes earlier where several segments meet.
    MayHideOrder,
    /// The start, the order or a segment is unknown, so that the walk cannot be checked.
    Unknown,
}

/// Properties of a path that errors leave unknown, after its variables are bound.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PathUncertainty {
    pub(crate) letters: Letters,
    /// Whether an error may hide I of a segment.
    pub(crate) is_infeed_unknown: bool,
    /// Whether all cuts are known nevertheless: the only errors are texts without an element, none of which may belong to a cut.
    pub(crate) are_cuts_known: bool,
    pub(crate) walk: WalkCertainty,
    /// Possible ends of the path; empty if the end is unknown.
    pub(crate) ends: Vec<Xy>,
    /// See [`DrawingUncertainty::unclear_circles`].
    pub(crate) unclear_circles: Vec<Xy>,
}
