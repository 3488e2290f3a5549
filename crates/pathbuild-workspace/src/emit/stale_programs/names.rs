//! Names of programs and of other output files.

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Text;
use pathbuild_diagnostic::reasons::PROGRAM_OF_OTHER_PATH;
use pathbuild_gcode::native::{self, plain_title};
use pathbuild_gcode::provenance::{HEAD_BYTES, Provenance};

use crate::files::{PROGRAM_EXTENSIONS, is_program};
use crate::post_processor::PostProcessor;
use crate::session::{OutputKind, OutputName};
use crate::workspace::Workspace;

/// Whether a program is named after the drawing or path in this title, as `emit` names the programs of paths without R.
pub(super) fn has_name_of_title(program: &Utf8Path, title: &str) -> bool {
    let title = plain_title(title);
    let joined = native::joined_paths(&title).map(|(_, name)| name);
    let drawing = native::drawing_of_title(&title).and_then(|drawing| Utf8Path::new(drawing).file_stem());
    let path = title.split_once(' ').and_then(|(_, rest)| rest.split_once(',')).map(|(path, _)| path);
    let name = plain_title(program.file_stem().unwrap_or_default());
    let mut kinds = OutputKind::ALL.into_iter().filter(|kind| *kind != OutputKind::Values);
    let stem = kinds.find_map(|kind| name.strip_suffix(&kind.mark().to_lowercase()));
    stem.is_some() && [drawing, path, joined.as_deref()].contains(&stem)
}

/// Returns the reason why `program` must not replace a file: the file is named after another path, and contains the program of that path. `None` for
/// other files.
pub(crate) fn program_of_other_path(
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
    OutputName::parse(name).is_some_and(|name| name.kind.sheet().is_some())
}

/// Returns the names of all output files that a path with this stem may have, natively and through post-processors with a common file extension.
pub(super) fn possible_files(stem: &Utf8Path) -> impl Iterator<Item = Utf8PathBuf> + use<> {
    let native = OutputKind::ALL.map(|kind| kind.file(stem));
    let program = OutputKind::Milling.file(stem);
    let posted = PROGRAM_EXTENSIONS[1..].iter().map(move |extension| program.with_extension(extension));
    native.into_iter().chain(posted)
}
