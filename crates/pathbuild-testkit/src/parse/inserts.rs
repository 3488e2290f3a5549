use super::cursor::{Cursor, Parsed};
use super::shapes::one;
use super::statement::ParsedEntities;
use pathbuild_draw::model::{Insert, Point, Shape};

/// `insert NAME at P [scale S | scale X,Y] [rotate A] [columns N DX] [rows N DY]`
pub(crate) fn insert(cursor: &mut Cursor) -> Parsed<ParsedEntities> {
    let block = cursor.name("a block's name")?;
    cursor.keyword("at")?;
    let at = cursor.point("where the block goes")?;
    let mut insert = Insert {
        block,
        at,
        scale: Point::new(1.0, 1.0).at(1.0),
        rotation: 0.0,
        count: (1, 1),
        spacing: (0.0, 0.0),
    };
    loop {
        if cursor.take("scale") {
            insert.scale = scale(cursor)?;
        } else if cursor.take("rotate") {
            insert.rotation = cursor.number("an angle in degrees")?;
        } else if cursor.take("columns") {
            insert.count.0 = cursor.integer("number of columns")?;
            insert.spacing.0 = cursor.number("the distance of columns")?;
        } else if cursor.take("rows") {
            insert.count.1 = cursor.integer("number of rows")?;
            insert.spacing.1 = cursor.number("the distance of rows")?;
        } else {
            return Ok(one(Shape::Insert(insert), Some(at)));
        }
    }
}

fn scale(cursor: &mut Cursor) -> Parsed<Point> {
    if cursor.peek_word().is_some_and(|word| word.contains(',')) {
        return cursor.point("the factors in x and y").map(|factors| factors.at(1.0));
    }
    cursor.number("a factor").map(|factor| Point::new(factor, factor).at(factor))
}

/// `P P P [P]`
pub(crate) fn solid(cursor: &mut Cursor) -> Parsed<ParsedEntities> {
    let corners = cursor.points("a corner")?;
    let corners = match corners[..] {
        [a, b, c] => [a, b, c, c],
        [a, b, c, d] => [a, b, c, d],
        _ => return Err(cursor.error("a solid has three or four corners")),
    };
    Ok(one(Shape::Solid(corners), Some(corners[3])))
}
