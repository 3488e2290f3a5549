//! The arguments of each command.

use camino::Utf8PathBuf;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, Subcommand};
use clap_complete::env::Shells;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::UnitCodes;
use pathbuild_workspace::Inputs;
use pathbuild_workspace::config::types::Requirement;
use pathbuild_workspace::machine::LengthUnit;
use pathbuild_workspace::program::ReadingOptions;
use pathbuild_workspace::waivers::Date;

use super::completions;
use super::shared::{Address, InputArgs, WaiverArgs, date, named_file};

/// Arguments of `pathbuild check`.
#[derive(Clone, Debug, Default, Args)]
pub struct CheckArgs {
    /// Drawings, paths and directories to check.
    #[command(flatten)]
    pub inputs: InputArgs,
    /// Check every combination of the variables' values, not one example of each
    #[arg(long)]
    pub all_bindings: bool,
    /// Exit with 1 on warnings too
    #[arg(long)]
    pub error_on_warning: bool,
    /// Options for accepted findings.
    #[command(flatten)]
    pub waivers: WaiverArgs,
    /// Check only what depends on files changed since this Git revision
    #[arg(long, value_name = "REV")]
    pub changed_since: Option<String>,
    /// Show how long each stage took
    #[arg(long)]
    pub timings: bool,
    /// Show at most N errors; the last lines count all of them
    #[arg(long, value_name = "N")]
    pub max_errors: Option<usize>,
    /// Write a picture of each finding into this directory: a detail of the drawing with the place circled
    #[arg(long, value_name = "DIR")]
    pub pictures: Option<Utf8PathBuf>,
}

/// Arguments of `pathbuild emit`.
#[derive(Clone, Debug, Default, Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of its own on the command line")]
pub struct EmitArgs {
    /// Drawings, paths and directories for which programs are written.
    #[command(flatten)]
    pub inputs: InputArgs,
    /// Write nothing; report the files that are missing or out of date
    #[arg(long)]
    pub check: bool,
    /// With --check: compare only the moves
    #[arg(long, requires = "check")]
    pub moves: bool,
    /// Overwrite measured values in _Z.txt
    #[arg(long)]
    pub force: bool,
    /// Write for this post-processor: a built-in name or a file
    #[arg(long, value_name = "POST", add = completions::posts())]
    pub post: Option<String>,
    /// Join the paths, in this order, into one program called NAME, with a tool change wherever O differs
    #[arg(long, value_name = "NAME")]
    pub join: Option<String>,
    /// Write the dependencies of the files into FILE, for make and Ninja
    #[arg(long, value_name = "FILE", value_parser = named_file)]
    pub deps: Option<Utf8PathBuf>,
    /// Write the program to standard output: `-o -`
    #[arg(short, long, value_name = "-", value_parser = ["-"], hide_possible_values = true)]
    #[arg(conflicts_with_all = ["check", "deps", "remove_stale"])]
    pub output: Option<String>,
    /// Remove programs that pathbuild wrote earlier and would no longer write
    #[arg(long, conflicts_with = "check")]
    pub remove_stale: bool,
    /// G-code dialect for checking the post's output, in place of the one that the post names
    #[arg(long, value_name = "DIALECT", add = completions::dialects())]
    pub dialect: Option<String>,
    /// Date for posts that write one, and for waivers that end
    #[arg(long, value_name = "DATE", value_parser = date)]
    pub date: Option<Date>,
    /// After writing, run the command that the post names
    #[arg(long, conflicts_with_all = ["check", "output"])]
    pub run_post_build: bool,
}

/// Arguments of `pathbuild adjust`.
#[derive(Clone, Debug, Args)]
pub struct AdjustArgs {
    /// DRAWING.dxf, `DRAWING_Clean.gcode`, `DRAWING_Z.txt` or DRAWING
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<Utf8PathBuf>,
    /// Largest allowed difference between a measured and a drawn height
    #[arg(long, value_name = "MM", required = true, allow_hyphen_values = true)]
    pub max_correction: String,
    /// Print the lines of `DRAWING_Clean.gcode` that match
    #[arg(long, value_name = "REGEX", allow_hyphen_values = true)]
    pub show: Option<String>,
    /// Take values that are missing in `DRAWING_Z.txt` from a sender's log, one `[PRB:X,Y,Z:1]` for each probe, in order
    #[arg(long, value_name = "FILE")]
    pub log: Option<Utf8PathBuf>,
}

