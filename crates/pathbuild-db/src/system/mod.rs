//! The outside world, as the queries see it: one trait, so that tests run in memory and every file that a result depends on is known.

mod confined;
mod listing;
mod memory;
// The program in a browser has no files but those it is given.
#[cfg(not(target_family = "wasm"))]
mod os;
mod overlay;
mod spelling;

use std::fmt::Debug;
use std::ops::ControlFlow;
use std::time::{Instant, SystemTime};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::Stamp;
use pathbuild_diagnostic::Value;

pub use confined::Confined;
pub use listing::{Entry, EntryKind, Listing, Names};
pub use memory::MemorySystem;
#[cfg(not(target_family = "wasm"))]
pub use os::OsSystem;
pub use overlay::Overlay;
pub use spelling::{clean, join, spelt};

/// Reading, listing and writing files.
pub trait System: Debug + Send + Sync {
    /// The bytes of a file.
    ///
    /// # Errors
    /// When there is no such regular file, it cannot be read, or it has more bytes than `limit`.
    fn read(&self, path: &Utf8Path, limit: u64) -> Result<Vec<u8>, ReadError>;

    /// The same in memory that is there already; `room` is what was read before, and then whatever else there was.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    fn read_into<'r>(
        &self,
        path: &Utf8Path,
        limit: u64,
        room: &'r mut Vec<u8>,
    ) -> Result<&'r [u8], ReadError> {
        *room = self.read(path, limit)?;
        Ok(room)
    }

    /// The same with the stamp that the file had before and after it was read. Unknown where that was not the same, or nobody tells:
    /// then nobody can say later whether a file still has these bytes without reading it.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    fn read_stamped<'r>(
        &self,
        path: &Utf8Path,
        limit: u64,
        room: &'r mut Vec<u8>,
    ) -> Result<(&'r [u8], Stamp), ReadError> {
        self.read_into(path, limit, room).map(|bytes| (bytes, Stamp::UNKNOWN))
    }

    /// The first bytes of a file, at most so many.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    fn head(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError>;

    /// When a file was last changed, where that is known.
    fn modified(&self, path: &Utf8Path) -> Option<SystemTime>;

    /// The names in a directory.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    fn list(&self, directory: &Utf8Path) -> Result<Listing, ReadError>;

    /// The same, as they come.
    ///
    /// # Errors
    /// As [`read`](Self::read), also after some of them.
    fn list_by_parts(&self, directory: &Utf8Path, take: &mut dyn FnMut(Listing)) -> Result<(), ReadError> {
        take(self.list(directory)?);
        Ok(())
    }

    /// Each name in a directory, in no particular order, until `take` has enough. Links are links where the system has them.
    ///
    /// # Errors
    /// As [`read`](Self::read), also after some of them.
    fn each_entry(
        &self,
        directory: &Utf8Path,
        take: &mut dyn FnMut(Entry<'_>) -> ControlFlow<()>,
    ) -> Result<(), ReadError> {
        let listing = self.list(directory)?;
        let kinds = [(&listing.files, EntryKind::File), (&listing.directories, EntryKind::Directory)];
        let mut entries =
            kinds.into_iter().flat_map(|(names, kind)| names.iter().map(move |name| (name, kind)));
        _ = entries.try_for_each(|(name, kind)| take(Entry { name, is_exact: true, kind }));
        Ok(())
    }

    /// The last bytes of a file, at most so many.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    fn tail(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        let mut bytes = self.read(path, u64::MAX)?;
        Ok(bytes.split_off(bytes.len().saturating_sub(length)))
    }

    /// What is under a name.
    fn kind(&self, path: &Utf8Path) -> FileKind;

    /// The one name of a file that can be reached under several.
    fn canonical(&self, path: &Utf8Path) -> Utf8PathBuf;

    /// Writes a file whole or not at all, and only if what is there differs.
    ///
    /// # Errors
    /// The reason why it cannot be written; nothing is left under the name that was not there before.
    fn write(&self, path: &Utf8Path, bytes: &[u8]) -> Result<Written, Value>;

    /// Removes a file; that there is none is no error.
    ///
    /// # Errors
    /// The reason why it cannot be removed.
    fn remove(&self, path: &Utf8Path) -> Result<(), Value>;

    /// What time it is, for limits of time; `None` where there is no clock: who started the work there ends it when it takes too long.
    fn now(&self) -> Option<Instant> {
        Some(Instant::now())
    }
}

/// What is under a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum FileKind {
    File,
    Directory,
    Missing,
}

/// What writing did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Written {
    Changed,
    Unchanged,
}

/// Why something cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ReadError {
    /// There is nothing under that name.
    Missing,
    /// A directory where a file was asked for.
    IsDirectory,
    /// More bytes than the limit.
    TooLarge {
        /// How many there are.
        size: u64,
    },
    /// Any other reason.
    Other(Value),
}
