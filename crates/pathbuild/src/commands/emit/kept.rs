//! What is known from earlier runs of the programs on disk. `emit --check` of directories in which nothing changed since the last `emit` or
//! `emit --check` of them reads no drawing.
//!
//! What is kept is the whole answer of a run, with everything that it was made from: which drawings and directories there are, the drawings, the
//! names that were looked for, the programs themselves, and whatever else lies beside them.

use std::collections::BTreeSet;
use std::fmt::Write;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::{
    Corrupt, Decoder, Encoder, decode_diagnostic, decode_note, encode_diagnostic, encode_note,
};
use pathbuild_db::{SourceFile, Trace};
use pathbuild_diagnostic::{Diagnostic, Note};

use super::deliver::{Delivered, State, Task};
use super::job::Job;
use super::stale::Looked;
use crate::args::EmitArgs;
use crate::context::Context;
use pathbuild_workspace::config::Concerns;
use pathbuild_workspace::posting::Poster;
use pathbuild_workspace::session::{
    CheckedTarget, Content, Found, Keeper, Made, Programs, Session, is_passing,
};

/// The kept answer to a run's question, and where the run's own is kept.
pub(super) struct Memory<'a> {
    keeper: Keeper,
    /// The drawings and directories that there are, as a hash: with others the question is another.
    surroundings: String,
    poster: Option<&'a Poster>,
}

/// What a run did.
pub(super) struct Run<'a> {
    pub(super) task: Task,
    /// The drawings of which every path was considered.
    pub(super) covered: &'a [SourceFile],
    pub(super) checked: Vec<CheckedTarget>,
    pub(super) jobs: Vec<Job>,
    pub(super) delivered: Vec<Delivered>,
    /// Everything that was found.
    pub(super) diagnostics: &'a [Diagnostic],
    pub(super) looked: Looked,
}

impl<'a> Memory<'a> {
    /// What is kept; `None` for runs that nothing is kept of: only those over directories, or over the library.
    pub(super) fn open(
        context: &Context,
        session: &Session<'_>,
        args: &EmitArgs,
        poster: Option<&'a Poster>,
    ) -> Option<Self> {
        let is_special =
            args.output.is_some() || args.deps.is_some() || args.join.is_some() || args.remove_stale;
        let has_targets = !context.settings.emit.targets.value.is_empty() && session.has_library();
        if is_special || !context.keeps_results() || args.inputs.inputs.is_empty() && !has_targets {
            return None;
        }
        let found = session.directories_only(&args.inputs)?;
        let surroundings = surroundings(session, args, &found);
        let keeper = Keeper::open(context, Concerns::Emit, &question(context, args, poster), found.listings)?;
        Some(Self { keeper, surroundings, poster })
    }

    /// What a check would say, if everything is as it was.
    pub(super) fn outcome(
        &self,
        context: &Context,
        session: &Session<'_>,
    ) -> Option<(Delivered, Vec<Diagnostic>)> {
        let outcome = decoded(self.keeper.payload(&self.surroundings)?).ok()?;
        context.printer.detail(context.choose(
            "nothing has changed since programs were written or checked: no drawing is read",
            "seit Programme geschrieben oder geprüft wurden, hat sich nichts geändert: keine Zeichnung wird gelesen",
        ));
        // Where files had not rested, they may have now.
        self.keeper.keep(session, &[&self.surroundings], &[]);
        Some(outcome)
    }

    /// Keeps what a run did.
    pub(super) fn keep(&self, session: &Session<'_>, run: &Run<'_>) {
        let covered = Trace { files: run.covered.to_vec(), lookups: Vec::new() };
        let traces = run.checked.iter().filter_map(|checked| checked.trace.clone());
        let made = Made {
            of: self.surroundings.as_str().into(),
            traces: std::iter::once(covered).chain(traces).collect(),
            programs: Programs {
                files: self.files(session, run),
                directories: run.looked.directories.clone(),
            },
            payload: run.is_lasting().then(|| encoded(run)),
        };
        self.keeper.keep(session, &[&self.surroundings], &[made]);
    }

