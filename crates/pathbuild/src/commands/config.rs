//! `pathbuild config show` and `config schema`.

use crate::args::{ConfigArgs, ConfigCommand};
use crate::context::Context;
use crate::exit::ExitStatus;
use pathbuild_workspace::config::{schema, show};

/// Prints what holds, or what can be written.
pub fn run(context: &Context, args: &ConfigArgs) -> ExitStatus {
    match args.command {
        ConfigCommand::Show { origin, .. } => context.printer.result(show(&context.settings, origin)),
        ConfigCommand::Schema => context.printer.result_json(format_args!("{:#}", schema())),
    }
    ExitStatus::Success
}