/// Arguments of `pathbuild watch`.
#[derive(Clone, Debug, Default, Args)]
pub struct WatchArgs {
    /// Drawings, paths and directories to watch.
    #[command(flatten)]
    pub inputs: InputArgs,
    /// Write the files of `[emit] targets` as well
    #[arg(long)]
    pub emit: bool,
    /// Options of the live page.
    #[command(flatten)]
    pub serving: ServeArgs,
    /// Look for changes at intervals (for network drives)
    #[arg(long)]
    pub poll: bool,
}

/// Options of the page that `pathbuild watch` serves.
#[derive(Clone, Debug, Default, Args)]
pub struct ServeArgs {
    /// Show the library as a page that stays up to date: on this computer at port 8347, or at ADDR (PORT, IP, IP:PORT or NAME:PORT)
    #[arg(long, value_name = "ADDR", num_args = 0..=1, default_missing_value = "127.0.0.1", value_parser = Address::parse)]
    pub serve: Option<Address>,
    /// With --serve: show the page in the browser
    #[arg(long, requires = "serve")]
    pub open: bool,
    /// With --serve: end when the page has been closed
    #[arg(long, requires = "serve")]
    pub until_closed: bool,
}

/// Arguments of `pathbuild graph`, `deps`, `rdeps`, `where` and `why`. For `graph`, `--format` also accepts dot and mermaid.
#[derive(Clone, Debug, Default, Args)]
pub struct GraphArgs {
    /// Drawings, paths and directories that the command shows.
    #[command(flatten)]
    pub inputs: InputArgs,
}

/// Arguments of `pathbuild list` and `stats`.
#[derive(Clone, Debug, Default, Args)]
pub struct ListArgs {
    /// Patterns of path names (8*, 20[0-5]?.1P), drawings (.dxf), directories; without drawings or directories the library
    #[arg(value_name = "GLOB|DRAWING|DIRECTORY", add = completions::paths())]
    pub inputs: Vec<String>,
    /// Compare with programs written for this post-processor: a built-in name or a file
    #[arg(long, value_name = "POST", add = completions::posts())]
    pub post: Option<String>,
}

impl ListArgs {
    /// Returns the arguments as inputs of a request.
    pub fn inputs(&self) -> Inputs {
        Inputs { inputs: self.inputs.clone() }
    }
}

/// Options for reading G-code programs.
#[derive(Clone, Debug, Default, Args)]
pub struct ReadingArgs {
    /// G-code dialect: native, rs274, linuxcnc, grbl, xpertmill, mach3, fanuc, haas, marlin, estlcam or din; without it pathbuild guesses
    #[arg(long, value_name = "DIALECT", value_parser = dialects(), hide_possible_values = true)]
    pub dialect: Option<Dialect>,
    /// `XpertMILL`: din: G70 means inches and G71 millimetres; table: the other way round
    #[arg(long, value_name = "din|table", value_parser = unit_codes(), hide_possible_values = true)]
    pub unit_codes: Option<UnitCodes>,
    /// `XpertMILL`: I and J are the arc's centre itself, not its distance from the arc's start
    #[arg(long)]
    pub absolute_arc_centres: bool,
    /// `XpertMILL`: ignore F and use the feeds of the layers
    #[arg(long)]
    pub ignore_feed: bool,
}

impl ReadingArgs {
    /// Converts the options to the workspace's options for reading.
    pub fn options(&self) -> ReadingOptions {
        ReadingOptions {
            dialect: self.dialect,
            unit_codes: self.unit_codes.unwrap_or_default(),
            absolute_arc_centres: self.absolute_arc_centres,
            ignore_feed: self.ignore_feed,
        }
    }
}

fn unit_codes() -> impl TypedValueParser<Value = UnitCodes> {
    let values = [("din", "G70 inches, G71 millimetres"), ("table", "The other way round")];
    PossibleValuesParser::new(values.map(|(name, help)| PossibleValue::new(name).help(help)))
        .map(|name| if name == "table" { UnitCodes::Table } else { UnitCodes::Din })
}

