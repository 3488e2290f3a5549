//! Snapshots of the drawing names in directories in which lookups are made. The watcher keeps its own snapshots, because a query may be
//! evaluated long after the change that invalidated it, and then already sees later changes.

use std::collections::{BTreeMap, BTreeSet};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{Db, drawing_names};

use crate::session::Session;

/// The drawing names in each directory, as seen by all results that depend on them.
#[derive(Default)]
pub(super) struct NameSnapshots(BTreeMap<Utf8PathBuf, BTreeSet<Box<str>>>);

impl NameSnapshots {
    /// Takes the snapshot of a directory if there is none. Must be called in the revision of the results that depend on the directory.
    pub(super) fn take(&mut self, session: &Session<'_>, directory: &Utf8Path) {
        if !self.0.contains_key(directory) {
            self.0.insert(directory.to_owned(), names_of(session, directory));
        }
    }

    /// Whether there is a snapshot of a directory.
    pub(super) fn has(&self, directory: &Utf8Path) -> bool {
        self.0.contains_key(directory)
    }

    /// The directories that have a snapshot.
    pub(super) fn directories(&self) -> impl Iterator<Item = &Utf8PathBuf> {
        self.0.keys()
    }

    /// Whether the snapshot of a directory contains a name.
    pub(super) fn holds(&self, directory: &Utf8Path, name: &str) -> bool {
        self.0.get(directory).is_some_and(|names| names.contains(name))
    }

    /// Lists a directory again, in the database as well, and returns the names that were added or removed. Later results see the new names.
    pub(super) fn renew(&mut self, session: &mut Session<'_>, directory: &Utf8Path) -> Vec<Box<str>> {
        session.touch_directory(directory);
        let names = names_of(session, directory);
        let before = self.0.insert(directory.to_owned(), names.clone()).unwrap_or_default();
        before.symmetric_difference(&names).cloned().collect()
    }
}

fn names_of(session: &Session<'_>, directory: &Utf8Path) -> BTreeSet<Box<str>> {
    let db = session.db();
    drawing_names(db, db.directory(directory)).iter().map(Box::from).collect()
}
