//! Positions each text so that it belongs to its element by the rules of book: language/parameter-texts.

use pathbuild_draw::geometry::sin_cos;
use pathbuild_draw::text_positions::{
    Candidate, ElementPart, TextPositions, TextSize, letter_heights, no_space_message,
};

use super::model::{
    Arc, Attachment, Block, Circle, Direction, DrawError, Ellipse, Entity, Horizontal, Insert, Layer, Line,
    MText, Note, NoteKind, Options, Orientation, Point, Polyline, Shape, Spline, Text, Version, Vertical,
    arc_of_bulge,
};

/// Maximum nesting depth of blocks to follow, which also bounds the recursion for blocks that contain themselves.
const MAX_BLOCK_DEPTH: u8 = 8;

/// Returns all elements of a list of entities, with blocks expanded.
pub(crate) fn candidates(entities: &[Entity], blocks: &[Block], layers: &[Layer]) -> Vec<Candidate> {
    let mut found = Vec::new();
    for (index, entity) in entities.iter().enumerate().filter(|(_, entity)| !entity.paper) {
        let layer = entity.layer.as_deref().unwrap_or("0");
        if let Shape::Insert(insert) = &entity.shape {
            expand(insert, layer, blocks, layers, MAX_BLOCK_DEPTH, &mut found);
        } else {
            found.extend(candidate(entity, Some(index), layer, layers));
        }
    }
    found
}

fn candidate(entity: &Entity, index: Option<usize>, layer: &str, layers: &[Layer]) -> Option<Candidate> {
    let pieces = pieces(&entity.shape);
    let line_type = line_type(entity, layer, layers);
    let takes_text = !line_type.eq_ignore_ascii_case("HIDDEN") && !is_silent_marker(&entity.shape, line_type);
    (!pieces.is_empty()).then(|| Candidate {
        entity: index,
        layer: layer.trim().to_lowercase(),
        takes_text,
        pieces,
    })
}

fn line_type<'a>(entity: &'a Entity, layer: &str, layers: &'a [Layer]) -> &'a str {
    match entity.line_type.as_deref() {
        None => of_layer(layer, layers),
        Some(own) if own.eq_ignore_ascii_case("BYLAYER") => of_layer(layer, layers),
        Some(own) => own.trim(),
    }
}

fn of_layer<'a>(name: &str, layers: &'a [Layer]) -> &'a str {
    layers
        .iter()
        .find(|layer| layer.name.eq_ignore_ascii_case(name))
        .map_or("CONTINUOUS", |layer| &layer.line_type)
}

fn is_silent_marker(shape: &Shape, line_type: &str) -> bool {
    let Shape::Circle(circle) = shape else { return false };
    line_type.eq_ignore_ascii_case("PHANTOM")
        && [0.75, 1.0].iter().any(|radius| (circle.radius - radius).abs() < 1e-6)
}

fn pieces(shape: &Shape) -> Vec<ElementPart> {
    match shape {
        Shape::Line(line) => vec![ElementPart::Line(*line)],
        Shape::Arc(arc) => vec![ElementPart::Arc(*arc)],
        Shape::Circle(circle) => vec![ElementPart::Circle(*circle)],
        Shape::Polyline(polyline) => of_polyline(polyline),
        Shape::Ellipse(ellipse) => chain(&of_ellipse(ellipse)),
        Shape::Spline(spline) => chain(&of_spline(spline)),
        Shape::Insert(_)
        | Shape::Text(_)
        | Shape::MText(_)
        | Shape::Solid(_)
        | Shape::Dimension(_)
        | Shape::Raw(_) => Vec::new(),
    }
}

fn of_polyline(polyline: &Polyline) -> Vec<ElementPart> {
    let piece = |(from, to, bulge)| {
        arc_of_bulge(from, to, bulge).map_or(ElementPart::Line(Line { from, to }), ElementPart::Arc)
    };
    polyline.pieces().map(piece).collect()
}

