//! `pathbuild completions`: a script that lets a shell complete commands and options.

use clap::CommandFactory;

use crate::args::{Cli, CompletionsArgs};
use crate::context::Context;
use crate::exit::ExitStatus;

/// Prints the script.
pub fn run(context: &Context, args: &CompletionsArgs) -> ExitStatus {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "pathbuild", &mut script);
    context.printer.result_bytes(&script);
    ExitStatus::Success
}
