//! The baseline, the file of findings that are accepted. (book: howto/ci)

use std::path::PathBuf;

use camino::Utf8PathBuf;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_workspace::Workspace;
use pathbuild_workspace::settle::{self, BaselineOutcome, BaselineTask};
use pathbuild_workspace::waivers::{Coverage, Waiver};

use crate::options::{date, utf8};
use crate::{Error, Finding};

/// The baseline of a check or a verification, and its use. By default, the findings in `pathbuild-baseline.txt` beside the configuration are
/// accepted.
#[derive(Clone, Debug, Default)]
pub struct BaselineOptions {
    file: Option<PathBuf>,
    task: Task,
}

#[derive(Clone, Debug, Default)]
enum Task {
    #[default]
    Apply,
    Update,
    Accept {
        code: String,
        reason: String,
        until: Option<String>,
    },
}

/// A baseline that was written.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct WrittenBaseline {
    /// Name of the file.
    pub file: String,
    /// Number of findings that were written.
    pub findings: usize,
}

impl BaselineOptions {
    /// Creates the default options.
    pub fn new() -> Self {
        Self::default()
    }

    /// Uses this file instead of `pathbuild-baseline.txt` beside the configuration.
    pub fn file(mut self, file: impl Into<PathBuf>) -> Self {
        self.file = Some(file.into());
        self
    }

    /// Writes all findings into the baseline instead of reporting them. Entries that still match keep their reasons and dates.
    pub fn update(mut self) -> Self {
        self.task = Task::Update;
        self
    }

    /// Writes the findings with this code, such as `PB203`, into the baseline instead of reporting them: with this reason and, if there is one, the
    /// last day on which this holds, such as `2026-12-31`.
    pub fn accept(mut self, code: impl Into<String>, reason: impl Into<String>, until: Option<&str>) -> Self {
        let until = until.map(str::to_owned);
        self.task = Task::Accept { code: code.into(), reason: reason.into(), until };
        self
    }

    pub(crate) fn resolve(self, workspace: &Workspace) -> Result<settle::BaselineOptions, Error> {
        let lang = Some(workspace.lang());
        let task = match self.task {
            Task::Apply => BaselineTask::Apply,
            Task::Update => BaselineTask::Update,
            Task::Accept { code, reason, until } => {
                let [en, de] = ["there is no code `{}`", "es gibt keinen Code `{}`"];
                let code = code.parse().map_err(|()| Error::Refused(workspace.phrase(en, de, &code)))?;
                let until = until.map(|text| date(&text, lang)).transpose()?;
                BaselineTask::Accept(code, Waiver { reason: Some(reason.into()), until, line: 0 })
            }
        };
        let file = self.file.map(|file| utf8(file, lang)).transpose()?;
        Ok(settle::BaselineOptions { file, task })
    }
}

/// The findings of a run after the baseline was applied or written.
pub(crate) struct SettledFindings {
    pub(crate) findings: Vec<Finding>,
    pub(crate) accepted: Vec<Finding>,
    pub(crate) baseline: Option<WrittenBaseline>,
}

impl SettledFindings {
    /// Applies or writes the baseline. `coverage` returns the files that the run covered.
    pub(crate) fn new(
        workspace: &Workspace,
        diagnostics: Vec<Diagnostic>,
        baseline: &settle::BaselineOptions,
        coverage: impl FnOnce() -> Coverage,
    ) -> Result<Self, Error> {
        let settled = workspace.apply_baseline_options(workspace.findings(diagnostics), baseline, coverage);
        match settled.map_err(Error::from_failure)? {
            BaselineOutcome::Findings(findings) => {
                let (findings, accepted) = Finding::reported_and_accepted(findings);
                Ok(Self { findings, accepted, baseline: None })
            }
            BaselineOutcome::Written(settle::WrittenBaseline { file, findings }) => {
                let baseline = Some(WrittenBaseline { file: Utf8PathBuf::into_string(file), findings });
                Ok(Self { findings: Vec::new(), accepted: Vec::new(), baseline })
            }
        }
    }
}
