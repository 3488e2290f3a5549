//! The raw paths of files, and what else was read from them.

use std::sync::Arc;

use pathbuild_diagnostic::{Diagnostic, Point};
use pathbuild_path::{PathName, Position, RawPath, SourceMap};

use super::reading::read;
use super::surveys::{SurveyedPath, surveyed};
use crate::database::Db;
use crate::inputs::SourceFile;

/// A path's name without regard to case, as a key.
#[salsa::interned(debug)]
pub struct NameKey<'db> {
    /// Upper case.
    #[returns(deref)]
    pub folded: Box<str>,
}

impl<'db> NameKey<'db> {
    /// The key of a name.
    pub fn of(db: &'db dyn Db, name: &PathName) -> Self {
        Self::new(db, name.folded().into_boxed_str())
    }

    /// The name.
    pub(super) fn name(self, db: &dyn Db) -> PathName {
        PathName::new(self.folded(db))
    }
}

/// What was read from a file.
#[derive(Clone, Debug)]
pub struct FileContents {
    /// In order of first appearance.
    paths: Vec<PathEntry>,
    /// Their numbers in the order of their names: a drawing may have as many paths as it has layers.
    by_name: Vec<usize>,
    report: FileReport,
}

/// A raw path, and beside it where its elements are in the file.
#[derive(Clone, Debug)]
struct PathEntry {
    /// Shared with whoever asks for the path, so that each may be dropped for itself.
    raw: Arc<RawPath>,
    map: SourceMap,
}

/// What is known of the file as a whole.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct FileReport {
    pub(super) diagnostics: Vec<Diagnostic>,
    /// Of its bytes, where the settings ask for it and it could be read.
    pub(super) hash: Option<[u8; 32]>,
}

/// Reads a drawing. Never the same as before: whoever asks goes through a query that takes out what it needs, and only those tell whether
/// that changed. What shifts lines and handles changes none of them.
#[salsa::tracked(no_eq, lru = 0)]
pub fn raw_file(db: &dyn Db, file: SourceFile) -> FileContents {
    let (paths, report) = read(db, file);
    let entry = |(raw, map)| PathEntry { raw: Arc::new(raw), map };
    FileContents::new(paths.into_iter().map(entry).collect(), report)
}

impl FileContents {
    fn new(paths: Vec<PathEntry>, report: FileReport) -> Self {
        let mut by_name: Vec<usize> = (0..paths.len()).collect();
        by_name.sort_by(|a, b| paths[*a].raw.name.cmp(&paths[*b].raw.name));
        Self { paths, by_name, report }
    }

    fn entry(&self, name: &PathName) -> Option<&PathEntry> {
        let found = self.by_name.binary_search_by(|path| self.paths[*path].raw.name.cmp(name));
        found.ok().map(|place| &self.paths[self.by_name[place]])
    }
}

/// The names of a file's paths, in order of first appearance: unchanged by edits that neither add nor remove a path.
pub fn path_names(db: &dyn Db, file: SourceFile) -> &[PathName] {
    match surveyed(db, file) {
        Some(survey) => survey.names(),
        None => query::path_names(db, file),
    }
}

/// What is known of a file as a whole: unchanged by edits of its paths.
fn file_report(db: &dyn Db, file: SourceFile) -> &FileReport {
    match surveyed(db, file) {
        Some(survey) => survey.report(),
        None => query::file_report(db, file),
    }
}

/// As they are asked where drawings are not surveyed.
mod query {
    use pathbuild_path::PathName;

    use super::{FileReport, raw_file};
    use crate::database::Db;
    use crate::inputs::SourceFile;

    #[salsa::tracked]
    pub(super) fn path_names(db: &dyn Db, file: SourceFile) -> Vec<PathName> {
        raw_file(db, file).paths.iter().map(|entry| entry.raw.name.clone()).collect()
    }

    #[salsa::tracked]
    pub(super) fn file_report(db: &dyn Db, file: SourceFile) -> FileReport {
        raw_file(db, file).report.clone()
    }
}

