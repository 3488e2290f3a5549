//! A system whose relative paths do not depend on the working directory of the process.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::Instant;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Value;

use super::{Entry, FileKind, FileLink, Listing, ReadError, Stamp, System, WriteOutcome};

/// Wraps another system; relative paths are relative to a directory. A process may change its working directory at any time, and another
/// program that uses pathbuild as a library has its own reasons for where it runs.
#[derive(Clone, Debug)]
pub struct BasedSystem {
    below: Arc<dyn System>,
    directory: Utf8PathBuf,
}

impl BasedSystem {
    /// A system with relative paths relative to `directory`, which is absolute.
    pub fn new(below: Arc<dyn System>, directory: Utf8PathBuf) -> Self {
        Self { below, directory }
    }

    fn place(&self, path: &Utf8Path) -> Utf8PathBuf {
        self.directory.join(path)
    }
}

impl System for BasedSystem {
    fn read_into(&self, path: &Utf8Path, limit: u64, room: &mut Vec<u8>) -> Result<Stamp, ReadError> {
        self.below.read_into(&self.place(path), limit, room)
    }

    fn head(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        self.below.head(&self.place(path), length)
    }

    fn tail(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        self.below.tail(&self.place(path), length)
    }

    fn list(&self, directory: &Utf8Path) -> Result<Listing, ReadError> {
        self.below.list(&self.place(directory))
    }

    fn each_entry(
        &self,
        directory: &Utf8Path,
        take: &mut dyn FnMut(Entry<'_>) -> ControlFlow<()>,
    ) -> Result<(), ReadError> {
        self.below.each_entry(&self.place(directory), take)
    }

    fn kind(&self, path: &Utf8Path) -> FileKind {
        self.below.kind(&self.place(path))
    }

    fn canonical(&self, path: &Utf8Path) -> Utf8PathBuf {
        self.below.canonical(&self.place(path))
    }

    fn link(&self, path: &Utf8Path) -> Option<FileLink> {
        self.below.link(&self.place(path))
    }

    fn write(&self, path: &Utf8Path, bytes: &[u8]) -> Result<WriteOutcome, Value> {
        self.below.write(&self.place(path), bytes)
    }

    fn remove(&self, path: &Utf8Path) -> Result<(), Value> {
        self.below.remove(&self.place(path))
    }

    fn now(&self) -> Option<Instant> {
        self.below.now()
    }
}
