//! What is known from earlier runs, target by target: of each drawing its paths, of each path what is wrong with it, or the files that it becomes.
//! What nothing has changed of is neither read nor made again.

use std::collections::HashMap;
use std::fmt::Write;

use crate::config::Concerns;
use crate::session::{
    Drawing, DrawingResult, FreshResult, FurtherFile, MadeOutput, OutputKind, OutputState, Question,
    ResultStore, Scope, Session, is_passing,
};
use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::{Listings, decode, encode};
use pathbuild_db::{Database, System, Target, Trace};
use pathbuild_diagnostic::{Diagnostic, Note};
use pathbuild_gcode::provenance::Provenance;
use serde::{Deserialize, Serialize};

use super::Answer;
use super::deliver::{Delivered, State, Task, is_of_other_version};
use super::job::Job;
use super::targets::Selection;
use crate::posting::{Inserted, PostProcessor};
use crate::workspace::Workspace;

/// The records of earlier runs with these settings.
pub(super) struct Store(ResultStore);

/// What is known of paths that become one program.
#[derive(Serialize, Deserialize)]
pub(super) struct KnownPaths {
    /// What is wrong with them and with what they embed, and why they become nothing though they are right.
    pub(super) diagnostics: Vec<Diagnostic>,
    /// What they become; `None` where that is nothing.
    pub(super) job: Option<KnownJob>,
}

/// What is known of a job.
#[derive(Serialize, Deserialize)]
pub(super) struct KnownJob {
    /// The path, as the drawing spells it.
    pub(super) path: Box<str>,
    /// The name of its files without what tells them apart, with the directory.
    pub(super) stem: Utf8PathBuf,
    /// Its files.
    pub(super) files: Vec<(OutputKind, Utf8PathBuf)>,
    /// What came of it; `None` where it was refused.
    pub(super) program: Option<KnownProgram>,
}

/// What is known of a program without making it.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct KnownProgram {
    /// How each of its files lies there now; nothing where something is wrong with the program.
    #[serde(skip)]
    files: Vec<(OutputKind, Utf8PathBuf, OutputState)>,
    /// In mm.
    length: f64,
    minutes: f64,
    /// Warnings, and what is wrong with the program.
    problems: Vec<Diagnostic>,
    notes: Vec<Note>,
    provenance: Option<Provenance>,
}

impl Store {
    /// The records about these drawings; `None` where none can be kept.
    pub(super) fn open(
        workspace: &Workspace,
        poster: Option<&PostProcessor>,
        scope: Scope,
        listings: Listings,
    ) -> Option<Self> {
        let text = question(poster);
        let question = Question { whose: Concerns::Emit, text: &text, scope, listings };
        ResultStore::open(workspace, question).map(Self)
    }

    /// What is known of a drawing alone, if it is as it was.
    pub(super) fn drawing(&self, drawing: &Utf8Path) -> Option<DrawingResult> {
        DrawingResult::decode(self.0.payload(drawing.as_str())?).ok()
    }

    /// What is known of paths that become one program, if that is enough for the task: whoever writes makes a program again of which a file is
    /// not as it was.
    pub(super) fn paths(&self, system: &dyn System, of: &str, task: Task) -> Option<KnownPaths> {
        let mut known: KnownPaths = decode(self.0.payload(of)?).ok()?;
        if let Some(KnownJob { files, program: Some(program), .. }) = &mut known.job
            && !program.is_wrong()
        {
            let states = self.0.outputs(of);
            if states.len() != files.len() {
                return None;
            }
            let states = files.iter().zip(states).map(|((kind, path), state)| (*kind, path.clone(), state));
            program.files = states.collect();
            let is_enough = match task {
                // The same program may have been written by another version.
                Task::Compare { moves_only: false } => {
                    program.outdated().all(|it| !is_of_other_version(system, it))
                }
                _ => program.is_current(task),
            };
            if !is_enough {
                return None;
            }
        }
        Some(known)
    }

    /// Keeps what was found now.
    pub(super) fn keep(&self, session: &Session<'_>, run: &Run<'_>) {
        let drawing = |Drawing { path, said, .. }: &Drawing| FreshResult {
            of: path.as_str().into(),
            traces: vec![Trace { files: vec![session.file(path)], lookups: Vec::new() }],
            payload: said.encode(),
            ..FreshResult::default()
        };
        let mut made: Vec<FreshResult> =
            run.asked.drawings().filter(|drawing| drawing.is_read).map(drawing).collect();
        let done = run.jobs.iter().zip(run.delivered).map(|(job, delivered)| (job, Some(delivered)));
        let all = done.chain(run.refused.iter().map(|job| (job, None)));
        let jobs: HashMap<&[Target], (&Job, Option<&Delivered>)> =
            all.map(|(job, delivered)| (&*job.targets, (job, delivered))).collect();
        made.extend(run.answers.iter().map(|answer| run.made(session, answer, &jobs)));
        self.0.keep(session, &made);
    }
}

/// What a run did.
pub(super) struct Run<'a> {
    pub(super) task: Task,
    pub(super) join: Option<&'a str>,
    pub(super) poster: Option<&'a PostProcessor>,
    pub(super) asked: &'a Selection,
    /// What was not known.
    pub(super) answers: &'a [Answer],
    pub(super) jobs: &'a [Job],
    /// What became of each of these.
    pub(super) delivered: &'a [Delivered],
    /// Jobs that were not done.
    pub(super) refused: &'a [Job],
}

