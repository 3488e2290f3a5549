//! Stores results in a directory that is named by a hash of the tree's real path, in the user's cache directory, so that no repository can bring its
//! own cache; or in a directory that the user named. Any number of processes may read and write in this directory: files are replaced atomically, so
//! every file is complete, and the last writer wins. (book: reference/configuration)

#![expect(clippy::disallowed_methods, reason = "these are the cache's own files; no result depends on them")]

use std::time::{Duration, SystemTime};
use std::{fs, io};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::reasons::{self, HOLDS_OTHERS, NO_CACHE, reason};
use pathbuild_diagnostic::{Text, Value};
use pathbuild_files::{CLOCK, FileSystemTime, private};

use crate::catalogue::{CacheFault, Catalogue, Key, decode_file, encode_file, is_file_name, key_of};

/// The place where the results of all trees are stored.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CacheLocation {
    /// pathbuild's directory in the user's cache directory; each tree has a subdirectory.
    User(Utf8PathBuf),
    /// A directory that the user named. It is trusted regardless of the tree for which it was created, so that it also serves copies of that tree.
    Named(Utf8PathBuf),
}

/// The place where the results of one tree are stored.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TreeStore {
    directory: Utf8PathBuf,
    /// Real path of the tree; `None` if the user named the directory.
    tree: Option<Utf8PathBuf>,
}

/// Name of the file that records the tree's path.
const TREE_FILE: &str = "tree";
/// Size limit of results files in bytes: a planted file must not exhaust the memory.
const MAX_RESULTS_BYTES: u64 = 1 << 30;
/// Size limit of the tree file and of the cache tag in bytes.
const MAX_TAG_BYTES: u64 = 1 << 16;
/// Name of the file that marks a directory as a cache.
const TAG_FILE: &str = "CACHEDIR.TAG";

impl TreeStore {
    /// Returns the store of the tree with this configuration directory. Nothing is created yet.
    pub fn of_tree(home: &CacheLocation, tree: &Utf8Path) -> Self {
        match home {
            CacheLocation::Named(directory) => Self { directory: directory.clone(), tree: None },
            CacheLocation::User(caches) => {
                let tree = tree.canonicalize_utf8().unwrap_or_else(|_| tree.to_owned());
                Self { directory: caches.join(tree_directory_name(&tree)), tree: Some(tree) }
            }
        }
    }

    /// Returns the directory of the results.
    pub fn directory(&self) -> &Utf8Path {
        &self.directory
    }

    /// Returns the reason why the store must not be used, if there is one: for example, its directory is a symbolic link, belongs to another user,
    /// can be written by every user, or holds files of other programs.
    pub fn refusal(&self) -> Option<&'static Text> {
        let holds_others = || entry_names(&self.directory).any(|name| !is_ours(&self.directory, &name));
        let is_right = || match private::read(&self.directory.join(TAG_FILE), MAX_TAG_BYTES) {
            Ok(Some(tag)) => is_own_tag(&tag),
            Ok(None) => !holds_others(),
            Err(_) => false,
        };
        private::refusal(&self.directory).or_else(|| (!is_right()).then_some(&HOLDS_OTHERS))
    }

    /// Loads the results of a key; `None` if there are none.
    ///
    /// # Errors
    /// The reason why the results file cannot be used.
    pub fn load(&self, key: &Key) -> Result<Option<Catalogue>, CacheFault> {
        match private::read(&self.directory.join(key.file_name()), MAX_RESULTS_BYTES) {
            Ok(Some(file)) => decode_file(key, &file).map(Some),
            Ok(None) => Ok(None),
            Err(_) => Err(CacheFault::Damaged),
        }
    }

    /// Stores results under a key, replacing earlier ones.
    ///
    /// # Errors
    /// If the results cannot be written; the earlier results remain.
    pub fn store(&self, key: &Key, mut catalogue: Catalogue) -> io::Result<()> {
        catalogue.records.sort_unstable_by(|a, b| a.subject.cmp(&b.subject));
        let too_much = || reasons::text_error(io::ErrorKind::Other, &reasons::RESULT_TOO_LARGE);
        let bytes = encode_file(key, &catalogue).ok_or_else(too_much)?;
        if bytes.len() as u64 > MAX_RESULTS_BYTES {
            return Err(too_much());
        }
        self.create()?;
        private::replace(&self.directory, &key.file_name(), &bytes)
    }

    /// Returns the current time of the directory's file system.
    ///
    /// # Errors
    /// If no file can be written in the directory.
    pub fn clock(&self) -> io::Result<FileSystemTime> {
        FileSystemTime::now_in(&self.directory)
    }

    /// Creates the directory, and the tag that keeps it out of backups. Returns whether the directory is new.
    ///
    /// # Errors
    /// If the directory or a file in it cannot be created, or if an existing tag cannot be read.
    pub fn create(&self) -> io::Result<bool> {
        let is_new = private::make_directory(&self.directory)?;
        let tag = private::read(&self.directory.join(TAG_FILE), MAX_TAG_BYTES);
        if tag.map_err(|_| reasons::text_error(io::ErrorKind::Other, &reasons::TAG_UNREADABLE))?.is_none() {
            private::replace(&self.directory, TAG_FILE, TAG_TEXT.as_bytes())?;
            if let Some(tree) = &self.tree {
                private::replace(&self.directory, TREE_FILE, tree.as_str().as_bytes())?;
            }
        }
        Ok(is_new)
    }
}

