//! Applies the configuration to diagnostics: it sets their severities, ignores some, and waives others. (book: reference/diagnostics)

use std::sync::atomic::{AtomicBool, Ordering};

use camino::Utf8Path;
use pathbuild_diagnostic::messages::outputs;
use pathbuild_diagnostic::{Code, Diagnostic};

use crate::config::types::{FileSeverities, Level, level_in};
use crate::config::{Settings, clean};
use crate::waivers::Waiver;
use crate::workspace::Workspace;

/// The configured severities of a run. Unlike a workspace, they can be shared between threads.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Severities<'a> {
    settings: &'a Settings,
    working_directory: &'a Utf8Path,
    is_date_decisive: &'a AtomicBool,
}

/// The outcome of applying the configured severities and waivers to a diagnostic.
pub(crate) enum Verdict {
    /// The diagnostic is reported, with its configured severity.
    Reported(Diagnostic),
    /// The diagnostic is dropped.
    Ignored,
    /// The diagnostic is accepted for a stated reason.
    Waived(Diagnostic, Waiver),
}

impl Workspace {
    pub(crate) fn severities(&self) -> Severities<'_> {
        Severities {
            settings: &self.settings,
            working_directory: &self.working_directory,
            is_date_decisive: &self.is_date_decisive,
        }
    }

    /// Whether any of these diagnostics is an error under the configuration. A program with errors is not written.
    pub fn has_error<'d>(&self, diagnostics: impl IntoIterator<Item = &'d Diagnostic>) -> bool {
        self.severities().has_error(diagnostics)
    }

    /// Returns PB524 if the configuration lowers all errors among these problems of a program that was not written. Without it, the user would see no
    /// reason why the program was not written.
    pub fn lowered_error<'d>(
        &self,
        problems: impl IntoIterator<Item = &'d Diagnostic> + Clone,
    ) -> Option<Diagnostic> {
        let error = problems.clone().into_iter().find(|problem| problem.is_error())?;
        if self.has_error(problems) {
            return None;
        }
        let problem = Diagnostic::new(&outputs::LOWERED_ERROR).quoting("code", error.code().to_string());
        Some(Diagnostic { file: error.file.clone(), path: error.path.clone(), ..problem })
    }
}

impl Severities<'_> {
    pub(crate) fn has_error<'d>(&self, diagnostics: impl IntoIterator<Item = &'d Diagnostic>) -> bool {
        let is_error = |diagnostic: &Diagnostic| match self.apply_severity(diagnostic.clone()) {
            Verdict::Reported(diagnostic) => diagnostic.is_error(),
            Verdict::Ignored | Verdict::Waived(..) => false,
        };
        diagnostics.into_iter().any(is_error)
    }

    /// Applies the configured severities and their waivers to a diagnostic.
    pub(crate) fn apply_severity(&self, diagnostic: Diagnostic) -> Verdict {
        let code = diagnostic.code();
        let run = self.settings.date;
        let file = diagnostic.file.as_deref().map(|file| self.configured(file));
        let entries = file.iter().flat_map(|file| self.levels_in(code, file));
        let mut ended = Vec::new();
        let mut level = level_in(&self.settings.tables.severity.value, code).map(|level| (level, None));
        for (entry, in_file) in entries {
            if entry.waiver.holds(run) {
                level = Some((in_file, Some(&entry.waiver)));
                break;
            }
            ended.push(&entry.waiver);
        }
        let place = self.settings.file.as_deref().and_then(Utf8Path::file_name).unwrap_or_default();
        let noted = |diagnostic| {
            ended.iter().fold(diagnostic, |diagnostic, waiver| waiver.note_end(diagnostic, place, run))
        };
        let Some((level, waiver)) = level else { return Verdict::Reported(noted(diagnostic)) };
        match (level.severity(), waiver.filter(|waiver| waiver.is_stated())) {
            (Some(severity), waiver) => {
                let diagnostic = noted(Diagnostic { severity, ..diagnostic });
                Verdict::Reported(match waiver {
                    Some(waiver) => waiver.note_severity(diagnostic, place, run),
                    None => diagnostic,
                })
            }
            (None, Some(waiver)) => {
                self.is_date_decisive.fetch_or(waiver.until.is_some(), Ordering::Relaxed);
                Verdict::Waived(diagnostic, waiver.clone())
            }
            (None, None) => Verdict::Ignored,
        }
    }

    /// Returns the name of a file as patterns in the configuration see it: relative to the configuration's directory, with slashes.
    pub(crate) fn configured(&self, file: &Utf8Path) -> String {
        let file = clean(&self.working_directory.join(file));
        let below = self.settings.directory().and_then(|directory| file.strip_prefix(directory).ok());
        below.unwrap_or(&file).as_str().replace('\\', "/")
    }

    /// Iterates over the entries that set the level of a code in a file. If several apply, the last one of the configuration takes precedence, so
    /// it comes first.
    fn levels_in(&self, code: Code, file: &str) -> impl Iterator<Item = (&FileSeverities, Level)> {
        let entries = self.settings.tables.severity_in.value.iter().rev();
        let entries = entries.filter(move |entry| entry.concerns(file));
        entries.filter_map(move |entry| Some((entry, level_in(&entry.levels, code)?)))
    }
}
