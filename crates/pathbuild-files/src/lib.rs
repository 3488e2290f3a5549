//! Access to files, of the operating system or in memory. Queries see them through a single trait, so that tests run in memory and all files that a
//! result depends on are known; [`private`] files belong to the program itself.

mod memory;
mod wrappers;
// The WebAssembly build has no operating system, only the files it is given.
#[cfg(not(target_family = "wasm"))]
mod os;
mod path_spelling;
pub mod private;
mod replace;
mod stamp;
pub use memory::{MemorySystem, OverlaySystem};
#[cfg(not(target_family = "wasm"))]
pub use os::OsSystem;
pub use path_spelling::{
    clean, is_drawing, is_hidden, is_windows_device, join, or_current_directory, with_forward_slashes,
};
pub use replace::is_temporary;
pub use stamp::{CLOCK, FileSystemTime, Stamp};
pub use wrappers::{ConfinedSystem, FixedDirectorySystem};

use std::fmt::{self, Debug};
use std::ops::ControlFlow;
use std::time::Instant;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::limits::{file_too_large, too_many_bytes};
use pathbuild_diagnostic::messages::files;
use pathbuild_diagnostic::reasons::{IS_DIRECTORY, NO_FILE};
use pathbuild_diagnostic::{Diagnostic, Value};

/// File operations of the operating system, or of a substitute such as a [`MemorySystem`].
pub trait System: Debug + Send + Sync {
    /// Reads a file into a buffer, overwriting its old content, and returns the file's stamp. The stamp is unknown if it differs before and after
    /// reading, or if the system has none: then the file must be read again to find out whether it has changed.
    ///
    /// # Errors
    /// If there is no such regular file, it cannot be read, or it has more bytes than `limit`. The content of the buffer is then undefined.
    fn read_into(&self, path: &Utf8Path, limit: u64, buffer: &mut Vec<u8>) -> Result<Stamp, ReadError>;

    /// Reads a whole file of at most `limit` bytes.
    ///
    /// # Errors
    /// The errors of [`read_into`](Self::read_into).
    fn read(&self, path: &Utf8Path, limit: u64) -> Result<Vec<u8>, ReadError> {
        let mut bytes = Vec::new();
        self.read_into(path, limit, &mut bytes)?;
        Ok(bytes)
    }

    /// Reads the first `length` bytes of a file, or all of it if it is shorter.
    ///
    /// # Errors
    /// The errors of [`read`](Self::read).
    fn read_head(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        let mut bytes = self.read(path, u64::MAX)?;
        bytes.truncate(length);
        Ok(bytes)
    }

    /// Returns the names in a directory.
    ///
    /// # Errors
    /// The errors of [`read`](Self::read).
    fn list(&self, directory: &Utf8Path) -> Result<Listing, ReadError>;

    /// Calls `take` for each entry of a directory, in no particular order, until `take` asks to stop. Links are not resolved.
    ///
    /// # Errors
    /// The errors of [`read`](Self::read), possibly after `take` was called for some entries.
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

    /// Reads the last `length` bytes of a file, or all of it if it is shorter.
    ///
    /// # Errors
    /// The errors of [`read`](Self::read).
    fn read_tail(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        let mut bytes = self.read(path, u64::MAX)?;
        Ok(bytes.split_off(bytes.len().saturating_sub(length)))
    }

    /// Returns the type of the file at a path, following links.
    fn kind(&self, path: &Utf8Path) -> FileKind;

    /// Returns one path for a file that can be reached by several paths, so that such paths compare equal.
    fn canonical(&self, path: &Utf8Path) -> Utf8PathBuf;

    /// Returns how a path links to a file that has other names; `None` for an ordinary file, or if the system cannot tell.
    fn link(&self, _: &Utf8Path) -> Option<FileLink> {
        None
    }

    /// Replaces a file atomically, unless it already has these bytes.
    ///
    /// # Errors
    /// The reason why it cannot be written. In that case the path is left as it was.
    fn write(&self, path: &Utf8Path, bytes: &[u8]) -> Result<WriteOutcome, Value>;

    /// Removes a file, if it exists.
    ///
    /// # Errors
    /// The reason why it cannot be removed.
    fn remove(&self, path: &Utf8Path) -> Result<(), Value>;

