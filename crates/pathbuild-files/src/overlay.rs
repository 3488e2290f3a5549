//! Wraps a system and adds or replaces one file in memory, to see the effect of writing it.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Instant, SystemTime};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Value;

use super::{Entry, FileKind, Listing, ReadError, System, WriteOutcome};

/// Another system with one file replaced. Only reads see the replacement.
#[derive(Debug)]
pub struct OverlaySystem {
    below: Arc<dyn System>,
    path: Utf8PathBuf,
    bytes: Vec<u8>,
}

impl OverlaySystem {
    /// Overlays a file with these bytes. The path must be normalised.
    pub fn new(below: Arc<dyn System>, path: Utf8PathBuf, bytes: Vec<u8>) -> Self {
        Self { below, path, bytes }
    }

    fn directory(&self) -> &Utf8Path {
        self.path.parent().unwrap_or(Utf8Path::new(""))
    }
}

impl System for OverlaySystem {
    fn read(&self, path: &Utf8Path, limit: u64) -> Result<Vec<u8>, ReadError> {
        let size = self.bytes.len() as u64;
        match path == self.path {
            true if size > limit => Err(ReadError::TooLarge { size }),
            true => Ok(self.bytes.clone()),
            false => self.below.read(path, limit),
        }
    }

    fn read_into<'r>(
        &self,
        path: &Utf8Path,
        limit: u64,
        room: &'r mut Vec<u8>,
    ) -> Result<&'r [u8], ReadError> {
        if path != self.path {
            return self.below.read_into(path, limit, room);
        }
        *room = self.read(path, limit)?;
        Ok(room)
    }

    fn head(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        if path == self.path {
            return Ok(self.bytes[..length.min(self.bytes.len())].to_vec());
        }
        self.below.head(path, length)
    }

    fn modified(&self, path: &Utf8Path) -> Option<SystemTime> {
        self.below.modified(path)
    }

    fn list(&self, directory: &Utf8Path) -> Result<Listing, ReadError> {
        let listed = self.below.list(directory);
        let Some(name) = self.path.file_name().filter(|_| directory == self.directory()) else {
            return listed;
        };
        let mut listing = listed.unwrap_or_default();
        if !listing.files.iter().any(|listed| listed == name) {
            listing.files.push(name);
        }
        Ok(listing)
    }

    fn each_entry(
        &self,
        directory: &Utf8Path,
        take: &mut dyn FnMut(Entry<'_>) -> ControlFlow<()>,
    ) -> Result<(), ReadError> {
        // Directory walks show only what exists on disk.
        self.below.each_entry(directory, take)
    }

    fn kind(&self, path: &Utf8Path) -> FileKind {
        if path == self.path { FileKind::File } else { self.below.kind(path) }
    }

    fn canonical(&self, path: &Utf8Path) -> Utf8PathBuf {
        self.below.canonical(path)
    }

    fn write(&self, path: &Utf8Path, bytes: &[u8]) -> Result<WriteOutcome, Value> {
        self.below.write(path, bytes)
    }

    fn remove(&self, path: &Utf8Path) -> Result<(), Value> {
        self.below.remove(path)
    }

    fn now(&self) -> Option<Instant> {
        self.below.now()
    }
}
