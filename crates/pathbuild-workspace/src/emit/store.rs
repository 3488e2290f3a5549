//! Cached results of earlier runs of `emit`: the paths of each drawing, and for each path its diagnostics and files. Drawings and programs
//! whose inputs are unchanged are neither read nor rebuilt.

use std::collections::HashMap;
use std::fmt::Write;

use crate::config::ResultKind;
use crate::session::{
    CacheQuery, Drawing, DrawingResult, ExtraInput, FreshResult, GeneratedFile, OutputKind, OutputState,
    ResultStore, Scope, Session, is_transient,
};
use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::{Listings, decode, encode};
use pathbuild_db::{Database, System, Target, Trace};
use pathbuild_diagnostic::{Diagnostic, Note};
use pathbuild_gcode::provenance::Provenance;
use serde::{Deserialize, Serialize};

use super::CheckedProgram;
use super::deliver::{ProgramOutcome, State, Task, is_of_other_version};
use super::job::Job;
use super::targets::TargetSelection;
use crate::posting::{InsertedFile, PostProcessor};
use crate::workspace::Workspace;

/// The cached results of earlier runs with the same settings.
pub(super) struct Store(ResultStore);

/// The cached result of the paths of one program.
#[derive(Serialize, Deserialize)]
pub(super) struct CachedPaths {
    /// Diagnostics of the paths and of what they embed, and reasons why no program is generated.
    pub(super) diagnostics: Vec<Diagnostic>,
    /// The job; `None` if no program is generated.
    pub(super) job: Option<CachedJob>,
}

/// The cached part of a job.
#[derive(Serialize, Deserialize)]
pub(super) struct CachedJob {
    /// Name of the path, as the drawing spells it.
    pub(super) path: Box<str>,
    /// Output directory and common stem of the file names.
    pub(super) stem: Utf8PathBuf,
    /// The files, with their kinds.
    pub(super) files: Vec<(OutputKind, Utf8PathBuf)>,
    /// The outcome; `None` if the job was dropped.
    pub(super) program: Option<CachedProgram>,
}

/// The cached outcome of a program.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct CachedProgram {
    /// Current state of each file on disk; empty if the program has errors.
    #[serde(skip)]
    files: Vec<(OutputKind, Utf8PathBuf, OutputState)>,
    /// In mm.
    length: f64,
    minutes: f64,
    /// Warnings and errors of the program.
    problems: Vec<Diagnostic>,
    notes: Vec<Note>,
    provenance: Option<Provenance>,
}

impl Store {
    /// Loads the cached results of these drawings; `None` if nothing can be cached.
    pub(super) fn open(
        workspace: &Workspace,
        post_processor: Option<&PostProcessor>,
        scope: Scope,
        listings: Listings,
    ) -> Option<Self> {
        let text = query(post_processor);
        let query = CacheQuery { result_kind: ResultKind::Emit, text: &text, scope, listings };
        ResultStore::open(workspace, query).map(Self)
    }

    /// The cached paths of a drawing.
    pub(super) fn drawing(&self, drawing: &Utf8Path) -> Option<DrawingResult> {
        DrawingResult::decode(self.0.payload(drawing.as_str())?).ok()
    }

    /// The cached result of the paths of one program, if it suffices for the task. Before writing, a program is regenerated if one of its
    /// files has changed.
    pub(super) fn paths(&self, system: &dyn System, subject: &str, task: Task) -> Option<CachedPaths> {
        let mut cached: CachedPaths = decode(self.0.payload(subject)?).ok()?;
        if let Some(CachedJob { files, program: Some(program), .. }) = &mut cached.job
            && !program.is_wrong()
        {
            let states = self.0.outputs(subject);
            if states.len() != files.len() {
                return None;
            }
            let states = files.iter().zip(states).map(|((kind, path), state)| (*kind, path.clone(), state));
            program.files = states.collect();
            let is_enough = match task {
                // The file may contain the same program written by another version.
                Task::Compare { moves_only: false } => {
                    program.outdated().all(|path| !is_of_other_version(system, path))
                }
                _ => program.is_current(task),
            };
            if !is_enough {
                return None;
            }
        }
        Some(cached)
    }

