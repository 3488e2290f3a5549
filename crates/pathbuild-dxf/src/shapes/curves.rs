//! ELLIPSE and SPLINE, approximated by lines and arcs within a tolerance: SPLINE is a B-spline, rational or not, open or closed. (book:
//! reference/configuration, `approximate-curves`; DXF reference: ELLIPSE has its centre in 10, the end of the major axis relative to it in
//! 11, the ratio in 40, parameters in 41 and 42; SPLINE has its degree in 71, knots in 40, control points in 10, weights in 41)
//!
//! A curve is divided into biarcs: pairs of arcs that meet in a common tangent and have given directions at both ends. The joint is chosen so
//! that the tangents at both ends have the same length up to the common tangent.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{Vector2, Vector3};
use pathbuild_diagnostic::messages::drawing::{SPLINE_BY_FIT_POINTS, SPLINE_NOT_UNDERSTOOD};
use pathbuild_motion::is_full_turn;

use crate::faults::EntityError;
use crate::fields::{BadGroup, Fields};
use crate::placement::{MAX_COORDINATE, Placement, angle_of};
use crate::shapes::{is_mirrored, repeated_number};
use crate::{Arc, Geometry, Line, Point3};

/// A point or vector of the plane.
type Vector = Vector2<f64>;

fn length(vector: Vector) -> f64 {
    libm::hypot(vector.x, vector.y)
}

/// Whether both coordinates are at most [`MAX_COORDINATE`] in absolute value.
fn is_near(vector: Vector) -> bool {
    vector.iter().all(|coordinate| coordinate.abs() <= MAX_COORDINATE)
}

/// Returns the vector turned by a quarter turn, counterclockwise.
fn left_normal(vector: Vector) -> Vector {
    Vector::new(-vector.y, vector.x)
}

/// A point of a curve with the unit vector of the curve's direction.
#[derive(Clone, Copy, Debug)]
struct Ray {
    point: Vector,
    direction: Vector,
}

/// A line or arc of less than a turn.
#[derive(Clone, Copy, Debug)]
struct CurvePiece {
    start: Vector,
    end: Vector,
    bend: PieceShape,
}

#[derive(Clone, Copy, Debug)]
enum PieceShape {
    Straight,
    Round { centre: Vector, radius: f64, clockwise: bool },
}

/// Largest height over the chord, in mm, of an arc that becomes a line: its radius would be too large to be accurate.
const MAX_LINE_HEIGHT: f64 = 1e-7;

/// Returns the biarc between two rays; `None` if there is none, for example between opposite directions along their chord.
fn biarc(from: Ray, to: Ray) -> Option<[CurvePiece; 2]> {
    let chord = to.point - from.point;
    let reach = control_distance(chord, from.direction, to.direction)?;
    let bend = (from.direction - to.direction) * reach;
    let joint = (from.point + to.point + bend) * 0.5;
    let first = piece(from.point, joint, from.direction);
    // Construct the second piece backwards from the end, where its direction is known.
    let second = piece(to.point, joint, -to.direction).reversed();
    Some([first, second])
}

/// Returns the distance of the control polygon's corners from the ends; `None` if there is no such polygon.
fn control_distance(chord: Vector, from: Vector, to: Vector) -> Option<f64> {
    let along = chord.dot(&(from + to));
    let turn = 2.0 * (1.0 - from.dot(&to)).max(0.0);
    let square = chord.dot(&chord);
    let root = libm::sqrt(along * along + turn * square);
    // The two forms are equal; the one that does not subtract nearly equal numbers is used.
    let reach = if along > 0.0 { square / (root + along) } else { (root - along) / turn };
    (reach.is_finite() && reach > 0.0).then_some(reach)
}

/// Returns the arc that leaves a point in a given direction and reaches another point.
fn piece(start: Vector, end: Vector, direction: Vector) -> CurvePiece {
    let chord = end - start;
    let aside = chord.dot(&left_normal(direction));
    let square = chord.dot(&chord);
    // The height over the chord is about a quarter of the distance of the end from the tangent.
    if aside.abs() < 4.0 * MAX_LINE_HEIGHT && chord.dot(&direction) >= 0.0 {
        return CurvePiece { start, end, bend: PieceShape::Straight };
    }
    let to_centre = square / (2.0 * aside);
    let centre = start + left_normal(direction) * to_centre;
    CurvePiece {
        start,
        end,
        bend: PieceShape::Round { centre, radius: to_centre.abs(), clockwise: to_centre < 0.0 },
    }
}

