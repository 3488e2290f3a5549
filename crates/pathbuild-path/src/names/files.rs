//! Names of files: the paths and ranges of paths that they name, and the files that may define a path. (book: language/layers-and-names)

use std::cmp::Ordering;
use std::ops::Range;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::outputs as messages;

use super::pattern::{DASHES, DefaultPattern, Groups, Pattern, PatternError};
use super::{PathName, PathPattern};

/// The pattern of path names in the stem of a file name.
#[derive(Clone, Debug)]
pub struct FilePattern(Pattern);

/// A path name or a range of path names in a file name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NameRange {
    from: Groups,
    /// The last name of the range; `None` for a single name.
    to: Option<Groups>,
}

/// The groups of a path name, by which it is looked up.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PathKey(Groups);

impl Default for FilePattern {
    fn default() -> Self {
        Self(Pattern::Default(DefaultPattern::File))
    }
}

impl FilePattern {
    /// The default pattern, for names like `1234` or `1234.5`.
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

    /// Returns the names and ranges in the stem of a file name: first all ranges, then all names, including those at the ends of ranges.
    pub fn ranges(&self, stem: &str) -> Vec<NameRange> {
        let mut found = Vec::new();
        self.each_range(stem, |range| found.push(range));
        found
    }

    /// Calls `take` for each name and range in the stem of a file name.
    pub fn each_range(&self, stem: &str, mut take: impl FnMut(NameRange)) {
        // A range contains a dash, which most names do not.
        if stem.contains(DASHES) {
            self.0.each_range(stem, |from, to| take(NameRange { from, to: Some(to) }));
        }
        self.0.each(stem, |name| take(NameRange { from: name, to: None }));
    }

    /// Returns the byte ranges of the name ranges in a stem.
    pub(crate) fn range_spans(&self, stem: &str) -> Vec<Range<usize>> {
        if stem.contains(DASHES) { self.0.range_spans(stem) } else { Vec::new() }
    }

    /// The regular expression as given.
    pub fn as_str(&self) -> &str {
        self.0.as_str()
    }
}

impl PathKey {
    /// Returns the key of a name; `None` if the path pattern does not match it.
    pub fn new(name: &str, pattern: &PathPattern) -> Option<Self> {
        pattern.groups(name).map(Self)
    }

    /// Whether another name is equal when compared like file names, in which numbers are compared by value, so that 01 equals 1.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        self.0.len() == other.0.len()
            && self.0.iter().zip(&other.0).all(|(one, other)| compare_groups(one, other).is_eq())
    }
}

impl NameRange {
    /// Whether a path of this name may be in a file that is named with this range.
    pub fn holds(&self, path: &PathKey) -> bool {
        compare(&self.from, path).is_le() && compare(self.end(), path).is_ge()
    }

    fn end(&self) -> &Groups {
        self.to.as_ref().unwrap_or(&self.from)
    }
}

/// Compares an end of a range in a file's name with the name of a path.
fn compare(file: &Groups, PathKey(path): &PathKey) -> Ordering {
    let remaining =
        |groups: &Groups, index| groups.iter().skip(index).filter(|group| !group.is_empty()).count();
    for index in 0..file.len().max(path.len()) {
        let order = match (file.get(index), path.get(index)) {
            (Some(file), Some(path)) if !file.is_empty() && !path.is_empty() => compare_groups(file, path),
            // A file's name without further groups covers a path's name with more groups: 1234 equals 1234.3A, but 1234.3 is greater than 1234.
            _ if remaining(file, index) > remaining(path, index) => return Ordering::Greater,
            _ => return Ordering::Equal,
        };
        if order.is_ne() {
            return order;
        }
    }
    Ordering::Equal
}

/// Compares two integers of any length by value, and anything else as texts, ignoring case.
fn compare_groups(a: &str, b: &str) -> Ordering {
    if is_integer(a) && is_integer(b) {
        let (a, b) = (a.trim_start_matches('0'), b.trim_start_matches('0'));
        return a.len().cmp(&b.len()).then_with(|| a.cmp(b));
    }
    a.chars().flat_map(char::to_uppercase).cmp(b.chars().flat_map(char::to_uppercase))
}

fn is_integer(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}

/// The name ranges of many files, ordered by the first group of their first name. Integers and texts have no common order, so ranges between an
/// integer and a text are kept apart, and each lookup scans them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RangeTable {
    sorted: Vec<Entry>,
    /// Ranges that cannot be ordered, each with the number of its file.
    others: Vec<(NameRange, u32)>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Entry {
    /// First group of the range's first name.
    from: FirstGroup,
    /// First group of the range's last name.
    to: FirstGroup,
    /// The maximum of `to` over the entries up to this one.
    latest: FirstGroup,
    range: NameRange,
    file: u32,
}

/// The first group of a name. Integers are less than texts.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum FirstGroup {
    Integer(u64),
    /// A text in upper case.
    Text(String),
}

