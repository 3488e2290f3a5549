//! Reads whole files.

use std::fs::File;
use std::io::{self, ErrorKind};

use super::open::{not_regular, regular_size};
use crate::ReadError;

/// Initial size of the buffer in bytes. Most drawings are smaller.
const USUAL: usize = 1 << 16;

/// Reads a file of at most `limit` bytes into `room`, and returns its length. `room` may be longer.
///
/// # Errors
/// If it is not a regular file, cannot be read, or is larger than `limit`.
pub(super) fn read(file: &File, limit: u64, room: &mut Vec<u8>) -> Result<usize, ReadError> {
    if room.len() < USUAL {
        room.resize(USUAL, 0);
    }
    let mut length = fill(file, room, 0)?;
    // Querying type and size takes a twelfth of the time of reading a drawing. It is skipped for a file that delivered some bytes, but
    // fewer than the buffer holds.
    if length == 0 || length == room.len() {
        let size = regular_size(file)?;
        if size > limit {
            return Err(ReadError::TooLarge { size });
        }
        // One byte more than the reported size, since the file may grow in the meantime.
        room.resize(usize::try_from(size).unwrap_or(usize::MAX).saturating_add(1).max(room.len()), 0);
        length = fill(file, room, length)?;
    }
    while length == room.len() && length as u64 <= limit {
        room.resize(2 * length, 0);
        length = fill(file, room, length)?;
    }
    if length as u64 > limit { Err(ReadError::TooLarge { size: length as u64 }) } else { Ok(length) }
}

/// Reads from offset `filled` until the file ends or `room` is full. Returns the new offset.
fn fill(file: &File, room: &mut [u8], mut filled: usize) -> Result<usize, ReadError> {
    while filled < room.len() {
        match read_at(file, &mut room[filled..], filled as u64) {
            Ok(0) => break,
            Ok(read) => filled += read,
            Err(error) if error.kind() == ErrorKind::Interrupted => continue,
            Err(error) if error.kind() == ErrorKind::NotSeekable => return Err(not_regular()),
            Err(error) => return Err(error.into()),
        }
        if is_end(&room[..filled]) {
            break;
        }
    }
    Ok(filled)
}

/// Whether these bytes end as a drawing does, so that there is no need to check for more.
fn is_end(bytes: &[u8]) -> bool {
    let text = bytes.trim_ascii_end();
    text.ends_with(b"\nEOF")
}

/// Reads at an offset, which pipes do not support.
#[cfg(unix)]
fn read_at(file: &File, room: &mut [u8], place: u64) -> io::Result<usize> {
    std::os::unix::fs::FileExt::read_at(file, room, place)
}

/// Reads at an offset.
#[cfg(windows)]
fn read_at(file: &File, room: &mut [u8], place: u64) -> io::Result<usize> {
    std::os::windows::fs::FileExt::seek_read(file, room, place)
}
