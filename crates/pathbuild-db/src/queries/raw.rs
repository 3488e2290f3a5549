//! Reads indexed drawings again for what the index does not contain: raw paths, the elements of texts, and places.

use std::sync::Arc;

use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, Point};
use pathbuild_dxf::Drawing;
use pathbuild_path::{
    AssignedText, Bindings, CaseSensitiveName, Combinations, Definition, PathName, Position, RawPath,
    SourceMap,
};

use crate::database::{Db, abandon_query, catch_bugs};
use crate::inputs::{Reading, Settings, SourceFile};
use crate::queries::index::{NameKey, file_index};
use crate::queries::reading::{Fingerprint, entities, read, read_entities};

/// Calls `work` with the bytes of an indexed drawing. If they no longer match the index, the drawing is marked as changed and the query abandoned.
/// `None` if the drawing cannot be read, which the index reports.
fn read_again<R>(db: &dyn Db, file: SourceFile, work: impl FnOnce(&[u8], &mut Drawing) -> R) -> Option<R> {
    let indexed = file_index(db, file).fingerprint();
    let result = read(db, file, |bytes, _, drawing| {
        (Some(Fingerprint::of(bytes)) == indexed).then(|| work(bytes, drawing))
    });
    match result {
        Ok(Some(result)) => Some(result),
        Err(_) if indexed.is_none() => None,
        Ok(None) | Err(_) => abandon_query(db, file),
    }
}

/// Reads the entities of an indexed drawing on some of its layers. Empty if it cannot be read.
pub(super) fn read_layers(db: &dyn Db, file: SourceFile, keep_layer: &dyn Fn(&str) -> bool) -> Drawing {
    read_layers_with_options(db, file, Settings::get(db).reading(db), keep_layer)
}

/// Like [`read_layers`], but with reading options other than those of the settings.
pub(super) fn read_layers_with_options(
    db: &dyn Db,
    file: SourceFile,
    reading: &Reading,
    keep_layer: &dyn Fn(&str) -> bool,
) -> Drawing {
    read_again(db, file, |bytes, _| entities(bytes, reading, keep_layer)).unwrap_or_default()
}

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
    /// The raw path, shared with the per-path query, so that either can be evicted alone.
    pub(super) raw: Arc<RawPath>,
    pub(super) map: SourceMap,
}

/// The place where a path is drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PathPlace {
    /// Name of the path, in the spelling of its layer.
    pub name: CaseSensitiveName,
    /// Name of the path's first layer.
    pub layer: Box<str>,
    /// Point of the path's start marker, or of its first element if it has none.
    pub point: Option<Point>,
    /// Position of `point` in the file.
    pub position: Option<Position>,
}

/// Reads the paths of an indexed drawing again, with all their elements. Empty if the drawing cannot be read or reading it panics, which the
/// index reports. Results are not compared, because lines and handles differ after any edit; only those used last are kept, which bounds memory.
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

/// Returns a raw path of a file, unaffected by edits of other paths.
#[salsa::tracked(returns(as_deref), lru = 256)]
pub(super) fn raw_path<'db>(db: &'db dyn Db, file: SourceFile, name: NameKey<'db>) -> Option<Arc<RawPath>> {
    let name = name.name(db);
    raw_file(db, file).entry(&name).map(|entry| Arc::clone(&entry.raw))
}

/// Returns a raw path, for clients outside of queries. It takes a plain name, since a name interned outside a query is never reclaimed.
fn raw_by_name<'db>(db: &'db dyn Db, file: SourceFile, name: &PathName) -> Option<&'db RawPath> {
    raw_file(db, file).entry(name).map(|entry| &*entry.raw)
}

/// Fills in the position of the element that a diagnostic of this path is about.
pub(super) fn locate_in(db: &dyn Db, file: SourceFile, path: &PathName, diagnostic: &mut Diagnostic) {
    if let Some(entry) = raw_file(db, file).entry(path) {
        entry.map.locate(diagnostic);
    }
}

/// Returns the place of a path; `None` if the file has no such path.
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

    /// Returns the raw paths, in order of first appearance.
    pub(super) fn paths(&self) -> impl Iterator<Item = &RawPath> {
        self.paths.iter().map(|entry| &*entry.raw)
    }

    pub(super) fn entry(&self, name: &PathName) -> Option<&PathEntry> {
        let found = self.by_name.binary_search_by(|path| self.paths[*path].raw.name.cmp(name));
        found.ok().map(|place| &self.paths[self.by_name[place]])
    }
}

/// Returns the texts of a drawing's paths with the element of each. The drawing is read again for that.
#[salsa::tracked]
pub fn assigned_texts(db: &dyn Db, file: SourceFile) -> Vec<AssignedText> {
    let language = Settings::get(db).language(db);
    let drawing = read_layers(db, file, &|layer| language.path_pattern.is_layer(layer));
    pathbuild_path::assigned_texts(&drawing, language)
}

/// Returns the combinations of a path's variable values, with a warning if there are more than `limit`. `None` for a path without variables or with
/// errors.
pub fn combinations(
    db: &dyn Db,
    file: SourceFile,
    name: &PathName,
    limit: usize,
) -> Option<(Vec<Bindings>, Option<Diagnostic>)> {
    let raw = raw_by_name(db, file, name).filter(|raw| raw.is_sound() && !raw.definitions.is_empty())?;
    let Combinations { chosen, all } = Combinations::new(&raw.definitions, limit);
    let is_truncated = (chosen.len() as u64) < all;
    let warning = || {
        let has_many_values = |definition: &Definition| definition.corner_values().len() > limit;
        let message = if raw.definitions.iter().any(has_many_values) {
            &messages::VALUES_CUT
        } else {
            &messages::COMBINATIONS_CUT
        };
        let warning = Diagnostic::new(message)
            .with("checked", chosen.len())
            .with("all", all)
            .in_path(raw.name.as_str())
            .in_file(file.path(db));
        match &raw.start {
            Some(start) => start.origin.at(warning),
            None => warning,
        }
    };
    let warning = is_truncated.then(warning);
    Some((chosen, warning))
}
