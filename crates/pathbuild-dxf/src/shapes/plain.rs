//! LINE, ARC and CIRCLE.

use crate::fields::Fields;
use crate::trouble::EntityError;
use crate::{Arc, Circle, Geometry, Line};

use super::{from_object_coordinates, is_mirrored};

/// A LINE; its points are in world coordinates whatever its extrusion.
pub(crate) fn line<'a>(fields: &Fields<'a>) -> Result<Geometry, EntityError<'a>> {
    is_mirrored(fields)?;
    Ok(Geometry::Line(Line { start: fields.point(10)?, end: fields.point(11)? }))
}

/// An ARC.
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

/// A CIRCLE.
pub(crate) fn circle<'a>(fields: &Fields<'a>) -> Result<Geometry, EntityError<'a>> {
    let circle = Circle { centre: fields.point(10)?, radius: fields.length(40)? };
    from_object_coordinates(Geometry::Circle(circle), fields)
}
