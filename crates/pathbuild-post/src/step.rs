//! The moves of an operation. Lengths are in millimetres, feeds in mm/min.

use pathbuild_motion::{Move, Pace, Path, Position};

/// An action of the machine.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// A move of the tool. A straight move begins where the previous step ended; its `from` is ignored.
    Move(Move),
    /// A hole, regardless of how it is drilled.
    Hole(Hole),
    /// A dwell.
    Dwell {
        /// Duration.
        seconds: f64,
    },
    /// Waits for the operator.
    Stop,
    /// A comment for the operator.
    Comment(Box<str>),
}

/// A drilled hole. The tool moves to its position, down, and up again to `exit`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hole {
    /// X and Y in mm.
    pub at: [f64; 2],
    /// Height in mm from which the tool descends, and at which it moves between holes.
    pub level: f64,
    /// Height down to which the tool moves by rapid, in mm.
    pub retract: f64,
    /// Z of the bottom, in mm.
    pub bottom: f64,
    /// Height to which the tool is retracted afterwards, in mm.
    pub exit: f64,
    /// In mm/min.
    pub feed: Option<f64>,
    /// How the bottom is reached.
    pub kind: HoleKind,
}

/// How a hole is drilled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HoleKind {
    /// In one go.
    Plain,
    /// In one go, followed by a dwell at the bottom.
    Dwell {
        /// Duration.
        seconds: f64,
    },
    /// In several pecks, with the tool retracted from the hole after each.
    Peck {
        /// Depth of a peck in mm, greater than 0.
        depth: f64,
    },
}

impl Step {
    /// A straight move at full speed.
    pub fn rapid(to: impl Into<Position>) -> Self {
        Self::straight(to, Pace::Rapid)
    }

    /// A straight cut. `feed` is `None` if the parsed program does not specify it.
    pub fn feed(to: impl Into<Position>, feed: Option<f64>) -> Self {
        Self::straight(to, Pace::Feed(feed.unwrap_or_default()))
    }

    /// A straight move until the probe makes contact.
    pub fn probe(to: impl Into<Position>, feed: Option<f64>) -> Self {
        Self::straight(to, Pace::Probe { feed: feed.unwrap_or_default(), toward: true, must_answer: true })
    }

    fn straight(to: impl Into<Position>, pace: Pace) -> Self {
        let from = Position::default();
        Self::Move(Move { from, to: to.into(), path: Path::Line, pace, named: None })
    }

    /// The move, if it cuts.
    pub(super) fn as_cut(&self) -> Option<&Move> {
        match self {
            Self::Move(movement) if matches!(movement.pace, Pace::Feed(_)) => Some(movement),
            _ => None,
        }
    }

    /// The feed in mm/min, if the step specifies one.
    pub(super) fn stated_feed(&self) -> Option<f64> {
        match self {
            Self::Move(movement) => movement.pace.stated_feed(),
            Self::Hole(hole) => hole.feed,
            Self::Dwell { .. } | Self::Stop | Self::Comment(_) => None,
        }
    }

    /// Whether all its numbers are finite.
    pub(super) fn is_finite(&self) -> bool {
        match self {
            Self::Move(movement) => movement.is_finite(),
            Self::Hole(hole) => hole.is_finite(),
            Self::Dwell { seconds } => seconds.is_finite(),
            Self::Stop | Self::Comment(_) => true,
        }
    }
}

impl Hole {
    fn is_finite(&self) -> bool {
        let kind = match self.kind {
            HoleKind::Plain => 0.0,
            HoleKind::Dwell { seconds: number } | HoleKind::Peck { depth: number } => number,
        };
        let numbers = [self.at[0], self.at[1], self.level, self.retract, self.bottom, self.exit, kind];
        numbers.into_iter().chain(self.feed).all(f64::is_finite)
    }
}