impl FirstGroup {
    /// Returns the first group; `None` if the group did not participate in the match or is an integer that is too long.
    fn new(group: &str) -> Option<Self> {
        match group {
            "" => None,
            integer if is_integer(integer) => integer.parse().ok().map(Self::Integer),
            text => Some(Self::text(text)),
        }
    }

    fn text(group: &str) -> Self {
        Self::Text(group.chars().flat_map(char::to_uppercase).collect())
    }

    fn is_integer(&self) -> bool {
        matches!(self, Self::Integer(_))
    }
}

impl Entry {
    fn new(range: NameRange, file: u32) -> Result<Self, (NameRange, u32)> {
        let first = |groups: &Groups| FirstGroup::new(groups.first()?);
        match (first(&range.from), first(range.end())) {
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
        // The small keys are sorted first; then each of the large entries is moved once.
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
    /// Returns the numbers of the files that may define a path, in ascending order without duplicates.
    pub fn files(&self, path: &PathKey) -> Vec<u32> {
        let mut files = Vec::new();
        let mut take = |range: &NameRange, file: u32| {
            if range.holds(path) {
                files.push(file);
            }
        };
        let group = path.0.first();
        match group.and_then(|group| FirstGroup::new(group)).zip(group) {
            Some((first, group)) => {
                // A text is compared with integers as if they were texts, but the table is not sorted that way, so all integers are scanned.
                if !first.is_integer() {
                    self.integers().iter().for_each(|entry| take(&entry.range, entry.file));
                }
                if self.has_texts() {
                    self.entries_around(&FirstGroup::text(group))
                        .for_each(|entry| take(&entry.range, entry.file));
                }
                if first.is_integer() {
                    self.entries_around(&first).for_each(|entry| take(&entry.range, entry.file));
                }
            }
            None => self.sorted.iter().for_each(|entry| take(&entry.range, entry.file)),
        }
        self.others.iter().for_each(|(range, file)| take(range, *file));
        files.sort_unstable();
        files.dedup();
        files
    }

    /// Returns the entries with ranges that include a first group.
    fn entries_around(&self, first: &FirstGroup) -> impl Iterator<Item = &Entry> {
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

/// Returns PB519 for paths in the file's name that are on no layer, and PB521 for paths that are never looked up in a file of this name. Q-projects
/// are exempt, since they are named after the drawing that they test. `stem`: the name without `.dxf`; `drawn`: the paths of the drawing.
pub fn check_file_name(
    stem: &str,
    drawn: &[PathName],
    files: &FilePattern,
    paths: &PathPattern,
) -> Vec<Diagnostic> {
    if is_q_project(stem) {
        return Vec::new();
    }
    let key = |name: &PathName| PathKey::new(name.as_str(), paths);
    let ranges = files.ranges(stem);
    let is_covered =
        |name: &PathName| key(name).is_some_and(|key| ranges.iter().any(|range| range.holds(&key)));
    let keys: Vec<PathKey> = drawn.iter().filter_map(key).collect();
    let is_drawn =
        |name: &PathName| key(name).is_some_and(|key| keys.iter().any(|known| known.is_like(&key)));
    let promised = names_in_file_name(stem, files, paths).into_iter().filter(|name| !is_drawn(name));
    let broken =
        promised.map(|name| Diagnostic::new(&messages::PROMISED_PATH).quoting("name", name.as_str()));
    let strays = drawn.iter().filter(|name| !is_covered(name)).map(|name| {
        let stray = Diagnostic::new(&messages::STRAY_PATH).quoting("name", name.as_str());
        stray.in_path(name.as_str())
    });
    broken.chain(strays).collect()
}

/// Whether a drawing with this name, given without `.dxf`, is a Q-project.
pub fn is_q_project(stem: &str) -> bool {
    tested_by_q_project(stem).is_some()
}

/// Returns the name of the drawing that a Q-project tests, both without `.dxf`; `None` for the name of another drawing.
pub fn tested_by_q_project(stem: &str) -> Option<&str> {
    stem.strip_suffix("_Q").or_else(|| stem.strip_suffix("_q"))
}

/// Returns the name of the Q-project that tests a drawing, both without `.dxf`.
pub fn q_project_name(stem: &str) -> String {
    format!("{stem}_Q")
}

/// Returns the full path names in a file's name, without duplicates and without the ends of ranges.
fn names_in_file_name(stem: &str, files: &FilePattern, paths: &PathPattern) -> Vec<PathName> {
    let ranges = files.range_spans(stem);
    let mut promised: Vec<PathName> = Vec::new();
    let mut from = 0;
    while let Some((name, found)) = stem.get(from..).and_then(|rest| paths.first_in(rest)) {
        let found = from + found.start..from + found.end;
        let is_end = ranges.iter().any(|range| range.start < found.end && found.start < range.end);
        let is_whole = !stem[..found.start].ends_with(char::is_alphanumeric)
            && !stem[found.end..].starts_with(char::is_alphanumeric);
        if is_whole && !is_end && !promised.contains(&name) {
            promised.push(name);
        }
        from = found.end.max(from + 1);
    }
    promised
}
