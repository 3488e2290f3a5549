//! Reading a command line.

use std::ffi::OsString;

use camino::Utf8Path;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{
    ArgMatches, Args, Command as Definition, CommandFactory, Error, FromArgMatches, Subcommand, ValueEnum,
};

use super::common::LangArg;
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
        let matches = Self::matches(&Self::command(), arguments)?;
        Self::from_arg_matches(&matches).map_err(|error| error.format(&mut Self::command()))
    }

    /// The same by a definition in some language, as clap has it.
    ///
    /// # Errors
    /// What is to be said instead, in that language.
    pub fn matches(definition: &Definition, arguments: &[OsString]) -> Result<ArgMatches, Error> {
        let read = |arguments: &[OsString]| definition.clone().try_get_matches_from(arguments);
        read(arguments).or_else(|error| match drawing_as_command(&error, arguments) {
            Some(arguments) => read(&arguments),
            None => Err(error),
        })
    }

    /// The language that a command line asks for, right or wrong as it may be otherwise.
    pub fn lang(arguments: &[OsString]) -> Option<LangArg> {
        let texts: Vec<&str> = arguments.iter().filter_map(|argument| argument.to_str()).collect();
        let apart = texts.windows(2).filter(|pair| pair[0] == "--lang").map(|pair| pair[1]);
        let joined = texts.iter().filter_map(|text| text.strip_prefix("--lang="));
        apart.chain(joined).find_map(|name| LangArg::from_str(name, false).ok())
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
