//! `emit`: generates the programs of paths, and writes, compares or prints them. (book: reference/commands, `emit`; book: program/gcode)
//!
//! Stages: `select` the paths, `plan` their programs, `build` those that are not cached, `settle` the files.

mod build;
mod comparison;
mod deps;
mod joined;
mod options;
mod outcome;
mod plan;
mod program_scenes;
mod select;
mod settle;
mod sheet;
mod stale_programs;
mod written_programs;

use std::collections::HashMap;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::Target;
use pathbuild_db::system::FileKind;
use pathbuild_diagnostic::Diagnostic;

use crate::Inputs;
use crate::config::ResultKind;
use crate::config::types::SheetFormat;
use crate::memo::{Answer, Memo, is_transient};
use crate::post_processor::{PostArguments, PostProcessor};
use crate::session::{ArgumentMatches, CheckedTarget, Session};
use crate::workspace::{Failure, Workspace};

pub use build::program_remarks;
pub use comparison::{DrawingComparison, compare_with_drawing, native_text};
pub use options::{Provenances, missing_values, write_settings};
pub use outcome::{ProgramOutcome, State, Task};
use plan::{
    Job, JobBuilder, Plan, jobs_mut, leave_out_files_of_others, leave_out_second_definitions, plan,
    warn_of_numbers,
};
pub use program_scenes::{SceneReport, SheetOutcome, ShownText, sheet_of};
pub use select::TargetPatterns;
use select::TargetSelection;
use settle::{build_and_settle, lost_values_problem};
pub use sheet::sheet_bytes;
pub(crate) use stale_programs::program_of_other_path;
use stale_programs::{EarlierPrograms, StaleOutcome, has_stale_adjusted_program, report_unselected};
pub use written_programs::{CoveredDrawings, WrittenPrograms};

/// A request to emit programs.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// The task to perform with the generated files.
    pub task: Task,
    /// Name or file of the post-processor that replaces the configured one; `None` for the configured one.
    pub post: Option<String>,
    /// Arguments for the post-processor; native programs ignore them.
    pub post_arguments: PostArguments,
    /// Name of the program into which all paths are joined, in the order of the inputs; `None` for one program per path.
    pub join: Option<String>,
    /// Dependency file to write for `make` and `ninja`.
    pub deps: Option<Utf8PathBuf>,
    /// Whether to remove stale programs.
    pub removes_stale: bool,
}

/// The programs of a run of `emit`, with their diagnostics.
#[derive(Debug)]
pub struct Emission {
    /// The outcome of each program, in the order of the targets, followed by earlier programs of paths that this run could not write.
    pub delivered: Vec<ProgramOutcome>,
    /// Stale programs that were removed.
    pub removed: Vec<Utf8PathBuf>,
    /// Stale programs that are reported as errors (PB520), as they are in a comparison.
    pub outdated: Vec<Utf8PathBuf>,
    /// All diagnostics, unsorted, with duplicates.
    pub diagnostics: Vec<Diagnostic>,
}

impl Request {
    /// Whether results of earlier runs may be used, provided that the session traces inputs. If not, everything is regenerated.
    pub fn uses_cache(&self) -> bool {
        let is_always_made = matches!(self.task, Task::Print | Task::Write { force: true })
            || self.deps.is_some()
            || self.post_arguments.run_post_build;
        !is_always_made
    }

    /// Emits the programs of these drawings, paths and directories, or without inputs those of the paths matched by `[emit] targets`. The session
    /// must trace inputs if results are to be cached.
    ///
    /// # Errors
    /// If the request or the post-processor is invalid, with the reason.
    pub fn run(&self, session: &mut Session<'_>, inputs: &Inputs) -> Result<Emission, Failure> {
        let workspace = session.workspace();
        let post = self.post.as_deref();
        let post_processor = PostProcessor::for_run(workspace, post, self.post_arguments.clone());
        let post_processor = post_processor.map_err(Failure::Post)?;
        if let Some(refusal) = self.reason_for_post_processor(workspace).filter(|_| post_processor.is_none())
        {
            return Err(Failure::Usage(refusal.to_owned()));
        }
        let post_processor = post_processor.as_ref();
        let emitter = Emitter { request: self, inputs, post_processor };
        let uses_cache = session.is_traced() && self.uses_cache();
        if !uses_cache {
            session.prefetch(inputs, &|_| false);
        }
        let mut matches = session.match_arguments(inputs);
        let memo = if uses_cache {
            // The cache itself accounts for drawings and settings. Besides these, only the post-processor affects a program.
            let query = post_processor.map_or_else(|| "emit".to_owned(), PostProcessor::cache_key);
            Memo::open(session, ResultKind::Emit, &query, inputs, &mut matches)
        } else {
            Memo::default()
        };
        let run = session.with_stable_files(|session| emitter.perform(session, &memo, &matches));
        Ok(emitter.conclude(session, &memo, &matches, run.map_err(Failure::Usage)?))
    }

