//! Arguments that several commands share, with the types of their values.

use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::ops::Deref;

use camino::Utf8PathBuf;
use clap::{Arg, ArgAction, ArgMatches, Args, Command as Definition, Error, FromArgMatches, ValueEnum};
use pathbuild_diagnostic::{Code, Lang};
use pathbuild_workspace::Inputs;
use pathbuild_workspace::config::sections::general::OPTIONS;
use pathbuild_workspace::config::{GivenOptions, OptionValues, Overrides, SettingOption};
use pathbuild_workspace::waivers::Date;

use super::completions;
use crate::printer::{ColorChoice, Verbosity};
use crate::render::Format;

/// The common options.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Common options")]
pub struct CommonArgs {
    /// Options that override the configuration.
    #[command(flatten)]
    pub settings: SettingArgs,
    /// Language of messages (also: `PATHBUILD_LANG`)
    #[arg(long, global = true, value_enum, hide_possible_values = true, value_name = "en|de")]
    pub lang: Option<LangArg>,
    /// Use this configuration instead of the drawing's pathbuild.toml
    #[arg(long, global = true, value_name = "FILE")]
    pub config: Option<Utf8PathBuf>,
    /// Format of the messages
    #[arg(long, global = true, value_enum, hide_possible_values = true, value_name = FORMATS)]
    pub format: Option<Format>,
    /// Write a report of the findings into a file as well; `-` is standard output (repeatable)
    #[arg(long, global = true, value_name = "FORMAT=FILE", value_parser = ReportFile::parse)]
    pub report: Vec<ReportFile>,
    /// When to use colours
    #[arg(long, global = true, value_enum, hide_possible_values = true, value_name = "auto|always|never")]
    pub color: Option<ColorChoice>,
    /// Print less: no status lines; given twice: results only
    #[arg(short, long, global = true, action = clap::ArgAction::Count, conflicts_with = "verbose")]
    pub quiet: u8,
    /// Print more
    #[arg(short, long, global = true, action = clap::ArgAction::Count)]
    pub verbose: u8,
    /// Number of threads
    #[arg(short, long, global = true, value_name = "N", value_parser = jobs)]
    pub jobs: Option<u16>,
    /// Do not trust the tree: read no file outside of it, and run no command that it names
    #[arg(long, global = true)]
    pub untrusted: bool,
    /// Use no cached results and cache none
    #[arg(long, global = true)]
    pub no_cache: bool,
    /// Directory for cached results; copies of the tree can share it (also: `PATHBUILD_CACHE_DIR`)
    #[arg(long, global = true, value_name = "DIR", conflicts_with = "no_cache")]
    pub cache_dir: Option<Utf8PathBuf>,
}

const FORMATS: &str = "full|concise|json|sarif|github|gitlab|junit";

impl CommonArgs {
    /// Returns the values that override the configuration.
    pub fn overrides(&self) -> Overrides {
        Overrides {
            settings: self.settings.0.clone(),
            lang: self.lang.map(Lang::from),
            config: self.config.clone(),
            untrusted: self.untrusted,
            trusted: None,
            date: None,
        }
    }

    /// Returns the amount of output to print.
    pub fn verbosity(&self) -> Verbosity {
        Verbosity::from_counts(self.quiet, self.verbose)
    }
}

/// A language, as written on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum LangArg {
    /// English
    En,
    /// German
    De,
}

impl From<LangArg> for Lang {
    fn from(lang: LangArg) -> Self {
        match lang {
            LangArg::En => Self::En,
            LangArg::De => Self::De,
        }
    }
}

fn jobs(text: &str) -> Result<u16, &'static str> {
    text.parse().ok().filter(|jobs| (1..=1024).contains(jobs)).ok_or("expected a number from 1 to 1024")
}

/// Options given on the command line that override settings of the configuration, not yet validated.
#[derive(Clone, Debug, Default)]
pub struct SettingArgs(pub GivenOptions);

impl Args for SettingArgs {
    fn augment_args(command: Definition) -> Definition {
        OPTIONS.iter().map(argument).fold(command, Definition::arg)
    }

    fn augment_args_for_update(command: Definition) -> Definition {
        Self::augment_args(command)
    }
}

