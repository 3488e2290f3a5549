//! What a kept result was made from.

use camino::Utf8PathBuf;

use crate::names::Names;
use crate::stamp::Stamp;

/// Results with everything that they were made from, to be kept. Files, directories and questions that several were made from are in it once.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Catalogue {
    /// Every file that was read.
    pub files: Vec<FileFact>,
    /// Every directory that was listed.
    pub directories: Vec<DirectoryFact>,
    /// The directories that were asked together, by their numbers: the same ones are asked for thousands of names.
    pub directory_lists: Vec<Vec<usize>>,
    /// Every question.
    pub lookups: Vec<Lookup>,
    /// The results.
    pub records: Vec<Record>,
}

/// A file as it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct FileFact {
    /// As the run spelt it.
    pub path: Utf8PathBuf,
    /// What the system said of it.
    pub stamp: Stamp,
    /// The blake3 hash of its bytes; `None` where it could not be read.
    pub hash: Option<[u8; 32]>,
}

/// A directory as it was listed.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectoryFact {
    /// As the run spelt it.
    pub path: Utf8PathBuf,
    /// The names of its drawings, sorted.
    pub names: Names,
    /// Where it really is, relative to the configuration where it lies below it: links on the way to it decide whether two files are one.
    pub canonical: Box<str>,
    /// Whether what is asked of it is asked again in any case: there are links among the names, or they changed while they were read.
    pub is_doubtful: bool,
}

/// A result.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// What it is of: a drawing, mostly. No two are of the same.
    pub of: Box<str>,
    /// The files that it was made from, by their numbers.
    pub files: Vec<usize>,
    /// What was looked for, by the numbers of the questions.
    pub lookups: Vec<usize>,
    /// The files that were written of it, by their numbers: it holds without them, but then they are to be written again.
    pub outputs: Vec<usize>,
    /// The result itself, which only its maker can read.
    pub payload: Vec<u8>,
}

/// A question to directories: which of their names may hold this path?
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Lookup {
    /// The number of the list of the directories.
    pub directories: usize,
    /// The path's name.
    pub name: Box<str>,
}

/// Whether the name of a file is a drawing's.
pub(crate) fn is_drawing(name: &str) -> bool {
    const EXTENSION: &str = "dxf";
    let stem = name.len().checked_sub(EXTENSION.len() + 1).filter(|stem| *stem > 0);
    stem.is_some_and(|stem| {
        let bytes = name.as_bytes();
        bytes[stem] == b'.' && bytes[stem + 1..].eq_ignore_ascii_case(EXTENSION.as_bytes())
    })
}
