//! Positions, sets of axes, planes, and arcs.

use std::f64::consts::{PI, TAU};

/// A position in the program's first coordinate system, in mm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Position {
    /// X, Y and Z in mm. The value of an axis that is not in `known` is not a coordinate of this system.
    pub at: [f64; 3],
    /// The axes with a known coordinate. All are unknown at the start of the program; some become unknown through a move to a named position or
    /// a probing move.
    pub known: Axes,
}

impl Position {
    /// Creates a position with all axes known.
    pub fn known(x: f64, y: f64, z: f64) -> Self {
        Self { at: [x, y, z], known: Axes::ALL }
    }

    /// X, Y and Z; `None` for unknown axes.
    pub fn axes(&self) -> [Option<f64>; 3] {
        [0, 1, 2].map(|axis| self.known.has(Axes::of(axis)).then(|| self.at[axis]))
    }

    /// X in mm.
    pub fn x(&self) -> f64 {
        self.at[0]
    }

    /// Y in mm.
    pub fn y(&self) -> f64 {
        self.at[1]
    }

    /// Z in mm.
    pub fn z(&self) -> f64 {
        self.at[2]
    }
}

impl From<[Option<f64>; 3]> for Position {
    fn from(axes: [Option<f64>; 3]) -> Self {
        let known = (0..3).filter(|axis| axes[*axis].is_some());
        Self {
            at: axes.map(Option::unwrap_or_default),
            known: known.fold(Axes::NONE, |known, axis| known.with(Axes::of(axis))),
        }
    }
}

impl From<[f64; 3]> for Position {
    fn from(at: [f64; 3]) -> Self {
        Self { at, known: Axes::ALL }
    }
}

/// A set of the axes X, Y, Z.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Axes(u8);

impl Axes {
    /// The empty set.
    pub const NONE: Self = Self(0);
    /// The set of X, Y and Z.
    pub const ALL: Self = Self(7);
    /// The set of X and Y.
    pub const XY: Self = Self(3);
    /// The set of Z alone.
    pub const Z: Self = Self(4);

    /// Returns the set of the axis with index 0 (X), 1 (Y) or 2 (Z).
    pub fn of(index: usize) -> Self {
        Self(1 << index)
    }

    /// Whether the set contains all of `other`.
    pub fn has(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// Returns the union of two sets.
    pub fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Returns the axes that are not in `other`.
    pub fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Returns the intersection of two sets.
    pub fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// Whether the set is empty.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }
}

/// The plane in which arcs and cycles work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Plane {
    /// X and Y (G17).
    #[default]
    Xy,
    /// Z and X (G18).
    Zx,
    /// Y and Z (G19).
    Yz,
}

impl Plane {
    /// Returns the indices of the plane's first and second axis. Turning from the first to the second is counterclockwise.
    pub fn axes(self) -> [usize; 2] {
        match self {
            Self::Xy => [0, 1],
            Self::Zx => [2, 0],
            Self::Yz => [1, 2],
        }
    }

    /// Returns the index of the axis perpendicular to the plane.
    pub fn third(self) -> usize {
        match self {
            Self::Xy => 2,
            Self::Zx => 1,
            Self::Yz => 0,
        }
    }

    /// Returns the plane's axes as a set.
    pub fn axes_of_plane(self) -> Axes {
        Axes::ALL.without(Axes::of(self.third()))
    }

    /// Returns the coordinates of a position along the plane's two axes.
    pub fn project(self, at: &[f64; 3]) -> [f64; 2] {
        self.axes().map(|axis| at[axis])
    }
}

// Arcs: swept angles, points along them, and division into chords.

/// An arc in a plane. If its ends differ along the third axis, it is a helix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// The plane of the arc.
    pub plane: Plane,
    /// The centre in mm, along the plane's first and second axis.
    pub centre: [f64; 2],
    /// Whether the arc turns clockwise, as seen from the positive end of the third axis.
    pub clockwise: bool,
    /// Number of full turns in addition to the arc itself.
    pub extra_turns: u32,
}

/// Difference in radians up to which two directions are considered equal. An arc with both ends in equal directions from its centre is a full
/// circle, as in GRBL.
const DIRECTION_TOLERANCE: f64 = 5e-7;

/// Maximum rounding error of an angle after a rotation, in radians.
const ROUNDING: f64 = 1e-12;

/// Greatest permitted difference of the radii at the two ends of an arc in mm, in programs in mm, as in NIST's RS274/NGC.
pub const MAX_RADIUS_DIFFERENCE_MM: f64 = 0.002;
/// Greatest permitted difference of the radii at the two ends of an arc in inches, in programs in inches.
pub const MAX_RADIUS_DIFFERENCE_INCHES: f64 = 0.000_2;

