//! Changed drawings, and which results depend on them.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::join;
use pathbuild_db::{Db, Trace};

use super::EarlierFiles;
use crate::session::{Coverage, Dependencies, Session};

/// Inputs of results that may have changed.
#[derive(Debug, Default)]
pub(super) struct ReachedInputs {
    files: BTreeSet<Utf8PathBuf>,
    /// Directories in which lookups were made.
    directories: BTreeSet<Utf8PathBuf>,
}

/// Drawings that were changed, added or removed.
pub(super) struct ChangedDrawings {
    files: BTreeSet<Utf8PathBuf>,
    /// File names of these drawings, by directory.
    names: BTreeMap<Utf8PathBuf, Vec<String>>,
    coverage: Coverage,
}

impl ReachedInputs {
    /// Adds the inputs of a result computed in this run.
    pub(super) fn add(&mut self, session: &Session<'_>, traces: &[Trace]) {
        for trace in traces {
            trace.files.iter().for_each(|file| add(&mut self.files, file.path(session.db())));
            let directories = trace.lookups.iter().flat_map(|lookup| &lookup.directories);
            directories.for_each(|directory| add(&mut self.directories, directory));
        }
    }

    /// Adds the inputs of a cached result.
    pub(super) fn add_cached(&mut self, facts: &Dependencies<'_>) {
        facts.files.iter().for_each(|file| add(&mut self.files, file));
        facts.lookups.iter().for_each(|(directory, _)| add(&mut self.directories, directory));
    }
}

/// Inserts a path; copies it only if it is new, because most paths are already in the set.
fn add(paths: &mut BTreeSet<Utf8PathBuf>, path: &Utf8Path) {
    if !paths.contains(path) {
        paths.insert(path.to_owned());
    }
}

impl ChangedDrawings {
    /// Those of the given inputs that have changed since `past`.
    pub(super) fn new(session: &Session<'_>, past: &dyn EarlierFiles, reached: ReachedInputs) -> Self {
        let ReachedInputs { mut files, directories } = reached;
        let mut gone = BTreeSet::new();
        for directory in &directories {
            let now = drawings(session, directory);
            let old = past.drawings(directory).iter().filter(|name| !now.contains(*name));
            gone.extend(old.map(|name| join(directory, name)));
            files.extend(now.iter().map(|name| join(directory, name)));
        }
        let files: Vec<Utf8PathBuf> = files.into_iter().collect();
        let changed = past.changed(&files).into_iter().zip(files);
        let changed = changed.filter_map(|(is_changed, file)| is_changed.then_some(file));
        let files: BTreeSet<Utf8PathBuf> = changed.chain(gone).collect();
        Self { names: by_directory(&files), files, coverage: Coverage::new(session.workspace()) }
    }

    /// Whether a result computed in this run depends on one of the drawings.
    pub(super) fn affects(&self, session: &Session<'_>, traces: &[Trace]) -> bool {
        let db = session.db();
        traces.iter().any(|trace| {
            trace.files.iter().any(|file| self.files.contains(file.path(db)))
                || trace.lookups.iter().any(|lookup| {
                    lookup.directories.iter().any(|directory| self.answers(directory, lookup.name.as_str()))
                })
        })
    }

    /// Whether a cached result depends on one of the drawings.
    pub(super) fn affects_cached(&self, facts: &Dependencies<'_>) -> bool {
        facts.files.iter().any(|file| self.files.contains(*file))
            || facts.lookups.iter().any(|(directory, name)| self.answers(directory, name))
    }

    /// Whether one of the drawings may answer a lookup of `name` in this directory.
    fn answers(&self, directory: &Utf8Path, name: &str) -> bool {
        let names = self.names.get(directory);
        names.is_some_and(|names| names.iter().any(|file| self.coverage.may_hold(file, name)))
    }
}

/// File names of the drawings in a directory, hidden ones included.
fn drawings(session: &Session<'_>, directory: &Utf8Path) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    // Errors are ignored here: the lookups in this directory report them.
    _ = session.db().system().each_entry(directory, &mut |entry| {
        if entry.is_exact && Session::is_drawing(Utf8Path::new(entry.name)) {
            names.insert(entry.name.to_owned());
        }
        ControlFlow::Continue(())
    });
    names
}

fn by_directory(files: &BTreeSet<Utf8PathBuf>) -> BTreeMap<Utf8PathBuf, Vec<String>> {
    let mut names: BTreeMap<Utf8PathBuf, Vec<String>> = BTreeMap::new();
    for file in files {
        if let (Some(directory), Some(name)) = (file.parent(), file.file_name()) {
            names.entry(directory.to_owned()).or_default().push(name.to_owned());
        }
    }
    names
}