    /// Stores the results computed in this run.
    pub(super) fn keep(&self, session: &Session<'_>, run: &RunRecord<'_>) {
        let drawing = |Drawing { path, result, .. }: &Drawing| FreshResult {
            subject: path.as_str().into(),
            traces: vec![Trace { files: vec![session.file(path)], lookups: Vec::new() }],
            payload: result.encode(),
            ..FreshResult::default()
        };
        let mut fresh: Vec<FreshResult> =
            run.selection.drawings().filter(|drawing| drawing.is_read).map(drawing).collect();
        let done = run.jobs.iter().zip(run.delivered).map(|(job, delivered)| (job, Some(delivered)));
        let all = done.chain(run.refused.iter().map(|job| (job, None)));
        let jobs: HashMap<&[Target], (&Job, Option<&ProgramOutcome>)> =
            all.map(|(job, delivered)| (&*job.targets, (job, delivered))).collect();
        fresh.extend(run.answers.iter().map(|answer| run.fresh_result(session, answer, &jobs)));
        self.0.keep(session, &fresh);
    }
}

/// The outcome of a run, to be cached.
pub(super) struct RunRecord<'a> {
    pub(super) task: Task,
    pub(super) join: Option<&'a str>,
    pub(super) post_processor: Option<&'a PostProcessor>,
    pub(super) selection: &'a TargetSelection,
    /// Results that were not cached.
    pub(super) answers: &'a [CheckedProgram],
    pub(super) jobs: &'a [Job],
    /// The outcome of each job.
    pub(super) delivered: &'a [ProgramOutcome],
    /// Jobs that were dropped.
    pub(super) refused: &'a [Job],
}

impl RunRecord<'_> {
    fn fresh_result(
        &self,
        session: &Session<'_>,
        answer: &CheckedProgram,
        jobs: &HashMap<&[Target], (&Job, Option<&ProgramOutcome>)>,
    ) -> FreshResult {
        let targets: Vec<Target> = answer.checked.iter().map(|checked| checked.target).collect();
        let subject = subject(session.db(), &targets, self.join).into();
        let traces: Vec<Trace> = answer.checked.iter().filter_map(|checked| checked.trace.clone()).collect();
        let mut diagnostics = answer.found(session);
        diagnostics.extend_from_slice(&answer.refusals);
        let job = jobs.get(&*targets).copied();
        let problems =
            job.and_then(|(_, delivered)| delivered).into_iter().flat_map(|outcome| &outcome.problems);
        let is_lasting =
            traces.len() == targets.len() && !diagnostics.iter().chain(problems).any(is_transient);
        let (further, outputs) = match job {
            _ if !is_lasting => return FreshResult { subject, ..FreshResult::default() },
            Some((job, Some(delivered))) if is_complete(job, delivered) => {
                (self.inserted(session, delivered), outputs(delivered, self.task))
            }
            // The post-processor may accept the program once other files change.
            Some((_, Some(delivered))) if delivered.is_refused => {
                (self.inserted(session, delivered), Vec::new())
            }
            // Writing failed; it may succeed another time.
            Some((_, Some(_))) => {
                return FreshResult { subject, ..FreshResult::default() };
            }
            _ => Default::default(),
        };
        let cached =
            CachedPaths { diagnostics, job: job.map(|(job, delivered)| CachedJob::of(job, delivered)) };
        FreshResult { subject, traces, further, outputs, payload: encode(&cached) }
    }

    /// The files that the post-processor inserted or failed to insert, with their hashes.
    fn inserted(&self, session: &Session<'_>, delivered: &ProgramOutcome) -> Vec<ExtraInput> {
        let Some(post) = self.post_processor.and_then(PostProcessor::file) else { return Vec::new() };
        let beside = post.parent().unwrap_or(Utf8Path::new(""));
        let file = |InsertedFile { name, hash }: &InsertedFile| ExtraInput {
            path: session.normal(&beside.join(name)),
            hash: *hash,
        };
        delivered.inserted.iter().map(file).collect()
    }
}

