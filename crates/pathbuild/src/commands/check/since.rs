//! `check --changed-since REV`: the drawings that changed since a revision of Git, and what depends on them.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::process::Command;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::Trace;

use crate::context::Context;
use pathbuild_workspace::config::clean;
use pathbuild_workspace::session::{Coverage, Facts, Session};

/// The drawings that changed, came or went.
pub(super) struct Changed {
    files: BTreeSet<Utf8PathBuf>,
    coverage: Coverage,
}

impl Changed {
    /// Those that Git names: in commits since then, not yet committed, and not yet added.
    ///
    /// # Errors
    /// What Git says where it cannot tell.
    pub(super) fn since(context: &Context, session: &Session<'_>, revision: &str) -> Result<Self, String> {
        if revision.starts_with('-') {
            return Err(format!("{revision:?} is no revision"));
        }
        let directory = &context.working_directory;
        let up = git(directory, &["rev-parse", "--show-cdup"])?;
        let top = clean(&directory.join(String::from_utf8_lossy(&up).trim()));
        let mut names = git(&top, &["diff", "--name-only", "--no-renames", "-z", revision, "--"])?;
        names.extend(git(&top, &["ls-files", "--others", "--exclude-standard", "-z"])?);
        let names = names.split(|byte| *byte == 0).filter_map(|name| std::str::from_utf8(name).ok());
        let drawings = names.map(Utf8Path::new).filter(|name| Session::is_drawing(name));
        let files = drawings.map(|name| session.normal(&top.join(name))).collect();
        Ok(Self { files, coverage: Coverage::new(context) })
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
    pub(super) fn concerns_kept(&self, facts: &Facts<'_>) -> bool {
        facts.files.iter().any(|file| self.files.contains(*file))
            || facts.lookups.iter().any(|(directory, name)| self.answers(directory, name))
    }

    /// Whether one of them may be what was looked for in a directory.
    fn answers(&self, directory: &Utf8Path, name: &str) -> bool {
        let in_directory = self.files.iter().filter(|file| file.parent() == Some(directory));
        in_directory.filter_map(|file| file.file_name()).any(|file| self.coverage.may_hold(file, name))
    }
}

fn git<S: AsRef<OsStr>>(directory: &Utf8Path, arguments: &[S]) -> Result<Vec<u8>, String> {
    let mut command = Command::new("git");
    if !directory.as_str().is_empty() {
        command.current_dir(directory);
    }
    let output = command.args(arguments).output().map_err(|error| format!("git cannot be run: {error}"))?;
    if output.status.success() {
        return Ok(output.stdout);
    }
    let said = String::from_utf8_lossy(&output.stderr);
    Err(format!("git: {}", said.lines().next().unwrap_or("it failed")))
}
