//! Paths with bound variables, and the direct embeddings of each: every subpath segment with the path that it names, checked against each
//! other. (book: language/embedding; the order of errors: book: reference/diagnostics)

use pathbuild_diagnostic::messages::drawing;
use pathbuild_diagnostic::{Code, Diagnostic, Value};
use pathbuild_path::{
    Bindings, CaseSensitiveName, Origin, PathName, PathSignature, SubpathCall, SubpathChecker, SubpathName,
    WalkedPath,
};

use crate::database::Db;
use crate::inputs::{Settings, SourceFile};
use crate::queries::index::{
    BindResult, NameKey, PathSummary, bind, file_index, path_index, walk_within_limit,
};
use crate::queries::lookup::{ResolvedPath, find_path, own_directory, search_path};
use crate::queries::nearby_ends::LayerHints;
use crate::queries::raw::{raw_path, read_layers};

/// A subpath segment and the result of resolving it.
#[derive(Clone, Debug, PartialEq, salsa::SalsaValue)]
pub struct Embedding<'db> {
    /// Index of the segment in [`Path::segments`](pathbuild_path::Path::segments).
    pub segment: usize,
    /// The element that draws the segment.
    pub origin: Origin,
    /// The name of the embedded path, if the segment has one.
    pub name: Option<CaseSensitiveName>,
    /// The embedded path, or the first error that prevents embedding it.
    pub outcome: Outcome<'db>,
    /// Warnings about the segment.
    pub warnings: Vec<Diagnostic>,
}

/// The result of resolving a subpath segment: the first error that stops it, or the embedded path.
#[derive(Clone, Debug, PartialEq, salsa::SalsaValue)]
pub enum Outcome<'db> {
    /// The segment has no name, or names a path that must not be embedded: PB501, PB502, PB507.
    Refused(Diagnostic),
    /// The path may be in a directory that cannot be listed, or in a drawing with errors that hide its paths: PB001, PB113, with PB511.
    Unread(Vec<Diagnostic>),
    /// The path was found nowhere, or in several files: PB503, PB504.
    NotFound(Diagnostic),
    /// The values do not fit the variables of the path: PB302 to PB304.
    Unbound(Vec<Diagnostic>),
    /// The path was found; the problems are PB201, PB505, PB506 and PB510.
    Found {
        /// The embedded path with its values.
        child: Instance<'db>,
        /// Mismatches between the segment and the path.
        problems: Vec<Diagnostic>,
    },
}

/// Returns the direct embeddings of a path, in the order of its segments.
pub fn direct_embeddings<'db>(db: &'db dyn Db, instance: Instance<'db>) -> &'db [Embedding<'db>] {
    // Most paths embed nothing; no query is needed for them.
    if summary(db, instance).has_subpaths() { embeddings(db, instance) } else { &[] }
}

/// Whether a finding says that a segment embeds a path once more (PB121), although the segment does not fit that path (PB505).
pub(super) fn is_about_misfit<'db>(db: &'db dyn Db, instance: Instance<'db>, found: &Diagnostic) -> bool {
    let is_misfit = |embedding: &Embedding<'db>| match &embedding.outcome {
        Outcome::Found { problems, .. } => problems
            .iter()
            .any(|problem| problem.code() == Code::SubpathSizeDiffers && problem.place == found.place),
        _ => false,
    };
    found.message == &drawing::SUBPATH_TWICE && direct_embeddings(db, instance).iter().any(is_misfit)
}

#[salsa::tracked]
fn embeddings<'db>(db: &'db dyn Db, instance: Instance<'db>) -> Vec<Embedding<'db>> {
    let Some(outer) = summary(db, instance).known_signature() else { return Vec::new() };
    let settings = Settings::get(db);
    let checker = SubpathChecker::new(
        outer,
        settings.restrictions(db),
        settings.language(db),
        settings.reading(db).compatible,
    );
    let read_all = || read_layers(db, instance.file(db), &|_| true);
    let embedder =
        EmbeddingResolver { db, file: instance.file(db), checker, hints: LayerHints::new(&read_all) };
    outer.subpaths.iter().map(|call| embedder.embedding(call)).collect()
}

struct EmbeddingResolver<'a, 'db> {
    db: &'db dyn Db,
    /// The drawing of the embedding path.
    file: SourceFile,
    checker: SubpathChecker<'db>,
    hints: LayerHints<'a>,
}

