//! Whether a path may stand where a subpath segment names it, and what does not fit. (spec/50-path-building.md, "Subpaths")

use pathbuild_diagnostic::messages::{parameters, subpaths as messages, variables};
use pathbuild_diagnostic::{Diagnostic, TextFault, Value};
use pathbuild_path::approx::{at_least, near};
use pathbuild_path::{Bindings, Letter, Path, PathName, Segment, Subpath};
use regex::Regex;

use super::brief::{Brief, Head};
use crate::database::Db;
use crate::settings::Settings;

/// A path that embeds others.
#[derive(Clone, Copy)]
pub(super) struct Outer<'db> {
    pub(super) db: &'db dyn Db,
    pub(super) path: &'db Path,
}

/// A distance in mm by which a segment and the path it embeds may differ.
const CHORD_TOLERANCE: f64 = 0.001;

/// The values that a segment gives.
pub(super) fn bindings(subpath: &Subpath) -> Bindings {
    Bindings::new(subpath.values.iter().filter_map(|given| Some((given.variable?, given.value.clone()))))
}

impl Outer<'_> {
    /// What keeps it from embedding a path of this name: E, or a restriction.
    pub(super) fn forbidden(&self, name: &PathName) -> Option<Diagnostic> {
        let problem =
            |rule: &str| Diagnostic::new(&messages::FORBIDDEN).with("name", name.as_str()).with("rule", rule);
        if let Some(rule) = &self.path.embeds_only {
            let allowed = Regex::new(rule).is_ok_and(|pattern| name.is_match(&pattern));
            return (!allowed).then(|| problem(rule));
        }
        let rules = Settings::get(self.db).restrictions(self.db);
        let rule = rules.iter().find(|rule| rule.concerns(&self.path.name))?;
        (!rule.allows(name)).then(|| problem(rule.child.as_str()))
    }

    /// What is wrong with the values that a segment gives the variables of the path it names.
    pub(super) fn binding_problems(
        &self,
        segment: &Segment,
        subpath: &Subpath,
        head: &Head,
    ) -> Vec<Diagnostic> {
        let mut problems = Vec::new();
        for given in &subpath.values {
            let definition = head.definitions.iter().find(|known| Some(known.name) == given.variable);
            let name = given.variable.map(String::from).unwrap_or_default();
            let problem = match definition {
                None => Diagnostic::new(&variables::VALUE_WITHOUT_DEFINITION).with(
                    "known",
                    head.definitions.iter().map(|known| known.name.to_string()).collect::<Value>(),
                ),
                Some(definition) if !definition.allows(&given.value) => {
                    Diagnostic::new(&variables::VALUE_NOT_ALLOWED)
                        .with("value", &*given.value)
                        .with("definition", definition.to_string())
                }
                Some(_) => continue,
            };
            let problem = problem.with("variable", name).with("name", head.name.as_str());
            problems.push(self.at(segment, problem, Some(&given.text)));
        }
        let missing = head
            .definitions
            .iter()
            .filter(|known| !subpath.values.iter().any(|given| given.variable == Some(known.name)));
        problems.extend(missing.map(|definition| {
            let problem = Diagnostic::new(&variables::MISSING_VALUE)
                .with("variable", definition.name)
                .with("definition", definition.to_string());
            self.at_name(segment, subpath, problem)
        }));
        problems
    }

    /// What of T, O, M and the size differs between the segment and the path it embeds.
    pub(super) fn misfits(&self, segment: &Segment, subpath: &Subpath, inner: &Brief) -> Vec<Diagnostic> {
        let fault = |letter| self.path.fault(subpath, letter);
        let differs = |letter: Letter, here: Value, there: Value| {
            let problem = Diagnostic::new(&messages::PARAMETER_DIFFERS)
                .with("letter", letter.as_char())
                .with("segment", here.render(pathbuild_diagnostic::Lang::En))
                .with("path", there.render(pathbuild_diagnostic::Lang::En))
                .with("name", inner.name.as_str());
            self.at(segment, problem, fault(letter).as_ref())
        };
        let mut problems = Vec::new();
        match (&subpath.material, &inner.material) {
            (Some(here), Some(there)) if here != there => {
                problems.push(differs(Letter::M, (&**here).into(), (&**there).into()));
            }
            (Some(_), Some(_)) => {}
            (here, there) => {
                problems.extend(self.without_material(segment, here.is_none(), there.is_none(), inner));
            }
        }
        for (letter, here, there) in
            [(Letter::T, subpath.thickness, inner.thickness), (Letter::O, subpath.tool, inner.tool)]
        {
            if !near(here, there) {
                problems.push(differs(letter, here.into(), there.into()));
            }
        }
        if !at_least(self.path.thickness, subpath.thickness) {
            let problem = Diagnostic::new(&messages::T_BELOW)
                .with("path", self.path.thickness)
                .with("segment", subpath.thickness);
            problems.push(self.at(segment, problem, fault(Letter::T).as_ref()));
        }
        let (here, there) = ((subpath.end - subpath.start).norm(), inner.size);
        if (here - there).abs() > CHORD_TOLERANCE {
            let problem = Diagnostic::new(&messages::SIZE_DIFFERS)
                .with("segment", here)
                .with("path", there)
                .with("name", inner.name.as_str());
            problems.push(self.at(segment, problem, None));
        }
        problems
    }

    fn without_material(
        &self,
        segment: &Segment,
        is_missing_here: bool,
        is_missing_there: bool,
        inner: &Brief,
    ) -> Option<Diagnostic> {
        let place = match (is_missing_here, is_missing_there) {
            (true, true) => format!("{} / {}", self.path.name, inner.name),
            (true, false) => self.path.name.to_string(),
            (false, true) => inner.name.to_string(),
            (false, false) => return None,
        };
        Some(self.at(segment, Diagnostic::new(&parameters::MISSING_MATERIAL).with("where", place), None))
    }

    /// Puts a diagnostic where a segment is.
    pub(super) fn at(
        &self,
        segment: &Segment,
        diagnostic: Diagnostic,
        text: Option<&TextFault>,
    ) -> Diagnostic {
        let diagnostic = self.path.origin(segment).at(diagnostic.in_path(self.path.name.as_str()));
        match text {
            Some(text) => diagnostic.with_text(text.clone()),
            None => diagnostic,
        }
    }

    /// The same with the name underlined.
    pub(super) fn at_name(&self, segment: &Segment, subpath: &Subpath, diagnostic: Diagnostic) -> Diagnostic {
        self.at(segment, diagnostic, self.path.fault(subpath, Letter::Embed).as_ref())
    }
}
