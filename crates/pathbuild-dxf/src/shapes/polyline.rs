//! LWPOLYLINE and two-dimensional POLYLINE as lines and arcs along their centre line. Their width is ignored, since the cutter determines how
//! wide a path is milled.

use pathbuild_diagnostic::messages::drawing::POLYLINE_NOT_FLAT;

use crate::faults::EntityError;
use crate::fields::{BadGroup, Fields};
use crate::placement::{Placement, angle_of};
use crate::shapes::{is_mirrored, repeated_number};
use crate::{Arc, Geometry, Line, Point3};

/// The centre line of a polyline.
#[derive(Clone, Debug)]
pub(crate) struct Polyline {
    /// The lines and arcs between the vertices.
    pub(crate) pieces: Vec<Geometry>,
    /// Whether the polyline has a width, which the pieces do not show.
    pub(crate) is_wide: bool,
}

/// Converts an LWPOLYLINE to lines and arcs.
pub(crate) fn lwpolyline<'a>(fields: &Fields<'a>) -> Result<Polyline, EntityError<'a>> {
    let flags = fields.whole_number(70)?.unwrap_or(0);
    let z = fields.number(38)?.unwrap_or(0.0);
    let mut corners: Vec<Corner> = Vec::new();
    let mut has_y = true;
    // The constant width applies only if no vertex has a width of its own.
    let mut is_wide = None;
    for pair in &fields.repeated {
        let number = repeated_number(pair)?;
        match (pair.code, corners.last_mut()) {
            (40 | 41, _) => {
                is_wide = Some(is_wide.unwrap_or(false) || number != 0.0);
                continue;
            }
            (10, _) if !has_y => return Err(BadGroup::Missing { code: 20 }.into()),
            (10, _) => corners.push(Corner { x: number, y: 0.0, z, bulge: 0.0 }),
            (_, None) => return Err(BadGroup::Missing { code: 10 }.into()),
            (20, Some(corner)) => corner.y = number,
            (_, Some(corner)) => corner.bulge = number,
        }
        has_y = if pair.code == 42 { has_y } else { pair.code == 20 };
    }
    if !has_y {
        return Err(BadGroup::Missing { code: 20 }.into());
    }
    check_count(fields, corners.len())?;
    let is_wide = match is_wide {
        Some(is_wide) => is_wide,
        None => fields.number(43)?.is_some_and(|width| width != 0.0),
    };
    Ok(Polyline { pieces: pieces(&corners, flags & CLOSED_FLAG != 0, is_mirrored(fields)?), is_wide })
}

/// Checks that an LWPOLYLINE has as many vertices as it states: an editor or a transfer may have lost some.
fn check_count<'a>(fields: &Fields<'a>, found: usize) -> Result<(), BadGroup<'a>> {
    match (fields.whole_number(90)?, fields.get(90)) {
        (Some(stated), Some(value)) if usize::try_from(stated) != Ok(found) => {
            Err(BadGroup::VertexCount { value, found })
        }
        _ => Ok(()),
    }
}

/// A POLYLINE that is waiting for its VERTEX records.
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of its own")]
pub(crate) struct PolylineBuilder {
    elevation: f64,
    is_closed: bool,
    is_mirrored: bool,
    is_spline_fit: bool,
    /// The default widths at the start and the end of a piece, for vertices without widths of their own.
    widths: [f64; 2],
    is_wide: bool,
    corners: Vec<Corner>,
}

