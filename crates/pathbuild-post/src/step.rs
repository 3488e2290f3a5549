//! The moves of an operation. Lengths are millimetres, feeds mm/min.

use pathbuild_motion::{Move, Pace, Path, Position};

/// One thing that the machine does.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// The tool moves. Where a straight move begins is where the step before it ended: `from` counts for arcs only.
    Move(Move),
    /// A hole, however it is drilled.
    Hole(Hole),
    /// Standing still.
    Dwell {
        /// For how long.
        seconds: f64,
    },
    /// Waiting for whoever stands at the machine.
    Stop,
    /// A remark for whoever stands at the machine.
    Comment(Box<str>),
}

/// A drilled hole: from wherever the tool is, over it, down, and up again to `exit`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hole {
    /// X and Y in mm.
    pub at: [f64; 2],
    /// The height from which the tool comes, at which it also goes from hole to hole, mm.
    pub level: f64,
    /// The height down to which it goes by rapid, mm.
    pub retract: f64,
    /// Z of the bottom, mm.
    pub bottom: f64,
    /// The height to which it is lifted afterwards, mm.
    pub exit: f64,
    /// mm/min.
    pub feed: Option<f64>,
    /// How the bottom is reached.
    pub kind: HoleKind,
}

/// How a hole is drilled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HoleKind {
    /// In one go.
    Plain,
    /// In one go, then waiting there.
    Dwell {
        /// For how long.
        seconds: f64,
    },
    /// Lifting the tool out of the hole again and again.
    Peck {
        /// Depth of one go, mm, greater than 0.
        depth: f64,
    },
}

impl Step {
    /// Straight, as fast as the machine can.
    pub fn rapid(to: impl Into<Position>) -> Self {
        Self::straight(to, Pace::Rapid)
    }

    /// Straight, cutting. `feed` is `None` where a program that was read says none.
    pub fn feed(to: impl Into<Position>, feed: Option<f64>) -> Self {
        Self::straight(to, Pace::Feed(feed.unwrap_or_default()))
    }

    /// Straight until the probe closes.
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
            Self::Move(it) if matches!(it.pace, Pace::Feed(_)) => Some(it),
            _ => None,
        }
    }

    /// The feed in mm/min that it states.
    pub(super) fn stated_feed(&self) -> Option<f64> {
        match self {
            Self::Move(it) => it.pace.stated_feed(),
            Self::Hole(hole) => hole.feed,
            Self::Dwell { .. } | Self::Stop | Self::Comment(_) => None,
        }
    }

    /// Whether every number in it is finite.
    pub(super) fn is_finite(&self) -> bool {
        match self {
            Self::Move(it) => it.is_finite(),
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
