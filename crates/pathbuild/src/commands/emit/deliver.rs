//! Making the files of one path, and writing, comparing or printing them. It runs on many threads and prints nothing.

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::Written;
use pathbuild_db::{Database, Db, program};
use pathbuild_diagnostic::messages::{files, probes};
use pathbuild_diagnostic::{Diagnostic, Point};
use pathbuild_toolpath::{Outside, Program, Statistics};

use super::compare;
use super::job::Job;
use crate::args::EmitArgs;
use crate::session::{OutputKind, Writing};

/// What is done with the files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Task {
    /// They are written. `force`: also over measured values.
    Write { force: bool },
    /// They are compared with what lies on disk.
    Compare { moves_only: bool },
    /// They are printed.
    Print,
}

/// What became of a path's files.
#[derive(Default)]
pub(super) struct Delivered {
    /// Each file.
    pub(super) files: Vec<(Utf8PathBuf, State)>,
    /// The program's length in mm.
    pub(super) length: f64,
    /// The program's time.
    pub(super) minutes: f64,
    /// What went wrong, or where moves differ.
    pub(super) problems: Vec<Diagnostic>,
}

/// What became of a file.
pub(super) enum State {
    /// It was written.
    Written,
    /// It was there already.
    Unchanged,
    /// What lies on disk is what would be written.
    Current,
    /// It is not.
    Outdated,
    /// There is nothing on disk.
    Missing,
    /// Its text, to be printed.
    Printed(String),
}

impl Task {
    pub(super) fn new(args: &EmitArgs) -> Self {
        if args.check {
            Self::Compare { moves_only: args.moves }
        } else if args.output.is_some() {
            Self::Print
        } else {
            Self::Write { force: args.force }
        }
    }

    /// Whether times are part of the result.
    pub(super) fn writes_times(self) -> bool {
        self != Self::Compare { moves_only: true }
    }
}

/// Does a job. Nothing of a path is written when something keeps one of its files from being written.
pub(super) fn deliver(db: &Database, job: &Job, task: Task, writing: &Writing) -> Delivered {
    let Some(program) = program(db, job.target).clone() else { return Delivered::default() };
    let sum = Statistics::of(&program, writing.options.rapid).sum();
    let mut delivered = Delivered { length: sum.length, minutes: sum.minutes(), ..Delivered::default() };
    let correction = writing.options.correction;
    let at = |diagnostic: Diagnostic| diagnostic.in_file(job.target.file(db).path(db)).in_path(&program.path);
    let count = correction.count(&program);
    if count > writing.most_moves {
        delivered.problems.push(at(too_many_pieces(count, writing.most_moves)));
        return delivered;
    }
    delivered.problems.extend(correction.outside(&program).map(|outside| at(outside_probes(&outside))));
    let outputs = outputs(job, &program, writing);
    match task {
        Task::Write { force } => {
            if let Err(problem) = write(db, &outputs, force, &mut delivered) {
                delivered.problems.push(*problem);
            }
        }
        Task::Compare { moves_only } => {
            for output in outputs.iter().filter(|output| !moves_only || output.kind != OutputKind::Values) {
                let (state, problems) = compare::compare(db, output, moves_only);
                delivered.files.push((output.path.clone(), state));
                delivered.problems.extend(problems);
            }
        }
        Task::Print => {
            delivered.files =
                outputs.into_iter().map(|output| (output.path, State::Printed(output.text))).collect();
        }
    }
    delivered
}

/// PB005: what comes of cutting moves is limited like the moves themselves.
fn too_many_pieces(count: u64, limit: u64) -> Diagnostic {
    Diagnostic::new(&files::LIMIT)
        .with("what", format!("the number of moves, cut by z-split ({count}),"))
        .with("limit", limit)
        .with("key", "embedding-moves")
}

fn outside_probes(outside: &Outside) -> Diagnostic {
    Diagnostic::new(&probes::OUTSIDE)
        .with("distance", outside.distance)
        .with("at", Point::new(outside.at.x, outside.at.y))
}

/// A file to be written.
pub(super) struct Output {
    pub(super) kind: OutputKind,
    pub(super) path: Utf8PathBuf,
    pub(super) text: String,
}

fn outputs(job: &Job, program: &Program, writing: &Writing) -> Vec<Output> {
    let provenance = job.provenance.to_string();
    let output = |(kind, path): &(OutputKind, Utf8PathBuf)| Output {
        kind: *kind,
        path: path.clone(),
        text: kind.text(program, &provenance, writing),
    };
    job.files.iter().map(output).collect()
}

fn write(
    db: &Database,
    outputs: &[Output],
    force: bool,
    delivered: &mut Delivered,
) -> Result<(), Box<Diagnostic>> {
    let values = || outputs.iter().filter(|output| output.kind == OutputKind::Values);
    if !force && let Some(lost) = values().find(|output| would_lose_values(db, output)) {
        let name = lost.path.file_name().unwrap_or_default();
        return Err(Box::new(
            Diagnostic::new(&probes::VALUES_PRESENT).with("name", name).in_file(&lost.path),
        ));
    }
    for output in outputs {
        let is_kept = output.kind == OutputKind::Values && !force && has_same_probes(db, output);
        let written = if is_kept {
            Ok(Written::Unchanged)
        } else {
            db.system().write(&output.path, output.text.as_bytes())
        };
        let written = written.map_err(|reason| Box::new(cannot_write(output.path.as_str(), &reason)))?;
        let state = if written == Written::Changed { State::Written } else { State::Unchanged };
        delivered.files.push((output.path.clone(), state));
    }
    Ok(())
}

/// Whether there are values that somebody measured, for other probes than now.
fn would_lose_values(db: &Database, output: &Output) -> bool {
    let Some(present) = present(db, &output.path) else { return false };
    let probes = without_values(&present);
    probes != without_values(&output.text) && probes != present.trim_end()
}

/// Whether a file of values is there and is for these probes.
pub(super) fn has_same_probes(db: &Database, output: &Output) -> bool {
    present(db, &output.path).is_some_and(|present| without_values(&present) == without_values(&output.text))
}

fn present(db: &Database, path: &Utf8Path) -> Option<String> {
    let bytes = db.system().read(path, 1 << 24).ok()?;
    Some(String::from_utf8_lossy(&bytes).replace("\r\n", "\n"))
}

/// A file of values with everything behind `=` taken away.
fn without_values(text: &str) -> String {
    let lines = text
        .lines()
        .map(|line| line.split_inclusive('=').filter(|part| part.ends_with('=')).collect::<String>());
    lines.collect::<Vec<_>>().join("\n")
}

/// PB004.
pub(super) fn cannot_write(name: &str, reason: &str) -> Diagnostic {
    Diagnostic::new(&files::CANNOT_WRITE).with("name", name).with("reason", reason)
}
