//! Directories and files that belong to one person: made for their owner only, never made or read through links, and not used where they
//! are somebody else's.
#![expect(clippy::disallowed_methods, reason = "the cache's own files, which no result depends on")]

use std::fs::{self, DirBuilder, File, Metadata, OpenOptions};
use std::io::{self, Read, Write};

use camino::{Utf8Path, Utf8PathBuf};

/// Makes a directory with those above it that are missing; whether it was not there.
///
/// # Errors
/// When it cannot be made.
pub(crate) fn make_directory(directory: &Utf8Path) -> io::Result<bool> {
    if fs::symlink_metadata(directory).is_ok() {
        return Ok(false);
    }
    let mut builder = DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.create(directory).map(|()| true)
}

/// Why a directory is not used; nothing where it is not there yet.
pub(crate) fn refusal(directory: &Utf8Path) -> Option<&'static str> {
    match fs::symlink_metadata(directory) {
        Ok(data) if data.is_symlink() => Some("it is a link"),
        Ok(data) if !data.is_dir() => Some("it is no directory"),
        Ok(data) if !is_own(&data) => Some("it belongs to somebody else"),
        Ok(data) if is_open_to_all(&data) => Some("everybody may write into it"),
        Ok(_) => None,
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(_) => Some("it cannot be looked at"),
    }
}

/// The bytes of a file, if it is a regular one of this person; `None` where there is none.
///
/// # Errors
/// When it cannot be read, or is something else.
pub(crate) fn read(path: &Utf8Path) -> io::Result<Option<Vec<u8>>> {
    let mut options = OpenOptions::new();
    options.read(true);
    // A link is not followed, and nobody waits for who writes into a pipe.
    #[cfg(unix)]
    {
        let flags = rustix::fs::OFlags::NOFOLLOW | rustix::fs::OFlags::NONBLOCK;
        std::os::unix::fs::OpenOptionsExt::custom_flags(&mut options, flags.bits().cast_signed());
    }
    let mut file = match options.open(path) {
        Ok(file) => file,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error),
    };
    let data = file.metadata()?;
    if !data.is_file() || !is_own(&data) {
        return Err(io::Error::other("it is no file of this user"));
    }
    let mut bytes = Vec::with_capacity(usize::try_from(data.len()).unwrap_or_default());
    file.read_to_end(&mut bytes)?;
    Ok(Some(bytes))
}

/// Makes a file that was not there, with a name of its own that begins with a point.
///
/// # Errors
/// When it cannot be made.
pub(crate) fn create_beside(directory: &Utf8Path, name: &str) -> io::Result<(Utf8PathBuf, File)> {
    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    for attempt in 0..ATTEMPTS {
        let path = directory.join(format!(".{name}.{}-{attempt}.tmp", std::process::id()));
        match options.open(&path) {
            Ok(file) => return Ok((path, file)),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
    Err(io::Error::other("too many temporary files"))
}

/// Puts a file in the place of another, whole or not at all. What lay there, a link too, is replaced and not followed.
///
/// # Errors
/// When it cannot be written; what was there still is.
pub(crate) fn replace(directory: &Utf8Path, name: &str, bytes: &[u8]) -> io::Result<()> {
    let (beside, mut file) = create_beside(directory, name)?;
    let written = file.write_all(bytes).and_then(|()| fs::rename(&beside, directory.join(name)));
    if written.is_err() {
        // Best effort: the error that is reported is the one that came first.
        _ = fs::remove_file(&beside);
    }
    written
}

/// Removes a file. That somebody else removed it is no error.
///
/// # Errors
/// When it cannot be removed.
pub(crate) fn remove(path: &Utf8Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// So many names are tried for a file that must be new: killed runs of the same number may have left theirs.
const ATTEMPTS: u32 = 100;

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
