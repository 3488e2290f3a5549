use clap::Args;

use super::InputArgs;
use super::address::Address;

/// `pathbuild watch`
#[derive(Clone, Debug, Default, Args)]
pub struct WatchArgs {
    /// What to watch.
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
