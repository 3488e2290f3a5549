use camino::Utf8PathBuf;
use clap::{Args, Subcommand};

/// `pathbuild import`
#[derive(Clone, Debug, Args)]
pub struct ImportArgs {
    /// G-code program
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<Utf8PathBuf>,
    /// rs274, linuxcnc, grbl, xpertmill or native; else guessed
    #[arg(long, value_name = "DIALECT")]
    pub dialect: Option<String>,
}

/// `pathbuild verify`
#[derive(Clone, Debug, Args)]
pub struct VerifyArgs {
    /// G-code program
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<Utf8PathBuf>,
    /// rs274, linuxcnc, grbl, xpertmill or native; else guessed
    #[arg(long, value_name = "DIALECT")]
    pub dialect: Option<String>,
    /// Compare with what this path's drawing says
    #[arg(long, value_name = "PATH")]
    pub against: Option<String>,
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
    /// A built-in name or a file
    #[arg(long, value_name = "POST", required = true)]
    pub post: Option<String>,
    /// Dialect of the program; else guessed
    #[arg(long, value_name = "DIALECT")]
    pub dialect: Option<String>,
    /// File to write; else standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<Utf8PathBuf>,
}

/// What can be asked about post-processors.
#[derive(Clone, Debug, Subcommand)]
pub enum PostCommand {
    /// List the built-in posts
    List,
    /// Print a built-in post's definition
    Show {
        /// Name of a built-in post
        name: String,
    },
}
