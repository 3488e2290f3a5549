//! The command line in German: definitions with German help, and error messages. The English texts come from `args` and from clap. This
//! module also prints help and usage errors, in both languages.

use std::error::Error as _;
use std::fmt::Write as _;

use clap::builder::{PossibleValue, PossibleValuesParser, Str};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, Command, CommandFactory, Error};
use pathbuild_diagnostic::Lang;
use pathbuild_workspace::config::sections::general::OPTIONS;

use crate::args::{self, Cli};
use crate::exit::ExitStatus;
use crate::printer::Printer;

const TEMPLATE: &str = "{before-help}{about-with-newline}\nAufruf: {usage}\n\n{all-args}{after-help}";

/// Returns the definition of the command line with help in a language. The German definition only serves to show help and errors.
pub fn command(lang: Lang) -> Command {
    let mut command = Cli::command();
    command.build();
    match lang {
        Lang::En => command,
        Lang::De => translate_command(command),
    }
}

/// Returns every help text, value name and possible value in English and German, except for settings. A test compares them with the
/// definition of the command line.
pub fn catalogue() -> impl Iterator<Item = (&'static str, &'static str)> {
    args::GERMAN.into_iter().chain([OTHER_TRANSLATIONS]).flatten().copied()
}

/// Returns the German translation of a text of the command line.
pub fn german(english: &str) -> Option<&'static str> {
    let settings = OPTIONS.iter().map(|option| (option.help.en, option.help.de));
    catalogue().chain(settings).find(|(en, _)| *en == english).map(|(_, de)| de)
}

/// Translates the words that clap itself inserts into help texts.
fn translate_clap_words(help: &str) -> String {
    let words = [
        ("[OPTIONS]", "[OPTIONEN]"),
        ("\nArguments:\n", "\nArgumente:\n"),
        ("\nOptions:\n", "\nOptionen:\n"),
        // The second line of a usage message is indented by the length of its first word.
        ("\n       pathbuild ", "\n        pathbuild "),
    ];
    words.into_iter().fold(help.to_owned(), |help, (en, de)| help.replace(en, de))
}

fn translate_command(command: Command) -> Command {
    let about = command.get_about().and_then(|about| german(&about.to_string()));
    let after = command.get_after_help().and_then(|after| german(&after.to_string()));
    let command = about.into_iter().fold(command, Command::about);
    let command = after.into_iter().fold(command, Command::after_help);
    command
        .help_template(TEMPLATE)
        .subcommand_help_heading("Befehle")
        .subcommand_value_name("BEFEHL")
        .mut_args(argument)
        .mut_subcommands(translate_command)
}

fn argument(argument: Arg) -> Arg {
    let heading = argument.get_help_heading().and_then(german);
    let name = |name: &Str| german(name).map_or_else(|| name.clone(), Str::from);
    let names: Vec<Str> = argument.get_value_names().unwrap_or_default().iter().map(name).collect();
    let argument = with_help(argument).help_heading(heading);
    if names.is_empty() { argument } else { argument.value_names(names) }
}

/// Translates the help of an argument and of its possible values.
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

/// Prints clap's answer to a command line that is not run, in this language: help, the version, or a usage error.
pub(crate) fn print_clap_error(error: &Error, lang: Lang, printer: &Printer) -> ExitStatus {
    let text = error.render().to_string();
    let text = if lang == Lang::De { translate_clap_words(&text) } else { text };
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => help(&text, printer),
        _ if lang == Lang::De && error.kind() != ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            print_usage_error(&german_error(error), lang, printer)
        }
        _ => {
            printer.usage(text);
            ExitStatus::Usage
        }
    }
}

/// Prints help that was requested.
pub(crate) fn help(text: &str, printer: &Printer) -> ExitStatus {
    printer.result(text);
    ExitStatus::Success
}

pub(crate) fn print_usage_error(reason: &str, lang: Lang, printer: &Printer) -> ExitStatus {
    let (error, advice) = match lang {
        Lang::En => ("error", "For more information, try '--help'."),
        Lang::De => ("Fehler", ADVICE),
    };
    printer.usage(format_args!("{error}: {reason}\n\n{advice}\n"));
    ExitStatus::Usage
}

/// Last line of German usage errors, which refers to the help.
const ADVICE: &str = "Mehr dazu mit '--help'.";

/// Returns the German message for a usage error, with tips and the usage. It is composed from the parts of clap's error.
fn german_error(error: &Error) -> String {
    let mut text = error_description(error);
    let tips = tips(error);
    if !tips.is_empty() {
        _ = write!(text, "\n\n  Tipp: {}", tips.join("\n  Tipp: "));
    }
    if let Some(ContextValue::StyledStr(usage)) = error.get(ContextKind::Usage) {
        _ = write!(text, "\n\n{}", translate_clap_words(&usage.to_string()).replace("Usage:", "Aufruf:"));
    }
    text
}