fn of_ellipse(ellipse: &Ellipse) -> Vec<Point> {
    let minor = Point::new(-ellipse.major.y, ellipse.major.x) * ellipse.ratio;
    let sweep = Arc { centre: ellipse.centre, radius: 1.0, start: ellipse.start, end: ellipse.end }.sweep();
    let at = |i: u8| {
        let (sin, cos) = sin_cos(ellipse.start + sweep * f64::from(i) / 32.0);
        ellipse.centre + ellipse.major * cos + minor * sin
    };
    (0..=32).map(at).collect()
}

/// Returns the control points or the fit points of a spline: an approximation that suffices for placing texts.
fn of_spline(spline: &Spline) -> Vec<Point> {
    if spline.fit.is_empty() { spline.control.clone() } else { spline.fit.clone() }
}

fn chain(points: &[Point]) -> Vec<ElementPart> {
    points.windows(2).map(|pair| ElementPart::Line(Line { from: pair[0], to: pair[1] })).collect()
}

fn expand(
    insert: &Insert,
    layer: &str,
    blocks: &[Block],
    layers: &[Layer],
    depth: u8,
    found: &mut Vec<Candidate>,
) {
    let Some(block) = blocks.iter().find(|block| block.name.eq_ignore_ascii_case(&insert.block)) else {
        return;
    };
    let uniform = (insert.scale.x.abs() - insert.scale.y.abs()).abs() < 1e-9;
    if depth == 0 || !uniform {
        return;
    }
    let mut inner = Vec::new();
    for entity in &block.entities {
        let own = entity.layer.as_deref().filter(|own| *own != "0").unwrap_or(layer);
        if let Shape::Insert(nested) = &entity.shape {
            expand(nested, own, blocks, layers, depth - 1, &mut inner);
        } else {
            inner.extend(candidate(entity, None, own, layers));
        }
    }
    for copy in copies(insert) {
        let moved = |piece: &ElementPart| transform(piece, insert, block.base, copy);
        found.extend(
            inner
                .iter()
                .map(|one| Candidate { pieces: one.pieces.iter().map(moved).collect(), ..one.clone() }),
        );
    }
}

/// Returns the offsets of an insert's columns and rows.
fn copies(insert: &Insert) -> impl Iterator<Item = Point> + '_ {
    let (columns, rows) = insert.count;
    let at = |column, row| {
        Point::new(f64::from(column) * insert.spacing.0, f64::from(row) * insert.spacing.1)
            .rotated(insert.rotation)
    };
    (0..columns.max(1)).flat_map(move |column| (0..rows.max(1)).map(move |row| at(column, row)))
}

fn transform(piece: &ElementPart, insert: &Insert, base: Point, copy: Point) -> ElementPart {
    let scale = insert.scale;
    let scaled = |p: Point| Point::new(p.x * scale.x, p.y * scale.y);
    let point = |p: Point| insert.at + copy + scaled(p - base).rotated(insert.rotation);
    match piece {
        ElementPart::Line(line) => ElementPart::Line(Line { from: point(line.from), to: point(line.to) }),
        ElementPart::Circle(circle) => ElementPart::Circle(Circle {
            centre: point(circle.centre),
            radius: circle.radius * scale.x.abs(),
        }),
        ElementPart::Arc(arc) => {
            let (centre, from, to) =
                (point(arc.centre), point(arc.point(arc.start)), point(arc.point(arc.end)));
            let (from, to) = if scale.x * scale.y < 0.0 { (to, from) } else { (from, to) };
            let radius = arc.radius * scale.x.abs();
            ElementPart::Arc(Arc { centre, radius, start: centre.direction(from), end: centre.direction(to) })
        }
    }
}

/// The circle by which a text is matched with its element.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct TextCircle {
    pub centre: Point,
    pub radius: f64,
}

