//! The table of name ranges in a directory, for finding the files that may define a path. (book: language/layers-and-names)

use crate::files::{NameRange, PathKey};
use crate::group::Group;

/// The name ranges of many files, ordered by the first group of their first name. Integers and texts have no common order, so each lookup
/// searches either the integers or the texts, and scans all ranges from one to the other.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RangeTable {
    sorted: Vec<Entry>,
    /// Ranges that cannot be ordered.
    others: Vec<(NameRange, u32)>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Entry {
    /// The first groups of the first and of the last name.
    from: FirstGroup,
    to: FirstGroup,
    /// The maximum of `to` over the entries up to this one.
    latest: FirstGroup,
    range: NameRange,
    file: u32,
}

/// The first group of a name. Integers precede texts.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum FirstGroup {
    Integer(u64),
    /// A text in upper case.
    Text(String),
}

impl FirstGroup {
    /// `None` for a group that did not participate, and for an integer that is too long.
    fn new(group: &Group) -> Option<Self> {
        match group {
            Group::Short { value, .. } => Some(Self::Integer(*value)),
            Group::Other(_) if group.is_empty() || group.is_integer() => None,
            Group::Other(_) => Some(Self::text(group)),
        }
    }

    fn text(group: &Group) -> Self {
        Self::Text(group.text().chars().flat_map(char::to_uppercase).collect())
    }

    fn is_integer(&self) -> bool {
        matches!(self, Self::Integer(_))
    }
}

impl Entry {
    fn new(range: NameRange, file: u32) -> Result<Self, (NameRange, u32)> {
        let (from, to) = range.first_groups();
        match (FirstGroup::new(&from), FirstGroup::new(&to)) {
            (Some(from), Some(to)) if from.is_integer() == to.is_integer() => {
                Ok(Self { latest: to.clone(), from, to, range, file })
            }
            _ => Err((range, file)),
        }
    }
}

impl FromIterator<(NameRange, u32)> for RangeTable {
    /// Builds the table from ranges, each with the number of its file.
    fn from_iter<I: IntoIterator<Item = (NameRange, u32)>>(ranges: I) -> Self {
        let (mut sorted, mut others) = (Vec::new(), Vec::new());
        for (range, file) in ranges {
            match Entry::new(range, file) {
                Ok(entry) => sorted.push(entry),
                Err(other) => others.push(other),
            }
        }
        // Sorts by cached keys, since entries are large.
        sorted.sort_by_cached_key(|entry| entry.from.clone());
        for index in 1..sorted.len() {
            if sorted[index - 1].latest > sorted[index].latest {
                sorted[index].latest = sorted[index - 1].latest.clone();
            }
        }
        Self { sorted, others }
    }
}

impl RangeTable {
    /// The numbers of the files that may define a path, in ascending order without duplicates.
    pub fn files(&self, path: &PathKey) -> Vec<u32> {
        let mut files = Vec::new();
        let mut take = |range: &NameRange, file: u32| {
            if range.holds(path) {
                files.push(file);
            }
        };
        let group = path.first_group();
        match group.and_then(FirstGroup::new).zip(group) {
            Some((first, group)) => {
                // A text is compared with integers as text, for which they are not ordered.
                if !first.is_integer() {
                    self.integers().iter().for_each(|entry| take(&entry.range, entry.file));
                }
                if self.has_texts() {
                    self.around(&FirstGroup::text(group)).for_each(|entry| take(&entry.range, entry.file));
                }
                if first.is_integer() {
                    self.around(&first).for_each(|entry| take(&entry.range, entry.file));
                }
            }
            None => self.sorted.iter().for_each(|entry| take(&entry.range, entry.file)),
        }
        self.others.iter().for_each(|(range, file)| take(range, *file));
        files.sort_unstable();
        files.dedup();
        files
    }

    /// The entries whose ranges contain a first group.
    fn around(&self, first: &FirstGroup) -> impl Iterator<Item = &Entry> {
        let begun = self.sorted.partition_point(|entry| entry.from <= *first);
        let reaching = self.sorted[..begun].iter().rev().take_while(move |entry| entry.latest >= *first);
        reaching.filter(move |entry| entry.to >= *first)
    }

    fn has_texts(&self) -> bool {
        self.sorted.last().is_some_and(|entry| !entry.from.is_integer())
    }

    fn integers(&self) -> &[Entry] {
        &self.sorted[..self.sorted.partition_point(|entry| entry.from.is_integer())]
    }
}
