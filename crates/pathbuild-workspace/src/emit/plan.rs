//! Plans programs: determines which files the paths become. (book: reference/commands, `emit`)

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::fmt::Write;
use std::slice;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::join;
use pathbuild_db::{
    Database, Db, Role, SecondDefinition, SourceFile, Target, Trace, path_names, second_definitions, trace,
};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::{outputs as messages, posts};
use pathbuild_gcode::native;
use pathbuild_path::PathName;
use serde::{Deserialize, Serialize};

use super::options;
use super::outcome::{ProgramOutcome, Task, is_of_other_version, write_error};
use super::select::TargetSelection;
use crate::common_findings::number_warnings;
use crate::config::types::SheetFormat;
use crate::memo::{Answer, Inputs, Memo, OutputState};
use crate::post_processor::PostProcessor;
use crate::session::{CheckedTarget, OutputKind, ProgramFacts, Session, stem_fault};
use crate::workspace::Workspace;

/// The plan for one program: its job, or the reasons why it has none.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(super) struct Plan {
    /// Diagnostics of the paths and of the drawings that they use.
    pub(super) diagnostics: Vec<Diagnostic>,
    /// Reasons why no program is generated, besides errors of the paths.
    pub(super) refusals: Vec<Diagnostic>,
    pub(super) job: Option<Job>,
}

/// A path without errors, or several such paths that are joined into one program, with the files to generate.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Job {
    /// The paths in milling order; never empty.
    #[serde(skip)]
    pub(super) targets: Vec<Target>,
    /// The drawings that were read for the paths, starting with the first path's own. Includes drawings that were searched for an embedded path but
    /// do not define it.
    #[serde(skip)]
    pub(super) sources: Vec<SourceFile>,
    /// Name of the path as the drawing spells it, or the name of the joined program.
    pub(super) path: Box<str>,
    /// Output directory, joined with the common stem of the file names.
    pub(super) stem: Utf8PathBuf,
    pub(super) files: Vec<(OutputKind, Utf8PathBuf)>,
    /// Title of the program, which the header of the file states after the provenance.
    #[serde(skip)]
    pub(super) title: String,
    /// Whether the job is left out although the paths have no errors: another job writes one of the same files, or the configuration turns a warning
    /// into an error.
    #[serde(skip)]
    pub(super) is_left_out: bool,
    /// The outcome of the job; `None` until its files are generated.
    pub(super) outcome: Option<ProgramOutcome>,
}

impl Plan {
    pub(super) fn problems(&self) -> impl Iterator<Item = &Diagnostic> {
        self.diagnostics.iter().chain(&self.refusals)
    }

    /// Returns the outcome of the job, unless the job is left out.
    pub(super) fn outcome(self) -> Option<ProgramOutcome> {
        self.job.filter(|job| !job.is_left_out)?.outcome
    }

    /// Returns the diagnostics of the program itself, without those of its paths.
    pub(super) fn program_problems(&self, workspace: &Workspace) -> Vec<Diagnostic> {
        let outcome = self.remaining_job().and_then(|job| job.outcome.as_ref());
        let problems = self.refusals.iter().chain(outcome.into_iter().flat_map(|outcome| &outcome.problems));
        problems.cloned().chain(self.lowered_error(workspace)).collect()
    }

    /// Leaves out the job if the configuration turns a warning into an error.
    pub(super) fn leave_out_if_raised(&mut self, workspace: &Workspace) {
        let is_wrong = workspace.has_error(self.problems());
        if let Some(job) = self.job.as_mut().filter(|_| is_wrong) {
            job.leave_out();
        }
    }

    /// Returns PB524 if the configuration lowers the severity of the errors that keep the program from being written.
    pub(super) fn lowered_error(&self, workspace: &Workspace) -> Option<Diagnostic> {
        let outcome = self.job.as_ref().and_then(|job| job.outcome.as_ref());
        let unwritten = outcome.filter(|outcome| outcome.files.is_empty());
        workspace.lowered_error(
            self.refusals.iter().chain(unwritten.into_iter().flat_map(|outcome| &outcome.problems)),
        )
    }

