//! Decides which cached results still hold: their files must be unchanged, and their lookups must still give the same answers.
use std::collections::BTreeSet;

use camino::Utf8Path;
use rayon::prelude::*;

use crate::facts::DirectoryFact;
use crate::listing::{Listing, Listings};
use crate::snapshot::{CachedDirectory, CachedFile, Snapshot};
use pathbuild_files::Stamp;

/// Whether the file of the first name may contain the path of the second name.
pub type CoversFn<'a> = &'a (dyn Fn(&str, &str) -> bool + Sync);

/// A file's bytes, and the stamp under which they were read.
pub type StampedBytes = (Vec<u8>, Stamp);

/// The outcome of verifying a snapshot.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// For each record, whether it was requested and still holds; its outputs do not matter.
    pub holds: Vec<bool>,
    /// For each record, requested or not, whether no input is known to have changed.
    pub is_sound: Vec<bool>,
    /// State of each file.
    pub files: Vec<FileState>,
    /// The current state of each directory.
    pub directories: Vec<DirectoryFact>,
    /// Whether every stamp and every directory is unchanged, so that the snapshot need not be rewritten.
    pub is_current: bool,
}

/// How a snapshot is compared with the file system.
#[derive(Clone, Copy)]
pub struct VerifyContext<'a> {
    /// Directory that paths are relative to.
    pub base: &'a Utf8Path,
    /// Which file may contain which path.
    pub covers: CoversFn<'a>,
    /// Which records are requested, by subject.
    pub is_requested: &'a (dyn Fn(&str) -> bool + Sync),
    /// Whether a file may be accessed.
    pub is_allowed: &'a (dyn Fn(&Utf8Path) -> bool + Sync),
    /// Reads a file; the flag tells whether it is an output. The stamp is unknown if it changed during the read.
    pub read: &'a (dyn Fn(&Utf8Path, bool) -> Option<StampedBytes> + Sync),
    /// Hashes the content of an output; outputs may have parts that users edit.
    pub hash_output: &'a (dyn Fn(&Utf8Path, &[u8]) -> [u8; 32] + Sync),
}

/// Compares a snapshot with the file system. Directories in `listings` are not listed again.
pub fn verify(snapshot: &Snapshot, context: VerifyContext<'_>, mut listings: Listings) -> Verdict {
    let is_requested: Vec<bool> = (0..snapshot.records())
        .map(|number| (context.is_requested)(snapshot.record(number).subject()))
        .collect();
    let files = files(snapshot, &is_requested, context);
    let listed: Vec<Option<Listing>> = (0..snapshot.directories())
        .map(|number| listings.remove(snapshot.directory(number).path()))
        .collect();
    let now = |(number, listed)| {
        DirectoryFact::from_listing(snapshot.directory(number).path(), context.base, listed)
    };
    let directories: Vec<DirectoryFact> = listed.into_par_iter().enumerate().map(now).collect();
    let changes: Vec<DirectoryChange> = directories
        .iter()
        .enumerate()
        .map(|(number, now)| DirectoryChange::of(snapshot.directory(number), now))
        .collect();
    let are_same = !changes.iter().any(DirectoryChange::is_some);
    let is_current =
        are_same && files.iter().all(|state| matches!(state, FileState::Unchanged | FileState::Unchecked));
    let is_sound = if is_current {
        vec![true; snapshot.records()]
    } else {
        sound_records(snapshot, &files, &changes, context.covers)
    };
    let holds = is_requested
        .iter()
        .zip(&is_sound)
        .map(|(is_requested, is_sound)| *is_requested && *is_sound)
        .collect();
    Verdict { holds, is_sound, files, directories, is_current }
}

/// States of the files of the requested records. Querying the metadata of ten thousand files dominates a run without changes.
fn files(snapshot: &Snapshot, is_requested: &[bool], context: VerifyContext<'_>) -> Vec<FileState> {
    let mut roles = vec![Role::None; snapshot.files()];
    for (number, _) in is_requested.iter().enumerate().filter(|(_, is_requested)| **is_requested) {
        let record = snapshot.record(number);
        record.outputs().for_each(|file| roles[file] = Role::Output);
        record.files().for_each(|file| roles[file] = Role::Source);
    }
    let state = |(number, role): (usize, &Role)| match role {
        Role::None => FileState::Unchecked,
        Role::Source => {
            state(snapshot.file(number), context, false, &|_, bytes| *blake3::hash(bytes).as_bytes())
        }
        Role::Output => state(snapshot.file(number), context, true, context.hash_output),
    };
    roles.par_iter().enumerate().with_min_len(256).map(state).collect()
}

/// How the requested records use a file.
#[derive(Clone, Copy)]
enum Role {
    None,
    Source,
    Output,
}

/// For each record, whether none of its checked files has changed and all its lookups give the same answers.
fn sound_records(
    snapshot: &Snapshot,
    files: &[FileState],
    changes: &[DirectoryChange],
    covers: CoversFn<'_>,
) -> Vec<bool> {
    let changed =
        |list| snapshot.directory_list(list).map(|number| &changes[number]).filter(|change| change.is_some());
    let changed: Vec<Vec<&DirectoryChange>> =
        (0..snapshot.directory_lists()).map(|list| changed(list).collect()).collect();
    let is_stale = |number| {
        let (list, name) = snapshot.lookup(number);
        changed[list].iter().any(|change| change.concerns(name, covers))
    };
    let stale: Vec<bool> = (0..snapshot.lookups()).map(is_stale).collect();
    let is_sound = |number| {
        let record = snapshot.record(number);
        record.files().all(|file| files[file] != FileState::Changed)
            && !record.lookups().any(|lookup| stale[lookup])
    };
    (0..snapshot.records()).map(is_sound).collect()
}

/// State of a file compared with the snapshot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileState {
    /// The stamp is unchanged.
    Unchanged,
    /// The stamp differs or was unknown, but the bytes are unchanged; they were read under this new stamp.
    Touched(Stamp),
    /// The bytes differ, or the file is gone.
    Changed,
    /// No requested record uses it.
    Unchecked,
}

fn state(
    file: CachedFile<'_>,
    context: VerifyContext<'_>,
    is_output: bool,
    hash_of: &dyn Fn(&Utf8Path, &[u8]) -> [u8; 32],
) -> FileState {
    let path = file.path();
    // Check first: a stamp is that of the target of symbolic links, which may be anywhere.
    if !(context.is_allowed)(path) {
        return FileState::Changed;
    }
    let stamp = Stamp::of(path);
    if stamp == file.stamp() && stamp != Stamp::UNKNOWN {
        return FileState::Unchanged;
    }
    let Some(hash) = file.hash().filter(|_| stamp != Stamp::MISSING) else { return FileState::Changed };
    match (context.read)(path, is_output) {
        Some((bytes, stamp)) if hash_of(path, &bytes) == hash => FileState::Touched(stamp),
        _ => FileState::Changed,
    }
}

/// Difference between a directory and its snapshot.
pub(crate) enum DirectoryChange {
    /// Same names, no links.
    None,
    /// Names that were added or removed.
    Names(Vec<Box<str>>),
    /// Symbolic links have other targets, or names may be missing: all lookups in this directory are repeated.
    Links,
}

impl DirectoryChange {
    pub(crate) fn of(before: CachedDirectory<'_>, now: &DirectoryFact) -> Self {
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

    /// Whether a lookup of this path may now give another answer.
    fn concerns(&self, path: &str, covers: CoversFn<'_>) -> bool {
        match self {
            Self::None => false,
            Self::Links => true,
            Self::Names(names) => names.iter().any(|name| covers(name, path)),
        }
    }
}
