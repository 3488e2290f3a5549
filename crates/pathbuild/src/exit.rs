//! Exit status of the program. The numbers are part of the interface and never change. (book: reference/diagnostics)

use std::process::ExitCode;

use pathbuild_workspace::findings::Findings;

/// The exit status of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[must_use]
pub enum ExitStatus {
    /// 0: no errors; there may be warnings.
    Success,
    /// 1: errors were found, or something could not be written.
    Errors,
    /// 2: wrong usage or configuration; nothing was done.
    Usage,
}

impl ExitStatus {
    pub(crate) fn of(findings: &Findings) -> Self {
        if findings.error_count() > 0 { Self::Errors } else { Self::Success }
    }

    /// Returns the number that the shell receives.
    pub fn code(self) -> u8 {
        match self {
            Self::Success => 0,
            Self::Errors => 1,
            Self::Usage => 2,
        }
    }
}

impl From<ExitStatus> for ExitCode {
    fn from(status: ExitStatus) -> Self {
        Self::from(status.code())
    }
}
