//! Reading drawings: a file to its raw paths.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use pathbuild_diagnostic::messages::files as messages;
use pathbuild_diagnostic::{Diagnostic, Point};
use pathbuild_dxf::Options;
use pathbuild_path::{PathName, Position, RawPath, SourceMap};

use super::survey::{SurveyedPath, surveyed};
use crate::database::Db;
use crate::inputs::SourceFile;
use crate::settings::{Reading, Settings};
use crate::system::ReadError;

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

/// The paths of a drawing with where their elements are in the file, and what is known of it as a whole.
pub(super) fn read(db: &dyn Db, file: SourceFile) -> (Vec<(RawPath, SourceMap)>, FileReport) {
    // Asked for first: it stands for the bytes that are read behind salsa's back.
    file.revision(db);
    let settings = Settings::get(db);
    let reading = settings.reading(db);
    let mut hash = None;
    let read = with_bytes(db, file, reading.file_size, |bytes| {
        // Of these bytes, not of what a second look would find: they are what is compiled.
        hash = reading.is_hashed.then(|| *blake3::hash(bytes).as_bytes());
        parse(bytes, reading, settings.language(db))
    });
    let read = read.unwrap_or_else(|error| Err(Box::new(unreadable(error, reading))));
    let raw = read
        .unwrap_or_else(|problem| pathbuild_path::RawFile { paths: Vec::new(), diagnostics: vec![*problem] });
    let in_this_file = |diagnostic: Diagnostic| diagnostic.in_file(file.path(db));
    let diagnostics = raw.diagnostics.into_iter().map(in_this_file).collect();
    (raw.paths, FileReport { diagnostics, hash })
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
    let name = PathName::new(name.folded(db));
    raw_file(db, file).entry(&name).map(|entry| Arc::clone(&entry.raw))
}

/// Whether a file defines a path: unchanged by edits of the path itself.
pub(super) fn defines(db: &dyn Db, file: SourceFile, name: &PathName) -> bool {
    path_names(db, file).contains(name)
}

/// A raw path of a file.
pub fn raw_path<'db>(db: &'db dyn Db, file: SourceFile, name: NameKey<'db>) -> Option<&'db RawPath> {
    let survey = surveyed(db, file);
    let kept = survey.and_then(|survey| survey.path(name.folded(db))).and_then(SurveyedPath::raw);
    kept.or_else(|| path_entry(db, file, name).as_deref())
}

/// Fills in where the element of a diagnostic of that path is in the file.
pub(super) fn position_of(db: &dyn Db, file: SourceFile, path: &PathName, diagnostic: &mut Diagnostic) {
    let survey = surveyed(db, file);
    let kept = survey.and_then(|survey| survey.path(path.as_str())).and_then(SurveyedPath::map);
    // Not through an interned name: this is asked from outside queries.
    if let Some(map) = kept.or_else(|| raw_file(db, file).entry(path).map(|entry| &entry.map)) {
        map.locate(diagnostic);
    }
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

thread_local! {
    /// Where drawings are read into, one after the other.
    static BYTES: Cell<Vec<u8>> = const { Cell::new(Vec::new()) };
}

/// As much memory is kept for the next drawing; few have more bytes.
const KEPT: usize = 1 << 20;

/// Works on the bytes of a drawing.
fn with_bytes<R>(
    db: &dyn Db,
    file: SourceFile,
    limit: u64,
    work: impl FnOnce(&[u8]) -> R,
) -> Result<R, ReadError> {
    let mut bytes = BYTES.take();
    let result = db.system().read_into(file.path(db), limit, &mut bytes).map(|()| work(&bytes));
    if bytes.capacity() <= KEPT {
        BYTES.set(bytes);
    }
    result
}

/// A panic in here is a bug that one file shows: it must not keep the others from being read.
fn parse(
    bytes: &[u8],
    reading: &Reading,
    language: &pathbuild_path::Language,
) -> Result<pathbuild_path::RawFile, Box<Diagnostic>> {
    let read = || {
        let options = Options {
            keep_layer: &|layer| language.path_pattern.is_layer(layer),
            units: reading.units,
            approximate_curves: reading.approximate_curves,
            max_entities: reading.entities,
            max_text: reading.text_length,
        };
        pathbuild_path::raw_file(&pathbuild_dxf::read(bytes, &options), language)
    };
    catch_unwind(AssertUnwindSafe(read)).map_err(|payload| Box::new(internal_error(&*payload)))
}

/// PB006 for a panic that is not salsa's own way of cancelling.
pub(crate) fn internal_error(payload: &(dyn std::any::Any + Send)) -> Diagnostic {
    let text = payload.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let reason = text.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_default();
    Diagnostic::new(&messages::INTERNAL).with("reason", reason)
}

fn unreadable(error: ReadError, reading: &Reading) -> Diagnostic {
    match error {
        ReadError::Missing => Diagnostic::new(&messages::MISSING),
        ReadError::IsDirectory => Diagnostic::new(&messages::IS_DIRECTORY),
        ReadError::Other(reason) => Diagnostic::new(&messages::UNREADABLE).with("reason", &*reason),
        ReadError::TooLarge { size } => Diagnostic::new(&messages::LIMIT)
            .with("what", format!("the file's size of {size} bytes"))
            .with("limit", format!("{} bytes", reading.file_size))
            .with("key", "file-size"),
    }
}

/// See [`bound`](super::bound).
pub(super) fn bound(db: &mut dyn Db, kept: usize) {
    raw_file::set_lru_capacity(db, kept);
    path_entry::set_lru_capacity(db, kept);
}
