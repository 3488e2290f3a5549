//! Checks the parameters of a path and its elements as far as possible without values: letters, @, definitions.

use std::collections::HashSet;
use std::sync::Arc;

use pathbuild_diagnostic::messages::drawing::BARS_ON_HOLE;
use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, Value};

use super::checked::PathCheck;
use super::{Start, Starts};
use crate::definition::Definition;
use crate::element::{Cut, Role};
use crate::letter::Letter;
use crate::matrix::ElementClass;
use crate::names::PathName;
use crate::text::{LetterValue, ParameterText};

impl PathCheck<'_> {
    pub(super) fn check_parameters(&mut self, starts: &Starts) {
        let Some(start) = &self.raw.start else { return self.check_elements(None) };
        let Some(text) = self.raw.drawn.text(start.text) else {
            let problem = start.origin.at(Diagnostic::new(&messages::NO_PATH_PARAMETERS));
            if !self.raw.faults.has_broken_entity {
                self.report(problem);
            }
            return self.check_elements(None);
        };
        self.raw.parameters = start.text;
        if let Some(piece) = text.piece(Letter::At) {
            match referenced(text, piece, starts) {
                Ok((name, lender)) => self.borrow(name, lender),
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
        self.check_elements(self.raw.tool());
    }

    fn borrow(&mut self, name: &PathName, lender: &Start) {
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
            let text = drawn.texts.get(text).filter(|text| !self.raw.may_be_of_path(*text));
            let problems = text.map(|text| text.problems(element.class(tool)));
            for problem in problems.into_iter().flatten() {
                self.report(drawn.origin(element).at(problem));
            }
        }
        let problems = self.raw.probes.iter().flat_map(|probe| {
            let problems = drawn.text(probe.text).map(|text| text.problems(ElementClass::Probe));
            problems.into_iter().flatten().map(|problem| probe.origin.at(problem))
        });
        for problem in problems.collect::<Vec<_>>() {
            self.report(problem);
        }
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
                Ok(definition) => definitions.push(definition),
                Err(problem) => {
                    faulty.extend(parameters.value(piece).chars().next());
                    problems.push(self.raw.at_parameters(problem.with_text(parameters.fault(piece))));
                }
            }
        }
        self.raw.definitions = definitions;
        self.raw.faults.variables = faulty;
        for problem in problems {
            self.report(problem);
        }
    }
}

/// The path named by @, with its start.
fn referenced<'s>(
    text: ParameterText<'_>,
    piece: &LetterValue,
    starts: &'s Starts,
) -> Result<(&'s PathName, &'s Start), Box<Diagnostic>> {
    if text.pieces().len() > 1 {
        return Err(Box::new(Diagnostic::new(&messages::AT_WITH_OTHERS)));
    }
    let name = PathName::new(text.value(piece));
    let Some((name, start)) = starts.get_key_value(&name) else {
        let known: Value = starts.keys().map(PathName::as_str).collect();
        let problem =
            Diagnostic::new(&messages::AT_UNKNOWN).quoting("name", name.as_str()).with("known", known);
        return Err(Box::new(problem));
    };
    if start.borrows {
        return Err(Box::new(Diagnostic::new(&messages::AT_CHAINED).quoting("name", name.as_str())));
    }
    Ok((name, start))
}
