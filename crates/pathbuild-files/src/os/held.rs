//! Retries operations on files that another program has locked for exclusive use, as CAD programs on Windows do while saving.

use std::io;
use std::thread;
use std::time::Duration;

use pathbuild_diagnostic::reasons::is_held;

/// Retries an operation for up to two seconds while it fails because another program has locked the file.
///
/// # Errors
/// The last error.
pub(super) fn waiting<T>(attempt: impl FnMut() -> io::Result<T>) -> io::Result<T> {
    again_while(is_held, attempt, thread::sleep)
}

/// Retries an operation while its error satisfies `is_passing`.
fn again_while<T>(
    is_passing: impl Fn(&io::Error) -> bool,
    mut attempt: impl FnMut() -> io::Result<T>,
    mut pause: impl FnMut(Duration),
) -> io::Result<T> {
    for _ in 0..PAUSES {
        match attempt() {
            Err(error) if is_passing(&error) => pause(PAUSE),
            result => return result,
        }
    }
    attempt()
}

const PAUSE: Duration = Duration::from_millis(50);
/// Number of pauses between attempts: two seconds in total.
const PAUSES: u32 = 40;

#[cfg(test)]
mod tests {
    use super::*;

    /// Simulates a file that is locked for this many attempts. Returns whether the operation succeeds, and the time waited.
    fn held(times: u32) -> (bool, Duration) {
        let (mut remaining, mut waited) = (times, Duration::ZERO);
        let attempt = || {
            if remaining == 0 {
                return Ok(());
            }
            remaining -= 1;
            Err(io::Error::from(io::ErrorKind::ResourceBusy))
        };
        let result = again_while(
            |error| error.kind() == io::ErrorKind::ResourceBusy,
            attempt,
            |pause| waited += pause,
        );
        (result.is_ok(), waited)
    }

    #[test]
    fn a_held_file_is_waited_for_two_seconds_and_no_longer() {
        assert_eq!(held(0), (true, Duration::ZERO));
        assert_eq!(held(3), (true, 3 * PAUSE));
        assert_eq!(held(PAUSES), (true, Duration::from_secs(2)));
        assert_eq!(held(PAUSES + 1), (false, Duration::from_secs(2)));
    }

    #[test]
    fn other_errors_are_not_waited_for() {
        let waited =
            again_while(is_held, || Err::<(), _>(io::ErrorKind::NotFound.into()), |_| panic!("a pause"));
        assert_eq!(waited.unwrap_err().kind(), io::ErrorKind::NotFound);
    }
}