impl FromArgMatches for SettingArgs {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let options = OPTIONS.iter().filter_map(|option| Some((option.name, texts(option, matches)?)));
        Ok(Self(options.collect()))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

fn argument(option: &SettingOption) -> Arg {
    let argument = Arg::new(option.name).long(option.name).global(true).help(option.help.en);
    match option.values {
        OptionValues::Switch => argument.action(ArgAction::SetTrue),
        OptionValues::Text(name) => argument.value_name(name).allow_hyphen_values(true),
        OptionValues::Texts(name) => {
            argument.value_name(name).allow_hyphen_values(true).action(ArgAction::Append)
        }
        OptionValues::Directory => argument.value_name("DIR"),
        OptionValues::Directories => argument.value_name("DIR").action(ArgAction::Append),
    }
}

fn texts(option: &SettingOption, matches: &ArgMatches) -> Option<Vec<String>> {
    if option.values == OptionValues::Switch {
        return matches.get_flag(option.name).then(Vec::new);
    }
    matches.get_many::<String>(option.name).map(|texts| texts.cloned().collect())
}

/// Options for accepted findings, and for findings to accept from now on.
#[derive(Clone, Debug, Default, Args)]
pub struct WaiverArgs {
    /// Report only findings that are not in this file (default: pathbuild-baseline.txt beside pathbuild.toml)
    #[arg(long, value_name = "FILE", value_parser = named_file)]
    pub baseline: Option<Utf8PathBuf>,
    /// Write all findings into the baseline file instead of reporting them
    #[arg(long)]
    pub update_baseline: bool,
    /// Accept the findings with this code: write them into the baseline file with --reason
    #[arg(long, value_name = "CODE", value_parser = code, requires = "reason", conflicts_with = "update_baseline")]
    pub accept: Option<Code>,
    /// With --accept: the reason
    #[arg(long, value_name = "TEXT", requires = "accept")]
    pub reason: Option<String>,
    /// With --accept: the last day on which this holds
    #[arg(long, value_name = "DATE", value_parser = date, requires = "accept")]
    pub until: Option<Date>,
    /// Date that waivers are compared with (default: `SOURCE_DATE_EPOCH`, else today in UTC)
    #[arg(long, value_name = "DATE", value_parser = date)]
    pub date: Option<Date>,
}

fn code(text: &str) -> Result<Code, &'static str> {
    text.parse().map_err(|()| "there is no such diagnostic: `pathbuild explain` lists all codes")
}

pub(super) fn date(text: &str) -> Result<Date, &'static str> {
    text.parse().map_err(|()| "expected a date such as 2026-12-31")
}

/// Refuses `-`, which stands for standard input or output elsewhere.
pub(super) fn named_file(text: &str) -> Result<Utf8PathBuf, &'static str> {
    if text == "-" { Err("expected the name of a file") } else { Ok(text.into()) }
}

/// Drawings, paths and directories given as arguments of a command.
#[derive(Clone, Debug, Default, Args)]
pub struct InputArgs {
    /// Drawings (.dxf), names of paths or patterns of them (8*.1P), directories
    #[arg(value_name = "DRAWING|PATH|DIRECTORY", add = completions::paths())]
    inputs: Vec<String>,
}

impl InputArgs {
    /// Returns the arguments as the inputs of a session.
    pub fn to_inputs(&self) -> Inputs {
        Inputs { inputs: self.inputs.clone() }
    }

    /// Whether there are no arguments.
    pub fn is_empty(&self) -> bool {
        self.inputs.is_empty()
    }
}

/// A report to write besides the printed output: `FORMAT=FILE`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReportFile {
    /// Format of the report.
    pub format: Format,
    /// File to write, or `-` for standard output.
    pub file: Utf8PathBuf,
}

impl ReportFile {
    /// Whether the report goes to standard output (`FORMAT=-`).
    pub fn is_stdout(&self) -> bool {
        self.file == "-"
    }

    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let (format, file) = text.split_once('=').ok_or("expected FORMAT=FILE")?;
        let format = Format::from_str(format, false).ok().filter(|format| format.shows_diagnostics());
        let format =
            format.ok_or("the format is full, concise, json, sarif, github, gitlab, junit or html")?;
        if file.is_empty() {
            return Err("the name of the file is missing".to_owned());
        }
        Ok(Self { format, file: file.into() })
    }
}

