//! Results to be cached, and the inputs that they depend on.

use camino::Utf8PathBuf;

use crate::names::Names;
use pathbuild_files::Stamp;

/// Results to be stored, with all their inputs. Files, directories and lookups that several results share are stored once.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Catalogue {
    /// Every file that was read.
    pub files: Vec<FileFact>,
    /// Every directory that was listed.
    pub directories: Vec<DirectoryFact>,
    /// Sets of directories that are searched together, as indices into `directories`. Thousands of lookups search the same set.
    pub directory_lists: Vec<Vec<usize>>,
    /// Every lookup.
    pub lookups: Vec<Lookup>,
    /// The results.
    pub records: Vec<Record>,
}

/// A file as it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct FileFact {
    /// Its path, spelled as in the run that read it.
    pub path: Utf8PathBuf,
    /// The file's metadata when it was read.
    pub stamp: Stamp,
    /// The blake3 hash of its bytes; `None` if it could not be read.
    pub hash: Option<[u8; 32]>,
}

/// A directory as it was listed.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectoryFact {
    /// Its path, spelled as in the run that read it.
    pub path: Utf8PathBuf,
    /// The names of its drawings, sorted.
    pub names: Names,
    /// Canonical paths of the directory and of the target of each symbolic link in it, relative to the configuration's directory if inside it.
    /// They decide whether two files are the same.
    pub canonical: Box<str>,
    /// Whether lookups in this directory are always repeated: names may be missing, or the directory changed while it was read.
    pub is_doubtful: bool,
}

/// A result.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// What the result is about, mostly a drawing. Unique among the records.
    pub subject: Box<str>,
    /// The files that were read, as indices into [`Catalogue::files`].
    pub files: Vec<usize>,
    /// The lookups that were made, as indices into [`Catalogue::lookups`].
    pub lookups: Vec<usize>,
    /// The files that were written, as indices into [`Catalogue::files`]. If one is missing, the result still holds, but the file must be
    /// written again.
    pub outputs: Vec<usize>,
    /// The result itself; only the crate that stored it can decode it.
    pub payload: Vec<u8>,
}

/// A search in directories: which of their files may contain the path of this name?
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Lookup {
    /// Index into [`Catalogue::directory_lists`].
    pub directories: usize,
    /// Name of the path.
    pub name: Box<str>,
}

/// Whether a file name has the extension of a drawing.
pub(crate) fn is_drawing(name: &str) -> bool {
    const EXTENSION: &str = "dxf";
    let stem = name.len().checked_sub(EXTENSION.len() + 1).filter(|stem| *stem > 0);
    stem.is_some_and(|stem| {
        let bytes = name.as_bytes();
        bytes[stem] == b'.' && bytes[stem + 1..].eq_ignore_ascii_case(EXTENSION.as_bytes())
    })
}
