//! Checks the parameters of a path and its elements as far as possible before variables are bound: letters, @, definitions.

use std::collections::{BTreeMap, HashSet};
use std::sync::Arc;

use pathbuild_diagnostic::messages::drawing::BARS_ON_HOLE;
use pathbuild_diagnostic::messages::parameters::LISTED_TWICE;
use pathbuild_diagnostic::messages::{drawing, parameters};
use pathbuild_diagnostic::{Diagnostic, EntityKind, Number, Point, Value};
use smol_str::SmolStr;

use crate::approx::coincide;
use crate::element::{Cut, Element, Origin, Role, Shape, diagnostic_point};
use crate::geometry::{Curve, Xy};
use crate::letter::{ElementClass, Letter, Letters};
use crate::names::PathName;
use crate::raw::RawPath;
use crate::read::likely_parameters::looks_like_parameters;
use crate::text::{LetterValue, ParameterText, definition_in_pieces};
use crate::variables::Definition;

/// The start texts of all paths, for references by @; empty if there are no references.
pub(super) type Starts = BTreeMap<PathName, Start>;

/// The text of a path's start marker, to which @ may refer.
pub(super) struct Start {
    pub(super) text: Box<str>,
    /// Whether the start's text itself refers to another path.
    pub(super) borrows: bool,
    pub(super) origin: Origin,
}

/// A text with O and T that does not belong to the start marker.
pub(super) struct StartText {
    pub(super) string: SmolStr,
    pub(super) anchor: Xy,
    /// The centre of the text's circle, which decides to which element it belongs.
    pub(super) middle: Xy,
}

/// Hints about where the text of a path's start was drawn, if not on its start marker.
#[derive(Default)]
pub(super) struct StartHints {
    /// A text with O and T that does not belong to the start marker.
    pub(super) text: Option<StartText>,
    /// Position of an end marker with a text that gives O and T, if the start marker of the path has no such text.
    pub(super) swapped: Option<Point>,
    /// Position of a circle like a start marker, but without its text, in a path that has a start and no end.
    pub(super) meant_as_end: Option<Point>,
}

impl StartText {
    /// Returns the arguments of a note about the text, with one of its points.
    fn arguments(&self, point: Xy) -> Vec<(&'static str, Value)> {
        let text = Value::quoted(self.string.replace('\n', " "));
        vec![("text", text), ("point", diagnostic_point(point).into())]
    }
}

