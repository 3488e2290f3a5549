//! Lists the element of each text, for display, and proxy lines, which are drawn beside the path of a component for copying into projects.
//! (book: language/parameter-texts, book: language/q-projects)

use std::collections::BTreeMap;

use pathbuild_diagnostic::{ElementId, EntityKind, TextFault};
use pathbuild_dxf::{Drawing, Entity, Geometry};

use crate::element::{Origin, Shape, Source};
use crate::geometry::Curve;
use crate::language::Language;
use crate::letter::Letter;
use crate::line_type::LineType;
use crate::names::PathName;
use crate::raw::Position;
use crate::read::candidates::{Candidate, Owner};
use crate::read::collect::{self, PathCollector};
use crate::read::entities::{TextCircle, curve};
use crate::read::texts::{TextMatch, Texts};
use crate::text::{LetterValue, ParameterText, ParameterTexts};

/// A text on a path layer, with its elements.
#[derive(Clone, Debug, PartialEq)]
pub struct AssignedText {
    /// The text with `%%` codes replaced and line ends kept.
    pub text: Box<str>,
    /// Type of the entity: TEXT or MTEXT.
    pub entity: EntityKind,
    /// Name of the path to which the text belongs.
    pub path: PathName,
    /// Name of the text's layer.
    pub layer: Box<str>,
    /// Position of the text in the file.
    pub position: Position,
    /// The circle by which the text is matched with an element.
    pub circle: TextCircle,
    /// The elements: several for a polyline, none if the text belongs to nothing (PB107).
    pub elements: Vec<AssignedElement>,
}

/// An element with a text.
#[derive(Clone, Debug, PartialEq)]
pub struct AssignedElement {
    /// Type of the entity in the file.
    pub entity: EntityKind,
    /// Name of the element's line type.
    pub line_type: Box<str>,
    /// Position of the element in the file.
    pub position: Position,
    /// The drawn shape.
    pub shape: Shape,
}

/// Returns the texts on the path layers of a drawing, in file order.
pub fn assigned_texts(drawing: &Drawing, language: &Language) -> Vec<AssignedText> {
    let entities = entities_by_path(drawing, language);
    let mut texts: Vec<AssignedText> = Vec::new();
    for path in collect::paths(drawing, language) {
        let PathCollector { name, map, texts: found, .. } = path;
        let Some(entities) = entities.get(&name) else { continue };
        let at = |id: ElementId| map.positions()[id.0 as usize];
        texts.extend(found.match_texts().into_iter().map(|found| assigned_text(&name, found, entities, &at)));
    }
    texts.sort_by_key(|text| text.position.line);
    texts
}

fn assigned_text(
    path: &PathName,
    found: TextMatch<'_>,
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

/// Returns the entities of each path in file order, which is the order of element numbers.
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

/// A DASHDOT line or arc with the text of a subpath, on a layer that is not a path layer.
#[derive(Clone, Debug, PartialEq)]
pub struct ProxyLine {
    /// The line or arc. Its number belongs to no path; use `position`.
    pub origin: Origin,
    /// Position of the line or arc in the file.
    pub position: Position,
    /// The drawn curve.
    pub curve: Curve,
    /// The text, which contains a `>`.
    text: ParameterTexts,
}

impl ProxyLine {
    /// The parameter text of the line.
    pub fn text(&self) -> ParameterText<'_> {
        self.text.first().unwrap_or_default()
    }

    /// Returns the path that the line represents; `None` if `>` is not followed by a path name.
    pub fn name(&self, language: &Language) -> Option<PathName> {
        let (value, _) = self.value(Letter::Embed)?;
        language.path_pattern.first_in(value).map(|(name, _)| name).filter(|name| !name.is_part_of(value))
    }

    /// Returns the value of a letter. `None` if it refers to variables, which belong to the project that the line is copied into.
    pub fn value(&self, letter: Letter) -> Option<(&str, TextFault)> {
        self.value_of_piece(self.text().piece(letter)?)
    }

    /// The values that the line sets, each with its variable and its place in the text.
    pub fn variables(&self) -> impl Iterator<Item = (char, &str, TextFault)> {
        let pieces = self.text().pieces().iter().filter(|piece| piece.letter == Some(Letter::Variable));
        pieces.filter_map(|piece| {
            let (value, fault) = self.value_of_piece(piece)?;
            let mut value = value.chars();
            Some((value.next()?, value.as_str(), fault))
        })
    }

    /// Returns the value of a piece and its place in the text; `None` if it refers to variables.
    fn value_of_piece(&self, piece: &LetterValue) -> Option<(&str, TextFault)> {
        let value = self.text().value(piece);
        (!value.contains('=')).then(|| (value, self.text().fault(piece)))
    }
}

/// Returns the proxy lines of a drawing in file order. The drawing must contain all layers; other texts and lines are ignored.
pub fn proxy_lines(drawing: &Drawing, language: &Language) -> Vec<ProxyLine> {
    let is_path: Vec<bool> =
        drawing.layers.iter().map(|layer| language.path_pattern.is_layer(&layer.name)).collect();
    let (mut texts, mut curves) = (Texts::default(), BTreeMap::new());
    for layer in &drawing.layers {
        texts.add_layer(&layer.name);
    }
    for (id, entity) in (0_u32..).map(ElementId).zip(&drawing.entities) {
        if is_path[entity.layer as usize] {
            continue;
        }
        let source = Source { id, entity: entity.kind, layer: entity.layer };
        match &entity.geometry {
            Geometry::Text(text) if is_subpath(&text.string) => {
                texts.add_text(text, source);
            }
            Geometry::MText(text) if is_subpath(&text.plain) => {
                texts.add_mtext(text, source);
            }
            _ => {
                let Some(curve) = dash_dotted_curve(entity, language) else { continue };
                let shape = Shape::Curve(curve);
                let group = entity.group;
                let candidate = Candidate { id, shape, group, owner: Owner::Faulty, is_taken: false };
                texts.add_candidate(entity.layer, candidate);
                curves.insert(id, (texts.origin(source, curve.start()), curve));
            }
        }
    }
    let with_text = texts.match_texts().into_iter().filter_map(|found| {
        let (id, _) = found.owners.first()?;
        let (origin, curve) = curves.remove(id)?;
        let position = *drawing.origins.get(id.0 as usize)?;
        Some(ProxyLine { origin, position, curve, text: (&*found.string).into() })
    });
    let mut lines: Vec<ProxyLine> = with_text.collect();
    lines.sort_by_key(|line| line.origin.id);
    lines
}

fn is_subpath(text: &str) -> bool {
    ParameterTexts::from(text).first().is_some_and(|text| text.piece(Letter::Embed).is_some())
}

fn dash_dotted_curve(entity: &Entity, language: &Language) -> Option<Curve> {
    if LineType::of(&entity.line_type, &language.line_types) != Some(LineType::Dashdot) {
        return None;
    }
    curve(&entity.geometry)
}
