//! Reading a program back on another thread while it is being written.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{Builder, JoinHandle};

use pathbuild_gcode::native::is_read_back;
use pathbuild_toolpath::Program;

/// Where the parts of a program's text go.
pub(super) struct Follower {
    parts: SyncSender<String>,
    reading: JoinHandle<bool>,
}

/// So many parts may wait for being read, lest a large program be in memory twice.
const AHEAD: usize = 256;

impl Follower {
    /// Begins to read a program's text back; `None` where the system has no thread left.
    pub(super) fn begin(program: Arc<Program>) -> Option<Self> {
        let (parts, received): (_, Receiver<String>) = sync_channel(AHEAD);
        let read = move || is_read_back(received, &program);
        let reading = Builder::new().name("reading back".into()).spawn(read).ok()?;
        Some(Self { parts, reading })
    }

    /// The next part, of whole lines.
    pub(super) fn take(&self, part: &str) {
        // Who does not read any more has met a bug, which shows itself again when all is read.
        _ = self.parts.send(part.to_owned());
    }

    /// The text is complete: what tells whether it says what the program does.
    pub(super) fn end(self) -> JoinHandle<bool> {
        self.reading
    }
}
