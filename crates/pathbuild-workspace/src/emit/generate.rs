//! Plans and generates programs; results of earlier runs are reused.

use std::collections::HashMap;

use pathbuild_db::{Db, Target, check_file};
use pathbuild_diagnostic::Diagnostic;

use super::deliver::{OutputSettings, ProgramOutcome, Task};
use super::job::{CachedOutcome, Job, JobBuilder, take_clashes};
use super::store::{CachedPaths, Store, subject};
use super::targets::TargetSelection;
use super::write_queue::deliver_all;
use super::{Request, options};
use crate::session::{ArgumentMatches, CheckedTarget, Session};

/// Context of a run of `emit`.
pub(super) struct EmitContext<'a> {
    pub(super) request: &'a Request<'a>,
    /// Cached results of earlier runs; `None` if everything is regenerated.
    pub(super) store: Option<Store>,
    pub(super) found: ArgumentMatches,
}

/// The outcome of a run.
pub(super) struct EmitResult {
    pub(super) selection: TargetSelection,
    /// Results that were not cached.
    pub(super) answers: Vec<CheckedProgram>,
    pub(super) jobs: Vec<Job>,
    /// Jobs that were dropped because they claim files of other jobs.
    pub(super) refused: Vec<Job>,
    /// The outcome of each job.
    pub(super) delivered: Vec<ProgramOutcome>,
    pub(super) diagnostics: Vec<Diagnostic>,
}

/// The result of checking the paths of one program.
pub(super) struct CheckedProgram {
    pub(super) checked: Vec<CheckedTarget>,
    /// Why no program is generated although the paths have no errors.
    pub(super) refusals: Vec<Diagnostic>,
}

impl CheckedProgram {
    /// Diagnostics of the paths and of the drawings that they use.
    pub(super) fn found(&self, session: &Session<'_>) -> Vec<Diagnostic> {
        self.checked.iter().flat_map(|checked| found(session, checked)).collect()
    }
}

/// Diagnostics of a path and of the drawings that it uses.
pub(super) fn found(session: &Session<'_>, checked: &CheckedTarget) -> Vec<Diagnostic> {
    let of_files = checked.files.iter().flat_map(|file| check_file(session.db(), *file));
    of_files.chain(&checked.diagnostics).cloned().collect()
}

impl EmitContext<'_> {
    /// Generates the programs that are not cached, and writes, compares or prints all of them.
    ///
    /// # Errors
    /// If the arguments make no sense; the text says why.
    pub(super) fn make(&self, session: &mut Session<'_>) -> Result<EmitResult, String> {
        let Request { task, post_processor, join, .. } = *self.request;
        let mut diagnostics = self.found.problems.clone();
        let selection =
            TargetSelection::new(session, self, &mut diagnostics).ok_or_else(|| nothing_to_emit(session))?;
        if task == Task::Print && join.is_none() && selection.targets.len() > 1 {
            let workspace = session.workspace();
            let reason = workspace.choose(
                "`-o -` writes a single program: name a single path",
                "`-o -` schreibt ein einzelnes Programm: nur einen Pfad nennen",
            );
            return Err(reason.to_owned());
        }
        let mut planner = Planner { context: self, session, answers: Vec::new(), diagnostics };
        let mut jobs = planner.jobs(&self.programs(&selection.targets))?;
        sort_by_target(&mut jobs, &selection.targets);
        let refused = take_clashes(session, &mut jobs, &mut planner.diagnostics);
        let clear = jobs.extract_if(.., |job| job.known == CachedOutcome::Plan).map(|job| job.targets);
        let clear: Vec<Vec<Target>> = clear.collect();
        jobs.extend(planner.check(&clear)?);
        sort_by_target(&mut jobs, &selection.targets);
        let Planner { answers, diagnostics, .. } = planner;
        if task == Task::Print && jobs.iter().any(|job| job.files.len() > 1) {
            let workspace = session.workspace();
            let reason = workspace.choose(
                "`-o -` writes a single file: the program of this path has Z-probes and consists of several files",
                "`-o -` schreibt eine einzelne Datei: das Programm dieses Pfads hat Z-Proben und besteht aus mehreren Dateien",
            );
            return Err(reason.to_owned());
        }
        let settings = OutputSettings::new(session.workspace(), post_processor);
        let delivered = deliver(session, &jobs, task, &settings);
        Ok(EmitResult { selection, answers, jobs, refused, delivered, diagnostics })
    }

    /// Groups the targets by program.
    fn programs(&self, targets: &[Target]) -> Vec<Vec<Target>> {
        match self.request.join {
            Some(_) if targets.is_empty() => Vec::new(),
            Some(_) => vec![targets.to_vec()],
            None => targets.iter().map(|target| vec![*target]).collect(),
        }
    }
}

