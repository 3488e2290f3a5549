//! Checks Q-projects and proxy lines: PB515, PB516, PB517.

use std::collections::BTreeMap;

use pathbuild_diagnostic::messages::outputs as messages;
use pathbuild_diagnostic::{Diagnostic, Message, TextFault, Value};

use super::Component;
use crate::approx::{coincide, near};
use crate::letter::Letter;
use crate::names::PathName;
use crate::number::parse_number;
use crate::path::{Path, Segment, SegmentKind, Subpath, SubpathName};
use crate::read::ProxyLine;

/// Tolerance in mm for lengths, the same as for embedded paths.
const LENGTH_TOLERANCE: f64 = 0.001;

/// Disagreements between a component and its Q-project.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct QProjectFindings {
    /// PB517, in the component's drawing.
    pub in_component: Vec<Diagnostic>,
    /// PB515 and PB516, in the Q-project.
    pub in_q_project: Vec<Diagnostic>,
}

/// Compares a component with its Q-project. `paths`: the paths of the Q-project, unless one has errors and its embeddings are unknown.
/// `drawing`: the file name of the component.
pub fn judge_q_project(component: &Component<'_>, drawing: &str, paths: Option<&[Path]>) -> QProjectFindings {
    let judge = Judge { component, drawing };
    let in_q_project = paths.map(|paths| judge.embeddings(paths)).unwrap_or_default();
    QProjectFindings { in_component: judge.proxies(), in_q_project }
}

struct Judge<'a> {
    component: &'a Component<'a>,
    drawing: &'a str,
}

/// A difference between two texts: the letter or variable, and both values.
type Difference = (String, Value, Value, Option<TextFault>);

impl<'a> Judge<'a> {
    /// PB517.
    fn proxies(&self) -> Vec<Diagnostic> {
        let of_proxy = |proxy| self.problems(proxy).into_iter().map(|problem| at_proxy(proxy, problem));
        self.component.proxies.iter().flat_map(of_proxy).collect()
    }

    /// PB517, without a place.
    fn problems(&self, proxy: &ProxyLine) -> Vec<Diagnostic> {
        let written = proxy.text().piece(Letter::Embed);
        let written = written.map(|piece| (proxy.text().value(piece), proxy.text().fault(piece)));
        let Some((written, fault)) = written.filter(|(written, _)| !written.contains('=')) else {
            return Vec::new();
        };
        let known = |name: PathName| self.component.raw(&name).map(|raw| (name, raw));
        let Some((name, raw)) = proxy.name(self.component.language).and_then(known) else {
            let names: Value = self.component.names().map(PathName::as_str).collect();
            let problem = Diagnostic::new(&messages::PROXY_OF_NOTHING).quoting("name", written);
            return vec![problem.with("names", names).with_text(fault)];
        };
        if let Some(other) = self.other(proxy, &name) {
            let problem = Diagnostic::new(&messages::PROXY_OF_OTHER).quoting("name", name.as_str());
            return vec![problem.quoting("other", other.as_str()).with_text(fault)];
        }
        let Some(path) = self.component.path(raw, Some(proxy)) else { return Vec::new() };
        let differences = differences_from_path(proxy, &path).into_iter();
        let mut problems: Vec<Diagnostic> = differences
            .map(|difference| differing(&messages::PROXY_VALUE_DIFFERS, difference, &name))
            .collect();
        let (here, there) = (proxy.curve.chord(), (path.end - path.start).norm());
        if (here - there).abs() > LENGTH_TOLERANCE {
            let problem = Diagnostic::new(&messages::PROXY_LENGTH_DIFFERS).quoting("name", name.as_str());
            problems.push(problem.with("here", here).with("there", there));
        }
        problems
    }

    /// The path whose ends a proxy line connects, if these are not the ends of the path that it names.
    fn other(&self, proxy: &ProxyLine, named: &PathName) -> Option<&'a PathName> {
        let (start, end) = (proxy.curve.start(), proxy.curve.end());
        let joined = self.component.paths.iter().filter(|raw| {
            let ends = raw.start.as_ref().zip(raw.end.as_ref()).map(|(from, to)| (from.at, to.at));
            ends.is_some_and(|(from, to)| {
                coincide(from, start) && coincide(to, end) || coincide(from, end) && coincide(to, start)
            })
        });
        let joined: Vec<&PathName> = joined.map(|raw| &*raw.name).collect();
        if joined.contains(&named) { None } else { joined.first().copied() }
    }

    fn embeddings(&self, paths: &[Path]) -> Vec<Diagnostic> {
        let mut embedded: BTreeMap<&PathName, Vec<(&Path, &Segment, &Subpath)>> = BTreeMap::new();
        for path in paths {
            for segment in &path.segments {
                if let SegmentKind::Subpath(subpath) = &segment.kind
                    && let SubpathName::Found { name, .. } = &subpath.name
                {
                    embedded.entry(name).or_default().push((path, segment, subpath));
                }
            }
        }
        let of_name = |name: &PathName| match embedded.get(name) {
            None => {
                let problem = Diagnostic::new(&messages::LACKS_PATH).quoting("name", name.as_str());
                vec![problem.quoting("drawing", self.drawing)]
            }
            Some(segments) => {
                let of_segment = |&(path, segment, subpath): &(&Path, &Segment, &Subpath)| {
                    self.embedding(name, path, segment, subpath)
                };
                segments.iter().flat_map(of_segment).collect()
            }
        };
        self.component.names().flat_map(of_name).collect()
    }

    /// PB516 if a subpath agrees with none of its path's proxy lines. Faulty proxy lines are ignored.
    fn embedding(
        &self,
        name: &PathName,
        path: &Path,
        segment: &Segment,
        subpath: &Subpath,
    ) -> Vec<Diagnostic> {
        let proxies = self.component.proxies(name).iter();
        let right = proxies.filter(|proxy| self.problems(proxy).is_empty());
        let mut compared: Vec<Vec<Diagnostic>> =
            right.map(|proxy| self.differences(name, proxy, path, subpath)).collect();
        if compared.iter().any(Vec::is_empty) || compared.is_empty() {
            return Vec::new();
        }
        let place = |problem: Diagnostic| path.origin(segment).at(problem.in_path(path.name.as_str()));
        compared.swap_remove(0).into_iter().map(place).collect()
    }

    /// The differences between a subpath of the Q-project and a proxy line.
    fn differences(
        &self,
        name: &PathName,
        proxy: &ProxyLine,
        path: &Path,
        subpath: &Subpath,
    ) -> Vec<Diagnostic> {
        let differences = differences_from_proxy(path, subpath, proxy).into_iter();
        let differing = differences.map(|difference| differing(&messages::Q_VALUE_DIFFERS, difference, name));
        let mut problems: Vec<Diagnostic> = differing.collect();
        let (here, there) = ((subpath.end - subpath.start).norm(), proxy.curve.chord());
        if (here - there).abs() > LENGTH_TOLERANCE {
            let problem = Diagnostic::new(&messages::Q_LENGTH_DIFFERS).quoting("name", name.as_str());
            problems.push(problem.with("here", here).with("there", there));
        }
        problems.into_iter().map(|problem| problem.quoting("drawing", self.drawing)).collect()
    }
}

