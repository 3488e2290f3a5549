use std::fmt::Debug;

use super::settings::Settings;

/// The cached results that depend on a setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ResultKind {
    /// Results of `check`, and hence those of `emit`.
    Check,
    /// Results of `emit` only.
    Emit,
    /// No results: the setting changes only what is requested or how it is reported.
    Neither,
}

impl ResultKind {
    /// Whether the cached results of the command `result_kind` depend on this setting.
    pub(in crate::config) fn is_part_of(self, result_kind: Self) -> bool {
        self != Self::Neither && self <= result_kind
    }
}

impl Settings {
    /// Passes each setting that a command's cached results depend on to `add`, with its name. `result_kind` is [`ResultKind::Check`] or
    /// [`ResultKind::Emit`].
    pub fn visit_inputs(&self, result_kind: ResultKind, add: &mut dyn FnMut(&'static str, &dyn Debug)) {
        self.general.visit_inputs(result_kind, add);
        self.emit.visit_inputs(result_kind, add);
        self.limits.visit_inputs(result_kind, add);
        self.machine.visit_inputs(result_kind, add);
        self.warnings.visit_inputs(result_kind, add);
        self.watch.visit_inputs(result_kind, add);
        self.tables.visit_inputs(result_kind, add);
    }
}
