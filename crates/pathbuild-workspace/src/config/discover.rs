use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::System;
use pathbuild_db::system::{FileKind, OsSystem, clean};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::configuration as messages;

use crate::files;
use crate::inputs::{Input, Inputs};

/// The name of a configuration.
pub const FILE_NAME: &str = "pathbuild.toml";

/// The configuration of a directory: in it, or in the nearest directory above.
pub(super) fn above(directory: &Utf8Path) -> Option<Utf8PathBuf> {
    directory.ancestors().map(|directory| directory.join(FILE_NAME)).find(|file| files::is_there(file))
}

/// The repository of a directory: the nearest directory above that Git takes for one, else the directory itself.
pub fn repository(directory: &Utf8Path) -> &Utf8Path {
    let is_repository = |directory: &&Utf8Path| OsSystem.kind(&directory.join(".git")) != FileKind::Missing;
    directory.ancestors().find(is_repository).unwrap_or(directory)
}

/// Arguments that lie under another configuration than the one of the run.
pub(super) fn strangers(
    inputs: &Inputs,
    working_directory: &Utf8Path,
    used: Option<&Utf8Path>,
) -> Vec<Diagnostic> {
    let place = |input: Input<'_>| match input {
        Input::Place(place) => Some(place.to_owned()),
        Input::Name(_) => None,
    };
    let stranger = |place: Utf8PathBuf| {
        let other = above(&clean(&working_directory.join(&place)))?;
        (Some(&*other) != used).then(|| complaint(&place, &other, used))
    };
    inputs.iter().filter_map(place).filter_map(stranger).collect()
}

fn complaint(place: &Utf8Path, other: &Utf8Path, used: Option<&Utf8Path>) -> Diagnostic {
    let message =
        if used.is_some() { &messages::OTHER_CONFIGURATION } else { &messages::UNEXPECTED_CONFIGURATION };
    let diagnostic = Diagnostic::new(message).with("argument", place.as_str()).with("other", other.as_str());
    match used {
        Some(used) => diagnostic.with("used", used.as_str()),
        None => diagnostic,
    }
}
