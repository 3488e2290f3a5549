//! What a command is asked to work on.

use std::ops::Deref;

use clap::{ArgMatches, Args, Command, Error, FromArgMatches};
use pathbuild_workspace::Inputs;

use crate::completion;

/// Drawings, paths and directories as arguments.
#[derive(Clone, Debug, Default)]
pub struct InputArgs(Inputs);

#[derive(Args)]
struct InputArguments {
    /// Drawings (.dxf), names of paths or patterns of them (8*.1P), directories
    #[arg(value_name = "DRAWING|PATH|DIRECTORY", add = completion::paths())]
    inputs: Vec<String>,
}

impl Deref for InputArgs {
    type Target = Inputs;

    fn deref(&self) -> &Inputs {
        &self.0
    }
}

impl Args for InputArgs {
    fn augment_args(command: Command) -> Command {
        InputArguments::augment_args(command)
    }

    fn augment_args_for_update(command: Command) -> Command {
        InputArguments::augment_args_for_update(command)
    }
}

impl FromArgMatches for InputArgs {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        InputArguments::from_arg_matches(matches).map(|InputArguments { inputs }| Self(Inputs { inputs }))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}