    pub(super) fn remaining_job(&self) -> Option<&Job> {
        self.job.as_ref().filter(|job| !job.is_left_out)
    }
}

impl Job {
    pub(super) fn drawing(&self, db: &Database) -> SourceFile {
        self.targets[0].file(db)
    }

    /// Leaves out the job, and discards the outcome of an earlier run, which may have written the files.
    pub(super) fn leave_out(&mut self) {
        self.is_left_out = true;
        self.outcome = None;
    }

    /// Leaves out the job if two drawings define one of its paths.
    pub(super) fn leave_out_if_defined_twice(
        &mut self,
        db: &Database,
        definitions: &BTreeSet<SecondDefinition>,
    ) {
        if definitions_of(db, &self.targets, definitions).next().is_some() {
            self.leave_out();
        }
    }

    fn name(&self, session: &Session<'_>) -> String {
        let db = session.db();
        format!("{} ({})", self.path, self.drawing(db).path(db))
    }
}

/// Plans the programs of a request. Cached plans are reused if they are still valid; the others are made from checked paths.
///
/// # Errors
/// If options are missing, with a message that names them.
pub(super) fn plan(
    builder: &JobBuilder<'_>,
    task: Task,
    memo: &Memo,
    targets: &[Target],
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Vec<Answer<Plan>>, String> {
    let JobBuilder { session, join, .. } = *builder;
    let workspace = session.workspace();
    let programs: Vec<&[Target]> = match join {
        Some(_) => targets.chunks(targets.len().max(1)).collect(),
        None => targets.chunks(1).collect(),
    };
    let mut refusal = None;
    let mut check = |open: &[&&[Target]]| -> Vec<(Plan, Inputs)> {
        let targets: Vec<Target> = open.iter().flat_map(|targets| targets.iter().copied()).collect();
        let mut checked = &*session.check(&targets);
        refusal = refusal.take().or_else(|| options::missing_options_error(workspace, task, checked));
        let plan = |targets: &&&[Target]| {
            let (own, rest) = checked.split_at(targets.len());
            checked = rest;
            (builder.plan(own), inputs(own))
        };
        open.iter().map(plan).collect()
    };
    let subject = |targets: &&[Target]| subject(session.db(), targets, join);
    let accept = |subject: &str, plan: Plan| cached_plan_if_sufficient(session, memo, task, subject, plan);
    let mut plans = memo.get_or(&programs, subject, accept, &mut check);
    for (answer, targets) in plans.iter_mut().zip(&programs) {
        if let Some(job) = &mut answer.value.job {
            job.targets = targets.to_vec();
            if let Some(outcome) = &mut job.outcome {
                outcome.path.clone_from(&job.path);
            }
        }
    }
    // The cached results may stem from a run that needed no times and therefore computed none.
    let is_timed = workspace.settings.general.rapid.value.is_some() || !task.writes_times();
    let is_cached = |answer: &Answer<Plan>| answer.inputs.is_none() && answer.value.job.is_some();
    if !is_timed && plans.iter().any(is_cached) {
        return Err(options::missing_values(workspace, ["rapid"]));
    }
    leave_out_clashes(session, jobs_mut(&mut plans), diagnostics);
    if let Some(join) = join {
        let jobs = jobs_mut(&mut plans);
        diagnostics.extend(jobs.filter_map(|job| leave_out_if_named_like_path(builder, join, job)));
    }
    // Plan again the jobs without an outcome: an earlier run left them out, perhaps because of a clash with a job that does not exist any more.
    for (answer, targets) in plans.iter_mut().zip(&programs) {
        let is_open = answer.value.remaining_job().is_some_and(|job| job.outcome.is_none());
        if answer.inputs.is_none()
            && is_open
            && let Some((plan, inputs)) = check(&[targets]).pop()
        {
            (answer.value, answer.inputs) = (plan, Some(inputs));
        }
    }
    for answer in &mut plans {
        answer.value.leave_out_if_raised(workspace);
    }
    refusal.map_or(Ok(plans), Err)
}

/// Returns the jobs of these plans.
pub(super) fn jobs_mut(plans: &mut [Answer<Plan>]) -> impl Iterator<Item = &mut Job> {
    plans.iter_mut().filter_map(|answer| answer.value.job.as_mut())
}

fn inputs(checked: &[CheckedTarget]) -> Inputs {
    let traces: Vec<Trace> = checked.iter().filter_map(|checked| checked.trace.clone()).collect();
    // A check that was aborted has no trace.
    let is_transient = traces.len() < checked.len();
    Inputs { traces, is_transient, ..Inputs::default() }
}

/// Returns the plan of an earlier run if it suffices for the task. It does not suffice if output files have changed on disk since, unless the task
/// compares them byte for byte.
fn cached_plan_if_sufficient(
    session: &Session<'_>,
    memo: &Memo,
    task: Task,
    subject: &str,
    mut plan: Plan,
) -> Option<Plan> {
    if let Some(Job { files, outcome: Some(outcome), .. }) = &mut plan.job
        && !outcome.problems.iter().any(Diagnostic::is_error)
    {
        // The configuration may have changed the severity of a warning since then.
        if session.workspace().has_error(&outcome.problems) {
            return None;
        }
        let states = memo.outputs(subject);
        if states.len() != files.len() {
            return None;
        }
        let files = files.iter().map(|(kind, path)| (*kind, path)).zip(states);
        let mut files = files.filter(|((kind, _), _)| task.covers(*kind));
        let system = session.db().system();
        let is_enough = |path: &Utf8Path, state: OutputState| match task {
            // A file with other bytes may contain the same program, written by another version.
            Task::Compare { moves_only: false } => {
                state != OutputState::Outdated || !is_of_other_version(system, path)
            }
            _ => state == OutputState::Current,
        };
        let known = |((_, path), state): ((_, &Utf8PathBuf), _)| {
            is_enough(path, state).then(|| (path.clone(), task.state_from_cache(state)))
        };
        outcome.files = files.by_ref().map(known).collect::<Option<_>>()?;
    }
    Some(plan)
}

/// Returns the cache subject of the paths of one program. It begins with the path of the first target's drawing, which ends at the first NUL.
fn subject(db: &Database, targets: &[Target], join: Option<&str>) -> Box<str> {
    let each = targets.iter().map(|target| format!("{}\0{}", target.file(db).path(db), target.name(db)));
    let mut subject = each.collect::<Vec<_>>().join("\0");
    if let Some(join) = join {
        _ = write!(subject, "\0\0{join}");
    }
    subject.into()
}

pub(super) struct JobBuilder<'a> {
    pub(super) session: &'a Session<'a>,
    /// The post-processor for the programs; `None` for native programs.
    pub(super) post_processor: Option<&'a PostProcessor>,
    /// Name of the program into which all paths are joined; `None` for one program per path.
    pub(super) join: Option<&'a str>,
    pub(super) sheet: SheetFormat,
}

