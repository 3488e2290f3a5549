//! SPLINE: B-splines, rational or not, open or closed. (DXF reference: degree 71, knots 40, control points 10, weights 41)

use pathbuild_diagnostic::messages::drawing::SPLINE_NOT_UNDERSTOOD;

use crate::curves::{Curve, NoPieces, Tolerance, Vector, approximate};
use crate::faults::EntityError;
use crate::fields::{BadGroup, Fields};
use crate::placement::Placement;
use crate::shapes::{is_mirrored, repeated_number};
use crate::{Geometry, Point3};

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
    /// Index of the knot at its start.
    knot: usize,
}

/// Point and weight in homogeneous coordinates.
type Homogeneous = [f64; 3];

/// The degree where none is given.
const CUBIC: i64 = 3;

/// Largest degree. Higher ones do not occur, and evaluation takes time quadratic in the degree.
const HIGHEST_DEGREE: usize = 15;

impl Spline {
    /// Reads a SPLINE. Its points are in world coordinates. One defined by fit points only is left out.
    pub(crate) fn read<'a>(fields: &Fields<'a>) -> Result<Self, EntityError<'a>> {
        is_mirrored(fields)?;
        let groups = Groups::of(fields)?;
        let z = groups.points.first().and_then(|point| point[2]).unwrap_or(0.0);
        if groups.points.iter().any(|point| point[2].unwrap_or(0.0) != z) {
            return Err(EntityError::Tilted);
        }
        let degree = usize::try_from(fields.whole(71)?.unwrap_or(CUBIC)).unwrap_or(0);
        let spline = Self { degree, points: groups.control_points()?, knots: groups.knots, z };
        if !spline.is_sound() {
            return Err(EntityError::left_out(&SPLINE_NOT_UNDERSTOOD, fields));
        }
        Ok(spline)
    }

    /// Approximates it by lines and arcs in the coordinates of the drawing.
    pub(crate) fn pieces(
        &self,
        placement: &Placement,
        tolerance: Tolerance,
    ) -> Result<Vec<Geometry>, NoPieces> {
        let placed = self.placed(placement);
        if !placed.is_near() {
            return Err(NoPieces::TooFar);
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

    /// Whether all of it is within the largest coordinate of a drawing; it lies within the hull of its control points.
    fn is_near(&self) -> bool {
        self.points.iter().all(|control| control.point.is_near())
    }

    fn placed(&self, placement: &Placement) -> Self {
        let place = |control: &ControlPoint| {
            let point = placement.point(Point3 { x: control.point.x, y: control.point.y, z: self.z });
            ControlPoint { point: Vector { x: point.x, y: point.y }, weight: control.weight }
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

    /// The control points, or none if the number of weights does not match.
    fn control_points<'a>(&self) -> Result<Vec<ControlPoint>, BadGroup<'a>> {
        if !self.weights.is_empty() && self.weights.len() != self.points.len() {
            return Ok(Vec::new());
        }
        let weights = self.weights.iter().copied().chain(std::iter::repeat(1.0));
        let control_point = |(point, weight): (&[Option<f64>; 3], f64)| match *point {
            [Some(x), Some(y), _] => Ok(ControlPoint { point: Vector { x, y }, weight }),
            _ => Err(BadGroup::Missing { code: 20 }),
        };
        self.points.iter().zip(weights).map(control_point).collect()
    }
}

impl Curve for Span<'_> {
    fn at(&self, parameter: f64) -> (Vector, Vector) {
        let ([x, y, w], [dx, dy, dw]) = self.homogeneous(parameter);
        let point = Vector { x: x / w, y: y / w };
        let derivative = Vector { x: (dx - point.x * dw) / w, y: (dy - point.y * dw) / w };
        (point, derivative)
    }
}

impl Span<'_> {
    /// Value and derivative by de Boor's algorithm.
    fn homogeneous(&self, parameter: f64) -> (Homogeneous, Homogeneous) {
        let Spline { degree, knots, points, .. } = self.spline;
        let first = self.knot - degree;
        let mut mixed = [[0.0; 3]; HIGHEST_DEGREE + 1];
        for (mixed, ControlPoint { point, weight }) in mixed.iter_mut().zip(&points[first..=self.knot]) {
            *mixed = [point.x * weight, point.y * weight, *weight];
        }
        let mut derivative = [0.0; 3];
        for level in 1..=*degree {
            if level == *degree {
                let speed = *degree as f64 / (knots[self.knot + 1] - knots[self.knot]);
                derivative =
                    std::array::from_fn(|axis| (mixed[*degree][axis] - mixed[degree - 1][axis]) * speed);
            }
            for index in (level..=*degree).rev() {
                let [from, to] = [knots[first + index], knots[first + index + degree + 1 - level]];
                let part = (parameter - from) / (to - from);
                let (before, here) = (mixed[index - 1], mixed[index]);
                mixed[index] = std::array::from_fn(|axis| before[axis] * (1.0 - part) + here[axis] * part);
            }
        }
        (mixed[*degree], derivative)
    }
}
