//! German messages for errors of the command line, built from the parts of clap's errors.

use std::error::Error as _;
use std::fmt::Write as _;

use clap::Error;
use clap::error::{ContextKind, ContextValue, ErrorKind};

use super::{german, shown};

/// Points to the help.
pub(crate) const ADVICE: &str = "Mehr dazu mit '--help'.";

/// The error with tips and usage.
pub(crate) fn reason(error: &Error) -> String {
    let mut text = what(error);
    let tips = tips(error);
    if !tips.is_empty() {
        _ = write!(text, "\n\n  Tipp: {}", tips.join("\n  Tipp: "));
    }
    if let Some(ContextValue::StyledStr(usage)) = error.get(ContextKind::Usage) {
        _ = write!(text, "\n\n{}", shown(&usage.to_string()).replace("Usage:", "Aufruf:"));
    }
    text
}

fn what(error: &Error) -> String {
    let one = |kind| context_values(error, kind).join(", ");
    let argument = one(ContextKind::InvalidArg);
    let value = one(ContextKind::InvalidValue);
    match error.kind() {
        ErrorKind::ArgumentConflict => conflict(&argument, &context_values(error, ContextKind::PriorArg)),
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

fn conflict(argument: &str, prior: &[String]) -> String {
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
    near.chain(other.iter().filter_map(|tip| tip_of(&tip.to_string()))).collect()
}

/// Translates a tip that clap has composed.
fn tip_of(english: &str) -> Option<String> {
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

/// Values that a clap error has in a certain context.
fn context_values(error: &Error, kind: ContextKind) -> Vec<String> {
    match error.get(kind) {
        Some(ContextValue::String(text)) => vec![text.clone()],
        Some(ContextValue::Strings(texts)) => texts.clone(),
        _ => Vec::new(),
    }
}