impl JobBuilder<'_> {
    /// Returns the plan for the paths of one program. It has no job if any of the paths has errors.
    pub(super) fn plan(&self, checked: &[CheckedTarget]) -> Plan {
        let diagnostics = checked.iter().flat_map(|checked| self.session.path_diagnostics(checked)).collect();
        let job = match (self.join, checked) {
            (Some(name), checked) => self.joined_job(name, checked),
            (None, [checked]) => self.single_job(checked).map_err(|problem| vec![*problem]),
            (None, _) => Ok(None),
        };
        match job {
            Ok(job) => Plan { diagnostics, refusals: Vec::new(), job },
            Err(refusals) => Plan { diagnostics, refusals, job: None },
        }
    }

    /// Returns the job that `emit` performs for a path on its own; `None` if the path has errors, with the configured severities.
    ///
    /// # Errors
    /// The reasons why no program is generated, besides errors of the path.
    pub(super) fn own_job(&self, checked: &CheckedTarget) -> Result<Option<Job>, Vec<Diagnostic>> {
        let mut plan = self.plan(slice::from_ref(checked));
        plan.leave_out_if_raised(self.session.workspace());
        let Plan { refusals, job, .. } = plan;
        if refusals.is_empty() { Ok(job.filter(|job| !job.is_left_out)) } else { Err(refusals) }
    }

    fn joined_job(&self, name: &str, checked: &[CheckedTarget]) -> Result<Option<Job>, Vec<Diagnostic>> {
        let error_free = || checked.iter().filter_map(|checked| Some((checked, checked.emitted.as_ref()?)));
        let refused =
            error_free().filter_map(|(checked, emitted)| self.refuse_probes(checked, emitted).err());
        let refused: Vec<Diagnostic> = refused.map(|problem| *problem).collect();
        if !refused.is_empty() {
            return Err(refused);
        }
        let Some(first) = checked.first().filter(|_| error_free().count() == checked.len()) else {
            return Ok(None);
        };
        let db = self.session.db();
        let directory = output_directory(self.session.out_dir().as_deref(), first.target.file(db).path(db));
        let stem = join_file_name(name, name, &directory).map_err(|problem| vec![*problem])?;
        let title = native::joined_title(name, error_free().map(|(_, emitted)| &*emitted.path));
        Ok(Some(Job { title, ..self.with_files(stem, name, checked, &[OutputKind::Milling]) }))
    }

    fn single_job(&self, checked: &CheckedTarget) -> Result<Option<Job>, Box<Diagnostic>> {
        let Some(emitted) = &checked.emitted else { return Ok(None) };
        let db = self.session.db();
        let file = checked.target.file(db);
        let at = |problem: Box<Diagnostic>| Box::new(problem.in_file(file.path(db)).in_path(&emitted.path));
        let is_alone = path_names(db, file).len() == 1;
        let name = if is_alone { file.path(db).file_stem().unwrap_or_default() } else { &emitted.path };
        let directory = output_directory(self.session.out_dir().as_deref(), file.path(db));
        let full = format!("{name}{}", emitted.suffix);
        let stem =
            join_file_name(&full, if is_alone { &emitted.suffix } else { &full }, &directory).map_err(at)?;
        self.refuse_probes(checked, emitted)?;
        let kinds = OutputKind::of(emitted.has_probes);
        Ok(Some(self.with_files(stem, &emitted.path, slice::from_ref(checked), kinds)))
    }

    /// Returns an error if the path has probes and there is a post-processor: its output cannot contain formulas, so the probes would be measured for
    /// nothing.
    fn refuse_probes(&self, checked: &CheckedTarget, emitted: &ProgramFacts) -> Result<(), Box<Diagnostic>> {
        if self.post_processor.is_none() || !emitted.has_probes {
            return Ok(());
        }
        let db = self.session.db();
        let problem = Diagnostic::new(&posts::POST_WITH_PROBES).in_path(&emitted.path);
        Err(Box::new(problem.in_file(checked.target.file(db).path(db))))
    }

    fn with_files(
        &self,
        stem: Utf8PathBuf,
        path: &str,
        checked: &[CheckedTarget],
        kinds: &[OutputKind],
    ) -> Job {
        let name = |kind: &OutputKind| match self.post_processor {
            Some(post_processor) if kind.is_program() => post_output_file(&stem, post_processor),
            _ => kind.file(&stem),
        };
        let kinds = kinds.iter().copied().chain(OutputKind::of_sheet(self.sheet));
        let db = self.session.db();
        let drawing = checked[0].target.file(db).path(db).file_name().unwrap_or_default();
        Job {
            title: native::title(drawing, path),
            targets: checked.iter().map(|checked| checked.target).collect(),
            path: path.into(),
            files: kinds.map(|kind| (kind, name(&kind))).collect(),
            stem,
            sources: sources(db, checked),
            is_left_out: false,
            outcome: None,
        }
    }
}