    /// Returns the reason why the request needs a post-processor; `None` if it does not need one.
    fn reason_for_post_processor<'w>(&self, workspace: &'w Workspace) -> Option<&'w str> {
        if self.join.is_some() {
            return Some(workspace.choose(
                "--join needs --post (or `post` in pathbuild.toml): native programs have a single path and no tool changes",
                "--join braucht --post (oder `post` in pathbuild.toml): das native Programm hat nur einen Pfad und keine Werkzeugwechsel",
            ));
        }
        // The date is also that of waivers.
        let dated = PostArguments { date: self.post_arguments.date.clone(), ..PostArguments::default() };
        (self.post_arguments != dated).then(|| workspace.choose(
            "--dialect and --run-post-build apply to post-processors only: give --post, or set `post` in pathbuild.toml",
            "--dialect und --run-post-build gelten nur für Postprozessoren: --post angeben oder `post` in pathbuild.toml setzen",
        ))
    }
}

/// A request with its inputs and its post-processor; without one, native programs are written.
struct Emitter<'r> {
    request: &'r Request,
    inputs: &'r Inputs,
    post_processor: Option<&'r PostProcessor>,
}

impl Emitter<'_> {
    /// Selects the paths, plans their programs, and builds and settles those that are not cached.
    fn perform(
        &self,
        session: &mut Session<'_>,
        memo: &Memo,
        matches: &ArgumentMatches,
    ) -> Result<RunResults, String> {
        let (task, join) = (self.request.task, self.request.join.as_deref());
        let workspace = session.workspace();
        let mut diagnostics = matches.problems.clone();
        let selection = TargetSelection::new(session, memo, matches, join.is_some(), &mut diagnostics)
            .ok_or_else(|| nothing_to_emit_message(workspace).to_owned())?;
        let lacks_paths = join.is_some() && diagnostics.iter().any(Diagnostic::is_error);
        if task == Task::Print && join.is_none() && selection.targets.len() > 1 {
            return Err(several_programs_message(workspace).to_owned());
        }
        let sheet = task.sheets(&workspace.settings);
        let builder = JobBuilder { session, post_processor: self.post_processor, join, sheet };
        let mut plans = plan(&builder, task, memo, &selection.targets, &mut diagnostics)?;
        if lacks_paths {
            jobs_mut(&mut plans).for_each(Job::leave_out);
        }
        self.leave_out_ambiguous(&builder, matches, &selection, &mut plans, &mut diagnostics);
        let jobs: Vec<&Job> = plans.iter().filter_map(|plan| plan.value.job.as_ref()).collect();
        diagnostics.extend(warn_of_numbers(session, self.post_processor, &jobs));
        diagnostics.extend(plans.iter().flat_map(|plan| plan.value.problems()).cloned());
        let mut remaining = plans.iter().filter_map(|plan| plan.value.remaining_job());
        if task == Task::Print && remaining.any(|job| job.files.len() > 1) {
            return Err(several_files_message(workspace).to_owned());
        }
        build_and_settle(session, jobs_mut(&mut plans), task, self.post_processor);
        for answer in &mut plans {
            complete_inputs(answer, task);
        }
        Ok(RunResults { selection, plans, diagnostics })
    }

    /// Leaves out jobs whose paths several drawings define, and those whose files would replace programs of other paths.
    fn leave_out_ambiguous(
        &self,
        builder: &JobBuilder<'_>,
        matches: &ArgumentMatches,
        selection: &TargetSelection,
        plans: &mut [Answer<Plan>],
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let Request { task, join, .. } = self.request;
        let are_together = builder.session.out_dir().is_some() && join.is_none();
        let db = builder.session.db();
        diagnostics.extend(leave_out_second_definitions(db, selection, are_together, jobs_mut(plans)));
        if !matches.is_library && *task != Task::Print {
            leave_out_files_of_others(builder, jobs_mut(plans), diagnostics);
        }
    }

    /// Settles the stale programs of earlier runs, writes the dependency file, and caches the results of this run.
    fn conclude(
        &self,
        session: &mut Session<'_>,
        memo: &Memo,
        matches: &ArgumentMatches,
        run: RunResults,
    ) -> Emission {
        let RunResults { selection, mut plans, mut diagnostics } = run;
        let (task, workspace) = (self.request.task, session.workspace());
        report_cached(workspace, &selection, &plans);
        // A dependency file that lacks the rules of a path with errors would keep a build system from building the program of this path again.
        let has_all_rules = !workspace.has_error(&diagnostics)
            && plans.iter().all(|plan| plan.value.remaining_job().is_some());
        self.add_compatible_notes(workspace, &mut plans);
        let jobs: Vec<&Job> = plans.iter().filter_map(|plan| plan.value.job.as_ref()).collect();
        let StaleOutcome { older, removed, outdated, .. } =
            self.settle_stale_programs(session, matches, &selection, &jobs, &mut diagnostics);
        diagnostics.extend(plans.iter().filter_map(|plan| plan.value.lowered_error(workspace)));
        let outcomes = jobs.iter().filter_map(|job| job.outcome.as_ref()).chain(&older);
        diagnostics.extend(outcomes.flat_map(|outcome| &outcome.problems).cloned());
        if let Some(file) = self.request.deps.as_ref().filter(|_| has_all_rules) {
            let jobs = plans.iter().filter_map(|plan| plan.value.remaining_job());
            diagnostics.extend(deps::write(session, file, jobs, self.post_processor));
        }
        let drawings = selection.drawings().filter_map(Answer::fresh);
        memo.store_results(session, drawings.chain(plans.iter().filter_map(Answer::fresh)));
        let mut delivered: Vec<ProgramOutcome> =
            plans.into_iter().filter_map(|plan| plan.value.outcome()).collect();
        delivered.extend(older);
        if task.is_comparison() {
            report_not_current(workspace, &delivered, &mut diagnostics);
        }
        Emission { delivered, removed, outdated, diagnostics: session.with_hints(diagnostics) }
    }

    /// Adds a note to each problem of a file that equals the program written with `--compatible`, if moves are compared.
    fn add_compatible_notes(&self, workspace: &Workspace, plans: &mut [Answer<Plan>]) {
        if self.request.task != (Task::Compare { moves_only: true }) {
            return;
        }
        let request = Request { deps: None, removes_stale: false, ..self.request.clone() };
        let emit = |workspace: &Workspace| {
            let emission = request.run(&mut Session::new(workspace), self.inputs);
            emission.map(|emission| emission.delivered).unwrap_or_default()
        };
        comparison::add_compatible_notes(workspace, jobs_mut(plans), emit);
    }

    /// Settles the stale programs of earlier runs, including those of paths that this run does not select.
    fn settle_stale_programs(
        &self,
        session: &mut Session<'_>,
        matches: &ArgumentMatches,
        selection: &TargetSelection,
        jobs: &[&Job],
        diagnostics: &mut Vec<Diagnostic>,
    ) -> StaleOutcome {
        let earlier = EarlierPrograms {
            session,
            task: self.request.task,
            post_processor: self.post_processor,
            join: self.request.join.as_deref(),
            targets: &selection.targets,
            arguments: &matches.arguments,
            named: &selection.named,
            covered: &|| &selection.covered,
            directories: &selection.directories,
            jobs,
        };
        let mut outcome = earlier.find_and_settle(self.request.removes_stale, diagnostics);
        let unselected = report_unselected(session, &outcome.unselected, &mut HashMap::new());
        let errors = unselected.iter().filter(|finding| session.workspace().has_error([*finding]));
        outcome.outdated.extend(errors.filter_map(|finding| finding.file.clone()));
        diagnostics.extend(unselected);
        outcome
    }
}

