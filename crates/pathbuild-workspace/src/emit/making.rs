//! Making programs: what is known of earlier runs is not made again.

use std::collections::HashMap;

use pathbuild_db::{Db, Target, check_file};
use pathbuild_diagnostic::Diagnostic;

use super::deliver::{Delivered, OutputSettings, Task};
use super::job::{Job, Known, Maker, take_clashes};
use super::store::{KnownPaths, Store, of};
use super::targets::Selection;
use super::write_queue::deliver_all;
use super::{Request, options};
use crate::session::{CheckedTarget, Found, Session};

/// What a run makes, and from what.
pub(super) struct Making<'a> {
    pub(super) request: &'a Request<'a>,
    /// What is known from earlier runs; `None` where everything is made.
    pub(super) store: Option<Store>,
    pub(super) found: Found,
}

/// What came of a run.
pub(super) struct RunResult {
    pub(super) asked: Selection,
    /// What was not known.
    pub(super) answers: Vec<Answer>,
    pub(super) jobs: Vec<Job>,
    /// Jobs that claim files of others, and are not done.
    pub(super) refused: Vec<Job>,
    /// What became of each job.
    pub(super) delivered: Vec<Delivered>,
    pub(super) diagnostics: Vec<Diagnostic>,
}

/// What was found now about paths that become one program.
pub(super) struct Answer {
    /// Each of the paths.
    pub(super) checked: Vec<CheckedTarget>,
    /// Why they become nothing, though they are right.
    pub(super) refusals: Vec<Diagnostic>,
}

impl Answer {
    /// What is wrong with the paths, and with the drawings that they are made from.
    pub(super) fn found(&self, session: &Session<'_>) -> Vec<Diagnostic> {
        self.checked.iter().flat_map(|checked| found(session, checked)).collect()
    }
}

/// What is wrong with a path, and with the drawings that it is made from.
pub(super) fn found(session: &Session<'_>, checked: &CheckedTarget) -> Vec<Diagnostic> {
    let of_files = checked.files.iter().flat_map(|file| check_file(session.db(), *file));
    of_files.chain(&checked.diagnostics).cloned().collect()
}

impl Making<'_> {
    /// Makes the programs of which not enough is known, and writes, compares or prints them.
    ///
    /// # Errors
    /// Why the arguments make no sense.
    pub(super) fn make(&self, session: &mut Session<'_>) -> Result<RunResult, String> {
        let Request { task, poster, join, .. } = *self.request;
        let mut diagnostics = self.found.problems.clone();
        let asked =
            Selection::new(session, self, &mut diagnostics).ok_or_else(|| nothing_to_emit(session))?;
        if task == Task::Print && join.is_none() && asked.targets.len() > 1 {
            let workspace = session.workspace();
            let reason = workspace.choose(
                "`-o -` writes one program: name one path",
                "`-o -` schreibt ein Programm: einen Pfad nennen",
            );
            return Err(reason.to_owned());
        }
        let mut planning = Planning { making: self, session, answers: Vec::new(), diagnostics };
        let mut jobs = planning.jobs(&self.programs(&asked.targets))?;
        in_order(&mut jobs, &asked.targets);
        let refused = take_clashes(session, &mut jobs, &mut planning.diagnostics);
        let clear = jobs.extract_if(.., |job| job.known == Known::Plan).map(|job| job.targets);
        let clear: Vec<Vec<Target>> = clear.collect();
        jobs.extend(planning.made(&clear)?);
        in_order(&mut jobs, &asked.targets);
        let Planning { answers, diagnostics, .. } = planning;
        if task == Task::Print && jobs.iter().any(|job| job.files.len() > 1) {
            let workspace = session.workspace();
            let reason = workspace.choose(
                "`-o -` writes one file: this path has Z-probes and becomes several files",
                "`-o -` schreibt eine Datei: dieser Pfad hat Z-Proben und ergibt mehrere",
            );
            return Err(reason.to_owned());
        }
        let means = OutputSettings::new(session.workspace(), poster);
        let delivered = deliver(session, &jobs, task, &means);
        Ok(RunResult { asked, answers, jobs, refused, delivered, diagnostics })
    }

    /// The paths of each program.
    fn programs(&self, targets: &[Target]) -> Vec<Vec<Target>> {
        match self.request.join {
            Some(_) if targets.is_empty() => Vec::new(),
            Some(_) => vec![targets.to_vec()],
            None => targets.iter().map(|target| vec![*target]).collect(),
        }
    }
}

