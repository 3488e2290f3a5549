use pathbuild_diagnostic::Diagnostic;

use super::{ListedPath, ProgramState};
use crate::workspace::Workspace;

/// A path, judged by the configuration's severities.
#[derive(Clone, Debug)]
pub struct Row {
    /// What is known of it.
    pub path: ListedPath,
    /// How many errors it has.
    pub errors: usize,
    /// How many warnings.
    pub warnings: usize,
}

/// What a path is, in one word: for itself, and beside the program on disk.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum State {
    /// It has errors.
    Errors,
    /// The program on disk is another one.
    Stale,
    /// The program on disk is the one that would be written.
    Current,
    /// It has no errors, and no program lies on disk.
    Ok,
}

impl State {
    pub(super) const ALL: [Self; 4] = [Self::Errors, Self::Stale, Self::Current, Self::Ok];

    /// As in JSON.
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
    /// A path under the configuration of a workspace.
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

    /// Width and height of what the cutter's tip reaches while it cuts, in mm.
    pub fn size(&self) -> Option<[f64; 2]> {
        let [x, y, _] = self.path.cutting_box;
        let width = |(low, high): (f64, f64)| high - low;
        Some([width(x?), width(y?)])
    }
}
