//! Walking directories for drawings. (spec/20-paths-and-files.md, "The library")

use std::cmp::Ordering;
use std::path::is_separator;

use camino::{Utf8Path, Utf8PathBuf};
use ignore::{DirEntry, WalkBuilder};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::files as messages;

/// What lies in a directory and below, in order of name.
#[derive(Debug, Default)]
pub(super) struct Walked {
    paths: Vec<Utf8PathBuf>,
    /// PB005 where there is more than the limit allows: then there are no paths, since nobody knows which are missing.
    pub(super) problem: Option<Box<Diagnostic>>,
}

/// Every drawing in a directory and below; .gitignore and .ignore files inside are respected.
pub(super) fn drawings(directory: &Utf8Path, limit: u64) -> Walked {
    walked(directory, limit, |entry, path| !is_directory(entry) && is_drawing(path))
}

/// A directory and every directory below it, likewise.
pub(super) fn directories(directory: &Utf8Path, limit: u64) -> Walked {
    walked(directory, limit, |entry, _| is_directory(entry))
}

/// `.dxf` counts in any case.
pub(super) fn is_drawing(path: &Utf8Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("dxf"))
}

impl IntoIterator for Walked {
    type Item = Utf8PathBuf;
    type IntoIter = std::vec::IntoIter<Utf8PathBuf>;

    fn into_iter(self) -> Self::IntoIter {
        self.paths.into_iter()
    }
}

/// What is wanted of everything below a directory. Links to directories are not followed: they could lead anywhere, and round in circles.
fn walked(directory: &Utf8Path, limit: u64, is_wanted: impl Fn(&DirEntry, &Utf8Path) -> bool) -> Walked {
    let root = if directory.as_str().is_empty() { Utf8Path::new(".") } else { directory };
    let mut walk = WalkBuilder::new(root);
    // Only what the directory itself says counts: results must not depend on the person's global Git settings.
    walk.hidden(true).parents(false).git_global(false).git_exclude(false).require_git(false);
    let mut paths = Vec::new();
    for (number, entry) in (0..).zip(walk.build().filter_map(Result::ok)) {
        if number > limit {
            return Walked { paths: Vec::new(), problem: Some(Box::new(too_many(root, limit))) };
        }
        match Utf8Path::from_path(entry.path()) {
            Some(path) if is_wanted(&entry, path) => paths.push(path.to_owned()),
            _ => {}
        }
    }
    paths.sort_unstable_by(|a, b| by_place(a, b));
    Walked { paths, problem: None }
}

/// The order of paths, part by part. It is `Ord`'s, as long as no part is empty or `.`, and is told without taking paths apart: of ten thousand that
/// takes longer than asking the system for all of them.
pub fn by_place(a: &Utf8Path, b: &Utf8Path) -> Ordering {
    let (a, b) = (a.as_str().as_bytes(), b.as_str().as_bytes());
    let rank = |byte: u8| if is_separator(char::from(byte)) { 0 } else { byte };
    let differing = a.iter().zip(b).find(|(x, y)| x != y);
    differing.map_or_else(|| a.len().cmp(&b.len()), |(x, y)| rank(*x).cmp(&rank(*y)))
}

fn is_directory(entry: &DirEntry) -> bool {
    // What was named may be a link itself.
    entry.file_type().is_some_and(|kind| kind.is_dir() || (kind.is_symlink() && entry.depth() == 0))
}

fn too_many(directory: &Utf8Path, limit: u64) -> Diagnostic {
    Diagnostic::new(&messages::TOO_MANY_ENTRIES)
        .with("directory", directory.as_str())
        .with("limit", limit)
        .with("key", "library-entries")
}
