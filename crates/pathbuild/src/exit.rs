//! Exit status of the program. The numbers are part of the interface and never change. (book: reference/diagnostics)

use std::process::ExitCode;

use pathbuild_workspace::findings::Findings;

/// How a run ended.
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
    /// The status that findings mean.
    pub(crate) fn of(findings: &Findings) -> Self {
        if findings.errors() > 0 { Self::Errors } else { Self::Success }
    }

    /// The number that the shell sees.
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
