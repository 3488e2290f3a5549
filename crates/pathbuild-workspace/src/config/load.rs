//! Finds and reads the configurations of the tree and of the user, and applies the command line.

use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::System;
use pathbuild_db::system::{ConfinedSystem, FileKind, join};
use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_diagnostic::{Diagnostic, Lang, Value};
use toml::de::DeTable;

use super::arguments::{OptionReader, Overrides};
use super::clean;
use super::describe::schema;
use super::kinds::{ABSOLUTE_DIRECTORIES, ABSOLUTE_DIRECTORY, choice};
use super::origin::SourcedValue;
use super::reader::{Source, TomlReader};
use super::settings::{Options, Settings};
use super::types::Directories;
use crate::files;
use crate::inputs::{Input, Inputs};

/// Finds and reads the configuration of a run, and applies the command line to it.
///
/// Also returns all diagnostics. If they include errors, the run cannot go on, but the settings at least contain the language of messages.
pub fn load(
    system: &Arc<dyn System>,
    given: &Overrides,
    inputs: &Inputs,
    working_directory: &Utf8Path,
) -> (Settings, Vec<Diagnostic>) {
    let discovery = Discovery { system: &**system, inputs, working_directory };
    let file = match &given.config {
        Some(file) => Some(clean(&working_directory.join(file))),
        None => discovery.for_run(),
    };
    let confined = untrusted_repositories(system, given, file.as_deref(), &discovery);
    let (mut options, faults) =
        file.as_deref().map(|file| read(&**system, file, confined.as_ref())).unwrap_or_default();
    let mut diagnostics = apply_overrides(given, working_directory, &mut options);
    if given.config.is_none() {
        diagnostics.extend(discovery.misplaced_inputs(file.as_deref()));
    }
    diagnostics.extend(faults);
    let not_used = if file.is_none() { discovery.for_working_directory() } else { None };
    let misnamed = if file.is_none() { discovery.misnamed() } else { None };
    let is_unexpected =
        given.config.is_none() && file.as_deref().is_some_and(|file| discovery.is_unexpected(file));
    let mut settings =
        Settings { file, not_used, misnamed, is_unexpected, confined, date: given.date, ..options.resolve() };
    // `config show` prints the value that applies.
    settings.general.comment_lang.value = settings.comment_lang();
    (settings, diagnostics)
}

/// Returns the repositories that an untrusted run must not leave: those of the configuration and of each argument. `None` if the run is trusted,
/// which means that all of them are trusted and `--untrusted` is not given.
fn untrusted_repositories(
    system: &Arc<dyn System>,
    given: &Overrides,
    file: Option<&Utf8Path>,
    discovery: &Discovery<'_>,
) -> Option<ConfinedSystem> {
    let first = || discovery.search_start();
    let directory = file.and_then(Utf8Path::parent).map_or_else(first, Utf8Path::to_owned);
    let root = confining_repository(&**system, &directory);
    let confined = ConfinedSystem::new(Arc::clone(system), root, discovery.working_directory);
    let further = discovery.search_starts();
    let confined =
        further.fold(confined, |confined, place| confined.with_root(confining_repository(&**system, &place)));
    let is_trusted = given.trusted.as_ref().is_none_or(|roots| confined.lies_below(roots));
    (given.untrusted || !is_trusted).then_some(confined)
}

/// Upper bound on the size of a configuration in bytes. It is fixed because all other limits are set in the configuration.
pub(super) const MAX_CONFIGURATION_BYTES: u64 = 4 << 20;

/// Checks the text of a configuration and returns its diagnostics.
pub fn check_text(file: &Utf8Path, text: &str) -> Vec<Diagnostic> {
    parse(file, text, None).1
}

fn read(
    system: &dyn System,
    file: &Utf8Path,
    confined: Option<&ConfinedSystem>,
) -> (Options, Vec<Diagnostic>) {
    let system = confined.map_or(system, |confined| confined);
    match text(system, file) {
        Ok(text) => parse(file, &text, confined),
        Err(fault) => (Options::default(), vec![*fault]),
    }
}

/// Reads a configuration file of at most [`MAX_CONFIGURATION_BYTES`].
fn text(system: &dyn System, file: &Utf8Path) -> Result<String, Box<Diagnostic>> {
    files::read(system, file, MAX_CONFIGURATION_BYTES).map_err(|reason| {
        let fault = Diagnostic::new(&messages::CONFIGURATION_UNREADABLE).in_file(file);
        Box::new(fault.with("reason", reason))
    })
}

/// Parses a configuration. A syntax error yields diagnostics only, since tables may be incomplete.
fn parse(file: &Utf8Path, text: &str, confined: Option<&ConfinedSystem>) -> (Options, Vec<Diagnostic>) {
    read_table(file, text, confined, |root, reader| {
        reader.suggest_tables(schema);
        Options::read(root, reader)
    })
}