impl CurvePiece {
    fn line(start: Vector, end: Vector) -> Self {
        Self { start, end, bend: PieceShape::Straight }
    }

    fn reversed(self) -> Self {
        let bend = match self.bend {
            PieceShape::Straight => PieceShape::Straight,
            PieceShape::Round { centre, radius, clockwise } => {
                PieceShape::Round { centre, radius, clockwise: !clockwise }
            }
        };
        Self { start: self.end, end: self.start, bend }
    }

    fn distance(&self, point: Vector) -> f64 {
        let to_ends = length(point - self.start).min(length(point - self.end));
        match self.bend {
            PieceShape::Straight => {
                let chord = self.end - self.start;
                let along = (point - self.start).dot(&chord);
                if along <= 0.0 || along >= chord.dot(&chord) {
                    return to_ends;
                }
                ((point - self.start).dot(&left_normal(chord)) / length(chord)).abs()
            }
            PieceShape::Round { centre, radius, .. } => {
                if self.spans(point) {
                    (length(point - centre) - radius).abs()
                } else {
                    to_ends
                }
            }
        }
    }

    /// Whether the projection of a point onto the circle lies on the arc.
    fn spans(&self, point: Vector) -> bool {
        let PieceShape::Round { centre, clockwise, .. } = self.bend else { return false };
        let angle = |point: Vector| {
            let angle = angle_of(point.x - centre.x, point.y - centre.y);
            if clockwise { -angle } else { angle }
        };
        let from_start = |degrees: f64| (degrees - angle(self.start)).rem_euclid(360.0);
        from_start(angle(point)) <= from_start(angle(self.end))
    }

    /// Returns the piece as the geometry of an entity; `None` if it has no length.
    fn geometry(&self, z: f64) -> Option<Geometry> {
        let point = |vector: Vector| Point3 { x: vector.x, y: vector.y, z };
        if self.start == self.end {
            return None;
        }
        Some(match self.bend {
            PieceShape::Straight => Geometry::Line(Line { start: point(self.start), end: point(self.end) }),
            PieceShape::Round { centre, radius, clockwise } => Geometry::Arc(Arc {
                centre: point(centre),
                radius,
                start_angle: angle_of(self.start.x - centre.x, self.start.y - centre.y),
                end_angle: angle_of(self.end.x - centre.x, self.end.y - centre.y),
                clockwise,
            }),
        })
    }
}

/// A curve that is smooth over the interval in question.
trait Curve {
    /// Returns the point at a parameter, and the derivative there.
    fn at(&self, parameter: f64) -> (Vector, Vector);
}

/// Limits of an approximation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tolerance {
    /// Largest distance in mm between the curve and its pieces.
    pub(crate) distance: f64,
    pub(crate) most_pieces: usize,
}

/// The reason why a curve cannot be approximated.
pub(crate) enum ApproximationFailure {
    /// The curve would take more pieces than the limit allows.
    TooMany,
    /// The curve may reach beyond [`MAX_COORDINATE`].
    TooFar,
}

/// Number of equal steps in which the span of a biarc is sampled.
const SAMPLES: u32 = 24;

/// Safety factor: between two samples the distance may be slightly larger than at both.
const MARGIN: f64 = 0.9;

/// Number of halvings after which a span becomes a line, however far the curve is from it: shorter spans differ only by rounding.
const MAX_HALVINGS: u32 = 24;

/// Appends the pieces of a curve between two parameters.
fn approximate(
    curve: &impl Curve,
    [from, to]: [f64; 2],
    z: f64,
    tolerance: Tolerance,
    pieces: &mut Vec<Geometry>,
) -> Result<(), ApproximationFailure> {
    let mut steps = tolerance.most_pieces.saturating_mul(2);
    let mut spans = vec![(from, to, 0)];
    while let Some((from, to, depth)) = spans.pop() {
        steps = steps.checked_sub(1).ok_or(ApproximationFailure::TooMany)?;
        if let Some(fitting) = fit(curve, from, to, tolerance.distance) {
            pieces.extend(fitting.iter().filter_map(|piece| piece.geometry(z)));
        } else if depth == MAX_HALVINGS {
            pieces.extend(CurvePiece::line(curve.at(from).0, curve.at(to).0).geometry(z));
        } else {
            let middle = f64::midpoint(from, to);
            spans.push((middle, to, depth + 1));
            spans.push((from, middle, depth + 1));
        }
    }
    if pieces.len() > tolerance.most_pieces { Err(ApproximationFailure::TooMany) } else { Ok(()) }
}

