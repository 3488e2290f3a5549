use camino::Utf8Path;
use pathbuild_diagnostic::Diagnostic;

use crate::config::Settings;

/// Gives diagnostics the severities that the configuration says, and drops those that it ignores.
pub fn judge(diagnostics: Vec<Diagnostic>, settings: &Settings) -> Vec<Diagnostic> {
    let severities = settings.severities();
    let relative = |file: &Utf8Path| {
        settings.directory().and_then(|it| file.strip_prefix(it).ok()).unwrap_or(file).to_owned()
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