/// Whether a drawn arc is a full circle. `ahead` is the angle from its start to its end in the direction of the arc, in radians: for a full circle, 0
/// up to rounding, slightly less than a whole turn, or slightly more. The remnant of a trimmed arc, which has hardly any length, is not a full
/// circle.
pub fn is_full_turn(ahead: f64) -> bool {
    let beyond = ahead - TAU * libm::round(ahead / TAU);
    let is_whole = beyond < 0.0 || ahead > PI;
    beyond.abs() <= if is_whole { DIRECTION_TOLERANCE } else { ROUNDING }
}

/// Returns the angle in radians from one direction to another in the direction of travel: greater than 0, and a full turn if the directions are
/// equal.
pub fn turn_angle([a, b]: [f64; 2], [c, d]: [f64; 2], clockwise: bool) -> f64 {
    let counterclockwise = libm::atan2(a * d - b * c, a * c + b * d);
    let turn = if clockwise { -counterclockwise } else { counterclockwise };
    if turn <= DIRECTION_TOLERANCE { turn + TAU } else { turn }
}

impl Arc {
    /// Returns the distance of a position from the centre, in mm.
    pub fn radius(&self, end: &Position) -> f64 {
        let [a, b] = self.radius_vector(&end.at);
        libm::hypot(a, b)
    }

    /// Returns the swept angle in radians, including extra turns.
    pub fn sweep(&self, from: &Position, to: &Position) -> f64 {
        turn_angle(self.radius_vector(&from.at), self.radius_vector(&to.at), self.clockwise)
            + TAU * f64::from(self.extra_turns)
    }

    /// Returns the angle in radians from one position to another around the centre, in the direction of the arc, between -pi and pi.
    pub fn angle_ahead(&self, from: &[f64; 3], to: &[f64; 3]) -> f64 {
        let ([a, b], [c, d]) = (self.radius_vector(from), self.radius_vector(to));
        let counterclockwise = libm::atan2(a * d - b * c, a * c + b * d);
        if self.clockwise { -counterclockwise } else { counterclockwise }
    }

    /// Returns the direction of travel at a point of the arc, as a unit vector along the plane's axes; zero at the centre.
    pub fn tangent(&self, at: &[f64; 3]) -> [f64; 2] {
        let [a, b] = self.radius_vector(at);
        let radius = libm::hypot(a, b);
        if radius == 0.0 {
            return [0.0, 0.0];
        }
        if self.clockwise { [b / radius, -a / radius] } else { [-b / radius, a / radius] }
    }

    /// Returns the vector from the centre to a position, in the plane.
    fn radius_vector(&self, at: &[f64; 3]) -> [f64; 2] {
        let [a, b] = self.plane.project(at);
        [a - self.centre[0], b - self.centre[1]]
    }

