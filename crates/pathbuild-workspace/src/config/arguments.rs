//! Values from the command line: options that set keys of the configuration, and options of the run itself.

use std::collections::BTreeMap;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::join;
use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_diagnostic::{Diagnostic, Lang, Message, Text, TextFault, Value};
use pathbuild_path::has_thousands;

use super::kinds::{MEASURE_BOUNDS, number_from_text, regex_fault, split_restriction};
use super::origin::SourcedValue;
use super::types::{Directories, Restriction};
use crate::waivers::RunDate;

/// A command-line option that sets the configuration key with the same name. (book: reference/commands)
#[derive(Debug)]
pub struct SettingOption {
    /// The name of the key and, after two hyphens, of the option.
    pub name: &'static str,
    /// Kind and number of the option's values.
    pub values: OptionValues,
    /// Help text of the option.
    pub help: Text,
}

/// The values that an option takes, with their name in the help.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OptionValues {
    /// No value: the option is a switch.
    Switch,
    /// One text, which may begin with a hyphen. The string names the value in the help.
    Text(&'static str),
    /// One text each time that the option is given. The string names the value in the help.
    Texts(&'static str),
    /// One directory, relative to the working directory.
    Directory,
    /// One directory each time that the option is given.
    Directories,
}

/// The given options that set keys: the values of each (none for a switch) by its name. They are validated when the configuration is loaded.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct GivenOptions(BTreeMap<&'static str, Vec<String>>);

impl GivenOptions {
    pub(super) fn has(&self, name: &str) -> bool {
        self.0.contains_key(name)
    }
}

impl FromIterator<(&'static str, Vec<String>)> for GivenOptions {
    fn from_iter<I: IntoIterator<Item = (&'static str, Vec<String>)>>(options: I) -> Self {
        Self(options.into_iter().collect())
    }
}

/// Values from the command line. Options that set keys are stored as text, so that they are validated together with the configuration.
#[derive(Clone, Debug, Default)]
pub struct Overrides {
    /// Options that set keys of the configuration.
    pub settings: GivenOptions,
    /// Language of messages (`--lang`).
    pub lang: Option<Lang>,
    /// `--config`: the configuration to use instead of the nearest one.
    pub config: Option<Utf8PathBuf>,
    /// `--untrusted`: treats the tree as untrusted.
    pub untrusted: bool,
    /// Directories below which all trees are trusted; `None` trusts trees everywhere.
    pub trusted: Option<Vec<Utf8PathBuf>>,
    /// The date that waivers are compared with.
    pub date: Option<RunDate>,
}

/// Parses the value of an option that must be a number greater than 0, with decimal point or comma.
///
/// # Errors
/// A diagnostic that underlines the value.
pub fn positive(name: &str, text: &str) -> Result<f64, Box<Diagnostic>> {
    let number = number_from_text(text).filter(|number| *number > 0.0);
    number.ok_or_else(|| Box::new(invalid_option(name, text, &messages::POSITIVE)))
}

/// Parses the value of an option that must be a number, with decimal point or comma.
///
/// # Errors
/// A diagnostic that underlines the value.
pub fn number(name: &str, text: &str) -> Result<f64, Box<Diagnostic>> {
    number_from_text(text).ok_or_else(|| Box::new(invalid_option(name, text, &messages::NUMBER)))
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

fn restriction(name: &str, text: &str) -> Result<Restriction, Box<Diagnostic>> {
    let Some(rule) = split_restriction(text) else {
        return Err(Box::new(fault(&messages::RESTRICT_WITHOUT_COLON, name, text)));
    };
    match regex_fault(&rule.parent).or_else(|| regex_fault(&rule.child)) {
        None => Ok(rule),
        Some(reason) => Err(Box::new(fault(&messages::BROKEN_REGEX, name, text).with("reason", reason))),
    }
}

fn invalid_option(name: &str, text: &str, expected: &'static Text) -> Diagnostic {
    let written_out = text.to_ascii_lowercase().contains('e').then(|| text.parse::<f64>().ok()).flatten();
    if let Some(number) = written_out.filter(|number| MEASURE_BOUNDS.contains(number)) {
        return fault(&messages::EXPONENT, name, text)
            .quoting("found", text)
            .quoting("number", number.to_string());
    }
    let fault = fault(&messages::INVALID_VALUE, name, text);
    fault.with("expected", Value::Prose(expected)).quoting("found", text)
}

fn fault(message: &'static Message, name: &str, text: &str) -> Diagnostic {
    let option = format!("--{name}");
    let shown = format!("{option}={text}");
    let span = option.len() + 1..shown.len();
    Diagnostic::new(message).quoting("key", option).with_text(TextFault::new(&shown, span))
}

/// A reader of the given options, which validates them, applies them to the configured values, and collects the diagnostics.
pub(super) struct OptionReader<'a> {
    given: &'a GivenOptions,
    working_directory: &'a Utf8Path,
    pub(super) diagnostics: Vec<Diagnostic>,
}

impl<'a> OptionReader<'a> {
    pub(super) fn new(given: &'a GivenOptions, working_directory: &'a Utf8Path) -> Self {
        Self { given, working_directory, diagnostics: Vec::new() }
    }

    /// Replaces a configured value with an option's value, if the option is given and valid.
    pub(super) fn replace_value<T>(
        &mut self,
        setting: &mut Option<SourcedValue<T>>,
        name: &'static str,
        read: impl FnOnce(&GivenOption<'a>) -> Result<T, Vec<Diagnostic>>,
    ) {
        if let Some(value) = self.take(name, read) {
            *setting = Some(SourcedValue::option(name, value));
        }
    }

    /// Appends the values of an option to the configured ones, if the option is given and valid.
    pub(super) fn append_values<T>(
        &mut self,
        setting: &mut Option<SourcedValue<Vec<T>>>,
        name: &'static str,
        read: impl FnOnce(&GivenOption<'a>) -> Result<Vec<T>, Vec<Diagnostic>>,
    ) {
        if let Some(items) = self.take(name, read) {
            setting.get_or_insert_with(|| SourcedValue::default(Vec::new())).extend(name, items);
        }
    }

    fn take<T>(
        &mut self,
        name: &'static str,
        read: impl FnOnce(&GivenOption<'a>) -> Result<T, Vec<Diagnostic>>,
    ) -> Option<T> {
        let texts = self.given.0.get(name)?;
        let option = GivenOption { name, texts, working_directory: self.working_directory };
        match read(&option) {
            Ok(value) => Some(value),
            Err(faults) => {
                self.diagnostics.extend(faults);
                None
            }
        }
    }
}

/// An option of the command line with its values. If the option takes only one value, the last one counts.
pub(super) struct GivenOption<'a> {
    name: &'static str,
    texts: &'a [String],
    working_directory: &'a Utf8Path,
}

impl GivenOption<'_> {
    pub(super) fn positive_number(&self) -> Result<Option<f64>, Vec<Diagnostic>> {
        let number = number_from_text(self.last()).filter(|number| MEASURE_BOUNDS.contains(number));
        number.map(Some).ok_or_else(|| vec![invalid_option(self.name, self.last(), &messages::MEASURE)])
    }

    pub(super) fn speed(&self) -> Result<Option<f64>, Vec<Diagnostic>> {
        match self.positive_number()? {
            Some(speed) if has_thousands(self.last(), speed) => {
                Err(vec![invalid_option(self.name, self.last(), &messages::SPEED)])
            }
            speed => Ok(speed),
        }
    }

    pub(super) fn regex(&self) -> Result<Box<str>, Vec<Diagnostic>> {
        regex(self.name, self.last()).map(Box::from).map_err(|fault| vec![*fault])
    }

    pub(super) fn restrictions(&self) -> Result<Vec<Restriction>, Vec<Diagnostic>> {
        let (mut rules, mut faults) = (Vec::new(), Vec::new());
        for text in self.texts {
            match restriction(self.name, text) {
                Ok(rule) => rules.push(rule),
                Err(fault) => faults.push(*fault),
            }
        }
        if faults.is_empty() { Ok(rules) } else { Err(faults) }
    }

    pub(super) fn directory(&self) -> Utf8PathBuf {
        self.absolute(self.last())
    }

    pub(super) fn directories(&self) -> Directories {
        self.texts.iter().map(|directory| self.absolute(directory)).collect()
    }

    fn absolute(&self, directory: &str) -> Utf8PathBuf {
        join(self.working_directory, Utf8Path::new(directory))
    }

    fn last(&self) -> &str {
        self.texts.last().map_or("", String::as_str)
    }
}
