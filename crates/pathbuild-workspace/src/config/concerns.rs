use std::fmt::Debug;

use super::settings::Settings;

/// Whose kept results depend on a setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Concerns {
    /// Those of checks, and so those of programs too.
    Check,
    /// Those of programs only.
    Emit,
    /// Nobody's: it decides what is asked for, or what becomes of the answer.
    Neither,
}

impl Concerns {
    /// Whether results that depend on `whose` settings depend on this one.
    pub(in crate::config) fn is_part_of(self, whose: Self) -> bool {
        self != Self::Neither && self <= whose
    }
}

impl Settings {
    /// Every setting that results depend on, by name; `whose` is [`Concerns::Check`] or [`Concerns::Emit`].
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
