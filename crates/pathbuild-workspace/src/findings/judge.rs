use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Diagnostic;

use crate::config::{Settings, clean};

/// Applies the configured severities, and drops diagnostics that are ignored. File names are relative to the working directory, those in
/// the configuration to its own directory.
pub fn judge(
    diagnostics: Vec<Diagnostic>,
    settings: &Settings,
    working_directory: &Utf8Path,
) -> Vec<Diagnostic> {
    let severities = settings.severities();
    let relative = |file: &Utf8Path| -> Utf8PathBuf {
        let file = clean(&working_directory.join(file));
        let below = settings.directory().and_then(|directory| file.strip_prefix(directory).ok());
        below.map(Utf8Path::to_owned).unwrap_or(file)
    };
    let judge = |mut diagnostic: Diagnostic| {
        let file = diagnostic.file.as_deref().map(relative);
        if let Some(level) = severities.level(diagnostic.code(), file.as_deref()) {
            diagnostic.severity = level.severity()?;
        }
        Some(diagnostic)
    };
    diagnostics.into_iter().filter_map(judge).collect()
}
