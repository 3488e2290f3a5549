//! Q-projects: `NAME_Q` embeds every path of `NAME` as given by its proxy lines. (book: language/q-projects)

use std::collections::BTreeMap;

use pathbuild_diagnostic::messages::outputs as messages;
use pathbuild_diagnostic::{Diagnostic, Message, TextFault, Value};
use smol_str::SmolStr;

use crate::approx::{coincide, near};
use crate::bind::bind;
use crate::embedding::{CHORD_TOLERANCE, with_note_on_combined_letters};
use crate::language::{Language, PathTools};
use crate::letter::{ElementClass, Letter};
use crate::names::PathName;
use crate::numbers::parse_number;
use crate::path::{Path, Segment, SegmentKind, Subpath, SubpathName};
use crate::raw::RawPath;
use crate::read::ProxyLine;
use crate::variables::{Bindings, Definition};

/// A component: the paths of a drawing, with their proxy lines.
#[derive(Debug)]
pub struct Component<'a> {
    /// The paths in order of first appearance.
    paths: Vec<&'a RawPath>,
    proxies: &'a [ProxyLine],
    language: &'a Language,
    by_name: BTreeMap<PathName, Vec<&'a ProxyLine>>,
}

impl<'a> Component<'a> {
    /// Groups the proxy lines of a drawing by its paths.
    pub fn new(
        paths: impl Iterator<Item = &'a RawPath>,
        proxies: &'a [ProxyLine],
        language: &'a Language,
    ) -> Self {
        let mut by_name: BTreeMap<PathName, Vec<&ProxyLine>> = BTreeMap::new();
        for proxy in proxies {
            if let Some(name) = proxy.name(language) {
                by_name.entry(name).or_default().push(proxy);
            }
        }
        Self { paths: paths.collect(), proxies, language, by_name }
    }

    fn names(&self) -> impl Iterator<Item = &'a PathName> {
        self.paths.iter().map(|path| &*path.name)
    }

    fn raw(&self, name: &PathName) -> Option<&'a RawPath> {
        self.paths.iter().copied().find(|path| *path.name == *name)
    }

    fn proxies(&self, name: &PathName) -> &[&'a ProxyLine] {
        self.by_name.get(name).map_or(&[], Vec::as_slice)
    }

    /// Returns the name of the tool that mills a path, if the configuration has one for it.
    fn tool(&self, path: &Path) -> Option<SmolStr> {
        self.language.tools.of(path.name.as_str(), path.tool).map(|tool| tool.name)
    }

    /// Returns a path bound to the values that a proxy line sets, and to example values for its other variables; `None` if the path has errors.
    fn path(&self, raw: &RawPath, proxy: Option<&ProxyLine>) -> Option<Path> {
        raw.is_sound().then(|| bind(raw, &values(raw, proxy), self.language).0)?
    }
}

/// Returns the values for a path's variables: those that a proxy line sets and the path permits, otherwise example values.
fn values(raw: &RawPath, proxy: Option<&ProxyLine>) -> Bindings {
    let examples = Bindings::check_values(&raw.definitions);
    let value = |definition: &Definition| {
        let given = proxy.and_then(|proxy| proxy.variables().find(|(name, ..)| *name == definition.name));
        let given = given.map(|(_, value, _)| value).filter(|value| definition.allows(value));
        let value = given.or_else(|| examples.get(definition.name))?;
        Some((definition.name, value.into()))
    };
    Bindings::new(raw.definitions.iter().filter_map(value))
}

/// A planned path of a Q-project, which embeds all paths that are milled with the same cutter.
#[derive(Clone, Debug, PartialEq)]
pub struct QProject {
    /// T, O and M of the path: those of the thickest embedded path.
    pub parameters: String,
    /// The segments of the path, in the order of the drawing's paths.
    pub lines: Vec<QProjectLine>,
    /// O in mm of the embedded paths.
    diameter: f64,
    /// Name of the tool that mills the embedded paths, if the configuration has one for them.
    tool: Option<SmolStr>,
}

impl QProject {
    /// Whether a path of this name is milled with the tool of the embedded paths.
    pub fn has_tool_of(&self, name: &PathName, tools: &PathTools) -> bool {
        tools.of(name.as_str(), self.diameter).map(|tool| tool.name) == self.tool
    }
}