/// Returns the biarc with the ends and directions of the curve, or the chord if there is no such biarc; `None` if it is too far from the curve.
fn fit(curve: &impl Curve, from: f64, to: f64, distance: f64) -> Option<Vec<CurvePiece>> {
    let width = to - from;
    let rays = ray(curve, from, width).zip(ray(curve, to, -width));
    let fitting = match rays.and_then(|(from, to)| biarc(from, to)) {
        Some(biarc) => biarc.to_vec(),
        None => vec![CurvePiece::line(curve.at(from).0, curve.at(to).0)],
    };
    let is_near = |sample: u32| {
        let point = curve.at(from + width * f64::from(sample) / f64::from(SAMPLES)).0;
        fitting.iter().any(|piece| piece.distance(point) <= distance * MARGIN)
    };
    (1..SAMPLES).all(is_near).then_some(fitting)
}

/// Returns a point of the curve with its direction. If the derivative vanishes at the point, the direction is taken slightly inside the span, on the
/// side of `inwards`. `None` if the curve has no direction there either.
fn ray(curve: &impl Curve, parameter: f64, inwards: f64) -> Option<Ray> {
    /// Distance, as a fraction of the span, of the point inside the span that gives the direction.
    const STEP: f64 = 1e-3;
    /// Derivatives shorter than this fraction of the difference quotient are treated as zero.
    const ZERO_DERIVATIVE: f64 = 1e-6;
    let (point, derivative) = curve.at(parameter);
    let quotient = (curve.at(parameter + inwards * STEP).0 - point) * (1.0 / (inwards * STEP));
    let has_direction = length(derivative) > ZERO_DERIVATIVE * length(quotient);
    let direction = if has_direction { derivative } else { quotient };
    let length = length(direction);
    (length > 0.0).then(|| Ray { point, direction: direction * (1.0 / length) })
}

/// An ellipse or elliptical arc.
#[derive(Clone, Debug)]
pub(crate) struct Ellipse {
    centre: Point3,
    /// Vector from the centre to the point with parameter 0.
    major: Vector,
    /// Vector from the centre to the point a quarter turn later.
    minor: Vector,
    start: f64,
    end: f64,
}

impl Ellipse {
    /// Reads an ELLIPSE. Its points are in world coordinates.
    pub(crate) fn read<'a>(fields: &Fields<'a>) -> Result<Self, EntityError<'a>> {
        let major = fields.point(11)?;
        let ratio = fields.length(40)?;
        let is_mirrored = is_mirrored(fields)?;
        if major.z != 0.0 {
            return Err(EntityError::Tilted);
        }
        if major.x == 0.0 && major.y == 0.0 {
            let value = fields.get(11).ok_or(BadGroup::Missing { code: 11 })?;
            return Err(BadGroup::NotPositive { code: 11, value }.into());
        }
        let side = if is_mirrored { -ratio } else { ratio };
        let start = fields.number(41)?.unwrap_or(0.0);
        let end = fields.number(42)?.unwrap_or(TAU);
        Ok(Self {
            centre: fields.point(10)?,
            major: Vector::new(major.x, major.y),
            minor: Vector::new(-major.y * side, major.x * side),
            start,
            end: start + sweep(start, end),
        })
    }

    /// Approximates the ellipse by arcs in the coordinates of the drawing.
    pub(crate) fn pieces(
        &self,
        placement: &Placement,
        tolerance: Tolerance,
    ) -> Result<Vec<Geometry>, ApproximationFailure> {
        let placed = self.placed(placement);
        if !placed.is_near() {
            return Err(ApproximationFailure::TooFar);
        }
        let mut pieces = Vec::new();
        let quarters = libm::ceil((self.end - self.start) / FRAC_PI_2).max(1.0);
        let width = (self.end - self.start) / quarters;
        let mut quarter = 0.0;
        while quarter < quarters {
            let from = self.start + width * quarter;
            quarter += 1.0;
            let to = self.start + width * quarter;
            approximate(&placed, [from, to], placed.centre.z, tolerance, &mut pieces)?;
        }
        Ok(pieces)
    }

    /// Whether the coordinates of the centre and of both half axes are at most [`MAX_COORDINATE`].
    fn is_near(&self) -> bool {
        let Point3 { x, y, .. } = self.centre;
        [Vector::new(x, y), self.major, self.minor].into_iter().all(is_near)
    }

    fn placed(&self, placement: &Placement) -> Self {
        let axis = |axis: Vector| {
            let (x, y) = placement.direction(axis.x, axis.y);
            Vector::new(x, y)
        };
        Self {
            centre: placement.point(self.centre),
            major: axis(self.major),
            minor: axis(self.minor),
            ..*self
        }
    }
}

