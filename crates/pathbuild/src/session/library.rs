//! The drawings below directories. (spec/20-paths-and-files.md, "The library")

use camino::{Utf8Path, Utf8PathBuf};
use ignore::WalkBuilder;

/// Every drawing in a directory and below, in order of name; .gitignore and .ignore files inside are respected.
pub(super) fn drawings(directory: &Utf8Path) -> Vec<Utf8PathBuf> {
    sorted(below(directory, false).filter(|path| is_drawing(path)))
}

/// A directory and every directory below it, likewise.
pub(super) fn directories(directory: &Utf8Path) -> Vec<Utf8PathBuf> {
    sorted(below(directory, true))
}

/// `.dxf` counts in any case.
pub(super) fn is_drawing(path: &Utf8Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("dxf"))
}

/// The directories below a directory, itself included, or all else.
fn below(directory: &Utf8Path, are_directories: bool) -> impl Iterator<Item = Utf8PathBuf> {
    let root = if directory.as_str().is_empty() { Utf8Path::new(".") } else { directory };
    let mut walk = WalkBuilder::new(root);
    // Only what the directory itself says counts: results must not depend on the person's global Git settings.
    walk.hidden(true)
        .parents(false)
        .git_global(false)
        .git_exclude(false)
        .require_git(false)
        .follow_links(true);
    let entries = walk
        .build()
        .filter_map(Result::ok)
        .filter(move |entry| entry.file_type().is_some_and(|kind| kind.is_dir() == are_directories));
    entries.filter_map(|entry| Utf8PathBuf::from_path_buf(entry.into_path()).ok())
}

fn sorted(paths: impl Iterator<Item = Utf8PathBuf>) -> Vec<Utf8PathBuf> {
    let mut paths: Vec<Utf8PathBuf> = paths.collect();
    paths.sort();
    paths
}
