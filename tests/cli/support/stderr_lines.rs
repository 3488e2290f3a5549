//! Collects the output of a running process.

use std::io::{BufRead, BufReader};
use std::process::Child;
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

/// The lines of a process's stderr as they arrive.
pub struct StderrLines(Receiver<String>);

/// Maximum time to wait for a line. It is long because a machine that builds everything in parallel is slow.
const PATIENCE: Duration = Duration::from_mins(1);

impl StderrLines {
    /// Starts reading the stderr of a process.
    pub fn by(child: &mut Child) -> Self {
        let stderr = BufReader::new(child.stderr.take().unwrap());
        let (sender, lines) = channel();
        std::thread::spawn(move || {
            stderr.lines().map_while(Result::ok).try_for_each(|line| sender.send(line))
        });
        Self(lines)
    }

    /// Waits for a line that contains a text, and returns the lines up to it.
    #[track_caller]
    pub fn until(&self, text: &str) -> Vec<String> {
        let mut seen = Vec::new();
        loop {
            let line = self.0.recv_timeout(PATIENCE);
            assert!(line.is_ok(), "`{text}` was not said: {seen:#?}");
            seen.extend(line);
            if seen.last().is_some_and(|line| line.contains(text)) {
                return seen;
            }
        }
    }
}
