//! Finds the files that define a path, by the name ranges in file names. (book: language/layers-and-names)

use std::borrow::Cow;

use camino::Utf8Path;
use pathbuild_diagnostic::messages::files as messages;
use pathbuild_diagnostic::reasons::NO_DIRECTORY;
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_path::{FilePattern, PathKey, PathName, RangeTable, SubpathName};
use rustc_hash::FxHashSet;

use crate::database::{Db, catch_bugs};
use crate::inputs::{Directory, Settings, SourceFile};
use crate::queries::index::{FileIndex, NameKey, file_index, path_index};
use crate::system::{FileKind, Names, ReadError, is_drawing, is_hidden, join, or_current_directory};

/// The drawings of a directory, by the path names that they may contain according to their file names.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NameTable {
    names: Names,
    ranges: RangeTable,
    /// The reason why the directory cannot be listed.
    fault: Option<ReadError>,
}

impl NameTable {
    /// Creates a table of the drawings among these files. Hidden drawings are listed, but other drawings cannot find their paths by name, since the
    /// library leaves hidden drawings out too.
    fn new(files: &Names, pattern: &FilePattern) -> Self {
        let (mut names, mut ranges) = (Names::default(), Vec::new());
        for name in files.iter().filter(|name| is_drawing(Utf8Path::new(name))) {
            let number = u32::try_from(names.len()).expect("a directory has fewer than 2^32 names");
            if !is_hidden(name) {
                let stem = &name[..name.len() - EXTENSION.len()];
                pattern.each_range(stem, |range| ranges.push((range, number)));
            }
            names.push(name);
        }
        Self { names, ranges: ranges.into_iter().collect(), fault: None }
    }

    /// Returns the files that may define a path, in order of name.
    pub(super) fn files(&self, db: &dyn Db, directory: Directory, key: &PathKey) -> Vec<SourceFile> {
        let name = |file: &u32| self.names.get(*file as usize);
        let mut files = self.ranges.files(key);
        files.sort_unstable_by_key(name);
        let file = |name| db.file(&join(directory.path(db), name));
        files.iter().filter_map(name).map(file).collect()
    }
}

/// Returns the name ranges in a directory. Empty if it does not exist or cannot be listed.
#[salsa::tracked]
pub fn name_table(db: &dyn Db, directory: Directory) -> NameTable {
    directory.revision(db);
    let pattern = Settings::get(db).file_pattern(db);
    let list = || db.system().list(directory.path(db)).map(|listing| listing.files);
    match db.take_listing(directory).map_or_else(list, Ok) {
        Ok(files) => NameTable::new(&files, pattern),
        Err(ReadError::Missing) => NameTable::default(),
        Err(fault) => NameTable { fault: Some(fault), ..NameTable::default() },
    }
}

/// Returns PB001 for a directory that cannot be listed, since any path may be defined there.
pub fn listing_error(db: &dyn Db, directory: Directory) -> Option<Diagnostic> {
    let fault = name_table(db, directory).fault.as_ref()?;
    Some(unlistable_error(directory.path(db), fault))
}

/// Returns PB001 for a directory with this error.
pub fn unlistable_error(directory: &Utf8Path, fault: &ReadError) -> Diagnostic {
    let reason = match fault {
        ReadError::Other(reason) => reason.clone(),
        ReadError::Missing | ReadError::IsDirectory | ReadError::TooLarge { .. } => {
            Value::Prose(&NO_DIRECTORY)
        }
    };
    let directory = or_current_directory(directory);
    Diagnostic::new(&messages::UNLISTABLE).with("reason", reason).in_file(directory)
}

/// Returns the file names of the drawings in a directory, including hidden ones. Empty after a panic.
pub fn drawing_names(db: &dyn Db, directory: Directory) -> &Names {
    static NONE: Names = Names::none();
    catch_bugs(|| &name_table(db, directory).names).unwrap_or(&NONE)
}

const EXTENSION: &str = ".dxf";

/// The result of looking for a path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ResolvedPath {
    /// The files that define the path. Anything but exactly one file is an error.
    pub files: Vec<SourceFile>,
    /// The files that may define the path according to their names.
    pub searched: Vec<SourceFile>,
    /// PB001 for directories that cannot be listed: the path may be defined there.
    pub unlisted: Vec<Diagnostic>,
}

