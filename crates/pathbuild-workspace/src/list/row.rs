use pathbuild_diagnostic::Diagnostic;

use super::{ListedPath, ProgramState};
use crate::workspace::Workspace;

/// A path, with its findings counted by the configured severities.
#[derive(Clone, Debug)]
pub struct Row {
    /// What is known of it.
    pub path: ListedPath,
    /// Number of errors.
    pub errors: usize,
    /// Number of warnings.
    pub warnings: usize,
}

/// State of a path and of its program on disk, in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum State {
    /// The path has errors.
    Errors,
    /// The program on disk is out of date.
    Stale,
    /// The program on disk is up to date.
    Current,
    /// The path has no errors, and there is no program on disk.
    Ok,
}

impl State {
    pub(super) const ALL: [Self; 4] = [Self::Errors, Self::Stale, Self::Current, Self::Ok];

    /// Name in JSON.
    pub(super) fn key(self) -> &'static str {
        match self {
            Self::Errors => "errors",
            Self::Stale => "stale",
            Self::Current => "current",
            Self::Ok => "ok",
        }
    }
}

impl Row {
    /// Counts the findings of a path under a workspace's configuration.
    pub fn new(workspace: &Workspace, path: ListedPath) -> Self {
        let found = workspace.findings(path.diagnostics.clone());
        let errors = found.diagnostics.iter().filter(|found: &&Diagnostic| found.is_error()).count();
        Self { path, errors, warnings: found.diagnostics.len() - errors }
    }

    /// What it is.
    pub fn state(&self) -> State {
        match self.path.program {
            _ if self.errors > 0 => State::Errors,
            ProgramState::Stale => State::Stale,
            ProgramState::Current => State::Current,
            ProgramState::None | ProgramState::Unknown => State::Ok,
        }
    }

    /// Width and height of the area that the tool tip reaches while cutting, in mm.
    pub fn size(&self) -> Option<[f64; 2]> {
        let [x, y, _] = self.path.cutting_box;
        let width = |(low, high): (f64, f64)| high - low;
        Some([width(x?), width(y?)])
    }
}
