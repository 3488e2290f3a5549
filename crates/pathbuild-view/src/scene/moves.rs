//! Moves of the tool.

use pathbuild_motion as motion;
use pathbuild_motion::{Axes, Pace, Path};
use serde::{Serialize, Serializer};

use super::Point;
use super::json::rounded;

/// A move of the tool tip.
#[derive(Clone, Debug, PartialEq)]
pub struct Move {
    /// The purpose.
    pub kind: MoveKind,
    /// The geometry: start, end and curve. Arcs and helices are kept.
    pub way: motion::Move,
    /// Its length in mm.
    pub length: f64,
    /// Its element, as an index into [`ScenePath::elements`](super::ScenePath::elements).
    pub element: Option<u32>,
    /// Its line in the G-code.
    pub line: Option<u32>,
}

/// The purpose of a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum MoveKind {
    /// Rapid move in the plane.
    Sweep,
    /// Rapid move straight up or down.
    Lift,
    /// Cut straight down or up.
    Plunge,
    /// Cut along an element.
    Mill,
    /// Cut along an element that is only marked.
    Mark,
    /// Move until the probe triggers.
    Probe,
}

impl Move {
    /// A move about which only its geometry is known.
    pub fn new(way: motion::Move, line: Option<u32>) -> Self {
        Self { kind: MoveKind::of(&way), length: way.length(), way, element: None, line }
    }

    /// Whether its position in the plane is known.
    pub fn is_placed(&self) -> bool {
        self.way.from.known.and(self.way.to.known).has(Axes::XY) && self.way.named.is_none()
    }

    /// The start in the plane.
    pub fn from(&self) -> Point {
        [self.way.from.x(), self.way.from.y()]
    }

    /// The end in the plane.
    pub fn to(&self) -> Point {
        [self.way.to.x(), self.way.to.y()]
    }

    /// Its lowest Z in mm; `None` if the height of neither end is known.
    pub fn depth(&self) -> Option<f64> {
        let ends = [&self.way.from, &self.way.to].into_iter().filter(|end| end.known.has(Axes::Z));
        ends.map(motion::Position::z).reduce(f64::min)
    }

    /// The corners of its bounding box in the plane; `None` if unknown.
    pub fn extent(&self) -> Option<[Point; 2]> {
        let [Some(x), Some(y), _] = self.way.extent() else { return None };
        self.is_placed().then_some([[x.0, y.0], [x.1, y.1]])
    }
}

impl MoveKind {
    fn of(way: &motion::Move) -> Self {
        let is_upright = way.is_upright();
        match way.pace {
            Pace::Probe { .. } => Self::Probe,
            Pace::Rapid if is_upright => Self::Lift,
            Pace::Rapid => Self::Sweep,
            Pace::Feed(_) if is_upright => Self::Plunge,
            Pace::Feed(_) => Self::Mill,
        }
    }

    /// Whether it removes material.
    pub fn cuts(self) -> bool {
        matches!(self, Self::Plunge | Self::Mill | Self::Mark)
    }
}

/// The JSON form of a move.
#[derive(Serialize)]
struct MoveJson {
    kind: MoveKind,
    from: [Option<f64>; 3],
    to: [Option<f64>; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    arc: Option<ArcJson>,
    #[serde(skip_serializing_if = "Option::is_none")]
    feed: Option<f64>,
    length: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    element: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<u32>,
}

/// The JSON form of an arc: the axes of its plane, its centre on these axes, and the angle it covers.
#[derive(Serialize)]
struct ArcJson {
    axes: [usize; 2],
    centre: [f64; 2],
    clockwise: bool,
    degrees: f64,
}

impl Serialize for Move {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let place = |end: &motion::Position| {
            [0, 1, 2].map(|axis| end.known.has(Axes::of(axis)).then(|| rounded(end.at[axis])))
        };
        let motion::Move { from, to, path, pace, .. } = &self.way;
        let arc = match path {
            Path::Line => None,
            Path::Arc(arc) => Some(ArcJson {
                axes: arc.plane.axes(),
                centre: arc.centre.map(rounded),
                clockwise: arc.clockwise,
                degrees: rounded(arc.sweep(from, to).to_degrees()),
            }),
        };
        let written = MoveJson {
            kind: self.kind,
            from: place(from),
            to: place(to),
            arc,
            feed: pace.feed(),
            length: rounded(self.length),
            element: self.element,
            line: self.line,
        };
        written.serialize(serializer)
    }
}