/// A planned subpath segment.
#[derive(Clone, Debug, PartialEq)]
pub struct QProjectLine {
    /// The length of the segment in mm.
    pub length: f64,
    /// The parameter text of the segment.
    pub text: String,
}

/// Plans the Q-project of a component, in order of first appearance: paths with different O, different tools, or a different T of the same material
/// are embedded by different paths of the Q-project. Each embedded path uses the values of its first proxy line, or else its own values and example
/// values. Paths with errors are left out.
pub fn plan_q_project(component: &Component<'_>) -> Vec<QProject> {
    let mut by_cutter: Vec<Vec<(Path, QProjectLine)>> = Vec::new();
    for planned in component.paths.iter().filter_map(|raw| planned_line(component, raw)) {
        let fits = |other: &Path| {
            let is_same_sheet = other.material == planned.0.material;
            near(other.tool, planned.0.tool)
                && component.tool(other) == component.tool(&planned.0)
                && (!is_same_sheet || near(other.thickness, planned.0.thickness))
        };
        let is_same = |group: &&mut Vec<(Path, QProjectLine)>| group.iter().all(|(other, _)| fits(other));
        match by_cutter.iter_mut().find(is_same) {
            Some(group) => group.push(planned),
            None => by_cutter.push(vec![planned]),
        }
    }
    by_cutter.into_iter().map(|group| embedding_path(component, group)).collect()
}

/// Returns the path that embeds these paths, all of which have the same O and the same tool.
fn embedding_path(component: &Component<'_>, planned: Vec<(Path, QProjectLine)>) -> QProject {
    let paths = planned.iter().map(|(path, _)| path);
    let thickest =
        paths.fold(&planned[0].0, |most, path| if path.thickness > most.thickness { path } else { most });
    let material = thickest.material.as_ref().map(|material| format!(" M{material}")).unwrap_or_default();
    let parameters = format!("T{} O{}{material}", thickest.thickness, thickest.tool);
    let (diameter, tool) = (thickest.tool, component.tool(thickest));
    QProject { parameters, lines: planned.into_iter().map(|(_, line)| line).collect(), diameter, tool }
}

fn planned_line(component: &Component<'_>, raw: &RawPath) -> Option<(Path, QProjectLine)> {
    let proxy = component.proxies(&raw.name).first().copied();
    let path = component.path(raw, proxy)?;
    let line =
        QProjectLine { length: (path.end - path.start).norm(), text: completed_text(raw, &path, proxy) };
    Some((path, line))
}

/// Returns the text of a proxy line, completed by the values that it leaves open.
fn completed_text(raw: &RawPath, path: &Path, proxy: Option<&ProxyLine>) -> String {
    let mut pieces = vec![format!(">{}", path.name)];
    if let Some(proxy) = proxy {
        let others = proxy.text().pieces().iter();
        let others = others.filter_map(|piece| Some((piece.letter?, proxy.text().value(piece))));
        let others = others.filter(|(letter, value)| {
            !matches!(letter, Letter::Embed | Letter::Variable) && !value.contains('=')
        });
        pieces.extend(others.map(|(letter, value)| format!("{}{value}", letter.as_char())));
    }
    let is_open = |letter| proxy.is_none_or(|proxy| proxy.value(letter).is_none());
    let own = [
        path.material.as_ref().map(|material| (Letter::M, material.to_string())),
        Some((Letter::T, path.thickness.to_string())),
        Some((Letter::O, path.tool.to_string())),
    ];
    let own = own.into_iter().flatten().filter(|(letter, _)| is_open(*letter));
    pieces.extend(own.map(|(letter, value)| format!("{}{value}", letter.as_char())));
    pieces.extend(values(raw, proxy).iter().map(|(variable, value)| format!(":{variable}{value}")));
    pieces.join(" ")
}

/// Disagreements between a component and its Q-project.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct QProjectFindings {
    /// Findings in the component's drawing (PB517).
    pub in_component: Vec<Diagnostic>,
    /// Findings in the Q-project (PB515 and PB516).
    pub in_q_project: Vec<Diagnostic>,
}

