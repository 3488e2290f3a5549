use super::cursor::{Cursor, Parsed};
use super::statement::ParsedEntities;
use pathbuild_draw::model::{Attachment, Direction, Entity, Horizontal, MText, Point, Shape, Text, Vertical};

/// Default letter height in mm.
const HEIGHT: f64 = 2.5;

/// `text P "..." [height H] [rotate A] [align ...] [backwards] [upside-down]`
pub(crate) fn text(cursor: &mut Cursor) -> Parsed<ParsedEntities> {
    cursor.keyword("text")?;
    let anchor = cursor.point("the text's anchor")?;
    let value = cursor.string("the text")?;
    let mut text = Text {
        value,
        anchor,
        height: HEIGHT,
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

/// `align [left|centre|right|middle|aligned P|fit P] [baseline|bottom|middle|top]`
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

/// `mtext P "..." [height H] [rotate A | direction X,Y] [align ROW COLUMN] [chunks N] [width W]`
pub(crate) fn mtext(cursor: &mut Cursor) -> Parsed<ParsedEntities> {
    cursor.keyword("mtext")?;
    let anchor = cursor.point("the text's anchor")?;
    let value = cursor.string("the text")?;
    let mut text = MText {
        value,
        anchor,
        height: HEIGHT,
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