impl PolylineBuilder {
    /// Reads the groups of a POLYLINE itself, before its VERTEX records.
    pub(crate) fn begin<'a>(fields: &Fields<'a>) -> Result<Self, EntityError<'a>> {
        let flags = fields.whole_number(70)?.unwrap_or(0);
        if flags & (THREE_DIMENSIONAL_FLAG | MESH_FLAG | POLYFACE_FLAG) != 0 {
            return Err(EntityError::omitted(&POLYLINE_NOT_FLAT, fields));
        }
        Ok(Self {
            elevation: fields.number(30)?.unwrap_or(0.0),
            is_closed: flags & CLOSED_FLAG != 0,
            is_mirrored: is_mirrored(fields)?,
            is_spline_fit: flags & SPLINE_FIT_FLAG != 0,
            widths: [fields.number(40)?.unwrap_or(0.0), fields.number(41)?.unwrap_or(0.0)],
            is_wide: false,
            corners: Vec::new(),
        })
    }

    /// Adds the next VERTEX. Frame points of a smoothed polyline are not corners.
    pub(crate) fn vertex<'a>(&mut self, fields: &Fields<'a>) -> Result<(), EntityError<'a>> {
        let flags = fields.whole_number(70)?.unwrap_or(0);
        if self.is_spline_fit && flags & FRAME_POINT_FLAG != 0 {
            return Ok(());
        }
        let point = fields.point(10)?;
        let z = if point.z == 0.0 { self.elevation } else { point.z };
        let bulge = fields.number(42)?.unwrap_or(0.0);
        let [start, end] = self.widths;
        let widths = [fields.number(40)?.unwrap_or(start), fields.number(41)?.unwrap_or(end)];
        self.is_wide |= widths != [0.0, 0.0];
        self.corners.push(Corner { x: point.x, y: point.y, z, bulge });
        Ok(())
    }

    pub(crate) fn end(self) -> Polyline {
        let pieces = pieces(&self.corners, self.is_closed, self.is_mirrored);
        Polyline { pieces, is_wide: self.is_wide }
    }
}

/// Flags of a polyline (group 70).
const CLOSED_FLAG: i64 = 1;
const SPLINE_FIT_FLAG: i64 = 4;
const THREE_DIMENSIONAL_FLAG: i64 = 8;
const MESH_FLAG: i64 = 16;
const POLYFACE_FLAG: i64 = 64;
/// Flag of a VERTEX (group 70).
const FRAME_POINT_FLAG: i64 = 16;

/// Largest bulge that is treated as straight: over a chord of one metre it is 5 nm high, and the radius would be too large to be accurate.
const MAX_LINE_BULGE: f64 = 1e-8;

/// Height in mm over the chord up to which an arc may become a line if its centre is too far away: the difference is invisible in printed
/// programs.
const MAX_INVISIBLE_HEIGHT: f64 = 0.0005;

#[derive(Clone, Copy, Debug)]
struct Corner {
    x: f64,
    y: f64,
    z: f64,
    /// Bulge of the piece to the next corner: the tangent of a quarter of its angle, positive for counterclockwise.
    bulge: f64,
}

impl Corner {
    fn point(self) -> Point3 {
        Point3 { x: self.x, y: self.y, z: self.z }
    }
}

/// Returns the pieces between corners, without those of zero length.
fn pieces(corners: &[Corner], is_closed: bool, is_mirrored: bool) -> Vec<Geometry> {
    let next = corners.iter().skip(1).chain(corners.first().filter(|_| is_closed));
    let mut pieces: Vec<Geometry> =
        corners.iter().zip(next).filter_map(|(from, to)| piece(*from, *to)).collect();
    if is_mirrored {
        for piece in &mut pieces {
            Placement::MIRRORED.apply(piece);
        }
    }
    pieces
}

fn piece(from: Corner, to: Corner) -> Option<Geometry> {
    let [start, end] = [from.point(), to.point()];
    if start == end {
        return None;
    }
    if from.bulge.abs() < MAX_LINE_BULGE || (start.x == end.x && start.y == end.y) {
        return Some(Geometry::Line(Line { start, end }));
    }
    let arc = Geometry::Arc(arc_from_bulge(start, end, from.bulge));
    let height = libm::hypot(end.x - start.x, end.y - start.y) * from.bulge.abs() / 2.0;
    Some(if height < MAX_INVISIBLE_HEIGHT && !arc.is_sound() {
        Geometry::Line(Line { start, end })
    } else {
        arc
    })
}

/// Returns the arc over a chord. Its height is the bulge times half the chord.
fn arc_from_bulge(start: Point3, end: Point3, bulge: f64) -> Arc {
    let [x, y] = [end.x - start.x, end.y - start.y];
    // Distance of the centre from the middle of the chord, to the left, in units of the chord.
    let to_centre = (1.0 - bulge * bulge) / (4.0 * bulge);
    let centre = Point3 {
        x: f64::midpoint(start.x, end.x) - y * to_centre,
        y: f64::midpoint(start.y, end.y) + x * to_centre,
        z: start.z,
    };
    let angle = |point: Point3| angle_of(point.x - centre.x, point.y - centre.y);
    Arc {
        centre,
        radius: libm::hypot(x, y) * (1.0 + bulge * bulge) / (4.0 * bulge.abs()),
        start_angle: angle(start),
        end_angle: angle(end),
        clockwise: bulge < 0.0,
    }
}
