//! The program `pathbuild`: arguments, configuration, how results are shown, exit status. What drawings mean is decided in the
//! crates below; this one holds no logic of theirs. (spec/05-command-line.md, spec/06-configuration.md)

pub mod args;
pub mod commands;
mod context;
mod exit;
pub mod printer;
pub mod render;
pub mod report;
mod usage;

use std::ffi::OsString;

use camino::Utf8PathBuf;
use clap::Parser;
use pathbuild_diagnostic::Lang;

pub use context::Context;
pub use exit::ExitStatus;

use args::{Cli, CommonArgs};
use printer::Printer;

/// Runs the program with the arguments that the shell gave it, the first being its own name.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitStatus {
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(error) => {
            let printer = Printer::default();
            let status = usage::answer(&error, &printer);
            return printer.finish(status);
        }
    };
    let context = context(&cli.common);
    let status = commands::run(&context, &cli.command);
    context.printer.finish(status)
}

fn context(common: &CommonArgs) -> Context {
    Context {
        printer: Printer::new(common.verbosity(), common.color.unwrap_or_default()),
        format: common.format.unwrap_or_default(),
        lang: common.lang.map_or(Lang::En, Into::into),
        working_directory: working_directory(),
    }
}

/// The working directory; empty, so that relative names stay relative, where the system does not tell it or it is no UTF-8.
#[expect(clippy::disallowed_methods, reason = "this is where the program asks once")]
fn working_directory() -> Utf8PathBuf {
    let directory = std::env::current_dir().ok();
    directory.and_then(|directory| Utf8PathBuf::from_path_buf(directory).ok()).unwrap_or_default()
}
