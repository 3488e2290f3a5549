//! Which results still hold: those whose files are as they were, and to whose questions directories still give the same answers.
use std::collections::BTreeSet;

use camino::Utf8Path;
use rayon::prelude::*;

use crate::facts::DirectoryFact;
use crate::listing::{Listing, Listings};
use crate::snapshot::{KeptDirectory, KeptFile, Snapshot};
use crate::stamp::Stamp;

/// Whether a file of this name may hold the path of that name.
pub type Covers<'a> = &'a (dyn Fn(&str, &str) -> bool + Sync);

/// Bytes, and the stamp that they were read under.
pub type Stamped = (Vec<u8>, Stamp);

/// What became of what was kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// For each record, whether it was asked for and still holds, whatever became of its outputs.
    pub holds: Vec<bool>,
    /// For each record, asked for or not, whether nothing is known against it.
    pub is_sound: Vec<bool>,
    /// For each file, what became of it.
    pub files: Vec<FileState>,
    /// Each directory as it is now.
    pub directories: Vec<DirectoryFact>,
    /// Whether every stamp and every directory is as it was, so that nothing need be written anew.
    pub is_current: bool,
}

/// How what was kept is looked at.
#[derive(Clone, Copy)]
pub struct Looking<'a> {
    /// The directory that names are relative to.
    pub base: &'a Utf8Path,
    /// Which file may hold which path.
    pub covers: Covers<'a>,
    /// Which records are looked at, by what they are of.
    pub is_asked: &'a (dyn Fn(&str) -> bool + Sync),
    /// Whether a file may be looked at.
    pub is_allowed: &'a (dyn Fn(&Utf8Path) -> bool + Sync),
    /// The bytes of a file, of an output or not, and the stamp that it had before and after they were read: unknown if that was not the same.
    pub read: &'a (dyn Fn(&Utf8Path, bool) -> Option<Stamped> + Sync),
    /// What the content of an output is hashed to: some is written by people.
    pub hash_output: &'a (dyn Fn(&Utf8Path, &[u8]) -> [u8; 32] + Sync),
}

/// Holds what was kept against the files as they are now. Directories that are among the listings are not listed again.
pub fn verify(kept: &Snapshot, looking: Looking<'_>, mut listings: Listings) -> Verdict {
    let is_asked: Vec<bool> =
        (0..kept.records()).map(|number| (looking.is_asked)(kept.record(number).of())).collect();
    let files = files(kept, &is_asked, looking);
    let listed: Vec<Option<Listing>> =
        (0..kept.directories()).map(|number| listings.remove(kept.directory(number).path())).collect();
    let now =
        |(number, listed)| DirectoryFact::from_listing(kept.directory(number).path(), looking.base, listed);
    let directories: Vec<DirectoryFact> = listed.into_par_iter().enumerate().map(now).collect();
    let changes: Vec<DirectoryChange> = directories
        .iter()
        .enumerate()
        .map(|(number, now)| DirectoryChange::of(kept.directory(number), now))
        .collect();
    let are_same = !changes.iter().any(DirectoryChange::is_some);
    let is_current =
        are_same && files.iter().all(|state| matches!(state, FileState::Resting | FileState::Unlooked));
    let is_sound =
        if is_current { vec![true; kept.records()] } else { sound(kept, &files, &changes, looking.covers) };
    let holds = is_asked.iter().zip(&is_sound).map(|(is_asked, is_sound)| *is_asked && *is_sound).collect();
    Verdict { holds, is_sound, files, directories, is_current }
}

/// What became of the files of the records that are asked for: to ask the system for ten thousand is most of the work.
fn files(kept: &Snapshot, is_asked: &[bool], looking: Looking<'_>) -> Vec<FileState> {
    let mut roles = vec![Role::None; kept.files()];
    for (number, _) in is_asked.iter().enumerate().filter(|(_, is_asked)| **is_asked) {
        let record = kept.record(number);
        record.outputs().for_each(|file| roles[file] = Role::Output);
        record.files().for_each(|file| roles[file] = Role::Source);
    }
    let state = |(number, role): (usize, &Role)| match role {
        Role::None => FileState::Unlooked,
        Role::Source => state(kept.file(number), looking, false, &|_, bytes| *blake3::hash(bytes).as_bytes()),
        Role::Output => state(kept.file(number), looking, true, looking.hash_output),
    };
    roles.par_iter().enumerate().with_min_len(256).map(state).collect()
}

/// What a file is to the records that are asked for.
#[derive(Clone, Copy)]
enum Role {
    None,
    Source,
    Output,
}

/// For each record whether no file that was looked at has changed, and every question has the same answer.
fn sound(kept: &Snapshot, files: &[FileState], changes: &[DirectoryChange], covers: Covers<'_>) -> Vec<bool> {
    let changed =
        |list| kept.directory_list(list).map(|number| &changes[number]).filter(|change| change.is_some());
    let changed: Vec<Vec<&DirectoryChange>> =
        (0..kept.directory_lists()).map(|list| changed(list).collect()).collect();
    let is_anew = |number| {
        let (list, name) = kept.lookup(number);
        changed[list].iter().any(|change| change.concerns(name, covers))
    };
    let anew: Vec<bool> = (0..kept.lookups()).map(is_anew).collect();
    let is_sound = |number| {
        let record = kept.record(number);
        record.files().all(|file| files[file] != FileState::Changed)
            && !record.lookups().any(|lookup| anew[lookup])
    };
    (0..kept.records()).map(is_sound).collect()
}

/// What became of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileState {
    /// Its stamp is what it was.
    Resting,
    /// Its stamp is another, or was not known, and its bytes are what they were: this is the stamp that they were read under.
    Restored(Stamp),
    /// It is not what it was.
    Changed,
    /// Nobody asked.
    Unlooked,
}

fn state(
    file: KeptFile<'_>,
    looking: Looking<'_>,
    is_output: bool,
    hash_of: &dyn Fn(&Utf8Path, &[u8]) -> [u8; 32],
) -> FileState {
    let path = file.path();
    // The stamp is that of what links lead to, wherever.
    if !(looking.is_allowed)(path) {
        return FileState::Changed;
    }
    let stamp = Stamp::of(path);
    if stamp == file.stamp() && stamp != Stamp::UNKNOWN {
        return FileState::Resting;
    }
    let Some(hash) = file.hash().filter(|_| stamp != Stamp::MISSING) else { return FileState::Changed };
    match (looking.read)(path, is_output) {
        Some((bytes, stamp)) if hash_of(path, &bytes) == hash => FileState::Restored(stamp),
        _ => FileState::Changed,
    }
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
            Self::Names(names) => names.iter().any(|name| covers(name, path)),
        }
    }
}
