//! Opens regular files only: reading a pipe may block, and a device may never end.

use std::fs::File;
use std::io;

use camino::Utf8Path;
use pathbuild_diagnostic::Value;
use pathbuild_diagnostic::reasons::NOT_REGULAR;

#[cfg(not(unix))]
use super::held;
use crate::ReadError;

/// Opens a file for reading. Anything but a regular file is closed again at once and never blocks.
///
/// # Errors
/// If the file does not exist or cannot be opened.
pub(super) fn open(path: &Utf8Path) -> Result<File, ReadError> {
    open_at_once(path).map_err(|error| {
        // A socket, and a directory on Windows, cannot be opened at all; report the type instead of the system's message.
        match path.as_std_path().metadata() {
            Ok(data) if data.is_dir() => ReadError::IsDirectory,
            Ok(data) if !data.is_file() => not_regular(),
            _ => error.into(),
        }
    })
}

/// The size of a regular file.
///
/// # Errors
/// If it is not a regular file.
pub(super) fn regular_size(file: &File) -> Result<u64, ReadError> {
    let data = file.metadata()?;
    if data.is_dir() {
        return Err(ReadError::IsDirectory);
    }
    if !data.is_file() {
        return Err(not_regular());
    }
    Ok(data.len())
}

pub(super) fn not_regular() -> ReadError {
    ReadError::Other(Value::Prose(&NOT_REGULAR))
}

/// Opens with `NONBLOCK`, since opening a pipe would otherwise wait for a writer.
#[cfg(unix)]
fn open_at_once(path: &Utf8Path) -> io::Result<File> {
    use rustix::fs::{Mode, OFlags};

    let flags = OFlags::RDONLY | OFlags::NONBLOCK | OFlags::NOCTTY | OFlags::CLOEXEC;
    Ok(rustix::fs::open(path.as_str(), flags, Mode::empty())?.into())
}

#[cfg(not(unix))]
#[expect(clippy::disallowed_methods, reason = "this is System's implementation: all IO comes here")]
fn open_at_once(path: &Utf8Path) -> io::Result<File> {
    held::waiting(|| File::open(path))
}
