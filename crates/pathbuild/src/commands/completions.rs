//! `pathbuild completions`: prints a script with which a shell completes commands, options, and names of paths, posts and codes.

use clap_complete::env::Shells;

use crate::args::CompletionsArgs;
use crate::args::completions::VARIABLE;
use crate::context::Context;
use crate::exit::ExitStatus;

/// Prints the completion script for the given shell.
pub fn run(context: &Context, args: &CompletionsArgs) -> ExitStatus {
    let mut script = Vec::new();
    let shell = Shells::builtins();
    let Some(shell) = shell.completer(&args.shell) else { return ExitStatus::Usage };
    // Writing to memory cannot fail.
    _ = shell.write_registration(VARIABLE, "pathbuild", "pathbuild", "pathbuild", &mut script);
    context.printer.result_bytes(&script);
    ExitStatus::Success
}
