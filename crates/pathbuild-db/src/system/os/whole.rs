//! Reading a file from its first to its last byte.

use std::fs::File;
use std::io::{self, ErrorKind};

use super::open::{not_regular, regular_size};
use crate::system::ReadError;

/// Most drawings have less.
const USUAL: usize = 1 << 16;

/// Reads a file of at most `limit` bytes into `room`, and gives back how many it has; `room` may have more.
///
/// # Errors
/// When it is no regular file, cannot be read, or has more bytes.
pub(super) fn read(file: &File, limit: u64, room: &mut Vec<u8>) -> Result<usize, ReadError> {
    if room.len() < USUAL {
        room.resize(USUAL, 0);
    }
    let mut length = fill(file, room, 0)?;
    // Asking what a file is and how large takes a twelfth of the time of reading a drawing. Who gave some bytes at a place, but not as many
    // as there was room for, need not be asked.
    if length == 0 || length == room.len() {
        let size = regular_size(file)?;
        if size > limit {
            return Err(ReadError::TooLarge { size });
        }
        // One byte more than there should be: a file may grow between the question for its size and the last byte.
        room.resize(usize::try_from(size).unwrap_or(usize::MAX).saturating_add(1).max(room.len()), 0);
        length = fill(file, room, length)?;
    }
    while length == room.len() && length as u64 <= limit {
        room.resize(2 * length, 0);
        length = fill(file, room, length)?;
    }
    if length as u64 > limit { Err(ReadError::TooLarge { size: length as u64 }) } else { Ok(length) }
}

/// Reads on from where `room` is filled to, until there is no more, or no more room; how far it is filled then.
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

/// Whether these bytes end as a drawing does: then nobody has to ask whether there are more.
fn is_end(bytes: &[u8]) -> bool {
    let text = bytes.trim_ascii_end();
    text.ends_with(b"\nEOF")
}

/// Reads at a place, which no pipe has.
#[cfg(unix)]
fn read_at(file: &File, room: &mut [u8], place: u64) -> io::Result<usize> {
    std::os::unix::fs::FileExt::read_at(file, room, place)
}

/// Reads on.
#[cfg(windows)]
fn read_at(file: &File, room: &mut [u8], place: u64) -> io::Result<usize> {
    std::os::windows::fs::FileExt::seek_read(file, room, place)
}
