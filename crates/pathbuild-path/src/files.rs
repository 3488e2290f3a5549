//! Finds the files that may define a path, by the names and ranges in their file names. (book: language/layers-and-names)

use std::borrow::Cow;
use std::cmp::Ordering;
use std::ops::Range;

use crate::PathPattern;
use crate::default_pattern::{DASHES, DefaultPattern};
use crate::group::{Group, Groups};
use crate::number_range::{NumberKey, NumberRange, number_key};
use crate::pattern::{Name, Pattern, PatternError};

/// The pattern of path names in the stem of a file name.
#[derive(Clone, Debug)]
pub struct FilePattern(Pattern);

/// A path name or a range of path names in a file name. A single name is a range with equal ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NameRange(Ends);

#[derive(Clone, Debug, PartialEq, Eq)]
enum Ends {
    /// The fast representation, used whenever possible.
    Numbers(NumberRange),
    Groups(Box<GroupRange>),
}

/// A range as the groups of its ends.
#[derive(Clone, Debug, PartialEq, Eq)]
struct GroupRange {
    from: FilePart,
    /// `None` for a single name.
    to: Option<FilePart>,
}

/// An end of a range: the groups of the file pattern.
#[derive(Clone, Debug, PartialEq, Eq)]
struct FilePart(Groups);

/// The groups of a path name, by which it is looked up.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PathKey {
    groups: Groups,
    number: Option<NumberKey>,
}

impl Default for FilePattern {
    fn default() -> Self {
        Self(Pattern::Default(DefaultPattern::File))
    }
}

impl FilePattern {
    /// The default: `1234` or `1234.5`.
    pub const DEFAULT: &str = DefaultPattern::File.source();

    /// Creates a pattern from the configuration or the command line.
    ///
    /// # Errors
    /// If it is not a valid regular expression, or matches an empty name.
    pub fn new(pattern: &str) -> Result<Self, PatternError> {
        let pattern = Pattern::new(pattern, DefaultPattern::File)?;
        pattern.check_ranges()?;
        Ok(Self(pattern))
    }

    /// The names and ranges in the stem of a file name, in the order of the specification: first ranges, then single names.
    pub fn ranges(&self, stem: &str) -> Vec<NameRange> {
        let mut found = Vec::new();
        self.each_range(stem, |range| found.push(range));
        found
    }

    /// Calls `take` for each of these names and ranges.
    pub fn each_range(&self, stem: &str, mut take: impl FnMut(NameRange)) {
        if let Some(numbers) = self.0.lone_numbers(stem) {
            return take(NumberRange::new(numbers, None).into());
        }
        // A range contains a dash, which most names do not.
        if stem.contains(DASHES) {
            self.0.each_range(stem, |from, to| take(NameRange::new(from, Some(to))));
        }
        self.0.each(stem, |name| take(NameRange::new(name, None)));
    }

    /// The positions of ranges in a stem.
    pub(crate) fn range_spans(&self, stem: &str) -> Vec<Range<usize>> {
        if stem.contains(DASHES) { self.0.range_spans(stem) } else { Vec::new() }
    }

    /// The regular expression as given.
    pub fn as_str(&self) -> &str {
        self.0.as_str()
    }
}

impl PathKey {
    /// The key of a name; `None` if the path pattern does not match it.
    pub fn new(name: &str, pattern: &PathPattern) -> Option<Self> {
        pattern.groups(name).map(|groups| Self { number: number_key(&groups), groups })
    }

    /// Whether another name is equal when compared like file names, in which numbers are compared by value, so that 01 equals 1.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        self.groups.len() == other.groups.len()
            && self.groups.iter().zip(other.groups.iter()).all(|(one, other)| one.compare(other).is_eq())
    }

    /// The first of its groups.
    pub(crate) fn first_group(&self) -> Option<&Group> {
        self.groups.first()
    }
}

impl NameRange {
    fn new(from: Name<'_>, to: Option<Name<'_>>) -> Self {
        let numbers = match (from.numbers(), &to) {
            (Some(from), None) => Some(NumberRange::new(from, None)),
            (Some(from), Some(to)) => to.numbers().map(|to| NumberRange::new(from, Some(to))),
            (None, _) => None,
        };
        Self(match numbers {
            Some(numbers) => Ends::Numbers(numbers),
            None => Ends::Groups(Box::new(GroupRange {
                from: FilePart(from.groups()),
                to: to.map(|to| FilePart(to.groups())),
            })),
        })
    }

    /// Whether a path of this name may be in the file.
    pub fn holds(&self, path: &PathKey) -> bool {
        if let (Ends::Numbers(range), Some(path)) = (&self.0, path.number) {
            return range.holds(path);
        }
        let range = self.groups();
        range.starts_by(path) && range.ends_by(path)
    }

    /// The first groups of the first and the last name.
    pub(crate) fn first_groups(&self) -> (Group, Group) {
        match &self.0 {
            Ends::Numbers(range) => range.first_groups(),
            Ends::Groups(range) => {
                let first = |part: &FilePart| part.0.first().cloned().unwrap_or_default();
                (first(&range.from), first(range.end()))
            }
        }
    }

    fn groups(&self) -> Cow<'_, GroupRange> {
        match &self.0 {
            Ends::Groups(range) => Cow::Borrowed(range),
            Ends::Numbers(range) => {
                let (from, to) = range.groups();
                Cow::Owned(GroupRange { from: FilePart(from), to: to.map(FilePart) })
            }
        }
    }
}

impl From<NumberRange> for NameRange {
    fn from(range: NumberRange) -> Self {
        Self(Ends::Numbers(range))
    }
}

impl GroupRange {
    fn starts_by(&self, path: &PathKey) -> bool {
        self.from.compare(path) != Ordering::Greater
    }

    fn ends_by(&self, path: &PathKey) -> bool {
        self.end().compare(path) != Ordering::Less
    }

    fn end(&self) -> &FilePart {
        self.to.as_ref().unwrap_or(&self.from)
    }
}

impl FilePart {
    /// Compares this part of a file name with the name of a path.
    fn compare(&self, path: &PathKey) -> Ordering {
        let (file, path) = (&self.0, &path.groups);
        for index in 0..file.len().max(path.len()) {
            let (file_group, path_group) = match (file.get(index), path.get(index)) {
                (Some(file), Some(path)) if !file.is_empty() && !path.is_empty() => (file, path),
                // A name without further groups covers one with more groups: 1234 equals 1234.3A, but 1234.3 is greater than 1234.
                _ if groups_left(file, index) > groups_left(path, index) => return Ordering::Greater,
                _ => return Ordering::Equal,
            };
            match file_group.compare(path_group) {
                Ordering::Equal => {}
                different => return different,
            }
        }
        Ordering::Equal
    }
}

fn groups_left(groups: &Groups, index: usize) -> usize {
    groups.iter().skip(index).filter(|group| !group.is_empty()).count()
}
