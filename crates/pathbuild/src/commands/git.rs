//! What Git says of revisions, for `check --changed-since` and `diff`.

use std::process::Command;

use camino::Utf8Path;
use pathbuild_workspace::Workspace;

/// Runs Git in a directory, with an index of its own where one is named.
///
/// # Errors
/// What Git says first where it fails.
pub(super) fn run(
    workspace: &Workspace,
    directory: &Utf8Path,
    index: Option<&Utf8Path>,
    arguments: &[&str],
) -> Result<Vec<u8>, String> {
    let mut command = Command::new("git");
    if !directory.as_str().is_empty() {
        command.current_dir(directory);
    }
    if let Some(index) = index {
        command.env("GIT_INDEX_FILE", index.as_str());
    }
    let output = command.args(arguments).output().map_err(|error| {
        workspace.phrase("git cannot be run: {}", "git lässt sich nicht starten: {}", &error.to_string())
    })?;
    if output.status.success() {
        return Ok(output.stdout);
    }
    let said = String::from_utf8_lossy(&output.stderr);
    let nothing = workspace.choose("it failed", "fehlgeschlagen");
    Err(format!("git: {}", said.lines().next().unwrap_or(nothing)))
}

/// Refuses what Git would take for an option.
///
/// # Errors
/// That it is no revision.
pub(super) fn revision<'a>(workspace: &Workspace, name: &'a str) -> Result<&'a str, String> {
    if name.starts_with('-') {
        return Err(workspace.phrase("{} is not a revision", "{} ist keine Revision", &format!("{name:?}")));
    }
    Ok(name)
}

/// What to do where a clone does not reach a revision.
pub(super) fn too_shallow(workspace: &Workspace, directory: &Utf8Path, revision: &str) -> Option<String> {
    let git = |arguments: &[&str]| run(workspace, directory, None, arguments);
    let is_shallow = git(&["rev-parse", "--is-shallow-repository"]).ok()?;
    let is_there = git(&["cat-file", "-e", &format!("{revision}^{{commit}}")]).is_ok();
    (is_shallow.trim_ascii() == b"true" && !is_there).then(|| {
        workspace.phrase(
            "this clone is too shallow: it does not reach {}; fetch more (git fetch --unshallow, `fetch-depth: 0` of \
             actions/checkout, GIT_DEPTH: \"0\" of GitLab)",
            "dieser Klon reicht nicht bis {}; mehr holen (git fetch --unshallow, `fetch-depth: 0` von \
             actions/checkout, GIT_DEPTH: \"0\" von GitLab)",
            revision,
        )
    })
}
