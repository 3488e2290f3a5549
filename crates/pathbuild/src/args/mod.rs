//! Defines the commands and options of the program. Defaults that depend on the configuration, and checks that need a file, are elsewhere.
//! (book: reference/commands)

/// Declares a table of texts in English and German.
macro_rules! german {
    ($(#[$doc:meta])* $visibility:vis $name:ident: $($en:literal, $de:literal;)*) => {
        $(#[$doc])*
        $visibility const $name: &[(&str, &str)] = &[$(($en, $de),)*];
    };
}

mod commands;
pub(crate) mod completions;
mod shared;

use std::ffi::OsString;

use camino::Utf8Path;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{
    ArgMatches, Args, Command as Definition, CommandFactory, Error, FromArgMatches, Parser, Subcommand,
    ValueEnum,
};
use pathbuild_workspace::Inputs;
use pathbuild_workspace::waivers::Date;

pub use self::commands::CheckArgs;
pub use self::commands::{AdjustArgs, EmitArgs};
pub use self::commands::{
    CacheArgs, CacheCommand, CompatArgs, CompletionsArgs, ConfigArgs, ConfigCommand, DiffArgs, ExplainArgs,
    InitArgs, QProjectArgs, SheetArgs, TextsArgs, ViewArgs,
};
pub use self::commands::{GraphArgs, ListArgs};
pub use self::commands::{ImportArgs, PostArgs, PostCommand, ReadingArgs, VerifyArgs};
pub use self::commands::{MachineArgs, MachineCommand};
pub use self::commands::{ServeArgs, WatchArgs};
pub use self::shared::CommonArgs;
pub use self::shared::DeferredArgs;
pub use self::shared::InputArgs;
use self::shared::LangArg;
pub use self::shared::ReportFile;
pub use self::shared::SettingArgs;
pub use self::shared::{Address, Host, WaiverArgs};

/// Compiles drawings of milling paths to G-code.
#[derive(Debug, Parser)]
#[command(name = "pathbuild", bin_name = "pathbuild", version, max_term_width = 110)]
#[command(
    after_help = "Exit status: 0 nothing wrong (warnings allowed), 1 errors found, 2 wrong usage or configuration."
)]
pub struct Cli {
    /// The command to run.
    #[command(subcommand)]
    pub command: Command,
    /// Options that every command accepts.
    #[command(flatten)]
    pub common: CommonArgs,
}

/// All commands, each with its arguments.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Check every path of the given drawings, paths or directories; without arguments the library. Writes no programs
    Check(DeferredArgs<CheckArgs>),
    /// Write the files of one or more paths; without arguments those of `[emit] targets`
    Emit(DeferredArgs<EmitArgs>),
    /// Put measured heights into a program: `DRAWING_Clean.gcode` and `DRAWING_Z.txt` become `DRAWING_Milling.gcode`
    Adjust(DeferredArgs<AdjustArgs>),
    /// Check again whenever a drawing changes
    Watch(DeferredArgs<WatchArgs>),
    /// Show which element each parameter text belongs to
    Texts(DeferredArgs<TextsArgs>),
    /// Show a path, a drawing or a program: in the browser, or as SVG, PNG, PDF, HTML or JSON
    View(DeferredArgs<ViewArgs>),
    /// Make a path's setup sheet for the machine operator: PDF, HTML or SVG, or in the browser
    Sheet(DeferredArgs<SheetArgs>),
    /// Show how changed drawings change the moves: between directories, Git revisions, or a program and a path
    Diff(DeferredArgs<DiffArgs>),
    /// Read a G-code program and print what it does: moves, depths, feeds, times
    Import(DeferredArgs<ImportArgs>),
    /// Check a G-code program
    Verify(DeferredArgs<VerifyArgs>),
    /// Write a G-code program for another machine
    Post(DeferredArgs<PostArgs>),
    /// Show which path embeds which, with the values of variables
    Graph(DeferredArgs<GraphArgs>),
    /// Show which paths a path embeds
    Deps(DeferredArgs<GraphArgs>),
    /// Show which paths embed a path
    Rdeps(DeferredArgs<GraphArgs>),
    /// List paths with drawing, M, T, O, size, length, minutes and state; without arguments those of the library
    List(DeferredArgs<ListArgs>),
    /// Count the paths by material, cutter and state
    Stats(DeferredArgs<ListArgs>),
    /// Show where a path is defined
    Where(DeferredArgs<GraphArgs>),
    /// Show why drawings would be compiled again: what has changed since the last `check` of the library
    Why(DeferredArgs<GraphArgs>),
    /// Write a Q-project: a drawing that embeds every path of another
    QProject(DeferredArgs<QProjectArgs>),
    /// Manage the results cached between runs
    Cache(DeferredArgs<CacheArgs>),
    /// Explain the codes of messages; without a code list all of them
    Explain(DeferredArgs<ExplainArgs>),
    /// Write a commented pathbuild.toml into the working directory
    Init(DeferredArgs<InitArgs>),
    /// Show the configuration
    Config(DeferredArgs<ConfigArgs>),
    /// Import machine settings from a controller, and tools from a CAM program
    Machine(DeferredArgs<MachineArgs>),
    /// Print a completion script for a shell
    Completions(DeferredArgs<CompletionsArgs>),
    /// Print the manual page
    Man,
    /// Run a command line of `PathDxf2GCode` or `PathGCodeAdjustZ`
    Compat(DeferredArgs<CompatArgs>),
}