fn length_units() -> impl TypedValueParser<Value = LengthUnit> {
    PossibleValuesParser::new(["mm", "inch"])
        .map(|name| if name == "inch" { LengthUnit::Inch } else { LengthUnit::Millimetre })
}

fn requirements() -> impl TypedValueParser<Value = Requirement> {
    PossibleValuesParser::new(Requirement::names())
        .map(|name| Requirement::named(&name).unwrap_or(Requirement::Rapids))
}

fn dialects() -> impl TypedValueParser<Value = Dialect> {
    let names = Dialect::ALL.iter().map(|dialect| dialect.name());
    PossibleValuesParser::new(names).try_map(|name| name.parse::<Dialect>().map_err(|()| "unknown dialect"))
}

/// Arguments of `pathbuild import`.
#[derive(Clone, Debug, Args)]
pub struct ImportArgs {
    /// G-code programs
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<Utf8PathBuf>,
    /// Options for reading the programs.
    #[command(flatten)]
    pub reading: ReadingArgs,
}

/// Arguments of `pathbuild verify`.
#[derive(Clone, Debug, Args)]
pub struct VerifyArgs {
    /// G-code programs, directories with programs, or - for standard input
    #[arg(value_name = "FILE|DIRECTORY", required = true)]
    pub files: Vec<Utf8PathBuf>,
    /// Compare with the drawing of this path, which also gives the cutter and the material
    #[arg(long, value_name = "PATH", add = completions::paths())]
    pub against: Option<String>,
    /// Diameter of the cutter; without it from T and `[tool.NAME]`, or from comments
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    pub cutter: Option<String>,
    /// Height of the material's upper face; programs by pathbuild contain it
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    pub surface: Option<String>,
    /// Fail unless these checks were made, separated by commas: rapids (or rapids=assumed), envelope, feeds, spindle, drawing, clamps, corners, coolant
    #[arg(long, value_name = "CHECKS", value_delimiter = ',', value_parser = requirements(), hide_possible_values = true)]
    pub require: Vec<Requirement>,
    /// Post-processor that wrote the programs: sets the known words and the dialect
    #[arg(long, value_name = "POST", add = completions::posts())]
    pub post: Option<String>,
    /// Options for accepted findings.
    #[command(flatten)]
    pub waivers: WaiverArgs,
    /// Options for reading the programs.
    #[command(flatten)]
    pub reading: ReadingArgs,
}

impl VerifyArgs {
    /// Returns the programs, followed by the path of `--against`, whose configuration also applies to programs outside of its tree.
    pub(super) fn inputs(&self) -> Inputs {
        let mut inputs = Inputs::of_files(self.files.iter().filter(|file| *file != "-"));
        inputs.inputs.extend(self.against.clone());
        inputs
    }
}

/// Arguments of `pathbuild post`.
#[derive(Clone, Debug, Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct PostArgs {
    /// Subcommand about the built-in posts, in place of a program.
    #[command(subcommand)]
    pub command: Option<PostCommand>,
    /// G-code program
    #[arg(value_name = "FILE", required = true)]
    pub file: Option<Utf8PathBuf>,
    /// Post-processor: a built-in name or a file
    #[arg(long, value_name = "POST", required = true, add = completions::posts())]
    pub post: Option<String>,
    /// Write to this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<Utf8PathBuf>,
    /// Height of the material's upper face, for rapid moves and for posts that need it; programs by pathbuild contain it
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    pub surface: Option<String>,
    /// G-code dialect for checking the post's output, in place of the one that the post names
    #[arg(long, value_name = "DIALECT", add = completions::dialects())]
    pub target: Option<String>,
    /// Date for posts that write one, and for waivers that end
    #[arg(long, value_name = "DATE", value_parser = date)]
    pub date: Option<Date>,
    /// After writing, run the command that the post names
    #[arg(long, requires = "output")]
    pub run_post_build: bool,
    /// Options for reading the program.
    #[command(flatten)]
    pub reading: ReadingArgs,
}

/// Subcommands of `post`.
#[derive(Clone, Debug, Subcommand)]
pub enum PostCommand {
    /// List the built-in posts
    List,
    /// Print a built-in post's definition
    Show {
        /// Name of a built-in post
        #[arg(add = completions::posts())]
        name: String,
    },
}