/// An address of this machine, at which the server listens.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Address {
    /// Host name or IP address.
    pub host: Host,
    /// Port; `None` means the default port, or a free one if the default port is in use.
    pub port: Option<u16>,
}

/// A name or an IP address of this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "self-explanatory")]
pub enum Host {
    Ip(IpAddr),
    Name(String),
}

impl Address {
    /// Loopback address, which only this machine can reach.
    pub const LOOPBACK: Self = Self { host: Host::Ip(IpAddr::V4(Ipv4Addr::LOCALHOST)), port: None };

    /// Parses `8080`, `127.0.0.1`, `[::1]:8080`, `localhost` or `name:8080`. Another name without a port is refused, because it could as
    /// well be a path or a directory.
    ///
    /// # Errors
    /// A description of the accepted forms.
    pub fn parse(text: &str) -> Result<Self, String> {
        if let Ok(port) = text.parse() {
            return Ok(Self { port: Some(port), ..Self::LOOPBACK });
        }
        if let Ok(address) = text.parse::<SocketAddr>() {
            return Ok(Self { host: Host::Ip(address.ip()), port: Some(address.port()) });
        }
        let bare = text.strip_prefix('[').and_then(|text| text.strip_suffix(']')).unwrap_or(text);
        if let Ok(ip) = bare.parse() {
            return Ok(Self { host: Host::Ip(ip), port: None });
        }
        let (name, port) = text.rsplit_once(':').map_or((text, None), |(name, port)| (name, Some(port)));
        let is_meant = port.is_some() || name.eq_ignore_ascii_case("localhost");
        let port: Option<u16> = port.map(str::parse).transpose().map_err(|_| ADVICE)?;
        if !is_meant || !is_name(name) {
            return Err(ADVICE.to_owned());
        }
        Ok(Self { host: Host::Name(name.to_ascii_lowercase()), port })
    }
}

const ADVICE: &str = "an address is PORT, IP, IP:PORT, localhost or NAME:PORT (drawings, paths and directories stand before --serve)";

/// Whether a text is a valid host name.
fn is_name(text: &str) -> bool {
    let is_part = |part: &str| {
        !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'-')
    };
    text.split('.').all(is_part)
}

/// Arguments of a command that are defined only when the command is used, because defining the arguments of all commands takes time.
#[derive(Clone, Debug)]
pub struct DeferredArgs<T>(T);

impl<T> Deref for DeferredArgs<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.0
    }
}

impl<T: Args> Args for DeferredArgs<T> {
    fn augment_args(command: Definition) -> Definition {
        command.defer(define::<T>)
    }

    fn augment_args_for_update(command: Definition) -> Definition {
        command.defer(define::<T>)
    }
}

impl<T: FromArgMatches> FromArgMatches for DeferredArgs<T> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        T::from_arg_matches(matches).map(Self)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        self.0.update_from_arg_matches(matches)
    }
}

/// Adds the arguments of a command to its definition. The description that the command already has is kept.
fn define<T: Args>(command: Definition) -> Definition {
    let about = command.get_about().cloned().unwrap_or_default();
    let long_about = command.get_long_about().cloned();
    let defined = T::augment_args(command).about(about);
    match long_about {
        Some(long_about) => defined.long_about(long_about),
        None => defined.long_about(None),
    }
}

