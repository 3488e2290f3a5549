//! `watch --emit`: writes the programs of drawings that were checked.

use std::collections::BTreeSet;

use camino::Utf8PathBuf;
use pathbuild_db::{Role, SecondDefinition, SourceFile, Target, path_names};
use pathbuild_diagnostic::{Code, Diagnostic};

use super::events::{Listener, Request, Update};
use super::library::Library;
use crate::emit::{CoveredDrawings, TargetPatterns, WrittenPrograms};
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
    programs: WrittenPrograms,
    /// The paths that two drawings define, as the check of the library reports them.
    reported_definitions: BTreeSet<SecondDefinition>,
    /// Diagnostics of programs that were reported last, except for the common ones.
    problems: Vec<Diagnostic>,
    /// Diagnostics of all programs together that were reported last.
    common_problems: Vec<Diagnostic>,
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
        let (reported_definitions, problems, common_problems) = Default::default();
        let programs = WrittenPrograms::default();
        Ok(Self {
            workspace,
            listener,
            is_on: request.emits,
            post_processor,
            programs,
            reported_definitions,
            problems,
            common_problems,
        })
    }

    /// Returns the post-processor for the programs; `None` for native programs, or if the request needs none.
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
    pub(super) fn transient_drawings(&self, session: &Session<'_>) -> BTreeSet<Utf8PathBuf> {
        let may_pass = |found: &Diagnostic| is_transient(found) || found.code() == Code::CannotWrite;
        self.programs.drawings_with(session, may_pass)
    }

    /// Sets the paths that two drawings define now. Returns the drawings whose programs are to be written or left out because of it.
    pub(super) fn set_second_definitions(&mut self, library: &Library<'_>) -> Vec<SourceFile> {
        if !self.is_on || !library.has_other_content() {
            return Vec::new();
        }
        self.reported_definitions = library.second_definitions(false);
        let session = library.session();
        let now = library.second_definitions(session.out_dir().is_some());
        self.programs.set_second_definitions(session.db(), now)
    }

    /// Forgets the programs of removed drawings. Returns the other drawings whose programs may be written now, because no removed drawing claims
    /// their file names any more.
    pub(super) fn forget(
        &mut self,
        session: &Session<'_>,
        removed: &BTreeSet<Utf8PathBuf>,
    ) -> Vec<SourceFile> {
        self.programs.forget(session.db(), removed)
    }

    /// Writes the targets among the paths of drawings that were checked. Returns the other drawings whose programs may be written now, because none
    /// of these drawings claims their file names any more.
    pub(super) fn write(
        &mut self,
        session: &mut Session<'_>,
        checked_files: &[SourceFile],
    ) -> Vec<SourceFile> {
        if !self.is_on {
            return Vec::new();
        }
        let mut configured = TargetPatterns::new(&self.workspace.settings);
        let mut targets: Vec<Target> = Vec::new();
        for file in checked_files {
            let names =
                path_names(session.db(), *file).iter().filter(|name| configured.matches(name.as_str()));
            targets.extend(names.map(|name| session.db().target(*file, name.as_str(), Role::Emitted)));
        }
        let post_processor = self.post_processor.as_ref();
        let (outcomes, rivals) = self.programs.write(session, post_processor, checked_files, &targets);
        match outcomes {
            Ok(outcomes) => self.listener.programs_written(outcomes),
            Err(refusal) => self.listener.options_missing(&refusal),
        }
        rivals
    }

    /// Updates the diagnostics of programs in a batch. While drawings are still to be checked, `scope` is `None`, and the diagnostics of all programs
    /// together stay as they are.
    pub(super) fn update_problems(
        &mut self,
        session: &mut Session<'_>,
        scope: Option<&CoveredDrawings<'_>>,
        update: &mut Update,
    ) {
        if !self.is_on {
            return;
        }
        if let Some(scope) = scope {
            let mut common = self.programs.common_problems(session, self.post_processor.as_ref(), scope);
            let twice = self.programs.second_definitions(session.db()).into_iter();
            let new = twice.filter(|definition| !self.reported_definitions.contains(definition));
            common.extend(new.map(SecondDefinition::diagnostic));
            update.has_other_problems |= replace(&mut self.common_problems, common, update);
        }
        let problems = self.programs.problems(session);
        replace(&mut self.problems, problems, update);
    }

    /// Returns the diagnostics of all programs together.
    pub(super) fn common_problems(&self) -> &[Diagnostic] {
        &self.common_problems
    }
}

/// Replaces diagnostics, and adds them to the update if they differ. Returns whether they do.
fn replace(before: &mut Vec<Diagnostic>, now: Vec<Diagnostic>, update: &mut Update) -> bool {
    let is_other = *before != now;
    if is_other {
        update.now.extend_from_slice(&now);
        update.before.extend(std::mem::replace(before, now));
    }
    is_other
}
