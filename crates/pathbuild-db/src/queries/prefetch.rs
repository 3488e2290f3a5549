//! Indexes drawings ahead of time, while directories are listed. An index does not depend on other drawings, so a wrong guess costs time
//! but cannot affect results.

use pathbuild_path::{PathName, SubpathName};
use rustc_hash::FxHashSet;

use super::index::{FileIndex, file_index};
use super::lookup::{own_directory, search_path};
use super::names::EXTENSION;
use crate::db::Db;
use crate::inputs::{Directory, SourceFile};
use crate::system::{FileKind, join};

/// The drawing of a directory that most likely defines a path: the one with its name.
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

/// The names that the paths of a drawing embed.
fn embedded_names(index: &FileIndex) -> impl Iterator<Item = &PathName> {
    let signatures = index.paths().filter_map(|path| path.summary.signature.as_ref());
    signatures.flat_map(|signature| &signature.subpaths).filter_map(|call| match &call.subpath.name {
        SubpathName::Found { name, .. } => Some(&**name),
        SubpathName::Missing { .. } | SubpathName::Invalid { .. } => None,
    })
}
