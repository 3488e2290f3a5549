//! The drawings that changed, and what depends on them.

use std::collections::BTreeSet;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::Trace;

use crate::session::{Coverage, Dependencies, Session};

/// The drawings that changed, came or went.
pub(super) struct Changed {
    files: BTreeSet<Utf8PathBuf>,
    coverage: Coverage,
}

impl Changed {
    /// These, by any of their spellings.
    pub(super) fn new(session: &Session<'_>, drawings: &[Utf8PathBuf]) -> Self {
        let files = drawings.iter().map(|drawing| session.normal(drawing)).collect();
        Self { files, coverage: Coverage::new(session.workspace()) }
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
        let in_directory = self.files.iter().filter(|file| file.parent() == Some(directory));
        in_directory.filter_map(|file| file.file_name()).any(|file| self.coverage.may_hold(file, name))
    }
}