impl Command {
    /// Whether the arguments may be G-code programs.
    pub(crate) fn reads_programs(&self) -> bool {
        matches!(self, Self::Verify(_) | Self::Import(_) | Self::Post(_) | Self::View(_) | Self::Adjust(_))
    }

    /// Returns the date that waivers are compared with, if the command line states one.
    pub fn date(&self) -> Option<Date> {
        match self {
            Self::Check(args) => args.waivers.date,
            Self::Verify(args) => args.waivers.date,
            Self::Emit(args) => args.date,
            Self::Post(args) => args.date,
            _ => None,
        }
    }

    /// Returns the drawings and paths that the command works on; empty for commands without such arguments.
    pub fn inputs(&self) -> Inputs {
        match self {
            Self::Check(args) => args.inputs.to_inputs(),
            Self::Emit(args) => args.inputs.to_inputs(),
            Self::Watch(args) => args.inputs.to_inputs(),
            Self::Texts(args) => args.inputs.to_inputs(),
            Self::View(args) => Inputs { inputs: vec![args.what.clone()] },
            Self::Sheet(args) => Inputs { inputs: vec![args.what.clone()] },
            Self::Graph(args)
            | Self::Deps(args)
            | Self::Rdeps(args)
            | Self::Where(args)
            | Self::Why(args) => args.inputs.to_inputs(),
            Self::List(args) | Self::Stats(args) => args.inputs(),
            Self::QProject(args) => Inputs { inputs: vec![args.drawing.clone()] },
            Self::Adjust(args) => Inputs::of_files(&args.files),
            Self::Import(args) => Inputs::of_files(&args.files),
            Self::Verify(args) => args.inputs(),
            Self::Post(args) => Inputs::of_files(&args.file),
            Self::Config(args) => match &args.command {
                ConfigCommand::Show { inputs, .. } => inputs.to_inputs(),
                ConfigCommand::Schema => Inputs::default(),
            },
            _ => Inputs::default(),
        }
    }

    /// Whether the command cannot run with an invalid configuration.
    pub fn needs_configuration(&self) -> bool {
        !matches!(self, Self::Explain(_) | Self::Init(_) | Self::Completions(_) | Self::Man | Self::Compat(_))
    }

    /// Whether the command prints findings or results in machine-readable formats.
    pub fn has_document(&self) -> bool {
        !matches!(self, Self::Explain(_) | Self::Init(_) | Self::Completions(_) | Self::Man | Self::Compat(_))
            && !matches!(self, Self::Config(args) if matches!(args.command, ConfigCommand::Schema))
            && !matches!(self, Self::Post(args) if matches!(args.command, Some(PostCommand::Show { .. })))
    }

    /// Whether the command writes a program or other raw output to stdout, so that everything else goes to stderr.
    pub fn owns_stdout(&self) -> bool {
        match self {
            Self::Emit(args) => args.output.is_some(),
            Self::Post(args) => args.command.is_none() && args.output.as_ref().is_none_or(|file| file == "-"),
            _ => false,
        }
    }

