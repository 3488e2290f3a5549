//! From a raw path and values of its variables to a [`Path`]: every parameter found, inherited and checked.
//! (book: language/letters, book: language/variables)

mod circles;
mod cuts;
mod segments;

use std::collections::HashMap;
use std::sync::Arc;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::parameters as messages;
use regex::Regex;
use smol_str::SmolStr;

use crate::element::{Cut, Element, Marker, Origin};
use crate::letter::Letter;
use crate::matrix::ElementClass;
use crate::path::{CutParameters, Helix, Hole, Path, Probe, Segment, Surface, Turn};
use crate::raw::{Language, RawPath};
use crate::text::{ParameterText, TextId};
use crate::values::{Given, Values};
use crate::variables::{Bindings, Interpolation};
use crate::{doubts, limits};

use segments::Scope;

/// The path that a raw path is with these values, and what is wrong with it. There is a path only where nothing is an error.
///
/// The raw path must be sound, and the bindings those of its definitions.
pub fn bind(raw: &RawPath, bindings: &Bindings, language: &Language) -> (Option<Path>, Vec<Diagnostic>) {
    let (Some(start), Some(end)) = (&raw.start, &raw.end) else { return (None, Vec::new()) };
    let mut binder = Binder::new(raw, bindings, language);
    let path = binder.path(start, end);
    let problems = binder.problems;
    (path.filter(|_| !problems.iter().any(Diagnostic::is_error)), problems)
}

/// Collects the values of a path and what is wrong with them.
struct Binder<'a> {
    raw: &'a RawPath,
    language: &'a Language,
    interpolation: Interpolation<'a>,
    /// The path's own values.
    values: Values<'a>,
    segments: Vec<Segment>,
    cuts: Vec<CutParameters>,
    holes: Vec<Hole>,
    helices: Vec<Helix>,
    problems: Vec<Diagnostic>,
    /// Which of them are about what a text says.
    of_texts: HashMap<TextId, Vec<usize>>,
    /// The path's D was said to be doubtful for marks.
    has_doubtful_marks: bool,
    /// A segment with support bars has a gap between them.
    has_gap: bool,
    /// The doubt about the first that has none.
    gapless: Option<Diagnostic>,
}

/// What something is reported at.
#[derive(Clone, Copy)]
enum At<'a> {
    Element(&'a Element),
    Marker(&'a Marker),
}

impl At<'_> {
    /// Its own text.
    fn text(self) -> Option<TextId> {
        match self {
            At::Element(element) => element.text,
            At::Marker(marker) => marker.text,
        }
    }
}

impl<'a> Binder<'a> {
    fn new(raw: &'a RawPath, bindings: &'a Bindings, language: &'a Language) -> Self {
        let interpolation = Interpolation { bindings, limit: language.text_limit };
        let values = Values::of_path(raw.parameters(), &interpolation);
        Self {
            raw,
            language,
            interpolation,
            values,
            segments: Vec::new(),
            cuts: Vec::new(),
            holes: Vec::new(),
            helices: Vec::new(),
            problems: Vec::new(),
            of_texts: HashMap::new(),
            has_doubtful_marks: false,
            has_gap: false,
            gapless: None,
        }
    }

    fn path(&mut self, start: &Marker, end: &Marker) -> Option<Path> {
        self.check_path_values();
        let (tool, thickness) = (self.path_number(Letter::O), self.path_number(Letter::T));
        let sweep_height = self.path_number(Letter::S);
        self.bind_segments(tool);
        // Rounded corners stand between sides that have gaps. Where nothing has one, U is doubtful.
        let gapless = self.gapless.take().filter(|_| !self.has_gap);
        self.problems.extend(gapless);
        let turns = self.raw.turns.iter();
        let mut path = Path {
            name: self.raw.name.clone(),
            tool: tool.unwrap_or_default(),
            thickness: thickness.unwrap_or_default(),
            sweep_height,
            material: self.path_text(Letter::M),
            feed: self.path_number(Letter::F),
            output_suffix: self.path_text(Letter::R).unwrap_or_default(),
            embeds_only: self.path_text(Letter::E),
            start: start.at,
            end: end.at,
            turns: turns.map(|turn| Turn { origin: turn.origin.clone(), at: turn.at }).collect(),
            drawn: Arc::clone(&self.raw.drawn),
            segments: std::mem::take(&mut self.segments),
            cuts: std::mem::take(&mut self.cuts),
            holes: std::mem::take(&mut self.holes),
            helices: std::mem::take(&mut self.helices),
            probes: Vec::new(),
            surface: sweep_height.is_none().then(|| self.surface(start, thickness.unwrap_or_default())),
            probe_surfaces: Vec::new(),
            start_origin: start.origin.clone(),
            end_origin: end.origin.clone(),
            left_out: self.raw.left_out.clone(),
        };
        self.add_probes(&mut path);
        (tool.is_some() && thickness.is_some()).then_some(path)
    }

    /// The upper face that a path without an S of its own must sweep above.
    fn surface(&self, start: &Marker, thickness: f64) -> Surface {
        let origin = self.raw.borrowed_from.as_ref().map_or(&start.origin, |lender| &lender.1).clone();
        Surface { origin, thickness, text: self.raw.parameters }
    }

