//! Wrong usage: what the program was called with cannot be done, whatever the drawings say. (exit status 2)

use clap::error::ErrorKind;

use crate::exit::ExitStatus;
use crate::printer::Printer;

/// Prints what clap found: help and version, which were asked for, or an error of usage.
pub(crate) fn answer(error: &clap::Error, printer: &Printer) -> ExitStatus {
    let text = error.render();
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
            printer.result(text);
            ExitStatus::Success
        }
        _ => {
            printer.usage(text);
            ExitStatus::Usage
        }
    }
}

/// Prints help that was asked for.
pub(crate) fn help(text: &str, printer: &Printer) -> ExitStatus {
    printer.result(text);
    ExitStatus::Success
}

/// Prints why the program cannot do what it was called for.
pub(crate) fn wrong(reason: &str, printer: &Printer) -> ExitStatus {
    printer.usage(format_args!("error: {reason}\n\nFor more information, try '--help'.\n"));
    ExitStatus::Usage
}