impl PathCheck<'_> {
    pub(super) fn check_parameters(&mut self, starts: &Starts) {
        let Some(start) = &self.raw.start else { return self.check_elements(None) };
        let Some(text) = self.raw.drawn.text(start.text) else {
            let problem = start.origin.at(Diagnostic::new(&parameters::NO_PATH_PARAMETERS));
            let problem = self.with_start_text(problem);
            if !self.raw.uncertainty.has_broken_entity {
                self.report(problem);
            }
            return self.check_elements(None);
        };
        self.raw.parameters = start.text;
        if let Some(piece) = text.piece(Letter::At) {
            match lender_named_by(text, piece, starts) {
                Ok((name, lender)) => self.borrow_parameters(name, lender),
                Err(problem) => {
                    let problem = start.origin.at(problem.with_text(text.fault(piece)));
                    self.raw.parameters = None;
                    self.report(problem);
                    return self.check_elements(None);
                }
            }
        }
        for problem in self.raw.parameters().problems(ElementClass::PathStart) {
            self.report(self.raw.at_parameters(problem));
        }
        self.define_variables();
        if starts.is_empty() {
            self.check_uses();
            self.check_letters_of_cuts();
        }
        self.check_elements(self.raw.tool());
    }

    /// Adds to PB207 the place where the path's text probably is.
    fn with_start_text(&self, problem: Diagnostic) -> Diagnostic {
        match &self.hints {
            StartHints { swapped: Some(end), .. } => {
                problem.note(&drawing::SWAPPED_MARKERS, vec![("point", (*end).into())])
            }
            StartHints { text: Some(text), .. } => {
                problem.note(&drawing::START_TEXT_ELSEWHERE, text.arguments(text.middle))
            }
            StartHints { .. } => problem,
        }
    }

    fn borrow_parameters(&mut self, name: &PathName, lender: &Start) {
        self.raw.parameters = Some(Arc::make_mut(&mut self.raw.drawn).texts.push(&lender.text));
        self.raw.borrowed_from = Some(Box::new((name.clone(), lender.origin.clone())));
    }

    fn check_elements(&mut self, tool: Option<f64>) {
        let drawn = Arc::clone(&self.raw.drawn);
        for element in &drawn.elements {
            let class = element.class(tool);
            if element.role == Role::Cut(Cut::Support) && class == ElementClass::DrilledHole {
                self.report(drawn.origin(element).at(Diagnostic::new(&BARS_ON_HOLE)));
            }
        }
        let mut seen = HashSet::new();
        for element in &drawn.elements {
            let Some(text) = element.text else { continue };
            // The parts of a polyline share a text, which is checked once.
            if !seen.insert(text) {
                continue;
            }
            let text = drawn.texts.get(text).filter(|text| !self.raw.may_be_start_text(*text));
            if let Some(text) =
                text.filter(|text| element.role == Role::SkippedSubpath && looks_like_parameters(*text))
            {
                let problem = Diagnostic::new(&parameters::PARAMETERS_ON_DOT)
                    .quoting("text", text.as_str().replace('\n', " "))
                    .with_text(text.whole_text_fault());
                self.report(drawn.origin(element).at(problem));
            }
            let problems = text.map(|text| text.problems(element.class(tool)));
            for problem in problems.into_iter().flatten() {
                self.report(drawn.origin(element).at(problem));
            }
        }
        let problems = self.raw.probes.iter().flat_map(|probe| {
            let problems = drawn.text(probe.text).map(|text| text.problems(ElementClass::Probe));
            problems.into_iter().flatten().map(|problem| probe.origin.at(problem))
        });
        self.report_all(problems.collect());
    }

    fn define_variables(&mut self) {
        let parameters = self.raw.parameters();
        if !parameters.letters.contains(Letter::Variable) {
            return;
        }
        let pieces = parameters.pieces().iter().filter(|piece| piece.letter == Some(Letter::Variable));
        let (mut definitions, mut problems, mut faulty) = (Vec::new(), Vec::new(), Vec::new());
        for piece in pieces {
            match Definition::parse(parameters.value(piece)) {
                Ok(definition) => {
                    if let Some(value) = definition.repeated_value() {
                        let problem = Diagnostic::new(&LISTED_TWICE).quoting("value", value);
                        let problem = problem.with("variable", definition.name);
                        problems.push(self.raw.at_parameters(problem.with_text(parameters.fault(piece))));
                    }
                    definitions.push(definition);
                }
                Err(problem) => {
                    faulty.extend(parameters.value(piece).chars().next());
                    // The spaces in the definition are reported separately.
                    if definition_in_pieces(parameters, piece).is_some() {
                        continue;
                    }
                    problems.push(self.raw.at_parameters(problem.with_text(parameters.fault(piece))));
                }
            }
        }
        self.raw.definitions = definitions;
        self.raw.uncertainty.variables = faulty;
        self.report_all(problems);
    }
}

impl PathCheck<'_> {
    /// Reports PB210 for each variable that no text of the path refers to. Nothing is reported if errors may hide a reference. Not called for
    /// drawings whose paths borrow texts from each other, since the variable may be meant for one of them.
    fn check_uses(&mut self) {
        let uncertainty = &self.raw.uncertainty;
        let may_be_hidden = uncertainty.has_broken_entity || uncertainty.stray_letters != Letters::default();
        if self.raw.definitions.is_empty() || may_be_hidden {
            return;
        }
        let texts = self.raw.drawn.texts.iter();
        let after_signs = texts.flat_map(|text| text.as_str().split('=').skip(1));
        let used: HashSet<char> = after_signs.filter_map(|after| after.chars().next()).collect();
        let is_defined = |name: &char| self.raw.definitions.iter().any(|definition| definition.name == *name);
        // A reference to a variable that does not exist (PB303) was meant for one that does.
        if !used.iter().all(is_defined) {
            return;
        }
        let parameters = self.raw.parameters();
        let unused = parameters.pieces().iter().filter_map(|piece| {
            let name = parameters.value(piece).chars().next()?;
            let is_unused =
                piece.letter == Some(Letter::Variable) && !used.contains(&name) && is_defined(&name);
            let problem = Diagnostic::new(&parameters::UNUSED_VARIABLE).with("variable", name);
            is_unused.then(|| self.raw.at_parameters(problem.with_text(parameters.fault(piece))))
        });
        self.report_all(unused.collect());
    }
}

