//! Parses parameter texts, modifiers of elements, and texts that belong to no element.

use pathbuild_diagnostic::Handle;

use super::cursor::{Cursor, Parsed, ParsedEntities, choice};
use crate::draw::model::{
    Attachment, Direction, Entity, Horizontal, MText, Note, NoteKind, Orientation, Point, Shape, Text,
    Vertical,
};

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

/// Default letter height in mm.
const LETTER_HEIGHT: f64 = 2.5;

/// Parses `text P "..." [height H] [rotate A] [align ...] [backwards] [upside-down]`.
pub(crate) fn text(cursor: &mut Cursor) -> Parsed<ParsedEntities> {
    cursor.keyword("text")?;
    let anchor = cursor.point("the text's anchor")?;
    let value = cursor.string("the text")?;
    let mut text = Text {
        value,
        anchor,
        height: LETTER_HEIGHT,
        rotation: 0.0,
        horizontal: Horizontal::Left,
        vertical: Vertical::Baseline,
        backwards: false,
        upside_down: false,
    };
    loop {
        if cursor.take("height") {
            text.height = cursor.length("the height of letters")?;
        } else if cursor.take("rotate") {
            text.rotation = cursor.number("an angle in degrees")?;
        } else if cursor.take("align") {
            align(cursor, &mut text)?;
        } else if cursor.take("backwards") {
            text.backwards = true;
        } else if cursor.take("upside-down") {
            text.upside_down = true;
        } else {
            return Ok(drawn(Shape::Text(text), anchor));
        }
    }
}

fn drawn(shape: Shape, at: Point) -> ParsedEntities {
    ParsedEntities { entities: vec![Entity::new(shape)], end: Some(at) }
}

/// Parses `align [left|centre|right|middle|aligned P|fit P] [baseline|bottom|middle|top]`.
fn align(cursor: &mut Cursor, text: &mut Text) -> Parsed<()> {
    let word = cursor.name("an alignment")?;
    text.horizontal = match word.as_str() {
        "left" => Horizontal::Left,
        "centre" => Horizontal::Centre,
        "right" => Horizontal::Right,
        "middle" => Horizontal::Middle,
        "aligned" => Horizontal::Aligned(cursor.point("the text's other end")?),
        "fit" => Horizontal::Fit(cursor.point("the text's other end")?),
        _ => {
            return Err(
                cursor.error(format!("{word:?} is none of left, centre, right, middle, aligned, fit"))
            );
        }
    };
    if let Horizontal::Aligned(other) | Horizontal::Fit(other) = text.horizontal {
        text.rotation = text.anchor.direction(other);
    }
    let vertical = [
        ("baseline", Vertical::Baseline),
        ("bottom", Vertical::Bottom),
        ("middle", Vertical::Middle),
        ("top", Vertical::Top),
    ];
    text.vertical =
        vertical.iter().find(|(word, _)| cursor.take(word)).map_or(Vertical::Baseline, |(_, v)| *v);
    Ok(())
}

/// Parses `mtext P "..." [height H] [rotate A | direction X,Y] [align ROW COLUMN] [chunks N] [width W]`.
pub(crate) fn mtext(cursor: &mut Cursor) -> Parsed<ParsedEntities> {
    cursor.keyword("mtext")?;
    let anchor = cursor.point("the text's anchor")?;
    let value = cursor.string("the text")?;
    let mut text = MText {
        value,
        anchor,
        height: LETTER_HEIGHT,
        attachment: Attachment::TopLeft,
        direction: Direction::Rotation(0.0),
        chunk: None,
        width: 0.0,
    };
    loop {
        if cursor.take("height") {
            text.height = cursor.length("the height of letters")?;
        } else if cursor.take("rotate") {
            text.direction = Direction::Rotation(cursor.number("an angle in degrees")?);
        } else if cursor.take("direction") {
            text.direction = Direction::Vector(cursor.point("the direction of the letters")?);
        } else if cursor.take("align") {
            text.attachment = attachment(cursor)?;
        } else if cursor.take("chunks") {
            text.chunk = Some(cursor.integer("number of characters")?);
        } else if cursor.take("width") {
            text.width = cursor.number("the width of the box")?;
        } else {
            return Ok(drawn(Shape::MText(text), anchor));
        }
    }
}

fn attachment(cursor: &mut Cursor) -> Parsed<Attachment> {
    let row = one_of(cursor, ["top", "middle", "bottom"])?;
    let column = one_of(cursor, ["left", "centre", "right"])?;
    Ok(Attachment::from_row_column(row, column))
}

fn one_of(cursor: &mut Cursor, words: [&str; 3]) -> Parsed<usize> {
    let expected = words.join(", ");
    let word = cursor.name(&expected)?;
    let found = words.iter().position(|known| *known == word);
    found.ok_or_else(|| cursor.error(format!("{word:?} is none of {expected}")))
}

pub(crate) fn note_kind(cursor: &mut Cursor) -> Parsed<NoteKind> {
    choice(cursor, "a kind of text", &[("text", NoteKind::Text), ("mtext", NoteKind::MText)])
}