    fn check_path_values(&mut self) {
        let mut problems = std::mem::take(&mut self.values.problems);
        for letter in ElementClass::PathStart.needed_letters().filter(|letter| !self.values.has(*letter)) {
            let missing = Diagnostic::new(&messages::MISSING_AT_START).with("letter", letter.as_char());
            problems.push(missing.with_text(self.raw.parameters().whole()));
        }
        if let Some(Err(error)) = self.values.text(Letter::E).map(Regex::new) {
            let problem = Diagnostic::new(&messages::INVALID_REGEX).with("reason", regex_reason(&error));
            problems.push(self.values.underline(Letter::E, problem));
        }
        problems.extend(limits::check(&self.values, &self.values, ElementClass::PathStart));
        let doubts = &self.language.doubts;
        problems.extend(doubts::check(&self.values, &self.values, ElementClass::PathStart, doubts));
        for problem in problems {
            self.report_at_start(problem);
        }
    }

    /// What is about the path's own values.
    fn report_at_start(&mut self, problem: Diagnostic) {
        let problem = self.raw.at_parameters(problem);
        self.problems.push(if problem.path.is_none() {
            problem.in_path(self.raw.name.as_str())
        } else {
            problem
        });
    }

    /// The bottom of a cut that is there, own or the path's; a mark that is doubtful is reported, of marks with the path's D the first.
    fn bottom(&mut self, scope: &Scope<'_>, cut: Cut) -> Option<f64> {
        let bottom = self.value(scope, cut.depth())?;
        let doubts = &self.language.doubts;
        let doubt =
            (cut == Cut::Mark).then(|| doubts::check_mark(bottom, scope.values, &self.values, doubts));
        match doubt.flatten() {
            Some((problem, false)) => self.report(scope.at, problem),
            Some((problem, true)) if !self.has_doubtful_marks => {
                self.has_doubtful_marks = true;
                self.report_at_start(problem);
            }
            _ => {}
        }
        Some(bottom)
    }

    fn path_number(&self, letter: Letter) -> Option<f64> {
        self.values.number(letter).number()
    }

    fn path_text(&self, letter: Letter) -> Option<SmolStr> {
        self.values.text(letter).map(Into::into)
    }

    /// The values of an element's text, checked; what is wrong is reported at the element.
    fn element_values(
        &mut self,
        at: At<'_>,
        text: Option<ParameterText<'a>>,
        class: ElementClass,
    ) -> Values<'a> {
        let Some(text) = text else { return Values::default() };
        let mut values = Values::of(text, &self.interpolation);
        let mut problems = std::mem::take(&mut values.problems);
        problems.append(&mut limits::check(&values, &self.values, class));
        problems.append(&mut doubts::check(&values, &self.values, class, &self.language.doubts));
        for problem in problems {
            self.report(at, problem);
        }
        values
    }

    fn origin(&self, at: At<'_>) -> Origin {
        match at {
            At::Element(element) => self.raw.drawn.origin(element).clone(),
            At::Marker(marker) => marker.origin.clone(),
        }
    }

    /// Reports once what the parts of a polyline, which share a text, have in common. Another text may say the same.
    fn report(&mut self, at: At<'_>, problem: Diagnostic) {
        let problem = self.origin(at).at(problem.in_path(self.raw.name.as_str()));
        if let (Some(text), true) = (at.text(), problem.text.is_some()) {
            let known = self.of_texts.entry(text).or_default();
            let is_same = |known: &usize| {
                let known = &self.problems[*known];
                (known.message, &known.text, &known.arguments)
                    == (problem.message, &problem.text, &problem.arguments)
            };
            if known.iter().any(is_same) {
                return;
            }
            known.push(self.problems.len());
        }
        self.problems.push(problem);
    }

    fn add_probes(&mut self, path: &mut Path) {
        for marker in &self.raw.probes {
            let (at, class) = (At::Marker(marker), ElementClass::Probe);
            let values = self.element_values(at, self.raw.drawn.text(marker.text), class);
            if let (Some(_), Given::Number(thickness)) = (&path.surface, values.number(Letter::T)) {
                let origin = marker.origin.clone();
                path.probe_surfaces.push(Surface { origin, thickness, text: marker.text });
            }
            let scope = Scope { at, class, values: &values };
            let thickness = self.value(&scope, Letter::T).unwrap_or_default();
            path.probes.push(Probe {
                origin: marker.origin.clone(),
                at: marker.at,
                height: thickness
                    + scope.texts(&self.values).number_or_default(Letter::H).unwrap_or_default(),
                feed: self.value(&scope, Letter::Z),
                label: values.text(Letter::L).map(Into::into),
                text: marker.text,
            });
        }
    }
}

/// The last line of a regular expression error says what is wrong; the lines before it draw the place, which the text shows anyway.
pub(crate) fn regex_reason(error: &regex::Error) -> String {
    let text = error.to_string();
    let last = text.lines().rfind(|line| !line.trim().is_empty()).unwrap_or_default();
    last.trim().trim_start_matches("error: ").to_owned()
}
