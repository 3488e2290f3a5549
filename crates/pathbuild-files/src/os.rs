//! Files of the operating system. All IO on drawings and programs happens here.
#![expect(clippy::disallowed_methods, reason = "this is System's implementation: all IO comes here")]

use std::collections::HashMap;
use std::fs::{self, File};
use std::io::{self, ErrorKind, Read, Seek, SeekFrom};
use std::ops::ControlFlow;
use std::sync::{Arc, LazyLock, Mutex, MutexGuard, PoisonError};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Value;
use pathbuild_diagnostic::reasons::{DIRECTORY_OF_THAT_NAME, NOT_REGULAR, reason};

use crate::path_spelling::or_current_directory;
use crate::replace::{self, is_temporary};
use crate::stamp::Stamp;
use crate::{Entry, EntryKind, FileKind, FileLink, Listing, ReadError, System, WriteOutcome};

/// The files of the operating system. Relative paths are relative to the working directory of the process.
#[derive(Clone, Copy, Debug, Default)]
pub struct OsSystem;

impl OsSystem {
    /// Returns the file system as a trait object, for callers that accept any [`System`].
    pub fn shared() -> Arc<dyn System> {
        Arc::new(Self)
    }
}

impl System for OsSystem {
    fn read_into(&self, path: &Utf8Path, limit: u64, buffer: &mut Vec<u8>) -> Result<Stamp, ReadError> {
        let file = open(path)?;
        let before = Stamp::of_open(&file);
        read_whole(&file, limit, buffer)?;
        Ok(if Stamp::of_open(&file) == before { before } else { Stamp::UNKNOWN })
    }

    fn read_head(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        let file = open(path)?;
        regular_size(&file)?;
        let mut bytes = Vec::new();
        file.take(length as u64).read_to_end(&mut bytes)?;
        Ok(bytes)
    }

    fn read_tail(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        let length = length as u64;
        let mut file = open(path)?;
        let size = regular_size(&file)?;
        file.seek(SeekFrom::Start(size.saturating_sub(length)))?;
        let mut tail = Vec::new();
        file.take(length).read_to_end(&mut tail)?;
        Ok(tail)
    }

    fn list(&self, directory: &Utf8Path) -> Result<Listing, ReadError> {
        let directory = or_current_directory(directory);
        let (mut listing, mut temporary) = (Listing::default(), Vec::new());
        self.each_entry(directory, &mut |Entry { name, kind, .. }| {
            if is_temporary(name, |name| !name.is_empty()) {
                temporary.push(directory.join(name));
            }
            // The type of a link is that of its target; a dangling link is listed as a file, which then cannot be read.
            let is_directory = match kind {
                EntryKind::Directory => true,
                EntryKind::Link => fs::metadata(directory.join(name)).is_ok_and(|data| data.is_dir()),
                EntryKind::File => false,
            };
            if is_directory { &mut listing.directories } else { &mut listing.files }.push(name);
            ControlFlow::Continue(())
        })?;
        listed_directories().entry(directory.to_owned()).or_insert(temporary);
        Ok(listing)
    }

    fn each_entry(
        &self,
        directory: &Utf8Path,
        take: &mut dyn FnMut(Entry<'_>) -> ControlFlow<()>,
    ) -> Result<(), ReadError> {
        for entry in fs::read_dir(or_current_directory(directory))? {
            let entry = entry?;
            let kind = match entry.file_type() {
                Ok(kind) if kind.is_dir() => EntryKind::Directory,
                Ok(kind) if kind.is_symlink() => EntryKind::Link,
                _ => EntryKind::File,
            };
            let name = entry.file_name();
            let is_exact = name.to_str().is_some();
            if take(Entry { name: &name.to_string_lossy(), is_exact, kind }).is_break() {
                break;
            }
        }
        Ok(())
    }

    fn kind(&self, path: &Utf8Path) -> FileKind {
        match fs::metadata(or_current_directory(path)) {
            Ok(data) if data.is_dir() => FileKind::Directory,
            Ok(_) => FileKind::File,
            Err(_) => FileKind::Missing,
        }
    }

    fn canonical(&self, path: &Utf8Path) -> Utf8PathBuf {
        path.canonicalize_utf8().unwrap_or_else(|_| path.to_owned())
    }

    fn link(&self, path: &Utf8Path) -> Option<FileLink> {
        let data = path.as_std_path().symlink_metadata().ok()?;
        if data.is_symlink() { path.read_link_utf8().ok().map(FileLink::Symbolic) } else { hard_link(&data) }
    }

    fn write(&self, path: &Utf8Path, bytes: &[u8]) -> Result<WriteOutcome, Value> {
        let parent = path.parent().unwrap_or(Utf8Path::new(""));
        remove_debris(or_current_directory(parent));
        match path.as_std_path().metadata() {
            Ok(data) if data.is_dir() => return Err(Value::Prose(&DIRECTORY_OF_THAT_NAME)),
            Ok(data) if !data.is_file() => return Err(Value::Prose(&NOT_REGULAR)),
            Ok(data) if data.len() == bytes.len() as u64 && file_contains(path, bytes) => {
                return Ok(WriteOutcome::Unchanged);
            }
            _ => {}
        }
        let written = fs::create_dir_all(or_current_directory(parent))
            .and_then(|()| replace::write(path, bytes, false));
        written.map(|()| WriteOutcome::Changed).map_err(|error| reason(&error))
    }

    fn remove(&self, path: &Utf8Path) -> Result<(), Value> {
        match fs::remove_file(path) {
            Err(error) if error.kind() != ErrorKind::NotFound => Err(reason(&error)),
            _ => Ok(()),
        }
    }
}

#[cfg(unix)]
fn hard_link(data: &fs::Metadata) -> Option<FileLink> {
    use std::os::unix::fs::MetadataExt;

    // Directories always have several hard links, so only files are considered.
    (data.is_file() && data.nlink() > 1).then(|| FileLink::Hard([data.dev(), data.ino()]))
}

/// Returns `None`: on Windows, the number of hard links is known only after opening the file.
#[cfg(not(unix))]
fn hard_link(_: &fs::Metadata) -> Option<FileLink> {
    None
}

impl From<io::Error> for ReadError {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            ErrorKind::NotFound => Self::Missing,
            ErrorKind::IsADirectory => Self::IsDirectory,
            _ => Self::Other(reason(&error)),
        }
    }
}

