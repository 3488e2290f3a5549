//! Decides which cached results are still valid: their files must be unchanged, and their lookups must still give the same answers in the directories
//! as they are now.

#![expect(
    clippy::disallowed_methods,
    reason = "change detection reads the real directories, which are no input of a drawing"
)]

use std::collections::{BTreeSet, HashMap};
use std::{fs, io};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_files::{Stamp, is_drawing, or_current_directory};
use rayon::prelude::*;

use crate::catalogue::{Catalogue, DirectoryFact, FileFact};

/// A function that returns whether the file with the first name may contain the path with the second name.
pub type CoversFn<'a> = &'a (dyn Fn(&str, &str) -> bool + Sync);

/// A file's bytes, and the stamp under which they were read.
pub type StampedBytes = (Vec<u8>, Stamp);

/// The result of verifying a catalogue.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// For each record, whether it was requested and is still valid; missing outputs do not matter.
    pub is_valid: Vec<bool>,
    /// For each record, requested or not, whether no input is known to have changed.
    pub is_sound: Vec<bool>,
    /// State of each file of the catalogue.
    pub files: Vec<FileState>,
    /// The current state of each directory of the catalogue.
    pub directories: Vec<DirectoryFact>,
    /// Whether every compared stamp and every directory is unchanged, so that the catalogue need not be rewritten.
    pub is_current: bool,
}

/// The settings and callbacks with which a catalogue is compared with the file system.
#[derive(Clone, Copy)]
pub struct VerifyContext<'a> {
    /// Directory to which paths are relative.
    pub base: &'a Utf8Path,
    /// Decides whether a file may contain a path.
    pub covers: CoversFn<'a>,
    /// Decides which records are requested, by their subject.
    pub is_requested: &'a (dyn Fn(&str) -> bool + Sync),
    /// Whether a file may be accessed.
    pub is_allowed: &'a (dyn Fn(&Utf8Path) -> bool + Sync),
    /// Reads a file; the flag is true for outputs. The stamp is unknown if the file changed during the read.
    pub read: &'a (dyn Fn(&Utf8Path, bool) -> Option<StampedBytes> + Sync),
    /// Hashes the content of an output without those parts that users may edit.
    pub hash_output: &'a (dyn Fn(&Utf8Path, &[u8]) -> [u8; 32] + Sync),
}

/// Compares a catalogue with the file system. Directories in `listings` are not listed again.
pub fn verify(catalogue: &Catalogue, context: VerifyContext<'_>, mut listings: Listings) -> Verdict {
    let is_requested: Vec<bool> =
        catalogue.records.iter().map(|record| (context.is_requested)(&record.subject)).collect();
    let files = file_states(catalogue, &is_requested, context);
    let listed: Vec<Option<Listing>> =
        catalogue.directories.iter().map(|directory| listings.remove(&directory.path)).collect();
    let now = |(before, listed): (&DirectoryFact, Option<Listing>)| {
        DirectoryFact::from_listing(&before.path, context.base, listed)
    };
    let directories: Vec<DirectoryFact> = catalogue.directories.par_iter().zip(listed).map(now).collect();
    let pairs = catalogue.directories.iter().zip(&directories);
    let changes: Vec<DirectoryChange> = pairs.map(|(before, now)| DirectoryChange::of(before, now)).collect();
    let are_same = !changes.iter().any(DirectoryChange::is_some);
    let is_current =
        are_same && files.iter().all(|state| matches!(state, FileState::Unchanged | FileState::Unchecked));
    let is_sound = if is_current {
        vec![true; catalogue.records.len()]
    } else {
        record_validity(catalogue, &files, &changes, context.covers)
    };
    let is_valid = is_requested
        .iter()
        .zip(&is_sound)
        .map(|(is_requested, is_sound)| *is_requested && *is_sound)
        .collect();
    Verdict { is_valid, is_sound, files, directories, is_current }
}

/// Determines the states of the files of the requested records, in parallel: querying the metadata of ten thousand files takes most of a run without
/// changes.
fn file_states(catalogue: &Catalogue, is_requested: &[bool], context: VerifyContext<'_>) -> Vec<FileState> {
    let mut roles = vec![FileRole::None; catalogue.files.len()];
    let requested = catalogue.records.iter().zip(is_requested).filter(|(_, is_requested)| **is_requested);
    for (record, _) in requested {
        record.outputs.iter().for_each(|file| roles[*file] = FileRole::Output);
        record.files.iter().for_each(|file| roles[*file] = FileRole::Source);
    }
    let state = |(role, file): (&FileRole, &FileFact)| match role {
        FileRole::None => FileState::Unchecked,
        FileRole::Source => file_state(file, context, false, &|_, bytes| *blake3::hash(bytes).as_bytes()),
        FileRole::Output => file_state(file, context, true, context.hash_output),
    };
    roles.par_iter().zip(&catalogue.files).with_min_len(256).map(state).collect()
}

