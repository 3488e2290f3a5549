//! Finds the changes between two programs. Equal moves are set aside. Among the rest, a run of moves that occurs at another place is
//! shifted; every other move is classified by its line in the plane: its final depth, feed and number of passes, before and after.

use std::collections::HashMap;
use std::ops::Range;

use imara_diff::{Algorithm, Diff, InternedInput, Interner};
use pathbuild_motion::Axes;

use super::identity::{Line, MillingResult, MoveIdentity, is_rapid, lines};
use super::{Change, ChangeKind};
use crate::scene::{Move, Point};

/// The origin of a program.
const ORIGIN: Point = [0.0; 2];

/// The changes from one program to another, in the order of the new one. Empty if both are equivalent.
pub fn compare(old: &[Move], new: &[Move]) -> Vec<Change> {
    let rows = differing(old, new);
    if rows.is_empty() {
        return Vec::new();
    }
    let comparison = Comparison { old, new, was: lines(old), is: lines(new) };
    rows.into_iter().flat_map(|(old, new)| comparison.changed(&old, &new)).collect()
}

/// The runs of moves in which two programs differ.
fn differing(old: &[Move], new: &[Move]) -> Vec<(Range<usize>, Range<usize>)> {
    // The way to the first fully known position depends on the machine.
    let begin =
        |moves: &[Move]| moves.iter().take_while(|movement| !movement.way.from.known.has(Axes::ALL)).count();
    let (was, is) = (begin(old), begin(new));
    let interner = Interner::new(old.len() + new.len());
    let mut input = InternedInput { before: Vec::new(), after: Vec::new(), interner };
    input.update_before(old[was..].iter().map(|movement| MoveIdentity::of(movement, ORIGIN)));
    input.update_after(new[is..].iter().map(|movement| MoveIdentity::of(movement, ORIGIN)));
    let row = |start: usize, row: &Range<u32>| start + row.start as usize..start + row.end as usize;
    let diff = Diff::compute(Algorithm::Histogram, &input);
    diff.hunks().map(|hunk| (row(was, &hunk.before), row(is, &hunk.after))).collect()
}

struct Comparison<'a> {
    old: &'a [Move],
    new: &'a [Move],
    was: HashMap<Line, MillingResult>,
    is: HashMap<Line, MillingResult>,
}

impl Comparison<'_> {
    /// Classifies the moves in a pair of differing runs.
    fn changed(&self, old: &Range<usize>, new: &Range<usize>) -> Vec<Change> {
        let mut changes = Vec::new();
        match self.shifted(old, new) {
            Some(core) => {
                self.judge(old.start..core.old.start, new.start..core.new.start, &mut changes);
                let behind = (core.old.end..old.end, core.new.end..new.end);
                changes.push(core);
                self.judge(behind.0, behind.1, &mut changes);
            }
            None => self.judge(old.clone(), new.clone(), &mut changes),
        }
        changes
    }

    /// A shift, if the cuts of both runs and the moves between them are equal except for their position. The approach and the departure are
    /// excluded, since their other ends did not move.
    fn shifted(&self, old: &Range<usize>, new: &Range<usize>) -> Option<Change> {
        let (old, new) = (cuts(self.old, old)?, cuts(self.new, new)?);
        let by = [0, 1].map(|axis| self.new[new.start].to()[axis] - self.old[old.start].to()[axis]);
        let is_same = |(was, is): (&Move, &Move)| MoveIdentity::of(was, ORIGIN) == MoveIdentity::of(is, by);
        let mut pairs = self.old[old.clone()].iter().zip(&self.new[new.clone()]);
        let is_shifted = old.len() == new.len() && by != ORIGIN && pairs.all(is_same);
        is_shifted.then_some(Change { kind: ChangeKind::Shifted(by), old, new })
    }

    /// Classifies each move by its line.
    fn judge(&self, old: Range<usize>, new: Range<usize>, changes: &mut Vec<Change>) {
        let (behind, before) = (old.end, new.start);
        for index in old {
            let movement = &self.old[index];
            // A line that is still milled is classified by its move in the new program.
            if is_rapid(movement) || !self.is.contains_key(&Line::of(movement)) {
                add(changes, ChangeKind::Removed, index..index + 1, before..before);
            }
        }
        for index in new {
            let movement = &self.new[index];
            let kind = if is_rapid(movement) { ChangeKind::Added } else { self.kind(&Line::of(movement)) };
            add(changes, kind, behind..behind, index..index + 1);
        }
    }

    /// The change of a line of the new program.
    fn kind(&self, line: &Line) -> ChangeKind {
        let (Some(was), Some(is)) = (self.was.get(line), self.is.get(line)) else { return ChangeKind::Added };
        let raised = ((is.bottom - was.bottom) * 1000.0).round() / 1000.0 + 0.0;
        let feed = ((is.feed - was.feed).abs() >= 0.001).then_some([was.feed, is.feed]);
        let passes = (is.passes != was.passes).then_some([was.passes, is.passes]);
        match (feed, passes) {
            (None, None) if raised == 0.0 => ChangeKind::Reordered,
            _ => ChangeKind::Altered { raised, feed, passes },
        }
    }
}

/// Adds a move; merges it with the previous change if that is adjacent and of the same kind.
fn add(changes: &mut Vec<Change>, kind: ChangeKind, old: Range<usize>, new: Range<usize>) {
    match changes.last_mut() {
        Some(last) if last.kind == kind && last.old.end == old.start && last.new.end == new.start => {
            (last.old.end, last.new.end) = (old.end, new.end);
        }
        _ => changes.push(Change { kind, old, new }),
    }
}

/// The range from the first to the last cut of a run.
fn cuts(moves: &[Move], row: &Range<usize>) -> Option<Range<usize>> {
    let is_cut = |index: &usize| moves[*index].kind.cuts();
    let first = row.clone().find(is_cut)?;
    let last = row.clone().rfind(is_cut)?;
    Some(first..last + 1)
}
