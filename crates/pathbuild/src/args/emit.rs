use camino::Utf8PathBuf;
use clap::Args;

use super::InputArgs;
use crate::completion;

/// `pathbuild emit`
#[derive(Clone, Debug, Default, Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of its own on the command line")]
pub struct EmitArgs {
    /// What to write.
    #[command(flatten)]
    pub inputs: InputArgs,
    /// Write nothing; report the files on disk that are out of date
    #[arg(long)]
    pub check: bool,
    /// With --check: compare only the moves
    #[arg(long, requires = "check")]
    pub moves: bool,
    /// Overwrite measured values in _Z.txt
    #[arg(long)]
    pub force: bool,
    /// Write for this post-processor: a built-in name or a file
    #[arg(long, value_name = "POST", add = completion::posts())]
    pub post: Option<String>,
    /// Join the paths, in this order, into one program called NAME, with a tool change wherever O differs
    #[arg(long, value_name = "NAME")]
    pub join: Option<String>,
    /// Write the dependencies of the files into FILE, for make and Ninja
    #[arg(long, value_name = "FILE")]
    pub deps: Option<Utf8PathBuf>,
    /// Write the program to standard output: `-o -`
    #[arg(short, long, value_name = "-", value_parser = ["-"], hide_possible_values = true)]
    #[arg(conflicts_with_all = ["check", "deps", "remove_stale"])]
    pub output: Option<String>,
    /// Remove programs that pathbuild wrote earlier and would no longer write
    #[arg(long, conflicts_with = "check")]
    pub remove_stale: bool,
    /// G-code dialect for checking the post's output, if the post names none
    #[arg(long, value_name = "DIALECT", add = completion::dialects())]
    pub dialect: Option<String>,
    /// Date for posts that write one
    #[arg(long, value_name = "DATE")]
    pub date: Option<String>,
    /// After writing, run the command that the post names
    #[arg(long, conflicts_with_all = ["check", "output"])]
    pub run_post_build: bool,
}

/// `pathbuild adjust`
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
