//! How many moves of each kind there are, how long they are and how long they take.

use pathbuild_toolpath::Total;

use crate::interpret::{Move, Pace, Path};

/// Moves by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tally {
    /// G0. Its time is left to whoever knows the machine.
    pub rapid: MoveTotals,
    /// Cutting moves but those straight down.
    pub milling: MoveTotals,
    /// Cutting moves straight down.
    pub drilling: MoveTotals,
    /// Probing moves, as far as they go at the most.
    pub probing: MoveTotals,
    /// How many of all are arcs.
    pub arcs: u64,
}

/// Moves of a kind.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MoveTotals {
    /// How many.
    pub moves: u64,
    /// mm, and minutes of length / feed.
    pub total: Total,
}

impl Tally {
    /// How many moves there are.
    pub fn moves(&self) -> u64 {
        [self.rapid, self.milling, self.drilling, self.probing].iter().map(|kind| kind.moves).sum()
    }

    /// Everything that is not rapid.
    pub fn cutting(&self) -> Total {
        sum([self.milling, self.drilling, self.probing].map(|kind| kind.total))
    }

    /// The whole length and time, with a rapid feed in mm/min.
    pub fn sum(&self, rapid: f64) -> Total {
        let length = self.rapid.total.length;
        sum([self.cutting(), Total { length, time: length / rapid }, Total::default()])
    }

    pub(super) fn add(&mut self, it: &Move) {
        let length = it.length();
        let kind = match it.pace {
            Pace::Rapid => &mut self.rapid,
            Pace::Feed(_) if is_straight_down(it) => &mut self.drilling,
            Pace::Feed(_) => &mut self.milling,
            Pace::Probe { .. } => &mut self.probing,
        };
        kind.moves += 1;
        kind.total.length += length;
        if let Some(feed) = it.pace.feed().filter(|feed| *feed > 0.0) {
            kind.total.time += length / feed;
        }
        self.arcs += u64::from(matches!(it.path, Path::Arc(_)));
    }
}

fn sum(totals: [Total; 3]) -> Total {
    totals.iter().fold(Total::default(), |sum, total| Total {
        length: sum.length + total.length,
        time: sum.time + total.time,
    })
}

fn is_straight_down(it: &Move) -> bool {
    matches!(it.path, Path::Line) && it.from.at[..2] == it.to.at[..2] && it.to.z() < it.from.z()
}