/// Finding out what paths become.
struct Planning<'a> {
    making: &'a Making<'a>,
    session: &'a Session<'a>,
    answers: Vec<Answer>,
    diagnostics: Vec<Diagnostic>,
}

impl Planning<'_> {
    /// The jobs of programs, by what is known of their paths, and of the others by what is found now.
    fn jobs(&mut self, programs: &[Vec<Target>]) -> Result<Vec<Job>, String> {
        let Request { task, join, .. } = *self.making.request;
        let (mut jobs, mut open) = (Vec::new(), Vec::new());
        for targets in programs {
            let of = || of(self.session.db(), targets, join);
            let system = self.session.db().system();
            match self.making.store.as_ref().and_then(|store| store.paths(system, &of(), task)) {
                Some(KnownPaths { diagnostics, job }) => {
                    self.diagnostics.extend(diagnostics);
                    jobs.extend(job.map(|job| Job::known(targets.clone(), job)));
                }
                None => open.push(targets.clone()),
            }
        }
        // Their moves may be known of a run that asked for no times.
        let rapid = self.session.workspace().settings.general.rapid.value;
        if !jobs.is_empty() && rapid.is_none() && task.writes_times() {
            return Err(options::missing_values(self.session.workspace(), ["rapid"]));
        }
        jobs.extend(self.made(&open)?);
        Ok(jobs)
    }

    /// The same by what is found now.
    fn made(&mut self, programs: &[Vec<Target>]) -> Result<Vec<Job>, String> {
        let Request { task, poster, join, .. } = *self.making.request;
        let mut checked = self.session.check(&programs.concat());
        if let Some(refusal) = options::missing(self.session.workspace(), task, &checked) {
            return Err(refusal);
        }
        let maker = Maker {
            session: self.session,
            poster,
            join,
            sheet: task.sheets(&self.session.workspace().settings),
        };
        let mut jobs = Vec::new();
        let mut checked = checked.drain(..);
        for targets in programs {
            let checked: Vec<CheckedTarget> = checked.by_ref().take(targets.len()).collect();
            let (job, refusals) = match maker.job(&checked) {
                Ok(job) => (job, Vec::new()),
                Err(problems) => (None, problems),
            };
            let answer = Answer { checked, refusals };
            self.diagnostics.extend(answer.found(self.session));
            self.diagnostics.extend_from_slice(&answer.refusals);
            self.answers.push(answer);
            jobs.extend(job);
        }
        Ok(jobs)
    }
}

/// Puts jobs in the order of their targets.
fn in_order(jobs: &mut [Job], targets: &[Target]) {
    let places: HashMap<Target, usize> = targets.iter().copied().zip(0..).collect();
    jobs.sort_by_key(|job| places[&job.targets[0]]);
}

/// Does the jobs of which not everything is known; what became of each.
pub(super) fn deliver(
    session: &mut Session<'_>,
    jobs: &[Job],
    task: Task,
    means: &OutputSettings<'_>,
) -> Vec<Delivered> {
    let open: Vec<&Job> = jobs.iter().filter(|job| job.known == Known::Nothing).collect();
    let mut made = deliver_all(session, &open, task, means).into_iter();
    let delivered = jobs.iter().map(|job| match &job.known {
        Known::Program(known) => known.delivered(task),
        Known::Nothing | Known::Plan => made.next().unwrap_or_default(),
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
