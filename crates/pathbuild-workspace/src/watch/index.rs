//! Finds the drawings affected by a change: by the files that their results depend on, and by the names that they look up in directories.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{Db, SourceFile, Trace, drawing_names};
use pathbuild_path::PathName;

use crate::memo::Coverage;
use crate::session::Session;

/// The reverse index of all traces.
#[derive(Default)]
pub(super) struct ReverseIndex {
    by_file: HashMap<SourceFile, HashSet<SourceFile>>,
    by_lookup: HashMap<Utf8PathBuf, BTreeMap<PathName, HashSet<SourceFile>>>,
    /// The traces of each drawing, needed to remove it.
    traces: HashMap<SourceFile, Vec<Trace>>,
}

impl ReverseIndex {
    /// Records the inputs of a drawing's results, replacing earlier ones.
    pub(super) fn set(&mut self, drawing: SourceFile, traces: Vec<Trace>) {
        // Most edits change geometry but not what is embedded.
        if self.traces.get(&drawing) == Some(&traces) {
            return;
        }
        self.remove(drawing);
        for trace in &traces {
            for file in &trace.files {
                self.by_file.entry(*file).or_default().insert(drawing);
            }
            for (directory, name) in lookups(trace) {
                let names = self.by_lookup.entry(directory.clone()).or_default();
                names.entry(name.clone()).or_default().insert(drawing);
            }
        }
        self.traces.insert(drawing, traces);
    }

    /// Removes a drawing.
    pub(super) fn remove(&mut self, drawing: SourceFile) {
        for trace in self.traces.remove(&drawing).unwrap_or_default() {
            for file in &trace.files {
                if let Some(drawings) = self.by_file.get_mut(file) {
                    drawings.remove(&drawing);
                }
            }
            for (directory, name) in lookups(&trace) {
                if let Some(drawings) =
                    self.by_lookup.get_mut(directory).and_then(|names| names.get_mut(name))
                {
                    drawings.remove(&drawing);
                }
            }
        }
    }

    /// The drawings that depend on the contents of a file.
    pub(super) fn of_file(&self, file: SourceFile) -> impl Iterator<Item = SourceFile> {
        self.by_file.get(&file).into_iter().flatten().copied()
    }

    /// The drawings with lookups in a directory that files of these names may answer.
    pub(super) fn of_names<'n>(
        &self,
        directory: &Utf8Path,
        names: impl IntoIterator<Item = &'n str>,
        coverage: &Coverage,
    ) -> Vec<SourceFile> {
        let covered = coverage.of_files(names);
        let lookups = self.by_lookup.get(directory).into_iter().flatten();
        let concerned = lookups.filter(|(path, _)| covered.may_hold(path.as_str()));
        concerned.flat_map(|(_, drawings)| drawings).copied().collect()
    }

    /// Whether the file is known as a dependency.
    pub(super) fn knows(&self, file: SourceFile) -> bool {
        self.by_file.contains_key(&file)
    }

    /// All files that any drawing depends on.
    pub(super) fn files(&self) -> impl Iterator<Item = SourceFile> {
        self.by_file.keys().copied()
    }
}

fn lookups(trace: &Trace) -> impl Iterator<Item = (&Utf8PathBuf, &PathName)> {
    trace
        .lookups
        .iter()
        .flat_map(|lookup| lookup.directories.iter().map(|directory| (directory, &lookup.name)))
}

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
