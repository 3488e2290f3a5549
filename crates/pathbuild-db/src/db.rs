//! What queries may ask besides each other.

use camino::Utf8Path;

use crate::inputs::{Directory, SourceFile};
use crate::scratch::ScratchPool;
use crate::system::{Names, System};

/// What queries may ask besides each other.
#[salsa::db]
pub trait Db: salsa::Database {
    /// The outside world.
    fn system(&self) -> &dyn System;

    /// The input that stands for a file, there or not. The path must be normalised.
    fn file(&self, path: &Utf8Path) -> SourceFile;

    /// The input that stands for a directory, there or not. The path must be normalised.
    fn directory(&self, path: &Utf8Path) -> Directory;

    /// The names in a directory that was listed before a query wanted them; waits for a listing that is under way. `None` where the
    /// directory must be listed now.
    fn listed(&self, directory: Directory) -> Option<Names>;

    /// Notes that a file has other bytes than those that its index was made from.
    fn note_changed(&self, file: SourceFile);

    /// Memory for reading drawings.
    fn scratch(&self) -> &ScratchPool;
}
