//! Lines, arcs and circles in the plane, and the placement of embedded paths.

use nalgebra::{Point2, UnitComplex, Vector2};
use pathbuild_motion::is_full_turn;

use crate::approx::{coincide, grid_square};

/// A point in the plane, in mm.
pub type Xy = Point2<f64>;

/// A straight line from `start` to `end`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "its ends")]
pub struct Line {
    pub start: Xy,
    pub end: Xy,
}

/// A circular arc from `start` to `end`.
///
/// Both ends and angles are stored: the ends determine which curves meet, the angles determine the length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// Centre of the arc's circle.
    pub centre: Xy,
    /// Radius in mm, greater than 0.
    pub radius: f64,
    /// Start of the arc.
    pub start: Xy,
    /// End of the arc.
    pub end: Xy,
    /// Whether the arc runs clockwise from start to end.
    pub clockwise: bool,
    /// The angle covered in that direction in degrees, greater than 0 and at most 360.
    pub degrees: f64,
}

/// The curve of a segment, from its start to its end.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the types say it")]
pub enum Curve {
    Line(Line),
    Arc(Arc),
}

/// The placement of an embedded path in a program: a rotation followed by a translation, without scaling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    turn: UnitComplex<f64>,
    shift: Vector2<f64>,
}

/// Key of the place of a curve, see [`Curve::place_key`].
pub(crate) type PlaceKey = [[i64; 2]; 3];

impl Curve {
    /// Returns the start point.
    pub fn start(&self) -> Xy {
        match self {
            Self::Line(line) => line.start,
            Self::Arc(arc) => arc.start,
        }
    }

    /// Returns the end point.
    pub fn end(&self) -> Xy {
        match self {
            Self::Line(line) => line.end,
            Self::Arc(arc) => arc.end,
        }
    }

    /// The distance between start and end in mm.
    pub fn chord(&self) -> f64 {
        (self.end() - self.start()).norm()
    }

    /// Returns the length along the curve in mm.
    pub fn length(&self) -> f64 {
        match self {
            Self::Line(line) => (line.end - line.start).norm(),
            Self::Arc(arc) => arc.length(),
        }
    }

    /// Returns the curve in the opposite direction.
    pub fn reversed(self) -> Self {
        match self {
            Self::Line(line) => Self::Line(Line { start: line.end, end: line.start }),
            Self::Arc(arc) => {
                Self::Arc(Arc { start: arc.end, end: arc.start, clockwise: !arc.clockwise, ..arc })
            }
        }
    }

    /// Returns the point at a distance in mm along the curve.
    pub(crate) fn at(&self, along: f64) -> Xy {
        match self {
            Self::Line(Line { start, end }) => {
                let length = (end - start).norm();
                if length == 0.0 { *start } else { start + (end - start) * (along / length) }
            }
            Self::Arc(_) => self.section(0.0, along).end(),
        }
    }

    /// Returns the point halfway along the curve.
    pub(crate) fn middle(&self) -> Xy {
        self.at(self.length() / 2.0)
    }

    /// Returns four points of the curve, a quarter of its length apart, beginning at its start.
    pub(crate) fn quarters(&self) -> [Xy; 4] {
        [0.0, 0.25, 0.5, 0.75].map(|share| self.at(share * self.length()))
    }

    /// Returns a key that is equal for curves that lie on each other: both ends, in order of their coordinates, and the point halfway.
    pub(crate) fn place_key(&self) -> PlaceKey {
        let (one, other) = (grid_square(self.start()), grid_square(self.end()));
        [one.min(other), one.max(other), grid_square(self.middle())]
    }

    /// Returns the area in mm² between a point and the curve, positive if the curve runs counterclockwise around the point. The sum over a closed
    /// sequence of curves is its area.
    pub(crate) fn area_from(&self, point: Xy) -> f64 {
        let triangle = (self.start() - point).perp(&(self.end() - point)) / 2.0;
        match self {
            Self::Line(_) => triangle,
            Self::Arc(arc) => {
                let angle = arc.degrees.to_radians();
                let segment = arc.radius * arc.radius * (angle - libm::sin(angle)) / 2.0;
                triangle + if arc.clockwise { -segment } else { segment }
            }
        }
    }