/// Parses the text of a configuration file and passes its root table to `read`. Returns the result of `read`, or the default after a syntax error,
/// with all diagnostics.
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
    let span = error.span().unwrap_or(0..0);
    let message = if is_decimal_comma(source, span.start) {
        &messages::TOML_COMMA
    } else if reason.contains("escape") {
        &messages::TOML_ESCAPE
    } else if reason == "duplicate key" {
        &messages::TOML_DUPLICATE
    } else {
        &messages::TOML_SYNTAX
    };
    source.fault(message, span).with("reason", Value::foreign(reason))
}

/// Whether a byte of the text is a comma between two digits.
fn is_decimal_comma(source: &Source<'_>, byte: usize) -> bool {
    let around = source.slice(byte.saturating_sub(1)..byte + 2).as_bytes();
    matches!(around, [before, b',', behind] if before.is_ascii_digit() && behind.is_ascii_digit())
}

/// A search for the configuration that applies to a run or a directory.
pub(super) struct Discovery<'a> {
    pub(super) system: &'a dyn System,
    pub(super) inputs: &'a Inputs,
    pub(super) working_directory: &'a Utf8Path,
}

impl Discovery<'_> {
    /// Finds the configuration of a run: the nearest one above the first argument. If this argument is a program without a configuration above it,
    /// the next argument decides, and finally the working directory.
    pub(super) fn for_run(&self) -> Option<Utf8PathBuf> {
        for input in self.inputs.iter() {
            let configuration = self.find_above(&self.search_start_of(input));
            if configuration.is_some() || !input.is_program(|place| self.is_directory(place)) {
                return configuration;
            }
        }
        self.for_working_directory()
    }

    pub(super) fn for_working_directory(&self) -> Option<Utf8PathBuf> {
        self.find_above(&clean(self.working_directory))
    }

    /// Finds a file that was probably meant as the configuration, in the directories where a configuration is searched.
    fn misnamed(&self) -> Option<Utf8PathBuf> {
        let start = self.search_start();
        let names = |directory| files::MISTAKEN_NAMES.iter().map(move |name| join(directory, name));
        start.ancestors().flat_map(names).find(|file| self.system.kind(file) == FileKind::File)
    }

    /// Returns the directory that takes the place of the configuration's directory if there is no configuration: that of the first argument, or the
    /// working directory.
    pub(super) fn search_start(&self) -> Utf8PathBuf {
        let first = self.inputs.iter().next();
        first.map_or_else(|| clean(self.working_directory), |first| self.search_start_of(first))
    }

    pub(super) fn search_starts(&self) -> impl Iterator<Item = Utf8PathBuf> + '_ {
        self.inputs.iter().map(|input| self.search_start_of(input))
    }

    /// Whether this configuration applies to a program unexpectedly: the working directory has another one, or the program lies outside the tree of
    /// this configuration.
    pub(super) fn is_unexpected(&self, file: &Utf8Path) -> bool {
        let tree = file.parent().unwrap_or(Utf8Path::new(""));
        let mut programs =
            self.inputs.iter().filter(|input| input.is_program(|place| self.is_directory(place))).peekable();
        programs.peek().is_some() && self.for_working_directory().as_deref() != Some(file)
            || programs.any(|program| !self.search_start_of(program).starts_with(tree))
    }

    fn search_start_of(&self, input: Input<'_>) -> Utf8PathBuf {
        clean(&self.working_directory.join(input.search_start(|place| self.is_directory(place))))
    }

    /// Finds the configuration that applies in a directory: its own, or else that of the nearest directory above.
    pub(super) fn find_above(&self, directory: &Utf8Path) -> Option<Utf8PathBuf> {
        let mut files = directory.ancestors().map(|directory| join(directory, files::FILE_NAME));
        // A directory named like a configuration, or a dangling link, is treated as a configuration that cannot be read.
        let is_one = |file: &Utf8PathBuf| match self.system.kind(file) {
            FileKind::File | FileKind::Directory => true,
            FileKind::Missing => files::is_named(file),
        };
        files.find(is_one)
    }

    /// Returns a diagnostic for each argument whose nearest configuration is not that of the run.
    pub(super) fn misplaced_inputs(&self, used: Option<&Utf8Path>) -> Vec<Diagnostic> {
        let place = |input: Input<'_>| match input {
            Input::Place(place) => Some(place.to_owned()),
            Input::Name(name) => self.is_directory(name.into()).then(|| name.into()),
        };
        let stranger = |input: Input<'_>| {
            let place = place(input)?;
            match self.find_above(&clean(&self.working_directory.join(&place))) {
                Some(other) => (Some(&*other) != used).then(|| misplaced_input(&place, &other, used)),
                None if input.is_program(|place| self.is_directory(place)) => None,
                None => used.map(|used| unconfigured_input(&place, used)),
            }
        };
        self.inputs.iter().filter_map(stranger).collect()
    }

    /// Whether an argument is a directory. This is looked up, because a directory's name need not contain a separator.
    fn is_directory(&self, place: &Utf8Path) -> bool {
        self.system.kind(&self.working_directory.join(place)) == FileKind::Directory
    }
}

