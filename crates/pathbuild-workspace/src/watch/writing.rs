//! `watch --emit`: writes the programs of what was asked again.

use std::collections::{BTreeSet, HashSet};

use camino::Utf8PathBuf;
use pathbuild_db::{Db, Role, SourceFile, path_names};
use pathbuild_diagnostic::Diagnostic;

use super::{Listener, Request};
use crate::emit::{self, Configured, Owners};
use crate::posting::{PostArguments, PostProcessor};
use crate::session::{Session, is_passing};
use crate::workspace::Workspace;

/// Writes programs, if it is to.
pub(super) struct Writer<'a> {
    workspace: &'a Workspace,
    listener: &'a dyn Listener,
    is_on: bool,
    poster: Option<PostProcessor>,
    owners: Owners,
    /// The drawings in whose programs something was found that may pass by itself.
    passing: BTreeSet<Utf8PathBuf>,
}

impl<'a> Writer<'a> {
    /// A writer, which writes if that is wanted.
    ///
    /// # Errors
    /// What is wrong with the post that the configuration names.
    pub(super) fn new(
        workspace: &'a Workspace,
        listener: &'a dyn Listener,
        request: &Request<'_>,
    ) -> Result<Self, Vec<Diagnostic>> {
        let is_needed = request.emits || request.lists;
        let poster =
            if is_needed { PostProcessor::of_run(workspace, None, PostArguments::default())? } else { None };
        let (owners, passing) = (Owners::default(), BTreeSet::new());
        Ok(Self { workspace, listener, is_on: request.emits, poster, owners, passing })
    }

    /// The post that programs are written through; `None`: natively, or nobody asks.
    pub(super) fn poster(&self) -> Option<&PostProcessor> {
        self.poster.as_ref()
    }

    /// The drawings with paths that are written.
    pub(super) fn written(&self, session: &Session<'_>, files: &[SourceFile]) -> Vec<SourceFile> {
        let mut configured = Configured::new(&self.workspace.settings);
        let mut is_written = |file: &&SourceFile| {
            path_names(session.db(), **file).iter().filter(|name| configured.means(name.as_str())).count() > 0
        };
        if self.is_on { files.iter().filter(|file| is_written(file)).copied().collect() } else { Vec::new() }
    }

    /// The files that the post is read from.
    pub(super) fn sources(&self) -> Vec<Utf8PathBuf> {
        self.poster.as_ref().map(PostProcessor::sources).unwrap_or_default()
    }

    /// The drawings in whose programs something was found that may pass by itself.
    pub(super) fn passing(&self) -> &BTreeSet<Utf8PathBuf> {
        &self.passing
    }

    /// What the paths of drawings that are asked again, or gone, were written to is free again.
    pub(super) fn release(
        &mut self,
        session: &Session<'_>,
        asked: impl Iterator<Item = SourceFile>,
        removed: &BTreeSet<Utf8PathBuf>,
    ) {
        let db = session.db();
        let removed = removed.iter().map(|drawing| db.file(drawing));
        let released: HashSet<SourceFile> = asked.chain(removed).collect();
        self.owners.retain(|_, owner| !released.contains(&owner.file(db)));
    }

    /// Writes the targets among all paths; what is wrong with them as programs, and targets that mean none.
    pub(super) fn begin(&mut self, session: &mut Session<'_>, all: &[SourceFile]) -> Vec<Diagnostic> {
        let mut configured = Configured::new(&self.workspace.settings);
        let mut problems = self.write_some(session, all, &mut configured);
        problems.extend(configured.unmet().filter(|_| self.is_on));
        problems
    }

    /// Writes the targets among the paths of drawings that were asked again; what is wrong with them as programs.
    pub(super) fn write(&mut self, session: &mut Session<'_>, asked: &[SourceFile]) -> Vec<Diagnostic> {
        self.write_some(session, asked, &mut Configured::new(&self.workspace.settings))
    }

    fn write_some(
        &mut self,
        session: &mut Session<'_>,
        files: &[SourceFile],
        configured: &mut Configured<'_>,
    ) -> Vec<Diagnostic> {
        if !self.is_on {
            return Vec::new();
        }
        let mut targets = Vec::new();
        for file in files {
            self.passing.remove(file.path(session.db()));
            let names = path_names(session.db(), *file).iter().filter(|name| configured.means(name.as_str()));
            targets.extend(names.map(|name| session.target_in(*file, name, Role::Emitted)));
        }
        match emit::write(session, self.poster.as_ref(), &targets, &mut self.owners) {
            Ok(emission) => {
                self.listener.written(&emission.delivered);
                let passing = emission.diagnostics.iter().filter(|found| is_passing(found));
                self.passing.extend(passing.filter_map(|found| found.file.clone()));
                emission.diagnostics
            }
            Err(refusal) => {
                self.listener.refused(&refusal);
                Vec::new()
            }
        }
    }
}