/// A path of a file: unchanged by edits of its siblings.
#[salsa::tracked(lru = 0)]
fn path_entry<'db>(db: &'db dyn Db, file: SourceFile, name: NameKey<'db>) -> Option<Arc<RawPath>> {
    let name = name.name(db);
    raw_file(db, file).entry(&name).map(|entry| Arc::clone(&entry.raw))
}

/// Whether a file defines a path: unchanged by edits of the path itself.
pub(super) fn defines(db: &dyn Db, file: SourceFile, name: &PathName) -> bool {
    path_names(db, file).contains(name)
}

/// A raw path of a file.
pub fn raw_path<'db>(db: &'db dyn Db, file: SourceFile, name: NameKey<'db>) -> Option<&'db RawPath> {
    let survey = surveyed(db, file);
    let kept = survey.and_then(|survey| survey.path(&name.name(db))).and_then(SurveyedPath::raw);
    kept.or_else(|| path_entry(db, file, name).as_deref())
}

/// Fills in where the element of a diagnostic of that path is in the file.
pub(super) fn position_of(db: &dyn Db, file: SourceFile, path: &PathName, diagnostic: &mut Diagnostic) {
    let survey = surveyed(db, file);
    let kept = survey.and_then(|survey| survey.path(path)).and_then(SurveyedPath::map);
    // Not through an interned name: this is asked from outside queries.
    if let Some(map) = kept.or_else(|| raw_file(db, file).entry(path).map(|entry| &entry.map)) {
        map.locate(diagnostic);
    }
}

/// Whether anything in a drawing refers to other paths. (Not kept: it is asked once, before anything else.)
pub fn has_subpaths(db: &dyn Db, file: SourceFile) -> bool {
    raw_file(db, file).paths.iter().any(|entry| entry.raw.has_subpaths())
}

/// Where a path is drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PathPlace {
    /// The path, as its layer spells it.
    pub name: PathName,
    /// The first of its layers.
    pub layer: Box<str>,
    /// Its start marker, or its first element where it has none.
    pub point: Option<Point>,
    /// Where that is in the file.
    pub position: Option<Position>,
}

/// A raw path of a file, for whoever asks by name from outside. (Not through an interned name, which nobody would reclaim there.)
pub(super) fn raw_by_name<'db>(db: &'db dyn Db, file: SourceFile, name: &PathName) -> Option<&'db RawPath> {
    raw_file(db, file).entry(name).map(|entry| &*entry.raw)
}

/// Where a path of a file is drawn; `None` when the file has no such path.
pub fn path_place(db: &dyn Db, file: SourceFile, name: &PathName) -> Option<PathPlace> {
    let entry = raw_file(db, file).entry(name)?;
    let raw = &*entry.raw;
    let start = raw.start.as_ref().map(|start| start.origin.clone());
    let origin = start.or_else(|| raw.drawn.elements.first().map(|element| raw.drawn.origin(element)));
    Some(PathPlace {
        name: raw.name.clone(),
        layer: raw.layer().into(),
        point: origin.as_ref().map(|origin| origin.point),
        position: origin.and_then(|origin| entry.map.positions().get(origin.id.0 as usize).copied()),
    })
}

/// What is wrong with the file as a whole.
pub(super) fn file_diagnostics(db: &dyn Db, file: SourceFile) -> &[Diagnostic] {
    &file_report(db, file).diagnostics
}

/// The hash of the bytes that a file's paths were read from; `None` where it could not be read, or the settings do not ask for hashes.
pub fn content_hash(db: &dyn Db, file: SourceFile) -> Option<[u8; 32]> {
    file_report(db, file).hash
}

/// See [`bound`](super::bound).
pub(super) fn bound(db: &mut dyn Db, kept: usize) {
    raw_file::set_lru_capacity(db, kept);
    path_entry::set_lru_capacity(db, kept);
}
