//! The names in a directory of the operating system.

#![expect(clippy::disallowed_methods, reason = "this is System's implementation: all IO comes here")]

use std::fs;
use std::io;
use std::mem;

use camino::Utf8Path;

use crate::system::Listing;

/// The names in a directory, in the order in which the system gives them, some at a time.
///
/// # Errors
/// When there is no such directory, or it cannot be read.
pub(super) fn list_by_parts(directory: &Utf8Path, take: &mut dyn FnMut(Listing)) -> io::Result<()> {
    let mut part = Listing::default();
    each_name(directory, |entry| {
        let Some((name, kind)) = entry else { return take(mem::take(&mut part)) };
        // A link is what it leads to; one that leads nowhere is a file that cannot be read. Some file systems do not tell what a name is.
        let is_directory = match kind {
            Kind::Directory => true,
            Kind::Link | Kind::Untold => fs::metadata(directory.join(name)).is_ok_and(|data| data.is_dir()),
            Kind::File => false,
        };
        if is_directory { &mut part.directories } else { &mut part.files }.push(name);
    })
}

/// What a directory says of a name in it.
#[derive(Clone, Copy)]
enum Kind {
    File,
    Directory,
    Link,
    Untold,
}

#[cfg(not(target_os = "linux"))]
impl From<fs::FileType> for Kind {
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
fn each_name(directory: &Utf8Path, mut take: impl FnMut(Option<(&str, Kind)>)) -> io::Result<()> {
    use rustix::fs::{FileType, Mode, OFlags, RawDir};

    let flags = OFlags::RDONLY | OFlags::DIRECTORY | OFlags::CLOEXEC;
    let directory = rustix::fs::open(directory.as_str(), flags, Mode::empty())?;
    let mut buffer = Vec::with_capacity(BUFFER);
    let mut entries = RawDir::new(directory, buffer.spare_capacity_mut());
    while let Some(entry) = entries.next() {
        let entry = entry?;
        let kind = match entry.file_type() {
            FileType::Directory => Kind::Directory,
            FileType::Symlink => Kind::Link,
            FileType::Unknown => Kind::Untold,
            _ => Kind::File,
        };
        match entry.file_name().to_bytes() {
            b"." | b".." => {}
            name => match str::from_utf8(name) {
                Ok(name) => take(Some((name, kind))),
                Err(_) => take(Some((&String::from_utf8_lossy(name), kind))),
            },
        }
        if entries.is_buffer_empty() {
            take(None);
        }
    }
    Ok(())
}

/// Bytes for the names that the system gives at once.
#[cfg(target_os = "linux")]
const BUFFER: usize = 1 << 15;

/// Takes each name, and nothing at the end.
#[cfg(not(target_os = "linux"))]
fn each_name(directory: &Utf8Path, mut take: impl FnMut(Option<(&str, Kind)>)) -> io::Result<()> {
    for entry in fs::read_dir(directory)? {
        let entry = entry?;
        take(Some((&entry.file_name().to_string_lossy(), entry.file_type()?.into())));
    }
    take(None);
    Ok(())
}