/// Looks for a path that a drawing refers to: in the drawing itself, whatever its file name, in its directory, and in the search directories.
pub(super) fn find_path<'db>(
    db: &'db dyn Db,
    from: SourceFile,
    name: NameKey<'db>,
) -> Cow<'db, ResolvedPath> {
    let resolved = resolve_path(db, own_directory(db, from), name);
    if path_index(db, from, name).is_none() {
        return Cow::Borrowed(resolved);
    }
    let canonical = |file: SourceFile| db.system().canonical(file.path(db));
    let is_other = |file: &SourceFile| *file != from && canonical(*file) != canonical(from);
    let others = resolved.files.iter().copied().filter(is_other);
    // A path in the drawing itself is found even if a directory cannot be listed.
    Cow::Owned(ResolvedPath {
        files: std::iter::once(from).chain(others).collect(),
        searched: resolved.searched.clone(),
        unlisted: Vec::new(),
    })
}

/// Looks for a path that drawings in a directory refer to. Files that cannot define it according to their names do not affect the result.
#[salsa::tracked]
pub fn resolve_path<'db>(db: &'db dyn Db, directory: Directory, name: NameKey<'db>) -> ResolvedPath {
    let directories = search_path(db, directory);
    let searched =
        distinct(directories.iter().flat_map(|directory| files_for(db, *directory, name.folded(db))));
    let defines = |file: &&SourceFile| path_index(db, **file, name).is_some();
    let mut files: Vec<SourceFile> = searched.iter().filter(defines).copied().collect();
    if files.len() > 1 {
        // Keep a file that is reached under two names only once.
        let mut seen = FxHashSet::default();
        files.retain(|file| seen.insert(db.system().canonical(file.path(db))));
    }
    let unlisted = directories.iter().filter_map(|directory| listing_error(db, *directory)).collect();
    ResolvedPath { files, searched, unlisted }
}

/// Returns the directories to search for paths that drawings in a directory refer to, starting with that directory.
#[salsa::tracked]
pub fn search_path(db: &dyn Db, own: Directory) -> Vec<Directory> {
    let searched = Settings::get(db).search(db).iter();
    distinct(std::iter::once(own).chain(searched.map(|path| db.directory(path))))
}

pub(super) fn own_directory(db: &dyn Db, file: SourceFile) -> Directory {
    db.directory(file.path(db).parent().unwrap_or(Utf8Path::new("")))
}

/// Returns the files of a directory that define a path, for clients outside of queries. It takes a plain name, since a name interned outside a query
/// is never reclaimed.
pub fn defining_files(db: &dyn Db, directory: Directory, name: &PathName) -> Vec<SourceFile> {
    let files = candidate_files(db, directory, name).into_iter();
    files.filter(|file| file_index(db, *file).path(name).is_some()).collect()
}

/// Returns the files of a directory that may define a path, judged by their names alone.
pub fn candidate_files(db: &dyn Db, directory: Directory, name: &PathName) -> Vec<SourceFile> {
    files_for(db, directory, name.as_str())
}

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

/// Returns the drawing of a directory that most likely defines a path: the file with the path's name.
pub fn likely_file(db: &dyn Db, directory: Directory, name: &str) -> Option<SourceFile> {
    let path = join(directory.path(db), format!("{name}{EXTENSION}"));
    (db.system().kind(&path) == FileKind::File).then(|| db.file(&path))
}

/// Whether any path of a drawing embeds others.
pub fn embeds_others(db: &dyn Db, file: SourceFile) -> bool {
    file_index(db, file).paths().any(|path| path.summary.has_subpaths())
}

/// Indexes the drawings that most likely define what a drawing embeds, recursively.
pub fn prefetch(db: &dyn Db, file: SourceFile) {
    let (mut open, mut seen) = (vec![file], FxHashSet::from_iter([file]));
    while let Some(file) = open.pop() {
        let directories = search_path(db, own_directory(db, file));
        for name in embedded_names(file_index(db, file)) {
            let mut places = directories.iter();
            let likely = places.find_map(|directory| likely_file(db, *directory, name.as_str()));
            open.extend(likely.filter(|file| seen.insert(*file)));
        }
    }
}

fn embedded_names(index: &FileIndex) -> impl Iterator<Item = &PathName> {
    let signatures = index.paths().filter_map(|path| path.summary.signature.as_ref());
    signatures.flat_map(|signature| &signature.subpaths).filter_map(|call| match &call.subpath.name {
        SubpathName::Found { name, .. } => Some(&**name),
        SubpathName::Missing { .. } | SubpathName::Invalid { .. } => None,
    })
}
