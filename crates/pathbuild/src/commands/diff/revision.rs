//! Drawings as they were in a revision of Git: taken out into a directory of their own, which goes when it is no longer needed.

use std::fs;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_workspace::config::clean;
use tempfile::TempDir;

use crate::commands::git;
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
    let name = git::revision(context, name)?;
    let run = |directory: &Utf8Path, index: Option<&Utf8Path>, arguments: &[&str]| {
        git::run(context, directory, index, arguments)
    };
    let directory = &context.working_directory;
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).trim().to_owned();
    let commit =
        run(directory, None, &["rev-parse", "--verify", "--end-of-options", &format!("{name}^{{tree}}")])
            .map_err(|reason| {
                let neither = context.phrase(
                    "{} is neither a directory nor a program nor a revision",
                    "{} ist weder ein Verzeichnis noch ein Programm noch eine Revision",
                    &format!("{name:?}"),
                );
                git::too_shallow(context, directory, name).unwrap_or_else(|| format!("{neither} ({reason})"))
            })?;
    let (tree, below) = (text(commit), text(run(directory, None, &["rev-parse", "--show-prefix"])?));
    let top = clean(&directory.join(text(run(directory, None, &["rev-parse", "--show-cdup"])?)));
    let files = tempfile::Builder::new().prefix("pathbuild-").tempdir().map_err(|error| error.to_string())?;
    let place = Utf8Path::from_path(files.path()).ok_or_else(|| {
        let reason = context.choose(
            "the directory for temporary files has no UTF-8 name",
            "der Name des Verzeichnisses für temporäre Dateien ist kein UTF-8",
        );
        reason.to_owned()
    })?;
    let place = place.canonicalize_utf8().map_err(|error| error.to_string())?;
    // What is above is another's.
    let whole = place.join("tree");
    let index = place.join("index");
    // It is a repository as much as the one it comes from: ignore files count, and nothing is followed out of it.
    make_directory(&whole.join(".git"))?;
    run(&top, Some(&index), &["read-tree", &tree])?;
    run(&top, Some(&index), &["checkout-index", "--all", &format!("--prefix={whole}/")])?;
    let root = if below.is_empty() { whole } else { whole.join(below.trim_end_matches('/')) };
    Ok(Revision { name: name.to_owned(), root, _files: files })
}

#[expect(clippy::disallowed_methods, reason = "the directory is our own, among the system's temporary ones")]
fn make_directory(place: &Utf8Path) -> Result<(), String> {
    fs::create_dir_all(place).map_err(|error| error.to_string())
}