/// Returns the root of the Git repository that contains a directory, if there is one.
pub fn repository<'a>(system: &dyn System, directory: &'a Utf8Path) -> Option<&'a Utf8Path> {
    let is_repository = |directory: &&Utf8Path| system.kind(&directory.join(".git")) != FileKind::Missing;
    directory.ancestors().find(is_repository)
}

/// Returns the repository outside which an untrusted run must not access files. If the path of the directory goes through symbolic links, this is the
/// repository that contains the outermost of these links, if there is one. Without any repository, returns the directory itself.
pub(super) fn confining_repository<'a>(system: &dyn System, directory: &'a Utf8Path) -> &'a Utf8Path {
    let is_link = |place: &&Utf8Path| {
        let (Some(parent), Some(name)) = (place.parent(), place.file_name()) else { return false };
        system.canonical(place) != system.canonical(parent).join(name)
    };
    let is_repository = |place: &&Utf8Path| system.kind(&place.join(".git")) != FileKind::Missing;
    let outermost = directory.ancestors().filter(is_link).last();
    let around = outermost.and_then(|link| link.ancestors().skip(1).find(is_repository));
    around.or_else(|| repository(system, directory)).unwrap_or(directory)
}

fn misplaced_input(place: &Utf8Path, other: &Utf8Path, used: Option<&Utf8Path>) -> Diagnostic {
    let message =
        if used.is_some() { &messages::OTHER_CONFIGURATION } else { &messages::UNEXPECTED_CONFIGURATION };
    let diagnostic =
        Diagnostic::new(message).quoting("argument", place.as_str()).quoting("other", other.as_str());
    match used {
        Some(used) => diagnostic.quoting("used", used.as_str()),
        None => diagnostic,
    }
}

fn unconfigured_input(place: &Utf8Path, used: &Utf8Path) -> Diagnostic {
    let diagnostic = Diagnostic::new(&messages::NO_CONFIGURATION);
    diagnostic.quoting("argument", place.as_str()).quoting("used", used.as_str())
}

/// Settings of the user for all trees.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct UserSettings {
    /// `lang`: language of messages. Comments in programs keep the language that the configuration of their tree sets.
    pub lang: Option<Lang>,
    /// `[cache] dir`: where results are cached, in a subdirectory for each tree.
    pub cache_dir: Option<Utf8PathBuf>,
    /// `[trust] roots`: directories with trusted trees; all other trees are treated as with `--untrusted`. `None` trusts all trees.
    pub trusted: Option<Directories>,
}

impl UserSettings {
    /// Reads the user's settings from a file, if it exists, and returns all diagnostics of the file.
    pub fn load(system: &dyn System, file: &Utf8Path) -> (Self, Vec<Diagnostic>) {
        if !files::is_named(file) {
            return (Self::default(), Vec::new());
        }
        match text(system, file) {
            Ok(text) => read_table(file, &text, None, Self::read),
            Err(fault) => (Self::default(), vec![*fault]),
        }
    }

    fn read(root: &DeTable<'_>, reader: &mut TomlReader<'_>) -> Self {
        reader.table(root, "", |table| Self {
            lang: table.take("lang", &choice()).map(|lang| lang.value),
            cache_dir: table
                .section("cache", |cache| cache.take("dir", &ABSOLUTE_DIRECTORY))
                .map(|value| value.value),
            trusted: table
                .section("trust", |trust| trust.take("roots", &ABSOLUTE_DIRECTORIES))
                .map(|value| value.value),
        })
    }
}

fn apply_overrides(
    overrides: &Overrides,
    working_directory: &Utf8Path,
    options: &mut Options,
) -> Vec<Diagnostic> {
    let mut reader = OptionReader::new(&overrides.settings, working_directory);
    options.general.apply(&mut reader);
    // PathDxf2GCode has one option for the language of both messages and comments. Without `--compatible`, `--lang` does not change programs.
    if let Some(lang) = overrides.lang.filter(|_| overrides.settings.has("compatible")) {
        options.general.comment_lang = Some(SourcedValue::option("lang", lang));
    }
    reader.diagnostics
}