    /// Extends a bounding box by the points of the arc that are extreme along the plane's axes. Does nothing if an end is unknown in the plane.
    pub(crate) fn widen(&self, from: &Position, to: &Position, extent: &mut [Option<(f64, f64)>; 3]) {
        if !from.known.and(to.known).has(self.plane.axes_of_plane()) {
            return;
        }
        let [a, b] = self.radius_vector(&from.at);
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

/// Returns the widest angle in radians of a chord that stays within `tolerance` mm of the circle; never more than a quarter turn.
pub fn widest_chord(radius: f64, tolerance: f64) -> f64 {
    (2.0 * libm::acos(1.0 - tolerance / radius.max(tolerance))).min(PI / 2.0)
}

/// An arc between two positions, with precomputed values.
#[derive(Clone, Copy, Debug)]
pub struct Course {
    arc: Arc,
    from: [f64; 3],
    to: [f64; 3],
    sweep: f64,
    /// The radius in mm at the start.
    radius: f64,
    /// Increase of the radius along the arc, as a fraction of `radius`; 0 for a true arc.
    growth: f64,
}

impl Course {
    /// Creates the course of an arc between positions that are known in its plane.
    pub fn new(arc: Arc, from: &Position, to: &Position) -> Self {
        let (radius, end) = (arc.radius(from), arc.radius(to));
        let growth = if radius > 0.0 { end / radius - 1.0 } else { 0.0 };
        Self { arc, from: from.at, to: to.at, sweep: arc.sweep(from, to), radius, growth }
    }

    /// Returns the arc without the values computed for its ends.
    pub fn arc(&self) -> Arc {
        self.arc
    }

    /// Returns the directions from the centre to both ends, in radians from the plane's first axis. The direction to the end is not reduced to the
    /// first turn.
    pub fn directions(&self) -> [f64; 2] {
        let [a, b] = self.arc.radius_vector(&self.from);
        let start = libm::atan2(b, a);
        [start, start + if self.arc.clockwise { -self.sweep } else { self.sweep }]
    }

    /// Returns the swept angle in radians, including extra turns.
    pub fn sweep(&self) -> f64 {
        self.sweep
    }

    /// Returns the radius at the start, in mm.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Returns the length in space, in mm.
    pub fn length(&self) -> f64 {
        let third = self.arc.plane.third();
        libm::hypot(self.length_in_plane(), self.to[third] - self.from[third])
    }

    /// Returns the length in the plane, in mm, computed with the radius at the start.
    pub fn length_in_plane(&self) -> f64 {
        self.radius * self.sweep
    }

    /// Returns the greatest distance in mm between the arc and its chord from start to end, for an arc of at most one turn.
    pub fn sagitta(&self) -> f64 {
        self.radius * (1.0 - libm::cos(self.sweep / 2.0))
    }

    /// Returns the position at a fraction (0 to 1) of the arc.
    pub fn point(&self, share: f64) -> [f64; 3] {
        self.position_at_fraction(
            rotated(self.arc.radius_vector(&self.from), self.turn_sin_cos(share)),
            share,
        )
    }

    /// Returns the positions at a quarter, half and three quarters of the arc, each rotated from the previous one.
    pub fn quarters(&self) -> [[f64; 3]; 3] {
        let quarter = self.turn_sin_cos(0.25);
        let mut spoke = self.arc.radius_vector(&self.from);
        [0.25, 0.5, 0.75].map(|share| {
            spoke = rotated(spoke, quarter);
            self.position_at_fraction(spoke, share)
        })
    }

    /// Returns the sine and cosine of the angle swept by a fraction of the arc.
    fn turn_sin_cos(&self, share: f64) -> (f64, f64) {
        let angle = self.sweep * share;
        libm::sincos(if self.arc.clockwise { -angle } else { angle })
    }

    /// Returns the position at a fraction of the arc. `[a, b]` is the vector from the centre to the start, already rotated by that fraction of the
    /// swept angle.
    fn position_at_fraction(&self, [a, b]: [f64; 2], share: f64) -> [f64; 3] {
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

fn rotated([a, b]: [f64; 2], (sin, cos): (f64, f64)) -> [f64; 2] {
    [a * cos - b * sin, a * sin + b * cos]
}

// Arcs are adjusted to the way in which a controller reads them: from rounded numbers. (book: program/gcode)
//
// A controller rejects an arc, or mills something unexpected, if its centre is not equidistant from its ends. Start, end and centre are rounded
// separately, each by up to half a unit of the last digit. Together this may be too much even for a correct arc. Then a centre that differs by one
// unit of the last digit from the correctly rounded one usually fits both ends.

/// An arc as it is to be written: its points in the plane, and the notation of its numbers.
pub struct WrittenArc<'r> {
    /// Start in mm.
    pub from: [f64; 2],
    /// End in mm.
    pub to: [f64; 2],
    /// Centre in mm, absolute or relative to the start depending on `is_absolute`.
    pub centre: [f64; 2],
    /// Converts a length in mm to the number that is written, in the output unit.
    pub length: &'r dyn Fn(f64) -> f64,
    /// Whether the centre is absolute instead of relative to the start.
    pub is_absolute: bool,
    /// Length of the output unit in mm: 1 or 25.4.
    pub unit: f64,
}

impl WrittenArc<'_> {
    /// Returns the vector in mm by which to move the centre so that the written radii at both ends agree. Each coordinate is 0, or one unit of the
    /// third decimal of a millimetre (the fourth of an inch) up or down.
    ///
    /// # Errors
    /// The written radii at both ends in the output unit, if no nearby centre makes them agree. An arc that is wrong before rounding is never
    /// adjusted.
    pub fn centre_correction(&self) -> Result<[f64; 2], [f64; 2]> {
        let nearest = self.radii([0.0; 2]);
        if difference(nearest) <= self.tolerance() {
            return Ok([0.0; 2]);
        }
        if difference(self.exact_radii()) > self.tolerance() * self.unit {
            return Err(nearest);
        }
        let digit = self.tolerance() / 2.0 * self.unit;
        let along = || [-digit, 0.0, digit].into_iter();
        let moved = |by: &[f64; 2]| difference(self.radii(*by));
        let beside = along().flat_map(|x| along().map(move |y| [x, y]));
        let best = beside.min_by(|a, b| moved(a).total_cmp(&moved(b)));
        best.filter(|by| moved(by) <= self.tolerance()).ok_or(nearest)
    }

    /// Returns the permitted difference of the radii in the output unit, as in NIST's RS274/NGC.
    fn tolerance(&self) -> f64 {
        if self.unit == 1.0 { MAX_RADIUS_DIFFERENCE_MM } else { MAX_RADIUS_DIFFERENCE_INCHES }
    }

    fn exact_radii(&self) -> [f64; 2] {
        let origin = if self.is_absolute { [0.0; 2] } else { self.from };
        [self.from, self.to].map(|point| {
            let [x, y] = [0, 1].map(|axis| point[axis] - origin[axis] - self.centre[axis]);
            libm::hypot(x, y)
        })
    }

    /// Returns the radii at both ends in the output unit, after moving the centre and rounding.
    fn radii(&self, by: [f64; 2]) -> [f64; 2] {
        let centre = [0, 1].map(|axis| {
            let origin = if self.is_absolute { 0.0 } else { (self.length)(self.from[axis]) };
            origin + (self.length)(self.centre[axis] + by[axis])
        });
        [self.from, self.to].map(|point| {
            let [x, y] = [0, 1].map(|axis| (self.length)(point[axis]) - centre[axis]);
            libm::hypot(x, y)
        })
    }
}

fn difference(radii: [f64; 2]) -> f64 {
    (radii[0] - radii[1]).abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::step::{Move, MoveShape, Pace};

    const QUARTER: Arc = Arc { plane: Plane::Xy, centre: [0.0; 2], clockwise: false, extra_turns: 0 };

    fn arc_move(arc: Arc, to: [f64; 3]) -> Move {
        let (from, to) = (Position::known(10.0, 0.0, 0.0), Position::known(to[0], to[1], to[2]));
        Move { from, to, shape: MoveShape::Arc(arc), pace: Pace::Feed(100.0), named: None }
    }

    fn sweep(arc: Arc, to: [f64; 3]) -> f64 {
        let movement = arc_move(arc, to);
        arc.sweep(&movement.from, &movement.to)
    }

    #[test]
    fn the_sweep_follows_the_direction() {
        let end = [0.0, 10.0, -1.0];
        assert!((sweep(QUARTER, end) - PI / 2.0).abs() < 1e-12);
        assert!((sweep(Arc { clockwise: true, ..QUARTER }, end) - 1.5 * PI).abs() < 1e-12);
        assert!((sweep(Arc { extra_turns: 2, ..QUARTER }, end) - 4.5 * PI).abs() < 1e-12);
    }

    #[test]
    fn ends_in_one_direction_make_a_full_circle() {
        let ahead = |angle: f64| {
            let (sin, cos) = libm::sincos(angle);
            [10.0 * cos, 10.0 * sin, -1.0]
        };
        for clockwise in [false, true] {
            let arc = Arc { clockwise, ..QUARTER };
            let sign = if clockwise { -1.0 } else { 1.0 };
            assert_eq!(sweep(arc, [10.0, 0.0, -1.0]), TAU, "the same end");
            assert!(sweep(arc, ahead(sign * 4.9e-7)) > TAU, "ahead by less than a direction");
            assert!(sweep(arc, ahead(sign * 5.1e-7)) < 1e-6, "ahead by more");
            assert!((sweep(arc, ahead(sign * -1e-6)) - TAU).abs() < 2e-6, "nearly all round");
        }
    }

    #[test]
    fn chords_stay_within_the_tolerance() {
        let course = arc_move(QUARTER, [0.0, 10.0, -1.0]).course().unwrap();
        let widest = widest_chord(10.0, 0.01);
        let count = (course.sweep() / widest).ceil();
        let sagitta = |count: f64| Course { sweep: course.sweep() / count, ..course }.sagitta();
        assert!(sagitta(count) <= 0.01 && sagitta(count - 1.0) > 0.01, "{count} is just enough");
        assert_eq!(widest_chord(0.005, 0.01), PI / 2.0, "a circle does not become a point");
    }

    #[test]
    fn pieces_join_and_end_exactly_where_the_arc_does() {
        let pieces: Vec<Move> = arc_move(QUARTER, [0.0, 10.0, -1.0]).split(2).collect();
        assert_eq!(pieces[0].to, pieces[1].from);
        assert_eq!(pieces[1].to.at, [0.0, 10.0, -1.0]);
        let [x, y, z] = pieces[0].to.at;
        let side = 10.0 * std::f64::consts::FRAC_1_SQRT_2;
        assert!((x - side).abs() < 1e-12 && (y - side).abs() < 1e-12);
        assert_eq!(z, -0.5);
    }
}
