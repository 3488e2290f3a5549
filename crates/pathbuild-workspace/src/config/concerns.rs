use std::fmt::Debug;

use super::settings::Settings;

/// The cached results that depend on a setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Concerns {
    /// Results of `check`, and hence those of `emit`.
    Check,
    /// Results of `emit` only.
    Emit,
    /// Affects no cached result, only what is requested or how it is reported.
    Neither,
}

impl Concerns {
    /// Whether the cached results of the command `whose` depend on this setting.
    pub(in crate::config) fn is_part_of(self, whose: Self) -> bool {
        self != Self::Neither && self <= whose
    }
}

impl Settings {
    /// Passes each setting that a command's cached results depend on to `add`, with its name. `whose` is [`Concerns::Check`] or
    /// [`Concerns::Emit`].
    pub fn concerning(&self, whose: Concerns, add: &mut dyn FnMut(&'static str, &dyn Debug)) {
        self.general.concerning(whose, add);
        self.emit.concerning(whose, add);
        self.limits.concerning(whose, add);
        self.machine.concerning(whose, add);
        self.warnings.concerning(whose, add);
        self.watch.concerning(whose, add);
        self.tables.concerning(whose, add);
    }
}
