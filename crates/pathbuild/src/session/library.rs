//! The drawings below directories. (spec/20-paths-and-files.md, "The library")

use camino::{Utf8Path, Utf8PathBuf};
use ignore::WalkBuilder;

/// Every drawing in a directory and below, in order of name; .gitignore and .ignore files inside are respected. Links to directories
/// are not followed: they could lead anywhere, and round in circles.
pub(super) fn drawings(directory: &Utf8Path) -> Vec<Utf8PathBuf> {
    let root = if directory.as_str().is_empty() { Utf8Path::new(".") } else { directory };
    let mut walk = WalkBuilder::new(root);
    // Only what the directory itself says counts: results must not depend on the person's global Git settings.
    walk.hidden(true).parents(false).git_global(false).git_exclude(false).require_git(false);
    let files = walk
        .build()
        .filter_map(Result::ok)
        .filter(|entry| entry.file_type().is_some_and(|kind| !kind.is_dir()));
    let paths = files.filter_map(|entry| Utf8PathBuf::from_path_buf(entry.into_path()).ok());
    let mut drawings: Vec<Utf8PathBuf> = paths.filter(|path| is_drawing(path)).collect();
    drawings.sort();
    drawings
}

/// `.dxf` counts in any case.
pub(super) fn is_drawing(path: &Utf8Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("dxf"))
}