/// State while planning which files the paths become.
struct Planner<'a> {
    context: &'a EmitContext<'a>,
    session: &'a Session<'a>,
    answers: Vec<CheckedProgram>,
    diagnostics: Vec<Diagnostic>,
}

impl Planner<'_> {
    /// The jobs of these programs, from the cache where possible.
    fn jobs(&mut self, programs: &[Vec<Target>]) -> Result<Vec<Job>, String> {
        let Request { task, join, .. } = *self.context.request;
        let (mut jobs, mut open) = (Vec::new(), Vec::new());
        for targets in programs {
            let subject = || subject(self.session.db(), targets, join);
            let system = self.session.db().system();
            match self.context.store.as_ref().and_then(|store| store.paths(system, &subject(), task)) {
                Some(CachedPaths { diagnostics, job }) => {
                    self.diagnostics.extend(diagnostics);
                    jobs.extend(job.map(|job| Job::known(targets.clone(), job)));
                }
                None => open.push(targets.clone()),
            }
        }
        // The cached moves may stem from a run that needed no times.
        let rapid = self.session.workspace().settings.general.rapid.value;
        if !jobs.is_empty() && rapid.is_none() && task.writes_times() {
            return Err(options::missing_values(self.session.workspace(), ["rapid"]));
        }
        jobs.extend(self.check(&open)?);
        Ok(jobs)
    }

    /// Checks the programs and returns their jobs.
    fn check(&mut self, programs: &[Vec<Target>]) -> Result<Vec<Job>, String> {
        let Request { task, post_processor, join, .. } = *self.context.request;
        let mut checked = self.session.check(&programs.concat());
        if let Some(refusal) = options::missing(self.session.workspace(), task, &checked) {
            return Err(refusal);
        }
        let builder = JobBuilder {
            session: self.session,
            post_processor,
            join,
            sheet: task.sheets(&self.session.workspace().settings),
        };
        let mut jobs = Vec::new();
        let mut checked = checked.drain(..);
        for targets in programs {
            let checked: Vec<CheckedTarget> = checked.by_ref().take(targets.len()).collect();
            let (job, refusals) = match builder.job(&checked) {
                Ok(job) => (job, Vec::new()),
                Err(problems) => (None, problems),
            };
            let answer = CheckedProgram { checked, refusals };
            self.diagnostics.extend(answer.found(self.session));
            self.diagnostics.extend_from_slice(&answer.refusals);
            self.answers.push(answer);
            jobs.extend(job);
        }
        Ok(jobs)
    }
}

/// Sorts jobs in the order of their targets.
fn sort_by_target(jobs: &mut [Job], targets: &[Target]) {
    let places: HashMap<Target, usize> = targets.iter().copied().zip(0..).collect();
    jobs.sort_by_key(|job| places[&job.targets[0]]);
}

/// Generates the jobs that are not cached. Returns the outcome of every job.
pub(super) fn deliver(
    session: &mut Session<'_>,
    jobs: &[Job],
    task: Task,
    settings: &OutputSettings<'_>,
) -> Vec<ProgramOutcome> {
    let open: Vec<&Job> = jobs.iter().filter(|job| job.known == CachedOutcome::Nothing).collect();
    let mut outcomes = deliver_all(session, &open, task, settings).into_iter();
    let delivered = jobs.iter().map(|job| match &job.known {
        CachedOutcome::Program(known) => known.delivered(task),
        CachedOutcome::Nothing | CachedOutcome::Plan => outcomes.next().unwrap_or_default(),
    });
    delivered.collect()
}

fn nothing_to_emit(session: &Session<'_>) -> String {
    let reason = session.workspace().choose(
        "nothing to emit: name drawings, paths or directories, or set `library` and `[emit] targets` in pathbuild.toml",
        "nichts zu schreiben: Zeichnungen, Pfade oder Verzeichnisse nennen oder `library` und `[emit] targets` in pathbuild.toml setzen",
    );
    reason.to_owned()
}
