//! Drawings as they were in a revision of Git: taken out into a directory of their own, which goes when it is no longer needed.

use std::ffi::OsString;
use std::fs;
use std::process::Command;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_workspace::config::clean;
use tempfile::TempDir;

use crate::context::Context;

/// What was taken out.
pub(super) struct Revision {
    /// As it was named.
    pub(super) name: String,
    /// What the working directory was in it.
    pub(super) root: Utf8PathBuf,
    _files: TempDir,
}

/// Takes out a revision of the repository that the working directory lies in. Neither that nor its index is touched.
///
/// # Errors
/// What Git says where it knows no such revision.
pub(super) fn checked_out(context: &Context, name: &str) -> Result<Revision, String> {
    if name.starts_with('-') {
        return Err(format!("{name:?} is no revision"));
    }
    let directory = &context.working_directory;
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).trim().to_owned();
    let commit =
        git(directory, None, &["rev-parse", "--verify", "--end-of-options", &format!("{name}^{{tree}}")])
            .map_err(|reason| {
                format!("{name:?} is neither a directory nor a program nor a revision ({reason})")
            })?;
    let (tree, below) = (text(commit), text(git(directory, None, &["rev-parse", "--show-prefix"])?));
    let top = clean(&directory.join(text(git(directory, None, &["rev-parse", "--show-cdup"])?)));
    let files = tempfile::Builder::new().prefix("pathbuild-").tempdir().map_err(|error| error.to_string())?;
    let place =
        Utf8Path::from_path(files.path()).ok_or("the directory for temporary files has no UTF-8 name")?;
    let place = place.canonicalize_utf8().map_err(|error| error.to_string())?;
    // What is above is another's.
    let whole = place.join("tree");
    let index = place.join("index");
    // It is a repository as much as the one it comes from: ignore files count, and nothing is followed out of it.
    make_directory(&whole.join(".git"))?;
    git(&top, Some(&index), &["read-tree", &tree])?;
    git(&top, Some(&index), &["checkout-index", "--all", &format!("--prefix={whole}/")])?;
    let root = if below.is_empty() { whole } else { whole.join(below.trim_end_matches('/')) };
    Ok(Revision { name: name.to_owned(), root, _files: files })
}

fn git(directory: &Utf8Path, index: Option<&Utf8Path>, arguments: &[&str]) -> Result<Vec<u8>, String> {
    let mut command = Command::new("git");
    if !directory.as_str().is_empty() {
        command.current_dir(directory);
    }
    if let Some(index) = index {
        command.env("GIT_INDEX_FILE", OsString::from(index.as_str()));
    }
    let output = command.args(arguments).output().map_err(|error| format!("git cannot be run: {error}"))?;
    if output.status.success() {
        return Ok(output.stdout);
    }
    let said = String::from_utf8_lossy(&output.stderr);
    Err(format!("git: {}", said.lines().next().unwrap_or("it failed")))
}

#[expect(clippy::disallowed_methods, reason = "the directory is our own, among the system's temporary ones")]
fn make_directory(place: &Utf8Path) -> Result<(), String> {
    fs::create_dir_all(place).map_err(|error| error.to_string())
}
