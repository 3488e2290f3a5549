//! Matches the moves of a program with lines of its text. A post may write other rapid moves than the native program, cycles for holes, and
//! several lines for a move, so lines are matched by the ends of moves.

use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{Heights, Options, interpret_each};
use pathbuild_motion::{Axes, Move, Pace, Position};

/// Tolerance in mm within which two ends are the same: larger than the rounding error of inches with four decimals.
const SAME_PLACE: f64 = 0.006;

/// Maximum number of moves in the text that are searched for the end of one move.
const SEARCHED: usize = 4096;

/// For each move of a program, its line in the text that was written from it; `None` if there is none.
pub(super) fn lines_of_moves(moves: &[Move], text: &[u8], dialect: Dialect) -> Vec<Option<u32>> {
    let options = Options { heights: Heights::Nominal, ..Options::default() };
    let mut written: Vec<(u32, Move)> = Vec::new();
    interpret_each(text, dialect, &options, &mut |step| {
        // Moves before the first fully known position belong to the frame.
        if let Some((line, movement)) = step.as_move()
            && (!written.is_empty() || movement.from.known == Axes::ALL)
        {
            written.push((line, movement));
        }
    });
    let mut finder = Finder { written: &written, next: 0, last: None };
    moves.iter().map(|movement| finder.line(movement)).collect()
}

struct Finder<'a> {
    written: &'a [(u32, Move)],
    /// Index of the first written move that is not matched yet.
    next: usize,
    last: Option<u32>,
}

impl Finder<'_> {
    fn line(&mut self, movement: &Move) -> Option<u32> {
        match movement.pace {
            Pace::Rapid => self.rapid(movement),
            Pace::Feed(_) | Pace::Probe { .. } => self.cut(movement),
        }
    }

    /// The first line of a cut. The cut ends where its last piece ends.
    fn cut(&mut self, movement: &Move) -> Option<u32> {
        let is_cut = |(_, written): &(u32, Move)| !matches!(written.pace, Pace::Rapid);
        let rest = &self.written[self.next..self.written.len().min(self.next + SEARCHED)];
        let ends =
            |candidate: &(u32, Move)| is_cut(candidate) && is_same(&candidate.1.to, &movement.to, Axes::ALL);
        let end = rest.iter().position(ends)?;
        let first = rest[..=end].iter().find(|candidate| is_cut(candidate))?.0;
        self.next += end + 1;
        self.last = Some(first);
        Some(first)
    }

    /// The line of a rapid move before the next cut: one with the same ends, or else with the same end, or else in the same direction. If
    /// one line stands for several moves, it is the line of the move before.
    fn rapid(&mut self, movement: &Move) -> Option<u32> {
        let rest = &self.written[self.next..];
        let rapids = rest.iter().take_while(|(_, written)| written.pace == Pace::Rapid);
        let rapids: Vec<&Move> = rapids.take(SEARCHED).map(|(_, written)| written).collect();
        let moved = if movement.is_upright() { Axes::Z } else { Axes::XY };
        let has_both = |written: &&Move| {
            is_same(&written.from, &movement.from, Axes::ALL) && is_same(&written.to, &movement.to, Axes::ALL)
        };
        let has_end = |written: &&Move| is_same(&written.to, &movement.to, Axes::ALL);
        let has_part = |written: &&Move| is_same(&written.to, &movement.to, moved);
        let found = rapids.iter().position(has_both);
        let found = found.or_else(|| rapids.iter().position(has_end));
        let found = found.or_else(|| rapids.iter().position(has_part));
        if let Some(found) = found {
            self.last = Some(rest[found].0);
            self.next += found + 1;
        }
        self.last
    }
}

/// Whether two places are the same along some axes.
fn is_same(a: &Position, b: &Position, axes: Axes) -> bool {
    (0..3).filter(|axis| axes.has(Axes::of(*axis))).all(|axis| {
        a.known.and(b.known).has(Axes::of(axis)) && libm::fabs(a.at[axis] - b.at[axis]) < SAME_PLACE
    })
}
