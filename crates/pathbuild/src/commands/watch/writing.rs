//! `watch --emit`: writes the programs of what was asked again.

use std::collections::HashSet;

use pathbuild_db::{Db, Role, SourceFile, path_names};
use pathbuild_diagnostic::Diagnostic;

use super::library::Update;
use crate::commands::emit::{self, Owners};
use crate::context::Context;
use crate::posting::{Poster, Wishes};
use crate::session::Session;

/// Writes programs, if it is to.
pub(super) struct Writer<'a> {
    context: &'a Context,
    is_on: bool,
    poster: Option<Poster>,
    owners: Owners,
}

impl<'a> Writer<'a> {
    /// A writer that writes if `is_on`.
    ///
    /// # Errors
    /// What is wrong with the post that the configuration names.
    pub(super) fn new(context: &'a Context, is_on: bool) -> Result<Self, Vec<Diagnostic>> {
        let poster = if is_on { Poster::of_run(context, None, Wishes::default())? } else { None };
        Ok(Self { context, is_on, poster, owners: Owners::default() })
    }

    /// What keeps it from writing.
    pub(super) fn refusal(&self) -> Option<String> {
        let has_targets = !self.context.settings.emit.targets.value.is_empty();
        (self.is_on && !has_targets)
            .then(|| "nothing to emit: set `[emit] targets` in pathbuild.toml".to_owned())
    }

    /// Writes the targets among the paths of the drawings that were asked again; what is wrong with them as programs.
    pub(super) fn write(&mut self, session: &Session<'_>, update: &Update) -> Vec<Diagnostic> {
        if !self.is_on {
            return Vec::new();
        }
        let db = session.db();
        // What their paths were written to is free again.
        let removed = update.removed.iter().map(|drawing| db.file(drawing));
        let released: HashSet<SourceFile> = update.asked.iter().copied().chain(removed).collect();
        self.owners.retain(|_, owner| !released.contains(&owner.file(db)));
        let patterns = &self.context.settings.emit.targets.value;
        let is_target = |name: &str| patterns.iter().any(|pattern| pattern.matches(name));
        let mut targets = Vec::new();
        for file in &update.asked {
            let names = path_names(db, *file).iter().filter(|name| is_target(name.as_str()));
            targets.extend(names.map(|name| session.target_in(*file, name, Role::Emitted)));
        }
        emit::write(self.context, session, self.poster.as_ref(), &targets, &mut self.owners)
    }
}
