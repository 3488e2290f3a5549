//! Shapes on layers without a path.

use pathbuild_dxf::{Drawing, Entity, Geometry};
use pathbuild_path::{Arc, Curve, TextCircle, Xy};

use super::drawn::{curve_shape, pair};
use crate::scene::{OtherShape, Shape};

/// The shapes of a drawing that was read without its path layers.
pub fn other_layers(drawing: &Drawing) -> Vec<OtherShape> {
    drawing.entities.iter().map(|entity| other(drawing, entity)).collect()
}

fn other(drawing: &Drawing, entity: &Entity) -> OtherShape {
    let layer = drawing.layers[entity.layer as usize].name.to_string();
    let text = |circle: TextCircle, text: &str, height, rotation| OtherShape::Text {
        layer: layer.clone(),
        text: text.to_owned(),
        at: pair(circle.centre),
        height,
        rotation,
    };
    match &entity.geometry {
        Geometry::Line(line) => {
            let [from, to] = [line.start, line.end].map(|end| [end.x, end.y]);
            OtherShape::Shape { layer, shape: Shape::Line { from, to } }
        }
        Geometry::Arc(arc) => {
            let centre = Xy::new(arc.centre.x, arc.centre.y);
            let arc = Arc::from_angles(centre, arc.radius, arc.start_angle, arc.end_angle, arc.clockwise);
            OtherShape::Shape { layer, shape: curve_shape(&Curve::Arc(arc)) }
        }
        Geometry::Circle(circle) => {
            let centre = [circle.centre.x, circle.centre.y];
            OtherShape::Shape { layer, shape: Shape::Circle { centre, radius: circle.radius } }
        }
        Geometry::Text(entity) => {
            text(TextCircle::of_text(entity), &entity.string, entity.height, entity.rotation)
        }
        Geometry::MText(entity) => {
            text(TextCircle::of_mtext(entity), &entity.plain, entity.height, entity.rotation)
        }
    }
}
