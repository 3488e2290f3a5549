//! ELLIPSE. (DXF reference: centre 10, end of the major axis 11 relative to it, ratio 40, parameters 41 and 42)

use std::f64::consts::{FRAC_PI_2, TAU};

use pathbuild_motion::is_same_direction;

use crate::curves::{Curve, NoPieces, Tolerance, Vector, approximate};
use crate::faults::EntityError;
use crate::fields::{BadGroup, Fields};
use crate::placement::Placement;
use crate::shapes::is_mirrored;
use crate::{Geometry, Point3};

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
            major: Vector { x: major.x, y: major.y },
            minor: Vector { x: -major.y * side, y: major.x * side },
            start,
            end: start + sweep(start, end),
        })
    }

    /// Approximates it by arcs in the coordinates of the drawing.
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

    /// Whether all of it is within the largest coordinate of a drawing.
    fn is_near(&self) -> bool {
        let Point3 { x, y, .. } = self.centre;
        [Vector { x, y }, self.major, self.minor].into_iter().all(Vector::is_near)
    }

    fn placed(&self, placement: &Placement) -> Self {
        let axis = |axis: Vector| {
            let (x, y) = placement.direction(axis.x, axis.y);
            Vector { x, y }
        };
        Self {
            centre: placement.point(self.centre),
            major: axis(self.major),
            minor: axis(self.minor),
            ..*self
        }
    }
}

/// Range of the parameter: greater than 0, and a full turn if both ends are in the same direction.
fn sweep(start: f64, end: f64) -> f64 {
    if is_same_direction(end - start) {
        return TAU;
    }
    let turn = libm::fmod(end - start, TAU);
    if turn < 0.0 { turn + TAU } else { turn }
}

impl Curve for Ellipse {
    fn at(&self, parameter: f64) -> (Vector, Vector) {
        let (sin, cos) = libm::sincos(parameter);
        let centre = Vector { x: self.centre.x, y: self.centre.y };
        let point = centre.plus(self.major.times(cos)).plus(self.minor.times(sin));
        (point, self.minor.times(cos).minus(self.major.times(sin)))
    }
}
