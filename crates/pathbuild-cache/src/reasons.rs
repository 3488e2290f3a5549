//! Explains why a cached result no longer holds.

use camino::Utf8PathBuf;

use crate::snapshot::Snapshot;
use crate::verify::{CoversFn, DirectoryChange, FileState, Verdict};

/// An input of a result that has changed.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reason {
    /// A file has different bytes, or is gone.
    File {
        /// Its path, spelled as in the run that read it.
        path: Utf8PathBuf,
        /// Whether it is gone.
        is_gone: bool,
    },
    /// A file that may contain a path which was looked up has appeared or disappeared.
    Name {
        /// The file.
        file: Utf8PathBuf,
        /// Name of the path that was looked up.
        path: Box<str>,
        /// Whether the file disappeared.
        is_gone: bool,
    },
    /// A symbolic link in a directory, or on the way to it, has another target, or the directory could not be listed completely.
    Links {
        /// The directory.
        directory: Utf8PathBuf,
    },
}

/// Lists why a record no longer holds, without duplicates; empty if it holds.
pub fn reasons(snapshot: &Snapshot, verdict: &Verdict, record: usize, covers: CoversFn<'_>) -> Vec<Reason> {
    let record = snapshot.record(record);
    let changed = record.files().filter(|file| verdict.files[*file] == FileState::Changed);
    let mut reasons: Vec<Reason> = changed
        .map(|file| {
            let path = snapshot.file(file).path().to_owned();
            Reason::File { is_gone: !path.exists(), path }
        })
        .collect();
    for (directories, name) in record.lookups().map(|lookup| snapshot.lookup(lookup)) {
        for directory in snapshot.directory_list(directories) {
            reasons.extend(of_lookup(snapshot, verdict, directory, name, covers));
        }
    }
    reasons.sort();
    reasons.dedup();
    // For a file that was read and is gone, one reason is enough.
    let gone: Vec<Utf8PathBuf> = reasons.iter().filter_map(Reason::gone_file).cloned().collect();
    reasons.retain(|reason| !matches!(reason, Reason::Name { file, .. } if gone.contains(file)));
    reasons
}

impl Reason {
    fn gone_file(&self) -> Option<&Utf8PathBuf> {
        match self {
            Self::File { path, is_gone: true } => Some(path),
            _ => None,
        }
    }
}

fn of_lookup(
    snapshot: &Snapshot,
    verdict: &Verdict,
    directory: usize,
    path: &str,
    covers: CoversFn<'_>,
) -> Vec<Reason> {
    let (before, now) = (snapshot.directory(directory), &verdict.directories[directory]);
    let directory = &now.path;
    match DirectoryChange::of(before, now) {
        DirectoryChange::None => Vec::new(),
        DirectoryChange::Links => vec![Reason::Links { directory: directory.clone() }],
        DirectoryChange::Names(names) => {
            let names = names.iter().map(|name| &**name);
            let covering = names.filter(|name| covers(name, path));
            let reason = |name: &str| Reason::Name {
                file: directory.join(name),
                path: path.into(),
                is_gone: !now.names.iter().any(|present| present == name),
            };
            covering.map(reason).collect()
        }
    }
}