/// Whether pathbuild wrote a cache tag. The whole text is compared, because other programs use the same signature line.
fn is_own_tag(tag: &[u8]) -> bool {
    tag == TAG_TEXT.as_bytes()
}

/// Whether pathbuild wrote the directory's tree file: then the directory has the name that pathbuild gives to the tree in that file.
fn is_own_tree(directory: &Utf8Path) -> bool {
    recorded_tree(directory).is_some_and(|tree| directory.file_name() == Some(&tree_directory_name(&tree)))
}

/// Returns the tree that a directory's tree file names.
fn recorded_tree(directory: &Utf8Path) -> Option<Utf8PathBuf> {
    let tree = private::read(&directory.join(TREE_FILE), MAX_TAG_BYTES).ok().flatten()?;
    String::from_utf8(tree).ok().map(Utf8PathBuf::from)
}

/// Returns the name of a tree's subdirectory in the user's cache directory.
fn tree_directory_name(tree: &Utf8Path) -> String {
    blake3::hash(tree.as_str().as_bytes()).to_hex()[..NAME_LENGTH].to_owned()
}

/// Number of hexadecimal digits in the name of a tree's subdirectory.
const NAME_LENGTH: usize = 32;

const TAG_TEXT: &str = "Signature: 8a477f597d28d172789f06886806bc55\n\
    # This directory holds results that pathbuild can make again. It may be deleted at any time.\n\
    # https://bford.info/cachedir/\n";

/// A results file in a store.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Path of the results file.
    pub path: Utf8PathBuf,
    /// Size in bytes.
    pub size: u64,
    /// The reason why the file cannot be used; `None` if it can.
    pub fault: Option<CacheFault>,
}

/// A file or directory that could not be removed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RemoveError {
    /// Path of the file or directory.
    pub path: Utf8PathBuf,
    /// The reason why it could not be removed.
    pub reason: Value,
}

/// Age after which pruning removes results that have not been rewritten: 30 days.
const UNUSED_AGE: Duration = Duration::from_hours(30 * 24);
/// Age after which a temporary file is considered abandoned by a killed process: one hour.
const ABANDONED_AGE: Duration = Duration::from_hours(1);

impl TreeStore {
    /// Lists all results files, sorted by name, and checks whether this build of the program can use them.
    pub fn entries(&self, build: &Key) -> Vec<Entry> {
        let mut entries: Vec<Entry> = entry_names(self.directory())
            .filter(|name| is_file_name(name))
            .map(|name| self.directory().join(name))
            .map(|path| Entry {
                size: fs::symlink_metadata(&path).map_or(0, |data| data.len()),
                fault: cache_fault(&path, build),
                path,
            })
            .collect();
        entries.sort_by(|a, b| a.path.cmp(&b.path));
        entries
    }

    /// Removes useless files: those that cannot be used, those not rewritten for a month, and temporary files of killed processes. Returns the number
    /// of removed files.
    ///
    /// # Errors
    /// If one of them cannot be removed. If the directory is not a cache, nothing is removed.
    pub fn prune(&self, build: &Key) -> Result<usize, RemoveError> {
        refuse_foreign_directory(self.directory())?;
        let unused = self.entries(build).into_iter();
        let unused = unused.filter(|entry| entry.fault.is_some() || is_older(&entry.path, UNUSED_AGE));
        let abandoned = entry_names(self.directory()).filter(|name| is_temporary(name));
        let abandoned =
            abandoned.map(|name| self.directory().join(name)).filter(|path| is_older(path, ABANDONED_AGE));
        let all: Vec<Utf8PathBuf> = unused.map(|entry| entry.path).chain(abandoned).collect();
        all.iter().try_for_each(|path| remove(path))?;
        Ok(all.len())
    }

