//! What file names say about paths: the drawings of a directory by the name ranges in theirs. (book: language/layers-and-names)

use pathbuild_path::{FilePattern, PathKey, RangeTable};

use crate::bugs::catch_bugs;
use crate::db::Db;
use crate::inputs::{Directory, SourceFile};
use crate::settings::Settings;
use crate::system::{Names, join};

/// The drawings of a directory by the path names in theirs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NameTable {
    names: Names,
    ranges: RangeTable,
}

impl NameTable {
    /// The drawings among some file names.
    fn new(files: &Names, pattern: &FilePattern) -> Self {
        let (mut names, mut ranges) = (Names::default(), Vec::new());
        for name in files.iter().filter(|name| is_drawing(name)) {
            let number = u32::try_from(names.len()).expect("a directory has fewer than 2^32 names");
            let stem = &name[..name.len() - EXTENSION.len()];
            pattern.each_range(stem, |range| ranges.push((range, number)));
            names.push(name);
        }
        Self { names, ranges: ranges.into_iter().collect() }
    }

    /// The files that may hold a path, in order of name.
    pub(super) fn files(&self, db: &dyn Db, directory: Directory, key: &PathKey) -> Vec<SourceFile> {
        let name = |file: &u32| self.names.get(*file as usize);
        let mut files = self.ranges.files(key);
        files.sort_unstable_by_key(name);
        let file = |name| db.file(&join(directory.path(db), name));
        files.iter().filter_map(name).map(file).collect()
    }
}

/// The name ranges in a directory's file names. A directory that cannot be listed has none.
#[salsa::tracked]
pub fn name_table(db: &dyn Db, directory: Directory) -> NameTable {
    directory.revision(db);
    let pattern = Settings::get(db).file_pattern(db);
    let list = || db.system().list(directory.path(db)).unwrap_or_default().files;
    NameTable::new(&db.listed(directory).unwrap_or_else(list), pattern)
}

/// The names of the drawings in a directory, as its name ranges were read from them; none where that shows a bug.
pub fn drawing_names(db: &dyn Db, directory: Directory) -> &Names {
    static NONE: Names = Names::none();
    catch_bugs(|| &name_table(db, directory).names).unwrap_or(&NONE)
}

/// What drawings' names end in.
pub(super) const EXTENSION: &str = ".dxf";

/// `.dxf` counts in any case.
fn is_drawing(name: &str) -> bool {
    let bytes = name.as_bytes();
    bytes.len() > EXTENSION.len()
        && bytes[bytes.len() - EXTENSION.len()..].eq_ignore_ascii_case(EXTENSION.as_bytes())
}