    /// Returns the current time, for time limits. `None` if there is no clock: then pathbuild enforces no time limits, and the program that embeds it
    /// must stop work that takes too long.
    fn now(&self) -> Option<Instant> {
        Some(Instant::now())
    }
}

/// The type of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum FileKind {
    File,
    Directory,
    Missing,
}

/// A name of a file that has other names as well.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileLink {
    /// A symbolic link with this target, which is relative to the directory of the link.
    Symbolic(Utf8PathBuf),
    /// A hard link to the file with this device and inode number.
    Hard([u64; 2]),
}

/// The result of writing a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum WriteOutcome {
    Changed,
    Unchanged,
}

/// The reason why a file or directory cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ReadError {
    /// The file or directory does not exist.
    Missing,
    /// The path leads to a directory, but a file is needed.
    IsDirectory,
    /// The file has more bytes than the limit.
    TooLarge {
        /// Size of the file in bytes.
        size: u64,
    },
    /// Any other reason, such as missing permission.
    Other(Value),
}

impl ReadError {
    /// Returns the diagnostic for a file that cannot be read, without a place. `key` is the configuration key of the size limit.
    pub fn diagnostic(self, limit: u64, key: &str) -> Diagnostic {
        match self {
            Self::Missing => Diagnostic::new(&files::MISSING),
            Self::TooLarge { size } => file_too_large(size, limit, key),
            other => Diagnostic::new(&files::UNREADABLE).with("reason", other.reason(limit)),
        }
    }

    /// Returns the reason as a phrase, for a message that says what the file was needed for.
    pub fn reason(self, limit: u64) -> Value {
        match self {
            Self::Missing => (&NO_FILE).into(),
            Self::IsDirectory => (&IS_DIRECTORY).into(),
            Self::Other(reason) => reason,
            Self::TooLarge { size } => too_many_bytes(size, limit).into(),
        }
    }
}

/// Names stored back to back in one string, since a directory may hold ten thousand drawings.
#[derive(Clone, Default, PartialEq, Eq)]
pub struct Names {
    text: String,
    /// End offset of each name in `text`.
    ends: Vec<usize>,
}

/// The names in a directory, in no particular order: sorting ten thousand takes longer than reading the few drawings among them that are
/// needed. Names that are not UTF-8 appear in a lossy spelling that no file has.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listing {
    /// Everything that is not a directory, dangling links included.
    pub files: Names,
    /// Directories, and links that lead to one.
    pub directories: Names,
}

/// A name in a directory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry<'a> {
    /// The name; if it is not UTF-8, with replacement characters.
    pub name: &'a str,
    /// Whether `name` is exact: only then can the file be opened by it.
    pub is_exact: bool,
    /// The type of the entry.
    pub kind: EntryKind,
}

/// The type of a directory entry, with links unresolved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EntryKind {
    /// A regular file or anything else, such as a pipe.
    File,
    /// A directory.
    Directory,
    /// A symbolic link, whatever its target is.
    Link,
}

impl Names {
    /// Creates an empty list.
    pub const fn none() -> Self {
        Self { text: String::new(), ends: Vec::new() }
    }

    /// Appends all names of another list.
    pub fn extend(&mut self, names: &Self) {
        let begin = self.text.len();
        self.text.push_str(&names.text);
        self.ends.extend(names.ends.iter().map(|end| begin + end));
    }

    /// Appends a name, even if the list contains it already.
    pub fn push(&mut self, name: &str) {
        self.text.push_str(name);
        self.ends.push(self.text.len());
    }

    /// Returns the number of names.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there are no names.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Returns the name at an index; `None` beyond the end.
    pub fn get(&self, number: usize) -> Option<&str> {
        let end = *self.ends.get(number)?;
        let begin = number.checked_sub(1).map_or(0, |before| self.ends[before]);
        Some(&self.text[begin..end])
    }

    /// Iterates over the names in the order in which they were added.
    pub fn iter(&self) -> impl Iterator<Item = &str> {
        (0..self.len()).filter_map(|number| self.get(number))
    }
}

impl Debug for Names {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

impl<'t> FromIterator<&'t str> for Names {
    fn from_iter<I: IntoIterator<Item = &'t str>>(names: I) -> Self {
        let mut all = Self::default();
        names.into_iter().for_each(|name| all.push(name));
        all
    }
}
