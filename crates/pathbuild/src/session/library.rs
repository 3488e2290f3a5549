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
    walked(directory, limit, |is_directory, path| !is_directory && is_drawing(path))
}

/// A directory and every directory below it, likewise.
pub(super) fn directories(directory: &Utf8Path, limit: u64) -> Walked {
    walked(directory, limit, |is_directory, _| is_directory)
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
fn walked(directory: &Utf8Path, limit: u64, is_wanted: impl Fn(bool, &Utf8Path) -> bool) -> Walked {
    let root = if directory.as_str().is_empty() { Utf8Path::new(".") } else { directory };
    let entries = plain_entries(root, limit).unwrap_or_else(|HasRules| ruled_entries(root, limit));
    if entries.len() as u64 > limit.saturating_add(1) {
        return Walked { paths: Vec::new(), problem: Some(Box::new(too_many(root, limit))) };
    }
    let wanted = entries.into_iter().filter(|entry| is_wanted(entry.is_directory, &entry.path));
    let mut paths: Vec<Utf8PathBuf> = wanted.map(|entry| entry.path).collect();
    paths.sort_unstable_by(|a, b| by_place(a, b));
    Walked { paths, problem: None }
}

/// Something in a directory or below; the directory itself is one.
struct Found {
    path: Utf8PathBuf,
    is_directory: bool,
}

/// There are files of rules that say what does not count.
struct HasRules;

/// Everything in a directory and below, as long as there are no rules: most libraries have none, and to look for them at each of ten thousand
/// entries takes longer than all the rest. Nothing more is looked for once there is more than the limit allows.
fn plain_entries(root: &Utf8Path, limit: u64) -> Result<Vec<Found>, HasRules> {
    let mut found = vec![Found { path: root.to_owned(), is_directory: true }];
    let mut open = vec![root.to_owned()];
    while let Some(directory) = open.pop() {
        let Ok(listed) = directory.read_dir_utf8() else {
            // A root that is no directory is for those who know all cases.
            if found.len() == 1 {
                return Err(HasRules);
            }
            continue;
        };
        for entry in listed.filter_map(Result::ok) {
            let name = entry.file_name();
            if matches!(name, ".gitignore" | ".ignore") {
                return Err(HasRules);
            }
            let Ok(kind) = entry.file_type() else { continue };
            if name.starts_with('.') {
                continue;
            }
            if kind.is_dir() {
                open.push(entry.path().to_owned());
            }
            found.push(Found { path: entry.into_path(), is_directory: kind.is_dir() });
            if found.len() as u64 > limit.saturating_add(1) {
                return Ok(found);
            }
        }
    }
    Ok(found)
}

/// The same where there are rules.
fn ruled_entries(root: &Utf8Path, limit: u64) -> Vec<Found> {
    let mut walk = WalkBuilder::new(root);
    // Only what the directory itself says counts: results must not depend on the person's global Git settings.
    walk.hidden(true).parents(false).git_global(false).git_exclude(false).require_git(false);
    let entries = walk.build().filter_map(Result::ok).filter_map(|entry| {
        let path = Utf8Path::from_path(entry.path())?.to_owned();
        Some(Found { path, is_directory: is_directory(&entry) })
    });
    let most = usize::try_from(limit).unwrap_or(usize::MAX).saturating_add(2);
    entries.take(most).collect()
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
