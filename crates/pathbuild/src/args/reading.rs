//! Parses a command line.

use std::ffi::OsString;

use camino::Utf8Path;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{
    ArgMatches, Args, Command as Definition, CommandFactory, Error, FromArgMatches, Subcommand, ValueEnum,
};

use super::common::LangArg;
use super::{Cli, Command, CommonArgs};

impl Cli {
    /// Parses a command line, which begins with the program's own name.
    ///
    /// # Errors
    /// An error of usage, or the requested help or version.
    pub fn read(arguments: &[OsString]) -> Result<Self, Error> {
        if let Some(read) = Self::read_command(arguments) {
            return Ok(read);
        }
        let matches = Self::matches(&Self::command(), arguments)?;
        Self::from_arg_matches(&matches).map_err(|error| error.format(&mut Self::command()))
    }

    /// Parses a command line with a definition in some language.
    ///
    /// # Errors
    /// An error of usage, or the requested help or version, in that language.
    pub fn matches(definition: &Definition, arguments: &[OsString]) -> Result<ArgMatches, Error> {
        let read = |arguments: &[OsString]| definition.clone().try_get_matches_from(arguments);
        read(arguments).or_else(|error| match drawing_as_command(&error, arguments) {
            Some(arguments) => read(&arguments),
            None => Err(error),
        })
    }

    /// The language requested by a command line, even if the command line has errors.
    pub fn lang(arguments: &[OsString]) -> Option<LangArg> {
        let texts: Vec<&str> = arguments.iter().filter_map(|argument| argument.to_str()).collect();
        let apart = texts.windows(2).filter(|pair| pair[0] == "--lang").map(|pair| pair[1]);
        let joined = texts.iter().filter_map(|text| text.strip_prefix("--lang="));
        apart.chain(joined).find_map(|name| LangArg::from_str(name, false).ok())
    }

    /// Fast path for a command line that begins with a command and has no errors: defines only that command. Every command gets its own
    /// copy of the common options, and defining all of them takes a quarter of the time of a short run.
    fn read_command(arguments: &[OsString]) -> Option<Self> {
        let commands = Command::augment_subcommands(Definition::new("pathbuild"));
        let command = commands.find_subcommand(arguments.get(1)?)?.clone();
        let line = CommonArgs::augment_args(Definition::new("pathbuild")).subcommand(command);
        Self::from_arg_matches(&line.try_get_matches_from(arguments).ok()?).ok()
    }
}

/// Inserts `check` before a drawing that is given in place of a command.
fn drawing_as_command(error: &Error, arguments: &[OsString]) -> Option<Vec<OsString>> {
    let named = error.get(ContextKind::InvalidSubcommand);
    let (ErrorKind::InvalidSubcommand, Some(ContextValue::String(named))) = (error.kind(), named) else {
        return None;
    };
    Utf8Path::new(named).extension().filter(|extension| extension.eq_ignore_ascii_case("dxf"))?;
    let place = arguments.iter().position(|argument| argument == named.as_str())?;
    let (before, after) = arguments.split_at(place);
    Some([before, &["check".into()], after].concat())
}
