//! Findings that belong to no single drawing. (book: reference/configuration, book: language/keep-outs)

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::Db;
use pathbuild_db::system::{FileKind, join};
use pathbuild_diagnostic::messages::{configuration, outputs};
use pathbuild_diagnostic::{Diagnostic, Message};

use crate::config::SourcedValue;
use crate::files;
use crate::memo::DrawingResult;
use crate::session::Session;

/// Warns about each configuration in the searched directories that does not apply to the run. Directories outside the tree of the applied
/// configuration are skipped: for them, `--config` has chosen a configuration of another tree.
pub(crate) fn unused_configurations(session: &Session<'_>, directories: &[Utf8PathBuf]) -> Vec<Diagnostic> {
    let system = session.db().system();
    let used = session.workspace().settings.file.as_deref().map(|file| session.normal(file));
    let tree = used.as_deref().and_then(Utf8Path::parent);
    let files = directories.iter().map(|directory| join(directory, files::FILE_NAME));
    let is_unused = |file: &Utf8PathBuf| {
        tree.is_none_or(|tree| file.starts_with(tree))
            && used.as_ref() != Some(file)
            && system.kind(file) != FileKind::Missing
    };
    let warning = |file: Utf8PathBuf| {
        let problem = match &used {
            Some(used) => {
                Diagnostic::new(&configuration::UNUSED_CONFIGURATION).quoting("used", used.as_str())
            }
            None => Diagnostic::new(&configuration::UNUSED_WITHOUT_ANY),
        };
        problem.in_file(&file)
    };
    files.filter(is_unused).map(warning).collect()
}

/// Returns PB527 for each pattern that matches no layer of the library, given the results of all its drawings. Returns nothing if a drawing could
/// not be read, because it may contain such layers.
pub(crate) fn patterns_without_layer<'a>(
    session: &Session<'_>,
    mut library: impl Iterator<Item = &'a DrawingResult> + Clone,
) -> Vec<Diagnostic> {
    let has_all = library.clone().next().is_some() && !library.clone().any(DrawingResult::is_unread);
    if !has_all || session.is_compatible() {
        return Vec::new();
    }
    let settings = &session.workspace().settings;
    let problem = |pattern: &SourcedValue<Option<Box<str>>>, message: &'static Message| {
        let problem = Diagnostic::new(message).quoting("pattern", pattern.value.as_deref()?);
        Some(settings.locate(problem, pattern.origin))
    };
    let clamps = || problem(&settings.general.keep_out, &outputs::NO_CLAMP_LAYER);
    let parts = || problem(&settings.general.part, &outputs::NO_PART_LAYER);
    let has_clamps = library.clone().any(|drawing| drawing.layers.has_clamps);
    let has_parts = library.any(|drawing| drawing.layers.has_parts);
    let clamps = (!has_clamps).then(clamps).flatten();
    clamps.into_iter().chain((!has_parts).then(parts).flatten()).collect()
}
