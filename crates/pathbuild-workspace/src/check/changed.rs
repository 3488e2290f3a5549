//! The drawings that changed, and what depends on them.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::join;
use pathbuild_db::{Db, Trace};

use super::Past;
use crate::session::{Coverage, Dependencies, Session};

/// What results depend on, as far as that may have changed.
#[derive(Debug, Default)]
pub(super) struct Reached {
    files: BTreeSet<Utf8PathBuf>,
    /// Where something was looked for.
    directories: BTreeSet<Utf8PathBuf>,
}

/// The drawings that changed, came or went.
pub(super) struct Changed {
    files: BTreeSet<Utf8PathBuf>,
    /// Their names, by directory.
    names: BTreeMap<Utf8PathBuf, Vec<String>>,
    coverage: Coverage,
}

impl Reached {
    /// What a result that was made now depends on.
    pub(super) fn add(&mut self, session: &Session<'_>, traces: &[Trace]) {
        for trace in traces {
            trace.files.iter().for_each(|file| add(&mut self.files, file.path(session.db())));
            let directories = trace.lookups.iter().flat_map(|sought| &sought.directories);
            directories.for_each(|directory| add(&mut self.directories, directory));
        }
    }

    /// The same of a result that was kept.
    pub(super) fn add_kept(&mut self, facts: &Dependencies<'_>) {
        facts.files.iter().for_each(|file| add(&mut self.files, file));
        facts.lookups.iter().for_each(|(directory, _)| add(&mut self.directories, directory));
    }
}

/// Most are there already.
fn add(paths: &mut BTreeSet<Utf8PathBuf>, path: &Utf8Path) {
    if !paths.contains(path) {
        paths.insert(path.to_owned());
    }
}

impl Changed {
    /// Those of what is reached that changed since then.
    pub(super) fn new(session: &Session<'_>, past: &dyn Past, reached: Reached) -> Self {
        let Reached { mut files, directories } = reached;
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

    /// Whether a result that was made now depends on one of them.
    pub(super) fn concerns(&self, session: &Session<'_>, traces: &[Trace]) -> bool {
        let db = session.db();
        traces.iter().any(|trace| {
            trace.files.iter().any(|file| self.files.contains(file.path(db)))
                || trace.lookups.iter().any(|sought| {
                    sought.directories.iter().any(|directory| self.answers(directory, sought.name.as_str()))
                })
        })
    }

    /// The same of a result that was kept.
    pub(super) fn concerns_kept(&self, facts: &Dependencies<'_>) -> bool {
        facts.files.iter().any(|file| self.files.contains(*file))
            || facts.lookups.iter().any(|(directory, name)| self.answers(directory, name))
    }

    /// Whether one of them may be what was looked for in a directory.
    fn answers(&self, directory: &Utf8Path, name: &str) -> bool {
        let names = self.names.get(directory);
        names.is_some_and(|names| names.iter().any(|file| self.coverage.may_hold(file, name)))
    }
}

/// The names of the drawings in a directory, hidden ones too.
fn drawings(session: &Session<'_>, directory: &Utf8Path) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    // What cannot be listed is told by whoever looks for something in it.
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
