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
    /// Report only what is not in this file
    #[arg(long, value_name = "FILE")]
    pub baseline: Option<Utf8PathBuf>,
    /// Write everything that is found into the baseline file instead of reporting it
    #[arg(long, requires = "baseline")]
    pub update_baseline: bool,
    /// Check only what depends on files changed since this Git revision
    #[arg(long, value_name = "REV")]
    pub changed_since: Option<String>,
    /// Show where the time went
    #[arg(long)]
    pub timings: bool,
    /// Show no more than N errors; the last lines count all
    #[arg(long, value_name = "N")]
    pub max_errors: Option<usize>,
    /// Write a picture of each erroneous path into this directory
    #[arg(long, value_name = "DIR", hide = true)]
    pub pictures: Option<Utf8PathBuf>,
}
