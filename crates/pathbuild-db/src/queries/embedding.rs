//! What a path embeds: every subpath segment with the path it names, checked against each other.
//! (spec/50-path-building.md, "Subpaths"; the order of errors: spec/80-diagnostics.md)

use pathbuild_diagnostic::messages::{parameters, subpaths as messages, variables};
use pathbuild_diagnostic::{Diagnostic, Severity, TextFault, Value};
use pathbuild_path::approx::{at_least, near};
use pathbuild_path::{Bindings, Origin, Path, PathName, Segment, SegmentKind, Subpath, SubpathName};
use regex::Regex;

use super::brief::{Brief, Head, head, summary};
use super::instance::{Instance, path};
use super::lookup::{Found, find_path, names_in};
use super::raw::NameKey;
use crate::database::Db;
use crate::settings::Settings;

/// A subpath segment and what came of it.
#[derive(Clone, Debug, PartialEq, salsa::SalsaValue)]
pub struct Embedding<'db> {
    /// Index into [`Path::segments`].
    pub segment: usize,
    /// Where the segment is drawn.
    pub origin: Origin,
    /// The path that it names, where it names one.
    pub name: Option<PathName>,
    /// What came of it.
    pub outcome: Outcome<'db>,
    /// What is doubtful about it.
    pub warnings: Vec<Diagnostic>,
}

/// What comes of a subpath segment, from the first error that stops it to the embedded path.
#[derive(Clone, Debug, PartialEq, salsa::SalsaValue)]
pub enum Outcome<'db> {
    /// It names no path, or one that may not be embedded: PB501, PB502, PB507.
    Refused(Diagnostic),
    /// The path is nowhere, or in several places: PB503, PB504.
    NotFound(Diagnostic),
    /// The values do not fit its variables: PB302 to PB304.
    Unbound(Vec<Diagnostic>),
    /// The path, and what does not fit: PB201, PB505, PB506, PB510.
    Found {
        /// The embedded path with its values.
        child: Instance<'db>,
        /// What does not fit.
        problems: Vec<Diagnostic>,
    },
}

/// A distance in mm by which a segment and the path it embeds may differ.
const CHORD_TOLERANCE: f64 = 0.001;

/// What a path embeds, segment by segment; not what those embed.
pub fn embeds<'db>(db: &'db dyn Db, instance: Instance<'db>) -> &'db [Embedding<'db>] {
    // Most paths embed nothing, and need not be asked for once more.
    let embeds_any = summary(db, instance).brief.as_ref().is_some_and(|brief| brief.has_subpaths);
    if embeds_any { embeddings(db, instance) } else { &[] }
}

#[salsa::tracked]
fn embeddings<'db>(db: &'db dyn Db, instance: Instance<'db>) -> Vec<Embedding<'db>> {
    let Some(outer) = &path(db, instance).path else { return Vec::new() };
    let embedder = Embedder { db, instance, outer };
    let subpaths = outer.segments.iter().enumerate().filter_map(|(index, segment)| match &segment.kind {
        SegmentKind::Subpath(subpath) => Some((index, segment, subpath)),
        _ => None,
    });
    subpaths.map(|(index, segment, subpath)| embedder.embedding(index, segment, subpath)).collect()
}

struct Embedder<'db> {
    db: &'db dyn Db,
    instance: Instance<'db>,
    outer: &'db Path,
}

