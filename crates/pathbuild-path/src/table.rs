//! The sorted table of a directory's name ranges: which files may hold a path, in O(log n + hits). (spec/20-paths-and-files.md)

use std::cmp::Ordering;

use crate::files::{NameRange, PathKey};
use crate::group::Group;

/// The name ranges of many files, for looking up path names.
///
/// Where every group is always an integer or always a text (as with the default patterns), ranges have an order and are searched
/// like an interval tree. Else "integers by value, the rest as text" is no order, and all ranges are looked at.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RangeTable {
    /// In order of their beginnings where `classes` is there, else as added.
    entries: Vec<(NameRange, u32)>,
    /// What each group is; `None` when the ranges have no order.
    classes: Option<Vec<Class>>,
    /// `furthest[node]`: the entry with the greatest end below that node of the binary tree over `entries`.
    furthest: Vec<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Class {
    Integer,
    Text,
}

impl RangeTable {
    /// A table of ranges, each with the number of the file that it is in the name of.
    pub fn new(mut entries: Vec<(NameRange, u32)>) -> Self {
        let classes = classes(&entries);
        if classes.is_some() {
            sort(&mut entries);
        }
        let mut table = Self { entries, classes, furthest: Vec::new() };
        if table.is_sorted() {
            table.furthest = vec![0; 2 * table.entries.len().next_power_of_two()];
            table.build(1, 0, table.leaves());
        }
        table
    }

    /// Whether look-ups use the order. When not, each looks at every range.
    pub fn is_sorted(&self) -> bool {
        self.classes.is_some()
    }

    /// The numbers of the files that may hold a path: ascending, each once.
    pub fn files(&self, path: &PathKey) -> Vec<u32> {
        let mut files = Vec::new();
        if self.fits(path) {
            let begun = self.entries.partition_point(|(range, _)| range.starts_by(path));
            self.collect(1, 0, self.leaves(), begun, path, &mut files);
        } else {
            files.extend(self.entries.iter().filter(|(range, _)| range.holds(path)).map(|(_, file)| *file));
        }
        files.sort_unstable();
        files.dedup();
        files
    }

    /// Whether the path's groups are of the kinds that the table is ordered by.
    fn fits(&self, path: &PathKey) -> bool {
        let Some(classes) = &self.classes else { return false };
        let groups = path.groups();
        let compared = groups.iter().zip(classes);
        has_no_gap(groups)
            && compared.into_iter().all(|(group, class)| group.is_empty() || Class::of(group) == *class)
    }

    fn leaves(&self) -> usize {
        self.entries.len().next_power_of_two()
    }

    fn build(&mut self, node: usize, from: usize, to: usize) -> Option<u32> {
        if from >= self.entries.len() {
            return None;
        }
        let best = if to - from == 1 {
            u32::try_from(from).expect("a directory has fewer than 2^32 name ranges")
        } else {
            let middle = usize::midpoint(from, to);
            let left = self.build(2 * node, from, middle)?;
            match self.build(2 * node + 1, middle, to) {
                Some(right) if self.ends_later(right, left) => right,
                _ => left,
            }
        };
        self.furthest[node] = best;
        Some(best)
    }

    fn ends_later(&self, a: u32, b: u32) -> bool {
        let end = |entry: u32| self.entries[entry as usize].0.end_groups();
        compare_ends(end(a), end(b), Ordering::Greater) == Ordering::Greater
    }

    /// Visits the entries before `begun` that end at or behind the path, leaving out subtrees that all end before it.
    fn collect(
        &self,
        node: usize,
        from: usize,
        to: usize,
        begun: usize,
        path: &PathKey,
        files: &mut Vec<u32>,
    ) {
        if from >= begun || !self.entries[self.furthest[node] as usize].0.ends_by(path) {
            return;
        }
        if to - from == 1 {
            files.push(self.entries[from].1);
            return;
        }
        let middle = usize::midpoint(from, to);
        self.collect(2 * node, from, middle, begun, path, files);
        self.collect(2 * node + 1, middle, to, begun, path, files);
    }
}

impl Class {
    fn of(group: &Group) -> Self {
        if group.is_integer() { Self::Integer } else { Self::Text }
    }
}

/// The class of each group, when every range agrees on it and no range has an empty group before a full one.
fn classes(entries: &[(NameRange, u32)]) -> Option<Vec<Class>> {
    let mut classes: Vec<Class> = Vec::new();
    let ends = entries.iter().flat_map(|(range, _)| [range.start_groups(), range.end_groups()]);
    for groups in ends {
        if !has_no_gap(groups) {
            return None;
        }
        for (index, group) in groups.iter().take_while(|group| !group.is_empty()).enumerate() {
            match classes.get(index) {
                None => classes.push(Class::of(group)),
                Some(class) if *class == Class::of(group) => {}
                Some(_) => return None,
            }
        }
    }
    Some(classes)
}

fn has_no_gap(groups: &[Group]) -> bool {
    groups.iter().skip_while(|group| !group.is_empty()).all(Group::is_empty)
}

/// Puts ranges in order of their beginnings.
fn sort(entries: &mut [(NameRange, u32)]) {
    if entries.iter().all(|(range, _)| short_key(range.start_groups()).is_some()) {
        // Of ten thousand drawings, most of the time would go into comparing groups.
        entries.sort_by_cached_key(|(range, file)| (short_key(range.start_groups()), *file));
    } else {
        entries.sort_by(|(a, file_a), (b, file_b)| {
            compare_ends(a.start_groups(), b.start_groups(), Ordering::Less).then(file_a.cmp(file_b))
        });
    }
}

/// What orders a beginning as [`compare_ends`] does, where it is at most two short integers.
fn short_key(groups: &[Group]) -> Option<[u64; 2]> {
    let mut key = [0; 2];
    for (index, group) in groups.iter().take_while(|group| !group.is_empty()).enumerate() {
        let Group::Short { value, .. } = group else { return None };
        // 0 is for a group that is not there.
        *key.get_mut(index)? = value.checked_add(1)?;
    }
    Some(key)
}

/// Orders ends of ranges; an end that is the beginning of another is `shorter` than it: a range begins with the first and ends with
/// the last path that its end covers.
fn compare_ends(a: &[Group], b: &[Group], shorter: Ordering) -> Ordering {
    let full = |groups: &[Group]| groups.iter().take_while(|group| !group.is_empty()).count();
    let (a, b) = (&a[..full(a)], &b[..full(b)]);
    let difference = a.iter().zip(b).map(|(x, y)| x.compare(y)).find(|order| order.is_ne());
    difference.unwrap_or_else(|| match a.len().cmp(&b.len()) {
        Ordering::Less => shorter,
        Ordering::Equal => Ordering::Equal,
        Ordering::Greater => shorter.reverse(),
    })
}
