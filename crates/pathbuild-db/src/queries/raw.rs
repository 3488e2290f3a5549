//! The raw paths of files, and where they are drawn.

use std::sync::Arc;

use pathbuild_diagnostic::{Diagnostic, Point};
use pathbuild_path::{PathName, Position, RawPath, SourceMap, SpeltName};

use super::index::NameKey;
use super::reading::read_entities;
use super::rereading::read_again;
use crate::bugs::catch_bugs;
use crate::db::Db;
use crate::inputs::SourceFile;
use crate::settings::Settings;

/// What was read from a file.
#[derive(Clone, Debug, Default)]
pub struct FileContents {
    /// In order of first appearance.
    paths: Vec<PathEntry>,
    /// Their numbers in the order of their names: a drawing may have as many paths as it has layers.
    by_name: Vec<usize>,
}

/// A raw path, and beside it where its elements are in the file.
#[derive(Clone, Debug)]
pub(super) struct PathEntry {
    /// Shared with whoever asks for the path, so that each may be dropped for itself.
    pub(super) raw: Arc<RawPath>,
    pub(super) map: SourceMap,
}

/// Where a path is drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PathPlace {
    /// The path, as its layer spells it.
    pub name: SpeltName,
    /// The first of its layers.
    pub layer: Box<str>,
    /// Its start marker, or its first element where it has none.
    pub point: Option<Point>,
    /// Where that is in the file.
    pub position: Option<Position>,
}

/// Reads an indexed drawing again, for all that is drawn. Empty where it cannot be read, or shows a bug: its index says so. Never the same as
/// before an edit, which changes lines and handles at least. Few are kept.
#[salsa::tracked(no_eq, lru = 256)]
pub fn raw_file(db: &dyn Db, file: SourceFile) -> FileContents {
    let settings = Settings::get(db);
    let (reading, language) = (settings.reading(db), settings.language(db));
    let read = read_again(db, file, |bytes, drawing| {
        catch_bugs(|| {
            read_entities(bytes, drawing, reading, &|layer| language.path_pattern.is_layer(layer));
            pathbuild_path::raw_file(drawing, language)
        })
    });
    let raw = read.and_then(Result::ok).unwrap_or_default();
    let entry = |(raw, map)| PathEntry { raw: Arc::new(raw), map };
    FileContents::new(raw.paths.into_iter().map(entry).collect())
}

/// A path of a file: unchanged by edits of other paths in the file.
#[salsa::tracked(returns(as_deref), lru = 256)]
pub(super) fn raw_path<'db>(db: &'db dyn Db, file: SourceFile, name: NameKey<'db>) -> Option<Arc<RawPath>> {
    let name = name.name(db);
    raw_file(db, file).entry(&name).map(|entry| Arc::clone(&entry.raw))
}

/// The same for whoever asks from outside. (Not through an interned name, which nobody would reclaim there.)
pub(super) fn raw_by_name<'db>(db: &'db dyn Db, file: SourceFile, name: &PathName) -> Option<&'db RawPath> {
    raw_file(db, file).entry(name).map(|entry| &*entry.raw)
}

/// Fills in where the element of a diagnostic of that path is in the file.
pub(super) fn locate_in(db: &dyn Db, file: SourceFile, path: &PathName, diagnostic: &mut Diagnostic) {
    if let Some(entry) = raw_file(db, file).entry(path) {
        entry.map.locate(diagnostic);
    }
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

impl FileContents {
    fn new(paths: Vec<PathEntry>) -> Self {
        let mut by_name: Vec<usize> = (0..paths.len()).collect();
        by_name.sort_by(|a, b| paths[*a].raw.name.cmp(&paths[*b].raw.name));
        Self { paths, by_name }
    }

    /// The raw paths, in order of first appearance.
    pub(super) fn paths(&self) -> impl Iterator<Item = &RawPath> {
        self.paths.iter().map(|entry| &*entry.raw)
    }

    pub(super) fn entry(&self, name: &PathName) -> Option<&PathEntry> {
        let found = self.by_name.binary_search_by(|path| self.paths[*path].raw.name.cmp(name));
        found.ok().map(|place| &self.paths[self.by_name[place]])
    }
}