impl<'db> Embedder<'db> {
    fn embedding(&self, index: usize, segment: &Segment, subpath: &Subpath) -> Embedding<'db> {
        let mut warnings = Vec::new();
        let outcome = match &subpath.name {
            SubpathName::Missing { text } => {
                let problem = Diagnostic::new(&messages::MISSING_NAME);
                Outcome::Refused(self.at(segment, problem, text.as_ref()))
            }
            SubpathName::Invalid { value, text } => {
                let pattern = Settings::get(self.db).language(self.db).path_pattern.as_str();
                let problem =
                    Diagnostic::new(&messages::INVALID_NAME).with("value", &**value).with("pattern", pattern);
                Outcome::Refused(self.at(segment, problem, Some(text)))
            }
            SubpathName::Found { name, text, has_more } => {
                warnings.extend(has_more.as_ref().map(|value| {
                    let mut warning = Diagnostic::new(&messages::MORE_THAN_NAME)
                        .with("value", &**value)
                        .with("name", name.as_str());
                    warning.severity = Severity::Warning;
                    self.at(segment, warning, Some(text))
                }));
                self.named(segment, subpath, name, text)
            }
        };
        let origin = self.outer.origin(segment);
        Embedding { segment: index, origin, name: segment.embedded_name().cloned(), outcome, warnings }
    }

    fn named(&self, segment: &Segment, subpath: &Subpath, name: &PathName, text: &TextFault) -> Outcome<'db> {
        if let Some(problem) = self.forbidden(name) {
            return Outcome::Refused(self.at(segment, problem, Some(text)));
        }
        let key = NameKey::of(self.db, name);
        let found = find_path(self.db, self.instance.file(self.db), key);
        match found.files.as_slice() {
            [] => Outcome::NotFound(self.at(segment, self.nowhere(name, &found), Some(text))),
            [file] => match head(self.db, *file, key) {
                Some(head) => {
                    self.bound(segment, subpath, head, Instance::new(self.db, *file, key, bindings(subpath)))
                }
                None => Outcome::NotFound(self.at(segment, self.nowhere(name, &found), Some(text))),
            },
            [first, second, ..] => {
                let problem = Diagnostic::new(&messages::DEFINED_TWICE)
                    .with("name", name.as_str())
                    .with("first", first.path(self.db).as_str())
                    .with("second", second.path(self.db).as_str());
                Outcome::NotFound(self.at(segment, problem, Some(text)))
            }
        }
    }

    /// Checks the values against the path's variables. A path whose drawing has errors is not asked for its variables.
    fn bound(&self, segment: &Segment, subpath: &Subpath, head: &Head, child: Instance<'db>) -> Outcome<'db> {
        let problems = if head.is_sound { self.binding_problems(segment, subpath, head) } else { Vec::new() };
        if !problems.is_empty() {
            return Outcome::Unbound(problems);
        }
        let problems = match &summary(self.db, child).brief {
            Some(inner) => self.misfits(segment, subpath, inner),
            None => Vec::new(),
        };
        Outcome::Found { child, problems }
    }

    fn forbidden(&self, name: &PathName) -> Option<Diagnostic> {
        let problem =
            |rule: &str| Diagnostic::new(&messages::FORBIDDEN).with("name", name.as_str()).with("rule", rule);
        if let Some(rule) = &self.outer.embeds_only {
            let allowed = Regex::new(rule).is_ok_and(|pattern| name.is_match(&pattern));
            return (!allowed).then(|| problem(rule));
        }
        let rules = Settings::get(self.db).restrictions(self.db);
        let rule = rules.iter().find(|rule| rule.concerns(&self.outer.name))?;
        (!rule.allows(name)).then(|| problem(rule.child.as_str()))
    }

    fn nowhere(&self, name: &PathName, found: &Found) -> Diagnostic {
        let directories: Value =
            found.directories.iter().map(|path| shown_directory(path.as_str())).collect();
        let files: Value = found.searched.iter().map(|file| file.path(self.db).as_str()).collect();
        let problem = Diagnostic::new(&messages::NOT_FOUND)
            .with("name", name.as_str())
            .with("directories", directories)
            .with("files", files);
        let near = near_names(name, names_in(self.db, &found.searched));
        if near.is_empty() {
            return problem;
        }
        problem.note(&messages::NEAR_NAMES, vec![("names", near.iter().map(PathName::as_str).collect())])
    }

    fn binding_problems(&self, segment: &Segment, subpath: &Subpath, head: &Head) -> Vec<Diagnostic> {
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
            let text = match &subpath.name {
                SubpathName::Found { text, .. } => Some(text),
                _ => None,
            };
            self.at(segment, problem, text)
        }));
        problems
    }

    /// What of T, O, M and the size differs between the segment and the path it embeds.
    fn misfits(&self, segment: &Segment, subpath: &Subpath, inner: &Brief) -> Vec<Diagnostic> {
        let fault =
            |letter| subpath.faults.iter().find(|(known, _)| *known == letter).map(|(_, fault)| fault);
        let differs = |letter: char, here: Value, there: Value| {
            let problem = Diagnostic::new(&messages::PARAMETER_DIFFERS)
                .with("letter", letter)
                .with("segment", here.render(pathbuild_diagnostic::Lang::En))
                .with("path", there.render(pathbuild_diagnostic::Lang::En))
                .with("name", inner.name.as_str());
            self.at(segment, problem, fault(letter))
        };
        let mut problems = Vec::new();
        match (&subpath.material, &inner.material) {
            (Some(here), Some(there)) if here != there => {
                problems.push(differs('M', (&**here).into(), (&**there).into()));
            }
            (Some(_), Some(_)) => {}
            (here, there) => {
                problems.extend(self.without_material(segment, here.is_none(), there.is_none(), inner));
            }
        }
        for (letter, here, there) in
            [('T', subpath.thickness, inner.thickness), ('O', subpath.tool, inner.tool)]
        {
            if !near(here, there) {
                problems.push(differs(letter, here.into(), there.into()));
            }
        }
        if !at_least(self.outer.thickness, subpath.thickness) {
            let problem = Diagnostic::new(&messages::T_BELOW)
                .with("path", self.outer.thickness)
                .with("segment", subpath.thickness);
            problems.push(self.at(segment, problem, fault('T')));
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
            (true, true) => format!("{} / {}", self.outer.name, inner.name),
            (true, false) => self.outer.name.to_string(),
            (false, true) => inner.name.to_string(),
            (false, false) => return None,
        };
        Some(self.at(segment, Diagnostic::new(&parameters::MISSING_MATERIAL).with("where", place), None))
    }

    fn at(&self, segment: &Segment, diagnostic: Diagnostic, text: Option<&TextFault>) -> Diagnostic {
        let diagnostic = self.outer.origin(segment).at(diagnostic.in_path(self.outer.name.as_str()));
        match text {
            Some(text) => diagnostic.with_text(text.clone()),
            None => diagnostic,
        }
    }
}

fn bindings(subpath: &Subpath) -> Bindings {
    Bindings::new(subpath.values.iter().filter_map(|given| Some((given.variable?, given.value.clone()))))
}

fn shown_directory(path: &str) -> &str {
    if path.is_empty() { "." } else { path }
}

/// Names that differ from a name by little: most like `8999.1P` for `8999.01P`.
pub(crate) fn near_names(name: &PathName, mut known: Vec<PathName>) -> Vec<PathName> {
    let plain = |name: &PathName| {
        let parts = name.folded();
        let parts = parts.split('.').map(|part| part.trim_start_matches('0').to_owned());
        parts.collect::<Vec<_>>().join(".")
    };
    let wanted = plain(name);
    known.retain(|other| distance(&wanted, &plain(other)) <= 1);
    known.sort();
    known.dedup();
    known.truncate(5);
    known
}

/// The edit distance of two names, as far as 2.
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    if a.len().abs_diff(b.len()) > 2 {
        return 3;
    }
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.iter().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}