    /// Returns the section between two distances from the start, in mm along the curve. Every section of a line without length is the line itself.
    pub fn section(&self, from: f64, to: f64) -> Self {
        match self {
            Self::Line(line) => {
                let direction = (line.end - line.start).try_normalize(0.0).unwrap_or_default();
                Self::Line(Line { start: line.start + direction * from, end: line.start + direction * to })
            }
            Self::Arc(arc) => Self::Arc(arc.section(from, to)),
        }
    }
}

impl Arc {
    /// Creates an arc from its angles in degrees as drawn. [`is_full_turn`] decides whether it is a full circle.
    pub fn from_angles(centre: Xy, radius: f64, start_angle: f64, end_angle: f64, clockwise: bool) -> Self {
        let ahead = if clockwise { start_angle - end_angle } else { end_angle - start_angle };
        let start = on_circle(centre, radius, start_angle);
        if is_full_turn(ahead.to_radians()) {
            return Self { centre, radius, start, end: start, clockwise, degrees: 360.0 };
        }
        let (end, turns) = (on_circle(centre, radius, end_angle), ahead / 360.0);
        Self { centre, radius, start, end, clockwise, degrees: 360.0 * (turns - turns.floor()) }
    }

    /// Returns the length of the arc in mm.
    pub fn length(&self) -> f64 {
        self.radius * self.degrees.to_radians()
    }

    fn section(&self, from: f64, to: f64) -> Self {
        let at = |along: f64| {
            let angle = (along / self.radius).copysign(if self.clockwise { -1.0 } else { 1.0 });
            let (sin, cos) = libm::sincos(angle);
            self.centre
                + UnitComplex::new_unchecked(nalgebra::Complex::new(cos, sin)) * (self.start - self.centre)
        };
        Self { start: at(from), end: at(to), degrees: ((to - from) / self.radius).to_degrees(), ..*self }
    }
}

impl Placement {
    /// Creates the placement that moves `origin` to (0, 0) without rotation.
    pub fn from_origin(origin: Xy) -> Self {
        Self { turn: UnitComplex::identity(), shift: -origin.coords }
    }

    /// Returns the placement that maps `start` exactly to `onto_start`, and the direction from `start` to `end` to the direction from `onto_start` to
    /// `onto_end`. If a direction is undefined because its points coincide, the rotation is that of the surrounding placement `around`.
    pub fn aligning((start, end): (Xy, Xy), (onto_start, onto_end): (Xy, Xy), around: &Self) -> Self {
        let has_no_direction = coincide(start, end) || coincide(onto_start, onto_end);
        let turn =
            if has_no_direction { around.turn } else { rotation_between(end - start, onto_end - onto_start) };
        Self { turn, shift: onto_start.coords - turn * start.coords }
    }

    /// Applies the placement to a point.
    pub fn place(&self, point: Xy) -> Xy {
        self.turn * point + self.shift
    }

    /// Returns the placement of a helical circle with this centre, which moves with its path but does not turn: the cutter begins at the point with
    /// the least Y in the program.
    pub fn of_circle(&self, centre: Xy) -> Self {
        Self { turn: UnitComplex::identity(), shift: self.place(centre) - centre }
    }

    /// Whether the placement turns a path.
    pub fn is_turned(&self) -> bool {
        self.turn.re < 0.0 || self.turn.im.abs() > MIN_TURN
    }

    /// Returns the point that the placement moves to this one.
    pub fn unplace(&self, placed: Xy) -> Xy {
        self.turn.inverse() * (placed - self.shift)
    }

