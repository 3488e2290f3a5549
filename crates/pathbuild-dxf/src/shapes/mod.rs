//! Converts the groups of an entity to its shape, in the coordinates of its space: the drawing's or the block's.

pub(crate) mod curves;
mod insert;
mod polyline;
mod text;

use pathbuild_diagnostic::Point;

use crate::faults::EntityError;
use crate::fields::{BadGroup, Fields, Value};
use crate::number::real;
use crate::pairs::Pair;
use crate::placement::Placement;
use crate::{Arc, Circle, Geometry, Line};

pub(crate) use curves::Ellipse;
pub(crate) use curves::Spline;
pub(crate) use insert::{Array, Insert};
pub(crate) use polyline::{Polyline, PolylineBuilder, lwpolyline};
pub(crate) use text::{label, mtext, text};

/// Whether object coordinates are mirrored: extrusion (0, 0, -1).
fn is_mirrored<'a>(fields: &Fields<'a>) -> Result<bool, EntityError<'a>> {
    /// Tolerance for the x and y of a computed normal, relative to its z.
    const NORMAL_TOLERANCE: f64 = 1e-9;
    if fields.get(210).is_none() && fields.get(220).is_none() && fields.get(230).is_none() {
        return Ok(false);
    }
    let [x, y] = [fields.number(210)?.unwrap_or(0.0), fields.number(220)?.unwrap_or(0.0)];
    let z = fields.number(230)?.unwrap_or(1.0);
    if z == 0.0 || x.abs().max(y.abs()) > NORMAL_TOLERANCE * z.abs() {
        return Err(EntityError::Tilted);
    }
    Ok(z < 0.0)
}

/// Converts a shape from object coordinates to world coordinates.
fn from_object_coordinates<'a>(
    mut geometry: Geometry,
    fields: &Fields<'a>,
) -> Result<Geometry, EntityError<'a>> {
    if is_mirrored(fields)? {
        Placement::MIRRORED.apply(&mut geometry);
    }
    Ok(geometry)
}

/// Returns a point of a HATCH: the first of its boundary, or the centre of an arc of the boundary. The very first point of the entity is left
/// out, since it is the elevation.
pub(crate) fn hatch_point(fields: &Fields<'_>) -> Option<Point> {
    let second = |code: i32| {
        let of_code = fields.repeated.iter().filter(|pair| pair.code == code);
        of_code.skip(1).find_map(|pair| repeated_number(pair).ok())
    };
    let is_mirrored = is_mirrored(fields).ok()?;
    Some(Point::new(if is_mirrored { -second(10)? } else { second(10)? }, second(20)?))
}

fn repeated_number<'a>(pair: &Pair<'a>) -> Result<f64, BadGroup<'a>> {
    let value = Value::new(pair.value, pair.line);
    real(pair.value).map_err(|reason| BadGroup::Number { code: pair.code, value, reason })
}

/// Reads a LINE; its points are in world coordinates whatever its extrusion.
pub(crate) fn line<'a>(fields: &Fields<'a>) -> Result<Geometry, EntityError<'a>> {
    is_mirrored(fields)?;
    Ok(Geometry::Line(Line { start: fields.point(10)?, end: fields.point(11)? }))
}

pub(crate) fn arc<'a>(fields: &Fields<'a>) -> Result<Geometry, EntityError<'a>> {
    let arc = Arc {
        centre: fields.point(10)?,
        radius: fields.length(40)?,
        start_angle: fields.required(50)?,
        end_angle: fields.required(51)?,
        clockwise: false,
    };
    from_object_coordinates(Geometry::Arc(arc), fields)
}

pub(crate) fn circle<'a>(fields: &Fields<'a>) -> Result<Geometry, EntityError<'a>> {
    let circle = Circle { centre: fields.point(10)?, radius: fields.length(40)? };
    from_object_coordinates(Geometry::Circle(circle), fields)
}
