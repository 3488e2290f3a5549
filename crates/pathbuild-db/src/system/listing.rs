//! What is in a directory.

use std::fmt;

/// Names one after the other in one text: a directory of ten thousand drawings has as many.
#[derive(Clone, Default, PartialEq, Eq)]
pub struct Names {
    text: String,
    /// Where each ends.
    ends: Vec<usize>,
}

/// The names in a directory, in no particular order: sorting ten thousand takes longer than reading the few drawings among them that are
/// wanted. Of names that are no UTF-8 there is a lossy spelling, which no file has.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listing {
    /// What is no directory.
    pub files: Names,
    /// Directories, and links to them.
    pub directories: Names,
}

/// A name in a directory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry<'a> {
    /// The name, or a lossy spelling of one that is no UTF-8.
    pub name: &'a str,
    /// Whether a file can be found under that spelling.
    pub is_exact: bool,
    /// What it is a name of.
    pub kind: EntryKind,
}

/// What a directory says of a name in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EntryKind {
    /// Anything that is none of the others.
    File,
    /// A directory.
    Directory,
    /// A symbolic link, to whatever.
    Link,
}

impl Names {
    pub(crate) const fn none() -> Self {
        Self { text: String::new(), ends: Vec::new() }
    }

    /// Those behind these.
    pub fn extend(&mut self, names: &Self) {
        let begin = self.text.len();
        self.text.push_str(&names.text);
        self.ends.extend(names.ends.iter().map(|end| begin + end));
    }

    /// One more name.
    pub fn push(&mut self, name: &str) {
        self.text.push_str(name);
        self.ends.push(self.text.len());
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// A name by its number.
    pub fn get(&self, number: usize) -> Option<&str> {
        let end = *self.ends.get(number)?;
        let begin = number.checked_sub(1).map_or(0, |before| self.ends[before]);
        Some(&self.text[begin..end])
    }

    /// All of them.
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
