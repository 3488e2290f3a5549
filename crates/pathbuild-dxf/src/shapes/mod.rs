//! Converts the groups of an entity to its shape, in the coordinates of its space: the drawing's or the block's.

mod ellipse;
mod insert;
mod plain;
mod polyline;
mod spline;
mod text;

use crate::Geometry;
use crate::fields::{BadGroup, Fields, Value};
use crate::number::real;
use crate::pairs::Pair;
use crate::placement::Placement;
use crate::trouble::EntityError;

pub(crate) use ellipse::Ellipse;
pub(crate) use insert::Insert;
pub(crate) use plain::{arc, circle, line};
pub(crate) use polyline::{OpenPolyline, lightweight};
pub(crate) use spline::Spline;
pub(crate) use text::{mtext, text};

/// Whether object coordinates are mirrored: extrusion (0, 0, -1).
fn is_mirrored<'a>(fields: &Fields<'a>) -> Result<bool, EntityError<'a>> {
    /// Tolerance for the components of a normal that was computed.
    const NOISE: f64 = 1e-9;
    if fields.get(210).is_none() && fields.get(220).is_none() && fields.get(230).is_none() {
        return Ok(false);
    }
    let [x, y] = [fields.number(210)?.unwrap_or(0.0), fields.number(220)?.unwrap_or(0.0)];
    let z = fields.number(230)?.unwrap_or(1.0);
    if z == 0.0 || x.abs().max(y.abs()) > NOISE * z.abs() {
        return Err(EntityError::Tilted);
    }
    Ok(z < 0.0)
}

/// Maps a shape from object coordinates to those of the space.
fn from_object_coordinates<'a>(
    mut geometry: Geometry,
    fields: &Fields<'a>,
) -> Result<Geometry, EntityError<'a>> {
    if is_mirrored(fields)? {
        Placement::MIRRORED.apply(&mut geometry);
    }
    Ok(geometry)
}

/// Parses a repeated group as a number.
fn repeated_number<'a>(pair: &Pair<'a>) -> Result<f64, BadGroup<'a>> {
    let value = Value::new(pair.value, pair.line);
    real(pair.value).map_err(|reason| BadGroup::Number { code: pair.code, value, reason })
}
