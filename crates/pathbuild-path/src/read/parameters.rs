//! The parameters of a path and its elements, as far as they can be checked without values: which letters, @, definitions.

use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, Value};

use super::Starts;
use super::collect::Collected;
use crate::definition::Definition;
use crate::element::Origin;
use crate::letter::{ElementClass, Letter};
use crate::name::PathName;
use crate::raw::tool;
use crate::text::{ParameterText, Piece};

impl Collected<'_> {
    pub(crate) fn check_parameters(&mut self, starts: &Starts) {
        // Without the path's parameters it is not known what most elements are, so their letters are not judged.
        let Some(start) = &self.raw.start else { return };
        let Some(text) = self.raw.text_of(start.text) else {
            let problem = start.origin.at(Diagnostic::new(&messages::NO_PATH_PARAMETERS));
            if !self.has_broken_entity {
                self.report(problem);
            }
            return;
        };
        let parameters_at = match text.piece(Letter::At) {
            None => Ok((self.raw.name.clone(), (text.clone(), start.origin.clone()))),
            Some(piece) => referenced(text, &piece, starts)
                .map_err(|problem| start.origin.at(problem.with_text(text.fault(&piece)))),
        };
        match parameters_at {
            Ok((name, (parameters, origin))) => {
                self.raw.parameters = parameters;
                self.raw.parameters_at = Some((name, origin));
            }
            Err(problem) => return self.report(problem),
        }
        for problem in self.raw.parameters.problems(ElementClass::PathStart) {
            self.report(self.raw.at_parameters(problem));
        }
        self.define_variables();
        self.check_elements(tool(&self.raw.parameters));
    }

    fn check_elements(&mut self, tool: Option<f64>) {
        let mut found = Vec::new();
        let mut check = |origin: &Origin, text: Option<u32>, class: ElementClass| {
            let problems = self.raw.text_of(text).map(|text| text.problems(class)).unwrap_or_default();
            if !problems.is_empty() {
                found.push((origin.clone(), problems));
            }
        };
        let mut seen = None;
        for element in &*self.raw.elements {
            // The parts of a polyline share one text, which is checked once.
            if element.text.is_some() && element.text == seen {
                continue;
            }
            seen = element.text.or(seen);
            check(&element.origin, element.text, element.class(tool));
        }
        for probe in &self.raw.probes {
            check(&probe.origin, probe.text, ElementClass::Probe);
        }
        for (origin, problems) in found {
            self.report_all(&origin, problems);
        }
    }

    fn report_all(&mut self, origin: &Origin, problems: Vec<Diagnostic>) {
        for problem in problems {
            self.report(origin.at(problem));
        }
    }

    fn define_variables(&mut self) {
        let parameters = &self.raw.parameters;
        let pieces = parameters.pieces().filter(|piece| piece.letter == Some(Letter::Variable));
        let (mut definitions, mut problems) = (Vec::new(), Vec::new());
        for piece in pieces {
            match Definition::parse(parameters.value(&piece)) {
                Ok(definition) => definitions.push(definition),
                Err(problem) => {
                    problems.push(self.raw.at_parameters(problem.with_text(parameters.fault(&piece))));
                }
            }
        }
        self.raw.definitions = definitions;
        for problem in problems {
            self.report(problem);
        }
    }
}

/// The path that @ names, with its parameters and where they stand.
fn referenced(
    text: &ParameterText,
    piece: &Piece,
    starts: &Starts,
) -> Result<(PathName, (ParameterText, Origin)), Box<Diagnostic>> {
    if text.pieces().nth(1).is_some() {
        return Err(Box::new(Diagnostic::new(&messages::AT_WITH_OTHERS)));
    }
    let name = PathName::new(text.value(piece));
    let Some((name, start)) = starts.get_key_value(&name) else {
        let known: Value = starts.keys().map(PathName::as_str).collect();
        let problem = Diagnostic::new(&messages::AT_UNKNOWN).with("name", name.as_str()).with("known", known);
        return Err(Box::new(problem));
    };
    if start.0.piece(Letter::At).is_some() {
        return Err(Box::new(Diagnostic::new(&messages::AT_CHAINED).with("name", name.as_str())));
    }
    Ok((name.clone(), start.clone()))
}