impl Run<'_> {
    fn made(
        &self,
        session: &Session<'_>,
        answer: &Answer,
        jobs: &HashMap<&[Target], (&Job, Option<&Delivered>)>,
    ) -> FreshResult {
        let targets: Vec<Target> = answer.checked.iter().map(|checked| checked.target).collect();
        let of = of(session.db(), &targets, self.join).into();
        let traces: Vec<Trace> = answer.checked.iter().filter_map(|checked| checked.trace.clone()).collect();
        let mut diagnostics = answer.found(session);
        diagnostics.extend_from_slice(&answer.refusals);
        let job = jobs.get(&*targets).copied();
        let problems = job.and_then(|(_, delivered)| delivered).into_iter().flat_map(|it| &it.problems);
        let is_lasting = traces.len() == targets.len() && !diagnostics.iter().chain(problems).any(is_passing);
        let (further, outputs) = match job {
            _ if !is_lasting => return FreshResult { of, ..FreshResult::default() },
            Some((job, Some(delivered))) if is_complete(job, delivered) => {
                (self.inserted(session, delivered), outputs(delivered, self.task))
            }
            // What a post refuses may be right with other files.
            Some((_, Some(delivered))) if delivered.is_refused => {
                (self.inserted(session, delivered), Vec::new())
            }
            // Not written: another time it may be.
            Some((_, Some(_))) => {
                return FreshResult { of, ..FreshResult::default() };
            }
            _ => Default::default(),
        };
        let known = KnownPaths { diagnostics, job: job.map(|(job, delivered)| KnownJob::of(job, delivered)) };
        FreshResult { of, traces, further, outputs, payload: encode(&known) }
    }

    /// The files that the post put in, or could not, as they were read.
    fn inserted(&self, session: &Session<'_>, delivered: &Delivered) -> Vec<FurtherFile> {
        let Some(post) = self.poster.and_then(PostProcessor::file) else { return Vec::new() };
        let beside = post.parent().unwrap_or(Utf8Path::new(""));
        let file = |Inserted { name, hash }: &Inserted| FurtherFile {
            path: session.normal(&beside.join(name)),
            hash: *hash,
        };
        delivered.inserted.iter().map(file).collect()
    }
}

/// Whether all files of a program were written or compared, and nothing went wrong that may go right another time.
fn is_complete(job: &Job, delivered: &Delivered) -> bool {
    delivered.files.len() == job.files.len()
        && delivered.hashes.len() == job.files.len()
        && !delivered.problems.iter().any(Diagnostic::is_error)
}

fn outputs(delivered: &Delivered, task: Task) -> Vec<MadeOutput> {
    // Programs with the same moves need not be the same byte for byte.
    let is_compared_whole = task != Task::Compare { moves_only: true };
    let is_there = |state: &State| matches!(state, State::Written | State::Unchanged | State::Current);
    let output = |((path, state), hash): (&(Utf8PathBuf, State), &[u8; 32])| MadeOutput {
        path: path.clone(),
        hash: *hash,
        is_there: is_compared_whole && is_there(state),
    };
    delivered.files.iter().zip(&delivered.hashes).map(output).collect()
}

impl KnownJob {
    fn of(job: &Job, delivered: Option<&Delivered>) -> Self {
        Self {
            path: job.path.clone(),
            stem: job.stem.clone(),
            files: job.files.clone(),
            program: delivered.map(KnownProgram::of),
        }
    }
}

impl KnownProgram {
    fn of(delivered: &Delivered) -> Self {
        Self {
            files: Vec::new(),
            length: delivered.length,
            minutes: delivered.minutes,
            problems: delivered.problems.clone(),
            notes: delivered.notes.clone(),
            provenance: delivered.provenance.clone(),
        }
    }

    /// Whether nothing is written of it.
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

    /// What becomes of its files: nothing, or what a comparison says.
    pub(super) fn delivered(&self, task: Task) -> Delivered {
        let is_written = matches!(task, Task::Write { .. });
        let state = |state: OutputState| match state {
            OutputState::Current if is_written => State::Unchanged,
            OutputState::Current => State::Current,
            OutputState::Outdated => State::Outdated,
            OutputState::Missing => State::Missing,
        };
        let files = self.files.iter().filter(|(kind, ..)| task.compares(*kind));
        Delivered {
            files: files.map(|(_, path, found)| (path.clone(), state(*found))).collect(),
            length: self.length,
            minutes: self.minutes,
            problems: self.problems.clone(),
            notes: self.notes.clone(),
            provenance: self.provenance.clone(),
            ..Delivered::default()
        }
    }
}

/// Everything that a program depends on and that is in no drawing and no setting.
fn question(poster: Option<&PostProcessor>) -> String {
    let mut text = "emit".to_owned();
    if let Some(poster) = poster {
        _ = write!(text, " {:?} {}", poster.file(), blake3::hash(&poster.identity()).to_hex());
    }
    text
}

/// The name of the record of paths that become one program: the drawing of the first stands before the first NUL.
pub(super) fn of(db: &Database, targets: &[Target], join: Option<&str>) -> String {
    let each = targets.iter().map(|target| format!("{}\0{}", target.file(db).path(db), target.name(db)));
    let mut of = each.collect::<Vec<_>>().join("\0");
    if let Some(join) = join {
        _ = write!(of, "\0\0{join}");
    }
    of
}