/// Returns the range of the parameter in radians, which is always greater than 0: 2π if [`is_full_turn`] is true, otherwise less.
fn sweep(start: f64, end: f64) -> f64 {
    if is_full_turn(end - start) {
        return TAU;
    }
    let turn = libm::fmod(end - start, TAU);
    if turn < 0.0 { turn + TAU } else { turn }
}

impl Curve for Ellipse {
    fn at(&self, parameter: f64) -> (Vector, Vector) {
        let (sin, cos) = libm::sincos(parameter);
        let centre = Vector::new(self.centre.x, self.centre.y);
        let point = centre + self.major * cos + self.minor * sin;
        (point, self.minor * cos - self.major * sin)
    }
}

/// A B-spline in a plane parallel to the drawing's.
#[derive(Clone, Debug)]
pub(crate) struct Spline {
    degree: usize,
    knots: Vec<f64>,
    points: Vec<ControlPoint>,
    z: f64,
}

#[derive(Clone, Copy, Debug)]
struct ControlPoint {
    point: Vector,
    weight: f64,
}

/// The smooth part of a spline between two neighbouring knots.
struct Span<'s> {
    spline: &'s Spline,
    /// Index of the knot at the start of the span.
    knot: usize,
}

/// Point and weight in homogeneous coordinates.
type Homogeneous = Vector3<f64>;

/// Degree of a spline that states none.
const CUBIC: i64 = 3;

/// Largest degree that is read. Higher ones do not occur, and evaluation takes time quadratic in the degree.
const HIGHEST_DEGREE: usize = 15;

impl Spline {
    /// Reads a SPLINE. Its points are in world coordinates. A spline that is defined by fit points only is left out.
    pub(crate) fn read<'a>(fields: &Fields<'a>) -> Result<Self, EntityError<'a>> {
        is_mirrored(fields)?;
        let groups = Groups::of(fields)?;
        if groups.points.is_empty() && fields.get(11).is_some() {
            return Err(EntityError::omitted(&SPLINE_BY_FIT_POINTS, fields));
        }
        let z = groups.points.first().and_then(|point| point[2]).unwrap_or(0.0);
        if groups.points.iter().any(|point| point[2].unwrap_or(0.0) != z) {
            return Err(EntityError::Tilted);
        }
        let degree = usize::try_from(fields.whole_number(71)?.unwrap_or(CUBIC)).unwrap_or(0);
        let spline = Self { degree, points: groups.control_points()?, knots: groups.knots, z };
        if !spline.is_sound() {
            return Err(EntityError::omitted(&SPLINE_NOT_UNDERSTOOD, fields));
        }
        Ok(spline)
    }

    /// Approximates the spline by lines and arcs in the coordinates of the drawing.
    pub(crate) fn pieces(
        &self,
        placement: &Placement,
        tolerance: Tolerance,
    ) -> Result<Vec<Geometry>, ApproximationFailure> {
        let placed = self.placed(placement);
        if !placed.is_near() {
            return Err(ApproximationFailure::TooFar);
        }
        let mut pieces = Vec::new();
        for knot in self.degree..self.points.len() {
            let [from, to] = [self.knots[knot], self.knots[knot + 1]];
            if from < to {
                approximate(&Span { spline: &placed, knot }, [from, to], placed.z, tolerance, &mut pieces)?;
            }
        }
        Ok(pieces)
    }

    /// Whether no coordinate of the spline exceeds [`MAX_COORDINATE`]. The spline lies within the hull of its control points, so these are tested.
    fn is_near(&self) -> bool {
        self.points.iter().all(|control| is_near(control.point))
    }

    fn placed(&self, placement: &Placement) -> Self {
        let place = |control: &ControlPoint| {
            let point = placement.point(Point3 { x: control.point.x, y: control.point.y, z: self.z });
            ControlPoint { point: Vector::new(point.x, point.y), weight: control.weight }
        };
        let z = placement.point(Point3 { x: 0.0, y: 0.0, z: self.z }).z;
        Self {
            degree: self.degree,
            knots: self.knots.clone(),
            points: self.points.iter().map(place).collect(),
            z,
        }
    }

    fn is_sound(&self) -> bool {
        (1..=HIGHEST_DEGREE).contains(&self.degree)
            && self.points.len() > self.degree
            && self.knots.len() == self.points.len() + self.degree + 1
            && self.knots.is_sorted()
            && self.knots[self.degree] < self.knots[self.points.len()]
            && self.points.iter().all(|control| control.weight > 0.0)
    }
}

