//! The command line in German: definitions with German help, and error messages. The English texts come from `args` and from clap.

mod help;
mod usage;

use clap::builder::{PossibleValue, PossibleValuesParser, Str};
use clap::{Arg, Command, CommandFactory};
use pathbuild_diagnostic::Lang;
use pathbuild_workspace::config::sections::general::OPTIONS;

pub use help::CATALOGUE;
pub(crate) use usage::{ADVICE, reason};

use crate::args::Cli;

const TEMPLATE: &str = "{before-help}{about-with-newline}\nAufruf: {usage}\n\n{all-args}{after-help}";

/// The definition of the command line with help in a language. The German one is used to show help and errors only.
pub fn command(lang: Lang) -> Command {
    let mut command = Cli::command();
    command.build();
    match lang {
        Lang::En => command,
        Lang::De => translated(command),
    }
}

/// The German translation of a text of the command line.
pub fn german(english: &str) -> Option<&'static str> {
    let settings = OPTIONS.iter().map(|option| (option.help.en, option.help.de));
    CATALOGUE.iter().copied().chain(settings).find(|(en, _)| *en == english).map(|(_, de)| de)
}

/// Translates the words that clap itself inserts into help texts.
pub(crate) fn shown(help: &str) -> String {
    let words = [
        ("[OPTIONS]", "[OPTIONEN]"),
        ("\nArguments:\n", "\nArgumente:\n"),
        ("\nOptions:\n", "\nOptionen:\n"),
        // Second line of a usage.
        ("\n       pathbuild ", "\n        pathbuild "),
    ];
    words.into_iter().fold(help.to_owned(), |help, (en, de)| help.replace(en, de))
}

fn translated(command: Command) -> Command {
    let about = command.get_about().and_then(|about| german(&about.to_string()));
    let after = command.get_after_help().and_then(|after| german(&after.to_string()));
    let command = about.into_iter().fold(command, Command::about);
    let command = after.into_iter().fold(command, Command::after_help);
    command
        .help_template(TEMPLATE)
        .subcommand_help_heading("Befehle")
        .subcommand_value_name("BEFEHL")
        .mut_args(argument)
        .mut_subcommands(translated)
}

fn argument(argument: Arg) -> Arg {
    let heading = argument.get_help_heading().and_then(german);
    let name = |name: &Str| german(name).map_or_else(|| name.clone(), Str::from);
    let names: Vec<Str> = argument.get_value_names().unwrap_or_default().iter().map(name).collect();
    let argument = with_help(argument).help_heading(heading);
    if names.is_empty() { argument } else { argument.value_names(names) }
}

/// Translates the help of an argument, including its possible values.
fn with_help(argument: Arg) -> Arg {
    let help = argument.get_help().and_then(|help| german(&help.to_string())).unwrap_or_default();
    let values = argument.get_possible_values();
    if values.is_empty() || !argument.get_action().takes_values() {
        return argument.help(help);
    }
    let names: Vec<&str> = values.iter().map(PossibleValue::get_name).collect();
    let is_hidden = argument.is_hide_possible_values_set();
    let help = if is_hidden { help.to_owned() } else { format!("{help} [möglich: {}]", names.join(", ")) };
    let values: Vec<PossibleValue> = values.into_iter().map(value).collect();
    argument.help(help).hide_possible_values(true).value_parser(PossibleValuesParser::new(values))
}

fn value(value: PossibleValue) -> PossibleValue {
    let help = value.get_help().and_then(|help| german(&help.to_string()));
    help.into_iter().fold(value, PossibleValue::help)
}