    /// The files beside drawings that were looked at.
    fn files(&self, session: &Session<'_>, run: &Run<'_>) -> Vec<(Utf8PathBuf, Content)> {
        let mut files = Vec::new();
        for delivered in &run.delivered {
            let paths = delivered.files.iter().map(|(path, _)| path.clone());
            files.extend(paths.zip(delivered.contents.iter().copied()));
        }
        files.extend(run.looked.programs.iter().cloned());
        // The post's own file is a part of the question.
        if let Some(post) = self.poster.and_then(Poster::file) {
            let beside = post.parent().unwrap_or(Utf8Path::new(""));
            let inserted = run.delivered.iter().flat_map(|delivered| &delivered.inserted);
            let inserted: BTreeSet<Utf8PathBuf> =
                inserted.map(|name| session.normal(&beside.join(&**name))).collect();
            files.extend(inserted.into_iter().map(|file| (file, Content::Unknown)));
        }
        files
    }
}

impl Run<'_> {
    /// Whether a check would say the same as long as nothing changes.
    fn is_lasting(&self) -> bool {
        let is_known = match self.task {
            Task::Write { .. } => {
                let mut all = self.jobs.iter().zip(&self.delivered);
                all.all(|(job, delivered)| delivered.files.len() == job.files.len())
            }
            // A program that could not be read may be readable another time.
            Task::Compare { .. } => {
                !self.delivered.iter().any(|delivered| delivered.contents.contains(&Content::Unknown))
            }
            Task::Print => false,
        };
        is_known && !self.diagnostics.iter().any(is_passing)
    }
}

/// Everything that an answer depends on and that is in no drawing, and in no option that all answers depend on.
fn question(context: &Context, args: &EmitArgs, poster: Option<&Poster>) -> String {
    let mut text = format!("emit --check {:?}", (&args.inputs.inputs, args.moves, &args.date, &args.dialect));
    // The lines that messages name.
    _ = write!(text, " {:?} {:?}", context.settings.file, context.settings.emit.targets.origin);
    if let Some(poster) = poster {
        _ = write!(text, " {:?} {}", poster.file(), blake3::hash(&poster.identity()).to_hex());
    }
    text
}

/// The drawings and directories that there are.
fn surroundings(session: &Session<'_>, args: &EmitArgs, found: &Found) -> String {
    let mut hasher = blake3::Hasher::new();
    let is_part = session.has_library() && !args.inputs.inputs.is_empty();
    let library = if is_part { session.library() } else { Vec::new() };
    for paths in [&found.drawings, &found.directories, &library] {
        for path in paths {
            hasher.update(path.as_str().as_bytes()).update(&[0]);
        }
        hasher.update(&[0]);
    }
    hasher.finalize().to_hex().to_string()
}

fn encoded(run: &Run<'_>) -> Vec<u8> {
    let mut encoder = Encoder::default();
    let files: Vec<_> = run.delivered.iter().flat_map(|delivered| &delivered.files).collect();
    encoder.list(files.into_iter(), |encoder, (path, state)| {
        encoder.text(path.as_str());
        encoder.u8(match state {
            State::Missing => 0,
            State::Outdated => 1,
            State::Written | State::Unchanged | State::Current | State::Printed(_) => 2,
        });
    });
    // Each is said once.
    let mut notes: Vec<&Note> = Vec::new();
    for note in run.delivered.iter().flat_map(|delivered| &delivered.notes) {
        if !notes.contains(&note) {
            notes.push(note);
        }
    }
    encoder.list(notes.into_iter(), encode_note);
    encoder.list(run.diagnostics.iter(), encode_diagnostic);
    encoder.finish()
}

fn decoded(payload: &[u8]) -> Result<(Delivered, Vec<Diagnostic>), Corrupt> {
    let mut decoder = Decoder::new(payload);
    let files = decoder.list(|decoder| {
        let path = Utf8PathBuf::from(decoder.text()?);
        let state = match decoder.u8()? {
            0 => State::Missing,
            1 => State::Outdated,
            2 => State::Current,
            _ => return Err(Corrupt),
        };
        Ok((path, state))
    })?;
    let notes = decoder.list(decode_note)?;
    let diagnostics = decoder.list(decode_diagnostic)?;
    if !decoder.is_at_end() {
        return Err(Corrupt);
    }
    Ok((Delivered { files, notes, ..Delivered::default() }, diagnostics))
}
