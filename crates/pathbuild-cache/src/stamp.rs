//! Whether a file is as it was, without reading it: what the system says of it.
//!
//! As in Git, equal stamps mean an equal file only if the file had rested for a while when it was read: one that changes again within the
//! same tick of the file system's clock keeps its stamp. Whatever had not rested is kept without a stamp, and is read and hashed next time.
#![expect(
    clippy::disallowed_methods,
    reason = "the stat index is about files as the system has them, beside the drawings' bytes"
)]

use std::fs::{self, Metadata};
use std::io;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use camino::Utf8Path;

use crate::private;

/// What the system says of a file, as bytes that are compared as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stamp([u8; Stamp::SIZE]);

/// The time by the clock that stamps the files of a directory, which need not be this machine's.
#[derive(Clone, Copy, Debug)]
pub struct Clock(SystemTime);

/// The coarsest tick of a file system in use (FAT).
const TICK: Duration = Duration::from_secs(2);

impl Stamp {
    pub(crate) const SIZE: usize = 48;

    /// That of no file at all.
    pub const MISSING: Self = Self([0xFF; Self::SIZE]);

    /// One that no file has.
    pub const UNKNOWN: Self = Self([0; Self::SIZE]);

    /// That of a file, of what a link leads to.
    pub fn of(file: &Utf8Path) -> Self {
        fs::metadata(file).map_or(Self::MISSING, |data| Self::of_data(&data))
    }

    /// The same, to be kept by a run that began to read at `begun`: unknown if the file had not rested by then.
    pub fn settled(file: &Utf8Path, begun: Clock) -> Self {
        match fs::metadata(file) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Self::MISSING,
            Ok(data) if has_rested(&data, begun) => Self::of_data(&data),
            _ => Self::UNKNOWN,
        }
    }

    /// Whether a file changed while a run that began at `begun` was reading. What the run read of it first may not be what it read of it last.
    pub fn has_changed_since(file: &Utf8Path, Clock(begun): Clock) -> bool {
        fs::metadata(file).and_then(|data| data.modified()).is_ok_and(|modified| modified > begun)
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
        let (probe, file) = private::create_beside(directory, "clock")?;
        let time = file.metadata().and_then(|data| data.modified());
        // It may not even have been made.
        _ = fs::remove_file(&probe);
        time.map(Self)
    }
}

/// Whether a file was last changed so long before a time that a later change would show.
fn has_rested(data: &Metadata, Clock(begun): Clock) -> bool {
    let is_before = |time: SystemTime| time.checked_add(TICK).is_some_and(|time| time < begun);
    data.modified().is_ok_and(is_before) && changed(data).is_none_or(is_before)
}

#[cfg(unix)]
fn changed(data: &Metadata) -> Option<SystemTime> {
    use std::os::unix::fs::MetadataExt;
    let seconds = Duration::from_secs(u64::try_from(data.ctime()).ok()?);
    UNIX_EPOCH.checked_add(seconds)
}

#[cfg(not(unix))]
fn changed(_: &Metadata) -> Option<SystemTime> {
    None
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
