//! Where results are stored: in the user's cache directory, in a directory named after the tree's real path, so that no repository can
//! bring its own cache; or in a directory that the user named. Any number of processes may read and write there: files are replaced
//! atomically, so every file is complete, and the last writer wins. (book: reference/configuration)

use std::io;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Text;
use pathbuild_diagnostic::reasons::{self, HOLDS_OTHERS};

use crate::facts::Catalogue;
use crate::flat::CatalogueTooLarge;
use crate::format::{self, CacheFault, Key};
use crate::snapshot::Snapshot;
use crate::upkeep::is_ours;
use pathbuild_files::Clock;
use pathbuild_files::private;

/// Where the results of all trees are stored.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Home {
    /// pathbuild's directory in the user's cache directory; each tree has a subdirectory.
    User(Utf8PathBuf),
    /// A directory that the user named. It is trusted whichever tree it was made for, so that it also serves copies of that tree.
    Named(Utf8PathBuf),
}

/// Where the results of one tree are stored.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TreeStore {
    directory: Utf8PathBuf,
    /// Real path of the tree; `None` if the user named the directory.
    tree: Option<Utf8PathBuf>,
}

/// Name of the file that records the tree's path.
pub(crate) const TREE: &str = "tree";
/// Size limit of results files in bytes: a planted file must not exhaust the memory.
pub(crate) const LARGEST: u64 = 1 << 30;
/// Size limit of the other files in bytes.
pub(crate) const SMALL: u64 = 1 << 16;
/// Name of the file that marks a directory as a cache.
pub(crate) const TAG: &str = "CACHEDIR.TAG";

impl TreeStore {
    /// The store of the tree with this configuration directory. Creates nothing yet.
    pub fn of_tree(home: &Home, tree: &Utf8Path) -> Self {
        match home {
            Home::Named(directory) => Self { directory: directory.clone(), tree: None },
            Home::User(caches) => {
                let tree = tree.canonicalize_utf8().unwrap_or_else(|_| tree.to_owned());
                Self { directory: caches.join(name_of(&tree)), tree: Some(tree) }
            }
        }
    }

    /// The directory of the results.
    pub fn directory(&self) -> &Utf8Path {
        &self.directory
    }

    /// Why the store must not be used: its directory is a symbolic link, belongs to another user, or holds other files.
    pub fn refusal(&self) -> Option<&'static Text> {
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

    /// Loads the results of a key; `None` if there are none.
    ///
    /// # Errors
    /// Why the results file cannot be used.
    pub fn load(&self, key: &Key) -> Result<Option<Snapshot>, CacheFault> {
        match private::read(&self.directory.join(key.file_name()), LARGEST) {
            Ok(Some(file)) => format::decode(key, file).map(Some),
            Ok(None) => Ok(None),
            Err(_) => Err(CacheFault::Damaged),
        }
    }

    /// Stores results under a key, replacing earlier ones.
    ///
    /// # Errors
    /// If they cannot be written; the earlier ones remain.
    pub fn store(&self, key: &Key, catalogue: &Catalogue) -> io::Result<()> {
        let too_much = || reasons::error(io::ErrorKind::Other, &reasons::TOO_MUCH_TO_KEEP);
        let bytes = format::encode(key, catalogue).map_err(|CatalogueTooLarge| too_much())?;
        if bytes.len() as u64 > LARGEST {
            return Err(too_much());
        }
        self.make()?;
        private::replace(&self.directory, &key.file_name(), &bytes)
    }

    /// Current time of the directory's file system.
    ///
    /// # Errors
    /// If nothing can be written there.
    pub fn clock(&self) -> io::Result<Clock> {
        Clock::of(&self.directory)
    }

    /// Creates the directory, and the tag that keeps it out of backups. Returns whether the directory is new.
    ///
    /// # Errors
    /// If it cannot be created.
    pub fn make(&self) -> io::Result<bool> {
        let is_new = private::make_directory(&self.directory)?;
        let tag = private::read(&self.directory.join(TAG), SMALL);
        if tag.map_err(|_| reasons::error(io::ErrorKind::Other, &reasons::TAG_UNREADABLE))?.is_none() {
            private::replace(&self.directory, TAG, TAG_TEXT.as_bytes())?;
            if let Some(tree) = &self.tree {
                private::replace(&self.directory, TREE, tree.as_str().as_bytes())?;
            }
        }
        Ok(is_new)
    }
}

/// Whether a cache tag was written by pathbuild: other programs use the same signature line.
pub(crate) fn is_own_tag(tag: &[u8]) -> bool {
    tag == TAG_TEXT.as_bytes()
}

/// Whether the directory's tree file was written by pathbuild: the directory is named after that tree.
pub(crate) fn is_own_tree(directory: &Utf8Path) -> bool {
    let tree = private::read(&directory.join(TREE), SMALL).ok().flatten();
    let tree = tree.and_then(|tree| String::from_utf8(tree).ok());
    tree.is_some_and(|tree| directory.file_name() == Some(name_of(Utf8Path::new(&tree)).as_str()))
}

/// Name of a tree's subdirectory in the user's cache directory.
fn name_of(tree: &Utf8Path) -> String {
    blake3::hash(tree.as_str().as_bytes()).to_hex()[..NAME_LENGTH].to_owned()
}

/// Number of hexadecimal digits in the name of a tree's subdirectory.
const NAME_LENGTH: usize = 32;

const TAG_TEXT: &str = "Signature: 8a477f597d28d172789f06886806bc55\n\
    # This directory holds results that pathbuild can make again. It may be deleted at any time.\n\
    # https://bford.info/cachedir/\n";