/// The use of a file by the requested records.
#[derive(Clone, Copy)]
enum FileRole {
    None,
    Source,
    Output,
}

/// Determines for each record whether none of its checked files has changed and all its lookups give the same answers.
fn record_validity(
    catalogue: &Catalogue,
    files: &[FileState],
    changes: &[DirectoryChange],
    covers: CoversFn<'_>,
) -> Vec<bool> {
    let changed = |list: &Vec<usize>| {
        list.iter().map(|number| &changes[*number]).filter(|change| change.is_some()).collect()
    };
    let changed: Vec<Vec<&DirectoryChange>> = catalogue.directory_lists.iter().map(changed).collect();
    let lookups = catalogue.lookups.iter();
    let stale: Vec<bool> = lookups
        .map(|lookup| {
            changed[lookup.directories].iter().any(|change| change.may_affect(&lookup.name, covers))
        })
        .collect();
    let records = catalogue.records.iter();
    records
        .map(|record| {
            record.files.iter().all(|file| files[*file] != FileState::Changed)
                && !record.lookups.iter().any(|lookup| stale[*lookup])
        })
        .collect()
}

/// State of a file compared with the catalogue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileState {
    /// The stamp is unchanged.
    Unchanged,
    /// The stamp differs or was unknown, but the bytes are unchanged; they were read under this new stamp.
    Touched(Stamp),
    /// The bytes differ, or the file is gone.
    Changed,
    /// No requested record uses the file, so it was not compared.
    Unchecked,
}

fn file_state(
    file: &FileFact,
    context: VerifyContext<'_>,
    is_output: bool,
    hash_of: &dyn Fn(&Utf8Path, &[u8]) -> [u8; 32],
) -> FileState {
    let path = &*file.path;
    // Check permission first: the stamp would be that of a symbolic link's target, which may be anywhere.
    if !(context.is_allowed)(path) {
        return FileState::Changed;
    }
    let stamp = Stamp::of(path);
    if stamp == file.stamp && stamp != Stamp::UNKNOWN {
        return FileState::Unchanged;
    }
    let Some(hash) = file.hash.filter(|_| stamp != Stamp::MISSING) else { return FileState::Changed };
    match (context.read)(path, is_output) {
        Some((bytes, stamp)) if hash_of(path, &bytes) == hash => FileState::Touched(stamp),
        _ => FileState::Changed,
    }
}

/// Difference between a directory and its cached state.
enum DirectoryChange {
    /// The names and the targets of links are the same.
    None,
    /// The given names were added or removed.
    Names(Vec<Box<str>>),
    /// Symbolic links have other targets, or names may be missing: all lookups in this directory are repeated.
    Links,
}

impl DirectoryChange {
    fn of(before: &DirectoryFact, now: &DirectoryFact) -> Self {
        if before.is_doubtful || now.is_doubtful || before.canonical != now.canonical {
            return Self::Links;
        }
        if before.names == now.names {
            return Self::None;
        }
        let (old, new): (BTreeSet<_>, BTreeSet<_>) =
            (before.names.iter().collect(), now.names.iter().collect());
        Self::Names(old.symmetric_difference(&new).copied().cloned().collect())
    }

    fn is_some(&self) -> bool {
        !matches!(self, Self::None)
    }

    /// Whether a lookup of this path may now give another answer.
    fn may_affect(&self, path: &str, covers: CoversFn<'_>) -> bool {
        match self {
            Self::None => false,
            Self::Links => true,
            Self::Names(names) => names.iter().any(|name| covers(name, path)),
        }
    }
}

/// A changed input because of which a result is no longer valid.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reason {
    /// A file has different bytes, or is gone.
    File {
        /// Path of the file, spelled as in the run that read it.
        path: Utf8PathBuf,
        /// Whether the file no longer exists.
        is_gone: bool,
    },
    /// A file that may contain a path which was looked up has appeared or disappeared.
    Name {
        /// Path of the file that has appeared or disappeared.
        file: Utf8PathBuf,
        /// Name of the path that was looked up.
        path: Box<str>,
        /// Whether the file disappeared.
        is_gone: bool,
    },
    /// A symbolic link in a directory or in its path has another target, or the directory could not be listed completely.
    Links {
        /// Directory in which lookups may now give other answers.
        directory: Utf8PathBuf,
    },
}

