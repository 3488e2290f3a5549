//! Walking directories for drawings. (spec/20-paths-and-files.md, "The library")

use std::cmp::Ordering;
use std::ops::ControlFlow;
use std::path::is_separator;

use camino::{Utf8Path, Utf8PathBuf};
use ignore::WalkBuilder;
use pathbuild_cache::{Listing, ListingKind, Listings};
use pathbuild_db::system::{Entry, EntryKind, OsSystem};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::files as messages;
use rayon::prelude::*;

/// What lies in a directory and below.
#[derive(Debug, Default)]
pub(super) struct Walked {
    /// Every drawing, in order of name.
    pub(super) drawings: Vec<Utf8PathBuf>,
    /// The directory itself and every directory below it, likewise.
    pub(super) directories: Vec<Utf8PathBuf>,
    /// What is in these directories, as far as it is known.
    pub(super) listings: Listings,
    /// PB005 where there is more than the limit allows: then there is nothing else, since nobody knows what is missing.
    pub(super) problem: Option<Box<Diagnostic>>,
}

/// So many directories are sooner listed one after the other than threads are started for them.
const FEW: usize = 4;

/// How directories are walked.
#[derive(Clone, Copy, Debug)]
pub(super) struct Walk {
    /// How many files and directories there may be.
    pub(super) limit: u64,
    /// Whether on all cores.
    pub(super) is_parallel: bool,
}

impl Walk {
    /// Every drawing in a directory and below; .gitignore and .ignore files inside are respected. Links to directories are not followed: they
    /// could lead anywhere, and round in circles. What is found is spelt as the root is: normally, if that is.
    pub(super) fn through(self, root: &Utf8Path) -> Walked {
        let (mut walked, count) = self.plain(root).unwrap_or_else(|HasRules| self.ruled(root));
        if count > self.limit.saturating_add(1) {
            let problem = Some(Box::new(too_many(readable(root), self.limit)));
            return Walked { problem, ..Walked::default() };
        }
        // Each directory's are in order already.
        walked.drawings.sort_by(|a, b| by_place(a, b));
        walked.directories.sort_by(|a, b| by_place(a, b));
        walked
    }

    /// The same as long as there are no rules, and how much was found: most libraries have none, and to look for them at each of ten thousand
    /// entries takes longer than all the rest. Nothing more is looked for once there is more than the limit allows.
    fn plain(self, root: &Utf8Path) -> Result<(Walked, u64), HasRules> {
        let mut walked = Walked::default();
        let mut open = vec![root.to_owned()];
        let mut count = 1;
        while !open.is_empty() && count <= self.limit.saturating_add(1) {
            let list = |directory: &Utf8PathBuf| Directory::list(directory, self.limit);
            let is_parallel = self.is_parallel && open.len() > FEW;
            let listed: Vec<_> = if is_parallel {
                open.par_iter().map(list).collect()
            } else {
                open.iter().map(list).collect()
            };
            let mut next = Vec::new();
            for (directory, listed) in open.into_iter().zip(listed) {
                match listed? {
                    Some(listed) => {
                        count += listed.count;
                        walked.drawings.extend(listed.drawings);
                        next.extend(listed.directories);
                        walked.listings.insert(directory.clone(), listed.listing);
                    }
                    // A root that is no directory is for those who know all cases.
                    None if walked.directories.is_empty() => return Err(HasRules),
                    None => {}
                }
                walked.directories.push(directory);
            }
            open = next;
        }
        Ok((walked, count))
    }

    /// The same where there are rules.
    fn ruled(self, root: &Utf8Path) -> (Walked, u64) {
        let mut walk = WalkBuilder::new(readable(root));
        // Only what the directory itself says counts: results must not depend on the person's global Git settings.
        walk.hidden(true).parents(false).git_global(false).git_exclude(false).require_git(false);
        let most = usize::try_from(self.limit).unwrap_or(usize::MAX).saturating_add(2);
        let mut walked = Walked::default();
        let mut count = 0;
        let named = walk.build().filter_map(Result::ok).filter_map(|entry| {
            let path = Utf8Path::from_path(entry.path())?;
            let path = if root.as_str().is_empty() { path.strip_prefix(".").unwrap_or(path) } else { path };
            // What was named may be a link itself.
            let is_directory = entry
                .file_type()
                .is_some_and(|kind| kind.is_dir() || (kind.is_symlink() && entry.depth() == 0));
            Some((path.to_owned(), is_directory))
        });
        for (path, is_directory) in named.take(most) {
            count += 1;
            if is_directory {
                walked.directories.push(path);
            } else if is_drawing(&path) {
                walked.drawings.push(path);
            }
        }
        (walked, count)
    }
}

