//! The files of a page: those it was given, and those written but not yet handed over. The given files are never modified, so that the
//! state of a program reflects the visitor's disk.

use std::time::{Instant, SystemTime};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::System;
use pathbuild_db::system::{FileKind, Listing, MemorySystem, ReadError, WriteOutcome};
use pathbuild_diagnostic::Value;

#[derive(Debug)]
pub(crate) struct Files {
    given: MemorySystem,
    written: MemorySystem,
}

impl Default for Files {
    fn default() -> Self {
        Self { given: MemorySystem::without_clock(), written: MemorySystem::without_clock() }
    }
}

impl Files {
    /// Adds a file given by the page.
    pub(crate) fn put(&self, path: Utf8PathBuf, bytes: &[u8]) {
        self.given.put(path, bytes);
    }

    /// Hands over a file that was written or given.
    pub(crate) fn take(&self, path: &Utf8Path) -> Vec<u8> {
        let bytes = self.read(path, u64::MAX).unwrap_or_default();
        _ = self.written.remove(path);
        bytes
    }

    fn holding(&self, path: &Utf8Path) -> &MemorySystem {
        if self.written.kind(path) == FileKind::File { &self.written } else { &self.given }
    }
}

impl System for Files {
    fn read(&self, path: &Utf8Path, limit: u64) -> Result<Vec<u8>, ReadError> {
        self.holding(path).read(path, limit)
    }

    fn head(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        self.holding(path).head(path, length)
    }

    fn modified(&self, path: &Utf8Path) -> Option<SystemTime> {
        self.given.modified(path)
    }

    fn list(&self, directory: &Utf8Path) -> Result<Listing, ReadError> {
        self.given.list(directory)
    }

    fn kind(&self, path: &Utf8Path) -> FileKind {
        self.holding(path).kind(path)
    }

    fn canonical(&self, path: &Utf8Path) -> Utf8PathBuf {
        path.to_owned()
    }

    fn write(&self, path: &Utf8Path, bytes: &[u8]) -> Result<WriteOutcome, Value> {
        if self.read(path, u64::MAX).is_ok_and(|present| present == bytes) {
            return Ok(WriteOutcome::Unchanged);
        }
        self.written.write(path, bytes)
    }

    fn remove(&self, path: &Utf8Path) -> Result<(), Value> {
        self.written.remove(path)
    }

    fn now(&self) -> Option<Instant> {
        None
    }
}