    /// Applies the placement to a curve.
    pub fn place_curve(&self, curve: &Curve) -> Curve {
        match curve {
            Curve::Line(line) => {
                Curve::Line(Line { start: self.place(line.start), end: self.place(line.end) })
            }
            Curve::Arc(arc) => Curve::Arc(Arc {
                centre: self.place(arc.centre),
                start: self.place(arc.start),
                end: self.place(arc.end),
                ..*arc
            }),
        }
    }
}

/// Angle in radians above which a path counts as turned. A smaller one changes no digit of a program.
const MIN_TURN: f64 = 1e-8;

/// Returns the point of a circle at an angle in degrees. Quarter turns are exact, so that points drawn at 90 degrees stay there.
pub(crate) fn on_circle(centre: Xy, radius: f64, degrees: f64) -> Xy {
    centre + direction(degrees) * radius
}

/// Returns the unit vector at an angle in degrees, exact at quarter turns.
pub fn direction(degrees: f64) -> Vector2<f64> {
    if degrees == 0.0 {
        return Vector2::new(1.0, 0.0);
    }
    let turn = degrees - 360.0 * (degrees / 360.0).floor();
    match turn {
        0.0 => Vector2::new(1.0, 0.0),
        90.0 => Vector2::new(0.0, 1.0),
        180.0 => Vector2::new(-1.0, 0.0),
        270.0 => Vector2::new(0.0, -1.0),
        _ => {
            let (sin, cos) = libm::sincos(turn.to_radians());
            Vector2::new(cos, sin)
        }
    }
}

/// Returns the rotation from one direction to another, neither of which is 0. Computed from products and a square root, since angles would lose
/// precision.
fn rotation_between(from: Vector2<f64>, to: Vector2<f64>) -> UnitComplex<f64> {
    let along = from.dot(&to);
    let across = from.perp(&to);
    let norm = libm::sqrt(along * along + across * across);
    UnitComplex::new_unchecked(nalgebra::Complex::new(along / norm, across / norm))
}

impl Curve {
    /// Returns the distance in mm between two curves; 0 if they cross or touch.
    pub fn distance(&self, other: &Self) -> f64 {
        if self.crosses(other) {
            return 0.0;
        }
        let to_other = [self.start(), self.end()].into_iter().chain(self.nearest_candidates(other));
        let to_self = [other.start(), other.end()].into_iter().chain(other.nearest_candidates(self));
        let to_other = to_other.map(|point| other.distance_to(point));
        to_other.chain(to_self.map(|point| self.distance_to(point))).fold(f64::INFINITY, f64::min)
    }

    /// Returns the distance in mm between a point and the curve.
    pub fn distance_to(&self, point: Xy) -> f64 {
        match self {
            Self::Line(line) => (line.nearest(point) - point).norm(),
            Self::Arc(arc) => arc.distance_to(point),
        }
    }

    /// Returns the point of the curve that is nearest to a point.
    pub(crate) fn nearest(&self, point: Xy) -> Xy {
        match self {
            Self::Line(line) => line.nearest(point),
            Self::Arc(arc) => arc.nearest(point),
        }
    }

    /// Returns the interior points of this curve that may be nearest to `other`. Empty if `other` is a line: the ends of both curves and the
    /// candidates on `other` then suffice.
    fn nearest_candidates(&self, other: &Self) -> Vec<Xy> {
        match (self, other) {
            (Self::Line(line), Self::Arc(arc)) => vec![line.nearest(arc.centre)],
            (Self::Arc(arc), Self::Arc(other)) => arc.on_line_through(other.centre),
            (_, Self::Line(_)) => Vec::new(),
        }
    }

    fn crosses(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Line(one), Self::Line(other)) => one.crosses(other),
            (Self::Line(line), Self::Arc(arc)) | (Self::Arc(arc), Self::Line(line)) => arc.crosses_line(line),
            (Self::Arc(one), Self::Arc(other)) => one.crosses(other),
        }
    }
}

