//! Hints for a path that breaks off: nearby ends on other layers, searched only in that case.

use std::cell::OnceCell;

use pathbuild_diagnostic::messages::walk as messages;
use pathbuild_diagnostic::{Code, Diagnostic, EntityKind, Number, Point};
use pathbuild_dxf::{Drawing, Geometry};
use pathbuild_path::{PathName, PathPattern, Xy, on_circle};

/// The ends of all lines and arcs of a drawing. The drawing is read again when they are first needed.
pub(super) struct LayerEnds<'a> {
    /// Reads all layers of the drawing.
    read: &'a dyn Fn() -> Drawing,
    ends: OnceCell<Vec<LayerEnd>>,
}

/// An end of a line or arc on any layer.
struct LayerEnd {
    layer: Box<str>,
    kind: EntityKind,
    point: Point,
}

/// Largest distance in mm at which an end on another layer is worth a hint.
const WORTH_NAMING: f64 = 1.0;

impl<'a> LayerEnds<'a> {
    pub(super) fn new(read: &'a dyn Fn() -> Drawing) -> Self {
        Self { read, ends: OnceCell::new() }
    }

    /// Adds the nearest end on another layer to PB401. A line on the wrong layer is its second most frequent cause.
    pub(super) fn with_hint(
        &self,
        path: &PathName,
        pattern: &PathPattern,
        diagnostic: Diagnostic,
    ) -> Diagnostic {
        if diagnostic.code() != Code::NothingContinues {
            return diagnostic;
        }
        let Some(point) = diagnostic.place.point else { return diagnostic };
        let ends = self.ends.get_or_init(|| all_ends(&(self.read)()));
        let is_other = |end: &&LayerEnd| pattern.layer(&end.layer).is_none_or(|layer| layer.path != *path);
        let distances = ends.iter().filter(is_other).map(|end| (end, distance(end.point, point)));
        let nearest = distances.reduce(|best, other| if other.1 < best.1 { other } else { best });
        match nearest {
            Some((end, distance)) if distance <= WORTH_NAMING => diagnostic.note(
                &messages::END_ON_OTHER_LAYER,
                vec![
                    ("layer", (&*end.layer).into()),
                    ("element", end.kind.name().into()),
                    ("point", end.point.into()),
                    ("distance", distance.into()),
                ],
            ),
            _ => diagnostic,
        }
    }
}

fn all_ends(drawing: &Drawing) -> Vec<LayerEnd> {
    let mut ends = Vec::new();
    for entity in &drawing.entities {
        let layer = &drawing.layers[entity.layer as usize].name;
        let mut add = |point: Xy| {
            ends.push(LayerEnd {
                layer: layer.clone(),
                kind: entity.kind,
                point: Point::new(point.x, point.y),
            });
        };
        match &entity.geometry {
            Geometry::Line(line) => {
                add(Xy::new(line.start.x, line.start.y));
                add(Xy::new(line.end.x, line.end.y));
            }
            Geometry::Arc(arc) => {
                let centre = Xy::new(arc.centre.x, arc.centre.y);
                add(on_circle(centre, arc.radius, arc.start_angle));
                add(on_circle(centre, arc.radius, arc.end_angle));
            }
            Geometry::Circle(_) | Geometry::Text(_) | Geometry::MText(_) => {}
        }
    }
    ends
}

fn distance(a: Point, b: Point) -> f64 {
    let difference = |Number(a): Number, Number(b): Number| a - b;
    Xy::new(difference(a.x, b.x), difference(a.y, b.y)).coords.norm()
}