fn nothing_to_emit_message(workspace: &Workspace) -> &str {
    workspace.choose(
        "nothing to emit: name drawings, paths or directories, or set `library` and `[emit] targets` in pathbuild.toml",
        "nichts zu schreiben: Zeichnungen, Pfade oder Verzeichnisse nennen oder `library` und `[emit] targets` in pathbuild.toml setzen",
    )
}

fn several_programs_message(workspace: &Workspace) -> &str {
    workspace.choose(
        "`-o -` writes a single program: name a single path",
        "`-o -` schreibt ein einzelnes Programm: nur einen Pfad nennen",
    )
}

fn several_files_message(workspace: &Workspace) -> &str {
    workspace.choose(
        "`-o -` writes a single file: the program of this path has Z-probes and consists of several files",
        "`-o -` schreibt eine einzelne Datei: das Programm dieses Pfads hat Z-Proben und besteht aus mehreren Dateien",
    )
}

/// The results of [`Emitter::perform`], with which [`Emitter::conclude`] goes on.
struct RunResults {
    selection: TargetSelection,
    plans: Vec<Answer<Plan>>,
    diagnostics: Vec<Diagnostic>,
}

/// Completes the recorded inputs of a plan with the files that its program inserts and the generated files.
fn complete_inputs(answer: &mut Answer<Plan>, task: Task) {
    let Some(inputs) = &mut answer.inputs else { return };
    let job = answer.value.remaining_job();
    let outcome = job.and_then(|job| job.outcome.as_ref());
    let problems = outcome.into_iter().flat_map(|outcome| &outcome.problems);
    inputs.is_transient |= answer.value.problems().chain(problems).any(is_transient);
    let (Some(job), Some(outcome)) = (job, outcome) else { return };
    inputs.further.clone_from(&outcome.inserted);
    if outcome.is_complete(job.files.len()) {
        inputs.outputs = outcome.generated(task);
    } else {
        // A refused program is refused again until its inputs change, so its result can be cached; a failed write may succeed in another run.
        inputs.is_transient |= !outcome.is_refused;
    }
}

