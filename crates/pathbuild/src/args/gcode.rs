use camino::Utf8PathBuf;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Subcommand, ValueEnum};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_workspace::Inputs;

use crate::completion;

/// How programs are read.
#[derive(Clone, Debug, Default, Args)]
pub struct ReadingArgs {
    /// G-code dialect: native, rs274, linuxcnc, grbl, xpertmill, mach3, fanuc, haas, marlin, estlcam or din; without it pathbuild guesses
    #[arg(long, value_name = "DIALECT", value_parser = dialects(), hide_possible_values = true)]
    pub dialect: Option<Dialect>,
    /// `XpertMILL`: din: G70 means inches and G71 millimetres; table: the other way round
    #[arg(long, value_name = "din|table", value_enum, hide_possible_values = true)]
    pub unit_codes: Option<UnitCodesArg>,
    /// `XpertMILL`: I and J are the arc's centre itself, not its distance from the arc's start
    #[arg(long)]
    pub absolute_arc_centres: bool,
    /// `XpertMILL`: ignore F and use the feeds of the layers
    #[arg(long)]
    pub ignore_feed: bool,
}

/// What G70 and G71 mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum UnitCodesArg {
    /// G70 inches, G71 millimetres.
    Din,
    /// The other way round.
    Table,
}

fn dialects() -> impl TypedValueParser<Value = Dialect> {
    let names = Dialect::ALL.iter().map(|dialect| dialect.name());
    PossibleValuesParser::new(names).try_map(|name| name.parse::<Dialect>().map_err(|()| "unknown dialect"))
}

/// `pathbuild import`
#[derive(Clone, Debug, Args)]
pub struct ImportArgs {
    /// G-code programs
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<Utf8PathBuf>,
    /// How they are read.
    #[command(flatten)]
    pub reading: ReadingArgs,
}

/// `pathbuild verify`
#[derive(Clone, Debug, Args)]
pub struct VerifyArgs {
    /// G-code programs
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<Utf8PathBuf>,
    /// Compare with the drawing of this path, which also gives the cutter and the material
    #[arg(long, value_name = "PATH", add = completion::paths())]
    pub against: Option<String>,
    /// Diameter of the cutter; without it from T and `[tool.NAME]`
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    pub cutter: Option<String>,
    /// Height of the material's upper face; programs by pathbuild contain it
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    pub surface: Option<String>,
    /// Post-processor that wrote the programs: sets the known words and the dialect
    #[arg(long, value_name = "POST", add = completion::posts())]
    pub post: Option<String>,
    /// How they are read.
    #[command(flatten)]
    pub reading: ReadingArgs,
}

impl VerifyArgs {
    /// The programs, followed by the path, whose configuration applies to programs outside its tree.
    pub(super) fn inputs(&self) -> Inputs {
        let mut inputs = Inputs::places(&self.files);
        inputs.inputs.extend(self.against.clone());
        inputs
    }
}

/// `pathbuild post`
#[derive(Clone, Debug, Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct PostArgs {
    /// Post-processors instead of programs.
    #[command(subcommand)]
    pub command: Option<PostCommand>,
    /// G-code program
    #[arg(value_name = "FILE", required = true)]
    pub file: Option<Utf8PathBuf>,
    /// Post-processor: a built-in name or a file
    #[arg(long, value_name = "POST", required = true, add = completion::posts())]
    pub post: Option<String>,
    /// File to write; without it standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<Utf8PathBuf>,
    /// Height of the material's upper face, for posts that need it; programs by pathbuild contain it
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    pub surface: Option<String>,
    /// G-code dialect for checking the post's output, if the post names none
    #[arg(long, value_name = "DIALECT", add = completion::dialects())]
    pub target: Option<String>,
    /// Date for posts that write one
    #[arg(long, value_name = "DATE")]
    pub date: Option<String>,
    /// After writing, run the command that the post names
    #[arg(long, requires = "output")]
    pub run_post_build: bool,
    /// How the program is read.
    #[command(flatten)]
    pub reading: ReadingArgs,
}

/// What can be asked about post-processors.
#[derive(Clone, Debug, Subcommand)]
pub enum PostCommand {
    /// List the built-in posts
    List,
    /// Print a built-in post's definition
    Show {
        /// Name of a built-in post
        #[arg(add = completion::posts())]
        name: String,
    },
}
