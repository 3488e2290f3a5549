use clap::Args;

use super::Inputs;

/// `pathbuild watch`
#[derive(Clone, Debug, Default, Args)]
pub struct WatchArgs {
    /// What to watch.
    #[command(flatten)]
    pub inputs: Inputs,
    /// Write the files too
    #[arg(long)]
    pub emit: bool,
    /// Serve the state as a web page
    #[arg(long, value_name = "ADDR", num_args = 0..=1, default_missing_value = "127.0.0.1:7878")]
    pub serve: Option<String>,
    /// Look for changes from time to time (network drives)
    #[arg(long)]
    pub poll: bool,
}
