//! Facts about drawings by themselves, from the cache or from the drawings.

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{Db, SourceFile, check_file, path_names};

use super::{DrawingResult, Session};

/// Drawings, each with the names of its paths and its own diagnostics.
#[derive(Debug, Default)]
pub(crate) struct Drawings(Vec<Drawing>);

/// A drawing with the names of its paths and its own diagnostics.
#[derive(Debug)]
pub(crate) struct Drawing {
    pub(crate) path: Utf8PathBuf,
    pub(crate) result: DrawingResult,
    /// Whether this run read it instead of taking it from the cache.
    pub(crate) is_read: bool,
}

impl Drawings {
    /// Reads the drawings that are not cached.
    pub(crate) fn new(
        session: &Session<'_>,
        paths: Vec<Utf8PathBuf>,
        known: impl Fn(&Utf8Path) -> Option<DrawingResult>,
    ) -> Self {
        let db = session.db();
        let known: Vec<Option<DrawingResult>> = paths.iter().map(|path| known(path)).collect();
        let open = || paths.iter().zip(&known).filter(|(_, known)| known.is_none()).map(|(path, _)| path);
        let files: Vec<SourceFile> = db.files(open().cloned().collect());
        session.parse_ahead(&files);
        let read = |path: &Utf8Path| {
            let file = db.file(path);
            let (names, diagnostics) = (path_names(db, file).to_vec(), check_file(db, file).to_vec());
            DrawingResult { names, diagnostics }
        };
        let drawing = |(path, known): (Utf8PathBuf, Option<DrawingResult>)| {
            let is_read = known.is_none();
            Drawing { result: known.unwrap_or_else(|| read(&path)), path, is_read }
        };
        Self(paths.into_iter().zip(known).map(drawing).collect())
    }

    /// All drawings.
    pub(crate) fn iter(&self) -> impl ExactSizeIterator<Item = &Drawing> {
        self.0.iter()
    }

    /// Finds a drawing. The drawings must have been given in order of name.
    pub(crate) fn get(&self, path: &Utf8Path) -> Option<&Drawing> {
        let place = self.0.binary_search_by(|drawing| drawing.path.as_str().cmp(path.as_str()));
        place.ok().map(|place| &self.0[place])
    }
}