fn error_description(error: &Error) -> String {
    let one = |kind| context_values(error, kind).join(", ");
    let argument = one(ContextKind::InvalidArg);
    let value = one(ContextKind::InvalidValue);
    match error.kind() {
        ErrorKind::ArgumentConflict => {
            conflict_message(&argument, &context_values(error, ContextKind::PriorArg))
        }
        ErrorKind::InvalidValue if value.is_empty() => {
            format!("zu '{argument}' fehlt der Wert{}", values(error, "möglich", ContextKind::ValidValue))
        }
        ErrorKind::InvalidValue => {
            let values = values(error, "möglich", ContextKind::ValidValue);
            format!("'{value}' ist kein Wert für '{argument}'{values}")
        }
        ErrorKind::ValueValidation => {
            let why = error.source().map(ToString::to_string).unwrap_or_default();
            format!("'{value}' ist kein Wert für '{argument}': {}", german(&why).unwrap_or(&why))
        }
        ErrorKind::TooManyValues => format!("'{value}' ist ein Wert zu viel für '{argument}'"),
        ErrorKind::UnknownArgument => format!("'{argument}' ist hier unbekannt"),
        ErrorKind::InvalidSubcommand => {
            format!("es gibt keinen Befehl '{}'", one(ContextKind::InvalidSubcommand))
        }
        ErrorKind::MissingSubcommand => {
            let values = values(error, "Befehle", ContextKind::ValidSubcommand);
            format!("zu '{}' fehlt der Befehl{values}", one(ContextKind::InvalidSubcommand))
        }
        ErrorKind::MissingRequiredArgument => {
            format!("es fehlt:{}", lines(&context_values(error, ContextKind::InvalidArg)))
        }
        ErrorKind::InvalidUtf8 => "ein Argument ist kein gültiger Text (UTF-8)".to_owned(),
        _ => "der Aufruf ist falsch".to_owned(),
    }
}

fn conflict_message(argument: &str, prior: &[String]) -> String {
    match prior {
        [prior] if prior == argument => format!("'{argument}' darf nur einmal vorkommen"),
        [prior] => format!("'{argument}' und '{prior}' schließen sich aus"),
        [] => format!("'{argument}' und andere Angaben schließen sich aus"),
        _ => format!("'{argument}' schließt sich aus mit:{}", lines(prior)),
    }
}

fn tips(error: &Error) -> Vec<String> {
    let kinds = [ContextKind::SuggestedSubcommand, ContextKind::SuggestedArg, ContextKind::SuggestedValue];
    let near = kinds.into_iter().map(|kind| context_values(error, kind)).filter(|near| !near.is_empty());
    let near = near.map(|near| format!("ist '{}' gemeint?", near.join("' oder '")));
    let Some(ContextValue::StyledStrs(other)) = error.get(ContextKind::Suggested) else {
        return near.collect();
    };
    near.chain(other.iter().filter_map(|tip| translate_tip(&tip.to_string()))).collect()
}

/// Translates a tip composed by clap; `None` if it is unknown.
fn translate_tip(english: &str) -> Option<String> {
    match *english.split('\'').collect::<Vec<_>>() {
        ["to pass ", value, " as a value, use ", line, ""] => {
            Some(format!("soll '{value}' ein Wert sein: '{line}'"))
        }
        ["", line, " exists"] => Some(format!("es gibt '{line}'")),
        ["subcommand ", name, " exists; to use it, remove the ", _, " before it"] => {
            Some(format!("es gibt den Befehl '{name}'; dafür das '--' davor weglassen"))
        }
        _ => None,
    }
}

fn values(error: &Error, heading: &str, kind: ContextKind) -> String {
    let values = context_values(error, kind);
    if values.is_empty() { String::new() } else { format!("\n  [{heading}: {}]", values.join(", ")) }
}

fn lines(items: &[String]) -> String {
    items.iter().flat_map(|item| ["\n  ", item.as_str()]).collect()
}

/// Returns the values that a clap error has for a kind of context.
fn context_values(error: &Error, kind: ContextKind) -> Vec<String> {
    match error.get(kind) {
        Some(ContextValue::String(text)) => vec![text.clone()],
        Some(ContextValue::Strings(texts)) => texts.clone(),
        _ => Vec::new(),
    }
}

/// Texts of clap itself and of values that are defined elsewhere, in English and German.
const OTHER_TRANSLATIONS: &[(&str, &str)] = &[
    (
        "Print this message or the help of the given subcommand(s)",
        "Gibt diese Hilfe oder die eines Befehls aus",
    ),
    ("Print help", "Gibt die Hilfe aus"),
    ("Print version", "Gibt die Version aus"),
    ("On a terminal", "Auf einem Terminal"),
    ("Also into a file or pipe", "Auch in eine Datei oder Pipe"),
    ("Nowhere", "Nirgends"),
    ("PARENT:CHILD", "AUSSEN:INNEN"),
    ("MM/MIN", "MM/MIN"),
];
