//! Reading a command line.

use std::ffi::OsString;

use clap::{Args, Command as Definition, Error, FromArgMatches, Parser, Subcommand};

use super::{Cli, Command, CommonArgs};

impl Cli {
    /// What a command line says, the program's own name first.
    ///
    /// # Errors
    /// What is to be said instead: that it is wrong, the help, the version.
    pub fn read(arguments: &[OsString]) -> Result<Self, Error> {
        Self::read_command(arguments).map_or_else(|| Self::try_parse_from(arguments), Ok)
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
