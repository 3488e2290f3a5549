//! The interface of queries to the database, and the scratch buffers that they share.

use std::fmt;
use std::sync::{Mutex, PoisonError};

use camino::Utf8Path;
use pathbuild_dxf::Drawing;

use crate::inputs::{Directory, SourceFile};
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

/// Buffers for one drawing.
#[derive(Default)]
pub(crate) struct Scratch {
    /// The bytes of the file.
    pub(crate) bytes: Vec<u8>,
    /// The parsed drawing.
    pub(crate) drawing: Drawing,
}

/// Scratch buffers that are not in use.
#[derive(Default)]
pub struct ScratchPool(Mutex<Vec<Scratch>>);

/// Largest buffer in bytes that is kept. Few drawings need more.
const MOST_BYTES: usize = 1 << 20;
const MOST_ENTITIES: usize = 1 << 12;

impl ScratchPool {
    /// Calls `work` with a scratch buffer, which holds the content of the previous drawing.
    pub(crate) fn with<R>(&self, work: impl FnOnce(&mut Scratch) -> R) -> R {
        let mut scratch = self.free().pop().unwrap_or_default();
        let result = work(&mut scratch);
        if scratch.bytes.len() <= MOST_BYTES && scratch.drawing.entities.capacity() <= MOST_ENTITIES {
            self.free().push(scratch);
        }
        result
    }

    fn free(&self) -> std::sync::MutexGuard<'_, Vec<Scratch>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl fmt::Debug for ScratchPool {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ScratchPool").finish_non_exhaustive()
    }
}
