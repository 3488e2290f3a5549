//! Atomic replacement of files: a temporary file in the same directory is renamed over the target.
//!
//! The writer holds a lock on its temporary file. A killed run loses its locks, so the next run that writes into the directory recognises
//! and removes what it left behind.

#![expect(clippy::disallowed_methods, reason = "this is System's implementation: all IO comes here")]

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind, Read, Write};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Value;
use pathbuild_diagnostic::reasons::{DIRECTORY_OF_THAT_NAME, NOT_REGULAR, TOO_MANY_TEMPORARY, error, reason};

use super::{debris, held, open, readable};
use crate::WriteOutcome;

/// Replaces the content of a file, unless it is already the same.
///
/// # Errors
/// If the file cannot be written, or is a pipe, socket or device. The path is then left as it was.
pub(super) fn replace(path: &Utf8Path, bytes: &[u8]) -> Result<WriteOutcome, Value> {
    debris::remove(readable(parent(path)));
    match path.as_std_path().metadata() {
        Ok(data) if data.is_dir() => Err(Value::Prose(&DIRECTORY_OF_THAT_NAME)),
        Ok(data) if !data.is_file() => Err(Value::Prose(&NOT_REGULAR)),
        Ok(data) if data.len() == bytes.len() as u64 && holds(path, bytes) => Ok(WriteOutcome::Unchanged),
        _ => write_anew(path, bytes).map_err(|error| reason(&error)),
    }
}

fn parent(path: &Utf8Path) -> &Utf8Path {
    path.parent().unwrap_or(Utf8Path::new(""))
}

fn write_anew(path: &Utf8Path, bytes: &[u8]) -> io::Result<WriteOutcome> {
    let parent = parent(path);
    if !parent.as_str().is_empty() {
        fs::create_dir_all(parent)?;
    }
    let (temporary, mut file) = temporary(path)?;
    let written = file.write_all(bytes).and_then(|()| file.flush());
    // The lock is held until the file has its final name.
    let renamed = written.and_then(|()| held::waiting(|| fs::rename(&temporary, path)));
    if renamed.is_err() {
        // Best effort: the first error is the one to report.
        _ = fs::remove_file(&temporary);
    }
    renamed.map(|()| WriteOutcome::Changed)
}

/// Whether a file has exactly these bytes, compared in chunks.
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

/// Creates and locks a temporary file beside `path`, under a name that no other run uses.
fn temporary(path: &Utf8Path) -> io::Result<(Utf8PathBuf, File)> {
    let name = path.file_name().unwrap_or("output");
    for attempt in 0..1000_u32 {
        let candidate = path.with_file_name(format!(".{name}.{}-{attempt}.tmp", std::process::id()));
        match OpenOptions::new().write(true).create_new(true).open(&candidate) {
            Ok(file) => match file.try_lock() {
                // Another run mistook the file for debris before it was locked, and is removing it.
                Err(TryLockError::WouldBlock) => {}
                // It may have been removed already.
                Ok(()) if candidate.as_std_path().symlink_metadata().is_err() => {}
                // Without support for locks, nothing is ever considered debris.
                Ok(()) | Err(TryLockError::Error(_)) => return Ok((candidate, file)),
            },
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
    Err(error(ErrorKind::AlreadyExists, &TOO_MANY_TEMPORARY))
}