/// Opens a file for reading, without waiting for the writer of a pipe. The caller must read it only if it is a regular file: reading a pipe may
/// block, and a device may never end.
///
/// # Errors
/// If the file does not exist or cannot be opened.
fn open(path: &Utf8Path) -> Result<File, ReadError> {
    open_at_once(path).map_err(|error| {
        // A socket, and a directory on Windows, cannot be opened at all: report its type instead of the system's message.
        match path.as_std_path().metadata() {
            Ok(data) if data.is_dir() => ReadError::IsDirectory,
            Ok(data) if !data.is_file() => not_regular_error(),
            _ => error.into(),
        }
    })
}

/// Opens a file with `NONBLOCK`, because opening a pipe would otherwise wait for a writer.
#[cfg(unix)]
fn open_at_once(path: &Utf8Path) -> io::Result<File> {
    use rustix::fs::{Mode, OFlags};

    let flags = OFlags::RDONLY | OFlags::NONBLOCK | OFlags::NOCTTY | OFlags::CLOEXEC;
    Ok(rustix::fs::open(path.as_str(), flags, Mode::empty())?.into())
}

#[cfg(not(unix))]
fn open_at_once(path: &Utf8Path) -> io::Result<File> {
    replace::retry_while_busy(|| File::open(path))
}

/// Reads a file of at most `limit` bytes. The old content of `bytes` is overwritten.
///
/// # Errors
/// If it is not a regular file, cannot be read, or is larger than `limit`.
fn read_whole(file: &File, limit: u64, bytes: &mut Vec<u8>) -> Result<(), ReadError> {
    let size = regular_size(file)?;
    if size > limit {
        return Err(ReadError::TooLarge { size });
    }
    bytes.clear();
    // The file may grow while it is read, so the read is limited as well. With one byte more than its size, `read_to_end` need not reallocate to
    // notice the end of the file.
    bytes.reserve(usize::try_from(size).unwrap_or_default().saturating_add(1));
    file.take(limit.saturating_add(1)).read_to_end(bytes)?;
    let size = bytes.len() as u64;
    if size > limit { Err(ReadError::TooLarge { size }) } else { Ok(()) }
}

/// Returns the size of a regular file in bytes.
///
/// # Errors
/// If it is not a regular file.
fn regular_size(file: &File) -> Result<u64, ReadError> {
    let data = file.metadata()?;
    if data.is_dir() {
        return Err(ReadError::IsDirectory);
    }
    if !data.is_file() {
        return Err(not_regular_error());
    }
    Ok(data.len())
}

fn not_regular_error() -> ReadError {
    ReadError::Other(Value::Prose(&NOT_REGULAR))
}

fn file_contains(path: &Utf8Path, bytes: &[u8]) -> bool {
    OsSystem.read(path, bytes.len() as u64).is_ok_and(|present| present == bytes)
}

/// Temporary files that were found by the first listing of each directory. Each directory is searched at most once per run; a listing made for
/// another purpose serves as that search.
static LISTED_DEBRIS: LazyLock<Mutex<HashMap<Utf8PathBuf, Vec<Utf8PathBuf>>>> = LazyLock::new(Mutex::default);

/// Removes temporary files in a directory that were left by processes that no longer run.
fn remove_debris(directory: &Utf8Path) {
    if !listed_directories().contains_key(directory) {
        // Nothing can be removed from a directory that cannot be listed.
        _ = OsSystem.list(directory);
    }
    let leftovers = std::mem::take(listed_directories().entry(directory.to_owned()).or_default());
    for debris in leftovers {
        let is_regular = debris.as_std_path().symlink_metadata().is_ok_and(|data| data.is_file());
        let is_left = || open(&debris).ok().filter(|file| file.try_lock().is_ok());
        if let Some(_locked) = is_regular.then(is_left).flatten() {
            // Best effort: a leftover temporary file does no harm.
            _ = fs::remove_file(&debris);
        }
    }
}

fn listed_directories() -> MutexGuard<'static, HashMap<Utf8PathBuf, Vec<Utf8PathBuf>>> {
    LISTED_DEBRIS.lock().unwrap_or_else(PoisonError::into_inner)
}