/// A directory in a system call's words.
fn readable(directory: &Utf8Path) -> &Utf8Path {
    if directory.as_str().is_empty() { Utf8Path::new(".") } else { directory }
}

/// `.dxf` counts in any case.
pub(super) fn is_drawing(path: &Utf8Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("dxf"))
}

/// There are files of rules that say what does not count.
struct HasRules;

/// What is in one directory.
#[derive(Default)]
struct Directory {
    drawings: Vec<Utf8PathBuf>,
    directories: Vec<Utf8PathBuf>,
    listing: Listing,
    /// The same of names that are no UTF-8: nothing can be found under their spellings.
    inexact: Listing,
    /// How much there is, hidden things aside.
    count: u64,
}

impl Directory {
    /// Nothing where it cannot be listed.
    fn list(directory: &Utf8Path, limit: u64) -> Result<Option<Self>, HasRules> {
        let mut found = Self::default();
        let mut has_rules = false;
        let listed = OsSystem.each_entry(directory, |entry| {
            has_rules = entry.is_exact && matches!(entry.name, ".gitignore" | ".ignore");
            found.add(directory, entry);
            if has_rules || found.count > limit { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        if has_rules {
            return Err(HasRules);
        }
        if listed.is_err() && found.listing.names.is_empty() && found.count == 0 {
            return Ok(None);
        }
        // Who looks for a path must not miss what was not told.
        found.listing.is_doubtful |= listed.is_err();
        found.listing.names.sort_by(by_name);
        let drawings = found.listing.names.iter().filter(|name| !is_hidden(name));
        found.drawings = drawings.map(|name| joined(directory, name)).collect();
        if !found.inexact.names.is_empty() {
            found.listing.is_doubtful |= found.inexact.is_doubtful;
            found.listing.names.extend(found.inexact.names.iter());
            found.listing.names.sort_by(Ord::cmp);
        }
        Ok(Some(found))
    }

    fn add(&mut self, directory: &Utf8Path, Entry { name, is_exact, kind }: Entry<'_>) {
        if kind != EntryKind::Directory {
            let listing = if is_exact { &mut self.listing } else { &mut self.inexact };
            listing.add(ListingKind::Drawings, name, kind == EntryKind::Link);
        }
        if is_exact && !is_hidden(name) {
            self.count += 1;
            if kind == EntryKind::Directory {
                self.directories.push(joined(directory, name));
            }
        }
    }
}

fn is_hidden(name: &str) -> bool {
    name.starts_with('.')
}

/// A name in a directory, made at once in the memory that it needs.
fn joined(directory: &Utf8Path, name: &str) -> Utf8PathBuf {
    let mut path = Utf8PathBuf::with_capacity(directory.as_str().len() + 1 + name.len());
    path.push(directory);
    path.push(name);
    path
}

/// The order of names. It is `Ord`'s, told by their first bytes where it can be.
pub fn by_name(a: &str, b: &str) -> Ordering {
    let begin = |name: &str| name.as_bytes().first_chunk().map(|bytes| u64::from_be_bytes(*bytes));
    match (begin(a), begin(b)) {
        (Some(x), Some(y)) if x != y => x.cmp(&y),
        _ => a.cmp(b),
    }
}

/// The order of paths, part by part. It is `Ord`'s, as long as no part is empty or `.`, and is told without taking paths apart: of ten thousand that
/// takes longer than asking the system for all of them.
pub fn by_place(a: &Utf8Path, b: &Utf8Path) -> Ordering {
    let (a, b) = (a.as_str().as_bytes(), b.as_str().as_bytes());
    let rank = |byte: u8| if is_separator(char::from(byte)) { 0 } else { byte };
    // Names in a directory begin alike.
    let (a_chunks, b_chunks) = (a.as_chunks::<CHUNK>().0, b.as_chunks::<CHUNK>().0);
    let same = CHUNK * a_chunks.iter().zip(b_chunks).take_while(|(x, y)| x == y).count();
    let differing = a[same..].iter().zip(&b[same..]).find(|(x, y)| x != y);
    differing.map_or_else(|| a.len().cmp(&b.len()), |(x, y)| rank(*x).cmp(&rank(*y)))
}

/// So many bytes are compared at once.
const CHUNK: usize = 8;

fn too_many(directory: &Utf8Path, limit: u64) -> Diagnostic {
    Diagnostic::new(&messages::TOO_MANY_ENTRIES)
        .with("directory", directory.as_str())
        .with("limit", limit)
        .with("key", "library-entries")
}
