//! Atomic replacement of files: a temporary file in the same directory is renamed over the target.
//!
//! The writer holds a lock on its temporary file. A killed run loses its locks, so the next run that writes into the directory recognises and
//! removes the files that it left behind.
#![expect(clippy::disallowed_methods, reason = "this is System's implementation: all IO comes here")]

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind, Write};
use std::thread;
use std::time::Duration;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::reasons::{TOO_MANY_TEMPORARY, WRITE_PROTECTED, is_opened_exclusively, text_error};

/// Replaces a file; refuses to if it is write-protected. An existing link is replaced and not followed. Only the owner has access to a private file.
///
/// # Errors
/// If it cannot be written; the previous file remains.
pub(crate) fn write(path: &Utf8Path, bytes: &[u8], is_private: bool) -> io::Result<()> {
    // Renaming needs access to the directory only, so it would also replace a write-protected file.
    if fs::symlink_metadata(path).is_ok_and(|data| data.is_file() && data.permissions().readonly()) {
        return Err(text_error(ErrorKind::PermissionDenied, &WRITE_PROTECTED));
    }
    let (temporary, mut file) = create_temporary(path, is_private)?;
    let written = file.write_all(bytes).and_then(|()| file.flush());
    // `file` stays open, and so locked, until it has its final name: another run removes unlocked temporary files as leftovers.
    let renamed = written.and_then(|()| retry_while_busy(|| fs::rename(&temporary, path)));
    // Best effort: the first error is the one to report.
    renamed.inspect_err(|_| _ = fs::remove_file(&temporary))
}

/// Creates and locks a temporary file beside `path`, under a name that no other run uses.
///
/// # Errors
/// If it cannot be created.
#[cfg_attr(not(unix), expect(unused_variables, reason = "elsewhere the directory decides who has access"))]
pub(crate) fn create_temporary(path: &Utf8Path, is_private: bool) -> io::Result<(Utf8PathBuf, File)> {
    let name = path.file_name().unwrap_or("output");
    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    if is_private {
        std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    }
    for attempt in 0..MAX_NAME_ATTEMPTS {
        let candidate = path.with_file_name(format!(".{name}.{}-{attempt}.tmp", std::process::id()));
        match options.open(&candidate) {
            Ok(file) => match file.try_lock() {
                // Another run mistook the file for a leftover before it was locked, and is removing it.
                Err(TryLockError::WouldBlock) => {}
                // Another run may have removed the file before it was locked.
                Ok(()) if candidate.as_std_path().symlink_metadata().is_err() => {}
                // On file systems without locks, no file is ever taken for a leftover.
                Ok(()) | Err(TryLockError::Error(_)) => return Ok((candidate, file)),
            },
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
    Err(text_error(ErrorKind::AlreadyExists, &TOO_MANY_TEMPORARY))
}

/// Number of names tried for a temporary file: killed runs with the same process id may have left theirs.
const MAX_NAME_ATTEMPTS: u32 = 1000;

/// Whether a name has the form `.NAME.123-0.tmp` of a temporary file, where `is_name` accepts NAME.
pub fn is_temporary(name: &str, is_name: impl Fn(&str) -> bool) -> bool {
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    name.strip_prefix('.')
        .and_then(|name| name.strip_suffix(".tmp"))
        .and_then(|name| name.rsplit_once('.'))
        .and_then(|(name, numbers)| numbers.split_once('-').filter(|_| is_name(name)))
        .is_some_and(|(process, attempt)| is_number(process) && is_number(attempt))
}

/// Retries an operation for up to two seconds while it fails because another program has locked the file for exclusive use, as CAD programs
/// on Windows do while saving.
///
/// # Errors
/// The last error.
pub(crate) fn retry_while_busy<T>(attempt: impl FnMut() -> io::Result<T>) -> io::Result<T> {
    retry_while(is_opened_exclusively, attempt, thread::sleep)
}

fn retry_while<T>(
    is_passing: impl Fn(&io::Error) -> bool,
    mut attempt: impl FnMut() -> io::Result<T>,
    mut pause: impl FnMut(Duration),
) -> io::Result<T> {
    for _ in 0..MAX_PAUSES {
        match attempt() {
            Err(error) if is_passing(&error) => pause(RETRY_PAUSE),
            result => return result,
        }
    }
    attempt()
}

const RETRY_PAUSE: Duration = Duration::from_millis(50);
/// Number of pauses between attempts: two seconds in total.
const MAX_PAUSES: u32 = 40;

#[cfg(test)]
mod tests {
    use super::*;

    /// Simulates a file that is locked for this many attempts. Returns whether the operation succeeds, and the time waited.
    fn retry_locked(times: u32) -> (bool, Duration) {
        let (mut remaining, mut waited) = (times, Duration::ZERO);
        let attempt = || {
            if remaining == 0 {
                return Ok(());
            }
            remaining -= 1;
            Err(io::Error::from(ErrorKind::ResourceBusy))
        };
        let result =
            retry_while(|error| error.kind() == ErrorKind::ResourceBusy, attempt, |pause| waited += pause);
        (result.is_ok(), waited)
    }

    #[test]
    fn a_held_file_is_waited_for_two_seconds_and_no_longer() {
        assert_eq!(retry_locked(0), (true, Duration::ZERO));
        assert_eq!(retry_locked(3), (true, 3 * RETRY_PAUSE));
        assert_eq!(retry_locked(MAX_PAUSES), (true, Duration::from_secs(2)));
        assert_eq!(retry_locked(MAX_PAUSES + 1), (false, Duration::from_secs(2)));
    }

    #[test]
    fn other_errors_are_not_waited_for() {
        let waited = retry_while(
            is_opened_exclusively,
            || Err::<(), _>(ErrorKind::NotFound.into()),
            |_| panic!("a pause"),
        );
        assert_eq!(waited.unwrap_err().kind(), ErrorKind::NotFound);
    }
}