german! {
    /// Help of shared arguments and their values, each text in English and German.
    pub(super) GERMAN:
    "Drawings (.dxf), names of paths or patterns of them (8*.1P), directories",
        "Zeichnungen (.dxf), Namen von Pfaden oder Muster dafür (8*.1P), Verzeichnisse";
    "Common options", "Allgemeine Optionen";
    "Language of messages (also: `PATHBUILD_LANG`)", "Sprache der Meldungen (auch: `PATHBUILD_LANG`)";
    "Use this configuration instead of the drawing's pathbuild.toml", "Nimmt diese Konfiguration statt der pathbuild.toml der Zeichnung";
    "Format of the messages", "Format der Meldungen";
    "Write a report of the findings into a file as well; `-` is standard output (repeatable)",
        "Schreibt die Befunde auch in eine Datei; `-` ist die Standardausgabe (wiederholbar)";
    "When to use colours", "Wann Farben verwendet werden";
    "Print less: no status lines; given twice: results only", "Gibt weniger aus: keine Statuszeilen; zweimal: nur Ergebnisse";
    "Print more", "Gibt mehr aus";
    "Number of threads", "Anzahl der Threads";
    "Do not trust the tree: read no file outside of it, and run no command that it names",
        "Traut dem Verzeichnisbaum nicht: liest keine Datei außerhalb und führt keinen dort genannten Befehl aus";
    "Date that waivers are compared with (default: `SOURCE_DATE_EPOCH`, else today in UTC)",
        "Datum, mit dem befristete Ausnahmen verglichen werden (sonst `SOURCE_DATE_EPOCH`, sonst heute in UTC)";
    "Report only findings that are not in this file (default: pathbuild-baseline.txt beside pathbuild.toml)",
        "Zeigt nur Befunde, die nicht in dieser Datei stehen (sonst: pathbuild-baseline.txt neben pathbuild.toml)";
    "Write all findings into the baseline file instead of reporting them",
        "Schreibt alle Befunde in die Datei von --baseline, statt sie zu zeigen";
    "Accept the findings with this code: write them into the baseline file with --reason",
        "Nimmt die Befunde mit diesem Code hin: schreibt sie mit --reason in die Datei von --baseline";
    "With --accept: the reason", "Mit --accept: der Grund";
    "With --accept: the last day on which this holds", "Mit --accept: der letzte Tag, an dem das gilt";
    "expected the name of a file", "erwartet wird der Name einer Datei";
    "expected a date such as 2026-12-31", "erwartet wird ein Datum wie 2026-12-31";
    "there is no such diagnostic: `pathbuild explain` lists all codes",
        "eine solche Meldung gibt es nicht: `pathbuild explain` führt alle Codes auf";
    "Use no cached results and cache none", "Verwendet keine gespeicherten Ergebnisse und speichert keine";
    "Directory for cached results; copies of the tree can share it (also: `PATHBUILD_CACHE_DIR`)",
        "Verzeichnis für gespeicherte Ergebnisse, das sich Kopien des Verzeichnisbaums teilen (auch: `PATHBUILD_CACHE_DIR`)";
    "With the faulty text underlined, help and notes", "Mit unterstrichenem Text, Hilfe und Hinweisen";
    "One line each", "Je eine Zeile";
    "One JSON object per line", "Je Zeile ein JSON-Objekt";
    "SARIF 2.1.0", "SARIF 2.1.0";
    "Annotations of a GitHub workflow", "Anmerkungen eines GitHub-Workflows";
    "GitLab Code Quality report", "Bericht für GitLab Code Quality";
    "`JUnit` XML, a test case for each path or program", "`JUnit`-XML, je Pfad oder Programm ein Testfall";
    "A page with pictures: for `--report` only", "Eine Seite mit Bildern: nur für `--report`";
    "A graph for Graphviz", "Ein Graph für Graphviz";
    "A graph for Mermaid", "Ein Graph für Mermaid";
    "English", "Englisch";
    "German", "Deutsch";
    "DRAWING|PATH|DIRECTORY", "ZEICHNUNG|PFAD|VERZEICHNIS";
    "FORMAT=FILE", "FORMAT=DATEI";
    "TEXT", "TEXT";
    "en|de", "en|de";
    "auto|always|never", "auto|always|never";
    "full|concise|json|sarif|github|gitlab|junit", "full|concise|json|sarif|github|gitlab|junit";
    "expected a number from 1 to 1024", "erwartet wird eine Zahl von 1 bis 1024";
    "expected FORMAT=FILE", "erwartet wird FORMAT=DATEI";
    "the format is full, concise, json, sarif, github, gitlab, junit or html",
        "das Format ist full, concise, json, sarif, github, gitlab, junit oder html";
    "the name of the file is missing", "der Name der Datei fehlt";
    "an address is PORT, IP, IP:PORT, localhost or NAME:PORT (drawings, paths and directories stand before --serve)",
        "eine Adresse ist PORT, IP, IP:PORT, localhost oder NAME:PORT (Zeichnungen, Pfade und Verzeichnisse stehen vor --serve)";
}
