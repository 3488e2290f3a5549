//! Directory listings made ahead of the queries that need them.

use std::fmt;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use camino::Utf8PathBuf;
use rustc_hash::FxHashMap;

use crate::bugs::catch_bugs;
use crate::inputs::Directory;
use crate::system::{Names, System};

/// Listings that no query has taken yet.
#[derive(Debug, Default)]
pub(crate) struct Listings(Mutex<FxHashMap<Directory, ListingState>>);

/// The state of a listing.
#[derive(Debug)]
enum ListingState {
    /// Complete.
    Known(Names),
    /// In progress on another thread. The channel closes without names if the listing fails or never runs.
    Pending(Receiver<Names>),
}

/// A listing to run on any thread. If it is dropped, the query lists the directory itself.
pub struct PendingListing {
    system: Arc<dyn System>,
    path: Utf8PathBuf,
    names: Sender<Names>,
}

impl PendingListing {
    /// Lists the directory. A panic is left to the query, since here it would end the run.
    pub fn run(self) {
        if let Ok(Ok(listing)) = catch_bugs(|| self.system.list(&self.path)) {
            // Sending fails if the directory has changed since and the listing was discarded.
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
    /// Registers a listing in progress.
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

    /// Adds a complete listing.
    pub(crate) fn put(&self, directory: Directory, names: Names) {
        self.states().entry(directory).or_insert(ListingState::Known(names));
    }

    /// Discards the listing of a directory that has changed.
    pub(crate) fn forget(&self, directory: Directory) {
        self.states().remove(&directory);
    }

    /// Takes the names in a directory; waits for a listing in progress.
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