/// Returns the circle of a TEXT or MTEXT; `None` for other entities. (book: language/parameter-texts)
pub fn text_circle(entity: &Entity) -> Option<TextCircle> {
    match &entity.shape {
        Shape::Text(text) => Some(of_text(text, entity.orientation == Orientation::Mirrored)),
        Shape::MText(text) => Some(of_mtext(text)),
        _ => None,
    }
}

fn of_text(text: &Text, mirrored: bool) -> TextCircle {
    let extent = TextSize::of_text(&text.value, text.height);
    let (anchor, across) = match text.horizontal {
        Horizontal::Left => (text.anchor, 0.5),
        Horizontal::Right => (text.anchor, -0.5),
        Horizontal::Centre | Horizontal::Middle => (text.anchor, 0.0),
        Horizontal::Aligned(other) | Horizontal::Fit(other) => ((text.anchor + other) * 0.5, 0.0),
    };
    let up = match text.vertical {
        _ if text.horizontal == Horizontal::Middle => 0.0,
        Vertical::Baseline | Vertical::Bottom => 0.5,
        Vertical::Middle => 0.0,
        Vertical::Top => -0.5,
    };
    let across = if mirrored == text.backwards { across } else { -across };
    let up = if text.upside_down { -up } else { up };
    let offset = Point::new(across * extent.width, up * extent.height);
    TextCircle { centre: anchor + offset.rotated(text.rotation), radius: extent.radius }
}

fn of_mtext(text: &MText) -> TextCircle {
    let extent = TextSize::of_mtext(&lines(&text.value), text.height);
    let index = text.attachment.number() - 1;
    let across = f64::from(1 - index % 3) / 2.0;
    let up = f64::from(index / 3 - 1) / 2.0;
    let offset = Point::new(across * extent.width, up * extent.height);
    TextCircle { centre: text.anchor + offset.rotated(text.direction.degrees()), radius: extent.radius }
}

/// Positions every note: each entity with a note is followed by its TEXT or MTEXT.
pub(crate) fn position_notes(
    entities: Vec<Entity>,
    candidates: &[Candidate],
    options: &Options,
    errors: &mut Vec<DrawError>,
) -> Vec<Entity> {
    let mut seats = TextPositions::new(candidates);
    let mut texts: Vec<Option<Entity>> = entities.iter().map(|_| None).collect();
    for kind in [NoteKind::Text, NoteKind::MText] {
        for (index, entity) in entities.iter().enumerate() {
            take_for_text(&mut seats, entity, kind);
            if let Some(note) = entity.note.as_ref().filter(|note| kind_of(note, options) == kind) {
                let heights =
                    note.height.map_or(letter_heights(options.note_height).to_vec(), |own| vec![own]);
                let extent = |height| extent(note, kind, height);
                match seats.find_position(index, &layer_of(entity), &heights, extent) {
                    Some(seat) => texts[index] = Some(note_entity(entity, note, kind, seat)),
                    None => errors.push(DrawError::new(entity.line, 0, no_space_message(&note.value))),
                }
            }
        }
    }
    entities.into_iter().zip(texts).flat_map(|(entity, text)| std::iter::once(entity).chain(text)).collect()
}

fn kind_of(note: &Note, options: &Options) -> NoteKind {
    match note.kind {
        Some(kind) => kind,
        None if options.version < Version::R13 => NoteKind::Text,
        None => options.note_kind,
    }
}

/// Finds the element to which an ordinary text of the drawing belongs, and records that the element has a text.
fn take_for_text(seats: &mut TextPositions<'_>, entity: &Entity, kind: NoteKind) {
    let is_kind = match entity.shape {
        Shape::Text(_) => kind == NoteKind::Text,
        Shape::MText(_) => kind == NoteKind::MText,
        _ => false,
    };
    if let Some(circle) = text_circle(entity).filter(|_| is_kind && !entity.paper) {
        seats.mark_element_with_text(&layer_of(entity), circle.centre, circle.radius);
    }
}