/// Compares a component with its Q-project. `paths`: the paths of the Q-project; `None` if one of them has errors, so that its embeddings are
/// unknown. `drawing`: the file of the component.
pub fn compare_q_project(
    component: &Component<'_>,
    drawing: &str,
    paths: Option<&[Path]>,
) -> QProjectFindings {
    let comparison = QProjectComparison { component, drawing };
    let in_q_project = paths.map(|paths| comparison.embedding_problems(paths)).unwrap_or_default();
    QProjectFindings { in_component: comparison.proxy_problems(), in_q_project }
}

struct QProjectComparison<'a> {
    component: &'a Component<'a>,
    drawing: &'a str,
}

/// A difference between two texts: the letter or variable, both values, and the place in the text that has the letter, if it is known.
type Difference = (String, Value, Value, Option<TextFault>);

impl<'a> QProjectComparison<'a> {
    /// Returns PB517 for each proxy line that disagrees with its own path, and the errors in its text.
    fn proxy_problems(&self) -> Vec<Diagnostic> {
        let of_proxy = |proxy| self.problems(proxy).into_iter().map(|problem| at_proxy(proxy, problem));
        self.component.proxies.iter().flat_map(of_proxy).collect()
    }

    /// Returns PB517 for a proxy line that disagrees with its own path, and the errors in its text, without places.
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
        if let Some(other) = self.other_connected_path(proxy, &name) {
            let problem = Diagnostic::new(&messages::PROXY_OF_OTHER).quoting("name", name.as_str());
            return vec![problem.quoting("other", other.as_str()).with_text(fault)];
        }
        let Some(path) = self.component.path(raw, Some(proxy)) else { return Vec::new() };
        let differences = differences_from_path(proxy, &path).into_iter();
        let mut problems: Vec<Diagnostic> = differences
            .map(|difference| difference_problem(&messages::PROXY_VALUE_DIFFERS, difference, &name))
            .collect();
        problems
            .extend(proxy.text().problems(ElementClass::Subpath).into_iter().filter(Diagnostic::is_error));
        problems.extend(wrong_variables(proxy, raw));
        let (here, there) = (proxy.curve.chord(), (path.end - path.start).norm());
        if (here - there).abs() > CHORD_TOLERANCE {
            let problem = Diagnostic::new(&messages::PROXY_LENGTH_DIFFERS).quoting("name", name.as_str());
            problems.push(problem.with("here", here).with("there", there));
        }
        problems
    }

    /// Returns the path with the ends that a proxy line connects, if the named path has other ends.
    fn other_connected_path(&self, proxy: &ProxyLine, named: &PathName) -> Option<&'a PathName> {
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

    /// Returns PB515 for each path of the component that the Q-project does not embed, and PB516 for each subpath that disagrees with the proxy
    /// lines.
    fn embedding_problems(&self, paths: &[Path]) -> Vec<Diagnostic> {
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
                vec![self.with_drawing(problem)]
            }
            Some(segments) => {
                let of_segment = |&(path, segment, subpath): &(&Path, &Segment, &Subpath)| {
                    self.subpath_problems(name, path, segment, subpath)
                };
                segments.iter().flat_map(of_segment).collect()
            }
        };
        self.component.names().flat_map(of_name).collect()
    }

    /// Returns PB516 if a subpath agrees with none of its path's proxy lines. Faulty proxy lines are ignored.
    fn subpath_problems(
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

    /// Returns the differences between a subpath of the Q-project and a proxy line.
    fn differences(
        &self,
        name: &PathName,
        proxy: &ProxyLine,
        path: &Path,
        subpath: &Subpath,
    ) -> Vec<Diagnostic> {
        let differences = differences_from_proxy(path, subpath, proxy).into_iter();
        let differing =
            differences.map(|difference| difference_problem(&messages::Q_VALUE_DIFFERS, difference, name));
        let mut problems: Vec<Diagnostic> = differing.collect();
        let (here, there) = ((subpath.end - subpath.start).norm(), proxy.curve.chord());
        if (here - there).abs() > CHORD_TOLERANCE {
            let problem = Diagnostic::new(&messages::Q_LENGTH_DIFFERS).quoting("name", name.as_str());
            problems.push(problem.with("here", here).with("there", there));
        }
        problems.into_iter().map(|problem| self.with_drawing(problem)).collect()
    }

    /// Names the drawing in a message, and as the argument of a command.
    fn with_drawing(&self, problem: Diagnostic) -> Diagnostic {
        let name = self.drawing.rsplit('/').next().unwrap_or_default();
        let is_plain = |character: char| character.is_alphanumeric() || "-_=./:,+".contains(character);
        let argument = if self.drawing.chars().all(is_plain) {
            self.drawing.to_owned()
        } else {
            format!("\"{}\"", self.drawing)
        };
        problem.quoting("drawing", name).quoting("argument", argument)
    }
}

