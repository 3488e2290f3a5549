//! How the shape of an element changed.

use nalgebra::Vector2;

use crate::element::Shape;
use crate::geometry::{Arc, Curve, Xy};

/// A change of a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ShapeChange {
    /// The same shape elsewhere.
    Moved([f64; 2]),
    /// One end is elsewhere.
    EndMoved([f64; 2]),
    /// The radius before and after.
    Radius([f64; 2]),
    /// Anything else.
    Reshaped,
}

/// Difference in mm up to which places and lengths are equal. CAD programs write at least four decimals.
pub(super) const SAME: f64 = 1e-4;

/// The changes from one shape to another, which is expected to be shifted. Their drawn direction does not matter.
pub(super) fn shape_changes(
    old: &Shape,
    new: &Shape,
    shift: Vector2<f64>,
) -> impl Iterator<Item = ShapeChange> + use<> {
    let changes = match (old, new) {
        (
            Shape::Circle { centre: old_centre, radius: old },
            Shape::Circle { centre: new_centre, radius: new },
        ) => {
            let radius = (!is_same(*old, *new)).then_some(ShapeChange::Radius([*old, *new]));
            [radius, moved(new_centre - old_centre - shift)]
        }
        (Shape::Curve(old), Shape::Curve(new)) => [curve_change(old, new, shift), None],
        _ => [Some(ShapeChange::Reshaped), None],
    };
    changes.into_iter().flatten()
}

/// Whether the shapes are equal up to rounding.
pub(super) fn is_equal(old: &Shape, new: &Shape, shift: Vector2<f64>) -> bool {
    shape_changes(old, new, shift).next().is_none()
}

fn moved(by: Vector2<f64>) -> Option<ShapeChange> {
    (!is_nothing(by)).then(|| ShapeChange::Moved(by.into()))
}

fn curve_change(old: &Curve, new: &Curve, shift: Vector2<f64>) -> Option<ShapeChange> {
    let new = alike(old, new, shift);
    let ends @ [first, second] = [new.start() - old.start() - shift, new.end() - old.end() - shift];
    match (old, new) {
        (Curve::Line(_), Curve::Line(_)) => ends_moved(first, second),
        (Curve::Arc(old), Curve::Arc(new)) => arc_change(old, &new, shift, ends),
        _ => Some(ShapeChange::Reshaped),
    }
}

fn ends_moved(first: Vector2<f64>, second: Vector2<f64>) -> Option<ShapeChange> {
    match (is_nothing(first), is_nothing(second)) {
        (true, true) => None,
        _ if is_nothing(first - second) => Some(ShapeChange::Moved(first.into())),
        (true, false) => Some(ShapeChange::EndMoved(second.into())),
        (false, true) => Some(ShapeChange::EndMoved(first.into())),
        (false, false) => Some(ShapeChange::Reshaped),
    }
}

/// The change of an arc to one in the same direction, whose centre and ends determine it.
fn arc_change(
    old: &Arc,
    new: &Arc,
    shift: Vector2<f64>,
    [first, second]: [Vector2<f64>; 2],
) -> Option<ShapeChange> {
    let centre = new.centre - old.centre - shift;
    let has_same_ends = is_nothing(first) && is_nothing(second);
    if !is_same(old.radius, new.radius) {
        let is_concentric = is_nothing(centre);
        let radii = [old.radius, new.radius];
        return Some(if is_concentric || has_same_ends {
            ShapeChange::Radius(radii)
        } else {
            ShapeChange::Reshaped
        });
    }
    match ends_moved(first, second) {
        Some(ShapeChange::Moved(by)) if is_nothing(centre - first) => Some(ShapeChange::Moved(by)),
        change @ (None | Some(ShapeChange::EndMoved(_))) if is_nothing(centre) => change,
        _ => Some(ShapeChange::Reshaped),
    }
}

/// The new curve in the direction of the old one: that of its turn for arcs, and that in which its ends are nearer for lines.
fn alike(old: &Curve, new: &Curve, shift: Vector2<f64>) -> Curve {
    let distance = |curve: &Curve| {
        (curve.start() - old.start() - shift).norm() + (curve.end() - old.end() - shift).norm()
    };
    let reversed = new.reversed();
    let is_reversed = match (old, new) {
        (Curve::Arc(old), Curve::Arc(new)) => old.clockwise != new.clockwise,
        _ => distance(&reversed) < distance(new),
    };
    if is_reversed { reversed } else { *new }
}

/// The middle between the ends, or the centre: the same in either direction.
pub(super) fn middle(shape: &Shape) -> Xy {
    match shape {
        Shape::Circle { centre, .. } => *centre,
        Shape::Curve(curve) => nalgebra::center(&curve.start(), &curve.end()),
    }
}

fn is_same(old: f64, new: f64) -> bool {
    (new - old).abs() <= SAME
}

pub(super) fn is_nothing(by: Vector2<f64>) -> bool {
    by.norm() <= SAME
}
