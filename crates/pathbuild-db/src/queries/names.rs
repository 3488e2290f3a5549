//! Maps the name ranges in file names to the drawings of a directory. (book: language/layers-and-names)

use camino::Utf8Path;
use pathbuild_diagnostic::messages::files as messages;
use pathbuild_diagnostic::reasons::NO_DIRECTORY;
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_path::{FilePattern, PathKey, RangeTable};

use crate::bugs::catch_bugs;
use crate::db::Db;
use crate::inputs::{Directory, SourceFile};
use crate::settings::Settings;
use crate::system::{Names, ReadError, join};

/// The drawings of a directory by the path names that their file names admit.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NameTable {
    names: Names,
    ranges: RangeTable,
    /// The reason why the directory cannot be listed.
    fault: Option<ReadError>,
}

impl NameTable {
    /// Selects the drawings among file names.
    fn new(files: &Names, pattern: &FilePattern) -> Self {
        let (mut names, mut ranges) = (Names::default(), Vec::new());
        for name in files.iter().filter(|name| is_drawing(name)) {
            let number = u32::try_from(names.len()).expect("a directory has fewer than 2^32 names");
            let stem = &name[..name.len() - EXTENSION.len()];
            pattern.each_range(stem, |range| ranges.push((range, number)));
            names.push(name);
        }
        Self { names, ranges: ranges.into_iter().collect(), fault: None }
    }

    /// The files that may define a path, in order of name.
    pub(super) fn files(&self, db: &dyn Db, directory: Directory, key: &PathKey) -> Vec<SourceFile> {
        let name = |file: &u32| self.names.get(*file as usize);
        let mut files = self.ranges.files(key);
        files.sort_unstable_by_key(name);
        let file = |name| db.file(&join(directory.path(db), name));
        files.iter().filter_map(name).map(file).collect()
    }
}

/// The name ranges in a directory. Empty if it does not exist or cannot be listed.
#[salsa::tracked]
pub fn name_table(db: &dyn Db, directory: Directory) -> NameTable {
    directory.revision(db);
    let pattern = Settings::get(db).file_pattern(db);
    let list = || db.system().list(directory.path(db)).map(|listing| listing.files);
    match db.listed(directory).map_or_else(list, Ok) {
        Ok(files) => NameTable::new(&files, pattern),
        Err(ReadError::Missing) => NameTable::default(),
        Err(fault) => NameTable { fault: Some(fault), ..NameTable::default() },
    }
}

/// PB001 for a directory that cannot be listed, since it may define the path.
pub fn unlisted(db: &dyn Db, directory: Directory) -> Option<Diagnostic> {
    let fault = name_table(db, directory).fault.as_ref()?;
    Some(unlistable(directory.path(db), fault))
}

/// PB001 for a directory with this error.
pub fn unlistable(directory: &Utf8Path, fault: &ReadError) -> Diagnostic {
    let reason = match fault {
        ReadError::Other(reason) => reason.clone(),
        ReadError::Missing | ReadError::IsDirectory | ReadError::TooLarge { .. } => {
            Value::Prose(&NO_DIRECTORY)
        }
    };
    let directory = if directory.as_str().is_empty() { Utf8Path::new(".") } else { directory };
    Diagnostic::new(&messages::UNLISTABLE).with("reason", reason).in_file(directory)
}

/// The file names that the name ranges of a directory were read from. Empty after a panic.
pub fn drawing_names(db: &dyn Db, directory: Directory) -> &Names {
    static NONE: Names = Names::none();
    catch_bugs(|| &name_table(db, directory).names).unwrap_or(&NONE)
}

/// File name extension of drawings.
pub(super) const EXTENSION: &str = ".dxf";

/// Whether a file name has the extension, in any case.
fn is_drawing(name: &str) -> bool {
    let bytes = name.as_bytes();
    bytes.len() > EXTENSION.len()
        && bytes[bytes.len() - EXTENSION.len()..].eq_ignore_ascii_case(EXTENSION.as_bytes())
}