/// Returns the drawings that were read for the paths, without duplicates.
fn sources(db: &Database, checked: &[CheckedTarget]) -> Vec<SourceFile> {
    let mut seen = HashSet::new();
    let read = checked.iter().flat_map(|checked| &trace(db, checked.target).files).copied();
    read.filter(|file| seen.insert(*file)).collect()
}

pub(super) fn post_output_file(stem: &Utf8Path, post_processor: &PostProcessor) -> Utf8PathBuf {
    OutputKind::Milling.file(stem).with_extension(post_processor.extension())
}

/// Returns the directory for the output files of a drawing's paths: the configured one, or else the drawing's own.
pub(super) fn output_directory(out_dir: Option<&Utf8Path>, drawing: &Utf8Path) -> Utf8PathBuf {
    out_dir.or(drawing.parent()).unwrap_or(Utf8Path::new("")).to_owned()
}

/// Leaves out jobs that would write the same file (PB514).
pub(super) fn leave_out_clashes<'p>(
    session: &Session<'_>,
    jobs: impl Iterator<Item = &'p mut Job>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let mut jobs: Vec<&mut Job> = jobs.collect();
    let (clashing, problems) = clashes(session, &jobs.iter().map(|job| &**job).collect::<Vec<_>>());
    diagnostics.extend(problems);
    for index in clashing {
        jobs[index].leave_out();
    }
}

