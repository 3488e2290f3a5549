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
    let changed = git(&top, &["diff", "--name-only", "--no-renames", "-z", revision, "--"]);
    let mut names = changed.map_err(|reason| too_shallow(context, &top, revision).unwrap_or(reason))?;
    names.extend(git(&top, &["ls-files", "--others", "--exclude-standard", "-z"])?);
    let names = names.split(|byte| *byte == 0).filter_map(|name| std::str::from_utf8(name).ok());
    let drawings = names.map(Utf8Path::new).filter(|name| Session::is_drawing(name));
    Ok(drawings.map(|name| top.join(name)).collect())
}

/// What to do where a clone does not reach a revision.
fn too_shallow(context: &Context, top: &Utf8Path, revision: &str) -> Option<String> {
    let is_shallow = git(top, &["rev-parse", "--is-shallow-repository"]).ok()?;
    let is_there = git(top, &["cat-file", "-e", &format!("{revision}^{{commit}}")]).is_ok();
    (is_shallow.trim_ascii() == b"true" && !is_there).then(|| {
        context
            .choose(
                "this clone is too shallow: it does not reach {}; fetch more (git fetch --unshallow, `fetch-depth: 0` of \
                 actions/checkout, GIT_DEPTH: \"0\" of GitLab)",
                "dieser Klon reicht nicht bis {}: mehr holen (git fetch --unshallow, `fetch-depth: 0` von \
                 actions/checkout, GIT_DEPTH: \"0\" von GitLab)",
            )
            .replace("{}", revision)
    })
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
