//! Results of earlier runs, for the commands that look at a whole library. (crate pathbuild-cache)
//!
//! What is kept is what the database said; whatever the configuration makes of it afterwards (severities, a baseline, formats) is not.

mod payload;
mod question;
mod writing;

use std::collections::HashMap;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::{Catalogue, Clock, Key, Place, Reason, Unusable, Verdict, reasons, verify};
use pathbuild_db::Trace;

use super::Session;
use crate::context::Context;

pub use payload::DrawingResult;
use question::whole_question;
pub use question::{BUILD, Coverage};
use writing::Writing;

/// The results that are kept for a question.
#[derive(Debug)]
pub struct Keeper {
    place: Place,
    key: Key,
    base: Utf8PathBuf,
    /// The time before anything was read; `None` where the cache cannot be written.
    begun: Option<Clock>,
    kept: Catalogue,
    verdict: Verdict,
    /// The number of each record.
    records: HashMap<Box<str>, usize>,
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
    pub files: Vec<&'a Utf8PathBuf>,
    /// What was looked for: directory and name.
    pub lookups: Vec<(&'a Utf8Path, &'a str)>,
}

/// Programs that a result depends on.
#[derive(Clone, Debug, Default)]
pub struct Programs {
    /// The files, there or not.
    pub files: Vec<Utf8PathBuf>,
    /// The directories whose names of programs count.
    pub directories: Vec<Utf8PathBuf>,
}

impl Keeper {
    /// The results kept for a question, held against the files as they are; `None` where there is no configuration, or nothing is to be kept.
    pub fn open(context: &Context, session: &Session<'_>, question: &str) -> Option<Self> {
        let base = context.settings.directory().filter(|_| context.use_cache)?.to_owned();
        let place = Place::beside(&base);
        let key = Key::new(BUILD, &whole_question(context, session, question));
        // Before the first file is looked at: what changes from here on shows.
        let begun = place.clock().ok();
        let kept = match place.load(&key) {
            Ok(kept) => kept.unwrap_or_default(),
            Err(reason) => {
                note(context, reason);
                Catalogue::default()
            }
        };
        let coverage = Coverage::new(context);
        let verdict = verify(&kept, &base, &|file, path| coverage.may_hold(file, path));
        let records =
            kept.records.iter().zip(0..).map(|(record, number)| (record.of.clone(), number)).collect();
        Some(Self { place, key, base, begun, kept, verdict, records })
    }

    /// What was kept, if it still holds.
    pub fn payload(&self, of: &str) -> Option<&[u8]> {
        let number = *self.records.get(of)?;
        self.verdict.holds[number].then(|| &*self.kept.records[number].payload)
    }

    /// What a kept result was made from.
    pub fn facts(&self, of: &str) -> Option<Facts<'_>> {
        let record = &self.kept.records[*self.records.get(of)?];
        let files = record.files.iter().map(|file| &self.kept.files[*file as usize].path);
        let directory = |number: u32| self.kept.directories[number as usize].path.as_path();
        let lookups = record.lookups.iter().map(|lookup| (directory(lookup.directory), &*lookup.name));
        Some(Facts { files: files.collect(), lookups: lookups.collect() })
    }

    /// Why what was kept no longer holds; no reason where it does, `None` where nothing was kept.
    pub fn why(&self, context: &Context, of: &str) -> Option<Vec<Reason>> {
        let coverage = Coverage::new(context);
        let number = *self.records.get(of)?;
        Some(reasons(&self.kept, &self.verdict, number, &|file, path| coverage.may_hold(file, path)))
    }

    /// Keeps results: of all that was asked for what still holds, and what was made now. Nothing is written where nothing changed.
    pub fn keep(&self, session: &Session<'_>, asked: &[&str], made: &[Made]) {
        let is_as_it_was =
            made.is_empty() && self.verdict.is_current && self.kept.records.len() == asked.len();
        let Some(begun) = self.begun.filter(|_| !is_as_it_was) else { return };
        let new: HashMap<&str, &Made> = made.iter().map(|made| (&*made.of, made)).collect();
        let mut writing = Writing::new(self, session, begun, made);
        for of in asked {
            match new.get(*of) {
                Some(made) => writing.add_made(made),
                None => writing.add_kept(self.records[*of]),
            }
        }
        // Whoever cannot write goes without.
        _ = self.place.store(&self.key, &writing.finish());
    }
}

fn note(context: &Context, reason: Unusable) {
    let phrase = match reason {
        Unusable::Damaged => context
            .choose("the cache is damaged and made anew", "der Cache ist beschädigt und wird neu angelegt"),
        Unusable::Foreign => context.choose(
            "the cache is of another build and made anew",
            "der Cache ist von einer anderen Programmfassung und wird neu angelegt",
        ),
    };
    context.printer.status(phrase);
}
