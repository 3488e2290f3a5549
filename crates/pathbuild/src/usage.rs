//! Errors of usage: the arguments cannot be processed, whatever the drawings contain. (exit status 2)

use clap::error::ErrorKind;
use pathbuild_diagnostic::Lang;

use crate::exit::ExitStatus;
use crate::german;
use crate::printer::Printer;

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
