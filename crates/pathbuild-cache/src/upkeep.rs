//! Looking after what is kept: how much there is, whether it is whole, and removing it.
#![expect(clippy::disallowed_methods, reason = "the cache's own files, which no result depends on")]

use std::fs;
use std::io;
use std::time::{Duration, SystemTime};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Value;
use pathbuild_diagnostic::reasons::{NO_CACHE, reason};

use crate::format::{self, Key, Unusable};
use crate::private;
use crate::stamp::CLOCK;
use crate::tree_store::{Home, LARGEST, SMALL, TAG, TREE, TreeStore, is_own_tag, is_own_tree};

/// A file of kept results.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Where it is.
    pub path: Utf8PathBuf,
    /// Its size in bytes.
    pub size: u64,
    /// Why it cannot be used; `None` where it can.
    pub fault: Option<Unusable>,
}

/// What could not be removed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotRemoved {
    /// The file, or the directory.
    pub path: Utf8PathBuf,
    /// Why not.
    pub reason: Value,
}

/// How long results that nobody asked for are kept when the cache is pruned.
const UNUSED: Duration = Duration::from_hours(30 * 24);
/// After which time a file that a process was writing must have been left behind.
const LEFT_BEHIND: Duration = Duration::from_hours(1);

impl TreeStore {
    /// Every file of results, in order of name, and whether this build of the program can use it.
    pub fn entries(&self, build: &Key) -> Vec<Entry> {
        let mut entries: Vec<Entry> = names(self.directory())
            .filter(|name| format::is_file_name(name))
            .map(|name| self.directory().join(name))
            .map(|path| Entry {
                size: fs::symlink_metadata(&path).map_or(0, |data| data.len()),
                fault: fault(&path, build),
                path,
            })
            .collect();
        entries.sort_by(|a, b| a.path.cmp(&b.path));
        entries
    }

    /// Removes what no longer serves: what cannot be used, what was not written for a month, and what a process left that was killed. Gives
    /// back how many files that were.
    ///
    /// # Errors
    /// When one of them cannot be removed, or it is no cache: then nothing is.
    pub fn prune(&self, build: &Key) -> Result<usize, NotRemoved> {
        refuse_others(self.directory())?;
        let unused = self.entries(build).into_iter();
        let unused = unused.filter(|entry| entry.fault.is_some() || is_older(&entry.path, UNUSED));
        let left = names(self.directory()).filter(|name| is_temporary(name));
        let left = left.map(|name| self.directory().join(name)).filter(|path| is_older(path, LEFT_BEHIND));
        let all: Vec<Utf8PathBuf> = unused.map(|entry| entry.path).chain(left).collect();
        all.iter().try_for_each(|path| remove(path))?;
        Ok(all.len())
    }

    /// Removes all of it; whether there was anything.
    ///
    /// # Errors
    /// When it cannot be removed, or is no cache: then nothing is.
    pub fn clean(&self) -> Result<bool, NotRemoved> {
        let is_there = fs::symlink_metadata(self.directory()).is_ok();
        if is_there {
            clean(self.directory())?;
        }
        Ok(is_there)
    }
}

impl Home {
    /// Removes the results of trees that are gone; how many trees that were.
    ///
    /// # Errors
    /// When they cannot be removed.
    pub fn prune(&self) -> Result<usize, NotRemoved> {
        let Self::User(caches) = self else { return Ok(0) };
        let (mut removed, mut not_removed) = (0, None);
        for directory in names(caches).map(|name| caches.join(name)) {
            let tree = private::read(&directory.join(TREE), SMALL).ok().flatten();
            let tree = tree.and_then(|tree| String::from_utf8(tree).ok());
            if tree.is_some_and(|tree| !Utf8Path::new(&tree).as_std_path().exists()) {
                match clean(&directory) {
                    Ok(()) => removed += 1,
                    // The others go all the same.
                    Err(error) => not_removed = Some(error),
                }
            }
        }
        not_removed.map_or(Ok(removed), Err)
    }
}

/// Whether a file in a directory of kept results is one that pathbuild makes there.
pub(crate) fn is_ours(directory: &Utf8Path, name: &str) -> bool {
    let is_named_so = format::is_file_name(name) || is_temporary(name) || name == TAG;
    is_named_so || name == TREE && is_own_tree(directory)
}

/// As [`private::create_beside`] names what becomes one of those files.
fn is_temporary(name: &str) -> bool {
    let word = name.strip_prefix('.').and_then(|name| name.strip_suffix(".tmp"));
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    word.and_then(|word| word.rsplit_once('.')).is_some_and(|(name, numbers)| {
        (format::is_file_name(name) || matches!(name, TAG | TREE | CLOCK))
            && numbers
                .split_once('-')
                .is_some_and(|(process, attempt)| is_number(process) && is_number(attempt))
    })
}

/// Removes what pathbuild made in a directory, and the directory where nothing else is in it.
fn clean(directory: &Utf8Path) -> Result<(), NotRemoved> {
    refuse_others(directory)?;
    // What says that it is a cache goes last.
    let ours: Vec<String> = names(directory).filter(|name| name != TAG && is_ours(directory, name)).collect();
    for name in ours.into_iter().chain([TAG.to_owned()]) {
        remove(&directory.join(name))?;
    }
    match fs::remove_dir(directory) {
        Err(error) if !matches!(error.kind(), io::ErrorKind::DirectoryNotEmpty | io::ErrorKind::NotFound) => {
            Err(not_removed(directory, &error))
        }
        _ => Ok(()),
    }
}

/// Nothing is removed through a link, or from a directory that pathbuild has not made: names like its own may be anybody's.
fn refuse_others(directory: &Utf8Path) -> Result<(), NotRemoved> {
    let refused = |word| NotRemoved { path: directory.to_owned(), reason: Value::Word(word) };
    if let Some(word) = private::refusal(directory) {
        return Err(refused(word));
    }
    let tag = directory.join(TAG);
    let tag = private::read(&tag, SMALL).map_err(|reason| NotRemoved { path: tag, reason })?;
    // Another run may be about to write it, or just have removed it: then there is nothing else but what pathbuild makes.
    let is_cache =
        tag.map_or_else(|| names(directory).all(|name| is_ours(directory, &name)), |tag| is_own_tag(&tag));
    if !is_cache {
        return Err(refused(&NO_CACHE));
    }
    Ok(())
}

fn remove(path: &Utf8Path) -> Result<(), NotRemoved> {
    private::remove(path).map_err(|error| not_removed(path, &error))
}

fn not_removed(path: &Utf8Path, error: &io::Error) -> NotRemoved {
    NotRemoved { path: path.to_owned(), reason: reason(error) }
}

fn names(directory: &Utf8Path) -> impl Iterator<Item = String> + use<> {
    let listed = directory.read_dir_utf8().into_iter().flatten().filter_map(Result::ok);
    listed.map(|entry| entry.file_name().to_owned()).collect::<Vec<_>>().into_iter()
}

fn fault(path: &Utf8Path, build: &Key) -> Option<Unusable> {
    let Ok(Some(file)) = private::read(path, LARGEST) else { return Some(Unusable::Damaged) };
    let Some(key) = format::key_of(&file) else { return Some(Unusable::Damaged) };
    if key.build != build.build {
        return Some(Unusable::Foreign);
    }
    format::decode(&key, file).err()
}

fn is_older(path: &Utf8Path, age: Duration) -> bool {
    let modified = fs::symlink_metadata(path).and_then(|data| data.modified());
    modified.is_ok_and(|time| SystemTime::now().duration_since(time).is_ok_and(|since| since > age))
}
