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
    while let Some(way) = moves.take(|movement| movement.pace == Pace::Rapid) {
        level = Some(if way.to.z() < way.from.z() && is_vertical(&way) { way.from.z() } else { way.to.z() });
    }
    let first = moves.take(is_drilling)?;
    let (mut last, mut pecks) = (first, false);
    while let Some(next) = moves.peck(first.from.z()) {
        (last, pecks) = (next, true);
    }
    let dwell = moves.dwell();
    let retract = first.from.z();
    let exit = moves.take(|movement| {
        movement.pace == Pace::Rapid && is_vertical(movement) && movement.to.z() >= retract
    })?;
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
        let Action::Move(movement) = step.action else { return None };
        let is_plain =
            movement.path == Path::Line && movement.named.is_none() && movement.to.known == Axes::ALL;
        (is_plain && is_wanted(&movement)).then(|| {
            self.steps = rest;
            movement
        })
    }

    /// Takes the moves of a peck: out of the hole, back down, and deeper.
    fn peck(&mut self, retract: f64) -> Option<Move> {
        let before = self.steps;
        let is_rapid = |movement: &Move| movement.pace == Pace::Rapid && is_vertical(movement);
        let deeper = self.take(|movement| is_rapid(movement) && movement.to.z() == retract).and_then(|_| {
            self.take(|movement| is_rapid(movement) && movement.to.z() <= retract);
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

fn is_vertical(movement: &Move) -> bool {
    movement.from.at[..2] == movement.to.at[..2]
}

fn is_drilling(movement: &Move) -> bool {
    matches!(movement.pace, Pace::Feed(_))
        && is_vertical(movement)
        && movement.to.z() < movement.from.z()
        && movement.from.known == Axes::ALL
}
