//! A file system in which something happens to a file while it is read, listed or written.

use std::fs;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicI64, Ordering};
use std::time::{Duration, Instant};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::System;
use pathbuild_db::system::{Entry, FileKind, Listing, OsSystem, ReadError, Stamp, WriteOutcome};
use pathbuild_diagnostic::Value;

/// The event that happens to a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Event {
    /// The file is removed.
    Vanish,
    /// Other bytes are written into the file.
    Change,
    /// Another file with the same modification time takes its name.
    Replace,
    /// Reading the file fails this once.
    Fail,
    /// Reading the file triggers a bug.
    Panic,
    /// The file is unchanged, but work that begins now appears to have taken too long already.
    Busy,
}

/// The operating system's files, with one event. It happens just before or after the n-th time that a certain file is read or a certain directory is
/// listed, or after the n-th time that the file is written.
#[derive(Debug)]
pub(crate) struct Mischief {
    pub(crate) trigger: String,
    pub(crate) countdown: AtomicI64,
    /// Whether the event also happens every time after the n-th.
    pub(crate) lasts: bool,
    pub(crate) is_before: bool,
    pub(crate) event: Event,
    pub(crate) victim: Utf8PathBuf,
    pub(crate) bytes: Vec<u8>,
}

/// Time that is longer than the time limit for a path.
const LONG: Duration = Duration::from_secs(61);

impl Mischief {
    /// Reads a path with `read`. If the event is due, it happens just before or just after the read.
    fn around<T>(
        &self,
        path: &Utf8Path,
        read: impl FnOnce() -> Result<T, ReadError>,
    ) -> Result<T, ReadError> {
        match (self.is_now(path), self.is_before) {
            (false, _) => read(),
            (true, true) => {
                self.happen();
                read()
            }
            (true, false) if self.event == Event::Fail => {
                Err(ReadError::Other(Value::foreign("too many open files")))
            }
            (true, false) => {
                let result = read();
                self.happen();
                result
            }
        }
    }

    fn is_now(&self, path: &Utf8Path) -> bool {
        self.event != Event::Busy && path.as_str().ends_with(&self.trigger) && self.is_due()
    }

    fn is_due(&self) -> bool {
        let countdown = self.countdown.fetch_sub(1, Ordering::SeqCst);
        countdown == 1 || self.lasts && countdown < 1
    }

    fn happen(&self) {
        match self.event {
            Event::Vanish => _ = fs::remove_file(&self.victim),
            Event::Change => _ = fs::write(&self.victim, &self.bytes),
            Event::Replace => {
                let modified = fs::metadata(&self.victim).and_then(|data| data.modified());
                let beside = self.victim.with_extension("new");
                fs::write(&beside, &self.bytes).unwrap();
                if let Ok(modified) = modified {
                    fs::File::options().write(true).open(&beside).unwrap().set_modified(modified).unwrap();
                }
                fs::rename(beside, &self.victim).unwrap();
            }
            Event::Fail | Event::Busy => {}
            Event::Panic => panic!("a bug that {} shows", self.victim),
        }
    }
}

impl System for Mischief {
    fn read_into(&self, path: &Utf8Path, limit: u64, room: &mut Vec<u8>) -> Result<Stamp, ReadError> {
        self.around(path, || OsSystem.read_into(path, limit, room))
    }

    fn read_head(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        OsSystem.read_head(path, length)
    }

    fn list(&self, directory: &Utf8Path) -> Result<Listing, ReadError> {
        self.around(directory, || OsSystem.list(directory))
    }

    fn each_entry(
        &self,
        directory: &Utf8Path,
        take: &mut dyn FnMut(Entry<'_>) -> ControlFlow<()>,
    ) -> Result<(), ReadError> {
        self.around(directory, || OsSystem.each_entry(directory, take))
    }

    fn kind(&self, path: &Utf8Path) -> FileKind {
        OsSystem.kind(path)
    }

    fn canonical(&self, path: &Utf8Path) -> Utf8PathBuf {
        OsSystem.canonical(path)
    }

    fn write(&self, path: &Utf8Path, bytes: &[u8]) -> Result<WriteOutcome, Value> {
        let written = OsSystem.write(path, bytes);
        if self.is_now(path) {
            self.happen();
        }
        written
    }

    fn remove(&self, path: &Utf8Path) -> Result<(), Value> {
        OsSystem.remove(path)
    }

    fn now(&self) -> Option<Instant> {
        let is_busy = self.event == Event::Busy && self.is_due();
        Instant::now().checked_sub(if is_busy { LONG } else { Duration::ZERO })
    }
}
