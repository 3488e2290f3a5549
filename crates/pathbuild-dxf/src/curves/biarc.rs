//! Two arcs that join without a bend and have given directions at both ends.
//!
//! (The joint is chosen so that both ends are equally far from the corner of their tangents.)

use super::vector::Vector;
use crate::angle;
use crate::{Arc, Geometry, Line, Point3};

/// A point of a curve, and the direction of the curve there, of length 1.
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

/// Arcs whose height over the chord is less (in mm) are lines: their radius would be too large to be accurate.
const FLAT: f64 = 1e-7;

/// The biarc between two rays; `None` where there is none, as between opposite directions along their chord.
pub(crate) fn biarc(from: Ray, to: Ray) -> Option<[CurvePiece; 2]> {
    let chord = to.point.minus(from.point);
    let reach = reach(chord, from.direction, to.direction)?;
    let bend = from.direction.minus(to.direction).times(reach);
    let joint = from.point.plus(to.point).plus(bend).times(0.5);
    let first = piece(from.point, joint, from.direction);
    // Drawn backwards from its end, where its direction is known.
    let second = piece(to.point, joint, to.direction.times(-1.0)).reversed();
    Some([first, second])
}

/// How far the corners of the control polygon are from the ends.
fn reach(chord: Vector, from: Vector, to: Vector) -> Option<f64> {
    let along = chord.dot(from.plus(to));
    let turn = 2.0 * (1.0 - from.dot(to)).max(0.0);
    let square = chord.dot(chord);
    let root = libm::sqrt(along * along + turn * square);
    // The same number both ways; each without the difference of nearly equal numbers.
    let reach = if along > 0.0 { square / (root + along) } else { (root - along) / turn };
    (reach.is_finite() && reach > 0.0).then_some(reach)
}

/// The arc from a point in a direction to another point.
fn piece(start: Vector, end: Vector, direction: Vector) -> CurvePiece {
    let chord = end.minus(start);
    let aside = chord.dot(direction.left());
    let square = chord.dot(chord);
    // The height over the chord is about a quarter of how far the end is aside of the tangent.
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

    /// How far a point is from it.
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

    /// Whether the foot of a point on the circle is on the arc.
    fn spans(&self, point: Vector) -> bool {
        let Bend::Round { centre, clockwise, .. } = self.bend else { return false };
        let angle = |point: Vector| {
            let angle = angle::of(point.x - centre.x, point.y - centre.y);
            if clockwise { -angle } else { angle }
        };
        let from_start = |degrees: f64| (degrees - angle(self.start)).rem_euclid(360.0);
        from_start(angle(point)) <= from_start(angle(self.end))
    }

    /// As an entity's shape; `None` when it has no length.
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
