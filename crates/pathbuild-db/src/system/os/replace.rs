//! Writing a file whole or not at all: a temporary file beside it takes its name.
//!
//! Who writes a temporary file holds a lock on it. A run that was killed holds none any more: what it left is removed by the next run
//! that writes in that directory.

#![expect(clippy::disallowed_methods, reason = "this is System's implementation: all IO comes here")]

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind, Read, Write};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Value;
use pathbuild_diagnostic::reasons::{DIRECTORY_OF_THAT_NAME, NOT_REGULAR, reason};

use super::{debris, held, open, readable};
use crate::system::Written;

/// Gives a file these bytes, if it has others.
///
/// # Errors
/// When it cannot be written, or is a pipe, socket or device; nothing is left under the name that was not there before.
pub(super) fn replace(path: &Utf8Path, bytes: &[u8]) -> Result<Written, Value> {
    debris::remove(readable(parent(path)));
    match path.as_std_path().metadata() {
        Ok(data) if data.is_dir() => Err(Value::Word(&DIRECTORY_OF_THAT_NAME)),
        Ok(data) if !data.is_file() => Err(Value::Word(&NOT_REGULAR)),
        Ok(data) if data.len() == bytes.len() as u64 && holds(path, bytes) => Ok(Written::Unchanged),
        _ => write_anew(path, bytes).map_err(|error| reason(&error)),
    }
}

fn parent(path: &Utf8Path) -> &Utf8Path {
    path.parent().unwrap_or(Utf8Path::new(""))
}

fn write_anew(path: &Utf8Path, bytes: &[u8]) -> io::Result<Written> {
    let parent = parent(path);
    if !parent.as_str().is_empty() {
        fs::create_dir_all(parent)?;
    }
    let (temporary, mut file) = temporary(path)?;
    let written = file.write_all(bytes).and_then(|()| file.flush());
    // The lock is held until the name is the file's own.
    let renamed = written.and_then(|()| held::waiting(|| fs::rename(&temporary, path)));
    if renamed.is_err() {
        // Best effort: the error that is reported is the one that came first.
        _ = fs::remove_file(&temporary);
    }
    renamed.map(|()| Written::Changed)
}

/// Whether a file has just these bytes, looked at piece by piece.
fn holds(path: &Utf8Path, bytes: &[u8]) -> bool {
    let Ok(mut file) = open::open(path) else { return false };
    let mut piece = vec![0; 1 << 15];
    let mut rest = bytes;
    loop {
        match file.read(&mut piece) {
            Ok(0) => return rest.is_empty(),
            Ok(length) => match rest.split_at_checked(length) {
                Some((expected, behind)) if *expected == piece[..length] => rest = behind,
                _ => return false,
            },
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(_) => return false,
        }
    }
}

/// A new file beside `path`, locked, under a name that no other run of the program has taken.
fn temporary(path: &Utf8Path) -> io::Result<(Utf8PathBuf, File)> {
    let name = path.file_name().unwrap_or("output");
    for attempt in 0..1000_u32 {
        let candidate = path.with_file_name(format!(".{name}.{}-{attempt}.tmp", std::process::id()));
        match OpenOptions::new().write(true).create_new(true).open(&candidate) {
            Ok(file) => match file.try_lock() {
                // Another run took it for debris between these two lines, and removes it.
                Err(TryLockError::WouldBlock) => {}
                // It may be removed already.
                Ok(()) if candidate.as_std_path().symlink_metadata().is_err() => {}
                // Where there are no locks nothing is taken for debris.
                Ok(()) | Err(TryLockError::Error(_)) => return Ok((candidate, file)),
            },
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
    Err(io::Error::new(ErrorKind::AlreadyExists, "too many temporary files beside it"))
}
