//! Finds the files that define a path. (book: language/layers-and-names)

use camino::Utf8Path;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::{PathKey, PathName};
use rustc_hash::FxHashSet;

use super::index::{NameKey, file_index, path_index};
use super::names::{name_table, unlisted};
use crate::db::Db;
use crate::inputs::{Directory, SourceFile};
use crate::settings::Settings;

/// The result of looking for a path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ResolvedPath {
    /// The files that define it. Exactly one is right; none and several are errors.
    pub files: Vec<SourceFile>,
    /// The files whose names admit the path.
    pub searched: Vec<SourceFile>,
    /// PB001 for directories that cannot be listed: the path may be defined there.
    pub unlisted: Vec<Diagnostic>,
}

/// Looks for a path that a drawing refers to, in its own directory and the search directories. `None` if the drawing itself defines it.
pub(super) fn find_path<'db>(
    db: &'db dyn Db,
    from: SourceFile,
    name: NameKey<'db>,
) -> Option<&'db ResolvedPath> {
    if path_index(db, from, name).is_some() {
        return None;
    }
    Some(resolve_path(db, own_directory(db, from), name))
}

/// Looks for a path that drawings in a directory refer to. Unaffected by files whose names do not admit it.
#[salsa::tracked]
pub fn resolve_path<'db>(db: &'db dyn Db, directory: Directory, name: NameKey<'db>) -> ResolvedPath {
    let directories = search_path(db, directory);
    let searched =
        distinct(directories.iter().flat_map(|directory| files_for(db, *directory, name.folded(db))));
    let defines = |file: &&SourceFile| path_index(db, **file, name).is_some();
    let mut files: Vec<SourceFile> = searched.iter().filter(defines).copied().collect();
    if files.len() > 1 {
        // A file reached under two names is no duplicate.
        let mut seen = FxHashSet::default();
        files.retain(|file| seen.insert(db.system().canonical(file.path(db))));
    }
    let unlisted = directories.iter().filter_map(|directory| unlisted(db, *directory)).collect();
    ResolvedPath { files, searched, unlisted }
}

/// The directories to search for paths that drawings in a directory refer to, starting with that directory.
#[salsa::tracked]
pub fn search_path(db: &dyn Db, own: Directory) -> Vec<Directory> {
    let searched = Settings::get(db).search(db).iter();
    distinct(std::iter::once(own).chain(searched.map(|path| db.directory(path))))
}

/// The directory of a drawing.
pub(super) fn own_directory(db: &dyn Db, file: SourceFile) -> Directory {
    db.directory(file.path(db).parent().unwrap_or(Utf8Path::new("")))
}

/// The files of a directory that define a path, for clients outside of queries. It takes a plain name, since a name interned outside a
/// query is never reclaimed.
pub fn holders(db: &dyn Db, directory: Directory, name: &PathName) -> Vec<SourceFile> {
    let files = may_hold(db, directory, name).into_iter();
    files.filter(|file| file_index(db, *file).path(name).is_some()).collect()
}

/// The files of a directory whose names admit a path. None is read.
pub fn may_hold(db: &dyn Db, directory: Directory, name: &PathName) -> Vec<SourceFile> {
    files_for(db, directory, name.as_str())
}

/// The files of a directory whose names admit a path.
fn files_for(db: &dyn Db, directory: Directory, name: &str) -> Vec<SourceFile> {
    let pattern = &Settings::get(db).language(db).path_pattern;
    let key = PathKey::new(name, pattern);
    key.map(|key| name_table(db, directory).files(db, directory, &key)).unwrap_or_default()
}

/// Removes duplicates and keeps the order.
fn distinct<T: Copy + Eq + std::hash::Hash>(all: impl Iterator<Item = T>) -> Vec<T> {
    let mut all: Vec<T> = all.collect();
    if all.len() > 1 {
        let mut seen = FxHashSet::default();
        all.retain(|one| seen.insert(*one));
    }
    all
}
