//! What this run itself read from files and directories, to be compared with cached facts.

use std::collections::{HashMap, HashSet};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::DirectoryFact;
use pathbuild_db::{Database, Db, SourceFile, content, drawing_names};
use pathbuild_files::Stamp;

use super::FreshResult;
use crate::session::Session;

/// Files and directories that the run accessed.
pub(super) struct RunFacts<'a> {
    db: &'a Database,
    /// The drawings that were read; `None` for one that could not be read or that changed during the run.
    read: HashMap<Utf8PathBuf, Option<Content>>,
    /// The directories in which lookups were made.
    searched: HashSet<&'a Utf8Path>,
    /// The files that were written or compared.
    written: HashSet<&'a Utf8Path>,
}

/// Hash of a file's bytes, and the stamp under which they were read.
pub(super) type Content = ([u8; 32], Stamp);

impl<'a> RunFacts<'a> {
    pub(super) fn new(session: &'a Session<'a>, fresh: &'a [FreshResult]) -> Self {
        let db = session.db();
        let traces = || fresh.iter().flat_map(|fresh| &fresh.traces);
        let read = traces().flat_map(|trace| &trace.files);
        let searched = traces().flat_map(|trace| &trace.lookups).flat_map(|lookup| &lookup.directories);
        Self {
            db,
            read: read.map(|file| (file.path(db).clone(), steady_content(db, *file))).collect(),
            searched: searched.map(|directory| &**directory).collect(),
            written: fresh.iter().flat_map(|fresh| &fresh.outputs).map(|output| &*output.path).collect(),
        }
    }

    /// Content that was read from a drawing.
    pub(super) fn content(&self, path: &Utf8Path) -> Option<Content> {
        self.read.get(path).copied().flatten()
    }

    /// Whether the bytes read from a drawing have a different hash.
    pub(super) fn is_other(&self, path: &Utf8Path, hash: Option<[u8; 32]>) -> bool {
        self.read.get(path).is_some_and(|content| content.map(|(read, _)| read) != hash)
    }

    /// Whether a file was written or compared.
    pub(super) fn has_written(&self, path: &Utf8Path) -> bool {
        self.written.contains(path)
    }

    /// Whether the database saw the same names in a directory, if it made lookups there.
    pub(super) fn agrees(&self, fact: &DirectoryFact) -> bool {
        if !self.searched.contains(&*fact.path) {
            return true;
        }
        let mut names: Vec<&str> = drawing_names(self.db, self.db.directory(&fact.path)).iter().collect();
        names.sort_unstable();
        names.into_iter().eq(fact.names.iter())
    }
}

/// Content of a drawing, if it did not change during the run.
fn steady_content(db: &Database, file: SourceFile) -> Option<Content> {
    content(db, file).filter(|_| !db.has_drifted(file))
}
