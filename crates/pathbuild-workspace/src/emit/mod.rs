//! `emit`: generates the programs of paths, and writes, compares or prints them. (book: reference/commands, `emit`; book: program/gcode)

mod compare;
mod compatible;
mod deliver;
mod deps;
mod drawing_comparison;
mod generate;
mod job;
mod older;
mod options;
mod program_text;
mod provenance;
mod sheet;
mod stale;
mod store;
mod target_patterns;
mod targets;
mod write_queue;

use std::collections::HashMap;
use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::FileKind;
use pathbuild_db::{SourceFile, Target};
use pathbuild_diagnostic::Diagnostic;

use crate::Inputs;
use crate::config::types::SheetFormat;
use crate::posting::PostProcessor;
use crate::session::{ArgumentMatches, Scope, Session};
use crate::workspace::Workspace;

use deliver::OutputSettings;
pub use deliver::{ProgramOutcome, State, Task};
pub use drawing_comparison::{DrawingComparison, compare_with_drawing, native_text};
use generate::{CheckedProgram, EmitContext, EmitResult, deliver};
use job::{JobBuilder, take_clashes};
pub use options::missing_values;
pub use options::writing;
pub(crate) use program_text::program_text;
pub use provenance::Provenances;
pub use sheet::{SheetOutcome, sheet_bytes, sheet_of};
use stale::StaleOutcome;
use store::{RunRecord, Store};
pub use target_patterns::TargetPatterns;
use targets::TargetSelection;

/// A request to emit programs.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    /// The drawings, paths and directories; if empty, the paths matched by `[emit] targets`.
    pub inputs: &'a Inputs,
    /// What to do with the generated files.
    pub task: Task,
    /// The post-processor to write programs through; `None` writes native programs.
    pub post_processor: Option<&'a PostProcessor>,
    /// Joins all paths, in the order of the inputs, into one program of this name.
    pub join: Option<&'a str>,
    /// Dependency file to write for `make` and `ninja`.
    pub deps: Option<&'a Utf8Path>,
    /// Whether to remove stale programs.
    pub removes_stale: bool,
}

/// The outcome of `emit`.
#[derive(Debug)]
pub struct Emission {
    /// The outcome of each program, in the order of the targets.
    pub delivered: Vec<ProgramOutcome>,
    /// Stale programs that were removed.
    pub removed: Vec<Utf8PathBuf>,
    /// Adjusted programs that no longer match their path's program.
    pub outdated: Vec<Utf8PathBuf>,
    /// All diagnostics, unsorted, with duplicates.
    pub diagnostics: Vec<Diagnostic>,
}

impl Request<'_> {
    /// Opens a session that suits this request.
    pub fn session<'w>(&self, workspace: &'w Workspace) -> Session<'w> {
        if workspace.keeps_results() && !self.is_always_made() {
            Session::traced(workspace)
        } else {
            Session::new(workspace)
        }
    }

    /// Whether everything must be regenerated, regardless of the cache.
    fn is_always_made(&self) -> bool {
        matches!(self.task, Task::Print | Task::Write { force: true })
            || self.deps.is_some()
            || self.post_processor.is_some_and(PostProcessor::runs_post_build)
    }

    /// Emits the programs in a session opened by [`session`](Self::session).
    ///
    /// # Errors
    /// Why the request makes no sense.
    pub fn run(&self, session: &mut Session<'_>) -> Result<Emission, String> {
        if !session.is_traced() {
            session.prefetch(self.inputs, &|_| false);
        }
        let mut found = session.match_arguments(self.inputs);
        let store = self.store(session, &mut found);
        let context = EmitContext { request: self, store, found };
        let result = session.with_stable_files(|session| context.make(session))?;
        let EmitResult { selection, answers, jobs, refused, mut delivered, mut diagnostics } = result;
        report_cached(session.workspace(), &selection, &answers);
        for (job, delivered) in jobs.iter().zip(&mut delivered) {
            delivered.path.clone_from(&job.path);
        }
        compatible::name(session.workspace(), self, &mut delivered);
        let older = older::programs(session, self, &selection.targets, &jobs, &delivered, &mut diagnostics);
        let problems = delivered.iter().chain(&older).flat_map(|delivered| &delivered.problems);
        diagnostics.extend(problems.cloned());
        if let Some(file) = self.deps {
            let inserted: Vec<_> = delivered.iter().map(|delivered| &*delivered.inserted).collect();
            diagnostics.extend(deps::write(session, file, &jobs, self.post_processor, &inserted));
        }
        let stale = match self.task {
            Task::Print => Vec::new(),
            _ => stale::stale(session, &selection, &jobs, &delivered, self.post_processor, &mut diagnostics),
        };
        let StaleOutcome { removed, outdated } =
            stale::settle(session, stale, self.removes_stale, &mut diagnostics);
        if let Some(store) = &context.store {
            let Self { task, join, post_processor, .. } = *self;
            let (selection, answers, jobs, delivered, refused) =
                (&selection, &answers, &jobs, &delivered, &refused);
            store.keep(
                session,
                &RunRecord { task, join, post_processor, selection, answers, jobs, delivered, refused },
            );
        }
        delivered.extend(older);
        Ok(Emission { delivered, removed, outdated, diagnostics: session.with_hints(diagnostics) })
    }

    /// Loads the cached results of the drawings that the request may select.
    fn store(&self, session: &Session<'_>, found: &mut ArgumentMatches) -> Option<Store> {
        if !session.is_traced() {
            return None;
        }
        let (scope, listings) = (Scope::of(session, found), std::mem::take(&mut found.listings));
        let store = Store::open(session.workspace(), self.post_processor, scope, listings);
        let is_known = |file: SourceFile| {
            store.as_ref().is_some_and(|store| store.drawing(file.path(session.db())).is_some())
        };
        session.prefetch(self.inputs, &is_known);
        store
    }
}