fn at_proxy(proxy: &ProxyLine, problem: Diagnostic) -> Diagnostic {
    let mut problem = proxy.origin.at(problem);
    problem.place.element = None;
    problem.locate(proxy.position.line, proxy.position.handle);
    problem
}

fn differing(
    message: &'static Message,
    (letter, here, there, text): Difference,
    name: &PathName,
) -> Diagnostic {
    let problem = Diagnostic::new(message).quoting("name", name.as_str()).quoting("letter", letter);
    let problem = problem.with("here", here).with("there", there);
    match text {
        Some(text) => problem.with_text(text),
        None => problem,
    }
}

/// The differences in T, O and M between a proxy line and its path.
fn differences_from_path(proxy: &ProxyLine, path: &Path) -> Vec<Difference> {
    let number = |letter: Letter, there: f64| {
        let (here, fault) = proxy.value(letter)?;
        (!is_number(here, there))
            .then(|| (letter.as_char().to_string(), Value::quoted(here), there.into(), Some(fault)))
    };
    let material = || {
        let (here, fault) = proxy.value(Letter::M)?;
        let expected = path.material.as_deref();
        (expected != Some(here))
            .then(|| ("M".to_owned(), Value::quoted(here), or_dash(expected), Some(fault)))
    };
    let numbers = [number(Letter::T, path.thickness), number(Letter::O, path.tool)];
    numbers.into_iter().flatten().chain(material()).collect()
}

/// The differences in T, O, M and variables between a subpath of the Q-project and a proxy line.
fn differences_from_proxy(path: &Path, subpath: &Subpath, proxy: &ProxyLine) -> Vec<Difference> {
    let fault = |letter| path.fault(subpath, letter);
    let number = |letter: Letter, here: f64| {
        let (there, _) = proxy.value(letter)?;
        let name = letter.as_char();
        (!is_number(there, here))
            .then(|| (name.to_string(), here.into(), Value::quoted(there), fault(letter)))
    };
    let material = || {
        let (there, _) = proxy.value(Letter::M)?;
        let here = subpath.material.as_deref();
        (here != Some(there)).then(|| ("M".to_owned(), or_dash(here), Value::quoted(there), fault(Letter::M)))
    };
    let mut differences: Vec<Difference> =
        [number(Letter::T, subpath.thickness), number(Letter::O, subpath.tool), material()]
            .into_iter()
            .flatten()
            .collect();
    differences.extend(differing_variables(subpath, proxy));
    differences
}

fn differing_variables(subpath: &Subpath, proxy: &ProxyLine) -> Vec<Difference> {
    let on_proxy: BTreeMap<char, &str> = proxy.variables().collect();
    let here = subpath.values.iter().filter_map(|given| Some((given.variable?, given)));
    let mut differences = Vec::new();
    let mut given = Vec::new();
    for (variable, value) in here {
        given.push(variable);
        let other = on_proxy.get(&variable).copied();
        if other.is_none_or(|other| !is_same_value(&value.value, other)) {
            let values = (Value::quoted(&value.value), or_dash(other));
            differences.push((format!(":{variable}"), values.0, values.1, Some(value.text.clone())));
        }
    }
    let missing = on_proxy.iter().filter(|(variable, _)| !given.contains(variable));
    differences.extend(
        missing.map(|(variable, value)| (format!(":{variable}"), or_dash(None), Value::quoted(value), None)),
    );
    differences
}

/// A value as it is shown where there may be none.
fn or_dash(value: Option<&str>) -> Value {
    Value::quoted(value.unwrap_or("-"))
}

fn is_number(text: &str, number: f64) -> bool {
    parse_number(text).is_some_and(|written| near(written, number))
}

/// Whether two values are equal; numbers may have a decimal point or a comma.
fn is_same_value(a: &str, b: &str) -> bool {
    a == b || parse_number(a).is_some_and(|number| is_number(b, number))
}