/// Leaves out the job of a joined program that has the name of a path's program (PB514).
fn leave_out_if_named_like_path(builder: &JobBuilder<'_>, name: &str, job: &mut Job) -> Option<Diagnostic> {
    let JobBuilder { session, .. } = *builder;
    let db = session.db();
    let named = session.select(&crate::Inputs { inputs: vec![name.to_owned()] });
    let named = named.paths.into_iter().map(|path| path.file).chain(named.named);
    let drawings = job.targets.iter().map(|target| target.file(db)).chain(named);
    let path = jobs_with_same_files(builder, job, drawings).iter().map(|rival| rival.name(session)).min()?;
    let output = job.files.first().and_then(|(_, file)| file.file_name());
    let problem = Diagnostic::new(&messages::JOINED_LIKE_PATH).quoting("path", path);
    let problem = problem.quoting("name", output.unwrap_or_default()).in_file(job.drawing(db).path(db));
    job.leave_out();
    Some(problem)
}

/// Returns the definitions that are about one of these targets.
pub(super) fn definitions_of<'d>(
    db: &Database,
    targets: &[Target],
    definitions: &'d BTreeSet<SecondDefinition>,
) -> impl Iterator<Item = &'d SecondDefinition> {
    let is_of = |definition: &SecondDefinition, target: &Target| {
        definition.is_of(target.file(db).path(db), &PathName::new(target.name(db)))
    };
    definitions.iter().filter(move |definition| targets.iter().any(|target| is_of(definition, target)))
}

/// Leaves out the jobs of paths that two of the selected drawings define, and returns PB504 for these paths, including paths with errors, which have no
/// job: their programs could not be told apart. `are_together` says whether all programs are written into one directory.
pub(super) fn leave_out_second_definitions<'p>(
    db: &Database,
    selection: &TargetSelection,
    are_together: bool,
    jobs: impl Iterator<Item = &'p mut Job>,
) -> Vec<Diagnostic> {
    let names = selection.drawings().map(|answer| (answer.drawing(), &*answer.value.names));
    let found = second_definitions(db, names, are_together);
    let mut targets: Vec<Target> = selection.targets.clone();
    for job in jobs {
        // Two programs with one file name are reported already (PB514).
        if job.is_left_out {
            targets.retain(|target| !job.targets.contains(target));
        }
        job.leave_out_if_defined_twice(db, &found);
    }
    definitions_of(db, &targets, &found).map(SecondDefinition::diagnostic).collect()
}

/// Leaves out jobs whose file another drawing of the library, which has the same name, would write in another run (PB514). Only a configured output
/// directory can be shared in this way: one that is given on the command line is for this run only.
pub(super) fn leave_out_files_of_others<'p>(
    builder: &JobBuilder<'_>,
    jobs: impl Iterator<Item = &'p mut Job>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let JobBuilder { session, .. } = *builder;
    let db = session.db();
    if session.workspace().settings.general.out_dir.origin.line().is_none() {
        return;
    }
    let name = |drawing: &Utf8Path| drawing.file_name().unwrap_or_default().to_lowercase();
    let mut library: BTreeMap<String, Vec<Utf8PathBuf>> = BTreeMap::new();
    for drawing in session.library().0 {
        library.entry(name(&drawing)).or_default().push(drawing);
    }
    for job in jobs.filter(|job| !job.is_left_out) {
        let own = job.drawing(db).path(db);
        let canonical = db.system().canonical(own);
        let others = library.get(&name(own)).into_iter().flatten();
        let others = others.filter(|other| db.system().canonical(other) != canonical);
        let others = others.map(|other| session.file(other));
        if let Some(rival) = jobs_with_same_files(builder, job, others).first() {
            let output = job.files.first().and_then(|(_, file)| file.file_name());
            diagnostics.push(same_output_error(output, job.name(session), rival.name(session), own));
            job.leave_out();
        }
    }
}