impl PathCheck<'_> {
    /// Reports PB210 for letters of the path's start that none of its elements uses: W without a chain, and everything about cutting in a path that
    /// only embeds others. Not called for drawings whose paths borrow texts from each other.
    fn check_letters_of_cuts(&mut self) {
        let drawn = Arc::clone(&self.raw.drawn);
        let uncertainty = &self.raw.uncertainty;
        let is_cut_hidden = uncertainty.has_broken_entity
            || !uncertainty.unclear_curves.is_empty()
            || !uncertainty.unclear_circles.is_empty();
        let has_cut = drawn.elements.iter().any(|element| matches!(element.role, Role::Cut(_)));
        let names_path = |subpath: &Element| {
            drawn.text(subpath.text).is_some_and(|text| text.letters.contains(Letter::Embed))
        };
        let mut subpaths = drawn.elements.iter().filter(|element| element.role == Role::Subpath).peekable();
        let only_embeds = !has_cut && !is_cut_hidden && subpaths.peek().is_some() && subpaths.all(names_path);
        let is_chain =
            |element: &Element| matches!((element.role, element.shape), (Role::Cut(_), Shape::Curve(_)));
        let probe = (!self.raw.probes.is_empty()).then_some(ElementClass::Probe);
        let is_used = |letter: Letter| {
            let mut classes = [ElementClass::Sweep, ElementClass::Subpath].into_iter().chain(probe);
            // F of the path also serves as Z of its Z-probes.
            letter == Letter::F && probe.is_some() || classes.any(|class| class.takes(letter))
        };
        let is_unused = |letter: &Letter| letter.is_inherited() && !is_used(*letter);
        let (letters, message): (Letters, _) = if only_embeds {
            (Letter::all().filter(is_unused).collect(), &parameters::WITHOUT_EFFECT_ON_EMBEDDED)
        } else if !drawn.elements.iter().any(is_chain) {
            (Letters::of(&[Letter::W]), &parameters::FIRST_DEPTH_WITHOUT_CHAIN)
        } else {
            return;
        };
        let unused = letters.iter().filter_map(|letter| {
            let fault = self.raw.parameters().fault_of(letter)?;
            let problem = Diagnostic::new(message).with("letter", letter.as_char()).with_text(Some(fault));
            Some(self.raw.at_parameters(problem))
        });
        self.report_all(unused.collect());
    }
}

/// Returns the path named by @, with its start.
///
/// # Errors
/// If there are other letters beside @, if no start has that name, or if that start borrows its parameters itself; without a place.
fn lender_named_by<'s>(
    text: ParameterText<'_>,
    piece: &LetterValue,
    starts: &'s Starts,
) -> Result<(&'s PathName, &'s Start), Box<Diagnostic>> {
    if text.pieces().len() > 1 {
        return Err(Box::new(Diagnostic::new(&parameters::AT_WITH_OTHERS)));
    }
    let name = PathName::new(text.value(piece));
    let Some((name, start)) = starts.get_key_value(&name) else {
        let lenders = starts.iter().filter(|(_, start)| !start.borrows);
        let known: Vec<&str> = lenders.map(|(name, _)| name.as_str()).collect();
        let problem = match known.as_slice() {
            [] => Diagnostic::new(&parameters::AT_WITHOUT_LENDER),
            known => Diagnostic::new(&parameters::AT_UNKNOWN).with("known", known.iter().collect::<Value>()),
        };
        return Err(Box::new(problem.quoting("name", name.as_str())));
    };
    if start.borrows {
        return Err(Box::new(Diagnostic::new(&parameters::AT_CHAINED).quoting("name", name.as_str())));
    }
    Ok((name, start))
}

/// Length in mm below which a line is not a move, and distance below which circles coincide: programs have three decimals.
const MIN_MOVE_LENGTH: f64 = 0.0005;

/// Length in mm below which a milled line or arc is taken for a remnant of trimming. Cutters are 0.1 mm wide or more, and machines place
/// them no more accurately than this.
const MIN_CUT_LENGTH: f64 = 0.01;

