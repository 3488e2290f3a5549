//! Tests the progress bar, which appears after half a second and disappears when the work is done. (book: reference/commands)

use std::io::{self, Write};
use std::sync::{Arc, Mutex};
use std::thread::sleep;
use std::time::Duration;

use pathbuild::printer::Progress;
use pathbuild_workspace::ProgressCounter;

/// A stream whose text can be inspected.
#[derive(Clone, Default)]
struct Screen(Arc<Mutex<Vec<u8>>>);

impl Write for Screen {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().map_err(|_| io::Error::other("poisoned"))?.extend(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Screen {
    fn text(&self) -> String {
        String::from_utf8_lossy(&self.0.lock().expect("no thread panicked")).into_owned()
    }
}

#[test]
fn work_of_less_than_half_a_second_shows_nothing() {
    let screen = Screen::default();
    let progress = Progress::new(2, Box::new(screen.clone()));
    progress.advance();
    drop(progress);
    assert_eq!(screen.text(), "");
}

#[test]
fn longer_work_shows_how_far_it_is_and_clears_the_line() {
    let screen = Screen::default();
    let progress = Progress::new(3, Box::new(screen.clone()));
    progress.advance();
    sleep(Duration::from_millis(1500));
    progress.advance();
    sleep(Duration::from_millis(500));
    drop(progress);
    let text = screen.text();
    assert!(text.contains("[##########--------------------] 1/3"), "{text:?}");
    assert!(text.contains("[####################----------] 2/3"), "{text:?}");
    assert!(text.ends_with("\r\u{1b}[K"), "{text:?}");
}

#[test]
fn a_stream_that_is_closed_ends_the_bar_and_nothing_else() {
    struct Closed;
    impl Write for Closed {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::ErrorKind::BrokenPipe.into())
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    let progress = Progress::new(0, Box::new(Closed));
    sleep(Duration::from_millis(700));
    progress.advance();
}