/// Returns the jobs of all paths in these drawings, each for a program of its own, that would write one of the files of `job`.
fn jobs_with_same_files(
    builder: &JobBuilder<'_>,
    job: &Job,
    drawings: impl IntoIterator<Item = SourceFile>,
) -> Vec<Job> {
    let JobBuilder { session, .. } = *builder;
    let builder = JobBuilder { join: None, ..*builder };
    let drawings = drawings.into_iter();
    let targets: Vec<Target> = drawings.flat_map(|file| session.targets(file, &Role::Emitted)).collect();
    let checked = session.check(&targets);
    let jobs = checked.chunks(1).filter_map(|checked| builder.plan(checked).job);
    let names = |job: &Job| -> BTreeSet<String> {
        job.files.iter().map(|(_, path)| path.as_str().to_lowercase()).collect()
    };
    let own = names(job);
    jobs.filter(|rival| !names(rival).is_disjoint(&own)).collect()
}

/// Returns the indices of the jobs that would write the same file, with PB514 for each clash. Case is ignored, as some file systems ignore it.
pub(super) fn clashes(session: &Session<'_>, jobs: &[&Job]) -> (BTreeSet<usize>, Vec<Diagnostic>) {
    let mut owners: BTreeMap<String, (&Utf8Path, Vec<usize>)> = BTreeMap::new();
    for (index, job) in jobs.iter().enumerate() {
        for (_, path) in &job.files {
            owners.entry(path.as_str().to_lowercase()).or_insert((path, Vec::new())).1.push(index);
        }
    }
    let (mut clashing, mut problems) = (BTreeSet::new(), Vec::new());
    for (path, owners) in owners.into_values().filter(|(_, owners)| owners.len() > 1) {
        // If two jobs share several files, reporting the first one is enough.
        if owners.iter().any(|owner| !clashing.contains(owner)) {
            let [first, second] = [owners[0], owners[1]].map(|owner| jobs[owner].name(session));
            let drawing = jobs[owners[0]].drawing(session.db()).path(session.db());
            problems.push(same_output_error(path.file_name(), first, second, drawing));
        }
        clashing.extend(owners);
    }
    (clashing, problems)
}

/// Returns PB530 for the program numbers that several programs share, or that the control reserves for macros.
pub(super) fn warn_of_numbers(
    session: &Session<'_>,
    post_processor: Option<&PostProcessor>,
    jobs: &[&Job],
) -> Vec<Diagnostic> {
    let db = session.db();
    let numbered = |job: &&Job| {
        let names = [&*job.path, job.targets[0].name(db)];
        let number = names.iter().find_map(|name| post_processor?.program_number(name))?;
        Some((number, job.name(session), job.drawing(db).path(db).to_owned()))
    };
    let written = jobs.iter().filter(|job| !job.is_left_out);
    let numbers: Vec<_> = written.filter_map(numbered).collect();
    number_warnings(&numbers)
}

fn same_output_error(name: Option<&str>, first: String, second: String, drawing: &Utf8Path) -> Diagnostic {
    Diagnostic::new(&messages::SAME_OUTPUT)
        .quoting("name", name.unwrap_or_default())
        .quoting("first", first)
        .quoting("second", second)
        .in_file(drawing)
}

/// Joins a file name to a directory. Returns an error if the system forbids the name. `rest` is the part of the name that does not come from the
/// drawing's file name.
fn join_file_name(name: &str, rest: &str, directory: &Utf8Path) -> Result<Utf8PathBuf, Box<Diagnostic>> {
    if let Some(fault) = stem_fault(name, rest) {
        return Err(Box::new(write_error(name, fault)));
    }
    Ok(join(directory, name))
}