/// Arguments of `pathbuild texts`.
#[derive(Clone, Debug, Default, Args)]
pub struct TextsArgs {
    /// Drawings with the texts to list.
    #[command(flatten)]
    pub inputs: InputArgs,
    /// Show only texts that match
    #[arg(long = "match", value_name = "REGEX")]
    pub pattern: Option<String>,
}

/// Arguments of `pathbuild view`.
#[derive(Clone, Debug, Args)]
pub struct ViewArgs {
    /// Name of a path, drawing (.dxf), or G-code program
    #[arg(value_name = "PATH|DRAWING|FILE", add = completions::paths())]
    pub what: String,
    /// Write a file (.svg, .png, .pdf, .html or .json, the scene as data) instead of showing the picture in the browser
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<Utf8PathBuf>,
    /// Show the stock when all moves are done, from above, in a file .svg, .png or .pdf
    #[arg(long, requires = "output")]
    pub stock: bool,
    /// Diameter of a program's cutter; without it from T and `[tool.NAME]`, or from comments
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    pub cutter: Option<String>,
    /// Height of a program's material; programs by pathbuild contain it
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    pub surface: Option<String>,
    /// Options for reading a program.
    #[command(flatten)]
    pub reading: ReadingArgs,
}

impl ViewArgs {
    /// Returns the first given option that applies only to programs.
    pub fn program_option(&self) -> Option<&'static str> {
        let ReadingArgs { dialect, unit_codes, absolute_arc_centres, ignore_feed } = &self.reading;
        let options = [
            ("--cutter", self.cutter.is_some()),
            ("--surface", self.surface.is_some()),
            ("--dialect", dialect.is_some()),
            ("--unit-codes", unit_codes.is_some()),
            ("--absolute-arc-centres", *absolute_arc_centres),
            ("--ignore-feed", *ignore_feed),
        ];
        options.into_iter().find_map(|(name, is_given)| is_given.then_some(name))
    }
}

/// Arguments of `pathbuild sheet`.
#[derive(Clone, Debug, Args)]
pub struct SheetArgs {
    /// Name of a path, or drawing (.dxf) with one path
    #[arg(value_name = "PATH|DRAWING", add = completions::paths())]
    pub what: String,
    /// Write a file (.pdf, .html or .svg) instead of showing the setup sheet in the browser
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<Utf8PathBuf>,
    /// Write for this post-processor: a built-in name or a file
    #[arg(long, value_name = "POST", add = completions::posts())]
    pub post: Option<String>,
}

/// Arguments of `pathbuild diff`.
#[derive(Clone, Debug, Args)]
pub struct DiffArgs {
    /// Before the change: a directory, a drawing, a Git revision, or a G-code program
    #[arg(value_name = "OLD")]
    pub old: String,
    /// After the change: the same, or a path if OLD is a program (default: working directory)
    #[arg(value_name = "NEW")]
    pub new: Option<String>,
    /// Also write a file: .html (with pictures) or .md (for a pull request)
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<Utf8PathBuf>,
    /// Options for reading programs.
    #[command(flatten)]
    pub reading: ReadingArgs,
}

/// Arguments of `pathbuild q-project`.
#[derive(Clone, Debug, Args)]
pub struct QProjectArgs {
    /// Drawing to embed
    #[arg(value_name = "DRAWING")]
    pub drawing: String,
    /// Name of the Q-project's path; without it the drawing's first number with .0Q
    #[arg(long, value_name = "NAME")]
    pub path_name: Option<String>,
    /// Write to this file instead of `DRAWING_Q.dxf`
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<Utf8PathBuf>,
}

/// Arguments of `pathbuild cache`.
#[derive(Clone, Debug, Args)]
pub struct CacheArgs {
    /// Subcommand of `cache`.
    #[command(subcommand)]
    pub command: CacheCommand,
}

/// Subcommands of `cache`.
#[derive(Clone, Debug, Subcommand)]
pub enum CacheCommand {
    /// Print the directory of the cached results
    Dir,
    /// Print the size of the cached results
    Size,
    /// Remove cached results that are no longer used
    Prune,
    /// Remove all cached results
    Clean,
    /// Check every cached result for damage
    Verify,
}

