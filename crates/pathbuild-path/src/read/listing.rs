//! Lists the element of each text, for display. (book: language/parameter-texts)

use std::collections::BTreeMap;

use pathbuild_diagnostic::{ElementId, EntityKind};
use pathbuild_dxf::{Drawing, Entity};

use super::collect::{self, PathCollector};
use super::texts::Match;
use crate::element::Shape;
use crate::names::PathName;
use crate::raw::{Language, Position};
use crate::text_circle::TextCircle;

/// A text on a path layer, with its elements.
#[derive(Clone, Debug, PartialEq)]
pub struct AssignedText {
    /// The text with `%%` codes replaced and line ends kept.
    pub text: Box<str>,
    /// TEXT or MTEXT.
    pub entity: EntityKind,
    /// The path.
    pub path: PathName,
    /// Its layer.
    pub layer: Box<str>,
    /// Its position in the file.
    pub position: Position,
    /// The circle by which it is matched with an element.
    pub circle: TextCircle,
    /// The elements: several for a polyline, none if the text belongs to nothing (PB107).
    pub elements: Vec<AssignedElement>,
}

/// An element with a text.
#[derive(Clone, Debug, PartialEq)]
pub struct AssignedElement {
    /// Its type in the file.
    pub entity: EntityKind,
    /// The name of its line type.
    pub line_type: Box<str>,
    /// Its position in the file.
    pub position: Position,
    /// The drawn shape.
    pub shape: Shape,
}

/// The texts on the path layers of a drawing, in file order.
pub fn assigned_texts(drawing: &Drawing, language: &Language) -> Vec<AssignedText> {
    let entities = entities_by_path(drawing, language);
    let mut texts: Vec<AssignedText> = Vec::new();
    for path in collect::paths(drawing, language) {
        let PathCollector { name, map, texts: found, .. } = path;
        let Some(entities) = entities.get(&name) else { continue };
        let at = |id: ElementId| map.positions()[id.0 as usize];
        texts.extend(found.matched().into_iter().map(|found| assigned(&name, found, entities, &at)));
    }
    texts.sort_by_key(|text| text.position.line);
    texts
}

fn assigned(
    path: &PathName,
    found: Match<'_>,
    entities: &[&Entity],
    at: &impl Fn(ElementId) -> Position,
) -> AssignedText {
    let element = |(id, shape): &(ElementId, Shape)| {
        let entity = entities[id.0 as usize];
        AssignedElement {
            entity: entity.kind,
            line_type: (&*entity.line_type).into(),
            position: at(*id),
            shape: *shape,
        }
    };
    AssignedText {
        text: found.string.into(),
        entity: found.origin.entity,
        path: path.clone(),
        layer: (&*found.origin.layer).into(),
        position: at(found.origin.id),
        circle: found.circle,
        elements: found.owners.iter().map(element).collect(),
    }
}

/// The entities of each path in file order, which is the order of element numbers.
fn entities_by_path<'d>(drawing: &'d Drawing, language: &Language) -> BTreeMap<PathName, Vec<&'d Entity>> {
    let paths = drawing.layers.iter().map(|layer| language.path_pattern.layer(&layer.name));
    let paths: Vec<Option<PathName>> = paths.map(|layer| layer.map(|layer| layer.path)).collect();
    let mut entities: BTreeMap<PathName, Vec<&Entity>> = BTreeMap::new();
    for entity in &drawing.entities {
        if let Some(path) = &paths[entity.layer as usize] {
            entities.entry(path.clone()).or_default().push(entity);
        }
    }
    entities
}
