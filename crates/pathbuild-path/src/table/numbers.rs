//! Ranges of numbers, by which nearly all files are named.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::tree::visit;
use crate::number_range::{NumberKey, NumberRange};

/// Ranges of numbers. The first few look-ups look at all of them: a project embeds ten paths, and to put ten thousand ranges in order takes
/// longer than ten looks.
#[derive(Debug)]
pub(super) struct NumberTable {
    entries: Vec<(NumberRange, u32)>,
    /// How often it was looked through.
    looks: AtomicUsize,
    sorted: OnceLock<Sorted>,
}

/// Ranges in order of their beginnings, and over them a binary tree of their ends.
#[derive(Debug)]
struct Sorted {
    entries: Vec<(NumberRange, u32)>,
    /// `latest[node]`: the last name that any range below that node holds. The leaves are the second half; the root is the second node.
    latest: Vec<NumberKey>,
}

/// So many looks at all ranges take about as long as putting them in order.
const LOOKS: usize = 64;

impl NumberTable {
    pub(super) fn new(entries: Vec<(NumberRange, u32)>) -> Self {
        Self { entries, looks: AtomicUsize::new(0), sorted: OnceLock::new() }
    }

    pub(super) fn entries(&self) -> impl Iterator<Item = (NumberRange, u32)> {
        self.entries.iter().copied()
    }

    /// The files whose ranges hold a path, in no particular order.
    pub(super) fn files(&self, path: NumberKey) -> Vec<u32> {
        if self.looks.fetch_add(1, Ordering::Relaxed) < LOOKS {
            return holding(&self.entries, path).collect();
        }
        self.sorted.get_or_init(|| Sorted::new(self.entries.clone())).files(path)
    }
}

/// The files of ranges that hold a path, by looking at all: some at a time, since nearly all are looked at in vain.
pub(super) fn holding(entries: &[(NumberRange, u32)], path: NumberKey) -> impl Iterator<Item = u32> {
    const AT_ONCE: usize = 16;
    let holds = move |(range, _): &&(NumberRange, u32)| range.holds(path);
    let has_any = move |some: &&[(NumberRange, u32)]| {
        some.iter().fold(false, |has_any, (range, _)| has_any | range.holds(path))
    };
    entries
        .chunks(AT_ONCE)
        .filter(has_any)
        .flat_map(move |some| some.iter().filter(holds).map(|(_, file)| *file))
}

impl Clone for NumberTable {
    fn clone(&self) -> Self {
        Self::new(self.entries.clone())
    }
}

impl PartialEq for NumberTable {
    fn eq(&self, other: &Self) -> bool {
        self.entries == other.entries
    }
}

impl Eq for NumberTable {}

impl Sorted {
    fn new(mut entries: Vec<(NumberRange, u32)>) -> Self {
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

    fn files(&self, path: NumberKey) -> Vec<u32> {
        let begun = self.entries.partition_point(|(range, _)| range.first() <= path);
        let mut files = Vec::new();
        let ends_before = |node: usize| self.latest[node] < path;
        visit(self.latest.len() / 2, begun, &ends_before, &mut |entry| files.push(self.entries[entry].1));
        files
    }
}
