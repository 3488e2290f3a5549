//! Files of the operating system. All IO on drawings and programs happens here.
#![expect(clippy::disallowed_methods, reason = "this is System's implementation: all IO comes here")]

mod debris;
mod directory;
mod held;
mod open;
mod replace;
mod whole;

use std::fs;
use std::io::{self, ErrorKind, Read, Seek, SeekFrom};
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::SystemTime;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Value;
use pathbuild_diagnostic::reasons::reason;

use crate::stamp::Stamp;
use crate::{Entry, FileKind, FileLink, Listing, ReadError, System, WriteOutcome};

/// The files of the operating system. Relative paths are relative to the working directory of the process.
#[derive(Clone, Copy, Debug, Default)]
pub struct OsSystem;

impl OsSystem {
    /// A shared instance.
    pub fn shared() -> Arc<dyn System> {
        Arc::new(Self)
    }
}

impl System for OsSystem {
    fn read(&self, path: &Utf8Path, limit: u64) -> Result<Vec<u8>, ReadError> {
        let mut room = Vec::new();
        let length = self.read_into(path, limit, &mut room)?.len();
        room.truncate(length);
        Ok(room)
    }

    fn read_into<'r>(
        &self,
        path: &Utf8Path,
        limit: u64,
        room: &'r mut Vec<u8>,
    ) -> Result<&'r [u8], ReadError> {
        let length = whole::read(&open::open(path)?, limit, room)?;
        Ok(&room[..length])
    }

    fn read_stamped<'r>(
        &self,
        path: &Utf8Path,
        limit: u64,
        room: &'r mut Vec<u8>,
    ) -> Result<(&'r [u8], Stamp), ReadError> {
        let file = open::open(path)?;
        let before = Stamp::of_open(&file);
        let length = whole::read(&file, limit, room)?;
        let stamp = if Stamp::of_open(&file) == before { before } else { Stamp::UNKNOWN };
        Ok((&room[..length], stamp))
    }

    fn head(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        let file = open::open(path)?;
        open::regular_size(&file)?;
        let mut bytes = Vec::new();
        file.take(length as u64).read_to_end(&mut bytes)?;
        Ok(bytes)
    }

    fn tail(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        let length = length as u64;
        let mut file = open::open(path)?;
        let size = open::regular_size(&file)?;
        file.seek(SeekFrom::Start(size.saturating_sub(length)))?;
        let mut tail = Vec::new();
        file.take(length).read_to_end(&mut tail)?;
        Ok(tail)
    }

    fn modified(&self, path: &Utf8Path) -> Option<SystemTime> {
        fs::metadata(path).ok()?.modified().ok()
    }

    fn list(&self, directory: &Utf8Path) -> Result<Listing, ReadError> {
        let mut listing = Listing::default();
        self.list_by_parts(directory, &mut |part| {
            listing.files.extend(&part.files);
            listing.directories.extend(&part.directories);
        })?;
        Ok(listing)
    }

    fn list_by_parts(&self, directory: &Utf8Path, take: &mut dyn FnMut(Listing)) -> Result<(), ReadError> {
        Ok(directory::list_by_parts(readable(directory), take)?)
    }

    fn each_entry(
        &self,
        directory: &Utf8Path,
        take: &mut dyn FnMut(Entry<'_>) -> ControlFlow<()>,
    ) -> Result<(), ReadError> {
        Ok(directory::each_entry(readable(directory), take)?)
    }

    fn kind(&self, path: &Utf8Path) -> FileKind {
        match fs::metadata(readable(path)) {
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
        replace::replace(path, bytes)
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

    // Every directory has several.
    (data.is_file() && data.nlink() > 1).then(|| FileLink::Hard([data.dev(), data.ino()]))
}

/// Windows does not count them without opening the file.
#[cfg(not(unix))]
fn hard_link(_: &fs::Metadata) -> Option<FileLink> {
    None
}

/// The path as passed to system calls, which do not accept an empty one.
fn readable(path: &Utf8Path) -> &Utf8Path {
    if path.as_str().is_empty() { Utf8Path::new(".") } else { path }
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
