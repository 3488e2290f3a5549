//! File stamps. They show by the file system's metadata whether a file has changed, so that the file need not be read.
//!
//! As in Git, equal stamps prove that a file is unchanged only if it had been at rest for a while when it was read: a file that changes
//! again within the same tick of the file system's clock keeps its stamp. Files that were not at rest are stored without a stamp, and are
//! read and hashed by the next run.
#![expect(
    clippy::disallowed_methods,
    reason = "change detection reads the metadata of the real files, which are no input of a drawing"
)]

use std::fs::{self, File, Metadata};
use std::io;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use camino::Utf8Path;
use serde::{Deserialize, Serialize};

use crate::replace;

/// A file's metadata as numbers that are compared as a whole: the size, the times of its last changes in whole seconds, and further numbers of the
/// file system.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Stamp([u64; 6]);

/// The time by the clock of a directory's file system, which may differ from this machine's clock.
#[derive(Clone, Copy, Debug)]
pub struct FileSystemTime(SystemTime);

/// Base name of the temporary file whose modification time is the time of the file system, as in `.clock.123-0.tmp`.
pub const CLOCK: &str = "clock";

/// Coarsest time resolution of a file system in use (FAT).
const TICK: Duration = Duration::from_secs(2);

impl Stamp {
    /// Stamp of a file that does not exist.
    pub const MISSING: Self = Self([u64::MAX; 6]);

    /// A stamp that no file has.
    pub const UNKNOWN: Self = Self([0; 6]);

    /// Returns the stamp of a file, following symbolic links; [`UNKNOWN`](Self::UNKNOWN) if its metadata cannot be read.
    pub fn of(file: &Utf8Path) -> Self {
        match fs::metadata(file) {
            Ok(data) => Self::of_data(&data),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Self::MISSING,
            Err(_) => Self::UNKNOWN,
        }
    }

    /// Returns the stamp of an open file; [`UNKNOWN`](Self::UNKNOWN) if its metadata cannot be read.
    pub fn of_open(file: &File) -> Self {
        file.metadata().map_or(Self::UNKNOWN, |data| Self::of_data(&data))
    }

    /// Returns the stamp to store for a run that began reading at `begun`: [`UNKNOWN`](Self::UNKNOWN) if the file was not at rest by then.
    #[must_use]
    pub fn for_storing(self, begun: FileSystemTime) -> Self {
        let is_of_file = self != Self::MISSING && self != Self::UNKNOWN;
        if is_of_file && !self.is_old_enough(begun) { Self::UNKNOWN } else { self }
    }

    /// Whether the file's last change is old enough that a later one would alter the stamp.
    fn is_old_enough(self, FileSystemTime(begun): FileSystemTime) -> bool {
        // Times before 1970 are not trusted: a file with such a time is never considered old enough.
        let is_before = |seconds: u64| {
            let time = i64::try_from(seconds)
                .ok()
                .and_then(|_| UNIX_EPOCH.checked_add(Duration::from_secs(seconds)));
            // Fractions of a second are rounded up.
            time.and_then(|time| time.checked_add(TICK + Duration::from_secs(1)))
                .is_some_and(|time| time < begun)
        };
        is_before(self.0[1]) && is_before(self.0[2])
    }

    /// Returns a stamp that is neither `MISSING` nor `UNKNOWN`: its last number is never zero and never all ones.
    fn of_data(data: &Metadata) -> Self {
        Self(numbers(data))
    }
}

impl FileSystemTime {
    /// Returns the time an hour ago, by this machine's clock. A file that was at rest by then is at rest now, even if the clock of its file system
    /// differs by minutes.
    #[expect(
        clippy::disallowed_methods,
        reason = "decides which files are compared once more, and no result"
    )]
    pub fn an_hour_ago() -> Self {
        let now = SystemTime::now();
        Self(now.checked_sub(Duration::from_hours(1)).unwrap_or(UNIX_EPOCH))
    }

    /// Returns the current time of a directory's file system: the modification time of a new file in it.
    ///
    /// # Errors
    /// If no file can be created there.
    pub fn now_in(directory: &Utf8Path) -> io::Result<Self> {
        let (probe, file) = replace::create_temporary(&directory.join(CLOCK), true)?;
        let time = file.metadata().and_then(|data| data.modified());
        // Best effort: a leftover temporary file does no harm.
        _ = fs::remove_file(&probe);
        time.map(Self)
    }
}

#[cfg(unix)]
fn numbers(data: &Metadata) -> [u64; 6] {
    use std::os::unix::fs::MetadataExt;
    let nanoseconds = data.mtime_nsec().cast_unsigned() << 32 | data.ctime_nsec().cast_unsigned();
    let kind = u64::from(data.mode()) << 32 | 1;
    let place = data.ino() ^ data.dev().rotate_left(40);
    [data.len(), data.mtime().cast_unsigned(), data.ctime().cast_unsigned(), nanoseconds, place, kind]
}

#[cfg(not(unix))]
fn numbers(data: &Metadata) -> [u64; 6] {
    let part = |time: io::Result<SystemTime>| {
        let since = time.ok().and_then(|time| time.duration_since(UNIX_EPOCH).ok()).unwrap_or_default();
        (since.as_secs(), u64::from(since.subsec_nanos()))
    };
    let ((modified, modified_part), (created, created_part)) = (part(data.modified()), part(data.created()));
    let kind = u64::from(data.is_file()) << 1 | 1;
    [data.len(), modified, created, modified_part << 32 | created_part, 0, kind]
}
