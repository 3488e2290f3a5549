//! Lengths and times of a program, calculated from its own moves. (book: program/gcode)

use pathbuild_motion::{Action, Axes, Move, MoveShape, Pace, Step};
use pathbuild_toolpath::{Program, Statistics, Total};

/// The statistics of a program with a rapid feed in mm/min, calculated from its moves. A compatible program has those of the original tool.
pub fn statistics(program: &Program, rapid: f64) -> Statistics {
    if program.compatible {
        return Statistics::of_reference(program, rapid);
    }
    let mut tally = Tally::default();
    for (_, it) in program.moves() {
        tally.add(&it, true);
    }
    Statistics {
        milling: tally.milling.total,
        drilling: tally.drilling.total,
        sweeps: tally.sweeps(rapid),
        commands: tally.moves(),
    }
}

/// Decides which moves of a parsed program have a length: those between positions that are completely known and that the program has
/// specified
/// since the last tool change.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Counting {
    /// The axes specified before the current step.
    stated: Axes,
}

impl Counting {
    /// Whether the length of the next step counts. It must be called for every step.
    pub(crate) fn counts(&mut self, step: &Step) -> bool {
        let stated = std::mem::replace(&mut self.stated, step.stated);
        match &step.action {
            Action::Move(it) => {
                [stated, step.stated, it.from.known, it.to.known].iter().all(|axes| axes.has(Axes::ALL))
            }
            _ => false,
        }
    }
}

/// Totals by kind of move.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tally {
    /// Rapid moves. Their time depends on the rapid feed of the machine.
    pub rapid: MoveTotals,
    /// Cutting moves other than drilling.
    pub milling: MoveTotals,
    /// Straight cutting moves up or down.
    pub drilling: MoveTotals,
    /// Number of probing moves. They have no length, because it is not known in advance how far they go.
    pub probing: u64,
    /// Number of arcs among all moves.
    pub arcs: u64,
}

/// The totals of one kind of move.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MoveTotals {
    /// Number of moves, including those of unknown length.
    pub moves: u64,
    /// Length in mm, and length / feed in minutes, which is infinite if some feed is unknown.
    pub total: Total,
}

impl Tally {
    /// Number of moves.
    pub fn moves(&self) -> u64 {
        [self.rapid, self.milling, self.drilling].iter().map(|kind| kind.moves).sum::<u64>() + self.probing
    }

    /// Length and time of milling and drilling.
    pub fn cutting(&self) -> Total {
        self.milling.total + self.drilling.total
    }

    /// Length and time of all moves, with a rapid feed in mm/min.
    pub fn sum(&self, rapid: f64) -> Total {
        self.cutting() + self.sweeps(rapid)
    }

    fn sweeps(&self, rapid: f64) -> Total {
        let length = self.rapid.total.length;
        // Without length there is no time either, whatever the feed.
        Total { length, time: if length > 0.0 { length / rapid } else { 0.0 } }
    }

    /// Adds a move. `has_length` tells whether its length is known and counts.
    pub(crate) fn add(&mut self, it: &Move, has_length: bool) {
        self.arcs += u64::from(matches!(it.shape, MoveShape::Arc(_)));
        let kind = match it.pace {
            Pace::Probe { .. } => {
                self.probing += 1;
                return;
            }
            Pace::Rapid => &mut self.rapid,
            Pace::Feed(_) if it.is_upright() => &mut self.drilling,
            Pace::Feed(_) => &mut self.milling,
        };
        kind.moves += 1;
        if has_length {
            let length = it.length();
            kind.total.length += length;
            if let Some(feed) = it.pace.feed()
                && length > 0.0
            {
                kind.total.time += if feed > 0.0 { length / feed } else { f64::INFINITY };
            }
        }
    }
}
