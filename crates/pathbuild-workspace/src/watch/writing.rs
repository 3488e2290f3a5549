//! `watch --emit`: writes the programs of what was asked again.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use camino::Utf8PathBuf;
use pathbuild_db::{Db, Role, SourceFile, path_names};
use pathbuild_diagnostic::{Code, Diagnostic, Value};

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
    /// What was found when the programs of drawings were made and written, for those of which something was.
    found: BTreeMap<Utf8PathBuf, Vec<Diagnostic>>,
}

/// What came of writing the programs of some drawings.
#[derive(Default)]
pub(super) struct Writing {
    /// What was found when they were written before.
    pub(super) before: Vec<Diagnostic>,
    /// What is found now.
    pub(super) now: Vec<Diagnostic>,
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
        let (owners, found) = (Owners::default(), BTreeMap::new());
        Ok(Self { workspace, listener, is_on: request.emits, poster, owners, found })
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

    /// The drawings in whose programs something was found that may pass by itself, or that could not be written: nobody tells when they can be.
    pub(super) fn passing(&self) -> BTreeSet<Utf8PathBuf> {
        let may_pass = |found: &Diagnostic| is_passing(found) || found.code() == Code::CannotWrite;
        let passing = self.found.iter().filter(|(_, found)| found.iter().any(may_pass));
        passing.map(|(drawing, _)| drawing.clone()).collect()
    }

    /// What the paths of drawings that are asked again, or gone, were written to is free again; what was found in the programs of those that are
    /// gone.
    pub(super) fn release(
        &mut self,
        session: &Session<'_>,
        asked: impl Iterator<Item = SourceFile>,
        removed: &BTreeSet<Utf8PathBuf>,
    ) -> Vec<Diagnostic> {
        let db = session.db();
        let gone = removed.iter().filter_map(|drawing| self.found.remove(drawing)).flatten().collect();
        let removed = removed.iter().map(|drawing| db.file(drawing));
        let released: HashSet<SourceFile> = asked.chain(removed).collect();
        self.owners.retain(|_, owner| !released.contains(&owner.file(db)));
        gone
    }

    /// Writes the targets among all paths; what is wrong with them as programs, and targets that mean none.
    pub(super) fn begin(&mut self, session: &mut Session<'_>, all: &[SourceFile]) -> Vec<Diagnostic> {
        let mut configured = Configured::new(&self.workspace.settings);
        let mut problems = self.write_some(session, all, &mut configured).now;
        problems.extend(configured.unmet().filter(|_| self.is_on));
        problems
    }

    /// Writes the targets among the paths of drawings that were asked again.
    pub(super) fn write(&mut self, session: &mut Session<'_>, asked: &[SourceFile]) -> Writing {
        self.write_some(session, asked, &mut Configured::new(&self.workspace.settings))
    }

    fn write_some(
        &mut self,
        session: &mut Session<'_>,
        files: &[SourceFile],
        configured: &mut Configured<'_>,
    ) -> Writing {
        if !self.is_on {
            return Writing::default();
        }
        let (mut targets, mut before) = (Vec::new(), Vec::new());
        for file in files {
            before.extend(self.found.remove(file.path(session.db())).into_iter().flatten());
            let names = path_names(session.db(), *file).iter().filter(|name| configured.means(name.as_str()));
            targets.extend(names.map(|name| session.target_in(*file, name, Role::Emitted)));
        }
        match emit::write(session, self.poster.as_ref(), &targets, &mut self.owners) {
            Ok(emission) => {
                self.listener.written(&emission.delivered);
                self.keep(session, &emission.diagnostics);
                Writing { before, now: emission.diagnostics }
            }
            Err(refusal) => {
                self.listener.refused(&refusal);
                Writing { before, now: Vec::new() }
            }
        }
    }

    fn keep(&mut self, session: &Session<'_>, found: &[Diagnostic]) {
        for problem in found {
            if let Some(drawing) = self.drawing_of(session, problem) {
                self.found.entry(drawing).or_default().push(problem.clone());
            }
        }
    }

    /// The drawing that a problem is of. What is wrong with a file that is to be written names that file.
    fn drawing_of(&self, session: &Session<'_>, problem: &Diagnostic) -> Option<Utf8PathBuf> {
        let name = problem.arguments.iter().find_map(|argument| match argument {
            ("name", Value::Text(name)) => Some(&**name),
            _ => None,
        });
        let file = problem.file.as_ref().map(|file| file.as_str()).or(name)?;
        match self.owners.get(&file.to_lowercase()) {
            Some(owner) => Some(owner.file(session.db()).path(session.db()).clone()),
            None => problem.file.clone(),
        }
    }
}
