//! Files that another program has open for itself alone, as a CAD does on Windows while it saves: they are waited for.

use std::io;
use std::thread;
use std::time::Duration;

use pathbuild_diagnostic::reasons::is_held;

/// Does what may find a file held by another program: again until the file is free, for two seconds at most.
///
/// # Errors
/// The last error.
pub(super) fn waiting<T>(attempt: impl FnMut() -> io::Result<T>) -> io::Result<T> {
    again_while(is_held, attempt, thread::sleep)
}

/// Tries again while an error `is_passing`.
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
/// Two seconds of pauses.
const PAUSES: u32 = 40;

#[cfg(test)]
mod tests {
    use super::*;

    /// What comes of a file that is held so many times, and how long it was waited for.
    fn held(times: u32) -> (bool, Duration) {
        let (mut left, mut waited) = (times, Duration::ZERO);
        let attempt = || {
            if left == 0 {
                return Ok(());
            }
            left -= 1;
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