    /// Name of the command, as it is typed.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Check(_) => "check",
            Self::Emit(_) => "emit",
            Self::Adjust(_) => "adjust",
            Self::Watch(_) => "watch",
            Self::Texts(_) => "texts",
            Self::View(_) => "view",
            Self::Sheet(_) => "sheet",
            Self::Diff(_) => "diff",
            Self::Import(_) => "import",
            Self::Verify(_) => "verify",
            Self::Post(_) => "post",
            Self::Graph(_) => "graph",
            Self::Deps(_) => "deps",
            Self::Rdeps(_) => "rdeps",
            Self::List(_) => "list",
            Self::Stats(_) => "stats",
            Self::Where(_) => "where",
            Self::Why(_) => "why",
            Self::QProject(_) => "q-project",
            Self::Cache(_) => "cache",
            Self::Explain(_) => "explain",
            Self::Init(_) => "init",
            Self::Config(_) => "config",
            Self::Machine(_) => "machine",
            Self::Completions(_) => "completions",
            Self::Man => "man",
            Self::Compat(_) => "compat",
        }
    }
}

impl Cli {
    /// Parses a command line that begins with the program's own name.
    ///
    /// # Errors
    /// A usage error, or a request for help or the version, which clap also treats as an error.
    pub fn read(arguments: &[OsString]) -> Result<Self, Error> {
        if let Some(read) = Self::read_command(arguments) {
            return Ok(read);
        }
        let matches = Self::matches(&Self::command(), arguments)?;
        Self::from_arg_matches(&matches).map_err(|error| error.format(&mut Self::command()))
    }

    /// Parses a command line with the given definition. A drawing in place of a command is checked. Errors are in the language of the definition.
    ///
    /// # Errors
    /// A usage error, or a request for help or the version, which clap also treats as an error.
    pub fn matches(definition: &Definition, arguments: &[OsString]) -> Result<ArgMatches, Error> {
        let read = |arguments: &[OsString]| definition.clone().try_get_matches_from(arguments);
        read(arguments).or_else(|error| match insert_check_command(&error, arguments) {
            Some(arguments) => read(&arguments),
            None => Err(error),
        })
    }

    /// Returns the language requested by a command line, even if the command line has errors.
    pub fn lang(arguments: &[OsString]) -> Option<LangArg> {
        let texts: Vec<&str> = arguments.iter().filter_map(|argument| argument.to_str()).collect();
        let apart = texts.windows(2).filter(|pair| pair[0] == "--lang").map(|pair| pair[1]);
        let joined = texts.iter().filter_map(|text| text.strip_prefix("--lang="));
        apart.chain(joined).find_map(|name| LangArg::from_str(name, false).ok())
    }

    /// Fast path for a command line that begins with a command and has no errors. It defines only that command, because every command gets
    /// its own copy of the common options, and defining all of them takes a quarter of the time of a short run.
    fn read_command(arguments: &[OsString]) -> Option<Self> {
        let commands = Command::augment_subcommands(Definition::new("pathbuild"));
        let command = commands.find_subcommand(arguments.get(1)?)?.clone();
        let line = CommonArgs::augment_args(Definition::new("pathbuild")).subcommand(command);
        Self::from_arg_matches(&line.try_get_matches_from(arguments).ok()?).ok()
    }
}

/// Inserts `check` if a drawing is given in place of a command; `None` otherwise.
fn insert_check_command(error: &Error, arguments: &[OsString]) -> Option<Vec<OsString>> {
    let named = error.get(ContextKind::InvalidSubcommand);
    let (ErrorKind::InvalidSubcommand, Some(ContextValue::String(named))) = (error.kind(), named) else {
        return None;
    };
    Utf8Path::new(named).extension().filter(|extension| extension.eq_ignore_ascii_case("dxf"))?;
    let place = arguments.iter().position(|argument| argument == named.as_str())?;
    let (before, after) = arguments.split_at(place);
    Some([before, &["check".into()], after].concat())
}

/// All help texts, in English and German.
pub(crate) const GERMAN: [&[(&str, &str)]; 3] = [COMMANDS, commands::GERMAN, shared::GERMAN];

