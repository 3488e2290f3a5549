//! Where results lie: in the user's cache directory, under the tree's real path, so that no repository brings its own; or in a directory that
//! the user named. Any number of processes may read and write there: files are written beside and renamed, so that a file is always one that
//! somebody finished, and the last one counts. (book: reference/configuration)

use std::io;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Word;
use pathbuild_diagnostic::reasons::HOLDS_OTHERS;

use crate::facts::Catalogue;
use crate::flat::TooMuch;
use crate::format::{self, Key, Unusable};
use crate::private;
use crate::snapshot::Snapshot;
use crate::stamp::Clock;
use crate::upkeep::is_ours;

/// Where the results of trees are kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Home {
    /// The directory of pathbuild in the user's cache directory: each tree has a directory there.
    User(Utf8PathBuf),
    /// A directory that the user named. It is believed whatever tree it was made for, so that it holds for a copy too.
    Named(Utf8PathBuf),
}

/// Where the results of one tree are kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TreeStore {
    directory: Utf8PathBuf,
    /// The real path of the tree, where results are only for it.
    tree: Option<Utf8PathBuf>,
}

/// In which file of a tree's directory the tree's path is.
pub(crate) const TREE: &str = "tree";
/// Larger results are not read: a file that somebody put there must not fill the memory.
pub(crate) const LARGEST: u64 = 1 << 30;
/// The same of the other files.
pub(crate) const SMALL: u64 = 1 << 16;
/// What marks a directory as a cache.
pub(crate) const TAG: &str = "CACHEDIR.TAG";

impl TreeStore {
    /// That of the tree whose configuration is in this directory. Nothing is made yet.
    pub fn of_tree(home: &Home, tree: &Utf8Path) -> Self {
        match home {
            Home::Named(directory) => Self { directory: directory.clone(), tree: None },
            Home::User(caches) => {
                let tree = tree.canonicalize_utf8().unwrap_or_else(|_| tree.to_owned());
                Self { directory: caches.join(name_of(&tree)), tree: Some(tree) }
            }
        }
    }

    /// Where it is.
    pub fn directory(&self) -> &Utf8Path {
        &self.directory
    }

    /// Why it is not used: it is a link, somebody else's, or a directory of other things.
    pub fn refusal(&self) -> Option<&'static Word> {
        let holds_others = || {
            let mut listed = self.directory.read_dir_utf8().into_iter().flatten().filter_map(Result::ok);
            listed.any(|entry| !is_ours(&self.directory, entry.file_name()))
        };
        let is_right = || match private::read(&self.directory.join(TAG), SMALL) {
            Ok(Some(tag)) => is_own_tag(&tag),
            Ok(None) => !holds_others(),
            Err(_) => false,
        };
        private::refusal(&self.directory).or_else(|| (!is_right()).then_some(&HOLDS_OTHERS))
    }

    /// What is kept under a key; `None` where nothing is.
    ///
    /// # Errors
    /// Why what is there cannot be used.
    pub fn load(&self, key: &Key) -> Result<Option<Snapshot>, Unusable> {
        match private::read(&self.directory.join(key.file_name()), LARGEST) {
            Ok(Some(file)) => format::decode(key, file).map(Some),
            Ok(None) => Ok(None),
            Err(_) => Err(Unusable::Damaged),
        }
    }

    /// Keeps results under a key, instead of what was there.
    ///
    /// # Errors
    /// When it cannot be written; what was there still is.
    pub fn store(&self, key: &Key, catalogue: &Catalogue) -> io::Result<()> {
        let too_much = || io::Error::other("there is more to keep than a file can hold");
        let bytes = format::encode(key, catalogue).map_err(|TooMuch| too_much())?;
        if bytes.len() as u64 > LARGEST {
            return Err(too_much());
        }
        self.make()?;
        private::replace(&self.directory, &key.file_name(), &bytes)
    }

    /// What time it is by the clock of its file system.
    ///
    /// # Errors
    /// When nothing can be written there.
    pub fn clock(&self) -> io::Result<Clock> {
        Clock::of(&self.directory)
    }

    /// Makes the directory, with what keeps it out of backups; whether it was not there.
    ///
    /// # Errors
    /// When it cannot be made.
    pub fn make(&self) -> io::Result<bool> {
        let is_new = private::make_directory(&self.directory)?;
        let tag = private::read(&self.directory.join(TAG), SMALL);
        if tag.map_err(|_| io::Error::other("its CACHEDIR.TAG cannot be read"))?.is_none() {
            private::replace(&self.directory, TAG, TAG_TEXT.as_bytes())?;
            if let Some(tree) = &self.tree {
                private::replace(&self.directory, TREE, tree.as_str().as_bytes())?;
            }
        }
        Ok(is_new)
    }
}

/// Whether the file that marks a cache is pathbuild's: others mark theirs by the same signature.
pub(crate) fn is_own_tag(tag: &[u8]) -> bool {
    tag == TAG_TEXT.as_bytes()
}

/// Whether the file that names a tree is pathbuild's: the directory has its name from that tree.
pub(crate) fn is_own_tree(directory: &Utf8Path) -> bool {
    let tree = private::read(&directory.join(TREE), SMALL).ok().flatten();
    let tree = tree.and_then(|tree| String::from_utf8(tree).ok());
    tree.is_some_and(|tree| directory.file_name() == Some(name_of(Utf8Path::new(&tree)).as_str()))
}

/// The name of the directory in which results of a tree are kept in a user's cache directory.
fn name_of(tree: &Utf8Path) -> String {
    blake3::hash(tree.as_str().as_bytes()).to_hex()[..NAME_LENGTH].to_owned()
}

/// So many digits of a hash tell trees apart.
const NAME_LENGTH: usize = 32;

const TAG_TEXT: &str = "Signature: 8a477f597d28d172789f06886806bc55\n\
    # This directory holds results that pathbuild can make again. It may be deleted at any time.\n\
    # https://bford.info/cachedir/\n";
