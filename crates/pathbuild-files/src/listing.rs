//! Directory listings.

use std::fmt;

/// Names stored back to back in one string, since a directory may hold ten thousand drawings.
#[derive(Clone, Default, PartialEq, Eq)]
pub struct Names {
    text: String,
    /// End offsets of the names.
    ends: Vec<usize>,
}

/// The names in a directory, in no particular order: sorting ten thousand takes longer than reading the few drawings among them that are
/// needed. Names that are not UTF-8 appear in a lossy spelling that no file has.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listing {
    /// Everything that is not a directory.
    pub files: Names,
    /// Directories, and links to them.
    pub directories: Names,
}

/// A name in a directory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry<'a> {
    /// The name, or a lossy spelling if it is not UTF-8.
    pub name: &'a str,
    /// Whether `name` is exact, so that a file can be opened by it.
    pub is_exact: bool,
    /// The type of the entry.
    pub kind: EntryKind,
}

/// The type of a directory entry, with links unresolved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EntryKind {
    /// Anything else.
    File,
    /// A directory.
    Directory,
    /// A symbolic link to anything.
    Link,
}

impl Names {
    /// No names.
    pub const fn none() -> Self {
        Self { text: String::new(), ends: Vec::new() }
    }

    /// Appends other names.
    pub fn extend(&mut self, names: &Self) {
        let begin = self.text.len();
        self.text.push_str(&names.text);
        self.ends.extend(names.ends.iter().map(|end| begin + end));
    }

    /// Appends a name.
    pub fn push(&mut self, name: &str) {
        self.text.push_str(name);
        self.ends.push(self.text.len());
    }

    /// The number of names.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there are no names.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The name at an index.
    pub fn get(&self, number: usize) -> Option<&str> {
        let end = *self.ends.get(number)?;
        let begin = number.checked_sub(1).map_or(0, |before| self.ends[before]);
        Some(&self.text[begin..end])
    }

    /// Iterates over the names.
    pub fn iter(&self) -> impl Iterator<Item = &str> {
        (0..self.len()).filter_map(|number| self.get(number))
    }
}

impl fmt::Debug for Names {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

impl<'t> FromIterator<&'t str> for Names {
    fn from_iter<I: IntoIterator<Item = &'t str>>(names: I) -> Self {
        let mut all = Self::default();
        names.into_iter().for_each(|name| all.push(name));
        all
    }
}
