//! Directories that are listed while somebody works already: the names of drawings as they come, for guessing where paths are, and in the end
//! all of them, for knowing it.

use std::collections::VecDeque;
use std::fmt;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

use camino::Utf8PathBuf;
use pathbuild_path::{FilePattern, PathKey};
use rustc_hash::FxHashMap;

use crate::inputs::Directory;
use crate::queries::{GatheredNames, NameTable};
use crate::system::{Names, System};

/// What is known so far of directories that are being listed.
#[derive(Debug, Default)]
pub struct Arrivals {
    underway: Mutex<FxHashMap<Directory, Arrived>>,
    changed: Condvar,
}

/// The names of a directory so far.
#[derive(Debug)]
struct Arrived {
    pattern: FilePattern,
    /// What has come and nobody has looked at yet.
    unread: VecDeque<Names>,
    names: GatheredNames,
    /// Whether no more will come.
    is_complete: bool,
    /// Whether they are all.
    are_all: bool,
}

/// Lists a directory, on any thread.
pub struct Lister {
    pub(crate) system: Arc<dyn System>,
    pub(crate) arrivals: Arc<Arrivals>,
    pub(crate) directory: Directory,
    pub(crate) path: Utf8PathBuf,
}

impl Lister {
    /// Lists it. The names are looked at by whoever waits for them.
    pub fn run(self) {
        let listed = self.system.list_by_parts(&self.path, &mut |part| {
            self.change(|arrived| arrived.unread.push_back(part.files));
        });
        self.change(|arrived| arrived.are_all = listed.is_ok());
    }

    fn change(&self, change: impl FnOnce(&mut Arrived)) {
        self.arrivals.underway().get_mut(&self.directory).map(change);
        self.arrivals.changed.notify_all();
    }
}

impl Drop for Lister {
    /// Nobody may wait for ever, even if there was no thread for it, or there is a bug.
    fn drop(&mut self) {
        self.change(|arrived| arrived.is_complete = true);
    }
}

impl Arrived {
    /// Looks at some names that have come, if there are any.
    fn read_part(&mut self) -> bool {
        let part = self.unread.pop_front();
        part.inspect(|part| self.names.add(part, &self.pattern)).is_some()
    }
}

impl fmt::Debug for Lister {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Lister").field("path", &self.path).finish_non_exhaustive()
    }
}

impl Arrivals {
    /// A directory will be listed.
    pub(crate) fn begin(&self, directory: Directory, pattern: FilePattern) {
        let arrived = Arrived {
            pattern,
            unread: VecDeque::new(),
            names: GatheredNames::default(),
            is_complete: false,
            are_all: false,
        };
        self.underway().insert(directory, arrived);
    }

    /// A directory has been listed already.
    pub(crate) fn put(&self, directory: Directory, pattern: FilePattern, names: Names) {
        let whole = || Arrived {
            pattern,
            unread: VecDeque::from([names]),
            names: GatheredNames::default(),
            is_complete: true,
            are_all: true,
        };
        self.underway().entry(directory).or_insert_with(whole);
    }

    /// The names that may hold a path and come first; waits for them.
    pub(crate) fn find(&self, directory: Directory, key: &PathKey) -> Vec<String> {
        let mut seen = 0;
        let mut underway = self.underway();
        while let Some(arrived) = underway.get_mut(&directory) {
            let found = arrived.names.find(key, seen);
            seen = arrived.names.len();
            if !found.is_empty() {
                return found;
            }
            if arrived.read_part() {
                continue;
            }
            if arrived.is_complete {
                break;
            }
            underway = self.wait(underway);
        }
        Vec::new()
    }

    /// All names, when they have come; `None` where nobody lists the directory.
    pub(crate) fn take(&self, directory: Directory) -> Option<NameTable> {
        let mut underway = self.underway();
        loop {
            let arrived = underway.get_mut(&directory)?;
            while arrived.read_part() {}
            if arrived.is_complete {
                let arrived = underway.remove(&directory).filter(|arrived| arrived.are_all);
                return arrived.map(|arrived| arrived.names.into());
            }
            underway = self.wait(underway);
        }
    }

    fn underway(&self) -> MutexGuard<'_, FxHashMap<Directory, Arrived>> {
        // Whoever panics while holding the lock has looked at names, or added some.
        self.underway.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait<'a>(
        &self,
        underway: MutexGuard<'a, FxHashMap<Directory, Arrived>>,
    ) -> MutexGuard<'a, FxHashMap<Directory, Arrived>> {
        self.changed.wait(underway).unwrap_or_else(PoisonError::into_inner)
    }
}
