//! Private directories and files: created with access for their owner only, never created or read through symbolic links, and not used if
//! they belong to another user.
#![expect(clippy::disallowed_methods, reason = "these are the cache's own files; no result depends on them")]

use std::fs::{self, DirBuilder, Metadata, OpenOptions};
use std::io::{self, Read};

use camino::Utf8Path;
use pathbuild_diagnostic::reasons::{
    IS_LINK, NEVER_SO_LARGE, NO_DIRECTORY_BUT_FILE, NO_OWN_FILE, NOT_INSPECTED, OF_OTHER_USER, OPEN_TO_ALL,
    reason,
};
use pathbuild_diagnostic::{Text, Value};

use crate::replace;

/// Creates a directory and its missing parents. Returns whether it is new.
///
/// # Errors
/// If it cannot be created.
pub fn make_directory(directory: &Utf8Path) -> io::Result<bool> {
    if fs::symlink_metadata(directory).is_ok() {
        return Ok(false);
    }
    let mut builder = DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.create(directory).map(|()| true)
}

/// Returns the reason why a directory must not be used; `None` if it is safe or does not exist yet.
pub fn refusal(directory: &Utf8Path) -> Option<&'static Text> {
    match fs::symlink_metadata(directory) {
        Ok(data) if data.is_symlink() => Some(&IS_LINK),
        Ok(data) if !data.is_dir() => Some(&NO_DIRECTORY_BUT_FILE),
        Ok(data) if !is_own(&data) => Some(&OF_OTHER_USER),
        Ok(data) if is_open_to_all(&data) => Some(&OPEN_TO_ALL),
        Ok(_) => None,
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(_) => Some(&NOT_INSPECTED),
    }
}

/// Reads a regular file that belongs to this user; returns `None` if nothing exists at this path.
///
/// # Errors
/// If the file cannot be read, is not a regular file of this user, or is larger than `limit` bytes.
pub fn read(path: &Utf8Path, limit: u64) -> Result<Option<Vec<u8>>, Value> {
    let mut options = OpenOptions::new();
    options.read(true);
    // Do not follow a symbolic link, and do not wait for the writer of a pipe.
    #[cfg(unix)]
    {
        let flags = rustix::fs::OFlags::NOFOLLOW | rustix::fs::OFlags::NONBLOCK;
        std::os::unix::fs::OpenOptionsExt::custom_flags(&mut options, flags.bits().cast_signed());
    }
    let file = match options.open(path) {
        Ok(file) => file,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(reason(&error)),
    };
    let data = file.metadata().map_err(|error| reason(&error))?;
    if !data.is_file() || !is_own(&data) {
        return Err(Value::Prose(&NO_OWN_FILE));
    }
    if data.len() > limit {
        return Err(Value::Prose(&NEVER_SO_LARGE));
    }
    // The file may grow while it is read, so limit the read as well.
    let mut bytes = Vec::with_capacity(usize::try_from(data.len()).unwrap_or_default());
    file.take(limit.saturating_add(1)).read_to_end(&mut bytes).map_err(|error| reason(&error))?;
    if bytes.len() as u64 > limit { Err(Value::Prose(&NEVER_SO_LARGE)) } else { Ok(Some(bytes)) }
}

/// Atomically replaces a file. An existing symbolic link is replaced, not followed.
///
/// # Errors
/// If it cannot be written; the previous file remains.
pub fn replace(directory: &Utf8Path, name: &str, bytes: &[u8]) -> io::Result<()> {
    replace::write(&directory.join(name), bytes, true)
}

/// Removes a file. It is not an error if the file is already gone.
///
/// # Errors
/// If it cannot be removed.
pub fn remove(path: &Utf8Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

#[cfg(unix)]
fn is_own(data: &Metadata) -> bool {
    std::os::unix::fs::MetadataExt::uid(data) == rustix::process::geteuid().as_raw()
}

#[cfg(not(unix))]
fn is_own(_: &Metadata) -> bool {
    true
}

#[cfg(unix)]
fn is_open_to_all(data: &Metadata) -> bool {
    std::os::unix::fs::MetadataExt::mode(data) & 0o002 != 0
}

#[cfg(not(unix))]
fn is_open_to_all(_: &Metadata) -> bool {
    false
}
