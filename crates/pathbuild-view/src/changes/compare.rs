//! Finding the changes. What is the same in both programs is set aside first; what is left between is looked at more and more leniently:
//! the same moves elsewhere, moves along the same lines, and at last moves that were added or removed.

use std::collections::HashMap;
use std::hash::Hash;
use std::ops::Range;

use imara_diff::{Algorithm, Diff, Hunk, InternedInput, Interner};

use super::identity::{Deed, Trail};
use super::{Change, ChangeKind};
use crate::scene::{Move, Point};

/// The origin of a program.
const ORIGIN: Point = [0.0; 2];

/// The changes from one program to another, in the order of the new one. Empty where both do the same.
pub fn compare(old: &[Move], new: &[Move]) -> Vec<Change> {
    let comparison = Comparison { old, new };
    let hunks = hunks(old, new, |it| Deed::of(it, ORIGIN));
    let mut changes: Vec<Change> = hunks.into_iter().flat_map(|hunk| comparison.changed(&hunk)).collect();
    comparison.pair_reordered(&mut changes);
    changes
}

struct Comparison<'a> {
    old: &'a [Move],
    new: &'a [Move],
}

impl Comparison<'_> {
    /// What became of the moves of a hunk.
    fn changed(&self, hunk: &Hunk) -> Vec<Change> {
        let (old, new) = ranges(hunk);
        let mut changes = Vec::new();
        if let Some(core) = self.shifted(&old, &new) {
            self.replaced(old.start..core.old.start, new.start..core.new.start, &mut changes);
            let ends = (core.old.end, core.new.end);
            changes.push(core);
            self.replaced(ends.0..old.end, ends.1..new.end, &mut changes);
            return changes;
        }
        let (mut before, mut after) = (old.start, new.start);
        for hunk in hunks(&self.old[old.clone()], &self.new[new.clone()], |it| Trail::of(it, ORIGIN)) {
            let (was, is) = ranges(&hunk);
            let (was, is) =
                (old.start + was.start..old.start + was.end, new.start + is.start..new.start + is.end);
            self.altered(before..was.start, after..is.start, &mut changes);
            (before, after) = (was.end, is.end);
            self.replaced(was, is, &mut changes);
        }
        self.altered(before..old.end, after..new.end, &mut changes);
        changes
    }

    /// Moves along the same lines, one for one.
    fn altered(&self, old: Range<usize>, new: Range<usize>, changes: &mut Vec<Change>) {
        for (was, is) in old.zip(new) {
            let (a, b) = (&self.old[was], &self.new[is]);
            let kind = ChangeKind::Altered { raised: raised(a, b), feed: feed(a, b) };
            match changes.last_mut() {
                _ if kind == (ChangeKind::Altered { raised: 0.0, feed: None }) => {}
                Some(last) if last.kind == kind && last.old.end == was && last.new.end == is => {
                    (last.old.end, last.new.end) = (was + 1, is + 1);
                }
                _ => changes.push(Change { kind, old: was..was + 1, new: is..is + 1 }),
            }
        }
    }

    /// Moves that have nothing in common.
    fn replaced(&self, old: Range<usize>, new: Range<usize>, changes: &mut Vec<Change>) {
        if let Some(core) = self.shifted(&old, &new) {
            return changes.push(core);
        }
        let behind = old.end;
        for old in parts(self.old, old) {
            changes.push(Change { kind: ChangeKind::Removed, old, new: new.start..new.start });
        }
        for new in parts(self.new, new) {
            changes.push(Change { kind: ChangeKind::Added, old: behind..behind, new });
        }
    }

    /// The cuts of both rows with what is between them, where all of them are the same but elsewhere. The ways there and back are left out:
    /// their other ends are where they were.
    fn shifted(&self, old: &Range<usize>, new: &Range<usize>) -> Option<Change> {
        let (old, new) = (cuts(self.old, old)?, cuts(self.new, new)?);
        let by = [0, 1].map(|axis| self.new[new.start].to()[axis] - self.old[old.start].to()[axis]);
        let is_same = |(was, is): (&Move, &Move)| Deed::of(was, ORIGIN) == Deed::of(is, by);
        let mut pairs = self.old[old.clone()].iter().zip(&self.new[new.clone()]);
        let is_shifted = old.len() == new.len() && by != ORIGIN && pairs.all(is_same);
        is_shifted.then_some(Change { kind: ChangeKind::Shifted(by), old, new })
    }

    /// Moves that were removed here and added there.
    fn pair_reordered(&self, changes: &mut Vec<Change>) {
        let deeds = |moves: &[Move]| -> Vec<Deed> { moves.iter().map(|it| Deed::of(it, ORIGIN)).collect() };
        let mut removed: HashMap<Vec<Deed>, Vec<(usize, Range<usize>)>> = HashMap::new();
        for (index, change) in
            changes.iter().enumerate().filter(|(_, change)| change.kind == ChangeKind::Removed)
        {
            removed
                .entry(deeds(&self.old[change.old.clone()]))
                .or_default()
                .push((index, change.old.clone()));
        }
        let mut is_paired = vec![false; changes.len()];
        for change in changes.iter_mut().filter(|change| change.kind == ChangeKind::Added) {
            let from = removed.get_mut(&deeds(&self.new[change.new.clone()])).and_then(Vec::pop);
            if let Some((from, old)) = from {
                is_paired[from] = true;
                (change.kind, change.old) = (ChangeKind::Reordered, old);
            }
        }
        let mut is_paired = is_paired.into_iter();
        changes.retain(|_| !is_paired.next().unwrap_or_default());
    }
}

