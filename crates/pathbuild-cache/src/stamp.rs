//! Whether a file is as it was, without reading it: what the system says of it.
//!
//! As in Git, equal stamps mean an equal file only if the file had rested for a while when it was read: one that changes again within the
//! same tick of the file system's clock keeps its stamp. Whatever had not rested is kept without a stamp, and is read and hashed next time.
#![expect(
    clippy::disallowed_methods,
    reason = "the stat index is about files as the system has them, beside the drawings' bytes"
)]

use std::fs::{self, File, Metadata};
use std::io;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use camino::Utf8Path;

use crate::private;

/// What the system says of a file, as bytes that are compared as a whole: size, times of its last changes in whole seconds, the rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stamp([u8; Stamp::SIZE]);

/// The time by the clock that stamps the files of a directory, which need not be this machine's.
#[derive(Clone, Copy, Debug)]
pub struct Clock(SystemTime);

/// The name of the file whose time is looked at.
pub(crate) const CLOCK: &str = "clock";

/// The coarsest tick of a file system in use (FAT).
const TICK: Duration = Duration::from_secs(2);

impl Stamp {
    pub(crate) const SIZE: usize = 48;

    /// That of no file at all.
    pub const MISSING: Self = Self([0xFF; Self::SIZE]);

    /// One that no file has.
    pub const UNKNOWN: Self = Self([0; Self::SIZE]);

    /// That of a file, of what a link leads to; unknown where the system does not tell it.
    pub fn of(file: &Utf8Path) -> Self {
        match fs::metadata(file) {
            Ok(data) => Self::of_data(&data),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Self::MISSING,
            Err(_) => Self::UNKNOWN,
        }
    }

    /// That of an open file; unknown where the system does not tell it.
    pub fn of_open(file: &File) -> Self {
        file.metadata().map_or(Self::UNKNOWN, |data| Self::of_data(&data))
    }

    /// The same, to be kept by a run that began to read at `begun`: unknown if the file had not rested by then.
    #[must_use]
    pub fn settled(self, begun: Clock) -> Self {
        let is_of_file = self != Self::MISSING && self != Self::UNKNOWN;
        if is_of_file && !self.has_rested(begun) { Self::UNKNOWN } else { self }
    }

    /// Whether a file was last changed so long before a time that a later change would show.
    fn has_rested(self, Clock(begun): Clock) -> bool {
        let number =
            |index: usize| self.0[8 * index..].first_chunk().map_or(0, |bytes| u64::from_le_bytes(*bytes));
        // Before 1970 is not believed.
        let is_before = |seconds: u64| {
            let time = i64::try_from(seconds)
                .ok()
                .and_then(|_| UNIX_EPOCH.checked_add(Duration::from_secs(seconds)));
            // Parts of a second count as a whole one.
            time.and_then(|time| time.checked_add(TICK + Duration::from_secs(1)))
                .is_some_and(|time| time < begun)
        };
        is_before(number(1)) && is_before(number(2))
    }

    pub(crate) fn from_bytes(bytes: [u8; Self::SIZE]) -> Self {
        Self(bytes)
    }

    pub(crate) fn to_bytes(self) -> [u8; Self::SIZE] {
        self.0
    }

    fn of_data(data: &Metadata) -> Self {
        let mut stamp = [0; Self::SIZE];
        for (slot, number) in stamp.chunks_exact_mut(8).zip(numbers(data)) {
            slot.copy_from_slice(&number.to_le_bytes());
        }
        // Neither of the two that stand for something else: a kind is never 0 nor all ones.
        Self(stamp)
    }
}

impl Clock {
    /// What time it is where the files of a directory are stamped: that of a file made there.
    ///
    /// # Errors
    /// When none can be made.
    pub fn of(directory: &Utf8Path) -> io::Result<Self> {
        let (probe, file) = private::create_beside(directory, CLOCK)?;
        let time = file.metadata().and_then(|data| data.modified());
        // It may not even have been made.
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