/// Distance in mm from a line up to which a point is considered to be on the line. Rotating coordinates rounds them by less.
const ON_LINE_DISTANCE: f64 = 1e-9;

impl Line {
    pub(crate) fn nearest(&self, point: Xy) -> Xy {
        let along = self.end - self.start;
        let squared = along.norm_squared();
        if squared == 0.0 {
            return self.start;
        }
        self.start + along * (along.dot(&(point - self.start)) / squared).clamp(0.0, 1.0)
    }

    /// Whether two lines cross: the ends of each are on opposite sides of the other. Lines that only touch, with an end of one on the other, do not
    /// cross. Nor does a line cross its own continuation, however the ends are rounded.
    pub(crate) fn crosses(&self, other: &Self) -> bool {
        let divides = |one: &Self, other: &Self| {
            let along = one.end - one.start;
            let length = along.norm();
            let aside = |point: Xy| along.perp(&(point - one.start)) / length;
            let (start, end) = (aside(other.start), aside(other.end));
            start.min(end) < -ON_LINE_DISTANCE && start.max(end) > ON_LINE_DISTANCE
        };
        divides(self, other) && divides(other, self)
    }
}

impl Arc {
    fn distance_to(&self, point: Xy) -> f64 {
        let out = point - self.centre;
        if out != Vector2::zeros() && self.spans(out) {
            return (out.norm() - self.radius).abs();
        }
        (point - self.start).norm().min((point - self.end).norm())
    }

    fn nearest(&self, point: Xy) -> Xy {
        let out = point - self.centre;
        match out.try_normalize(0.0) {
            Some(direction) if self.spans(out) => self.centre + direction * self.radius,
            _ if (point - self.start).norm() <= (point - self.end).norm() => self.start,
            _ => self.end,
        }
    }

    /// Whether the arc contains the point of its circle that lies in the direction `out` from the centre.
    pub(crate) fn spans(&self, out: Vector2<f64>) -> bool {
        let from = self.start - self.centre;
        let angle = libm::atan2(from.perp(&out), from.dot(&out)).to_degrees();
        let ahead = if self.clockwise { -angle } else { angle };
        (if ahead < 0.0 { ahead + 360.0 } else { ahead }) <= self.degrees
    }

    /// Returns the points of the arc on the line through its centre and another point.
    fn on_line_through(&self, other: Xy) -> Vec<Xy> {
        let way = other - self.centre;
        let Some(out) = way.try_normalize(0.0) else { return Vec::new() };
        let points = [out, -out].into_iter().filter(|out| self.spans(*out));
        points.map(|out| self.centre + out * self.radius).collect()
    }

    fn crosses_line(&self, line: &Line) -> bool {
        let along = line.end - line.start;
        let squared = along.norm_squared();
        if squared == 0.0 {
            return false;
        }
        let out = line.start - self.centre;
        let foot = -along.dot(&out) / squared;
        let upright = (out + along * foot).norm_squared();
        let half = self.radius * self.radius - upright;
        if half < 0.0 {
            return false;
        }
        let half = libm::sqrt(half / squared);
        let is_on_both = |at: f64| (0.0..=1.0).contains(&at) && self.spans(out + along * at);
        is_on_both(foot - half) || is_on_both(foot + half)
    }

    fn crosses(&self, other: &Self) -> bool {
        let way = other.centre - self.centre;
        let squared = way.norm_squared();
        if squared == 0.0 {
            return false;
        }
        // The line through the crossings of the circles meets the line between the centres at this fraction of the distance between the centres.
        let along = (squared + self.radius * self.radius - other.radius * other.radius) / (2.0 * squared);
        let half = self.radius * self.radius / squared - along * along;
        if half < 0.0 {
            return false;
        }
        let across = Vector2::new(-way.y, way.x) * libm::sqrt(half);
        [across, -across].into_iter().any(|across| {
            let out = way * along + across;
            self.spans(out) && other.spans(out - way)
        })
    }
}