/// From the first cut of a row to behind the last.
fn cuts(moves: &[Move], row: &Range<usize>) -> Option<Range<usize>> {
    let is_cut = |index: &usize| moves[*index].kind.cuts();
    let first = row.clone().find(is_cut)?;
    let last = row.clone().rfind(is_cut)?;
    Some(first..last + 1)
}

/// A row in parts: the way to its first cut, the cuts with what is between them, and the way from its last. The cuts can be found again
/// elsewhere, the ways there and back cannot.
fn parts(moves: &[Move], row: Range<usize>) -> impl Iterator<Item = Range<usize>> + use<> {
    let core = cuts(moves, &row).unwrap_or(row.start..row.start);
    [row.start..core.start, core.clone(), core.end..row.end].into_iter().filter(|part| !part.is_empty())
}

/// By how many mm a move is higher than the one along the same line was: of its ends the one that differs more.
fn raised(old: &Move, new: &Move) -> f64 {
    let by = |from: f64, to: f64| ((to - from) * 1000.0).round() / 1000.0;
    let start = by(old.way.from.z(), new.way.from.z());
    let end = by(old.way.to.z(), new.way.to.z());
    let raised = if start.abs() > end.abs() { start } else { end };
    raised + 0.0
}

fn feed(old: &Move, new: &Move) -> Option<[f64; 2]> {
    let (was, is) = (old.way.pace.feed()?, new.way.pace.feed()?);
    let differs = (was - is).abs() >= 0.001;
    differs.then_some([was, is])
}

/// Where two rows of moves differ, by what counts of each.
fn hunks<K: Hash + Eq>(old: &[Move], new: &[Move], key: impl Fn(&Move) -> K) -> Vec<Hunk> {
    let interner = Interner::new(old.len() + new.len());
    let mut input = InternedInput { before: Vec::new(), after: Vec::new(), interner };
    input.update_before(old.iter().map(&key));
    input.update_after(new.iter().map(&key));
    Diff::compute(Algorithm::Histogram, &input).hunks().collect()
}

fn ranges(hunk: &Hunk) -> (Range<usize>, Range<usize>) {
    (hunk.before.start as usize..hunk.before.end as usize, hunk.after.start as usize..hunk.after.end as usize)
}
