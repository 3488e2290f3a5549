//! Names of programs and of other output files.

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Text;
use pathbuild_diagnostic::reasons::PROGRAM_OF_OTHER_PATH;
use pathbuild_gcode::native::{self, plain_title};
use pathbuild_gcode::provenance::{HEAD_BYTES, Provenance};

use crate::files::{PROGRAM_EXTENSIONS, is_program};
use crate::post_processor::PostProcessor;
use crate::session::OutputKind;
use crate::workspace::Workspace;

pub(super) const SHEET_SUFFIX: &str = "_Sheet";

pub(super) const NATIVE_EXTENSION: &str = "gcode";

/// The kinds of native programs that are converted for the machine.
pub(super) const CONVERTED: [OutputKind; 2] = [OutputKind::Milling, OutputKind::Probing];

pub(super) const PROGRAM_SUFFIXES: [&str; 3] = ["_Milling", "_Clean", "_Probing"];

/// Whether a program is named after the drawing or path in this title, as `emit` names the programs of paths without R.
pub(super) fn has_name_of_title(program: &Utf8Path, title: &str) -> bool {
    let title = plain_title(title);
    let joined = native::joined_paths(&title).map(|(_, name)| name);
    let drawing = native::drawing_of_title(&title).and_then(|drawing| Utf8Path::new(drawing).file_stem());
    let path = title.split_once(' ').and_then(|(_, rest)| rest.split_once(',')).map(|(path, _)| path);
    let name = plain_title(program.file_stem().unwrap_or_default());
    let suffixes = PROGRAM_SUFFIXES.into_iter().chain([SHEET_SUFFIX]).map(str::to_lowercase);
    let stem = suffixes.into_iter().find_map(|suffix| name.strip_suffix(&*suffix));
    stem.is_some() && [drawing, path, joined.as_deref()].contains(&stem)
}

/// Returns the reason if a file is named after another path than that of `program` and contains the program of that path: `program` must not
/// replace it.
pub fn program_of_other_path(
    workspace: &Workspace,
    file: &Utf8Path,
    program: &[u8],
) -> Option<&'static Text> {
    let owner = |title: &str| match native::joined_paths(title) {
        Some((_, name)) => name,
        None => plain_title(title),
    };
    let (_, current) = Provenance::of_head(&workspace.system.read_head(file, HEAD_BYTES).ok()?)?;
    let (_, new) = Provenance::of_head(program)?;
    (owner(&new) != owner(&current) && has_name_of_title(file, &current)).then_some(&PROGRAM_OF_OTHER_PATH)
}

/// Whether this is the file name of a program. The extension that a post definition chooses is recognised only while that definition is in use.
pub(super) fn is_gcode(name: &str, post_processor: Option<&PostProcessor>) -> bool {
    let name = Utf8Path::new(name);
    is_program(name) || post_processor.is_some_and(|post| post.has_extension(name))
}

pub(super) fn is_sheet(name: &str) -> bool {
    OutputKind::ALL.iter().any(|kind| kind.sheet().is_some() && name.ends_with(kind.suffix()))
}

/// Returns the files that a path with this stem may have, with every post that has a usual extension.
pub(super) fn possible_files(stem: &Utf8Path) -> impl Iterator<Item = Utf8PathBuf> + use<> {
    let stem = stem.to_owned();
    let native = OutputKind::ALL.map(|kind| Utf8PathBuf::from(format!("{stem}{}", kind.suffix())));
    let posted = PROGRAM_EXTENSIONS[1..].iter();
    native.into_iter().chain(posted.map(move |extension| format!("{stem}_Milling.{extension}").into()))
}
