//! `check --changed-since REV`: the drawings that changed since a revision of Git.

use std::ffi::OsStr;
use std::process::Command;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_workspace::config::clean;
use pathbuild_workspace::session::Session;

use crate::context::Context;

/// The drawings that Git names: in commits since then, not yet committed, and not yet added.
///
/// # Errors
/// What Git says where it cannot tell.
pub(super) fn changed_since(context: &Context, revision: &str) -> Result<Vec<Utf8PathBuf>, String> {
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
    Ok(drawings.map(|name| top.join(name)).collect())
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
