//! Files inserted by a post definition; they must be below its directory. (book: program/posts)

use std::cell::RefCell;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::System;
use pathbuild_diagnostic::Value;
use pathbuild_diagnostic::reasons::LEADS_OUT_OF_POST;
use pathbuild_post::PostFiles;

/// Access to a directory and everything below it.
#[derive(Debug)]
pub(super) struct DirectoryFiles<'a> {
    pub(super) directory: &'a Utf8Path,
    pub(super) system: &'a dyn System,
}

/// A file that a definition inserts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InsertedFile {
    /// Path relative to the definition's directory.
    pub name: Utf8PathBuf,
    /// Hash of the content; `None` if it could not be read.
    pub hash: Option<[u8; 32]>,
}

/// Like [`DirectoryFiles`], and records the files that were read.
#[derive(Debug)]
pub(super) struct RecordedFiles<'a> {
    pub(super) below: DirectoryFiles<'a>,
    pub(super) read: RefCell<Vec<InsertedFile>>,
}

impl PostFiles for RecordedFiles<'_> {
    fn read(&self, path: &Utf8Path) -> Result<Vec<u8>, Value> {
        let read = self.below.read(path);
        let hash = read.as_ref().ok().map(|bytes| *blake3::hash(bytes).as_bytes());
        self.read.borrow_mut().push(InsertedFile { name: path.to_owned(), hash });
        read
    }
}

/// Upper bound on the size of an inserted file in bytes.
const LARGEST: u64 = 1 << 24;

impl PostFiles for DirectoryFiles<'_> {
    fn read(&self, path: &Utf8Path) -> Result<Vec<u8>, Value> {
        let Self { directory, system } = self;
        let base =
            system.canonical(if directory.as_str().is_empty() { Utf8Path::new(".") } else { directory });
        let file = system.canonical(&directory.join(path));
        if !file.starts_with(&base) && file.is_absolute() {
            return Err(Value::Prose(&LEADS_OUT_OF_POST));
        }
        system.read(&file, LARGEST).map_err(|error| error.reason(LARGEST))
    }
}