/// Whether all files of a program were written or compared, and no error occurred that may not recur.
fn is_complete(job: &Job, delivered: &ProgramOutcome) -> bool {
    delivered.files.len() == job.files.len()
        && delivered.hashes.len() == job.files.len()
        && !delivered.problems.iter().any(Diagnostic::is_error)
}

fn outputs(delivered: &ProgramOutcome, task: Task) -> Vec<GeneratedFile> {
    // Programs with the same moves need not be equal byte for byte.
    let is_compared_whole = task != Task::Compare { moves_only: true };
    let is_there = |state: &State| matches!(state, State::Written | State::Unchanged | State::Current);
    let output = |((path, state), hash): (&(Utf8PathBuf, State), &[u8; 32])| GeneratedFile {
        path: path.clone(),
        hash: *hash,
        is_there: is_compared_whole && is_there(state),
    };
    delivered.files.iter().zip(&delivered.hashes).map(output).collect()
}

impl CachedJob {
    fn of(job: &Job, delivered: Option<&ProgramOutcome>) -> Self {
        Self {
            path: job.path.clone(),
            stem: job.stem.clone(),
            files: job.files.clone(),
            program: delivered.map(CachedProgram::of),
        }
    }
}

impl CachedProgram {
    fn of(delivered: &ProgramOutcome) -> Self {
        Self {
            files: Vec::new(),
            length: delivered.length,
            minutes: delivered.minutes,
            problems: delivered.problems.clone(),
            notes: delivered.notes.clone(),
            provenance: delivered.provenance.clone(),
        }
    }

    /// Whether the program has errors, so that no file is written.
    fn is_wrong(&self) -> bool {
        self.problems.iter().any(Diagnostic::is_error)
    }

    fn outdated(&self) -> impl Iterator<Item = &Utf8Path> {
        let outdated = self.files.iter().filter(|(.., state)| *state == OutputState::Outdated);
        outdated.map(|(_, path, _)| &**path)
    }

    fn is_current(&self, task: Task) -> bool {
        let is_current = |state: OutputState| state == OutputState::Current;
        self.files.iter().all(|(kind, _, state)| !task.compares(*kind) || is_current(*state))
    }

    /// The outcome for its files without writing any: unchanged, or the result of the comparison.
    pub(super) fn delivered(&self, task: Task) -> ProgramOutcome {
        let is_written = matches!(task, Task::Write { .. });
        let state = |state: OutputState| match state {
            OutputState::Current if is_written => State::Unchanged,
            OutputState::Current => State::Current,
            OutputState::Outdated => State::Outdated,
            OutputState::Missing => State::Missing,
        };
        let files = self.files.iter().filter(|(kind, ..)| task.compares(*kind));
        ProgramOutcome {
            files: files.map(|(_, path, found)| (path.clone(), state(*found))).collect(),
            length: self.length,
            minutes: self.minutes,
            problems: self.problems.clone(),
            notes: self.notes.clone(),
            provenance: self.provenance.clone(),
            ..ProgramOutcome::default()
        }
    }
}

/// Everything that a program depends on besides drawings and settings.
fn query(post_processor: Option<&PostProcessor>) -> String {
    let mut text = "emit".to_owned();
    if let Some(post_processor) = post_processor {
        _ = write!(
            text,
            " {:?} {}",
            post_processor.file(),
            blake3::hash(&post_processor.identity()).to_hex()
        );
    }
    text
}

/// Cache subject of the paths of one program. It begins with the first path's drawing, up to the first NUL.
pub(super) fn subject(db: &Database, targets: &[Target], join: Option<&str>) -> String {
    let each = targets.iter().map(|target| format!("{}\0{}", target.file(db).path(db), target.name(db)));
    let mut subject = each.collect::<Vec<_>>().join("\0");
    if let Some(join) = join {
        _ = write!(subject, "\0\0{join}");
    }
    subject
}
