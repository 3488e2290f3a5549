//! Options that override settings. They are derived from the table of settings in `pathbuild_workspace::config::sections`.

use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches};
use pathbuild_workspace::config::sections::general::OPTIONS;
use pathbuild_workspace::config::{GivenOptions, OptionValues, SettingOption};

/// The options given on the command line that override settings, not yet validated.
#[derive(Clone, Debug, Default)]
pub struct SettingArgs(pub GivenOptions);

impl Args for SettingArgs {
    fn augment_args(command: Command) -> Command {
        OPTIONS.iter().map(argument).fold(command, Command::arg)
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for SettingArgs {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let options = OPTIONS.iter().filter_map(|option| Some((option.name, texts(option, matches)?)));
        Ok(Self(options.collect()))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

fn argument(option: &SettingOption) -> Arg {
    let argument = Arg::new(option.name)
        .long(option.name)
        .global(true)
        .help(option.help.en)
        .display_order(option.position);
    match option.values {
        OptionValues::Switch => argument.action(ArgAction::SetTrue),
        OptionValues::Text(name) => argument.value_name(name).allow_hyphen_values(true),
        OptionValues::Texts(name) => {
            argument.value_name(name).allow_hyphen_values(true).action(ArgAction::Append)
        }
        OptionValues::Directory => argument.value_name("DIR"),
        OptionValues::Directories => argument.value_name("DIR").action(ArgAction::Append),
    }
}

fn texts(option: &SettingOption, matches: &ArgMatches) -> Option<Vec<String>> {
    if option.values == OptionValues::Switch {
        return matches.get_flag(option.name).then(Vec::new);
    }
    matches.get_many::<String>(option.name).map(|texts| texts.cloned().collect())
}
