use camino::{Utf8Component, Utf8Path, Utf8PathBuf};
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

/// The path without `.` and `..`, as it is written: links are not followed, so that a linked drawing belongs where it is seen.
pub fn clean(path: &Utf8Path) -> Utf8PathBuf {
    let mut clean = Utf8PathBuf::new();
    for component in path.components() {
        match component {
            Utf8Component::ParentDir if clean.file_name().is_some() => _ = clean.pop(),
            // Nothing is above the root.
            Utf8Component::ParentDir if clean.has_root() => {}
            Utf8Component::CurDir => {}
            other => clean.push(other),
        }
    }
    clean
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
