//! Raw paths of files and their places.

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

/// The raw paths of a file.
#[derive(Clone, Debug, Default)]
pub struct FileContents {
    /// Paths in order of first appearance.
    paths: Vec<PathEntry>,
    /// Indices sorted by name, since a drawing may have as many paths as layers.
    by_name: Vec<usize>,
}

/// A raw path and the source map of its elements.
#[derive(Clone, Debug)]
pub(super) struct PathEntry {
    /// Shared with the per-path query, so that either can be evicted alone.
    pub(super) raw: Arc<RawPath>,
    pub(super) map: SourceMap,
}

/// The place of a path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PathPlace {
    /// The name as spelt by its layer.
    pub name: SpeltName,
    /// The first of its layers.
    pub layer: Box<str>,
    /// Its start marker, or its first element if it has none.
    pub point: Option<Point>,
    /// The position of that point in the file.
    pub position: Option<Position>,
}

/// Reads an indexed drawing again, with everything drawn. Empty if it cannot be read or panics, which the index reports. Lines and handles
/// differ after any edit, so comparing results is pointless. Few are kept.
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

/// A raw path of a file, unaffected by edits of other paths.
#[salsa::tracked(returns(as_deref), lru = 256)]
pub(super) fn raw_path<'db>(db: &'db dyn Db, file: SourceFile, name: NameKey<'db>) -> Option<Arc<RawPath>> {
    let name = name.name(db);
    raw_file(db, file).entry(&name).map(|entry| Arc::clone(&entry.raw))
}

/// A raw path, for clients outside of queries. It takes a plain name, since a name interned outside a query is never reclaimed.
pub(super) fn raw_by_name<'db>(db: &'db dyn Db, file: SourceFile, name: &PathName) -> Option<&'db RawPath> {
    raw_file(db, file).entry(name).map(|entry| &*entry.raw)
}

/// Fills in the position of the element that a diagnostic of this path is about.
pub(super) fn locate_in(db: &dyn Db, file: SourceFile, path: &PathName, diagnostic: &mut Diagnostic) {
    if let Some(entry) = raw_file(db, file).entry(path) {
        entry.map.locate(diagnostic);
    }
}

/// The place of a path; `None` if the file has no such path.
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
