use camino::Utf8PathBuf;
use clap::{Args, Subcommand};
use clap_complete::env::Shells;

use super::{InputArgs, ReadingArgs};
use crate::completion;

/// `pathbuild texts`
#[derive(Clone, Debug, Default, Args)]
pub struct TextsArgs {
    /// Drawings whose texts are listed.
    #[command(flatten)]
    pub inputs: InputArgs,
    /// Show only texts that match
    #[arg(long = "match", value_name = "REGEX")]
    pub pattern: Option<String>,
}

/// `pathbuild view`
#[derive(Clone, Debug, Args)]
pub struct ViewArgs {
    /// Name of a path, drawing (.dxf), or G-code program
    #[arg(value_name = "PATH|DRAWING|FILE", add = completion::paths())]
    pub what: String,
    /// File to write: .svg, .png, .pdf, .html or .json (the scene as data); without it the browser shows the picture
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<Utf8PathBuf>,
    /// How a program is read.
    #[command(flatten)]
    pub reading: ReadingArgs,
}

/// `pathbuild sheet`
#[derive(Clone, Debug, Args)]
pub struct SheetArgs {
    /// Name of a path, or drawing (.dxf) with one path
    #[arg(value_name = "PATH|DRAWING", add = completion::paths())]
    pub what: String,
    /// File to write: .pdf, .html or .svg; without it the browser shows the setup sheet
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<Utf8PathBuf>,
    /// Write for this post-processor: a built-in name or a file
    #[arg(long, value_name = "POST", add = completion::posts())]
    pub post: Option<String>,
}

/// `pathbuild diff`
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
    /// How programs are read.
    #[command(flatten)]
    pub reading: ReadingArgs,
}

/// `pathbuild q-project`
#[derive(Clone, Debug, Args)]
pub struct QProjectArgs {
    /// Drawing to embed
    #[arg(value_name = "DRAWING")]
    pub drawing: Utf8PathBuf,
    /// Name of the Q-project's path; without it the drawing's first number with .0Q
    #[arg(long, value_name = "NAME")]
    pub path_name: Option<String>,
    /// File to write; without it `DRAWING_Q.dxf`
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<Utf8PathBuf>,
}

/// `pathbuild cache`
#[derive(Clone, Debug, Args)]
pub struct CacheArgs {
    /// What to do with it.
    #[command(subcommand)]
    pub command: CacheCommand,
}

/// What can be done with the cache.
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

/// `pathbuild explain`
#[derive(Clone, Debug, Default, Args)]
pub struct ExplainArgs {
    /// Code or name of a message: PB203, parameter-out-of-range
    #[arg(value_name = "CODE", add = completion::codes())]
    pub codes: Vec<String>,
}

/// `pathbuild init`
#[derive(Clone, Copy, Debug, Default, Args)]
pub struct InitArgs {
    /// Write a small library to learn on: a first drawing, two components, a project, templates for CAD programs
    #[arg(long)]
    pub example: bool,
}

/// `pathbuild config`
#[derive(Clone, Debug, Args)]
pub struct ConfigArgs {
    /// What to show.
    #[command(subcommand)]
    pub command: ConfigCommand,
}

/// What can be shown of the configuration.
#[derive(Clone, Debug, Subcommand)]
pub enum ConfigCommand {
    /// Print the values in force
    Show {
        /// Also say where each value comes from
        #[arg(long)]
        origin: bool,
        /// For which drawings.
        #[command(flatten)]
        inputs: InputArgs,
    },
    /// Print the JSON schema of pathbuild.toml
    Schema,
}

/// `pathbuild completions`
#[derive(Clone, Debug, Args)]
pub struct CompletionsArgs {
    /// Shell to print the script for
    #[arg(value_name = "SHELL", value_parser = Shells::builtins().names().collect::<Vec<_>>())]
    pub shell: String,
}

/// `pathbuild compat`
#[derive(Clone, Debug, Default, Args)]
pub struct CompatArgs {
    /// Print the pathbuild command line instead of running it
    #[arg(long)]
    pub print: bool,
    /// Options and files as `PathDxf2GCode` or `PathGCodeAdjustZ` takes them
    #[arg(value_name = "ARGUMENT", trailing_var_arg = true, allow_hyphen_values = true)]
    pub arguments: Vec<String>,
}
