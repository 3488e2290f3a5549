//! Exit status of the program. The numbers are part of the interface and never change. (book: reference/diagnostics)

use std::process::ExitCode;

use clap::error::ErrorKind;
use pathbuild_diagnostic::Lang;
use pathbuild_workspace::findings::Findings;

use crate::german;
use crate::printer::Printer;

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

// Errors of usage: the arguments cannot be processed, whatever the drawings contain.

/// Prints clap's answer in this language: help and version, or an error of usage.
pub(crate) fn answer(error: &clap::Error, lang: Lang, printer: &Printer) -> ExitStatus {
    let text = error.render().to_string();
    let text = if lang == Lang::De { german::shown(&text) } else { text };
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => help(&text, printer),
        _ if lang == Lang::De && error.kind() != ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            wrong(&german::reason(error), lang, printer)
        }
        _ => {
            printer.usage(text);
            ExitStatus::Usage
        }
    }
}

/// Prints requested help.
pub(crate) fn help(text: &str, printer: &Printer) -> ExitStatus {
    printer.result(text);
    ExitStatus::Success
}

/// Prints an error of usage.
pub(crate) fn wrong(reason: &str, lang: Lang, printer: &Printer) -> ExitStatus {
    let (error, advice) = match lang {
        Lang::En => ("error", "For more information, try '--help'."),
        Lang::De => ("Fehler", german::ADVICE),
    };
    printer.usage(format_args!("{error}: {reason}\n\n{advice}\n"));
    ExitStatus::Usage
}
