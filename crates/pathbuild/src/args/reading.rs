//! Reading a command line.

use std::ffi::OsString;

use camino::Utf8Path;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Args, Command as Definition, Error, FromArgMatches, Parser, Subcommand};

use super::{Cli, Command, CommonArgs};

impl Cli {
    /// What a command line says, the program's own name first.
    ///
    /// # Errors
    /// What is to be said instead: that it is wrong, the help, the version.
    pub fn read(arguments: &[OsString]) -> Result<Self, Error> {
        if let Some(read) = Self::read_command(arguments) {
            return Ok(read);
        }
        Self::try_parse_from(arguments).or_else(|error| match drawing_as_command(&error, arguments) {
            Some(arguments) => Self::try_parse_from(arguments),
            None => Err(error),
        })
    }

    /// The same where the command comes first, as it nearly always does, and nothing else is to be said: without all other commands, each of which
    /// would get the common options for itself. To define them takes a quarter of the time of a short run.
    fn read_command(arguments: &[OsString]) -> Option<Self> {
        let commands = Command::augment_subcommands(Definition::new("pathbuild"));
        let command = commands.find_subcommand(arguments.get(1)?)?.clone();
        let line = CommonArgs::augment_args(Definition::new("pathbuild")).subcommand(command);
        Self::from_arg_matches(&line.try_get_matches_from(arguments).ok()?).ok()
    }
}

/// The command line with `check` before the drawing that stands where the command should.
fn drawing_as_command(error: &Error, arguments: &[OsString]) -> Option<Vec<OsString>> {
    let named = error.get(ContextKind::InvalidSubcommand);
    let (ErrorKind::InvalidSubcommand, Some(ContextValue::String(named))) = (error.kind(), named) else {
        return None;
    };
    Utf8Path::new(named).extension().filter(|it| it.eq_ignore_ascii_case("dxf"))?;
    let place = arguments.iter().position(|argument| argument == named.as_str())?;
    let (before, after) = arguments.split_at(place);
    Some([before, &["check".into()], after].concat())
}
