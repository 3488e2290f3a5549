//! Files in memory, for tests and for the page that compiles in a browser, and one file in memory over another system.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::{Bound, ControlFlow};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Value;

use super::{Entry, FileKind, Listing, ReadError, Stamp, System, WriteOutcome};

/// A file system in memory. A directory exists as long as it contains a file.
#[derive(Debug, Default)]
pub struct MemorySystem {
    files: Mutex<BTreeMap<Utf8PathBuf, Vec<u8>>>,
    has_no_clock: bool,
}

impl MemorySystem {
    /// Creates an empty system without a clock.
    pub fn without_clock() -> Self {
        Self { has_no_clock: true, ..Self::default() }
    }

    /// Creates or overwrites a file.
    pub fn put(&self, path: impl Into<Utf8PathBuf>, bytes: impl Into<Vec<u8>>) {
        self.files().insert(path.into(), bytes.into());
    }

    fn files(&self) -> MutexGuard<'_, BTreeMap<Utf8PathBuf, Vec<u8>>> {
        // The map is consistent even if a test panicked while holding the lock.
        self.files.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl System for MemorySystem {
    fn read_into(&self, path: &Utf8Path, limit: u64, buffer: &mut Vec<u8>) -> Result<Stamp, ReadError> {
        let files = self.files();
        copy_limited(files.get(path).ok_or(ReadError::Missing)?, limit, buffer)
    }

    fn list(&self, directory: &Utf8Path) -> Result<Listing, ReadError> {
        let files = self.files();
        let (mut names, mut directories) = (BTreeSet::new(), BTreeSet::new());
        for rest in files_below(&files, directory).filter_map(|path| path.strip_prefix(directory).ok()) {
            let mut components = rest.components();
            let Some(name) = components.next() else { continue };
            if components.next().is_some() { &mut directories } else { &mut names }.insert(name.as_str());
        }
        Ok(Listing { files: names.into_iter().collect(), directories: directories.into_iter().collect() })
    }

    fn kind(&self, path: &Utf8Path) -> FileKind {
        let files = self.files();
        if files.contains_key(path) {
            FileKind::File
        } else if path.as_str().is_empty() || files_below(&files, path).next().is_some() {
            FileKind::Directory
        } else {
            FileKind::Missing
        }
    }

    fn canonical(&self, path: &Utf8Path) -> Utf8PathBuf {
        path.to_owned()
    }

    fn write(&self, path: &Utf8Path, bytes: &[u8]) -> Result<WriteOutcome, Value> {
        let before = self.files().insert(path.to_owned(), bytes.to_vec());
        Ok(if before.as_deref() == Some(bytes) { WriteOutcome::Unchanged } else { WriteOutcome::Changed })
    }

    fn remove(&self, path: &Utf8Path) -> Result<(), Value> {
        self.files().remove(path);
        Ok(())
    }

    fn now(&self) -> Option<Instant> {
        (!self.has_no_clock).then(Instant::now)
    }
}

/// Copies the content of a file into a buffer. Returns an unknown stamp, because files in memory have none.
fn copy_limited(bytes: &[u8], limit: u64, buffer: &mut Vec<u8>) -> Result<Stamp, ReadError> {
    let size = bytes.len() as u64;
    if size > limit {
        return Err(ReadError::TooLarge { size });
    }
    buffer.clear();
    buffer.extend_from_slice(bytes);
    Ok(Stamp::UNKNOWN)
}

/// Iterates over the files below a directory, at any depth. Paths are ordered component by component, so the paths of these files are consecutive.
fn files_below<'a>(
    files: &'a BTreeMap<Utf8PathBuf, Vec<u8>>,
    directory: &Utf8Path,
) -> impl Iterator<Item = &'a Utf8PathBuf> {
    let from = files.range::<Utf8Path, _>((Bound::Included(directory), Bound::Unbounded));
    from.map(|(path, _)| path).take_while(move |path| path.starts_with(directory))
}

/// Another system with one file added or replaced in memory, to see the effect of writing it. Reads, [`list`](System::list) and
/// [`kind`](System::kind) show the replacement; all other operations are those of the system below.
#[derive(Debug)]
pub struct OverlaySystem {
    below: Arc<dyn System>,
    path: Utf8PathBuf,
    bytes: Vec<u8>,
}

impl OverlaySystem {
    /// Overlays the file at `path`, which must be normalised, with these bytes.
    pub fn new(below: Arc<dyn System>, path: Utf8PathBuf, bytes: Vec<u8>) -> Self {
        Self { below, path, bytes }
    }

    fn directory(&self) -> &Utf8Path {
        self.path.parent().unwrap_or(Utf8Path::new(""))
    }
}

impl System for OverlaySystem {
    fn read_into(&self, path: &Utf8Path, limit: u64, buffer: &mut Vec<u8>) -> Result<Stamp, ReadError> {
        if path == self.path {
            copy_limited(&self.bytes, limit, buffer)
        } else {
            self.below.read_into(path, limit, buffer)
        }
    }

    fn read_head(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        if path == self.path {
            return Ok(self.bytes[..length.min(self.bytes.len())].to_vec());
        }
        self.below.read_head(path, length)
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
        // The overlaid file is not added: the entries are those of the system below.
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
