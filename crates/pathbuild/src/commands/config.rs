//! `pathbuild config`: shows the settings in force, or the schema of the configuration.

use serde_json::json;

use crate::args::{ConfigArgs, ConfigCommand};
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::printer::Stream;
use crate::render::Format;
use pathbuild_workspace::config::{ShownSetting, schema, settings, show};

/// Prints the settings, or the schema.
pub fn run(context: &Context, args: &ConfigArgs) -> ExitStatus {
    match args.command {
        ConfigCommand::Show { .. } if context.format == Format::Json => {
            for (section, ShownSetting { name, value, origin }) in settings(&context.settings) {
                let origin = value.as_ref().map(|_| origin.to_string()).unwrap_or_default();
                let row = json!({ "section": section, "name": name, "value": value, "origin": origin });
                context.row("setting", row);
            }
        }
        ConfigCommand::Show { origin, .. } => context.printer.result(show(&context.settings, origin)),
        ConfigCommand::Schema => context.printer.json(Stream::Stdout, format_args!("{:#}", schema())),
    }
    ExitStatus::Success
}
