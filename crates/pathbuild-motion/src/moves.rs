//! Moves of the tool tip.

use pathbuild_diagnostic::Text;

use crate::arc::{Arc, Course};
use crate::position::{Axes, Plane, Position};

/// A move of the tool tip.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the types say it")]
pub struct Move {
    pub from: Position,
    pub to: Position,
    pub path: Path,
    pub pace: Pace,
    /// The named target of the move, if the program specifies it by name.
    pub named: Option<Named>,
}

/// The shape of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the types say it")]
pub enum Path {
    Line,
    Arc(Arc),
}

/// Speed and purpose of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// At full speed.
    Rapid,
    /// Cutting, with the feed in mm/min; 0 if the program does not specify it, which is reported.
    Feed(f64),
    /// Until the probe makes contact, at most to the end.
    Probe {
        /// In mm/min.
        feed: f64,
        /// Towards the material instead of away from it.
        toward: bool,
        /// Whether a missing contact is an alarm.
        must_answer: bool,
    },
}

impl Pace {
    /// The feed in mm/min, unless it is a rapid.
    pub fn feed(self) -> Option<f64> {
        match self {
            Self::Rapid => None,
            Self::Feed(feed) | Self::Probe { feed, .. } => Some(feed),
        }
    }

    /// The feed in mm/min specified by the program.
    pub fn stated_feed(self) -> Option<f64> {
        self.feed().filter(|feed| *feed > 0.0)
    }

    /// Sets the feed in mm/min, unless the move has one.
    pub fn set_missing_feed(&mut self, missing: f64) {
        match self {
            Self::Feed(feed) | Self::Probe { feed, .. } if *feed == 0.0 => *feed = missing,
            _ => {}
        }
    }

    /// The name of such a move in messages.
    pub fn word(self) -> &'static Text {
        match self {
            Self::Rapid => &Text { en: "a rapid move", de: "ein Eilgang" },
            Self::Feed(_) => &Text { en: "a cutting move", de: "eine Fräsbewegung" },
            Self::Probe { .. } => &Text { en: "a probing move", de: "eine Antastbewegung" },
        }
    }
}

/// Positions that a program specifies by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Named {
    /// G53: machine coordinates. If the machine's origin is unknown, unknown axes contain machine coordinates.
    Machine,
    /// G28.
    Home1,
    /// G30.
    Home2,
}

impl Move {
    /// Length in space, in mm. Axes that are unknown at either end are ignored.
    pub fn length(&self) -> f64 {
        let known = self.from.known.and(self.to.known);
        let step =
            |axis: usize| if known.has(Axes::of(axis)) { self.to.at[axis] - self.from.at[axis] } else { 0.0 };
        match self.path {
            Path::Arc(arc) if known.has(arc.plane.axes_of_plane()) => {
                libm::hypot(Course::new(arc, &self.from, &self.to).length_in_plane(), step(arc.plane.third()))
            }
            _ => libm::hypot(libm::hypot(step(0), step(1)), step(2)),
        }
    }

    /// Whether the move is vertical: its length in the plane XY is below 0.0005 mm, less than a program with three decimals can express.
    pub fn is_upright(&self) -> bool {
        let in_plane = match self.path {
            Path::Arc(arc) if arc.plane == Plane::Xy => {
                Course::new(arc, &self.from, &self.to).length_in_plane()
            }
            Path::Arc(_) => return false,
            Path::Line => libm::hypot(self.to.x() - self.from.x(), self.to.y() - self.from.y()),
        };
        self.from.known.and(self.to.known).has(Axes::XY) && in_plane < 0.0005
    }

    /// Bounding box, as least and greatest coordinates. Unknown ends are ignored; an axis without known ends is `None`.
    pub fn extent(&self) -> [Option<(f64, f64)>; 3] {
        let mut extent = [0, 1, 2].map(|axis| {
            let known = |end: &Position| end.known.has(Axes::of(axis)).then(|| end.at[axis]);
            match (known(&self.from), known(&self.to)) {
                (Some(from), Some(to)) => Some((from.min(to), from.max(to))),
                (from, to) => from.or(to).map(|at| (at, at)),
            }
        });
        if let Path::Arc(arc) = self.path {
            arc.widen(&self.from, &self.to, &mut extent);
        }
        extent
    }

    /// Maximum share of each axis in the speed of the move, from 0 to 1.
    pub fn axis_shares(&self) -> [f64; 3] {
        let length = self.length();
        if length == 0.0 {
            return [0.0; 3];
        }
        let known = self.from.known.and(self.to.known);
        let mut shares = [0, 1, 2].map(|axis| {
            let way = if known.has(Axes::of(axis)) { self.to.at[axis] - self.from.at[axis] } else { 0.0 };
            libm::fabs(way) / length
        });
        if let Path::Arc(arc) = self.path {
            // At some point an arc is parallel, or almost parallel, to each axis of its plane.
            let across = shares[arc.plane.third()];
            for axis in arc.plane.axes() {
                shares[axis] = libm::sqrt((1.0 - across * across).max(0.0));
            }
        }
        shares
    }

    /// Whether all its numbers are finite.
    pub fn is_finite(&self) -> bool {
        let centre = match self.path {
            Path::Line => [0.0; 2],
            Path::Arc(arc) => arc.centre,
        };
        let places = self.from.at.into_iter().chain(self.to.at);
        places.chain(centre).chain(self.pace.feed()).all(f64::is_finite)
    }

    /// Whether it does not move.
    pub fn is_nothing(&self) -> bool {
        matches!(self.path, Path::Line) && self.from == self.to
    }

    /// Its arc, if it is one.
    pub fn course(&self) -> Option<Course> {
        match self.path {
            Path::Line => None,
            Path::Arc(arc) => Some(Course::new(arc, &self.from, &self.to)),
        }
    }

    /// The position at a fraction (0 to 1) of the move.
    pub fn point(&self, share: f64) -> [f64; 3] {
        let (from, to) = (&self.from.at, &self.to.at);
        match self.path {
            _ if share >= 1.0 => *to,
            Path::Line => std::array::from_fn(|axis| from[axis] + share * (to[axis] - from[axis])),
            Path::Arc(arc) => Course::new(arc, &self.from, &self.to).point(share),
        }
    }

    /// Splits it into equal parts. The last one ends exactly at the end of the move.
    pub fn split(&self, count: u32) -> impl Iterator<Item = Self> + use<> {
        let (movement, course) = (*self, self.course());
        let mut from = movement.from;
        (1..=count).map(move |number| {
            let share = f64::from(number) / f64::from(count);
            let at = course
                .filter(|_| number < count)
                .map_or_else(|| movement.point(share), |movement| movement.point(share));
            let piece = Self { from, to: Position { at, ..movement.to }, ..movement };
            from = piece.to;
            piece
        })
    }
}
