//! Moves of the tool.

use pathbuild_gcode::interpret::{self, Axes, Pace, Path};
use serde::{Serialize, Serializer};

use super::Point;
use super::json::rounded;

/// A move of the tool's tip.
#[derive(Clone, Debug, PartialEq)]
pub struct Move {
    /// What it is for.
    pub kind: MoveKind,
    /// From where, to where and how. Arcs and helices stay what they are.
    pub way: interpret::Move,
    /// Its length in mm.
    pub length: f64,
    /// The element that it belongs to: index into [`ScenePath::elements`](super::ScenePath::elements).
    pub element: Option<u32>,
    /// Its line in the G-code.
    pub line: Option<u32>,
}

/// What a move is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum MoveKind {
    /// Rapid, in the plane.
    Sweep,
    /// Rapid, up or down only.
    Lift,
    /// Cutting, straight down or up.
    Plunge,
    /// Cutting along an element.
    Mill,
    /// The same along one that is only marked.
    Mark,
    /// Until the probe answers.
    Probe,
}

impl Move {
    /// A move of which nothing is known but what the tool does.
    pub fn new(way: interpret::Move, line: Option<u32>) -> Self {
        Self { kind: MoveKind::of(&way), length: way.length(), way, element: None, line }
    }

    /// Whether it is known where in the plane it leads.
    pub fn is_placed(&self) -> bool {
        self.way.from.known.and(self.way.to.known).has(Axes::XY) && self.way.named.is_none()
    }

    /// Where it begins in the plane.
    pub fn from(&self) -> Point {
        [self.way.from.x(), self.way.from.y()]
    }

    /// Where it ends in the plane.
    pub fn to(&self) -> Point {
        [self.way.to.x(), self.way.to.y()]
    }

    /// Its lowest Z in mm; `None` where no end's is known.
    pub fn depth(&self) -> Option<f64> {
        let ends = [&self.way.from, &self.way.to].into_iter().filter(|end| end.known.has(Axes::Z));
        ends.map(interpret::Position::z).reduce(f64::min)
    }

    /// Its lowest and its highest corner in the plane; `None` where they are not known.
    pub fn extent(&self) -> Option<[Point; 2]> {
        let [Some(x), Some(y), _] = self.way.extent() else { return None };
        self.is_placed().then_some([[x.0, y.0], [x.1, y.1]])
    }
}

impl MoveKind {
    fn of(way: &interpret::Move) -> Self {
        let is_upright = way.is_upright();
        match way.pace {
            Pace::Probe { .. } => Self::Probe,
            Pace::Rapid if is_upright => Self::Lift,
            Pace::Rapid => Self::Sweep,
            Pace::Feed(_) if is_upright => Self::Plunge,
            Pace::Feed(_) => Self::Mill,
        }
    }

    /// Whether it takes material away.
    pub fn cuts(self) -> bool {
        matches!(self, Self::Plunge | Self::Mill | Self::Mark)
    }
}

/// The JSON form of a move.
#[derive(Serialize)]
struct Written {
    kind: MoveKind,
    from: [Option<f64>; 3],
    to: [Option<f64>; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    arc: Option<WrittenArc>,
    #[serde(skip_serializing_if = "Option::is_none")]
    feed: Option<f64>,
    length: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    element: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<u32>,
}

/// The JSON form of an arc: the axes of its plane, its centre in them, and how far it goes round.
#[derive(Serialize)]
struct WrittenArc {
    axes: [usize; 2],
    centre: [f64; 2],
    clockwise: bool,
    degrees: f64,
}

impl Serialize for Move {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let place = |end: &interpret::Position| {
            [0, 1, 2].map(|axis| end.known.has(Axes::of(axis)).then(|| rounded(end.at[axis])))
        };
        let interpret::Move { from, to, path, pace, .. } = &self.way;
        let arc = match path {
            Path::Line => None,
            Path::Arc(arc) => Some(WrittenArc {
                axes: arc.plane.axes(),
                centre: arc.centre.map(rounded),
                clockwise: arc.clockwise,
                degrees: rounded(arc.sweep(from, to).to_degrees()),
            }),
        };
        let written = Written {
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