german! {
    /// Help of the program and of its commands, each text in English and German.
    COMMANDS:
    "Compiles drawings of milling paths to G-code", "Übersetzt Zeichnungen von Fräspfaden in G-Code";
    "Exit status: 0 nothing wrong (warnings allowed), 1 errors found, 2 wrong usage or configuration.",
        "Exit-Status: 0 ohne Fehler (Warnungen sind erlaubt), 1 Fehler gefunden, 2 falscher Aufruf oder falsche Konfiguration.";
    "Check every path of the given drawings, paths or directories; without arguments the library. Writes no programs",
        "Prüft jeden Pfad der genannten Zeichnungen, Pfade oder Verzeichnisse; ohne Angaben die Bibliothek. Schreibt keine Programme";
    "Write the files of one or more paths; without arguments those of `[emit] targets`",
        "Schreibt die Dateien eines oder mehrerer Pfade; ohne Angaben die von `[emit] targets`";
    "Put measured heights into a program: `DRAWING_Clean.gcode` and `DRAWING_Z.txt` become `DRAWING_Milling.gcode`",
        "Setzt gemessene Höhen in ein Programm ein: aus `ZEICHNUNG_Clean.gcode` und `ZEICHNUNG_Z.txt` wird `ZEICHNUNG_Milling.gcode`";
    "Check again whenever a drawing changes", "Prüft erneut, sobald sich eine Zeichnung ändert";
    "Show which element each parameter text belongs to", "Zeigt, zu welchem Element jeder Parametertext gehört";
    "Show a path, a drawing or a program: in the browser, or as SVG, PNG, PDF, HTML or JSON",
        "Zeigt einen Pfad, eine Zeichnung oder ein Programm: im Browser oder als SVG, PNG, PDF, HTML oder JSON";
    "Make a path's setup sheet for the machine operator: PDF, HTML or SVG, or in the browser",
        "Erstellt das Einrichteblatt eines Pfads für die Maschine: PDF, HTML oder SVG, oder im Browser";
    "Show how changed drawings change the moves: between directories, Git revisions, or a program and a path",
        "Zeigt, wie geänderte Zeichnungen die Bewegungen ändern: zwischen Verzeichnissen, Git-Revisionen oder einem Programm und einem Pfad";
    "Read a G-code program and print what it does: moves, depths, feeds, times",
        "Liest ein G-Code-Programm und gibt aus, was es tut: Bewegungen, Tiefen, Vorschübe, Zeiten";
    "Check a G-code program", "Prüft ein G-Code-Programm";
    "Write a G-code program for another machine", "Schreibt ein G-Code-Programm für eine andere Maschine";
    "Show which path embeds which, with the values of variables", "Zeigt, welcher Pfad welchen einbettet, mit den Werten der Variablen";
    "Show which paths a path embeds", "Zeigt, welche Pfade ein Pfad einbettet";
    "Show which paths embed a path", "Zeigt, welche Pfade einen Pfad einbetten";
    "List paths with drawing, M, T, O, size, length, minutes and state; without arguments those of the library",
        "Listet Pfade mit Zeichnung, M, T, O, Größe, Länge, Minuten und Zustand auf; ohne Angaben die der Bibliothek";
    "Count the paths by material, cutter and state", "Zählt die Pfade nach Material, Fräser und Zustand";
    "Show where a path is defined", "Zeigt, wo ein Pfad gezeichnet ist";
    "Show why drawings would be compiled again: what has changed since the last `check` of the library",
        "Zeigt, warum Zeichnungen neu übersetzt würden: was sich seit dem letzten `check` der Bibliothek geändert hat";
    "Write a Q-project: a drawing that embeds every path of another",
        "Schreibt ein Q-Projekt: eine Zeichnung, die jeden Pfad einer anderen einbettet";
    "Manage the results cached between runs", "Verwaltet die zwischen Läufen gespeicherten Ergebnisse";
    "Explain the codes of messages; without a code list all of them", "Erklärt die Codes der Meldungen; ohne Code werden alle aufgelistet";
    "Write a commented pathbuild.toml into the working directory", "Schreibt eine kommentierte pathbuild.toml ins Arbeitsverzeichnis";
    "Show the configuration", "Zeigt die Konfiguration";
    "Import machine settings from a controller, and tools from a CAM program",
        "Übernimmt Maschinendaten und Werkzeuge aus Steuerung oder CAM-Programm";
    "Print a completion script for a shell", "Gibt ein Skript aus, mit dem eine Shell Eingaben ergänzt";
    "Print the manual page", "Gibt die Handbuchseite (man) aus";
    "Run a command line of `PathDxf2GCode` or `PathGCodeAdjustZ`",
        "Führt eine Befehlszeile von `PathDxf2GCode` oder `PathGCodeAdjustZ` aus";
}
