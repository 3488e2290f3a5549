//! The current contents of directories.
#![expect(
    clippy::disallowed_methods,
    reason = "change detection reads the real directories, which are no input of a drawing"
)]

use std::collections::HashMap;
use std::fs;
use std::io;

use camino::{Utf8Path, Utf8PathBuf};

use crate::catalogue::DirectoryFact;

/// The names of drawings in a directory.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listing {
    /// The names; sorted once the listing is complete.
    pub names: Vec<Box<str>>,
    /// Names that are symbolic links, in any order.
    pub links: Vec<Box<str>>,
    /// Whether some may be missing.
    pub is_doubtful: bool,
}

/// Directories that the run has already listed, as the run spells their paths.
pub type Listings = HashMap<Utf8PathBuf, Listing>;

impl Listing {
    /// Adds a directory entry that is not itself a directory, if it is a drawing.
    pub fn add(&mut self, name: &str, is_link: bool) {
        if Utf8Path::new(name).extension().is_some_and(|extension| extension.eq_ignore_ascii_case("dxf")) {
            self.names.push(name.into());
            if is_link {
                self.links.push(name.into());
            }
        }
    }

    /// Lists a directory. A missing directory is empty; one that cannot be read makes the listing doubtful.
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
            // `System` lists names that are not UTF-8 in the same lossy spelling.
            if let Some(file_type) = entry.file_type().ok().filter(|file_type| !file_type.is_dir()) {
                listing.add(&entry.file_name().to_string_lossy(), file_type.is_symlink());
            }
        }
        listing.names.sort_unstable();
        listing
    }
}

impl DirectoryFact {
    /// Reads the current state of a directory. `base` is the configuration's directory.
    pub fn now(path: &Utf8Path, base: &Utf8Path) -> Self {
        Self::from_listing(path, base, None)
    }

    /// Like [`now`](Self::now), but reuses an earlier listing if there is one.
    pub(crate) fn from_listing(path: &Utf8Path, base: &Utf8Path, listed: Option<Listing>) -> Self {
        let place = if path.as_str().is_empty() { Utf8Path::new(".") } else { path };
        let Listing { names, mut links, is_doubtful } = listed.unwrap_or_else(|| Listing::of(place));
        let mut canonical = canonical(place, base);
        links.sort_unstable();
        for link in links {
            // No name holds this character.
            canonical.push('\0');
            canonical.push_str(&self::canonical(&place.join(&*link), base));
        }
        Self { path: path.to_owned(), names, canonical: canonical.into(), is_doubtful }
    }
}

/// Canonical path relative to `base` if inside it; empty if there is no such file.
fn canonical(place: &Utf8Path, base: &Utf8Path) -> String {
    let Ok(place) = place.canonicalize_utf8() else { return String::new() };
    let base = base.canonicalize_utf8().unwrap_or_else(|_| base.to_owned());
    place.strip_prefix(&base).map_or(place.as_str(), Utf8Path::as_str).to_owned()
}
