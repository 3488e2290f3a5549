//! Directory listings of the operating system.

#![expect(clippy::disallowed_methods, reason = "this is System's implementation: all IO comes here")]

use std::fs;
use std::io;
use std::mem;
use std::ops::ControlFlow;

use camino::Utf8Path;

use super::debris;
use crate::{Entry, EntryKind, Listing};

/// Lists a directory in batches, in the order in which the system delivers the names.
///
/// # Errors
/// If the directory does not exist or cannot be read.
pub(super) fn list_by_parts(directory: &Utf8Path, take: &mut dyn FnMut(Listing)) -> io::Result<()> {
    let mut part = Listing::default();
    let mut temporary = Vec::new();
    each_name(directory, |entry| {
        let Some(Name { spelling: name, kind, .. }) = entry else {
            take(mem::take(&mut part));
            return ControlFlow::Continue(());
        };
        if debris::is_temporary(name) {
            temporary.push(directory.join(name));
        }
        // A link has the type of its target, and counts as an unreadable file if it is dangling. Some file systems do not report types.
        let is_directory = match kind {
            ListedKind::Directory => true,
            ListedKind::Link | ListedKind::Untold => {
                fs::metadata(directory.join(name)).is_ok_and(|data| data.is_dir())
            }
            ListedKind::File => false,
        };
        if is_directory { &mut part.directories } else { &mut part.files }.push(name);
        ControlFlow::Continue(())
    })?;
    debris::listed(directory, temporary);
    Ok(())
}

/// Calls `take` for each entry, with the type that the directory reports, until it asks to stop.
///
/// # Errors
/// As [`list_by_parts`].
pub(super) fn each_entry(
    directory: &Utf8Path,
    mut take: impl FnMut(Entry<'_>) -> ControlFlow<()>,
) -> io::Result<()> {
    each_name(directory, |entry| {
        let Some(Name { spelling: name, is_exact, kind }) = entry else { return ControlFlow::Continue(()) };
        let kind = match kind {
            ListedKind::Directory => EntryKind::Directory,
            ListedKind::Link => EntryKind::Link,
            ListedKind::File => EntryKind::File,
            ListedKind::Untold => entry_kind(&directory.join(name)),
        };
        take(Entry { name, is_exact, kind })
    })
}

/// Asks the system for the type of an entry if the directory does not report it.
fn entry_kind(path: &Utf8Path) -> EntryKind {
    match fs::symlink_metadata(path).map(|data| data.file_type()) {
        Ok(kind) if kind.is_dir() => EntryKind::Directory,
        Ok(kind) if kind.is_symlink() => EntryKind::Link,
        _ => EntryKind::File,
    }
}

/// A name as stored in a directory.
struct Name<'a> {
    spelling: &'a str,
    /// Whether the spelling is exact, not lossy.
    is_exact: bool,
    kind: ListedKind,
}

/// The type of an entry as reported by the directory.
#[derive(Clone, Copy)]
enum ListedKind {
    File,
    Directory,
    Link,
    Untold,
}

#[cfg(not(target_os = "linux"))]
impl From<fs::FileType> for ListedKind {
    fn from(kind: fs::FileType) -> Self {
        if kind.is_dir() {
            Self::Directory
        } else if kind.is_symlink() {
            Self::Link
        } else {
            Self::File
        }
    }
}

/// Calls `take` for each name, and with `None` before each wait for more. Uses the system call directly: the standard library copies each
/// name three times, which doubles the time for listing ten thousand.
#[cfg(target_os = "linux")]
fn each_name(
    directory: &Utf8Path,
    mut take: impl FnMut(Option<Name<'_>>) -> ControlFlow<()>,
) -> io::Result<()> {
    use std::borrow::Cow;

    use rustix::fs::{FileType, Mode, OFlags, RawDir};

    let flags = OFlags::RDONLY | OFlags::DIRECTORY | OFlags::CLOEXEC;
    let directory = rustix::fs::open(directory.as_str(), flags, Mode::empty())?;
    let mut buffer = Vec::with_capacity(BUFFER);
    let mut entries = RawDir::new(directory, buffer.spare_capacity_mut());
    while let Some(entry) = entries.next() {
        let entry = entry?;
        let kind = match entry.file_type() {
            FileType::Directory => ListedKind::Directory,
            FileType::Symlink => ListedKind::Link,
            FileType::Unknown => ListedKind::Untold,
            _ => ListedKind::File,
        };
        let flow = match entry.file_name().to_bytes() {
            b"." | b".." => ControlFlow::Continue(()),
            name => {
                let spelling =
                    str::from_utf8(name).map_or_else(|_| String::from_utf8_lossy(name), Cow::Borrowed);
                let is_exact = matches!(spelling, Cow::Borrowed(_));
                take(Some(Name { spelling: &spelling, is_exact, kind }))
            }
        };
        if flow.is_break() || entries.is_buffer_empty() && take(None).is_break() {
            break;
        }
    }
    Ok(())
}

/// Size in bytes of the buffer for one batch of names.
#[cfg(target_os = "linux")]
const BUFFER: usize = 1 << 15;

/// Calls `take` for each name, and with `None` at the end.
#[cfg(not(target_os = "linux"))]
fn each_name(
    directory: &Utf8Path,
    mut take: impl FnMut(Option<Name<'_>>) -> ControlFlow<()>,
) -> io::Result<()> {
    for entry in fs::read_dir(directory)? {
        let entry = entry?;
        let name = entry.file_name();
        let kind = entry.file_type().map_or(ListedKind::Untold, ListedKind::from);
        let name = Name { spelling: &name.to_string_lossy(), is_exact: name.to_str().is_some(), kind };
        if take(Some(name)).is_break() {
            return Ok(());
        }
    }
    _ = take(None);
    Ok(())
}
