//! The names in a directory of the operating system.

#![expect(clippy::disallowed_methods, reason = "this is System's implementation: all IO comes here")]

use std::fs;
use std::io;
use std::mem;
use std::ops::ControlFlow;

use camino::Utf8Path;

use super::debris;
use crate::system::{Entry, EntryKind, Listing};

/// The names in a directory, in the order in which the system gives them, some at a time.
///
/// # Errors
/// When there is no such directory, or it cannot be read.
pub(super) fn list_by_parts(directory: &Utf8Path, take: &mut dyn FnMut(Listing)) -> io::Result<()> {
    let mut part = Listing::default();
    let mut left = Vec::new();
    each_name(directory, |entry| {
        let Some(Name { spelling: name, kind, .. }) = entry else {
            take(mem::take(&mut part));
            return ControlFlow::Continue(());
        };
        if debris::is_temporary(name) {
            left.push(directory.join(name));
        }
        // A link is what it leads to; one that leads nowhere is a file that cannot be read. Some file systems do not tell what a name is.
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
    debris::listed(directory, left);
    Ok(())
}

/// Each name in a directory with what the directory itself says of it, until `take` has enough.
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
            ListedKind::Untold => told(&directory.join(name)),
        };
        take(Entry { name, is_exact, kind })
    })
}

/// What the system says of a name of which the directory says nothing.
fn told(path: &Utf8Path) -> EntryKind {
    match fs::symlink_metadata(path).map(|data| data.file_type()) {
        Ok(kind) if kind.is_dir() => EntryKind::Directory,
        Ok(kind) if kind.is_symlink() => EntryKind::Link,
        _ => EntryKind::File,
    }
}

/// A name, as a directory has it.
struct Name<'a> {
    spelling: &'a str,
    /// Whether it has no other.
    is_exact: bool,
    kind: ListedKind,
}

/// What a directory says of a name in it.
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

/// Takes each name, and nothing whenever the next must be waited for. By the system call itself: the standard library makes three copies of each name, which is half of the time of listing ten thousand.
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

/// Bytes for the names that the system gives at once.
#[cfg(target_os = "linux")]
const BUFFER: usize = 1 << 15;

/// Takes each name, and nothing at the end.
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