/// Checks a raw path, and adds its findings to it.
pub(super) struct PathCheck<'r> {
    pub(super) raw: &'r mut RawPath,
    pub(super) hints: StartHints,
}

impl PathCheck<'_> {
    pub(super) fn report(&mut self, diagnostic: Diagnostic) {
        self.raw.diagnostics.push(diagnostic.or_in_path(self.raw.name.as_str()));
    }

    fn report_all(&mut self, diagnostics: Vec<Diagnostic>) {
        for diagnostic in diagnostics {
            self.report(diagnostic);
        }
    }

    /// Reports PB121 for lines without length, milled lines and arcs of almost no length, and circles that lie on others of their kind.
    pub(super) fn check_leftovers(&mut self) {
        let drawn = &self.raw.drawn;
        let at = |element: &Element, problem: Diagnostic| drawn.origin(element).at(problem);
        let mut found = Vec::new();
        for element in &drawn.elements {
            let Shape::Curve(curve) = element.shape else { continue };
            let (length, is_line) = (curve.length(), matches!(curve, Curve::Line(_)));
            // The parts of a polyline have the same text and depth.
            let is_single = matches!(element.source.entity, EntityKind::Line | EntityKind::Arc);
            let problem = match element.role {
                Role::Cut(_) if is_line && length < MIN_MOVE_LENGTH => {
                    Diagnostic::new(&drawing::CUT_WITHOUT_LENGTH)
                }
                Role::Cut(_) if length < MIN_CUT_LENGTH && is_single => {
                    Diagnostic::new(&drawing::CUT_HARDLY_LONG)
                        .with("element", element.shape.word())
                        .with("length", length)
                }
                // A sweep that is merely short still connects two ends.
                Role::Sweep | Role::SilentSweep if is_line && coincide(curve.start(), curve.end()) => {
                    Diagnostic::new(&drawing::SWEEP_WITHOUT_LENGTH)
                }
                _ => continue,
            };
            found.push(at(element, problem));
        }
        let circles = drawn.elements.iter().enumerate();
        let mut circles: Vec<(usize, Xy, f64)> = circles
            .filter_map(|(index, element)| Some((index, element.shape.point(), element.shape.radius()?)))
            .collect();
        circles.sort_by_cached_key(|(index, centre, radius)| {
            ([centre.x, centre.y, *radius].map(|length| Number((length / MIN_MOVE_LENGTH).round())), *index)
        });
        for pair in circles.windows(2) {
            let [(first, centre, radius), (second, other, other_radius)] = *pair else { continue };
            let [first, second] = [first, second].map(|index| &drawn.elements[index]);
            let is_same =
                (other - centre).norm() < MIN_MOVE_LENGTH && (other_radius - radius).abs() < MIN_MOVE_LENGTH;
            if is_same && first.role == second.role {
                let problem = Diagnostic::new(&drawing::CIRCLE_TWICE).with("diameter", 2.0 * radius);
                found.push(at(second, problem));
            }
        }
        self.report_all(found);
    }

    /// Reports missing markers.
    pub(super) fn check_markers(&mut self) {
        if self.raw.start.is_some() && self.raw.end.is_some() {
            return;
        }
        let missing = |message| {
            Diagnostic::new(message)
                .quoting("name", self.raw.name.as_str())
                .quoting("layer", self.raw.layer())
        };
        let text = self.hints.text.as_ref().map(|text| text.arguments(text.anchor));
        let start = self.raw.start.is_none().then(|| {
            let start = missing(&drawing::MISSING_START);
            match text {
                Some(text) => start.note(&drawing::START_TEXT, text),
                None => start,
            }
        });
        let end = self.raw.end.is_none().then(|| {
            let end = missing(&drawing::MISSING_END);
            match self.hints.meant_as_end {
                Some(point) => end.note(&drawing::MEANT_AS_END, vec![("point", point.into())]),
                None => end,
            }
        });
        let somewhere = self.raw.drawn.elements.first().map(|element| self.raw.drawn.origin(element));
        for diagnostic in start.into_iter().chain(end) {
            let placed = match &somewhere {
                Some(origin) => origin.at(diagnostic),
                None => diagnostic,
            };
            self.report(placed);
        }
    }
}
