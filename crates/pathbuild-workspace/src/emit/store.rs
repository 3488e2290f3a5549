//! What is known from earlier runs, target by target: of each drawing its paths, of each path what is wrong with it, or the files that it becomes.
//! What nothing has changed of is neither read nor made again.

use std::collections::HashMap;
use std::fmt::Write;

use crate::config::Concerns;
use crate::session::{
    CheckedTarget, DrawingResult, Keeper, Made, MadeOutput, OutputKind, OutputState, Question, Scope,
    Session, is_passing,
};
use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::{
    Corrupt, Decoder, Encoder, Listings, decode_diagnostic, decode_note, encode_diagnostic, encode_note,
};
use pathbuild_db::{SourceFile, Target, Trace, check_file};
use pathbuild_diagnostic::{Diagnostic, Note};
use pathbuild_gcode::provenance::Provenance;

use super::Request;
use super::asked::Drawings;
use super::deliver::{Delivered, State, Task};
use super::job::Job;
use crate::posting::Poster;
use crate::workspace::Workspace;

/// The records of earlier runs with these settings.
pub(super) struct Store(Keeper);

/// What is known of a path.
pub(super) struct Known {
    /// What is wrong with it and with what it embeds.
    pub(super) diagnostics: Vec<Diagnostic>,
    /// What it becomes; `None` where it is wrong.
    pub(super) program: Option<KnownProgram>,
}

/// What is known of a program without making it.
#[derive(Debug, PartialEq)]
pub(super) struct KnownProgram {
    /// The path, as the drawing spells it.
    pub(super) path: Box<str>,
    /// The name of its files without what tells them apart, with the directory.
    pub(super) stem: Utf8PathBuf,
    /// Its files.
    pub(super) files: Vec<(OutputKind, Utf8PathBuf)>,
    /// How they lie there now.
    states: Vec<OutputState>,
    /// In mm.
    length: f64,
    minutes: f64,
    /// Warnings.
    problems: Vec<Diagnostic>,
    notes: Vec<Note>,
    provenance: Provenance,
}

impl Store {
    /// The records about these drawings. `None` for runs that always make everything.
    pub(super) fn open(
        workspace: &Workspace,
        request: &Request<'_>,
        scope: Scope,
        listings: Listings,
    ) -> Option<Self> {
        if request.is_always_made() {
            return None;
        }
        let text = question(request.poster);
        let question = Question { whose: Concerns::Emit, text: &text, scope, listings };
        Keeper::open(workspace, question).map(Self)
    }

    /// What is known of a drawing alone, if it is as it was.
    pub(super) fn drawing(&self, drawing: &Utf8Path) -> Option<DrawingResult> {
        DrawingResult::decode(self.0.payload(drawing.as_str())?).ok()
    }

    /// What is known of a path, if that is enough for the task: whoever writes makes a program again of which a file is not as it was.
    pub(super) fn path(&self, drawing: &Utf8Path, path: &str, task: Task) -> Option<Known> {
        let of = of(drawing, path);
        let mut known = decoded(self.0.payload(&of)?).ok()?;
        if let Some(program) = &mut known.program {
            program.states = self.0.outputs(&of);
            let is_enough = program.states.len() == program.files.len()
                && (task == Task::Compare { moves_only: false } || program.is_current(task));
            return is_enough.then_some(known);
        }
        Some(known)
    }

    /// Keeps what was found now.
    pub(super) fn keep(&self, session: &Session<'_>, run: &Run<'_>) {
        let db = session.db();
        let drawing = |file: &SourceFile| Made {
            of: file.path(db).as_str().into(),
            traces: vec![Trace { files: vec![*file], lookups: Vec::new() }],
            payload: DrawingResult {
                names: run.drawings.names(session, *file).to_vec(),
                diagnostics: run.drawings.diagnostics(session, *file).to_vec(),
            }
            .encode(),
            ..Made::default()
        };
        let mut made: Vec<Made> = run.drawings.read().map(drawing).collect();
        let open: HashMap<Target, (&Job, &Delivered)> =
            run.open().map(|(job, delivered)| (job.targets[0], (job, delivered))).collect();
        for checked in run.checked {
            made.push(run.made(session, checked, open.get(&checked.target).copied()));
        }
        self.0.keep(session, &made);
    }
}

/// What a run did.
pub(super) struct Run<'a> {
    pub(super) task: Task,
    pub(super) drawings: &'a Drawings,
    /// The targets that were not known.
    pub(super) checked: &'a [CheckedTarget],
    /// All jobs.
    pub(super) jobs: &'a [Job],
    pub(super) delivered: &'a [Delivered],
    pub(super) poster: Option<&'a Poster>,
}

