//! The files that a definition inserts: those below its directory. (book: program/posts)

use camino::Utf8Path;
use pathbuild_db::System;
use pathbuild_db::system::ReadError;
use pathbuild_diagnostic::Value;
use pathbuild_diagnostic::reasons::{IS_DIRECTORY, LEADS_OUT_OF_POST, NO_FILE};
use pathbuild_post::PostFiles;

/// A directory with all that is below it.
#[derive(Debug)]
pub(super) struct Below<'a> {
    pub(super) directory: &'a Utf8Path,
    pub(super) system: &'a dyn System,
}

/// Larger texts are no part of a program.
const LARGEST: u64 = 1 << 24;

impl PostFiles for Below<'_> {
    fn read(&self, path: &Utf8Path) -> Result<Vec<u8>, Value> {
        let Self { directory, system } = self;
        let base =
            system.canonical(if directory.as_str().is_empty() { Utf8Path::new(".") } else { directory });
        let file = system.canonical(&directory.join(path));
        if !file.starts_with(&base) && file.is_absolute() {
            return Err(Value::Word(&LEADS_OUT_OF_POST));
        }
        system.read(&file, LARGEST).map_err(|error| match error {
            ReadError::Missing => Value::Word(&NO_FILE),
            ReadError::IsDirectory => Value::Word(&IS_DIRECTORY),
            ReadError::TooLarge { size } => format!("it has {size} bytes").into(),
            ReadError::Other(reason) => reason,
        })
    }
}
