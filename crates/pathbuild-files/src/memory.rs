//! Files in memory, for tests and for the page that compiles in a browser.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Bound;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Instant, SystemTime};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Value;

use super::{FileKind, Listing, ReadError, System, WriteOutcome};

/// Files by path. A directory exists as long as it contains a file.
#[derive(Debug, Default)]
pub struct MemorySystem {
    files: Mutex<BTreeMap<Utf8PathBuf, Vec<u8>>>,
    has_no_clock: bool,
}

impl MemorySystem {
    /// An empty system without a clock.
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
    fn read(&self, path: &Utf8Path, limit: u64) -> Result<Vec<u8>, ReadError> {
        let files = self.files();
        let bytes = files.get(path).ok_or(ReadError::Missing)?;
        let size = bytes.len() as u64;
        if size > limit { Err(ReadError::TooLarge { size }) } else { Ok(bytes.clone()) }
    }

    fn head(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        let mut bytes = self.read(path, u64::MAX)?;
        bytes.truncate(length);
        Ok(bytes)
    }

    fn modified(&self, _: &Utf8Path) -> Option<SystemTime> {
        None
    }

    fn list(&self, directory: &Utf8Path) -> Result<Listing, ReadError> {
        let files = self.files();
        let (mut names, mut directories) = (BTreeSet::new(), BTreeSet::new());
        for rest in below(&files, directory).filter_map(|path| path.strip_prefix(directory).ok()) {
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
        } else if path.as_str().is_empty() || below(&files, path).next().is_some() {
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

/// The files in a directory and below. Paths are ordered component by component, so these are consecutive.
fn below<'a>(
    files: &'a BTreeMap<Utf8PathBuf, Vec<u8>>,
    directory: &Utf8Path,
) -> impl Iterator<Item = &'a Utf8PathBuf> {
    let from = files.range::<Utf8Path, _>((Bound::Included(directory), Bound::Unbounded));
    from.map(|(path, _)| path).take_while(move |path| path.starts_with(directory))
}
