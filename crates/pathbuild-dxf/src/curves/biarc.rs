//! Biarcs: two tangent arcs with given directions at both ends.
//!
//! The joint is chosen so that both ends are equally far from the corner of their tangents.

use super::vector::Vector;
use crate::angle;
use crate::{Arc, Geometry, Line, Point3};

/// A point of a curve with the unit vector of the curve's direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    pub(crate) point: Vector,
    pub(crate) direction: Vector,
}

/// A line or arc of less than a turn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CurvePiece {
    pub(crate) start: Vector,
    pub(crate) end: Vector,
    bend: Bend,
}

#[derive(Clone, Copy, Debug)]
enum Bend {
    Straight,
    Round { centre: Vector, radius: f64, clockwise: bool },
}

/// Largest height over the chord, in mm, of an arc that becomes a line: its radius would be too large to be accurate.
const FLAT: f64 = 1e-7;

/// The biarc between two rays, or `None` if there is none, for example between opposite directions along their chord.
pub(crate) fn biarc(from: Ray, to: Ray) -> Option<[CurvePiece; 2]> {
    let chord = to.point.minus(from.point);
    let reach = reach(chord, from.direction, to.direction)?;
    let bend = from.direction.minus(to.direction).times(reach);
    let joint = from.point.plus(to.point).plus(bend).times(0.5);
    let first = piece(from.point, joint, from.direction);
    // Constructed backwards from the end, whose direction is known.
    let second = piece(to.point, joint, to.direction.times(-1.0)).reversed();
    Some([first, second])
}

/// Distance of the control polygon's corners from the ends.
fn reach(chord: Vector, from: Vector, to: Vector) -> Option<f64> {
    let along = chord.dot(from.plus(to));
    let turn = 2.0 * (1.0 - from.dot(to)).max(0.0);
    let square = chord.dot(chord);
    let root = libm::sqrt(along * along + turn * square);
    // Both forms are equal; each avoids the difference of nearly equal numbers.
    let reach = if along > 0.0 { square / (root + along) } else { (root - along) / turn };
    (reach.is_finite() && reach > 0.0).then_some(reach)
}

/// The arc that leaves a point in a given direction and reaches another point.
fn piece(start: Vector, end: Vector, direction: Vector) -> CurvePiece {
    let chord = end.minus(start);
    let aside = chord.dot(direction.left());
    let square = chord.dot(chord);
    // The height over the chord is about a quarter of the distance of the end from the tangent.
    if aside.abs() < 4.0 * FLAT && chord.dot(direction) >= 0.0 {
        return CurvePiece { start, end, bend: Bend::Straight };
    }
    let to_centre = square / (2.0 * aside);
    let centre = start.plus(direction.left().times(to_centre));
    CurvePiece {
        start,
        end,
        bend: Bend::Round { centre, radius: to_centre.abs(), clockwise: to_centre < 0.0 },
    }
}

impl CurvePiece {
    /// The line between two points.
    pub(crate) fn line(start: Vector, end: Vector) -> Self {
        Self { start, end, bend: Bend::Straight }
    }

    fn reversed(self) -> Self {
        let bend = match self.bend {
            Bend::Straight => Bend::Straight,
            Bend::Round { centre, radius, clockwise } => {
                Bend::Round { centre, radius, clockwise: !clockwise }
            }
        };
        Self { start: self.end, end: self.start, bend }
    }

    /// Distance of a point from the piece.
    pub(crate) fn distance(&self, point: Vector) -> f64 {
        let to_ends = point.minus(self.start).length().min(point.minus(self.end).length());
        match self.bend {
            Bend::Straight => {
                let chord = self.end.minus(self.start);
                let along = point.minus(self.start).dot(chord);
                if along <= 0.0 || along >= chord.dot(chord) {
                    return to_ends;
                }
                (point.minus(self.start).dot(chord.left()) / chord.length()).abs()
            }
            Bend::Round { centre, radius, .. } => {
                if self.spans(point) {
                    (point.minus(centre).length() - radius).abs()
                } else {
                    to_ends
                }
            }
        }
    }

    /// Whether the projection of a point onto the circle lies on the arc.
    fn spans(&self, point: Vector) -> bool {
        let Bend::Round { centre, clockwise, .. } = self.bend else { return false };
        let angle = |point: Vector| {
            let angle = angle::of(point.x - centre.x, point.y - centre.y);
            if clockwise { -angle } else { angle }
        };
        let from_start = |degrees: f64| (degrees - angle(self.start)).rem_euclid(360.0);
        from_start(angle(point)) <= from_start(angle(self.end))
    }

    /// The piece as the geometry of an entity; `None` if it has no length.
    pub(crate) fn geometry(&self, z: f64) -> Option<Geometry> {
        let point = |vector: Vector| Point3 { x: vector.x, y: vector.y, z };
        if self.start == self.end {
            return None;
        }
        Some(match self.bend {
            Bend::Straight => Geometry::Line(Line { start: point(self.start), end: point(self.end) }),
            Bend::Round { centre, radius, clockwise } => Geometry::Arc(Arc {
                centre: point(centre),
                radius,
                start_angle: angle::of(self.start.x - centre.x, self.start.y - centre.y),
                end_angle: angle::of(self.end.x - centre.x, self.end.y - centre.y),
                clockwise,
            }),
        })
    }
}
