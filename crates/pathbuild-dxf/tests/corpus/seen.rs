//! A common representation of entities for both readers.

use std::collections::BTreeMap;

use pathbuild_dxf::{Drawing, Entity, Geometry, HorizontalAlign, MText, Origin, Text, VerticalAlign};

/// The layers of a drawing by upper-case name, with whether each is frozen or off.
pub(crate) type SeenLayers = BTreeMap<String, bool>;

/// An entity in world coordinates.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Seen {
    pub(crate) kind: String,
    /// Name of the layer in upper case.
    pub(crate) layer: String,
    /// Name of the resolved line type in upper case.
    pub(crate) line_type: String,
    /// Handle of the entity; empty if it has none.
    pub(crate) handle: String,
    /// The string of a text; for an MTEXT, followed by its plain text.
    pub(crate) texts: Vec<String>,
    pub(crate) numbers: Vec<f64>,
}

/// Maximum difference between numbers that are considered equal. The oracle gives nine decimals.
const NEAR: f64 = 2e-9;

impl Seen {
    /// Returns the name of a property that differs; `None` if the entities are equal.
    pub(crate) fn difference(&self, other: &Self) -> Option<&'static str> {
        let is_near = |(a, b): (&f64, &f64)| b.is_nan() || (a - b).abs() <= NEAR + 1e-15 * a.abs();
        if self.kind != other.kind || self.numbers.len() != other.numbers.len() {
            return Some("kind");
        }
        if !self.handle.is_empty() && !self.handle.eq_ignore_ascii_case(&other.handle) {
            return Some("handle");
        }
        if !self.numbers.iter().zip(&other.numbers).all(is_near) {
            return Some("numbers");
        }
        if self.texts != other.texts {
            return Some("text");
        }
        if self.layer != other.layer {
            return Some("layer");
        }
        (self.line_type != other.line_type).then_some("line type")
    }
}

/// Returns the entities directly in ENTITIES, without parts of polylines, curves or blocks.
pub(crate) fn of_drawing(drawing: &Drawing, is_inserted: impl Fn(u32) -> bool) -> Vec<Seen> {
    let all = drawing.entities.iter().zip(&drawing.origins);
    let own = all.filter(|(entity, origin)| entity.group.is_none() && !is_inserted(origin.line));
    own.map(|(entity, origin)| seen(drawing, entity, *origin)).collect()
}

pub(crate) fn layers_of(drawing: &Drawing) -> SeenLayers {
    drawing.layers.iter().map(|layer| (layer.name.to_uppercase(), layer.hidden)).collect()
}

fn seen(drawing: &Drawing, entity: &Entity, origin: Origin) -> Seen {
    let (texts, numbers) = match &entity.geometry {
        Geometry::Line(it) => {
            (vec![], vec![it.start.x, it.start.y, it.start.z, it.end.x, it.end.y, it.end.z])
        }
        Geometry::Circle(it) => (vec![], vec![it.centre.x, it.centre.y, it.centre.z, it.radius]),
        Geometry::Arc(it) => {
            let [x, y, z] = [it.centre.x, it.centre.y, it.centre.z];
            (
                vec![],
                vec![x, y, z, it.radius, it.start_angle, it.end_angle, f64::from(u8::from(it.clockwise))],
            )
        }
        Geometry::Text(it) => (vec![it.string.to_string()], text(it)),
        Geometry::MText(it) => (vec![with_signs(&it.plain)], mtext(it)),
    };
    Seen {
        kind: entity.kind.name().to_owned(),
        layer: drawing.layers[entity.layer as usize].name.to_uppercase(),
        line_type: entity.line_type.to_string(),
        handle: origin.handle.map(|handle| handle.to_string()).unwrap_or_default(),
        texts,
        numbers,
    }
}

fn text(text: &Text) -> Vec<f64> {
    let horizontal = match text.horizontal {
        HorizontalAlign::Left => 0.0,
        HorizontalAlign::Centre => 1.0,
        HorizontalAlign::Right => 2.0,
    };
    let vertical = match text.vertical {
        VerticalAlign::Baseline => 0.0,
        VerticalAlign::Bottom => 1.0,
        VerticalAlign::Middle => 2.0,
        VerticalAlign::Top => 3.0,
    };
    let backwards = f64::from(u8::from(text.backwards));
    vec![
        text.anchor.x,
        text.anchor.y,
        text.height,
        text.rotation.rem_euclid(360.0),
        horizontal,
        vertical,
        backwards,
    ]
}

fn mtext(text: &MText) -> Vec<f64> {
    let column = match text.horizontal {
        HorizontalAlign::Left => 1.0,
        HorizontalAlign::Centre => 2.0,
        HorizontalAlign::Right => 3.0,
    };
    let row = match text.vertical {
        VerticalAlign::Top => 0.0,
        VerticalAlign::Middle => 3.0,
        VerticalAlign::Bottom | VerticalAlign::Baseline => 6.0,
    };
    vec![text.anchor.x, text.anchor.y, row + column, text.height, text.rotation]
}

/// Replaces codes by characters, as in ezdxf's plain text.
fn with_signs(plain: &str) -> String {
    plain.replace("%%c", "Ø").replace("%%d", "°").replace("%%p", "±")
}
