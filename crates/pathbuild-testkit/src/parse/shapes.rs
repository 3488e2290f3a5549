use super::arcs::arc;
use super::cursor::{Cursor, Parsed};
use super::curves::{ellipse, spline};
use super::inserts::{insert, solid};
use super::line_type;
use super::statement::ParsedEntities;
use pathbuild_draw::Draft;
use pathbuild_draw::model::{Circle, Entity, Line, Point, Polyline, PolylineKind, Shape, Vertex};

/// An element: `[VERB] [SHAPE] [LINETYPE] geometry`.
pub(crate) fn shape(cursor: &mut Cursor, draft: &mut Draft) -> Parsed<ParsedEntities> {
    let word = cursor.name("an element")?;
    match word.as_str() {
        "start" => marker(cursor, Entity::start),
        "end" => marker(cursor, Entity::end),
        "turn" => marker(cursor, Entity::turn),
        "probe" => {
            let line_type = line_type::option(cursor, draft)?;
            let drawn = marker(cursor, Entity::probe)?;
            Ok(typed(drawn, line_type.as_deref().unwrap_or("PHANTOM")))
        }
        "mill" => verb(cursor, "CONTINUOUS"),
        "mark" => verb(cursor, "DIVIDE"),
        "bars" => verb(cursor, "BORDER"),
        "subpath" => verb(cursor, "DASHDOT"),
        "skip" => verb(cursor, "DOT"),
        "sweep" => {
            let drawn = verb(cursor, "HIDDEN")?;
            Ok(if cursor.is_at_string() { typed(drawn, "DASHED") } else { drawn })
        }
        "insert" => insert(cursor),
        "solid" => solid(cursor),
        _ => plain(cursor, draft, &word),
    }
}

fn marker(cursor: &mut Cursor, make: fn(Point) -> Entity) -> Parsed<ParsedEntities> {
    let at = cursor.point("the marker's centre")?;
    Ok(ParsedEntities { entities: vec![make(at)], end: Some(at) })
}

fn typed(mut drawn: ParsedEntities, line_type: &str) -> ParsedEntities {
    let is_by_layer = line_type.eq_ignore_ascii_case("BYLAYER");
    for entity in &mut drawn.entities {
        entity.line_type = (!is_by_layer).then(|| line_type.to_owned());
    }
    drawn
}

/// A shape whose line type follows from the verb. The default shape is a line.
fn verb(cursor: &mut Cursor, line_type: &str) -> Parsed<ParsedEntities> {
    let shape =
        ["line", "arc", "circle", "polyline", "ellipse", "spline"].into_iter().find(|word| cursor.take(word));
    geometry(cursor, shape.unwrap_or("line")).map(|drawn| typed(drawn, line_type))
}

/// A shape with its line type; the default is CONTINUOUS.
fn plain(cursor: &mut Cursor, draft: &mut Draft, word: &str) -> Parsed<ParsedEntities> {
    if !matches!(word, "line" | "arc" | "circle" | "polyline" | "ellipse" | "spline") {
        return Err(cursor.error(format!("{word:?} is no element and no option")));
    }
    let line_type = line_type::option(cursor, draft)?;
    if line_type.is_none() && is_unknown_line_type(cursor) {
        line_type::expect(cursor, draft)?;
    }
    geometry(cursor, word).map(|drawn| typed(drawn, line_type.as_deref().unwrap_or("CONTINUOUS")))
}

fn is_unknown_line_type(cursor: &Cursor) -> bool {
    let keywords = ["to", "centre", "control", "fit", "heavy", "spatial", "degree"];
    !cursor.is_at_number() && cursor.peek_word().is_some_and(|word| !keywords.contains(&word))
}

fn geometry(cursor: &mut Cursor, shape: &str) -> Parsed<ParsedEntities> {
    match shape {
        "arc" => arc(cursor),
        "circle" => circle(cursor),
        "polyline" => polyline(cursor),
        "ellipse" => ellipse(cursor),
        "spline" => spline(cursor),
        _ => lines(cursor),
    }
}

pub(crate) fn one(shape: Shape, end: Option<Point>) -> ParsedEntities {
    ParsedEntities { entities: vec![Entity::new(shape)], end }
}

/// The start of a line or arc: a point, or `to` for the end of the previous element.
pub(crate) fn begin(cursor: &mut Cursor) -> Parsed<Point> {
    if cursor.take("to") {
        let last = cursor.base;
        return last.ok_or_else(|| cursor.error("nothing was drawn before this that `to` could go on from"));
    }
    let from = cursor.point("where it begins")?;
    cursor.take("to");
    Ok(from)
}

/// `P P [P ...]` or `to P [P ...]`: a line between consecutive points.
fn lines(cursor: &mut Cursor) -> Parsed<ParsedEntities> {
    let mut from = begin(cursor)?;
    let mut entities = Vec::new();
    while cursor.is_at_number() || entities.is_empty() {
        let to = cursor.point("where it ends")?;
        entities.push(Entity::new(Shape::Line(Line { from, to })));
        from = to;
    }
    Ok(ParsedEntities { entities, end: Some(from) })
}

/// `P d D` or `P r R`
fn circle(cursor: &mut Cursor) -> Parsed<ParsedEntities> {
    let centre = cursor.point("the centre")?;
    let radius = if cursor.take("r") {
        cursor.length("the radius")?
    } else {
        cursor.keyword("d")?;
        cursor.length("the diameter")? / 2.0
    };
    Ok(one(Shape::Circle(Circle { centre, radius }), Some(centre)))
}

/// `[heavy|spatial] P [bulge B] P ... [closed]`
fn polyline(cursor: &mut Cursor) -> Parsed<ParsedEntities> {
    let kind = if cursor.take("heavy") {
        PolylineKind::Heavy
    } else if cursor.take("spatial") {
        PolylineKind::Spatial
    } else {
        PolylineKind::Light
    };
    let mut vertices = Vec::new();
    while cursor.is_at_number() || vertices.is_empty() {
        let point = cursor.point("a corner")?;
        let bulge = if cursor.take("bulge") { cursor.number("a bulge")? } else { 0.0 };
        vertices.push(Vertex { point, bulge });
    }
    let closed = cursor.take("closed");
    let end = if closed { vertices.first() } else { vertices.last() }.map(|vertex| vertex.point);
    Ok(one(Shape::Polyline(Polyline { kind, vertices, closed }), end))
}
