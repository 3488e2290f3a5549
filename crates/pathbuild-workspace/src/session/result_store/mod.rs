//! Results of earlier runs, for the commands that look at a whole library. (crate pathbuild-cache)
//!
//! What is kept is what the database said; whatever the configuration makes of it afterwards (severities, a baseline, formats) is not.

mod lookups;
mod payload;
mod question;
mod scope;
mod seen;
mod writing;

use std::cell::Cell;
use std::collections::HashSet;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::{
    Clock, FileState, Key, Listings, Looking, Reason, Snapshot, Stamp, TreeStore, Unusable, Verdict, reasons,
    verify,
};
use pathbuild_db::system::FileKind;
use pathbuild_db::{Db, Trace};
use pathbuild_diagnostic::reasons::IN_STRANGERS_TREE;

use super::Session;
use super::outputs::{OutputKind, without_values};
use crate::config::Concerns;
use crate::workspace::Workspace;

pub use payload::{DrawingResult, is_passing};
use question::whole_question;
pub use question::{BUILD, Coverage, Held};
pub use scope::Scope;
use writing::Writing;

/// The results that are kept for a question.
#[derive(Debug)]
pub struct ResultStore {
    place: TreeStore,
    key: Key,
    base: Utf8PathBuf,
    coverage: Coverage,
    scope: Scope,
    /// The time before anything was read; `None` where the cache cannot be written.
    begun: Option<Clock>,
    kept: Snapshot,
    verdict: Verdict,
    /// The record that is likely asked for next: whoever asks does so in order.
    next: Cell<usize>,
}

/// What a run wants to know.
#[derive(Debug)]
pub struct Question<'a> {
    /// Whose results.
    pub whose: Concerns,
    /// What they depend on beside settings and files.
    pub text: &'a str,
    /// Which of them.
    pub scope: Scope,
    /// What is in directories that were listed just now.
    pub listings: Listings,
}

/// A result that was made now.
#[derive(Debug, Default)]
pub struct FreshResult {
    /// What it is of.
    pub of: Box<str>,
    /// Everything that it was made from.
    pub traces: Vec<Trace>,
    /// Files beside drawings that it was made from.
    pub further: Vec<FurtherFile>,
    /// The files that it becomes.
    pub outputs: Vec<MadeOutput>,
    /// Itself; `None` where another run may find something else, though nothing changes.
    pub payload: Option<Vec<u8>>,
}

/// A file beside drawings that a result was made from.
#[derive(Clone, Debug)]
pub struct FurtherFile {
    /// The file.
    pub path: Utf8PathBuf,
    /// The hash of the bytes that were read; `None` where they could not be.
    pub hash: Option<[u8; 32]>,
}

/// A file that a result becomes.
#[derive(Clone, Debug)]
pub struct MadeOutput {
    /// The file.
    pub path: Utf8PathBuf,
    /// What [`hash_output`] makes of its content.
    pub hash: [u8; 32],
    /// Whether that is what lies there.
    pub is_there: bool,
}

/// How a file that was written lies there now.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputState {
    /// As it would be written.
    Current,
    /// With other content.
    Outdated,
    /// Not at all.
    Missing,
}

/// What a kept result was made from.
#[derive(Clone, Debug)]
pub struct Dependencies<'a> {
    /// The files.
    pub files: Vec<&'a Utf8Path>,
    /// What was looked for: directory and name.
    pub lookups: Vec<(&'a Utf8Path, &'a str)>,
}

impl ResultStore {
    /// The results kept for a question, held against the files as they are; `None` where there is no configuration, or nothing is to be kept.
    pub fn open(context: &Workspace, question: Question<'_>) -> Option<Self> {
        let Question { whose, text, scope, listings } = question;
        let base = context.settings.directory()?.to_owned();
        let place = context.cache_place()?;
        let confined = context.settings.confined.as_ref();
        let is_strangers = confined.is_some_and(|confined| confined.may_hold(place.directory()));
        if let Some(reason) = is_strangers.then_some(&IN_STRANGERS_TREE).or_else(|| place.refusal()) {
            let phrase = context.choose("nothing is kept there", "dort wird nichts aufgehoben");
            let reason = context.choose(reason.en, reason.de);
            context.reporter.status(&format!("{}: {phrase}: {reason}", place.directory()));
            return None;
        }
        // Whoever cannot write goes without.
        if place.make().is_ok_and(|is_new| is_new) {
            note_old(context, &base);
        }
        let key = Key::new(BUILD, &whole_question(context, whose, text));
        // Before the first file is looked at: what changes from here on shows.
        let begun = place.clock().ok();
        let kept = match place.load(&key) {
            Ok(kept) => kept.unwrap_or_default(),
            Err(reason) => {
                note(context, reason);
                Snapshot::default()
            }
        };
        let coverage = Coverage::new(context);
        let verdict = look(context, &kept, &coverage, &scope, listings);
        Some(Self { place, key, base, coverage, scope, begun, kept, verdict, next: Cell::new(0) })
    }

    /// What was kept, if it still holds.
    pub fn payload(&self, of: &str) -> Option<&[u8]> {
        let number = self.record(of)?;
        self.verdict.holds[number].then(|| self.kept.record(number).payload())
    }