/// The repeated groups of a SPLINE.
#[derive(Default)]
struct Groups {
    knots: Vec<f64>,
    weights: Vec<f64>,
    points: Vec<[Option<f64>; 3]>,
}

impl Groups {
    fn of<'a>(fields: &Fields<'a>) -> Result<Self, BadGroup<'a>> {
        let mut groups = Self::default();
        for pair in &fields.repeated {
            let number = repeated_number(pair)?;
            match (pair.code, groups.points.last_mut()) {
                (40, _) => groups.knots.push(number),
                (41, _) => groups.weights.push(number),
                (10, _) => groups.points.push([Some(number), None, None]),
                (20, Some(point)) => point[1] = Some(number),
                (_, Some(point)) => point[2] = Some(number),
                (_, None) => return Err(BadGroup::Missing { code: 10 }),
            }
        }
        Ok(groups)
    }

    /// Returns the control points; an empty list if the number of weights does not match.
    fn control_points<'a>(&self) -> Result<Vec<ControlPoint>, BadGroup<'a>> {
        if !self.weights.is_empty() && self.weights.len() != self.points.len() {
            return Ok(Vec::new());
        }
        let weights = self.weights.iter().copied().chain(std::iter::repeat(1.0));
        let control_point = |(point, weight): (&[Option<f64>; 3], f64)| match *point {
            [Some(x), Some(y), _] => Ok(ControlPoint { point: Vector::new(x, y), weight }),
            _ => Err(BadGroup::Missing { code: 20 }),
        };
        self.points.iter().zip(weights).map(control_point).collect()
    }
}

impl Curve for Span<'_> {
    fn at(&self, parameter: f64) -> (Vector, Vector) {
        let (value, derivative) = self.homogeneous(parameter);
        let point = value.xy() / value.z;
        let derivative = (derivative.xy() - point * derivative.z) / value.z;
        (point, derivative)
    }
}

impl Span<'_> {
    /// Computes value and derivative by de Boor's algorithm.
    fn homogeneous(&self, parameter: f64) -> (Homogeneous, Homogeneous) {
        let Spline { degree, knots, points, .. } = self.spline;
        let first = self.knot - degree;
        let mut mixed = [Homogeneous::zeros(); HIGHEST_DEGREE + 1];
        for (mixed, ControlPoint { point, weight }) in mixed.iter_mut().zip(&points[first..=self.knot]) {
            *mixed = point.push(1.0) * *weight;
        }
        let mut derivative = Homogeneous::zeros();
        for level in 1..=*degree {
            if level == *degree {
                let speed = *degree as f64 / (knots[self.knot + 1] - knots[self.knot]);
                derivative = (mixed[*degree] - mixed[degree - 1]) * speed;
            }
            for index in (level..=*degree).rev() {
                let [from, to] = [knots[first + index], knots[first + index + degree + 1 - level]];
                let part = (parameter - from) / (to - from);
                mixed[index] = mixed[index - 1] * (1.0 - part) + mixed[index] * part;
            }
        }
        (mixed[*degree], derivative)
    }
}
