//! `watch --emit`: writes the programs of drawings that were checked.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use camino::Utf8PathBuf;
use pathbuild_db::{Db, Role, SourceFile, path_names};
use pathbuild_diagnostic::{Code, Diagnostic};

use super::events::{Listener, Request};
use crate::emit::{self, FileOwners, TargetPatterns};
use crate::memo::is_transient;
use crate::post_processor::{PostArguments, PostProcessor};
use crate::session::Session;
use crate::workspace::Workspace;

/// A writer of programs, which does nothing unless `--emit` is given.
pub(super) struct Writer<'a> {
    workspace: &'a Workspace,
    listener: &'a dyn Listener,
    is_on: bool,
    post_processor: Option<PostProcessor>,
    owners: FileOwners,
    /// The diagnostics of writing each drawing's programs, for drawings that have any.
    found: BTreeMap<Utf8PathBuf, Vec<Diagnostic>>,
}

/// The outcome of writing the programs of some drawings.
#[derive(Default)]
pub(super) struct WriteOutcome {
    /// Previous diagnostics of the drawings' programs.
    pub(super) before: Vec<Diagnostic>,
    /// Current diagnostics of the drawings' programs.
    pub(super) now: Vec<Diagnostic>,
}

impl<'a> Writer<'a> {
    /// Creates a writer, which does nothing unless the request emits.
    ///
    /// # Errors
    /// The errors of the configured post-processor.
    pub(super) fn new(
        workspace: &'a Workspace,
        listener: &'a dyn Listener,
        request: &Request<'_>,
    ) -> Result<Self, Vec<Diagnostic>> {
        let is_needed = request.emits || request.lists;
        let post_processor =
            if is_needed { PostProcessor::for_run(workspace, None, PostArguments::default())? } else { None };
        let (owners, found) = (FileOwners::default(), BTreeMap::new());
        Ok(Self { workspace, listener, is_on: request.emits, post_processor, owners, found })
    }

    /// The post-processor for the programs; `None` for native programs, or if the request needs none.
    pub(super) fn post_processor(&self) -> Option<&PostProcessor> {
        self.post_processor.as_ref()
    }

    pub(super) fn target_drawings(&self, session: &Session<'_>, files: &[SourceFile]) -> Vec<SourceFile> {
        let mut configured = TargetPatterns::new(&self.workspace.settings);
        let mut is_written = |file: &&SourceFile| {
            path_names(session.db(), **file).iter().filter(|name| configured.matches(name.as_str())).count()
                > 0
        };
        if self.is_on { files.iter().filter(|file| is_written(file)).copied().collect() } else { Vec::new() }
    }

    pub(super) fn sources(&self) -> Vec<Utf8PathBuf> {
        self.post_processor.as_ref().map(PostProcessor::sources).unwrap_or_default()
    }

    /// Returns the drawings with programs that have transient diagnostics or could not be written. No event reports when that changes, so they are
    /// tried again.
    pub(super) fn with_transient_problems(&self) -> BTreeSet<Utf8PathBuf> {
        let may_pass = |found: &Diagnostic| is_transient(found) || found.code() == Code::CannotWrite;
        let with_transient_problems = self.found.iter().filter(|(_, found)| found.iter().any(may_pass));
        with_transient_problems.map(|(drawing, _)| drawing.clone()).collect()
    }

    /// Releases the output file names that are claimed for drawings that will be checked again or were removed. Returns the other drawings that claim
    /// the same names, which must be checked again because they may be the only ones now.
    pub(super) fn release(
        &mut self,
        session: &Session<'_>,
        checked_files: impl Iterator<Item = SourceFile>,
        removed: &BTreeSet<Utf8PathBuf>,
    ) -> Vec<SourceFile> {
        let db = session.db();
        let removed = removed.iter().map(|drawing| db.file(drawing));
        let released: HashSet<SourceFile> = checked_files.chain(removed).collect();
        let mut others = Vec::new();
        self.owners.retain(|_, claimants| {
            let before = claimants.len();
            claimants.retain(|claimant| !released.contains(&claimant.file(db)));
            if claimants.len() < before {
                others.extend(claimants.iter().map(|claimant| claimant.file(db)));
            }
            !claimants.is_empty()
        });
        others
    }

    /// Forgets removed drawings, and returns the diagnostics of their programs.
    pub(super) fn forget(&mut self, removed: &BTreeSet<Utf8PathBuf>) -> Vec<Diagnostic> {
        removed.iter().filter_map(|drawing| self.found.remove(drawing)).flatten().collect()
    }

    /// Writes all targets. Returns diagnostics of the programs, and of targets that match no path.
    pub(super) fn begin(&mut self, session: &mut Session<'_>, all: &[SourceFile]) -> Vec<Diagnostic> {
        let mut configured = TargetPatterns::new(&self.workspace.settings);
        let mut problems = self.write_some(session, all, &mut configured).now;
        problems.extend(configured.unmatched().filter(|_| self.is_on));
        problems
    }

    /// Writes the targets among the paths of drawings that were checked.
    pub(super) fn write(&mut self, session: &mut Session<'_>, checked_files: &[SourceFile]) -> WriteOutcome {
        self.write_some(session, checked_files, &mut TargetPatterns::new(&self.workspace.settings))
    }

    fn write_some(
        &mut self,
        session: &mut Session<'_>,
        files: &[SourceFile],
        configured: &mut TargetPatterns<'_>,
    ) -> WriteOutcome {
        if !self.is_on {
            return WriteOutcome::default();
        }
        let (mut targets, mut before) = (Vec::new(), Vec::new());
        for file in files {
            before.extend(self.found.remove(file.path(session.db())).into_iter().flatten());
            let names =
                path_names(session.db(), *file).iter().filter(|name| configured.matches(name.as_str()));
            targets.extend(names.map(|name| session.target_in(*file, name, Role::Emitted)));
        }
        match emit::write(session, self.post_processor.as_ref(), &targets, &mut self.owners) {
            Ok(emission) => {
                self.listener.programs_written(emission.delivered);
                self.record(session, &emission.diagnostics);
                WriteOutcome { before, now: emission.diagnostics }
            }
            Err(refusal) => {
                self.listener.options_missing(&refusal);
                WriteOutcome { before, now: Vec::new() }
            }
        }
    }

    fn record(&mut self, session: &Session<'_>, found: &[Diagnostic]) {
        for problem in found {
            if let Some(drawing) = self.drawing_of(session, problem) {
                self.found.entry(drawing).or_default().push(problem.clone());
            }
        }
    }

    /// Returns the drawing that a diagnostic belongs to. Diagnostics about an output file name that file instead.
    fn drawing_of(&self, session: &Session<'_>, problem: &Diagnostic) -> Option<Utf8PathBuf> {
        let file = problem.file.as_ref().map(|file| file.as_str()).or(problem.quoted("name"))?;
        match self.owners.get(&file.to_lowercase()) {
            Some(owners) => owners.first().map(|owner| owner.file(session.db()).path(session.db()).clone()),
            None => problem.file.clone(),
        }
    }
}
