//! The directory `.pathbuild` beside a configuration. Any number of processes may read and write it: files are written beside and renamed, so
//! that a file is always one that somebody finished, and the last one counts.
#![expect(clippy::disallowed_methods, reason = "the cache's own files, which no result depends on")]

use std::fs;
use std::io;
use std::time::{Duration, SystemTime};

use camino::{Utf8Path, Utf8PathBuf};

use crate::facts::Catalogue;
use crate::flat::TooMuch;
use crate::format::{self, Key, SUFFIX, Unusable};
use crate::kept::Kept;
use crate::stamp::Clock;

/// Where results are kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    directory: Utf8PathBuf,
}

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

/// How long results that nobody asked for are kept when the cache is pruned.
const UNUSED: Duration = Duration::from_hours(30 * 24);

const TAG: &str = "Signature: 8a477f597d28d172789f06886806bc55\n\
    # This directory holds results that pathbuild can make again. It may be deleted at any time.\n\
    # https://bford.info/cachedir/\n";

impl Place {
    /// The cache of a configuration's directory. Nothing is made yet.
    pub fn beside(configuration: &Utf8Path) -> Self {
        Self { directory: configuration.join(".pathbuild") }
    }

    /// Where it is.
    pub fn directory(&self) -> &Utf8Path {
        &self.directory
    }

    /// What is kept under a key; `None` where nothing is.
    ///
    /// # Errors
    /// Why what is there cannot be used.
    pub fn load(&self, key: &Key) -> Result<Option<Kept>, Unusable> {
        match fs::read(self.directory.join(key.file_name())) {
            Ok(file) => format::decode(key, file).map(Some),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(_) => Err(Unusable::Damaged),
        }
    }

    /// Keeps results under a key, instead of what was there.
    ///
    /// # Errors
    /// When it cannot be written; what was there still is.
    pub fn store(&self, key: &Key, catalogue: &Catalogue) -> io::Result<()> {
        let bytes = format::encode(key, catalogue)
            .map_err(|TooMuch| io::Error::other("there is more to keep than a file can hold"))?;
        self.make()?;
        self.write(&key.file_name(), &bytes)
    }

    /// What time it is by the clock of its file system.
    ///
    /// # Errors
    /// When nothing can be written there.
    pub fn clock(&self) -> io::Result<Clock> {
        self.make()?;
        Clock::of(&self.directory)
    }

    /// Every file of results, in order of name, and whether this build of the program can use it.
    pub fn entries(&self, build: &Key) -> Vec<Entry> {
        let listed = self.directory.read_dir_utf8().into_iter().flatten().filter_map(Result::ok);
        let mut entries: Vec<Entry> = listed
            .filter(|entry| entry.file_name().ends_with(SUFFIX))
            .map(|entry| Entry {
                path: entry.path().to_owned(),
                size: entry.metadata().map_or(0, |data| data.len()),
                fault: fault(entry.path(), build),
            })
            .collect();
        entries.sort_by(|a, b| a.path.cmp(&b.path));
        entries
    }

    /// Removes what no longer serves: what cannot be used, what was not written for a month, and what a process left that was killed. Gives back
    /// how many files that were.
    ///
    /// # Errors
    /// When one of them cannot be removed.
    pub fn prune(&self, build: &Key) -> io::Result<usize> {
        let mut removed = 0;
        for entry in self.entries(build) {
            if entry.fault.is_some() || is_older(&entry.path, UNUSED) {
                remove(&entry.path)?;
                removed += 1;
            }
        }
        for entry in self.directory.read_dir_utf8().into_iter().flatten().filter_map(Result::ok) {
            if entry.file_name().starts_with('.')
                && entry.file_name() != ".gitignore"
                && is_older(entry.path(), LEFT_BEHIND)
            {
                remove(entry.path())?;
                removed += 1;
            }
        }
        Ok(removed)
    }

    /// Removes all of it; whether there was anything.
    ///
    /// # Errors
    /// When it cannot be removed, or is no cache: then nothing is.
    pub fn clean(&self) -> io::Result<bool> {
        if !self.directory.as_std_path().exists() {
            return Ok(false);
        }
        let tag = fs::read_to_string(self.directory.join("CACHEDIR.TAG")).unwrap_or_default();
        if !tag.starts_with("Signature: 8a477f597d28d172789f06886806bc55") {
            return Err(io::Error::other("it has no CACHEDIR.TAG, so it is no cache"));
        }
        fs::remove_dir_all(&self.directory).map(|()| true)
    }

    /// Makes the directory, with what keeps it out of backups and repositories.
    fn make(&self) -> io::Result<()> {
        if self.directory.join("CACHEDIR.TAG").as_std_path().exists() {
            return Ok(());
        }
        fs::create_dir_all(&self.directory)?;
        self.write(".gitignore", b"*\n")?;
        self.write("CACHEDIR.TAG", TAG.as_bytes())
    }

    fn write(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        let path = self.directory.join(name);
        let beside = self.directory.join(format!(".{name}.{}.tmp", std::process::id()));
        let written = fs::write(&beside, bytes).and_then(|()| fs::rename(&beside, &path));
        if written.is_err() {
            // Best effort: the error that is reported is the one that came first.
            _ = fs::remove_file(&beside);
        }
        written
    }
}

/// After which time a file that a process was writing must have been left behind.
const LEFT_BEHIND: Duration = Duration::from_hours(1);

fn fault(path: &Utf8Path, build: &Key) -> Option<Unusable> {
    let Ok(file) = fs::read(path) else { return Some(Unusable::Damaged) };
    let Some(key) = format::key_of(&file) else { return Some(Unusable::Damaged) };
    if key.build != build.build {
        return Some(Unusable::Foreign);
    }
    format::decode(&key, file).err()
}

fn is_older(path: &Utf8Path, age: Duration) -> bool {
    let modified = fs::metadata(path).and_then(|data| data.modified());
    modified.is_ok_and(|time| SystemTime::now().duration_since(time).is_ok_and(|since| since > age))
}

/// That somebody else removed it is no error.
fn remove(path: &Utf8Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}
