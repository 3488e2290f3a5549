//! Directories that are listed before a query wants their names.

use std::fmt;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use camino::Utf8PathBuf;
use rustc_hash::FxHashMap;

use crate::bugs::catch_bugs;
use crate::inputs::Directory;
use crate::system::{Names, System};

/// The listings that no query has taken yet.
#[derive(Debug, Default)]
pub(crate) struct Listings(Mutex<FxHashMap<Directory, ListingState>>);

/// What is known of the names in a directory.
#[derive(Debug)]
enum ListingState {
    /// All of them.
    Known(Names),
    /// Another thread lists them. The channel ends without names where it fails or never runs.
    Pending(Receiver<Names>),
}

/// Lists a directory, on any thread. If it is dropped instead, the directory is listed by the query that wants its names.
pub struct PendingListing {
    system: Arc<dyn System>,
    path: Utf8PathBuf,
    names: Sender<Names>,
}

impl PendingListing {
    /// Lists the directory. A bug that this shows is left to the query: it would end the run on this thread.
    pub fn run(self) {
        if let Ok(Ok(listing)) = catch_bugs(|| self.system.list(&self.path)) {
            // Nobody waits for the names of a directory that has changed since.
            _ = self.names.send(listing.files);
        }
    }
}

impl fmt::Debug for PendingListing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("PendingListing").field("path", &self.path).finish_non_exhaustive()
    }
}

impl Listings {
    /// A directory is going to be listed.
    pub(crate) fn begin(
        &self,
        directory: Directory,
        path: Utf8PathBuf,
        system: Arc<dyn System>,
    ) -> PendingListing {
        let (names, pending) = channel();
        self.states().insert(directory, ListingState::Pending(pending));
        PendingListing { system, path, names }
    }

    /// A directory was listed.
    pub(crate) fn put(&self, directory: Directory, names: Names) {
        self.states().entry(directory).or_insert(ListingState::Known(names));
    }

    /// The directory has changed: what was listed before does not count.
    pub(crate) fn forget(&self, directory: Directory) {
        self.states().remove(&directory);
    }

    /// The names in a directory, once; waits for a listing that is under way.
    pub(crate) fn take(&self, directory: Directory) -> Option<Names> {
        let state = self.states().remove(&directory)?;
        match state {
            ListingState::Known(names) => Some(names),
            ListingState::Pending(names) => names.recv().ok(),
        }
    }

    fn states(&self) -> MutexGuard<'_, FxHashMap<Directory, ListingState>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