fn at_proxy(proxy: &ProxyLine, problem: Diagnostic) -> Diagnostic {
    let mut problem = proxy.origin.at(problem);
    problem.place.element = None;
    problem.locate(proxy.position.line, proxy.position.handle);
    problem
}

fn difference_problem(
    message: &'static Message,
    (letter, here, there, text): Difference,
    name: &PathName,
) -> Diagnostic {
    let problem = Diagnostic::new(message).quoting("name", name.as_str()).quoting("letter", letter);
    with_note_on_combined_letters(problem.with("here", here).with("there", there).with_text(text))
}

/// Returns the differences in T, O and M between a proxy line and its path.
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

/// Returns the differences in T, O, M and variables between a subpath of the Q-project and a proxy line.
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
    let raised = || {
        let proxy_height = proxy.value(Letter::H).map(|(height, _)| height);
        (!is_number(proxy_height.unwrap_or("0"), subpath.height))
            .then(|| ("H".to_owned(), subpath.height.into(), or_dash(proxy_height), fault(Letter::H)))
    };
    let [thickness, tool] = [number(Letter::T, subpath.thickness), number(Letter::O, subpath.tool)];
    let mut differences: Vec<Difference> =
        [thickness, tool, material(), raised()].into_iter().flatten().collect();
    differences.extend(differing_variables(subpath, proxy));
    differences
}

/// Returns PB517 for the variables of a proxy line that its path does not have, and for values that the path does not allow.
fn wrong_variables(proxy: &ProxyLine, raw: &RawPath) -> Vec<Diagnostic> {
    let wrong = |(variable, value, fault): (char, &str, TextFault)| {
        let definition = raw.definitions.iter().find(|definition| definition.name == variable);
        let problem = match definition {
            None => Diagnostic::new(&messages::PROXY_VARIABLE_UNKNOWN),
            Some(definition) if !definition.allows(value) => {
                Diagnostic::new(&messages::PROXY_VALUE_NOT_ALLOWED)
                    .quoting("value", value)
                    .quoting("definition", definition.to_string())
            }
            Some(_) => return None,
        };
        let problem = problem.quoting("variable", variable.to_string());
        Some(problem.quoting("name", raw.name.as_str()).with_text(fault))
    };
    proxy.variables().filter_map(wrong).collect()
}

/// Returns the differences in the variables that a proxy line sets.
fn differing_variables(subpath: &Subpath, proxy: &ProxyLine) -> Vec<Difference> {
    let on_proxy: BTreeMap<char, &str> =
        proxy.variables().map(|(variable, value, _)| (variable, value)).collect();
    let here = subpath.values.iter().filter_map(|given| Some((given.variable?, given)));
    let mut differences = Vec::new();
    let mut given = Vec::new();
    for (variable, value) in here {
        given.push(variable);
        let other = on_proxy.get(&variable).copied();
        if let Some(other) = other.filter(|other| !is_same_value(&value.value, other)) {
            let values = (Value::quoted(&value.value), Value::quoted(other));
            differences.push((format!(":{variable}"), values.0, values.1, Some(value.text.clone())));
        }
    }
    let missing = on_proxy.iter().filter(|(variable, _)| !given.contains(variable));
    differences.extend(
        missing.map(|(variable, value)| (format!(":{variable}"), or_dash(None), Value::quoted(value), None)),
    );
    differences
}

/// Returns a value in quotation marks, or a hyphen if there is none.
fn or_dash(value: Option<&str>) -> Value {
    Value::quoted(value.unwrap_or("-"))
}

/// Whether a text is a number equal to `number`.
fn is_number(text: &str, number: f64) -> bool {
    parse_number(text).is_some_and(|written| near(written, number))
}

/// Whether two values are equal; numbers may have a decimal point or a comma.
fn is_same_value(a: &str, b: &str) -> bool {
    a == b || parse_number(a).is_some_and(|number| is_number(b, number))
}
