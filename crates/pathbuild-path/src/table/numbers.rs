//! Ranges of numbers, by which nearly all files are named.

use crate::number_range::{NumberKey, NumberRange};

/// Ranges in order of their beginnings, and over them a binary tree of their ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct NumberTable {
    entries: Vec<(NumberRange, u32)>,
    /// `latest[node]`: the last name that any range below that node holds. The leaves are the second half; the root is the second node.
    latest: Vec<NumberKey>,
}

impl NumberTable {
    pub(super) fn new(mut entries: Vec<(NumberRange, u32)>) -> Self {
        entries.sort_unstable();
        let leaves = entries.len().next_power_of_two();
        let mut latest = Vec::with_capacity(2 * leaves);
        latest.resize(leaves, NumberKey::default());
        latest.extend(entries.iter().map(|(range, _)| range.last()));
        latest.resize(2 * leaves, NumberKey::default());
        for node in (1..leaves).rev() {
            latest[node] = latest[2 * node].max(latest[2 * node + 1]);
        }
        Self { entries, latest }
    }

    pub(super) fn entries(&self) -> impl Iterator<Item = (NumberRange, u32)> {
        self.entries.iter().copied()
    }

    /// The files whose ranges hold a path, in no particular order.
    pub(super) fn files(&self, path: NumberKey) -> Vec<u32> {
        let begun = self.entries.partition_point(|(range, _)| range.first() <= path);
        let mut files = Vec::new();
        self.collect(1, 0, self.latest.len() / 2, begun, path, &mut files);
        files
    }

    /// Visits the entries before `begun` that end at or behind the path, leaving out subtrees that all end before it.
    fn collect(
        &self,
        node: usize,
        from: usize,
        to: usize,
        begun: usize,
        path: NumberKey,
        files: &mut Vec<u32>,
    ) {
        if from >= begun || self.latest[node] < path {
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
