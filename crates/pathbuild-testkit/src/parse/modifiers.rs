use pathbuild_diagnostic::Handle;

use super::cursor::{Cursor, Parsed};
use super::header::note_kind;
use pathbuild_draw::model::{Entity, Note, Orientation, Point, Shape};

/// Parses the parameter text and the modifiers after an element's shape. They apply to all entities of the line.
pub(crate) fn modifiers(cursor: &mut Cursor, entities: &mut [Entity]) -> Parsed<()> {
    while let Some(token) = cursor.peek() {
        if token.quoted {
            note(cursor, entities)?;
        } else {
            modifier(cursor, entities)?;
        }
    }
    Ok(())
}

fn note(cursor: &mut Cursor, entities: &mut [Entity]) -> Parsed<()> {
    let value = cursor.string("a parameter text")?;
    if entities
        .iter()
        .any(|entity| matches!(entity.shape, Shape::Insert(_) | Shape::Text(_) | Shape::MText(_)))
    {
        return Err(cursor.error("only elements have parameter texts"));
    }
    if entities.iter().any(|entity| entity.note.is_some()) {
        return Err(cursor.error("an element has one text; write a `text` or `mtext` line for a second one"));
    }
    for entity in entities {
        entity.note = Some(Note { value: value.clone(), kind: None, height: None });
    }
    Ok(())
}

fn modifier(cursor: &mut Cursor, entities: &mut [Entity]) -> Parsed<()> {
    let word = cursor.name("a word")?;
    match word.as_str() {
        "as" => {
            let notes = notes(cursor, entities)?;
            let kind = note_kind(cursor)?;
            for note in notes {
                note.kind = Some(kind);
            }
        }
        "height" => {
            let notes = notes(cursor, entities)?;
            let height = cursor.length("the height of letters")?;
            for note in notes {
                note.height = Some(height);
            }
        }
        "z" => {
            let z = cursor.number("a height")?;
            all(entities, |entity| raise(&mut entity.shape, z));
        }
        "mirrored" => all(entities, |entity| entity.orientation = Orientation::Mirrored),
        "normal" => {
            let normal = cursor.point("the normal")?;
            all(entities, |entity| entity.orientation = Orientation::Tilted(normal));
        }
        "paper" => all(entities, |entity| entity.paper = true),
        "invisible" => all(entities, |entity| entity.invisible = true),
        "colour" => {
            let colour = cursor.integer("colour number from 0 to 255")?;
            all(entities, |entity| entity.colour = Some(colour));
        }
        "style" => {
            let style = cursor.name("a text style")?;
            all(entities, |entity| entity.style = Some(style.clone()));
        }
        "layer" => {
            let layer = cursor.name("a layer's name")?;
            all(entities, |entity| entity.layer = Some(layer.clone()));
        }
        "handle" => handle(cursor, entities)?,
        _ => return Err(cursor.error(unexpected(&word))),
    }
    Ok(())
}

fn unexpected(word: &str) -> String {
    format!(
        "{word:?} is not expected here; behind an element may stand its text in quotation marks and as, height, \
         z, mirrored, normal, paper, invisible, colour, style, layer, handle"
    )
}

fn all(entities: &mut [Entity], change: impl Fn(&mut Entity)) {
    entities.iter_mut().for_each(change);
}

fn notes<'a>(cursor: &Cursor, entities: &'a mut [Entity]) -> Parsed<Vec<&'a mut Note>> {
    let notes: Vec<&mut Note> = entities.iter_mut().filter_map(|entity| entity.note.as_mut()).collect();
    if notes.is_empty() { Err(cursor.error("this is said behind the text it is about")) } else { Ok(notes) }
}

fn handle(cursor: &mut Cursor, entities: &mut [Entity]) -> Parsed<()> {
    let text = cursor.name("a handle")?;
    let number = u64::from_str_radix(&text, 16).ok().filter(|number| (1..1 << 60).contains(number));
    match (number, entities) {
        (Some(number), [entity]) => entity.handle = Some(Handle(number)),
        (Some(_), _) => return Err(cursor.error("several entities cannot have the same handle")),
        (None, _) => {
            return Err(cursor.error(format!("{text:?} is no handle; expected a hexadecimal number")));
        }
    }
    Ok(())
}

/// Moves all points of a shape to a height.
fn raise(shape: &mut Shape, z: f64) {
    let points: Vec<&mut Point> = match shape {
        Shape::Line(line) => vec![&mut line.from, &mut line.to],
        Shape::Arc(arc) => vec![&mut arc.centre],
        Shape::Circle(circle) => vec![&mut circle.centre],
        Shape::Polyline(polyline) => polyline.vertices.iter_mut().map(|vertex| &mut vertex.point).collect(),
        Shape::Ellipse(ellipse) => vec![&mut ellipse.centre],
        Shape::Spline(spline) => spline.control.iter_mut().chain(&mut spline.fit).collect(),
        Shape::Insert(insert) => vec![&mut insert.at],
        Shape::Text(text) => vec![&mut text.anchor],
        Shape::MText(text) => vec![&mut text.anchor],
        Shape::Solid(corners) => corners.iter_mut().collect(),
        Shape::Dimension(dimension) => vec![&mut dimension.from, &mut dimension.to, &mut dimension.line],
        Shape::Raw(_) => Vec::new(),
    };
    for point in points {
        point.z = z;
    }
}
