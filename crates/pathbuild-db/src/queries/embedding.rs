//! What a path embeds: every subpath segment with the path it names, checked against each other.
//! (spec/50-path-building.md, "Subpaths"; the order of errors: spec/80-diagnostics.md)

use pathbuild_diagnostic::messages::subpaths as messages;
use pathbuild_diagnostic::{Diagnostic, Severity, Value};
use pathbuild_path::{Origin, PathName, Segment, SegmentKind, Subpath, SubpathName};

use super::brief::{Head, head, summary};
use super::fit::{Outer, bindings};
use super::instance::{Instance, bound_path};
use super::lookup::{Found, find_path, names_in};
use super::raw::NameKey;
use crate::database::Db;
use crate::settings::Settings;

/// A subpath segment and what came of it.
#[derive(Clone, Debug, PartialEq, salsa::SalsaValue)]
pub struct Embedding<'db> {
    /// Index into [`Path::segments`](pathbuild_path::Path::segments).
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

/// What a path embeds, segment by segment; not what those embed.
pub fn embeds<'db>(db: &'db dyn Db, instance: Instance<'db>) -> &'db [Embedding<'db>] {
    // Most paths embed nothing, and need not be asked for once more.
    let embeds_any = summary(db, instance).brief.as_ref().is_some_and(|brief| brief.has_subpaths);
    if embeds_any { embeddings(db, instance) } else { &[] }
}

#[salsa::tracked]
fn embeddings<'db>(db: &'db dyn Db, instance: Instance<'db>) -> Vec<Embedding<'db>> {
    let Some(path) = bound_path(db, instance) else { return Vec::new() };
    let embedder = Embedder { db, instance, outer: Outer { db, path } };
    let subpaths = path.segments.iter().enumerate().filter_map(|(index, segment)| match &segment.kind {
        SegmentKind::Subpath(subpath) => Some((index, segment, subpath)),
        _ => None,
    });
    subpaths.map(|(index, segment, subpath)| embedder.embedding(index, segment, subpath)).collect()
}

struct Embedder<'db> {
    db: &'db dyn Db,
    instance: Instance<'db>,
    outer: Outer<'db>,
}

impl<'db> Embedder<'db> {
    fn embedding(&self, index: usize, segment: &Segment, subpath: &Subpath) -> Embedding<'db> {
        let mut warnings = Vec::new();
        let outcome = match &subpath.name {
            SubpathName::Missing { text } => {
                let problem = Diagnostic::new(&messages::MISSING_NAME);
                Outcome::Refused(self.outer.at(segment, problem, text.as_ref()))
            }
            SubpathName::Invalid { value } => {
                let pattern = Settings::get(self.db).language(self.db).path_pattern.as_str();
                let problem =
                    Diagnostic::new(&messages::INVALID_NAME).with("value", &**value).with("pattern", pattern);
                Outcome::Refused(self.outer.at_name(segment, subpath, problem))
            }
            SubpathName::Found { name, has_more } => {
                warnings.extend(has_more.as_ref().map(|value| {
                    let mut warning = Diagnostic::new(&messages::MORE_THAN_NAME)
                        .with("value", &**value)
                        .with("name", name.as_str());
                    warning.severity = Severity::Warning;
                    self.outer.at_name(segment, subpath, warning)
                }));
                self.named(segment, subpath, name)
            }
        };
        let origin = self.outer.path.origin(segment);
        Embedding { segment: index, origin, name: segment.embedded_name().cloned(), outcome, warnings }
    }

    fn named(&self, segment: &Segment, subpath: &Subpath, name: &PathName) -> Outcome<'db> {
        if let Some(problem) = self.outer.forbidden(name) {
            return Outcome::Refused(self.outer.at_name(segment, subpath, problem));
        }
        let key = NameKey::of(self.db, name);
        let found = find_path(self.db, self.instance.file(self.db), key);
        match found.files.as_slice() {
            [] => Outcome::NotFound(self.outer.at_name(segment, subpath, self.nowhere(name, &found))),
            [file] => match head(self.db, *file, key) {
                Some(head) => {
                    self.bound(segment, subpath, head, Instance::new(self.db, *file, key, bindings(subpath)))
                }
                None => Outcome::NotFound(self.outer.at_name(segment, subpath, self.nowhere(name, &found))),
            },
            [first, second, ..] => {
                let problem = Diagnostic::new(&messages::DEFINED_TWICE)
                    .with("name", name.as_str())
                    .with("first", first.path(self.db).as_str())
                    .with("second", second.path(self.db).as_str());
                Outcome::NotFound(self.outer.at_name(segment, subpath, problem))
            }
        }
    }

    /// Checks the values against the path's variables. A path whose drawing has errors is not asked for its variables.
    fn bound(&self, segment: &Segment, subpath: &Subpath, head: &Head, child: Instance<'db>) -> Outcome<'db> {
        let problems =
            if head.is_sound { self.outer.binding_problems(segment, subpath, head) } else { Vec::new() };
        if !problems.is_empty() {
            return Outcome::Unbound(problems);
        }
        let problems = match &summary(self.db, child).brief {
            Some(inner) => self.outer.misfits(segment, subpath, inner),
            None => Vec::new(),
        };
        Outcome::Found { child, problems }
    }

    fn nowhere(&self, name: &PathName, found: &Found) -> Diagnostic {
        let directories: Value = found
            .directories
            .iter()
            .map(|directory| shown_directory(directory.path(self.db).as_str()))
            .collect();
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
