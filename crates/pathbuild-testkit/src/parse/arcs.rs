use super::cursor::{Cursor, Parsed};
use super::shapes::{begin, one};
use super::statement::ParsedEntities;
use pathbuild_draw::model::{Arc, Point, Shape};

/// `centre P r R from A to B [cw]`, or `P P` and `r R [cw] [large]`, `via P`, `bulge B` or `centre P [cw]`.
pub(crate) fn arc(cursor: &mut Cursor) -> Parsed<ParsedEntities> {
    if cursor.take("centre") {
        return arc_by_angles(cursor);
    }
    let from = begin(cursor)?;
    let to = cursor.point("where it ends")?;
    let arc = if cursor.take("r") {
        arc_by_radius(cursor, from, to)?
    } else if cursor.take("via") {
        let via = cursor.point("a point on the arc")?;
        through(from, via, to).ok_or_else(|| cursor.error("these three points lie on a straight line"))?
    } else if cursor.take("bulge") {
        let bulge = cursor.number("a bulge")?;
        Arc::bulged(from, to, bulge).ok_or_else(|| cursor.error("this arc is straight or has no length"))?
    } else if cursor.take("centre") {
        let centre = cursor.point("the centre")?;
        directed(
            centre,
            centre.distance(from),
            centre.direction(from),
            centre.direction(to),
            cursor.take("cw"),
        )
    } else {
        cursor.next("r, via, bulge or centre")?;
        return Err(cursor.error("expected r, via, bulge or centre behind the ends of an arc"));
    };
    cursor.base = Some(to);
    Ok(one(Shape::Arc(arc), Some(to)))
}

fn arc_by_angles(cursor: &mut Cursor) -> Parsed<ParsedEntities> {
    let centre = cursor.point("the centre")?;
    cursor.keyword("r")?;
    let radius = cursor.length("the radius")?;
    cursor.keyword("from")?;
    let start = cursor.number("an angle in degrees")?;
    cursor.keyword("to")?;
    let end = cursor.number("an angle in degrees")?;
    let arc = directed(centre, radius, start, end, cursor.take("cw"));
    Ok(one(Shape::Arc(arc), Some(centre.polar(radius, end))))
}

/// A DXF arc, which always runs counterclockwise: the ends of a clockwise one are swapped.
fn directed(centre: Point, radius: f64, from: f64, to: f64, clockwise: bool) -> Arc {
    let (start, end) = if clockwise { (to, from) } else { (from, to) };
    Arc { centre, radius, start, end }
}

fn arc_by_radius(cursor: &mut Cursor, from: Point, to: Point) -> Parsed<Arc> {
    let radius = cursor.length("the radius")?;
    let clockwise = cursor.take("cw");
    let large = cursor.take("large");
    let half = from.distance(to) / 2.0;
    if half == 0.0 || half > radius * (1.0 + 1e-9) {
        return Err(cursor
            .error(format!("no arc of radius {radius} joins these ends, which are {} apart", 2.0 * half)));
    }
    let sagitta = radius - (radius * radius - half * half).max(0.0).sqrt();
    let height = if large { 2.0 * radius - sagitta } else { sagitta };
    let bulge = if clockwise { -height / half } else { height / half };
    Arc::bulged(from, to, bulge).ok_or_else(|| cursor.error("this arc has no length"))
}

/// The arc through three points.
fn through(from: Point, via: Point, to: Point) -> Option<Arc> {
    let (a, b) = (via - from, to - from);
    let cross = a.x * b.y - a.y * b.x;
    let (a2, b2) = (a.x * a.x + a.y * a.y, b.x * b.x + b.y * b.y);
    let centre = from + Point::new(b.y * a2 - a.y * b2, a.x * b2 - b.x * a2) * (0.5 / cross);
    let arc =
        directed(centre, centre.distance(from), centre.direction(from), centre.direction(to), cross < 0.0);
    (cross != 0.0 && arc.radius.is_finite()).then_some(arc)
}
