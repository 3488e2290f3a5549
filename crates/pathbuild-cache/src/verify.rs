//! Which results still hold: those whose files are as they were, and to whose questions directories still give the same answers.
#![expect(
    clippy::disallowed_methods,
    reason = "the stat index is about files as the system has them, beside the drawings' bytes"
)]

use std::collections::BTreeSet;
use std::fs;

use camino::Utf8Path;
use rayon::prelude::*;

use crate::facts::{DirectoryFact, ListingKind};
use crate::kept::{Kept, KeptDirectory, KeptFile};
use crate::listing::{Listing, Listings};
use crate::stamp::Stamp;

/// Whether a file of this name may hold the path of that name.
pub type Covers<'a> = &'a (dyn Fn(&str, &str) -> bool + Sync);

/// What became of what was kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// For each record, whether it still holds.
    pub holds: Vec<bool>,
    /// For each file, what became of it.
    pub files: Vec<FileState>,
    /// Each directory as it is now.
    pub directories: Vec<DirectoryFact>,
    /// Whether every stamp and every directory is as it was, so that nothing need be written anew.
    pub is_current: bool,
}

/// Holds what was kept against the files as they are now. `base` is the configuration's directory; directories that are among the listings are
/// not listed again.
pub fn verify(kept: &Kept, base: &Utf8Path, covers: Covers<'_>, mut listings: Listings) -> Verdict {
    // Asking the system for ten thousand files is most of the work.
    let files: Vec<FileState> =
        (0..kept.files()).into_par_iter().with_min_len(256).map(|file| state(kept.file(file))).collect();
    let listed: Vec<Option<Listing>> = (0..kept.directories())
        .map(|number| {
            let directory = kept.directory(number);
            let is_listed = directory.kind() == ListingKind::Drawings;
            if is_listed { listings.remove(directory.path()) } else { None }
        })
        .collect();
    let now = |(number, listed)| {
        let directory = kept.directory(number);
        DirectoryFact::from_listing(directory.path(), directory.kind(), base, listed)
    };
    let directories: Vec<DirectoryFact> = listed.into_par_iter().enumerate().map(now).collect();
    let changes: Vec<DirectoryChange> = directories
        .iter()
        .enumerate()
        .map(|(number, now)| DirectoryChange::of(kept.directory(number), now))
        .collect();
    let are_same = !changes.iter().any(DirectoryChange::is_some);
    let is_current = are_same && files.iter().all(|state| *state == FileState::Resting);
    let holds = if is_current { vec![true; kept.records()] } else { holding(kept, &files, &changes, covers) };
    Verdict { holds, files, directories, is_current }
}

/// For each record, whether it still holds.
fn holding(kept: &Kept, files: &[FileState], changes: &[DirectoryChange], covers: Covers<'_>) -> Vec<bool> {
    let is_anew = |number| {
        let (directory, name) = kept.lookup(number);
        changes[directory].concerns(name, covers)
    };
    let anew: Vec<bool> = (0..kept.lookups()).map(is_anew).collect();
    let holds = |number| {
        let record = kept.record(number);
        record.files().all(|file| files[file] != FileState::Changed)
            && !record.lookup_numbers().any(|lookup| anew[lookup])
    };
    (0..kept.records()).map(holds).collect()
}

/// What became of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileState {
    /// Its stamp is what it was.
    Resting,
    /// Its stamp is another, or was not known, and its bytes are what they were.
    Restored,
    /// It is not what it was.
    Changed,
}

fn state(file: KeptFile<'_>) -> FileState {
    let (path, stamp) = (file.path(), Stamp::of(file.path()));
    if stamp == file.stamp() && stamp != Stamp::UNKNOWN {
        return FileState::Resting;
    }
    let Some(hash) = file.hash().filter(|_| stamp != Stamp::MISSING) else { return FileState::Changed };
    let is_restored = fs::read(path).is_ok_and(|bytes| *blake3::hash(&bytes).as_bytes() == hash);
    if is_restored { FileState::Restored } else { FileState::Changed }
}

/// What became of a directory.
pub(crate) enum DirectoryChange {
    /// Nothing.
    None,
    /// These names came or went.
    Names(Vec<Box<str>>),
    /// Links decide what it is: whatever was asked of it is asked again.
    Links,
}

impl DirectoryChange {
    pub(crate) fn of(before: KeptDirectory<'_>, now: &DirectoryFact) -> Self {
        if before.is_doubtful() || now.is_doubtful || before.canonical() != &*now.canonical {
            return Self::Links;
        }
        if before.names().eq(now.names.iter()) {
            return Self::None;
        }
        let (old, new): (BTreeSet<&str>, BTreeSet<&str>) =
            (before.names().collect(), now.names.iter().collect());
        Self::Names(old.symmetric_difference(&new).map(|name| (*name).into()).collect())
    }

    fn is_some(&self) -> bool {
        !matches!(self, Self::None)
    }

    /// Whether the answer to a question may be another.
    fn concerns(&self, path: &str, covers: Covers<'_>) -> bool {
        match self {
            Self::None => false,
            Self::Links => true,
            Self::Names(names) => path.is_empty() || names.iter().any(|name| covers(name, path)),
        }
    }
}
