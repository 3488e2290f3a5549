//! Which files may hold a path, by the path names and ranges in the file's name. (spec/20-paths-and-files.md)

use std::cmp::Ordering;

use crate::PathPattern;
use crate::pattern::{LazyRegex, Pattern, PatternError};

/// What describes path names in a file's stem.
#[derive(Clone, Debug)]
pub struct FilePattern {
    part: Pattern,
    range: LazyRegex,
}

/// A path name, or a range of them, in a file's name. A single name is a range from itself to itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NameRange {
    from: FilePart,
    to: FilePart,
}

/// One end of a range: the groups of the file pattern.
#[derive(Clone, Debug, PartialEq, Eq)]
struct FilePart(Vec<Box<str>>);

/// The groups of a path name, by which it is looked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PathKey(Vec<Box<str>>);

impl Default for FilePattern {
    fn default() -> Self {
        Self::known(Self::DEFAULT)
    }
}

impl FilePattern {
    /// The default: `1234` or `1234.5`.
    pub const DEFAULT: &str = "([0-9]{4})(?:[.]([0-9]+))?";

    /// A pattern from the configuration or the command line.
    ///
    /// # Errors
    /// When it is no regular expression, or matches an empty name.
    pub fn new(pattern: &str) -> Result<Self, PatternError> {
        if pattern == Self::DEFAULT {
            return Ok(Self::default());
        }
        let known = Self { part: Pattern::new(pattern)?, ..Self::known(pattern) };
        known.range.check()?;
        Ok(known)
    }

    fn known(pattern: &str) -> Self {
        let range = LazyRegex::new(format!("(?P<from>{pattern})-(?P<to>{pattern})"));
        Self { part: Pattern::known(pattern), range }
    }

    /// The names and ranges in a file's stem, in the order of the specification: ranges, then single names.
    pub fn ranges(&self, stem: &str) -> Vec<NameRange> {
        let mut found = Vec::new();
        // A range has a hyphen in it; most names have none, and the search for ranges is the dearest part of listing a directory.
        if stem.contains('-') {
            found.extend(self.range.captures_all(stem).filter_map(|ends| {
                Some(NameRange { from: self.file_part(&ends["from"])?, to: self.file_part(&ends["to"])? })
            }));
        }
        found.extend(self.part.find_all(stem).filter_map(|name| {
            let part = self.file_part(name)?;
            Some(NameRange { from: part.clone(), to: part })
        }));
        found
    }

    /// The regular expression as it was given.
    pub fn as_str(&self) -> &str {
        self.part.as_str()
    }

    fn file_part(&self, name: &str) -> Option<FilePart> {
        Some(FilePart(self.part.groups(name)?.into_iter().map(Into::into).collect()))
    }
}

impl PathKey {
    /// The key of a name; `None` when the path pattern does not match it.
    pub fn new(name: &str, pattern: &PathPattern) -> Option<Self> {
        Some(Self(pattern.groups(name)?.into_iter().map(Into::into).collect()))
    }

    /// The groups as text.
    pub(crate) fn groups(&self) -> &[Box<str>] {
        &self.0
    }
}

impl NameRange {
    /// Whether a path of this name may be in the file.
    pub fn holds(&self, path: &PathKey) -> bool {
        self.starts_by(path) && self.ends_by(path)
    }

    pub(crate) fn starts_by(&self, path: &PathKey) -> bool {
        self.from.compare(path) != Ordering::Greater
    }

    pub(crate) fn ends_by(&self, path: &PathKey) -> bool {
        self.to.compare(path) != Ordering::Less
    }

    pub(crate) fn start_groups(&self) -> &[Box<str>] {
        &self.from.0
    }

    pub(crate) fn end_groups(&self) -> &[Box<str>] {
        &self.to.0
    }
}

impl FilePart {
    /// How this part of a file's name lies to a path's name.
    fn compare(&self, path: &PathKey) -> Ordering {
        let longest = self.0.len().max(path.0.len());
        for index in 0..longest {
            let file_group = self.0.get(index).map_or("", |group| &**group);
            let path_group = path.0.get(index).map_or("", |group| &**group);
            if file_group.is_empty() || path_group.is_empty() {
                // What has no more groups covers what has some: 1234 is equal to 1234.3A, but 1234.3 is greater than 1234.
                return if groups_left(&self.0, index) > groups_left(&path.0, index) {
                    Ordering::Greater
                } else {
                    Ordering::Equal
                };
            }
            match compare_groups(file_group, path_group) {
                Ordering::Equal => {}
                different => return different,
            }
        }
        Ordering::Equal
    }
}

fn groups_left(groups: &[Box<str>], index: usize) -> usize {
    groups.iter().skip(index).filter(|group| !group.is_empty()).count()
}

/// Two integers by value, however long, else two texts without regard to case.
pub(crate) fn compare_groups(a: &str, b: &str) -> Ordering {
    if is_integer(a) && is_integer(b) {
        let (a, b) = (a.trim_start_matches('0'), b.trim_start_matches('0'));
        return a.len().cmp(&b.len()).then_with(|| a.cmp(b));
    }
    a.chars().flat_map(char::to_uppercase).cmp(b.chars().flat_map(char::to_uppercase))
}

pub(crate) fn is_integer(group: &str) -> bool {
    !group.is_empty() && group.bytes().all(|byte| byte.is_ascii_digit())
}
