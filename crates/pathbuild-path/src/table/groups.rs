//! Ranges whose groups have an order, other than numbers: searched like an interval tree.

use std::cmp::Ordering;

use super::tree::visit;
use crate::files::{GroupRange, NameRange, PathKey};
use crate::group::Group;

/// Ranges in order of their beginnings, and over them a binary tree of their ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct GroupTable {
    entries: Vec<(GroupRange, u32)>,
    /// What each group is.
    classes: Vec<Class>,
    /// `furthest[node]`: the entry with the greatest end below that node.
    furthest: Vec<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Class {
    Integer,
    Text,
}

impl GroupTable {
    /// `None` when the ranges have no order.
    pub(super) fn new(ranges: &[(NameRange, u32)]) -> Option<Self> {
        let mut entries: Vec<(GroupRange, u32)> =
            ranges.iter().map(|(range, file)| (range.groups().into_owned(), *file)).collect();
        let classes = classes(&entries)?;
        entries.sort_by(|(a, file_a), (b, file_b)| {
            compare_ends(a.start_groups(), b.start_groups(), Ordering::Less).then(file_a.cmp(file_b))
        });
        let mut table = Self { entries, classes, furthest: Vec::new() };
        table.furthest = vec![0; 2 * table.leaves()];
        table.build(1, 0, table.leaves());
        Some(table)
    }

    /// The files whose ranges hold a path, in no particular order.
    pub(super) fn files(&self, path: &PathKey) -> Vec<u32> {
        let mut files = Vec::new();
        if self.fits(path) {
            let begun = self.entries.partition_point(|(range, _)| range.starts_by(path));
            let ends_before = |node: usize| !self.entries[self.furthest[node] as usize].0.ends_by(path);
            visit(self.leaves(), begun, &ends_before, &mut |entry| files.push(self.entries[entry].1));
        } else {
            let holds = |range: &GroupRange| range.starts_by(path) && range.ends_by(path);
            files.extend(self.entries.iter().filter(|(range, _)| holds(range)).map(|(_, file)| *file));
        }
        files
    }

    /// Whether the path's groups are of the kinds that the table is ordered by.
    fn fits(&self, path: &PathKey) -> bool {
        let groups = path.groups();
        let compared = groups.iter().zip(&self.classes);
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
}

impl Class {
    fn of(group: &Group) -> Self {
        if group.is_integer() { Self::Integer } else { Self::Text }
    }
}

/// The class of each group, when every range agrees on it and no range has an empty group before a full one.
fn classes(entries: &[(GroupRange, u32)]) -> Option<Vec<Class>> {
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