/// Reports, as a detail, how much was cached.
fn report_cached(context: &Workspace, selection: &TargetSelection, answers: &[CheckedProgram]) {
    let open: usize = answers.iter().map(|answer| answer.checked.len()).sum();
    let drawings = selection.drawings().count();
    let read = selection.drawings().filter(|drawing| drawing.is_read).count();
    let known = [(selection.targets.len() - open, selection.targets.len()), (drawings - read, drawings)];
    let phrases = [
        context.choose("paths whose results still hold", "Pfade, deren Ergebnisse noch gelten"),
        context.choose("drawings that are known", "Zeichnungen, die bekannt sind"),
    ];
    for (phrase, (known, all)) in phrases.iter().zip(known) {
        context.reporter.detail(&format!("{phrase}: {known} / {all}"));
    }
}

/// For each target with a program on disk, whether that program is up to date, or the errors that keep it from being generated.
pub(crate) fn on_disk(
    session: &mut Session<'_>,
    post_processor: Option<&PostProcessor>,
    targets: &[Target],
) -> HashMap<Target, Result<bool, Vec<Diagnostic>>> {
    let checked = session.check(targets);
    let builder = JobBuilder { session, post_processor, join: None, sheet: SheetFormat::No };
    let built = checked.chunks(1).filter_map(|checked| builder.job(checked).ok().flatten());
    let mut jobs: Vec<_> = built.collect();
    let system = Arc::clone(&session.workspace().system);
    jobs.retain(|job| job.files.iter().any(|(_, path)| system.kind(path) == FileKind::File));
    let settings = OutputSettings::new(session.workspace(), post_processor);
    let delivered = deliver(session, &jobs, Task::Compare { moves_only: false }, &settings);
    jobs.iter().zip(delivered).map(|(job, delivered)| (job.targets[0], is_current(delivered))).collect()
}

/// Whether all files of a program are up to date.
///
/// # Errors
/// The errors of a program that was not generated.
fn is_current(delivered: ProgramOutcome) -> Result<bool, Vec<Diagnostic>> {
    if delivered.files.is_empty() && delivered.problems.iter().any(Diagnostic::is_error) {
        return Err(delivered.problems);
    }
    let is_current = |(_, state): &(_, State)| matches!(state, State::Current);
    Ok(!delivered.files.is_empty() && delivered.files.iter().all(is_current))
}

/// The target that each file was written for. File names are in lower case.
pub type FileOwners = HashMap<String, Target>;

/// Writes the programs of these targets in a long-lived session and returns what is wrong with the programs themselves; drawing errors are
/// reported by `check`.
///
/// # Errors
/// Which options are missing.
pub fn write(
    session: &mut Session<'_>,
    post_processor: Option<&PostProcessor>,
    targets: &[Target],
    owners: &mut FileOwners,
) -> Result<Emission, String> {
    session.with_stable_files(|session| {
        let context = session.workspace();
        let checked = session.check(targets);
        let task = Task::Write { force: false };
        if let Some(refusal) = options::missing(context, task, &checked) {
            return Err(refusal);
        }
        let mut diagnostics = Vec::new();
        let builder =
            JobBuilder { session, post_processor, join: None, sheet: task.sheets(&context.settings) };
        let mut jobs = Vec::new();
        for checked in checked.chunks(1) {
            match builder.job(checked) {
                Ok(job) => jobs.extend(job),
                Err(problems) => diagnostics.extend(problems),
            }
        }
        take_clashes(session, &mut jobs, &mut diagnostics);
        jobs.retain(|job| job.claim(session, owners, &mut diagnostics));
        let settings = OutputSettings::new(context, post_processor);
        let delivered = deliver(session, &jobs, task, &settings);
        diagnostics.extend(delivered.iter().flat_map(|delivered| &delivered.problems).cloned());
        Ok(Emission { delivered, removed: Vec::new(), outdated: Vec::new(), diagnostics })
    })
}