/// Adds PB528 for each file that a comparison found missing or different, unless an error about this file is reported already. If `emit` would refuse
/// to replace the file, adds its error instead.
fn report_not_current(workspace: &Workspace, outcomes: &[ProgramOutcome], diagnostics: &mut Vec<Diagnostic>) {
    let mut by_file: HashMap<&Utf8Path, Vec<&Diagnostic>> = HashMap::new();
    for diagnostic in &*diagnostics {
        if let Some(file) = &diagnostic.file {
            by_file.entry(file).or_default().push(diagnostic);
        }
    }
    let is_known = |finding: &Diagnostic| {
        let known = finding.file.as_deref().and_then(|file| by_file.get(file));
        known.is_some_and(|known| workspace.has_error(known.iter().copied()))
    };
    let refusal = |finding: &Diagnostic| lost_values_problem(&*workspace.system, finding.file.as_ref()?);
    let findings =
        outcomes.iter().flat_map(ProgramOutcome::not_current_findings).filter(|finding| !is_known(finding));
    let new: Vec<Diagnostic> = findings.map(|finding| refusal(&finding).unwrap_or(finding)).collect();
    diagnostics.extend(new);
}

fn report_cached(context: &Workspace, selection: &TargetSelection, plans: &[Answer<Plan>]) {
    // Each plan is for one path, or for all paths if they are joined.
    let paths = selection.targets.len() / plans.len().max(1);
    let open = paths * plans.iter().filter(|plan| plan.inputs.is_some()).count();
    let drawings = selection.drawings().count();
    let read = selection.drawings().filter(|drawing| drawing.inputs.is_some()).count();
    context.report_cached(["paths", "Pfade"], selection.targets.len() - open, selection.targets.len());
    let phrase =
        context.choose("drawings known from the cache", "Zeichnungen, die aus dem Cache bekannt sind");
    context.reporter.detail(&format!("{phrase}: {} / {drawings}", drawings - read));
}

/// For each target with a program on disk, returns whether that program is up to date, or the errors that keep it from being generated; there are none
/// if an option that its moves depend on is not set. Without `rapid`, which only times depend on, moves are compared.
pub(crate) fn freshness_on_disk(
    session: &mut Session<'_>,
    post_processor: Option<&PostProcessor>,
    targets: &[Target],
) -> HashMap<Target, Result<bool, Vec<Diagnostic>>> {
    let checked = session.check(targets);
    let builder = JobBuilder { session, post_processor, join: None, sheet: SheetFormat::No };
    let job = |checked: &CheckedTarget| {
        let mut job = builder.own_job(checked).ok()??;
        job.is_left_out = !checked.missing_options.is_empty();
        Some(job)
    };
    let jobs = checked.iter().filter_map(job);
    let system = &*session.workspace().system;
    let is_there = |job: &Job| job.files.iter().any(|(_, path)| system.kind(path) == FileKind::File);
    let mut jobs: Vec<Job> = jobs.filter(is_there).collect();
    let moves_only = session.workspace().settings.general.rapid.value.is_none();
    build_and_settle(session, jobs.iter_mut(), Task::Compare { moves_only }, post_processor);
    let is_stale = |job: &Job| has_stale_adjusted_program(session, post_processor, job);
    let jobs: Vec<(bool, Job)> = jobs.into_iter().map(|job| (is_stale(&job), job)).collect();
    let state = |(is_stale, job): (bool, Job)| {
        let is_current = job.outcome.map_or_else(|| Err(Vec::new()), is_current);
        (job.targets[0], is_current.map(|is_current| is_current && !is_stale))
    };
    jobs.into_iter().map(state).collect()
}

/// Whether all files of a program are up to date.
///
/// # Errors
/// The errors of a program that was not generated.
fn is_current(outcome: ProgramOutcome) -> Result<bool, Vec<Diagnostic>> {
    if outcome.files.is_empty() && !outcome.problems.is_empty() {
        return Err(outcome.problems);
    }
    let is_current = |(_, state): &(_, State)| matches!(state, State::Current);
    Ok(!outcome.files.is_empty() && outcome.files.iter().all(is_current))
}