fn layer_of(entity: &Entity) -> String {
    entity.layer.as_deref().unwrap_or("0").trim().to_lowercase()
}

fn extent(note: &Note, kind: NoteKind, height: f64) -> TextSize {
    match kind {
        NoteKind::Text => TextSize::of_text(&note.value, height),
        NoteKind::MText => TextSize::of_mtext(&lines(&note.value), height),
    }
}

/// Returns the entity for a note, anchored at the lower left (TEXT) or upper left (MTEXT), as CAD programs do.
fn note_entity(
    entity: &Entity,
    note: &Note,
    kind: NoteKind,
    (centre, extent, height): (Point, TextSize, f64),
) -> Entity {
    let corner = |up: f64| Point::new(centre.x - extent.width / 2.0, centre.y + up * extent.height / 2.0);
    let shape = match kind {
        NoteKind::Text => Shape::Text(Text {
            value: note.value.clone(),
            anchor: corner(-1.0),
            height,
            rotation: 0.0,
            horizontal: Horizontal::Left,
            vertical: Vertical::Baseline,
            backwards: false,
            upside_down: false,
        }),
        NoteKind::MText => Shape::MText(MText {
            value: note.value.clone(),
            anchor: corner(1.0),
            height,
            attachment: Attachment::TopLeft,
            direction: Direction::Rotation(0.0),
            chunk: None,
            width: 0.0,
        }),
    };
    Entity { layer: entity.layer.clone(), paper: entity.paper, line: entity.line, ..Entity::new(shape) }
}

/// Returns the lines of an MTEXT as plain text: without formatting codes, but with `%%c` and the like unchanged.
pub(crate) fn lines(value: &str) -> Vec<String> {
    let mut plain = String::new();
    let mut chars = value.chars().peekable();
    while let Some(c) = chars.next() {
        match c {
            '{' | '}' => {}
            '\\' => escape(&mut chars, &mut plain),
            '^' => caret(&mut chars, &mut plain),
            _ => plain.push(c),
        }
    }
    plain.split('\n').map(str::to_owned).collect()
}

type Chars<'a> = std::iter::Peekable<std::str::Chars<'a>>;

fn escape(chars: &mut Chars<'_>, plain: &mut String) {
    match chars.next() {
        Some('P' | 'X') => plain.push('\n'),
        Some(c @ ('\\' | '{' | '}')) => plain.push(c),
        Some('~') => plain.push('\u{a0}'),
        Some('L' | 'l' | 'O' | 'o' | 'K' | 'k') | None => {}
        Some('S') => stacked(chars, plain),
        Some('U') if chars.peek() == Some(&'+') => unicode(chars, plain),
        Some(_) => while !matches!(chars.next(), Some(';') | None) {},
    }
}

fn stacked(chars: &mut Chars<'_>, plain: &mut String) {
    while let Some(c) = chars.next() {
        match c {
            ';' => break,
            '#' => plain.push('/'),
            '^' if chars.peek() == Some(&' ') => _ = chars.next(),
            '\\' => plain.extend(chars.next()),
            _ => plain.push(c),
        }
    }
}

/// Replaces `\U+XXXX` by one character, since the reader decodes it before the formatting.
fn unicode(chars: &mut Chars<'_>, plain: &mut String) {
    chars.next();
    let digits: String = chars.by_ref().take(4).collect();
    let decoded = u32::from_str_radix(&digits, 16).ok().and_then(char::from_u32);
    plain.push(decoded.unwrap_or('?'));
}

fn caret(chars: &mut Chars<'_>, plain: &mut String) {
    match chars.peek() {
        Some('J') => plain.push('\n'),
        Some('I') => plain.push('\t'),
        Some(' ') => plain.push('^'),
        _ => return plain.push('^'),
    }
    chars.next();
}
