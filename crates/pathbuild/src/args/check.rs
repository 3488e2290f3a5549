use camino::Utf8PathBuf;
use clap::Args;

use super::InputArgs;

/// `pathbuild check`
#[derive(Clone, Debug, Default, Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of its own on the command line")]
pub struct CheckArgs {
    /// What to check.
    #[command(flatten)]
    pub inputs: InputArgs,
    /// Check every combination of the variables' values, not one example of each
    #[arg(long)]
    pub all_bindings: bool,
    /// Exit with 1 on warnings too
    #[arg(long)]
    pub error_on_warning: bool,
    /// Report only findings that are not in this file
    #[arg(long, value_name = "FILE")]
    pub baseline: Option<Utf8PathBuf>,
    /// Write all findings into the baseline file instead of reporting them
    #[arg(long, requires = "baseline")]
    pub update_baseline: bool,
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
