//! The interface of queries to the database.

use camino::Utf8Path;

use crate::inputs::{Directory, SourceFile};
use crate::scratch::ScratchPool;
use crate::system::{Names, System};

/// The interface of queries to the database.
#[salsa::db]
pub trait Db: salsa::Database {
    /// The outside world.
    fn system(&self) -> &dyn System;

    /// The input of a file, which need not exist. The path must be normalised.
    fn file(&self, path: &Utf8Path) -> SourceFile;

    /// The input of a directory, which need not exist. The path must be normalised.
    fn directory(&self, path: &Utf8Path) -> Directory;

    /// The names in a directory that was listed in advance; waits for a listing in progress. `None` if the directory has yet to be listed.
    fn listed(&self, directory: Directory) -> Option<Names>;

    /// Records that a file's bytes no longer match its index.
    fn note_changed(&self, file: SourceFile);

    /// Scratch buffers for reading drawings.
    fn scratch(&self) -> &ScratchPool;
}