impl<'db> EmbeddingResolver<'_, 'db> {
    fn embedding(&self, call: &SubpathCall) -> Embedding<'db> {
        let name = match &call.subpath.name {
            SubpathName::Found { name, .. } => Some(name.clone()),
            SubpathName::Missing { .. } | SubpathName::Invalid { .. } => None,
        };
        let outcome = match self.checker.name(call) {
            Ok(name) => self.resolve_name(call, name),
            Err(problem) => Outcome::Refused(
                self.hints.with_name_hint(Settings::get(self.db).language(self.db), *problem),
            ),
        };
        let warnings = self.checker.warnings(call);
        Embedding { segment: call.segment, origin: call.origin.clone(), name, outcome, warnings }
    }

    fn resolve_name(&self, call: &SubpathCall, name: &PathName) -> Outcome<'db> {
        let key = NameKey::of(self.db, name);
        let resolved = find_path(self.db, self.file, key);
        match resolved.files.as_slice() {
            _ if !resolved.unlisted.is_empty() => Outcome::Unread(resolved.unlisted.clone()),
            [] => match self.unreadable_errors(call, name, &resolved) {
                Some(problems) => Outcome::Unread(problems),
                None => Outcome::NotFound(self.not_found_error(call, name, &resolved)),
            },
            [file] => self.bind_values(call, *file, key),
            [first, second, ..] => {
                let [first, second] = [first, second].map(|file| file.path(self.db).as_str());
                Outcome::NotFound(self.checker.defined_twice_problem(call, name, first, second))
            }
        }
    }

    /// Returns the errors of the only drawing that may define the path according to file names, if they hide all of that drawing's paths. The last
    /// diagnostic says that the drawing has errors.
    fn unreadable_errors(
        &self,
        call: &SubpathCall,
        name: &PathName,
        resolved: &ResolvedPath,
    ) -> Option<Vec<Diagnostic>> {
        let [file] = resolved.searched[..] else { return None };
        let index = file_index(self.db, file);
        let path = file.path(self.db);
        let errors = index.diagnostics().iter().filter(|found| found.is_error());
        let mut problems: Vec<Diagnostic> = errors.map(|error| error.clone().in_file(path)).collect();
        if problems.is_empty() || !index.names().is_empty() {
            return None;
        }
        problems.push(self.checker.hidden_by_errors_problem(call, name, path.as_str()));
        Some(problems)
    }

    fn not_found_error(&self, call: &SubpathCall, name: &PathName, resolved: &ResolvedPath) -> Diagnostic {
        let directories = search_path(self.db, own_directory(self.db, self.file)).iter();
        let directories: Value =
            directories.map(|directory| displayed_directory(directory.path(self.db).as_str())).collect();
        let files: Value = resolved.searched.iter().map(|file| file.path(self.db).as_str()).collect();
        let known = resolved.searched.iter().flat_map(|file| file_index(self.db, *file).names());
        self.checker.not_found_problem(call, name, directories, files, known.cloned().collect())
    }

    /// Checks the values of a segment against the variables of the path that it embeds, then the segment against the path.
    fn bind_values(&self, call: &SubpathCall, file: SourceFile, name: NameKey<'db>) -> Outcome<'db> {
        let problems = path_index(self.db, file, name)
            .as_ref()
            .map(|inner| self.checker.binding_problems(call, &inner.header))
            .unwrap_or_default();
        if !problems.is_empty() {
            return Outcome::Unbound(problems);
        }
        let child = Instance::new(self.db, file, name, call.bindings());
        let inner: Option<&PathSignature> = summary(self.db, child).signature.as_ref();
        let problems = inner.map(|inner| self.checker.mismatches(call, inner)).unwrap_or_default();
        Outcome::Found { child, problems }
    }
}

fn displayed_directory(directory: &str) -> &str {
    if directory.is_empty() { "." } else { directory }
}

/// A path of a file with values for its variables. Created inside queries only.
#[salsa::interned(debug)]
pub struct Instance<'db> {
    /// The drawing that defines the path.
    #[returns(copy)]
    pub file: SourceFile,
    /// The name of the path, folded for comparison.
    #[returns(copy)]
    pub name: NameKey<'db>,
    /// The values of the path's variables.
    #[returns(ref)]
    pub bindings: Bindings,
}

/// Returns the summary of a path. The summary with example values is part of the drawing's index.
pub fn summary<'db>(db: &'db dyn Db, instance: Instance<'db>) -> &'db PathSummary {
    match path_index(db, instance.file(db), instance.name(db)) {
        Some(index) if index.examples == *instance.bindings(db) => &index.summary,
        _ => summary_with_values(db, instance),
    }
}

#[salsa::tracked]
fn summary_with_values<'db>(db: &'db dyn Db, instance: Instance<'db>) -> PathSummary {
    let file = instance.file(db);
    let Some(raw) = raw_path(db, file, instance.name(db)) else { return PathSummary::default() };
    let read_all = || read_layers(db, file, &|_| true);
    PathSummary::new(db, raw, instance.bindings(db), &LayerHints::new(&read_all), &mut |_, _| {})
}

/// Returns the bound and checked path. Only programs need it, so few are kept.
#[salsa::tracked(lru = 256)]
pub fn path<'db>(db: &'db dyn Db, instance: Instance<'db>) -> BindResult {
    let language = Settings::get(db).language(db);
    let raw = raw_path(db, instance.file(db), instance.name(db));
    raw.map(|raw| bind(raw, instance.bindings(db), language)).unwrap_or_default()
}

/// Returns the result of walking a path, for its program. Empty for a path with errors. Few are kept.
#[salsa::tracked(lru = 256)]
pub fn chains<'db>(db: &'db dyn Db, instance: Instance<'db>) -> WalkedPath {
    let language = Settings::get(db).language(db);
    path(db, instance).path.as_ref().map(|path| walk_within_limit(db, path, language)).unwrap_or_default()
}
