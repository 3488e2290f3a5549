//! Snapshots of the names in directories that drawings' paths are looked for in. What the watcher compares with is its own: a query may be
//! computed long after the change that made it necessary, and then it holds later changes too.

use std::collections::{BTreeMap, BTreeSet};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{Db, drawing_names};

use crate::session::Session;

/// The names of the drawings in each directory, as all results that depend on them have seen them.
#[derive(Default)]
pub(super) struct NameSnapshots(BTreeMap<Utf8PathBuf, BTreeSet<Box<str>>>);

impl NameSnapshots {
    /// Takes the snapshot of a directory, if there is none yet. To be called in the revision of the results that depend on the directory.
    pub(super) fn take(&mut self, session: &Session<'_>, directory: &Utf8Path) {
        if !self.0.contains_key(directory) {
            self.0.insert(directory.to_owned(), names_of(session, directory));
        }
    }

    /// Whether there is a snapshot of a directory.
    pub(super) fn has(&self, directory: &Utf8Path) -> bool {
        self.0.contains_key(directory)
    }

    /// The directories of which there are snapshots.
    pub(super) fn directories(&self) -> impl Iterator<Item = &Utf8PathBuf> {
        self.0.keys()
    }

    /// Whether the snapshot of a directory has a name.
    pub(super) fn holds(&self, directory: &Utf8Path, name: &str) -> bool {
        self.0.get(directory).is_some_and(|names| names.contains(name))
    }

    /// Lists a directory again, for the database as well, and returns the names that came or went. From now on results see the new names.
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
