//! Recognises drilling cycles among the moves of a parsed program. The reader has expanded them to moves.

use pathbuild_motion::{Action, Axes, Move, Pace, Path, Step};

use super::step::{Hole, HoleKind};

/// Returns the hole that some steps begin with, and the remaining steps. All its moves must come from one line that has no others.
pub(super) fn hole(steps: &[Step]) -> Option<(Hole, &[Step])> {
    let [first, second, ..] = steps else { return None };
    if first.line != second.line {
        return None;
    }
    let mut moves = Moves { line: first.line, steps };
    let mut level = None;
    while let Some(way) = moves.take(|it| it.pace == Pace::Rapid) {
        level = Some(if way.to.z() < way.from.z() && is_vertical(&way) { way.from.z() } else { way.to.z() });
    }
    let first = moves.take(is_drilling)?;
    let (mut last, mut pecks) = (first, false);
    while let Some(next) = moves.peck(first.from.z()) {
        (last, pecks) = (next, true);
    }
    let dwell = moves.dwell();
    let retract = first.from.z();
    let exit = moves.take(|it| it.pace == Pace::Rapid && is_vertical(it) && it.to.z() >= retract)?;
    let kind = match (pecks, dwell) {
        (false, None) => HoleKind::Plain,
        (false, Some(seconds)) => HoleKind::Dwell { seconds },
        (true, None) => HoleKind::Peck { depth: retract - first.to.z() },
        (true, Some(_)) => return None,
    };
    let hole = Hole {
        at: [first.to.x(), first.to.y()],
        level: level.unwrap_or(retract),
        retract,
        bottom: last.to.z(),
        exit: exit.to.z(),
        feed: first.pace.feed().filter(|feed| *feed > 0.0),
        kind,
    };
    Some((hole, moves.steps))
}

/// The remaining steps of a line.
struct Moves<'a> {
    line: u32,
    steps: &'a [Step],
}

impl<'a> Moves<'a> {
    /// Takes the next move, if it is straight, leads to a known position and satisfies the condition.
    fn take(&mut self, is_wanted: impl Fn(&Move) -> bool) -> Option<Move> {
        let (step, rest) = self.next()?;
        let Action::Move(it) = step.action else { return None };
        let is_plain = it.path == Path::Line && it.named.is_none() && it.to.known == Axes::ALL;
        (is_plain && is_wanted(&it)).then(|| {
            self.steps = rest;
            it
        })
    }

    /// Takes the moves of a peck: out of the hole, back down, and deeper.
    fn peck(&mut self, retract: f64) -> Option<Move> {
        let before = self.steps;
        let is_rapid = |it: &Move| it.pace == Pace::Rapid && is_vertical(it);
        let deeper = self.take(|it| is_rapid(it) && it.to.z() == retract).and_then(|_| {
            self.take(|it| is_rapid(it) && it.to.z() <= retract);
            self.take(is_drilling)
        });
        if deeper.is_none() {
            self.steps = before;
        }
        deeper
    }

    /// The next step of the line, and those after it.
    fn next(&self) -> Option<(&'a Step, &'a [Step])> {
        self.steps.split_first().filter(|(step, _)| step.line == self.line)
    }

    fn dwell(&mut self) -> Option<f64> {
        let (step, rest) = self.next()?;
        let Action::Dwell(seconds) = step.action else { return None };
        self.steps = rest;
        Some(seconds)
    }
}

fn is_vertical(it: &Move) -> bool {
    it.from.at[..2] == it.to.at[..2]
}

fn is_drilling(it: &Move) -> bool {
    matches!(it.pace, Pace::Feed(_))
        && is_vertical(it)
        && it.to.z() < it.from.z()
        && it.from.known == Axes::ALL
}
