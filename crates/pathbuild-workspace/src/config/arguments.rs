use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::join;
use pathbuild_diagnostic::Lang;
use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_diagnostic::{Diagnostic, Message, TextFault, Value, Word};

use super::kinds::number::number_from_text;
use super::kinds::pattern::{regex_fault, split_restriction};
use super::options::Options;
use super::origin::Sourced;
use super::types::Restriction;

/// Values from the command line. Those that the configuration can also set are kept as text, so that they are validated in one place.
#[derive(Clone, Debug, Default)]
pub struct Overrides {
    /// `--feed` in mm/min.
    pub feed: Option<String>,
    /// `--rapid` in mm/min.
    pub rapid: Option<String>,
    /// `--sweep-height` in mm.
    pub sweep_height: Option<String>,
    /// `--probe-feed` in mm/min.
    pub probe_feed: Option<String>,
    /// `--search`, relative to the working directory.
    pub search: Vec<Utf8PathBuf>,
    /// `--path-pattern`.
    pub path_pattern: Option<String>,
    /// `--file-pattern`.
    pub file_pattern: Option<String>,
    /// `--restrict`, each PARENT:CHILD.
    pub restrict: Vec<String>,
    /// `--lang`.
    pub lang: Option<Lang>,
    /// `--out-dir`, relative to the working directory.
    pub out_dir: Option<Utf8PathBuf>,
    /// `--compatible`.
    pub compatible: bool,
    /// `--config`: the configuration to use instead of the nearest one.
    pub config: Option<Utf8PathBuf>,
    /// `--untrusted`: treats the tree as untrusted.
    pub untrusted: bool,
    /// Directories below which trees are trusted; `None` means that all trees are.
    pub trusted: Option<Vec<Utf8PathBuf>>,
}

/// Validates the values from the command line.
pub(super) fn read(arguments: &Overrides, working_directory: &Utf8Path) -> (Options, Vec<Diagnostic>) {
    let mut reader = OptionReader::default();
    let mut options = Options::default();
    let general = &mut options.general;
    general.feed = reader.positive("feed", arguments.feed.as_deref());
    general.rapid = reader.positive("rapid", arguments.rapid.as_deref());
    general.sweep_height = reader.positive("sweep-height", arguments.sweep_height.as_deref());
    general.probe_feed = reader.positive("probe-feed", arguments.probe_feed.as_deref());
    general.path_pattern = reader.regex("path-pattern", arguments.path_pattern.as_deref());
    general.file_pattern = reader.regex("file-pattern", arguments.file_pattern.as_deref());
    general.restrict = given(&arguments.restrict, "restrict", |rules| {
        rules.iter().filter_map(|rule| reader.restriction(rule)).collect()
    });
    general.search = given(&arguments.search, "search", |directories| {
        directories.iter().map(|directory| join(working_directory, directory)).collect()
    });
    general.out_dir = arguments
        .out_dir
        .as_ref()
        .map(|directory| Sourced::option("out-dir", Some(join(working_directory, directory))));
    general.compatible = arguments.compatible.then(|| Sourced::option("compatible", true));
    // PathDxf2GCode has a single option for messages and comments. Without `--compatible`, `--lang` does not change programs.
    let comments = arguments.lang.filter(|_| arguments.compatible);
    general.comment_lang = comments.map(|lang| Sourced::option("lang", lang));
    (options, reader.diagnostics)
}

/// Parses the value of an option that must be a number greater than 0, with decimal point or comma.
///
/// # Errors
/// A diagnostic that underlines the value.
pub fn positive(name: &str, text: &str) -> Result<f64, Box<Diagnostic>> {
    let number = number_from_text(text).filter(|number| *number > 0.0);
    number.ok_or_else(|| Box::new(invalid(name, text, &messages::POSITIVE)))
}

/// Parses the value of an option that must be a number, with decimal point or comma.
///
/// # Errors
/// A diagnostic that underlines the value.
pub fn number(name: &str, text: &str) -> Result<f64, Box<Diagnostic>> {
    number_from_text(text).ok_or_else(|| Box::new(invalid(name, text, &messages::NUMBER)))
}

fn invalid(name: &str, text: &str, expected: &'static Word) -> Diagnostic {
    let fault = fault(&messages::INVALID_VALUE, name, text);
    fault.with("expected", Value::Word(expected)).with("found", text)
}

/// Validates the value of an option that must be a regular expression.
///
/// # Errors
/// A diagnostic that underlines the value.
pub fn regex<'t>(name: &str, text: &'t str) -> Result<&'t str, Box<Diagnostic>> {
    match regex_fault(text) {
        None => Ok(text),
        Some(reason) => Err(Box::new(fault(&messages::BROKEN_REGEX, name, text).with("reason", reason))),
    }
}

#[derive(Default)]
struct OptionReader {
    diagnostics: Vec<Diagnostic>,
}

impl OptionReader {
    fn positive(&mut self, name: &'static str, text: Option<&str>) -> Option<Sourced<Option<f64>>> {
        let number = self.keep(positive(name, text?))?;
        Some(Sourced::option(name, Some(number)))
    }

    fn regex(&mut self, name: &'static str, text: Option<&str>) -> Option<Sourced<Box<str>>> {
        let regex = self.keep(regex(name, text?))?;
        Some(Sourced::option(name, regex.into()))
    }

    fn restriction(&mut self, text: &str) -> Option<Restriction> {
        let fault = || fault(&messages::RESTRICT_WITHOUT_COLON, "restrict", text);
        let rule = self.keep(split_restriction(text).ok_or_else(|| Box::new(fault())))?;
        let reason = regex_fault(&rule.parent).or_else(|| regex_fault(&rule.child));
        let broken = reason
            .map(|reason| self::fault(&messages::BROKEN_REGEX, "restrict", text).with("reason", reason));
        self.keep(broken.map_or(Ok(rule), |broken| Err(Box::new(broken))))
    }

    fn keep<T>(&mut self, result: Result<T, Box<Diagnostic>>) -> Option<T> {
        result.map_err(|diagnostic| self.diagnostics.push(*diagnostic)).ok()
    }
}

fn given<T, U>(values: &[T], name: &'static str, read: impl FnOnce(&[T]) -> U) -> Option<Sourced<U>> {
    (!values.is_empty()).then(|| Sourced::option(name, read(values)))
}

fn fault(message: &'static Message, name: &str, text: &str) -> Diagnostic {
    let option = format!("--{name}");
    let shown = format!("{option}={text}");
    let span = option.len() + 1..shown.len();
    Diagnostic::new(message).with("key", option).with_text(TextFault::new(&shown, span))
}