/// Lists the reasons why a record is no longer valid, without duplicates; empty if it is valid.
pub fn reasons(catalogue: &Catalogue, verdict: &Verdict, record: usize, covers: CoversFn<'_>) -> Vec<Reason> {
    let record = &catalogue.records[record];
    let changed = record.files.iter().filter(|file| verdict.files[**file] == FileState::Changed);
    let mut reasons: Vec<Reason> = changed
        .map(|file| {
            let path = catalogue.files[*file].path.clone();
            Reason::File { is_gone: !path.exists(), path }
        })
        .collect();
    for lookup in record.lookups.iter().map(|lookup| &catalogue.lookups[*lookup]) {
        for directory in &catalogue.directory_lists[lookup.directories] {
            let (before, now) = (&catalogue.directories[*directory], &verdict.directories[*directory]);
            reasons.extend(lookup_reasons(before, now, &lookup.name, covers));
        }
    }
    reasons.sort();
    reasons.dedup();
    // If a file that was read no longer exists, report only that, and not its name as well.
    let gone: Vec<Utf8PathBuf> = reasons.iter().filter_map(Reason::missing_file).cloned().collect();
    reasons.retain(|reason| !matches!(reason, Reason::Name { file, .. } if gone.contains(file)));
    reasons
}

impl Reason {
    fn missing_file(&self) -> Option<&Utf8PathBuf> {
        match self {
            Self::File { path, is_gone: true } => Some(path),
            _ => None,
        }
    }
}

fn lookup_reasons(
    before: &DirectoryFact,
    now: &DirectoryFact,
    path: &str,
    covers: CoversFn<'_>,
) -> Vec<Reason> {
    let directory = &now.path;
    match DirectoryChange::of(before, now) {
        DirectoryChange::None => Vec::new(),
        DirectoryChange::Links => vec![Reason::Links { directory: directory.clone() }],
        DirectoryChange::Names(names) => {
            let covering = names.into_iter().filter(|name| covers(name, path));
            let reason = |name: Box<str>| Reason::Name {
                file: directory.join(&*name),
                path: path.into(),
                is_gone: !now.names.contains(&name),
            };
            covering.map(reason).collect()
        }
    }
}

/// The names of drawings in a directory.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listing {
    /// The names of the drawings; sorted once the listing is complete.
    pub names: Vec<Box<str>>,
    /// The names of drawings that are symbolic links, in any order.
    pub links: Vec<Box<str>>,
    /// Whether names may be missing.
    pub is_doubtful: bool,
}

/// Directories that the run has already listed, as the run spells their paths.
pub type Listings = HashMap<Utf8PathBuf, Listing>;

impl Listing {
    /// Adds a directory entry that is not itself a directory, if it is a drawing.
    pub fn add(&mut self, name: &str, is_link: bool) {
        if is_drawing(Utf8Path::new(name)) {
            self.names.push(name.into());
            if is_link {
                self.links.push(name.into());
            }
        }
    }

    /// Lists a directory. The listing is empty for a missing directory, and doubtful for one that cannot be read.
    fn of(directory: &Utf8Path) -> Self {
        let mut listing = Self::default();
        let entries = match fs::read_dir(directory) {
            Ok(entries) => entries,
            Err(error) => {
                listing.is_doubtful = error.kind() != io::ErrorKind::NotFound;
                return listing;
            }
        };
        for entry in entries {
            let Ok(entry) = entry else {
                listing.is_doubtful = true;
                continue;
            };
            // Convert names that are not UTF-8 lossily, as `System` does.
            if let Some(file_type) = entry.file_type().ok().filter(|file_type| !file_type.is_dir()) {
                listing.add(&entry.file_name().to_string_lossy(), file_type.is_symlink());
            }
        }
        listing.names.sort_unstable();
        listing
    }
}

impl DirectoryFact {
    /// Reads the current state of a directory. `base` is the configuration's directory.
    pub fn read_current(path: &Utf8Path, base: &Utf8Path) -> Self {
        Self::from_listing(path, base, None)
    }

    /// Like [`read_current`](Self::read_current), but reuses an earlier listing if there is one.
    pub(crate) fn from_listing(path: &Utf8Path, base: &Utf8Path, listed: Option<Listing>) -> Self {
        let place = or_current_directory(path);
        let Listing { names, mut links, is_doubtful } = listed.unwrap_or_else(|| Listing::of(place));
        let mut canonical = canonical(place, base);
        links.sort_unstable();
        for link in links {
            // The separator is a character that occurs in no path.
            canonical.push('\0');
            canonical.push_str(&self::canonical(&place.join(&*link), base));
        }
        Self { path: path.to_owned(), names, canonical: canonical.into(), is_doubtful }
    }
}

/// Returns the canonical path, relative to `base` if inside it; empty if there is no such file.
fn canonical(place: &Utf8Path, base: &Utf8Path) -> String {
    let Ok(place) = place.canonicalize_utf8() else { return String::new() };
    let base = base.canonicalize_utf8().unwrap_or_else(|_| base.to_owned());
    place.strip_prefix(&base).map_or(place.as_str(), Utf8Path::as_str).to_owned()
}