impl Run<'_> {
    /// What became of the jobs that were not known.
    fn open(&self) -> impl Iterator<Item = (&Job, &Delivered)> {
        self.jobs.iter().zip(self.delivered).filter(|(job, _)| job.known.is_none())
    }

    fn made(&self, session: &Session<'_>, checked: &CheckedTarget, job: Option<(&Job, &Delivered)>) -> Made {
        let db = session.db();
        let of = of(checked.target.file(db).path(db), checked.target.name(db)).into();
        let traces = checked.trace.iter().cloned().collect();
        let diagnostics = found(session, checked);
        let is_lasting = checked.trace.is_some() && !diagnostics.iter().any(is_passing);
        match job.filter(|(job, delivered)| is_complete(job, delivered)) {
            // Refused, or not written: another time it may be.
            None if checked.emitted.is_some() => Made { of, ..Made::default() },
            None => Made {
                of,
                traces,
                payload: is_lasting.then(|| encoded(&diagnostics, None)),
                ..Made::default()
            },
            Some((job, delivered)) => Made {
                of,
                traces,
                further: self.inserted(session, delivered),
                outputs: outputs(delivered, self.task),
                payload: is_lasting.then(|| encoded(&diagnostics, Some((job, delivered)))),
            },
        }
    }

    /// The files that the post put in; its own is a part of the question.
    fn inserted(&self, session: &Session<'_>, delivered: &Delivered) -> Vec<Utf8PathBuf> {
        let Some(post) = self.poster.and_then(Poster::file) else { return Vec::new() };
        let beside = post.parent().unwrap_or(Utf8Path::new(""));
        delivered.inserted.iter().map(|name| session.normal(&beside.join(&**name))).collect()
    }
}

/// What is wrong with a path, and with the drawings that it is made from.
pub(super) fn found(session: &Session<'_>, checked: &CheckedTarget) -> Vec<Diagnostic> {
    let of_files = checked.files.iter().flat_map(|file| check_file(session.db(), *file));
    of_files.chain(&checked.diagnostics).cloned().collect()
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

impl KnownProgram {
    fn is_current(&self, task: Task) -> bool {
        let counts = |kind: OutputKind| task.compares(kind);
        let mut all = self.files.iter().zip(&self.states);
        all.all(|((kind, _), state)| !counts(*kind) || *state == OutputState::Current)
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
        let files = self.files.iter().zip(&self.states).filter(|((kind, _), _)| task.compares(*kind));
        Delivered {
            files: files.map(|((_, path), found)| (path.clone(), state(*found))).collect(),
            length: self.length,
            minutes: self.minutes,
            problems: self.problems.clone(),
            notes: self.notes.clone(),
            provenance: Some(self.provenance.clone()),
            ..Delivered::default()
        }
    }
}

/// Everything that a program depends on and that is in no drawing and no setting.
fn question(poster: Option<&Poster>) -> String {
    let mut text = "emit".to_owned();
    if let Some(poster) = poster {
        _ = write!(text, " {:?} {}", poster.file(), blake3::hash(&poster.identity()).to_hex());
    }
    text
}

/// The name of a path's record.
fn of(drawing: &Utf8Path, path: &str) -> String {
    format!("{drawing}\0{path}")
}

fn encoded(diagnostics: &[Diagnostic], program: Option<(&Job, &Delivered)>) -> Vec<u8> {
    let mut encoder = Encoder::default();
    encoder.list(diagnostics.iter(), encode_diagnostic);
    encoder.option(program, |encoder, (job, delivered)| {
        encoder.text(&job.path);
        encoder.text(job.stem.as_str());
        encoder.list(job.files.iter(), |encoder, (kind, path)| {
            encoder.u8(*kind as u8);
            encoder.text(path.as_str());
        });
        encoder.u64(delivered.length.to_bits());
        encoder.u64(delivered.minutes.to_bits());
        encoder.list(delivered.problems.iter(), encode_diagnostic);
        encoder.list(delivered.notes.iter(), encode_note);
        encoder.text(&delivered.provenance.as_ref().map(Provenance::to_string).unwrap_or_default());
    });
    encoder.finish()
}

fn decoded(payload: &[u8]) -> Result<Known, Corrupt> {
    let mut decoder = Decoder::new(payload);
    let diagnostics = decoder.list(decode_diagnostic)?;
    let program = decoder.option(|decoder| {
        Ok(KnownProgram {
            path: decoder.text()?.into(),
            stem: decoder.text()?.into(),
            files: decoder.list(|decoder| {
                let kind = usize::from(decoder.u8()?);
                Ok((*OutputKind::ALL.get(kind).ok_or(Corrupt)?, decoder.text()?.into()))
            })?,
            states: Vec::new(),
            length: f64::from_bits(decoder.u64()?),
            minutes: f64::from_bits(decoder.u64()?),
            problems: decoder.list(decode_diagnostic)?,
            notes: decoder.list(decode_note)?,
            provenance: decoder.text()?.parse().map_err(|()| Corrupt)?,
        })
    })?;
    if decoder.is_at_end() { Ok(Known { diagnostics, program }) } else { Err(Corrupt) }
}
