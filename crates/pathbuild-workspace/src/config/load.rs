use std::sync::Arc;

use camino::Utf8Path;
use pathbuild_db::System;
use pathbuild_db::system::ConfinedSystem;
use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_diagnostic::{Diagnostic, Value};
use toml::de::DeTable;

use super::arguments::Overrides;
use super::discover::{Discovery, confining};
use super::options::Options;
use super::reader::TomlReader;
use super::settings::Settings;
use super::source::Source;
use super::{arguments, clean};
use crate::files;
use crate::inputs::Inputs;

/// Finds and reads the configuration of a run, and applies the command line on top.
///
/// Also returns all diagnostics. If there are errors, the run cannot go on, but the settings at least contain the language of messages.
pub fn load(
    system: &Arc<dyn System>,
    given: &Overrides,
    inputs: &Inputs,
    working_directory: &Utf8Path,
) -> (Settings, Vec<Diagnostic>) {
    let discovery = Discovery { system: &**system, inputs, working_directory };
    let (options, mut diagnostics) = arguments::read(given, working_directory);
    let file = match &given.config {
        Some(file) => Some(clean(&working_directory.join(file))),
        None => discovery.for_run(),
    };
    let confined = confinement(system, given, file.as_deref(), &discovery);
    if given.config.is_none() {
        diagnostics.extend(discovery.misplaced_inputs(file.as_deref()));
    }
    let read = |file: &Utf8Path| read(&**system, file, confined.as_ref(), &mut diagnostics);
    let configured = file.as_deref().map(read).unwrap_or_default();
    let not_used = if file.is_none() { discovery.of_working_directory() } else { None };
    let is_unexpected =
        given.config.is_none() && file.as_deref().is_some_and(|file| discovery.is_unexpected(file));
    (Settings { file, not_used, is_unexpected, confined, ..options.over(configured).resolve() }, diagnostics)
}

/// The repositories that an untrusted run must not leave: that of the configuration, and that of each argument. `None` if all of them are
/// trusted.
fn confinement(
    system: &Arc<dyn System>,
    given: &Overrides,
    file: Option<&Utf8Path>,
    discovery: &Discovery<'_>,
) -> Option<ConfinedSystem> {
    let first = || discovery.search_start();
    let directory = file.and_then(Utf8Path::parent).map_or_else(first, Utf8Path::to_owned);
    let root = confining(&**system, &directory);
    let confined = ConfinedSystem::new(Arc::clone(system), root, discovery.working_directory);
    let further = discovery.search_starts();
    let confined = further.fold(confined, |confined, place| confined.and(confining(&**system, &place)));
    let is_trusted = given.trusted.as_ref().is_none_or(|roots| confined.lies_below(roots));
    (given.untrusted || !is_trusted).then_some(confined)
}

/// Upper bound on the size of a configuration in bytes. It is fixed because all other limits are set in the configuration.
pub(super) const LARGEST: u64 = 4 << 20;

/// Diagnostics of a configuration's text.
pub fn faults(file: &Utf8Path, text: &str) -> Vec<Diagnostic> {
    parse(file, text, None).1
}

fn read(
    system: &dyn System,
    file: &Utf8Path,
    confined: Option<&ConfinedSystem>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Options {
    let system = confined.map_or(system, |confined| confined);
    match files::read(system, file, LARGEST) {
        Ok(text) => {
            let (options, faults) = parse(file, &text, confined);
            diagnostics.extend(faults);
            options
        }
        Err(reason) => {
            diagnostics.push(
                Diagnostic::new(&messages::CONFIGURATION_UNREADABLE).in_file(file).with("reason", reason),
            );
            Options::default()
        }
    }
}

/// Parses a configuration. A syntax error yields diagnostics only, since tables may be incomplete.
fn parse(file: &Utf8Path, text: &str, confined: Option<&ConfinedSystem>) -> (Options, Vec<Diagnostic>) {
    read_table(file, text, confined, Options::read)
}

/// Parses the text of a configuration file.
pub(super) fn read_table<T: Default>(
    file: &Utf8Path,
    text: &str,
    confined: Option<&ConfinedSystem>,
    read: impl FnOnce(&DeTable<'_>, &mut TomlReader<'_>) -> T,
) -> (T, Vec<Diagnostic>) {
    let source = Source::new(file, text);
    let (root, errors) = DeTable::parse_recoverable(text);
    if !errors.is_empty() {
        let mut faults: Vec<_> = errors.iter().map(|error| syntax_fault(error, &source)).collect();
        // Further errors on the same line are consequences of the first.
        faults.dedup_by_key(|fault| fault.place.line);
        return (T::default(), faults);
    }
    let directory = file.parent().unwrap_or(Utf8Path::new(""));
    let mut reader = TomlReader::new(source, directory, confined);
    let value = read(root.get_ref(), &mut reader);
    (value, reader.finish())
}

fn syntax_fault(error: &toml::de::Error, source: &Source<'_>) -> Diagnostic {
    let reason = error.message().lines().next().unwrap_or_default();
    source.fault(&messages::TOML_SYNTAX, error.span().unwrap_or(0..0)).with("reason", Value::foreign(reason))
}
