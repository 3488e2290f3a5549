//! Options that are declared and not built yet: they are hidden from the help, and refused, since a run that took no notice of them
//! would give something else than was asked for. Whoever builds one takes it off here and shows it.

use super::{CheckArgs, Command};

impl Command {
    /// The first option on the command line that is not built yet.
    pub fn unbuilt_option(&self) -> Option<&'static str> {
        let options = match self {
            Self::Check(args) => check(args),
            _ => Vec::new(),
        };
        options.into_iter().find(|(_, is_given)| *is_given).map(|(name, _)| name)
    }
}

fn check(args: &CheckArgs) -> Vec<(&'static str, bool)> {
    vec![("--pictures", args.pictures.is_some())]
}
