//! The diagnostics of a run, ready for display: with configured severities, without duplicates, in an order independent of threads.
//! (book: reference/diagnostics)

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::{Code, Diagnostic};

use crate::check::CheckedFile;
use crate::config::{Settings, clean};
use crate::workspace::Workspace;

/// The diagnostics of a run, and what was checked.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    /// Sorted, without duplicates.
    pub diagnostics: Vec<Diagnostic>,
    /// The checked drawings, sorted by name; empty for commands that do not check drawings.
    pub checked: Vec<CheckedFile>,
}

impl Findings {
    /// Sorts diagnostics and drops duplicates. Several bindings or projects may lead to the same fault; the shortest trace is kept, and the
    /// first in order among equally short ones.
    pub fn new(mut diagnostics: Vec<Diagnostic>) -> Self {
        if diagnostics.iter().any(|diagnostic| !diagnostic.trace.is_empty()) {
            diagnostics
                .sort_by_cached_key(|diagnostic| (diagnostic.trace.len(), format!("{:?}", diagnostic.trace)));
        }
        diagnostics
            .sort_by(|a, b| a.sort_key().cmp(&b.sort_key()).then_with(|| a.message.key.cmp(b.message.key)));
        diagnostics.dedup_by(|later, earlier| is_same(earlier, later));
        Self { diagnostics, checked: Vec::new() }
    }

    /// Number of errors.
    pub fn errors(&self) -> usize {
        self.diagnostics.iter().filter(|diagnostic| diagnostic.is_error()).count()
    }

    /// Number of warnings.
    pub fn warnings(&self) -> usize {
        self.diagnostics.len() - self.errors()
    }
}

impl Workspace {
    /// Applies the configured severities, sorts, and drops duplicates.
    pub fn findings(&self, diagnostics: Vec<Diagnostic>) -> Findings {
        Findings::new(judge(diagnostics, &self.settings, &self.working_directory))
    }
}

/// Whether two findings are the same except for their traces. Paths nested too deep may be reached from several projects, each with
/// different arguments.
fn is_same(a: &Diagnostic, b: &Diagnostic) -> bool {
    let arguments_agree = a.arguments == b.arguments || a.code() == Code::NestingTooDeep;
    arguments_agree
        && (a.message, &a.file, &a.path, &a.place, &a.text)
            == (b.message, &b.file, &b.path, &b.place, &b.text)
}

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
