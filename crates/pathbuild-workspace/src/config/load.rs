use camino::Utf8Path;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::configuration as messages;
use toml::de::DeTable;

use super::arguments::Overrides;
use super::options::Options;
use super::reader::Reader;
use super::settings::Settings;
use super::source::Source;
use super::{arguments, discover};
use crate::files;
use crate::inputs::Inputs;

/// What holds for a run: finds and reads the configuration, and puts the command line over it.
///
/// Everything that is wrong comes with it; when anything is, nothing can be done, but the language can be told.
pub fn load(given: &Overrides, inputs: &Inputs, working_directory: &Utf8Path) -> (Settings, Vec<Diagnostic>) {
    let (options, mut diagnostics) = arguments::read(given, working_directory);
    let file = match &given.config {
        Some(file) => Some(discover::clean(&working_directory.join(file))),
        None => discover::above(&discover::clean(&working_directory.join(inputs.first_directory()))),
    };
    if given.config.is_none() {
        diagnostics.extend(discover::strangers(inputs, working_directory, file.as_deref()));
    }
    let configured = file.as_deref().map(|file| read(file, &mut diagnostics)).unwrap_or_default();
    (Settings { file, ..options.over(configured).resolve() }, diagnostics)
}

/// Bytes of a configuration. What limits everything else is written in it, so this one is fixed.
const LARGEST: u64 = 4 << 20;

/// What is wrong with the text of a configuration.
pub fn faults(file: &Utf8Path, text: &str) -> Vec<Diagnostic> {
    parse(file, text).1
}

fn read(file: &Utf8Path, diagnostics: &mut Vec<Diagnostic>) -> Options {
    match files::read(file, LARGEST) {
        Ok(text) => {
            let (options, faults) = parse(file, &text);
            diagnostics.extend(faults);
            options
        }
        Err(reason) => {
            diagnostics.push(
                Diagnostic::new(&messages::CONFIGURATION_UNREADABLE).in_file(file).with("reason", &*reason),
            );
            Options::default()
        }
    }
}

/// A text that is no TOML gives its faults only, since what can still be read of it may lack half of a table.
fn parse(file: &Utf8Path, text: &str) -> (Options, Vec<Diagnostic>) {
    let source = Source::new(file, text);
    let (root, errors) = DeTable::parse_recoverable(text);
    if !errors.is_empty() {
        let mut faults: Vec<_> = errors.iter().map(|error| syntax_fault(error, &source)).collect();
        // What follows on the same line only follows from it.
        faults.dedup_by_key(|fault| fault.place.line);
        return (Options::default(), faults);
    }
    let directory = file.parent().unwrap_or(Utf8Path::new(""));
    let mut reader = Reader::new(source, directory);
    let options = Options::read(root.get_ref(), &mut reader);
    (options, reader.finish())
}

fn syntax_fault(error: &toml::de::Error, source: &Source<'_>) -> Diagnostic {
    let reason = error.message().lines().next().unwrap_or_default();
    source.fault(&messages::TOML_SYNTAX, error.span().unwrap_or(0..0)).with("reason", reason)
}
