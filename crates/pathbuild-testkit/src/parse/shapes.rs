//! The shapes of elements, and their line types.

use super::cursor::{Cursor, Parsed, ParsedEntities};
use crate::draw::model::{
    Arc, Circle, Ellipse, Entity, Insert, Line, Point, Polyline, PolylineKind, Shape, Spline, Vertex,
    arc_of_bulge,
};
use crate::draw::{Draft, LINE_TYPES};

/// Parses an element: `[VERB] [SHAPE] [LINETYPE] geometry`.
pub(crate) fn shape(cursor: &mut Cursor, draft: &mut Draft) -> Parsed<ParsedEntities> {
    let word = cursor.name("an element")?;
    match word.as_str() {
        "start" => marker(cursor, Entity::start),
        "end" => marker(cursor, Entity::end),
        "turn" => marker(cursor, Entity::turn),
        "probe" => {
            let line_type = line_type(cursor, draft)?;
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

/// Parses a shape that gets the line type of its verb. The default shape is a line.
fn verb(cursor: &mut Cursor, line_type: &str) -> Parsed<ParsedEntities> {
    let shape =
        ["line", "arc", "circle", "polyline", "ellipse", "spline"].into_iter().find(|word| cursor.take(word));
    geometry(cursor, shape.unwrap_or("line")).map(|drawn| typed(drawn, line_type))
}

/// Parses a shape with its line type; the default is CONTINUOUS.
fn plain(cursor: &mut Cursor, draft: &mut Draft, word: &str) -> Parsed<ParsedEntities> {
    if !matches!(word, "line" | "arc" | "circle" | "polyline" | "ellipse" | "spline") {
        return Err(cursor.error(format!("{word:?} is no element and no option")));
    }
    let line_type = line_type(cursor, draft)?;
    if line_type.is_none() && is_unknown_line_type(cursor) {
        required_line_type(cursor, draft)?;
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

/// Parses the start of a line or arc: a point, or `to` for the end of the previous element.
pub(crate) fn begin(cursor: &mut Cursor) -> Parsed<Point> {
    if cursor.take("to") {
        let last = cursor.base;
        return last.ok_or_else(|| cursor.error("nothing was drawn before this that `to` could go on from"));
    }
    let from = cursor.point("where it begins")?;
    cursor.take("to");
    Ok(from)
}

/// Parses `P P [P ...]` or `to P [P ...]`: lines between consecutive points.
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

/// Parses `P d D` or `P r R`: a circle by its centre and diameter or radius.
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

/// Parses `[heavy|spatial] P [bulge B] P ... [closed]`.
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

/// Parses `centre P r R from A to B [cw]`, or `P P` followed by one of `r R [cw] [large]`, `via P`, `bulge B` and
/// `centre P [cw]`.
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
        arc_of_bulge(from, to, bulge).ok_or_else(|| cursor.error("this arc is straight or has no length"))?
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

/// Creates a DXF arc, which always runs counterclockwise: the ends of a clockwise arc are swapped.
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
    arc_of_bulge(from, to, bulge).ok_or_else(|| cursor.error("this arc has no length"))
}

/// Returns the arc through three points; `None` if they lie on a line.
fn through(from: Point, via: Point, to: Point) -> Option<Arc> {
    let (a, b) = (via - from, to - from);
    let cross = a.x * b.y - a.y * b.x;
    let (a2, b2) = (a.x * a.x + a.y * a.y, b.x * b.x + b.y * b.y);
    let centre = from + Point::new(b.y * a2 - a.y * b2, a.x * b2 - b.x * a2) * (0.5 / cross);
    let arc =
        directed(centre, centre.distance(from), centre.direction(from), centre.direction(to), cross < 0.0);
    (cross != 0.0 && arc.radius.is_finite()).then_some(arc)
}

/// Parses `centre P major X,Y ratio R [from A to B]`.
pub(crate) fn ellipse(cursor: &mut Cursor) -> Parsed<ParsedEntities> {
    cursor.keyword("centre")?;
    let centre = cursor.point("the centre")?;
    cursor.keyword("major")?;
    cursor.base = Some(Point::default());
    let major = cursor.point("the longer half axis as a vector")?;
    cursor.keyword("ratio")?;
    let ratio = cursor.length("the ratio of the axes")?;
    let (start, end) = if cursor.take("from") {
        let start = cursor.number("an angle in degrees")?;
        cursor.keyword("to")?;
        (start, cursor.number("an angle in degrees")?)
    } else {
        (0.0, 360.0)
    };
    Ok(one(Shape::Ellipse(Ellipse { centre, major, ratio, start, end }), Some(centre)))
}

/// Parses `[degree N] control P ... [knots K ...] [weights W ...] [closed]` or `fit P ...`.
pub(crate) fn spline(cursor: &mut Cursor) -> Parsed<ParsedEntities> {
    let degree = if cursor.take("degree") { cursor.integer("degree")? } else { 3 };
    let mut spline = Spline {
        degree,
        control: Vec::new(),
        knots: Vec::new(),
        weights: Vec::new(),
        fit: Vec::new(),
        closed: false,
    };
    if cursor.take("fit") {
        spline.fit = cursor.points("a point on the curve")?;
    } else {
        cursor.keyword("control")?;
        spline.control = cursor.points("a control point")?;
        let least = usize::from(degree) + 1;
        if spline.control.len() < least {
            return Err(
                cursor.error(format!("a spline of degree {degree} needs at least {least} control points"))
            );
        }
        spline.knots = clamped_knots(spline.control.len(), usize::from(degree));
    }
    if cursor.take("knots") {
        spline.knots = numbers(cursor, "a knot")?;
    }
    if cursor.take("weights") {
        spline.weights = numbers(cursor, "a weight")?;
    }
    spline.closed = cursor.take("closed");
    let end = spline.control.last().or(spline.fit.last()).copied();
    Ok(one(Shape::Spline(spline), end))
}

fn numbers(cursor: &mut Cursor, what: &str) -> Parsed<Vec<f64>> {
    let mut numbers = Vec::new();
    while cursor.is_at_number() {
        numbers.push(cursor.number(what)?);
    }
    Ok(numbers)
}

/// Returns the knots of a curve that begins and ends at its outer control points.
fn clamped_knots(control: usize, degree: usize) -> Vec<f64> {
    let spans = control - degree;
    (0..=control + degree).map(|index| index.saturating_sub(degree).min(spans) as f64).collect()
}

/// Parses `insert NAME at P [scale S | scale X,Y] [rotate A] [columns N DX] [rows N DY]`.
pub(crate) fn insert(cursor: &mut Cursor) -> Parsed<ParsedEntities> {
    let block = cursor.name("a block's name")?;
    cursor.keyword("at")?;
    let at = cursor.point("where the block goes")?;
    let mut insert = Insert {
        block,
        at,
        scale: Point::new(1.0, 1.0).at_height(1.0),
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
        return cursor.point("the factors in x and y").map(|factors| factors.at_height(1.0));
    }
    cursor.number("a factor").map(|factor| Point::new(factor, factor).at_height(factor))
}

/// Parses `P P P [P]`: the corners of a solid.
pub(crate) fn solid(cursor: &mut Cursor) -> Parsed<ParsedEntities> {
    let corners = cursor.points("a corner")?;
    let corners = match corners[..] {
        [a, b, c] => [a, b, c, c],
        [a, b, c, d] => [a, b, c, d],
        _ => return Err(cursor.error("a solid has three or four corners")),
    };
    Ok(one(Shape::Solid(corners), Some(corners[3])))
}

/// Parses `linetype NAME [dash ...]`, which declares a further line type.
pub(crate) fn declare_line_type(cursor: &mut Cursor, draft: &mut Draft) -> Parsed<()> {
    cursor.keyword("linetype")?;
    let name = cursor.name("a line type's name")?;
    let mut pattern = Vec::new();
    while cursor.is_at_number() {
        pattern.push(cursor.number("the length of a dash, a gap (less than 0) or a dot (0)")?);
    }
    list(name, pattern, draft);
    Ok(())
}

/// Parses an optional line type: a usual one, a declared one, or any name in quotes.
pub(crate) fn line_type(cursor: &mut Cursor, draft: &mut Draft) -> Parsed<Option<String>> {
    let Some(token) = cursor.peek() else { return Ok(None) };
    let name = token.text.clone();
    let pattern = pattern(&name, draft);
    if pattern.is_none() && !token.quoted {
        return Ok(None);
    }
    cursor.next("a line type")?;
    list(name.clone(), pattern.unwrap_or_else(|| vec![6.35, -3.175]), draft);
    Ok(Some(name))
}

/// Parses a line type, which must be given.
pub(crate) fn required_line_type(cursor: &mut Cursor, draft: &mut Draft) -> Parsed<String> {
    if let Some(name) = line_type(cursor, draft)? {
        return Ok(name);
    }
    let name = cursor.name("a line type")?;
    Err(cursor.error(unknown(&name)))
}

fn unknown(name: &str) -> String {
    format!("{name:?} is no known line type; list it with `linetype {name}`, or put it in quotation marks")
}

/// Returns the pattern of a usual or declared line type.
fn pattern(name: &str, draft: &Draft) -> Option<Vec<f64>> {
    if let Some((_, pattern)) = draft.line_types.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)) {
        return Some(pattern.clone());
    }
    let upper = name.to_ascii_uppercase();
    let usual =
        |wanted: &str| LINE_TYPES.iter().find(|(known, _)| *known == wanted).map(|(_, pattern)| *pattern);
    let suffixed = |suffix: &str, factor: f64| {
        let pattern = usual(upper.strip_suffix(suffix)?)?;
        Some(pattern.iter().map(|part| part * factor).collect())
    };
    usual(&upper)
        .map(<[f64]>::to_vec)
        .or_else(|| suffixed("X2", 2.0))
        .or_else(|| suffixed("2", 0.5))
        .or_else(|| suffixed("TINY", 0.15))
}

fn list(name: String, pattern: Vec<f64>, draft: &mut Draft) {
    let usual = LINE_TYPES.iter().any(|(known, _)| known.eq_ignore_ascii_case(&name));
    let listed = draft.line_types.iter().any(|(known, _)| known.eq_ignore_ascii_case(&name));
    if !usual && !listed {
        draft.line_types.push((name, pattern));
    }
}
