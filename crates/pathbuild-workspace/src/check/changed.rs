//! Changed drawings, and which results depend on them.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Debug;
use std::ops::ControlFlow;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::Db;
use pathbuild_db::system::join;

use crate::memo::{Answer, Coverage, Dependencies, DrawingResult, Memo};
use crate::session::Session;

/// The files at an earlier time, such as in a Git revision.
pub trait EarlierFiles: Debug {
    /// For each file, whether it has changed since or did not exist. Files about which nothing is known count as changed.
    fn changed(&self, files: &[Utf8PathBuf]) -> Vec<bool>;

    /// File names of the drawings that the directory contained.
    fn drawings(&self, directory: &Utf8Path) -> &[String];

    /// A file that has changed and affects all results, such as a configuration or a symbolic link. `directories` are those that were
    /// searched.
    fn changed_rule(&self, directories: &[Utf8PathBuf]) -> Option<Utf8PathBuf>;
}

/// Selects the results that are shown.
pub(super) struct ChangeFilter<'a> {
    session: &'a Session<'a>,
    memo: &'a Memo,
    /// `None` shows all results.
    changed: Option<ChangedDrawings>,
}

impl<'a> ChangeFilter<'a> {
    /// If `past` is given, selects those of the results that depend on files changed since then.
    pub(super) fn new<'r>(
        session: &'a Session<'a>,
        memo: &'a Memo,
        past: Option<&dyn EarlierFiles>,
        results: impl Iterator<Item = &'r Answer<DrawingResult>>,
    ) -> Self {
        let changed = past.map(|past| {
            let mut reached = ReachedInputs::default();
            for answer in results {
                if let Some(inputs) = memo.dependencies(session.db(), answer) {
                    reached.add(&inputs);
                }
            }
            ChangedDrawings::new(session, past, reached)
        });
        Self { session, memo, changed }
    }

    pub(super) fn contains(&self, answer: &Answer<DrawingResult>) -> bool {
        let Some(changed) = &self.changed else { return true };
        let inputs = self.memo.dependencies(self.session.db(), answer);
        inputs.is_none_or(|inputs| changed.affects(&inputs))
    }
}

/// Inputs of results that may have changed.
#[derive(Debug, Default)]
struct ReachedInputs {
    files: BTreeSet<Utf8PathBuf>,
    /// Directories in which lookups were made.
    directories: BTreeSet<Utf8PathBuf>,
}

/// Drawings that were changed, added or removed.
struct ChangedDrawings {
    files: BTreeSet<Utf8PathBuf>,
    /// File names of these drawings, by directory.
    names: BTreeMap<Utf8PathBuf, Vec<String>>,
    coverage: Coverage,
}

impl ReachedInputs {
    /// Adds the inputs of a result.
    fn add(&mut self, facts: &Dependencies<'_>) {
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
    fn new(session: &Session<'_>, past: &dyn EarlierFiles, reached: ReachedInputs) -> Self {
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

    /// Whether a result depends on one of the drawings.
    fn affects(&self, facts: &Dependencies<'_>) -> bool {
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
