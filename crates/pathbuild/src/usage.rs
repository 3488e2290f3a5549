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
