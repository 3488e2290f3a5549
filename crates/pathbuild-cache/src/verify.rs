//! Which results still hold: those whose files are as they were, and to whose questions directories still give the same answers.
#![expect(
    clippy::disallowed_methods,
    reason = "the stat index is about files as the system has them, beside the drawings' bytes"
)]

use std::collections::BTreeSet;
use std::fs;

use camino::Utf8Path;
use rayon::prelude::*;

use crate::facts::{Catalogue, DirectoryFact, FileFact, ListingKind, Lookup, Record};
use crate::stamp::Stamp;

/// Whether a file of this name may hold the path of that name.
pub type Covers<'a> = &'a (dyn Fn(&str, &str) -> bool + Sync);

/// What became of a catalogue.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// For each record, whether it still holds.
    pub holds: Vec<bool>,
    /// For each file, what became of it.
    pub files: Vec<FileState>,
    /// Each directory as it is now.
    pub directories: Vec<DirectoryFact>,
    /// Whether every stamp and every directory is as it was, so that the catalogue need not be written anew.
    pub is_current: bool,
}

/// Holds a catalogue against the files as they are now. `base` is the configuration's directory.
pub fn verify(catalogue: &Catalogue, base: &Utf8Path, covers: Covers<'_>) -> Verdict {
    let files: Vec<FileState> = catalogue.files.par_iter().with_min_len(256).map(state).collect();
    let now = |fact: &DirectoryFact| DirectoryFact::now(&fact.path, fact.kind, base);
    let directories: Vec<DirectoryFact> = catalogue.directories.par_iter().map(now).collect();
    let changes: Vec<DirectoryChange> = catalogue
        .directories
        .iter()
        .zip(&directories)
        .map(|(before, now)| DirectoryChange::of(before, now))
        .collect();
    let is_asked_anew = |lookup: &Lookup| changes[lookup.directory as usize].concerns(&lookup.name, covers);
    // Thousands of records ask the same.
    let all: BTreeSet<&Lookup> = if changes.iter().any(DirectoryChange::is_some) {
        catalogue.records.iter().flat_map(|record| &record.lookups).collect()
    } else {
        BTreeSet::new()
    };
    let anew: BTreeSet<&Lookup> = all.into_iter().filter(|lookup| is_asked_anew(lookup)).collect();
    let holds = |record: &Record| {
        record.files.iter().all(|file| files[*file as usize] != FileState::Changed)
            && (anew.is_empty() || !record.lookups.iter().any(|lookup| anew.contains(lookup)))
    };
    Verdict {
        holds: catalogue.records.iter().map(holds).collect(),
        is_current: files.iter().all(|state| *state == FileState::Resting)
            && !changes.iter().any(DirectoryChange::is_some),
        files,
        directories,
    }
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

fn state(file: &FileFact) -> FileState {
    let stamp = Stamp::of(&file.path);
    if stamp == file.stamp && stamp != Stamp::UNKNOWN {
        return FileState::Resting;
    }
    let Some(hash) = file.hash.filter(|_| stamp != Stamp::MISSING) else { return FileState::Changed };
    let is_restored = fs::read(&file.path).is_ok_and(|bytes| *blake3::hash(&bytes).as_bytes() == hash);
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

impl DirectoryFact {
    /// A directory as it is now; one that cannot be listed holds nothing.
    pub fn now(path: &Utf8Path, kind: ListingKind, base: &Utf8Path) -> Self {
        let place = if path.as_str().is_empty() { Utf8Path::new(".") } else { path };
        let mut names = Vec::new();
        let mut is_doubtful = false;
        for entry in fs::read_dir(place).into_iter().flatten().filter_map(Result::ok) {
            // As System lists them: of names that are no UTF-8 a lossy spelling.
            let name = entry.file_name().to_string_lossy().into_owned();
            if !kind.counts(&name) {
                continue;
            }
            let Ok(file_type) = entry.file_type() else { continue };
            is_doubtful |= file_type.is_symlink();
            if !file_type.is_dir() {
                names.push(name.into());
            }
        }
        names.sort_unstable();
        Self { path: path.to_owned(), kind, names, canonical: canonical(place, base), is_doubtful }
    }
}

impl DirectoryChange {
    pub(crate) fn of(before: &DirectoryFact, now: &DirectoryFact) -> Self {
        if before.is_doubtful || now.is_doubtful || before.canonical != now.canonical {
            return Self::Links;
        }
        if before.names == now.names {
            return Self::None;
        }
        let (old, new): (BTreeSet<_>, BTreeSet<_>) =
            (before.names.iter().collect(), now.names.iter().collect());
        Self::Names(old.symmetric_difference(&new).map(|name| (**name).clone()).collect())
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

fn canonical(directory: &Utf8Path, base: &Utf8Path) -> Box<str> {
    let Ok(directory) = directory.canonicalize_utf8() else { return "".into() };
    let base = base.canonicalize_utf8().unwrap_or_else(|_| base.to_owned());
    directory.strip_prefix(&base).map_or(directory.as_str(), Utf8Path::as_str).into()
}
