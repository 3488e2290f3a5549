//! `check --changed-since REV`: the drawings that changed since a revision of Git.

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_workspace::config::clean;
use pathbuild_workspace::session::Session;

use crate::commands::git;
use crate::context::Context;

/// The drawings that Git names: in commits since then, not yet committed, and not yet added.
///
/// # Errors
/// What Git says where it cannot tell.
pub(super) fn changed_since(context: &Context, revision: &str) -> Result<Vec<Utf8PathBuf>, String> {
    let revision = git::revision(context, revision)?;
    let run = |directory: &Utf8Path, arguments: &[&str]| git::run(context, directory, None, arguments);
    let directory = &context.working_directory;
    let up = run(directory, &["rev-parse", "--show-cdup"])?;
    let top = clean(&directory.join(String::from_utf8_lossy(&up).trim()));
    let changed = run(&top, &["diff", "--name-only", "--no-renames", "-z", revision, "--"]);
    let mut names = changed.map_err(|reason| git::too_shallow(context, &top, revision).unwrap_or(reason))?;
    names.extend(run(&top, &["ls-files", "--others", "--exclude-standard", "-z"])?);
    let names = names.split(|byte| *byte == 0).filter_map(|name| std::str::from_utf8(name).ok());
    let drawings = names.map(Utf8Path::new).filter(|name| Session::is_drawing(name));
    Ok(drawings.map(|name| top.join(name)).collect())
}