/// Arguments of `pathbuild explain`.
#[derive(Clone, Debug, Default, Args)]
pub struct ExplainArgs {
    /// Code or name of a message: PB203, parameter-out-of-range
    #[arg(value_name = "CODE", add = completions::codes())]
    pub codes: Vec<String>,
}

/// Arguments of `pathbuild init`.
#[derive(Clone, Copy, Debug, Default, Args)]
pub struct InitArgs {
    /// Write a small library to learn on: a first drawing, two components, a project, templates for CAD programs
    #[arg(long)]
    pub example: bool,
}

/// Arguments of `pathbuild config`.
#[derive(Clone, Debug, Args)]
pub struct ConfigArgs {
    /// Subcommand of `config`.
    #[command(subcommand)]
    pub command: ConfigCommand,
}

/// Subcommands of `config`.
#[derive(Clone, Debug, Subcommand)]
pub enum ConfigCommand {
    /// Print the values in effect
    Show {
        /// Also say where each value comes from
        #[arg(long)]
        origin: bool,
        /// The configuration of these drawings, paths and directories is shown.
        #[command(flatten)]
        inputs: InputArgs,
    },
    /// Print the JSON schema of pathbuild.toml
    Schema,
}

/// Arguments of `pathbuild machine`.
#[derive(Clone, Debug, Args)]
pub struct MachineArgs {
    /// Subcommand of `machine`.
    #[command(subcommand)]
    pub command: MachineCommand,
}

/// Subcommands of `machine`.
#[derive(Clone, Debug, Subcommand)]
pub enum MachineCommand {
    /// Compare descriptions of the machine with `[machine]` and `[tool]`; with --write, copy their values there
    Import {
        /// The answer of GRBL or grblHAL to $$, `FluidNC`'s YAML, `LinuxCNC`'s ini file or tool table, tools of FreeCAD or Fusion 360
        #[arg(value_name = "FILE", required = true)]
        files: Vec<Utf8PathBuf>,
        /// Unit of the lengths in a tool table of `LinuxCNC`, if its ini file is not among the files
        #[arg(long, value_name = "UNIT", value_parser = length_units())]
        units: Option<LengthUnit>,
        /// Write the values into pathbuild.toml
        #[arg(long)]
        write: bool,
    },
}

/// Arguments of `pathbuild completions`.
#[derive(Clone, Debug, Args)]
pub struct CompletionsArgs {
    /// Shell to print the script for
    #[arg(value_name = "SHELL", value_parser = Shells::builtins().names().collect::<Vec<_>>())]
    pub shell: String,
}

/// Arguments of `pathbuild compat`.
#[derive(Clone, Debug, Default, Args)]
pub struct CompatArgs {
    /// Print the pathbuild command line instead of running it
    #[arg(long)]
    pub print: bool,
    /// Options and files as `PathDxf2GCode` or `PathGCodeAdjustZ` takes them
    #[arg(value_name = "ARGUMENT", trailing_var_arg = true, allow_hyphen_values = true)]
    pub arguments: Vec<String>,
}

