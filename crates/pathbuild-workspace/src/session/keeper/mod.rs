//! Results of earlier runs, for the commands that look at a whole library. (crate pathbuild-cache)
//!
//! What is kept is what the database said; whatever the configuration makes of it afterwards (severities, a baseline, formats) is not.

mod payload;
mod question;
mod writing;

use std::cell::Cell;
use std::collections::HashMap;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::{
    Clock, Kept, Key, Listings, Lookup, Place, Reason, Unusable, Verdict, reasons, verify,
};
use pathbuild_db::Trace;
use pathbuild_db::system::{Kind, OsSystem, System};

use super::Session;
use crate::config::Concerns;
use crate::workspace::Workspace;

pub use payload::{DrawingResult, is_passing};
use question::whole_question;
pub use question::{BUILD, Coverage, Held};
use writing::Writing;

/// The results that are kept for a question.
#[derive(Debug)]
pub struct Keeper {
    place: Place,
    key: Key,
    base: Utf8PathBuf,
    /// The time before anything was read; `None` where the cache cannot be written.
    begun: Option<Clock>,
    kept: Kept,
    verdict: Verdict,
    /// The record that is likely asked for next: whoever asks does so in order.
    next: Cell<usize>,
}

/// A result that was made now.
#[derive(Debug, Default)]
pub struct Made {
    /// What it is of.
    pub of: Box<str>,
    /// Everything that it was made from.
    pub traces: Vec<Trace>,
    /// Further files that it depends on, and directories of which every program counts.
    pub programs: Programs,
    /// Itself; `None` where another run may find something else, though nothing changes.
    pub payload: Option<Vec<u8>>,
}

/// What a kept result was made from.
#[derive(Clone, Debug)]
pub struct Facts<'a> {
    /// The files.
    pub files: Vec<&'a Utf8Path>,
    /// What was looked for: directory and name.
    pub lookups: Vec<(&'a Utf8Path, Box<str>)>,
}

/// Files beside drawings that a result depends on.
#[derive(Clone, Debug, Default)]
pub struct Programs {
    /// The files, with what was found in each.
    pub files: Vec<(Utf8PathBuf, Content)>,
    /// The directories whose names count, all of them.
    pub directories: Vec<Utf8PathBuf>,
}

/// What was found under a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// Nothing.
    Missing,
    /// Bytes, of which this is the blake3 hash.
    Hashed([u8; 32]),
    /// Bytes that nobody hashed.
    Unknown,
}

impl Content {
    /// That of bytes.
    pub fn of(bytes: &[u8]) -> Self {
        Self::Hashed(*blake3::hash(bytes).as_bytes())
    }
}

impl Keeper {
    /// The results kept for a question, held against the files as they are; `None` where there is no configuration, or nothing is to be kept.
    /// `listings`: directories that were listed just now.
    pub fn open(context: &Workspace, whose: Concerns, question: &str, listings: Listings) -> Option<Self> {
        let base = context.settings.directory()?.to_owned();
        let place = context.cache_place()?;
        if let Some(reason) = place.refusal() {
            let phrase = context.choose("nothing is kept there", "dort wird nichts aufgehoben");
            context.reporter.status(&format!("{}: {phrase}: {reason}", place.directory()));
            return None;
        }
        // Whoever cannot write goes without.
        if place.make().is_ok_and(|is_new| is_new) {
            note_old(context, &base);
        }
        let key = Key::new(BUILD, &whole_question(context, whose, question));
        // Before the first file is looked at: what changes from here on shows.
        let begun = place.clock().ok();
        let kept = match place.load(&key) {
            Ok(kept) => kept.unwrap_or_default(),
            Err(reason) => {
                note(context, reason);
                Kept::default()
            }
        };
        let coverage = Coverage::new(context);
        let verdict = verify(&kept, &base, &|file, path| coverage.may_hold(file, path), listings);
        Some(Self { place, key, base, begun, kept, verdict, next: Cell::new(0) })
    }

    /// What was kept, if it still holds.
    pub fn payload(&self, of: &str) -> Option<&[u8]> {
        let number = self.record(of)?;
        self.verdict.holds[number].then(|| self.kept.record(number).payload())
    }

    /// What a kept result was made from.
    pub fn facts(&self, of: &str) -> Option<Facts<'_>> {
        let record = self.kept.record(self.record(of)?);
        let files = record.files().map(|file| self.kept.file(file).path());
        let sought = |Lookup { directory, name }: Lookup| (self.kept.directory(directory).path(), name);
        Some(Facts { files: files.collect(), lookups: record.lookups().map(sought).collect() })
    }

    /// Why what was kept no longer holds; no reason where it does, `None` where nothing was kept.
    pub fn why(&self, context: &Workspace, of: &str) -> Option<Vec<Reason>> {
        let coverage = Coverage::new(context);
        let number = self.record(of)?;
        Some(reasons(&self.kept, &self.verdict, number, &|file, path| coverage.may_hold(file, path)))
    }

    fn record(&self, of: &str) -> Option<usize> {
        let number = self.kept.record_of(of, self.next.get())?;
        self.next.set(number + 1);
        Some(number)
    }

    /// Keeps results: of all that was asked for what still holds, and what was made now. Nothing is written where nothing changed.
    pub fn keep(&self, session: &Session<'_>, asked: &[&str], made: &[Made]) {
        let is_as_it_was = made.is_empty() && self.verdict.is_current && self.kept.records() == asked.len();
        let Some(begun) = self.begun.filter(|_| !is_as_it_was) else { return };
        let new: HashMap<&str, &Made> = made.iter().map(|made| (&*made.of, made)).collect();
        let mut writing = Writing::new(self, session, begun, made);
        for of in asked {
            match (new.get(*of), self.record(of)) {
                (Some(made), _) => writing.add_made(made),
                (None, Some(kept)) => writing.add_kept(kept),
                (None, None) => {}
            }
        }
        // Whoever cannot write goes without.
        _ = self.place.store(&self.key, &writing.finish());
    }
}

/// Earlier versions kept results beside the configuration.
fn note_old(context: &Workspace, base: &Utf8Path) {
    if OsSystem.kind(&base.join(OLD)) == Kind::Directory {
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
