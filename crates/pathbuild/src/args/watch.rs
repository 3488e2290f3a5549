use clap::Args;

use super::InputArgs;

/// `pathbuild watch`
#[derive(Clone, Debug, Default, Args)]
pub struct WatchArgs {
    /// What to watch.
    #[command(flatten)]
    pub inputs: InputArgs,
    /// Write the files of `[emit] targets` too
    #[arg(long)]
    pub emit: bool,
    /// Look for changes from time to time (network drives)
    #[arg(long)]
    pub poll: bool,
}
