//! Lengths and extents of moves.

use std::f64::consts::{PI, TAU};

use super::codes::Plane;
use super::step::{Arc, Axes, Move, Path, Position};

/// Ends of an arc whose directions from the centre differ by less (in radians) are one direction: it is a full circle.
const SAME_DIRECTION: f64 = 5e-7;

impl Move {
    /// Its length in space, in mm. An axis of which one end is not known adds nothing.
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

    /// Whether it goes straight up or down: its length in the plane XY is below 0.0005 mm, which no program of three decimals can say.
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

    /// The smallest box that it stays in, as lowest and highest coordinates; unknown ends are left out, and an axis with none known
    /// is `None`.
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

    /// The most that each axis gets of the move's speed, from 0 to 1.
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
            // Somewhere on its way an arc points along each axis of its plane, or nearly so.
            let across = shares[arc.plane.third()];
            for axis in arc.plane.axes() {
                shares[axis] = libm::sqrt((1.0 - across * across).max(0.0));
            }
        }
        shares
    }

    /// Whether it goes nowhere.
    pub fn is_nothing(&self) -> bool {
        matches!(self.path, Path::Line) && self.from == self.to
    }
}

impl Plane {
    /// The indices of the plane's first and second axis; turning the first to the second is counterclockwise.
    pub fn axes(self) -> [usize; 2] {
        match self {
            Self::Xy => [0, 1],
            Self::Zx => [2, 0],
            Self::Yz => [1, 2],
        }
    }

    /// The index of the axis across.
    pub fn third(self) -> usize {
        match self {
            Self::Xy => 2,
            Self::Zx => 1,
            Self::Yz => 0,
        }
    }

    pub(crate) fn axes_of_plane(self) -> Axes {
        Axes::ALL.without(Axes::of(self.third()))
    }

    pub(crate) fn project(self, at: &[f64; 3]) -> [f64; 2] {
        self.axes().map(|axis| at[axis])
    }
}

/// An arc between two places, taken apart once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Course {
    arc: Arc,
    from: [f64; 3],
    to: [f64; 3],
    sweep: f64,
    /// The radius at its beginning, and how much it grows on the way, as a share of that.
    radius: f64,
    growth: f64,
}

impl Course {
    /// That of an arc between places that are known in its plane.
    pub(crate) fn new(arc: Arc, from: &Position, to: &Position) -> Self {
        let (radius, end) = (arc.radius(from), arc.radius(to));
        let growth = if radius > 0.0 { end / radius - 1.0 } else { 0.0 };
        Self { arc, from: from.at, to: to.at, sweep: arc.sweep(from, to), radius, growth }
    }

    /// Its length in space, in mm.
    pub(crate) fn length(&self) -> f64 {
        let third = self.arc.plane.third();
        libm::hypot(self.length_in_plane(), self.to[third] - self.from[third])
    }

    fn length_in_plane(&self) -> f64 {
        self.radius * self.sweep
    }

    /// The place that a share (0 to 1) of the way leads to.
    fn point(&self, share: f64) -> [f64; 3] {
        self.place(turned(self.arc.spoke(&self.from), self.turn(share)), share)
    }

    /// The places a quarter, half and three quarters of the way along, turned on from one to the next.
    pub(crate) fn quarters(&self) -> [[f64; 3]; 3] {
        let quarter = self.turn(0.25);
        let mut spoke = self.arc.spoke(&self.from);
        [0.25, 0.5, 0.75].map(|share| {
            spoke = turned(spoke, quarter);
            self.place(spoke, share)
        })
    }

    /// The sine and cosine of the angle that a share of the way turns by.
    fn turn(&self, share: f64) -> (f64, f64) {
        let angle = self.sweep * share;
        libm::sincos(if self.arc.clockwise { -angle } else { angle })
    }

    /// The place at the end of a spoke of the first radius that was turned by a share of the way.
    fn place(&self, [a, b]: [f64; 2], share: f64) -> [f64; 3] {
        let stretch = 1.0 + share * self.growth;
        let [first, second] = self.arc.plane.axes();
        let third = self.arc.plane.third();
        let mut at = [0.0; 3];
        at[first] = self.arc.centre[0] + a * stretch;
        at[second] = self.arc.centre[1] + b * stretch;
        at[third] = self.from[third] + share * (self.to[third] - self.from[third]);
        at
    }
}

fn turned([a, b]: [f64; 2], (sin, cos): (f64, f64)) -> [f64; 2] {
    [a * cos - b * sin, a * sin + b * cos]
}

impl Arc {
    /// The radius at a place, in mm.
    pub fn radius(&self, end: &Position) -> f64 {
        let [a, b] = self.spoke(&end.at);
        libm::hypot(a, b)
    }

    /// The angle that it goes through, in radians, extra turns included; never negative.
    pub fn sweep(&self, from: &Position, to: &Position) -> f64 {
        let ([a, b], [c, d]) = (self.spoke(&from.at), self.spoke(&to.at));
        let counterclockwise = libm::atan2(a * d - b * c, a * c + b * d);
        let sweep = if self.clockwise { -counterclockwise } else { counterclockwise };
        let sweep = if sweep <= SAME_DIRECTION { sweep + TAU } else { sweep };
        sweep + TAU * f64::from(self.extra_turns)
    }

    /// The place that a share (0 to 1) of the way from `from` to `to` leads to.
    pub fn point(&self, from: &Position, to: &Position, share: f64) -> [f64; 3] {
        Course::new(*self, from, to).point(share)
    }

    /// The direction of travel in the plane at one of its ends, as a unit vector in the plane's axes.
    pub fn tangent(&self, at: &[f64; 3]) -> [f64; 2] {
        let [a, b] = self.spoke(at);
        let radius = libm::hypot(a, b);
        if radius == 0.0 {
            return [0.0, 0.0];
        }
        if self.clockwise { [b / radius, -a / radius] } else { [-b / radius, a / radius] }
    }

    fn spoke(&self, at: &[f64; 3]) -> [f64; 2] {
        let [a, b] = self.plane.project(at);
        [a - self.centre[0], b - self.centre[1]]
    }

    /// Adds the outermost points of the circle that the arc comes through.
    fn widen(&self, from: &Position, to: &Position, extent: &mut [Option<(f64, f64)>; 3]) {
        if !from.known.and(to.known).has(self.plane.axes_of_plane()) {
            return;
        }
        let [a, b] = self.spoke(&from.at);
        let (radius, sweep) = (libm::hypot(a, b), self.sweep(from, to));
        let start = libm::atan2(b, a);
        for (quarter, (slot, sign)) in [(0, 1.0), (1, 1.0), (0, -1.0), (1, -1.0)].into_iter().enumerate() {
            let outermost = quarter as f64 * PI / 2.0;
            let way = if self.clockwise { start - outermost } else { outermost - start };
            let way = way - TAU * libm::floor(way / TAU);
            if way <= sweep {
                let at = self.centre[slot] + sign * radius;
                let axis = &mut extent[self.plane.axes()[slot]];
                *axis = axis.map(|(low, high)| (low.min(at), high.max(at)));
            }
        }
    }
}