    /// What became of the files that a result became, in the order in which they were kept.
    pub fn outputs(&self, of: &str) -> Vec<OutputState> {
        let Some(number) = self.record(of) else { return Vec::new() };
        let state = |file: usize| match self.verdict.files[file] {
            FileState::Resting | FileState::Restored(_) => OutputState::Current,
            FileState::Changed | FileState::Unlooked
                if Stamp::of(self.kept.file(file).path()) == Stamp::MISSING =>
            {
                OutputState::Missing
            }
            FileState::Changed | FileState::Unlooked => OutputState::Outdated,
        };
        self.kept.record(number).outputs().map(state).collect()
    }

    /// What a kept result was made from.
    pub fn facts(&self, of: &str) -> Option<Dependencies<'_>> {
        let record = self.kept.record(self.record(of)?);
        let files = record.files().map(|file| self.kept.file(file).path());
        let sought = |lookup| {
            let (directories, name) = self.kept.lookup(lookup);
            let list = self.kept.directory_list(directories);
            list.map(move |directory| (self.kept.directory(directory).path(), name))
        };
        Some(Dependencies { files: files.collect(), lookups: record.lookups().flat_map(sought).collect() })
    }

    /// Why what was kept no longer holds; no reason where it does, `None` where nothing was kept.
    pub fn why(&self, of: &str) -> Option<Vec<Reason>> {
        let number = self.record(of)?;
        let coverage = &self.coverage;
        Some(reasons(&self.kept, &self.verdict, number, &|file, path| coverage.may_hold(file, path)))
    }

    fn record(&self, of: &str) -> Option<usize> {
        let number = self.kept.record_of(of, self.next.get())?;
        self.next.set(number + 1);
        Some(number)
    }

    /// Keeps what was made now beside what still holds, also of other drawings. Nothing is written where nothing changed.
    pub fn keep(&self, session: &Session<'_>, made: &[FreshResult]) {
        let is_as_it_was = made.is_empty() && self.verdict.is_current;
        let Some(begun) = self.begun.filter(|_| !is_as_it_was) else { return };
        let made_now: HashSet<&str> = made.iter().map(|made| &*made.of).collect();
        let mut writing = Writing::new(self, session, begun, made);
        for number in (0..self.kept.records()).filter(|number| self.verdict.is_sound[*number]) {
            let of = self.kept.record(number).of();
            if !made_now.contains(of) && self.scope.may_return(of, session.db().system()) {
                writing.add_kept(number);
            }
        }
        for made in made {
            writing.add_made(made);
        }
        // Whoever cannot write goes without.
        _ = self.place.store(&self.key, &writing.finish());
    }
}

/// Holds what was kept against the files as they are.
fn look(
    workspace: &Workspace,
    kept: &Snapshot,
    coverage: &Coverage,
    scope: &Scope,
    listings: Listings,
) -> Verdict {
    let base = workspace.settings.directory().unwrap_or(Utf8Path::new(""));
    let is_asked = |of: &str| scope.holds(of);
    let covers = |file: &str, path: &str| coverage.may_hold(file, path);
    let (system, limits) = (&*workspace.system, &workspace.settings.limits);
    let read = |file: &Utf8Path, is_output: bool| {
        let mut room = Vec::new();
        let limit = if is_output { limits.output_size.value } else { limits.file_size.value };
        let (bytes, stamp) = system.read_stamped(file, limit, &mut room).ok()?;
        let length = bytes.len();
        room.truncate(length);
        Some((room, stamp))
    };
    let confined = workspace.settings.confined.as_ref();
    let is_allowed = |file: &Utf8Path| confined.is_none_or(|confined| confined.allows(file));
    let looking = Looking {
        base,
        covers: &covers,
        is_asked: &is_asked,
        is_allowed: &is_allowed,
        read: &read,
        hash_output: &hash_output,
    };
    verify(kept, looking, listings)
}

/// The hash of a file that a program becomes; of one into which people enter measured values, without them.
pub fn hash_output(path: &Utf8Path, bytes: &[u8]) -> [u8; 32] {
    let is_values = path.as_str().ends_with(OutputKind::Values.suffix());
    let hash = if is_values { blake3::hash(without_values(bytes).as_bytes()) } else { blake3::hash(bytes) };
    *hash.as_bytes()
}

/// Earlier versions kept results beside the configuration.
fn note_old(context: &Workspace, base: &Utf8Path) {
    if context.system.kind(&base.join(OLD)) == FileKind::Directory {
        context.reporter.status(context.choose(
            "results are kept in your cache directory now: .pathbuild beside the configuration is not used any more and can be deleted",
            "Ergebnisse werden jetzt in Ihrem Cache-Verzeichnis aufgehoben: .pathbuild neben der Konfiguration wird nicht mehr gebraucht und kann gelöscht werden",
        ));
    }
}

/// Where that was.
const OLD: &str = ".pathbuild";

fn note(context: &Workspace, reason: Unusable) {
    let phrase = match reason {
        Unusable::Damaged => context
            .choose("the cache is damaged and made anew", "der Cache ist beschädigt und wird neu angelegt"),
        Unusable::Foreign => context.choose(
            "the cache is of another build and made anew",
            "der Cache ist von einer anderen Programmfassung und wird neu angelegt",
        ),
    };
    context.reporter.status(phrase);
}