german! {
    /// Help of the arguments of all commands, each text in English and German.
    pub(super) GERMAN:
    "List the built-in posts", "Listet die eingebauten Postprozessoren auf";
    "Print a built-in post's definition", "Gibt die Definition eines eingebauten Postprozessors aus";
    "Print the directory of the cached results", "Gibt das Verzeichnis der gespeicherten Ergebnisse aus";
    "Print the size of the cached results", "Gibt die Größe der gespeicherten Ergebnisse aus";
    "Remove cached results that are no longer used", "Löscht gespeicherte Ergebnisse, die nicht mehr gebraucht werden";
    "Remove all cached results", "Löscht alle gespeicherten Ergebnisse";
    "Check every cached result for damage", "Prüft jedes gespeicherte Ergebnis auf Schäden";
    "Print the values in effect", "Gibt die geltenden Werte aus";
    "Compare descriptions of the machine with `[machine]` and `[tool]`; with --write, copy their values there",
        "Vergleicht Beschreibungen der Maschine mit `[machine]` und `[tool]` und übernimmt sie mit --write";
    "The answer of GRBL or grblHAL to $$, `FluidNC`'s YAML, `LinuxCNC`'s ini file or tool table, tools of FreeCAD or Fusion 360",
        "Die Antwort von GRBL oder grblHAL auf $$, die YAML-Datei von `FluidNC`, ini-Datei oder Werkzeugtabelle von `LinuxCNC`, Werkzeuge von FreeCAD oder Fusion 360";
    "UNIT", "EINHEIT";
    "Unit of the lengths in a tool table of `LinuxCNC`, if its ini file is not among the files",
        "Einheit der Längen in einer Werkzeugtabelle von `LinuxCNC`, wenn deren ini-Datei nicht mit angegeben ist";
    "Write the values into pathbuild.toml", "Schreibt die Werte in die pathbuild.toml";
    "Print the JSON schema of pathbuild.toml", "Gibt das JSON-Schema von pathbuild.toml aus";
    "Patterns of path names (8*, 20[0-5]?.1P), drawings (.dxf), directories; without drawings or directories the library",
        "Muster von Pfadnamen (8*, 20[0-5]?.1P), Zeichnungen (.dxf), Verzeichnisse; ohne Zeichnungen und Verzeichnisse die Bibliothek";
    "DRAWING.dxf, `DRAWING_Clean.gcode`, `DRAWING_Z.txt` or DRAWING",
        "ZEICHNUNG.dxf, `ZEICHNUNG_Clean.gcode`, `ZEICHNUNG_Z.txt` oder ZEICHNUNG";
    "Name of a path, drawing (.dxf), or G-code program", "Name eines Pfads, Zeichnung (.dxf) oder G-Code-Programm";
    "Name of a path, or drawing (.dxf) with one path", "Name eines Pfads, oder Zeichnung (.dxf) mit einem Pfad";
    "Write a file (.pdf, .html or .svg) instead of showing the setup sheet in the browser",
        "Schreibt eine Datei (.pdf, .html oder .svg), statt das Einrichteblatt im Browser zu zeigen";
    "Before the change: a directory, a drawing, a Git revision, or a G-code program",
        "Vor der Änderung: ein Verzeichnis, eine Zeichnung, eine Git-Revision oder ein G-Code-Programm";
    "After the change: the same, or a path if OLD is a program (default: working directory)",
        "Nach der Änderung: ebenso, bei einem Programm auch ein Pfad; sonst das Arbeitsverzeichnis";
    "G-code programs", "G-Code-Programme";
    "G-code programs, directories with programs, or - for standard input",
        "G-Code-Programme, Verzeichnisse mit Programmen oder - für die Standardeingabe";
    "G-code program", "G-Code-Programm";
    "Name of a built-in post", "Name eines eingebauten Postprozessors";
    "Drawing to embed", "Zeichnung zum Einbetten";
    "Code or name of a message: PB203, parameter-out-of-range", "Code oder Name einer Meldung: PB203, parameter-out-of-range";
    "Shell to print the script for", "Shell, für die das Skript bestimmt ist";
    "Options and files as `PathDxf2GCode` or `PathGCodeAdjustZ` takes them",
        "Optionen und Dateien, wie `PathDxf2GCode` oder `PathGCodeAdjustZ` sie erwartet";
    "Check every combination of the variables' values, not one example of each",
        "Prüft jede Kombination der Werte von Variablen, nicht nur je ein Beispiel";
    "Exit with 1 on warnings too", "Endet auch bei Warnungen mit Exit-Status 1";
    "Check only what depends on files changed since this Git revision",
        "Prüft nur, was von Dateien abhängt, die seit dieser Git-Revision geändert wurden";
    "Show how long each stage took", "Zeigt, wie lange jede Stufe gedauert hat";
    "Show at most N errors; the last lines count all of them", "Zeigt höchstens N Fehler; die letzten Zeilen zählen alle";
    "Write a picture of each finding into this directory: a detail of the drawing with the place circled",
        "Schreibt zu jedem Befund ein Bild in dieses Verzeichnis: einen Ausschnitt der Zeichnung mit eingekreister Stelle";
    "Write nothing; report the files that are missing or out of date",
        "Schreibt nichts; meldet Dateien, die fehlen oder nicht aktuell sind";
    "With --check: compare only the moves", "Mit --check: vergleicht nur die Bewegungen";
    "Overwrite measured values in _Z.txt", "Überschreibt gemessene Werte in _Z.txt";
    "Write for this post-processor: a built-in name or a file", "Schreibt für diesen Postprozessor: ein eingebauter Name oder eine Datei";
    "Join the paths, in this order, into one program called NAME, with a tool change wherever O differs",
        "Fügt die Pfade in dieser Reihenfolge zu einem Programm NAME zusammen, mit Werkzeugwechsel, wo O ein anderes ist";
    "Write the dependencies of the files into FILE, for make and Ninja",
        "Schreibt die Abhängigkeiten der Dateien in DATEI, für make und Ninja";
    "Write the program to standard output: `-o -`", "Schreibt das Programm in die Standardausgabe: `-o -`";
    "Remove programs that pathbuild wrote earlier and would no longer write",
        "Löscht Programme, die pathbuild früher geschrieben hat und nicht mehr schreiben würde";
    "G-code dialect for checking the post's output, in place of the one that the post names",
        "G-Code-Dialekt, in dem die Ausgabe des Postprozessors geprüft wird, an Stelle dessen, den er nennt";
    "Date for posts that write one, and for waivers that end",
        "Datum für Postprozessoren, die eines schreiben, und für befristete Ausnahmen";
    "After writing, run the command that the post names", "Führt nach dem Schreiben den Befehl aus, den der Postprozessor nennt";
    "Post-processor: a built-in name or a file", "Postprozessor: ein eingebauter Name oder eine Datei";
    "Write to this file instead of standard output", "Schreibt in diese Datei statt in die Standardausgabe";
    "Height of the material's upper face, for rapid moves and for posts that need it; programs by pathbuild contain it",
        "Höhe der Materialoberfläche, für Eilgänge und für Postprozessoren, die sie brauchen; in Programmen von pathbuild steht sie";
    "Largest allowed difference between a measured and a drawn height",
        "Größte erlaubte Differenz zwischen gemessener und gezeichneter Höhe";
    "Print the lines of `DRAWING_Clean.gcode` that match", "Gibt die Zeilen von `ZEICHNUNG_Clean.gcode` aus, auf die REGEX passt";
    "Take values that are missing in `DRAWING_Z.txt` from a sender's log, one `[PRB:X,Y,Z:1]` for each probe, in order",
        "Nimmt Werte, die in `ZEICHNUNG_Z.txt` fehlen, aus dem Protokoll eines Sendeprogramms: je Z-Probe ein `[PRB:X,Y,Z:1]`, der Reihe nach";
    "Write the files of `[emit] targets` as well", "Schreibt auch die Dateien von `[emit] targets`";
    "Look for changes at intervals (for network drives)", "Sucht in festen Abständen nach Änderungen (für Netzlaufwerke)";
    "Show the library as a page that stays up to date: on this computer at port 8347, or at ADDR (PORT, IP, IP:PORT or NAME:PORT)",
        "Zeigt die Bibliothek als Seite, die sich selbst aktualisiert: auf diesem Rechner an Port 8347 oder an ADRESSE (PORT, IP, IP:PORT oder NAME:PORT)";
    "With --serve: show the page in the browser", "Mit --serve: zeigt die Seite im Browser";
    "With --serve: end when the page has been closed", "Mit --serve: endet, wenn die Seite geschlossen worden ist";
    "Show only texts that match", "Zeigt nur Texte, auf die REGEX passt";
    "Write a file (.svg, .png, .pdf, .html or .json, the scene as data) instead of showing the picture in the browser",
        "Schreibt eine Datei (.svg, .png, .pdf, .html oder .json, das Bild als Daten), statt das Bild im Browser zu zeigen";
    "Show the stock when all moves are done, from above, in a file .svg, .png or .pdf",
        "Zeigt das Rohteil nach allen Bewegungen von oben, in einer Datei .svg, .png oder .pdf";
    "Diameter of a program's cutter; without it from T and `[tool.NAME]`, or from comments",
        "Durchmesser des Fräsers eines Programms; sonst aus T und `[tool.NAME]` oder aus Kommentaren";
    "Height of a program's material; programs by pathbuild contain it",
        "Materialhöhe eines Programms; Programme von pathbuild enthalten sie";
    "Also write a file: .html (with pictures) or .md (for a pull request)",
        "Schreibt auch eine Datei: .html (mit Bildern) oder .md (für einen Pull-Request)";
    "Compare with the drawing of this path, which also gives the cutter and the material",
        "Vergleicht mit der Zeichnung dieses Pfads, die auch Fräser und Material angibt";
    "Diameter of the cutter; without it from T and `[tool.NAME]`, or from comments",
        "Durchmesser des Fräsers; sonst aus T und `[tool.NAME]` oder aus Kommentaren";
    "Fail unless these checks were made, separated by commas: rapids (or rapids=assumed), envelope, feeds, spindle, drawing, clamps, corners, coolant",
        "Scheitert, wenn eine dieser Prüfungen nicht möglich war, mit Kommas getrennt: rapids (oder rapids=assumed), envelope, feeds, spindle, drawing, clamps, corners, coolant";
    "Height of the material's upper face; programs by pathbuild contain it",
        "Höhe der Materialoberfläche; in Programmen von pathbuild steht sie";
    "Compare with programs written for this post-processor: a built-in name or a file",
        "Vergleicht mit Programmen für diesen Postprozessor: ein eingebauter Name oder eine Datei";
    "Name of the Q-project's path; without it the drawing's first number with .0Q",
        "Name des Q-Projekt-Pfads; sonst die erste Nummer der Zeichnung mit .0Q";
    "Write to this file instead of `DRAWING_Q.dxf`", "Schreibt in diese Datei statt in `ZEICHNUNG_Q.dxf`";
    "Write a small library to learn on: a first drawing, two components, a project, templates for CAD programs",
        "Schreibt eine kleine Bibliothek zum Lernen: eine erste Zeichnung, zwei Bauteile, ein Projekt, Vorlagen für CAD-Programme";
    "Also say where each value comes from", "Gibt auch an, woher jeder Wert kommt";
    "Print the pathbuild command line instead of running it", "Gibt die Befehlszeile von pathbuild aus, statt sie auszuführen";
    "Post-processor that wrote the programs: sets the known words and the dialect",
        "Postprozessor, der die Programme geschrieben hat: legt die bekannten Wörter und den Dialekt fest";
    "G-code dialect: native, rs274, linuxcnc, grbl, xpertmill, mach3, fanuc, haas, marlin, estlcam or din; without it pathbuild guesses",
        "G-Code-Dialekt: native, rs274, linuxcnc, grbl, xpertmill, mach3, fanuc, haas, marlin, estlcam oder din; sonst versucht pathbuild, ihn zu erkennen";
    "`XpertMILL`: din: G70 means inches and G71 millimetres; table: the other way round",
        "`XpertMILL`: din: G70 heißt Zoll und G71 Millimeter; table: umgekehrt";
    "`XpertMILL`: I and J are the arc's centre itself, not its distance from the arc's start",
        "`XpertMILL`: I und J sind der Bogenmittelpunkt selbst, nicht sein Abstand vom Bogenanfang";
    "`XpertMILL`: ignore F and use the feeds of the layers", "`XpertMILL`: ignoriert F und verwendet die Vorschübe der Layer";
    "G70 inches, G71 millimetres", "G70 Zoll, G71 Millimeter";
    "The other way round", "Umgekehrt";
    "FILE|DIRECTORY", "DATEI|VERZEICHNIS";
    "GLOB|DRAWING|DIRECTORY", "MUSTER|ZEICHNUNG|VERZEICHNIS";
    "PATH|DRAWING|FILE", "PFAD|ZEICHNUNG|DATEI";
    "PATH|DRAWING", "PFAD|ZEICHNUNG";
    "PATH", "PFAD";
    "DRAWING", "ZEICHNUNG";
    "FILE", "DATEI";
    "ADDR", "ADRESSE";
    "DIR", "VERZEICHNIS";
    "OLD", "ALT";
    "NEW", "NEU";
    "DATE", "DATUM";
    "DIALECT", "DIALEKT";
    "CHECKS", "PRÜFUNGEN";
    "CODE", "CODE";
    "NAME", "NAME";
    "POST", "POST";
    "REGEX", "REGEX";
    "REV", "REVISION";
    "SHELL", "SHELL";
    "ARGUMENT", "ARGUMENT";
    "N", "N";
    "MM", "MM";
    "-", "-";
    "din|table", "din|table";
    "unknown dialect", "unbekannter Dialekt";
}