    /// Removes the whole store. Returns whether it existed.
    ///
    /// # Errors
    /// If the store cannot be removed. If its directory is not a cache, nothing is removed.
    pub fn clean(&self) -> Result<bool, RemoveError> {
        let is_there = fs::symlink_metadata(self.directory()).is_ok();
        if is_there {
            clean(self.directory())?;
        }
        Ok(is_there)
    }
}

impl CacheLocation {
    /// Removes the results of trees that no longer exist. Returns the number of these trees, which is 0 for a directory that the user named.
    ///
    /// # Errors
    /// If the results of a tree cannot be removed. Those of the other trees are removed nevertheless.
    pub fn prune(&self) -> Result<usize, RemoveError> {
        let Self::User(caches) = self else { return Ok(0) };
        let (mut removed, mut not_removed) = (0, None);
        for directory in entry_names(caches).map(|name| caches.join(name)) {
            if recorded_tree(&directory).is_some_and(|tree| !tree.exists()) {
                match clean(&directory) {
                    Ok(()) => removed += 1,
                    // Continue with the other trees.
                    Err(error) => not_removed = Some(error),
                }
            }
        }
        not_removed.map_or(Ok(removed), Err)
    }
}

/// Whether pathbuild creates files of this name in a results directory.
fn is_ours(directory: &Utf8Path, name: &str) -> bool {
    let is_named_so = is_file_name(name) || is_temporary(name) || name == TAG_FILE;
    is_named_so || name == TREE_FILE && is_own_tree(directory)
}

/// Whether this is the name of a temporary file for one of pathbuild's own files.
fn is_temporary(name: &str) -> bool {
    let is_ours = |name: &str| is_file_name(name) || matches!(name, TAG_FILE | TREE_FILE | CLOCK);
    pathbuild_files::is_temporary(name, is_ours)
}

/// Removes pathbuild's files from a directory, and the directory itself if it is then empty.
fn clean(directory: &Utf8Path) -> Result<(), RemoveError> {
    refuse_foreign_directory(directory)?;
    // The tag that marks the directory as a cache is removed last.
    let ours: Vec<String> =
        entry_names(directory).filter(|name| name != TAG_FILE && is_ours(directory, name)).collect();
    for name in ours.into_iter().chain([TAG_FILE.to_owned()]) {
        remove(&directory.join(name))?;
    }
    match fs::remove_dir(directory) {
        Err(error) if !matches!(error.kind(), io::ErrorKind::DirectoryNotEmpty | io::ErrorKind::NotFound) => {
            Err(remove_error(directory, &error))
        }
        _ => Ok(()),
    }
}

/// Refuses directories reached through a symbolic link or not created by pathbuild: other programs may use the same file names.
fn refuse_foreign_directory(directory: &Utf8Path) -> Result<(), RemoveError> {
    let refused = |word| RemoveError { path: directory.to_owned(), reason: Value::Prose(word) };
    if let Some(word) = private::refusal(directory) {
        return Err(refused(word));
    }
    let tag = directory.join(TAG_FILE);
    let tag = private::read(&tag, MAX_TAG_BYTES).map_err(|reason| RemoveError { path: tag, reason })?;
    // Another process may be about to write the tag, or may just have removed it. All other files must then be pathbuild's.
    let is_cache = tag
        .map_or_else(|| entry_names(directory).all(|name| is_ours(directory, &name)), |tag| is_own_tag(&tag));
    if !is_cache {
        return Err(refused(&NO_CACHE));
    }
    Ok(())
}

fn remove(path: &Utf8Path) -> Result<(), RemoveError> {
    private::remove(path).map_err(|error| remove_error(path, &error))
}

fn remove_error(path: &Utf8Path, error: &io::Error) -> RemoveError {
    RemoveError { path: path.to_owned(), reason: reason(error) }
}

fn entry_names(directory: &Utf8Path) -> impl Iterator<Item = String> + use<> {
    let listed = directory.read_dir_utf8().into_iter().flatten().filter_map(Result::ok);
    listed.map(|entry| entry.file_name().to_owned()).collect::<Vec<_>>().into_iter()
}

fn cache_fault(path: &Utf8Path, build: &Key) -> Option<CacheFault> {
    let Ok(Some(file)) = private::read(path, MAX_RESULTS_BYTES) else { return Some(CacheFault::Damaged) };
    let Some(key) = key_of(&file) else { return Some(CacheFault::Damaged) };
    if key.build != build.build {
        return Some(CacheFault::Foreign);
    }
    decode_file(&key, &file).err()
}

fn is_older(path: &Utf8Path, age: Duration) -> bool {
    let modified = fs::symlink_metadata(path).and_then(|data| data.modified());
    modified.is_ok_and(|time| SystemTime::now().duration_since(time).is_ok_and(|since| since > age))
}
