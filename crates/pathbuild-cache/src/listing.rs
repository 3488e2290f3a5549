//! Directories as they are now.
#![expect(
    clippy::disallowed_methods,
    reason = "the stat index is about directories as the system has them, beside what the drawings say"
)]

use std::collections::HashMap;
use std::fs;
use std::io;

use camino::{Utf8Path, Utf8PathBuf};

use crate::facts::{DirectoryFact, is_drawing};
use crate::names::Names;

/// The names of drawings in a directory.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listing {
    /// The names, sorted once all are there.
    pub names: Names,
    /// Whether there are links among them, or some may be missing.
    pub is_doubtful: bool,
}

/// The drawings in directories that somebody listed already, by directory as the run spells it.
pub type Listings = HashMap<Utf8PathBuf, Listing>;

impl Listing {
    /// Adds something in a directory that is no directory itself, if it is a drawing.
    pub fn add(&mut self, name: &str, is_link: bool) {
        if is_drawing(name) {
            self.is_doubtful |= is_link;
            self.names.push(name);
        }
    }

    /// A directory's. What is in one that cannot be listed is not known; one that is not there holds nothing.
    fn of(directory: &Utf8Path) -> Self {
        let mut listing = Self::default();
        let entries = match fs::read_dir(directory) {
            Ok(entries) => entries,
            Err(error) => {
                listing.is_doubtful = error.kind() != io::ErrorKind::NotFound;
                return listing;
            }
        };
        for entry in entries {
            let Ok(entry) = entry else {
                listing.is_doubtful = true;
                continue;
            };
            // As System lists them: of names that are no UTF-8 a lossy spelling.
            if let Some(file_type) = entry.file_type().ok().filter(|file_type| !file_type.is_dir()) {
                listing.add(&entry.file_name().to_string_lossy(), file_type.is_symlink());
            }
        }
        listing.names.sort_by(Ord::cmp);
        listing
    }
}

impl DirectoryFact {
    /// A directory as it is now. `base` is the configuration's directory.
    pub fn now(path: &Utf8Path, base: &Utf8Path) -> Self {
        Self::from_listing(path, base, None)
    }

    /// The same, if it was listed already without listing it again.
    pub(crate) fn from_listing(path: &Utf8Path, base: &Utf8Path, listed: Option<Listing>) -> Self {
        let place = if path.as_str().is_empty() { Utf8Path::new(".") } else { path };
        let Listing { names, is_doubtful } = listed.unwrap_or_else(|| Listing::of(place));
        Self { path: path.to_owned(), names, canonical: canonical(place, base), is_doubtful }
    }
}

fn canonical(directory: &Utf8Path, base: &Utf8Path) -> Box<str> {
    let Ok(directory) = directory.canonicalize_utf8() else { return "".into() };
    let base = base.canonicalize_utf8().unwrap_or_else(|_| base.to_owned());
    directory.strip_prefix(&base).map_or(directory.as_str(), Utf8Path::as_str).into()
}
