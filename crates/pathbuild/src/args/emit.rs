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
    /// Write nothing: is what lies on disk current?
    #[arg(long)]
    pub check: bool,
    /// With --check: compare the moves only
    #[arg(long, requires = "check")]
    pub moves: bool,
    /// Overwrite measured values in _Z.txt
    #[arg(long)]
    pub force: bool,
    /// Write for this post-processor: a built-in name or a file
    #[arg(long, value_name = "POST", add = completion::posts())]
    pub post: Option<String>,
    /// Make one program of several paths, in their order, with tool changes where O differs
    #[arg(long, value_name = "NAME")]
    pub join: Option<String>,
    /// Write what the files were made from, for make and ninja
    #[arg(long, value_name = "FILE", conflicts_with = "check")]
    pub deps: Option<Utf8PathBuf>,
    /// Write to standard output: `-o -`
    #[arg(short, long, value_name = "-", value_parser = ["-"], hide_possible_values = true)]
    #[arg(conflicts_with_all = ["check", "deps", "remove_stale"])]
    pub output: Option<String>,
    /// Remove G-code that pathbuild wrote earlier and nothing would write now
    #[arg(long, conflicts_with = "check")]
    pub remove_stale: bool,
    /// Dialect in which the post's output is checked and read back, where the post names none
    #[arg(long, value_name = "DIALECT", add = completion::dialects())]
    pub dialect: Option<String>,
    /// Date that the post may write
    #[arg(long, value_name = "DATE")]
    pub date: Option<String>,
    /// Run the command that the post names
    #[arg(long, conflicts_with_all = ["check", "output"])]
    pub run_post_build: bool,
}

/// `pathbuild adjust`
#[derive(Clone, Debug, Args)]
pub struct AdjustArgs {
    /// DRAWING.dxf, `DRAWING_Clean.gcode`, `DRAWING_Z.txt` or DRAWING
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<Utf8PathBuf>,
    /// Largest difference between a measured and a drawn height
    #[arg(long, value_name = "MM", required = true, allow_hyphen_values = true)]
    pub max_correction: String,
    /// Print the lines of _Clean.gcode that match
    #[arg(long, value_name = "REGEX", allow_hyphen_values = true)]
    pub show: Option<String>,
    /// Take values that `DRAWING_Z.txt` lacks from a sender's log, `[PRB:X,Y,Z:1]` for each probe in order
    #[arg(long, value_name = "FILE")]
    pub log: Option<Utf8PathBuf>,
}
