//! The moves of an operation. Lengths are millimetres, feeds mm/min.

/// Absolute coordinates in mm. Those that are not known, because nobody has said them yet, are `None`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[expect(missing_docs, reason = "coordinates")]
pub struct Position {
    pub x: Option<f64>,
    pub y: Option<f64>,
    pub z: Option<f64>,
}

impl Position {
    /// X, Y, Z.
    pub fn axes(self) -> [Option<f64>; 3] {
        [self.x, self.y, self.z]
    }
}

impl From<[f64; 3]> for Position {
    fn from([x, y, z]: [f64; 3]) -> Self {
        Self { x: Some(x), y: Some(y), z: Some(z) }
    }
}

impl From<[Option<f64>; 3]> for Position {
    fn from([x, y, z]: [Option<f64>; 3]) -> Self {
        Self { x, y, z }
    }
}

/// One thing that the machine does.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// As fast as the machine can.
    Rapid {
        /// Where to.
        to: Position,
    },
    /// Straight, cutting.
    Feed {
        /// Where to.
        to: Position,
        /// mm/min; `None` when the program that was read never said.
        feed: Option<f64>,
    },
    /// Along a circle or helix.
    Arc(Arc),
    /// A hole, however it is drilled.
    Hole(Hole),
    /// Standing still.
    Dwell {
        /// For how long.
        seconds: f64,
    },
    /// Straight until the probe closes.
    Probe {
        /// Where to at the furthest.
        to: Position,
        /// mm/min.
        feed: Option<f64>,
    },
    /// Waiting for whoever stands at the machine.
    Stop,
    /// A remark for whoever stands at the machine.
    Comment(Box<str>),
}

/// A circular move in the operation's plane, or a helix across it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// Seen from the positive end of the axis across the plane.
    pub clockwise: bool,
    /// Where it begins: where the tool is.
    pub from: [f64; 3],
    /// Absolute; the coordinate across the plane means nothing.
    pub centre: [f64; 3],
    /// Where it ends. The same point of the plane as `from` is a full circle.
    pub to: [f64; 3],
    /// mm/min; `None` when the program that was read never said.
    pub feed: Option<f64>,
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
    /// The feed in mm/min that it says.
    pub(super) fn feed(&self) -> Option<f64> {
        match self {
            Self::Feed { feed, .. } | Self::Probe { feed, .. } => *feed,
            Self::Arc(arc) => arc.feed,
            Self::Hole(hole) => hole.feed,
            Self::Rapid { .. } | Self::Dwell { .. } | Self::Stop | Self::Comment(_) => None,
        }
    }

    /// Whether every number in it is one.
    pub(super) fn is_finite(&self) -> bool {
        let position = |to: &Position| to.axes().into_iter().flatten().all(f64::is_finite);
        let all = |numbers: &[f64]| numbers.iter().all(|number| number.is_finite());
        let feed = |feed: &Option<f64>| feed.is_none_or(f64::is_finite);
        match self {
            Self::Rapid { to } => position(to),
            Self::Feed { to, feed: f } | Self::Probe { to, feed: f } => position(to) && feed(f),
            Self::Arc(arc) => all(&arc.from) && all(&arc.centre) && all(&arc.to) && feed(&arc.feed),
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
