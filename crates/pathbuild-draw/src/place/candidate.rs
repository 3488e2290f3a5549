use super::piece::ElementPart;
use crate::draft::Block;
use crate::model::{Arc, Circle, Ellipse, Entity, Insert, Layer, Line, Point, Polyline, Shape, Spline};

/// An element that a text may belong to.
#[derive(Clone, Debug)]
pub(crate) struct Candidate {
    /// Its index among the entities; `None` if it comes from a block.
    pub(crate) entity: Option<usize>,
    /// The layer in lower case.
    pub(crate) layer: String,
    /// Whether it accepts a text; lines of type HIDDEN, end markers and turn markers do not.
    pub(crate) takes_text: bool,
    pub(crate) pieces: Vec<ElementPart>,
}

/// Maximum nesting depth of blocks to follow, which also bounds the recursion for blocks that contain themselves.
const DEPTH: u8 = 8;

/// All elements of a list of entities, with blocks expanded.
pub(crate) fn candidates(entities: &[Entity], blocks: &[Block], layers: &[Layer]) -> Vec<Candidate> {
    let mut found = Vec::new();
    for (index, entity) in entities.iter().enumerate().filter(|(_, entity)| !entity.paper) {
        let layer = entity.layer.as_deref().unwrap_or("0");
        if let Shape::Insert(insert) = &entity.shape {
            expand(insert, layer, blocks, layers, DEPTH, &mut found);
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
        Arc::bulged(from, to, bulge).map_or(ElementPart::Line(Line { from, to }), ElementPart::Arc)
    };
    polyline.pieces().map(piece).collect()
}

fn of_ellipse(ellipse: &Ellipse) -> Vec<Point> {
    let minor = Point::new(-ellipse.major.y, ellipse.major.x) * ellipse.ratio;
    let sweep = Arc { centre: ellipse.centre, radius: 1.0, start: ellipse.start, end: ellipse.end }.sweep();
    let at = |i: u8| {
        let (sin, cos) = crate::model::sin_cos(ellipse.start + sweep * f64::from(i) / 32.0);
        ellipse.centre + ellipse.major * cos + minor * sin
    };
    (0..=32).map(at).collect()
}

/// The control polygon or the fit points, an approximation that suffices for placing texts.
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

/// The offsets of an insert's columns and rows.
fn copies(insert: &Insert) -> impl Iterator<Item = Point> + '_ {
    let (columns, rows) = insert.count;
    let at = |column, row| {
        Point::new(f64::from(column) * insert.spacing.0, f64::from(row) * insert.spacing.1)
            .turned(insert.rotation)
    };
    (0..columns.max(1)).flat_map(move |column| (0..rows.max(1)).map(move |row| at(column, row)))
}

fn transform(piece: &ElementPart, insert: &Insert, base: Point, copy: Point) -> ElementPart {
    let scale = insert.scale;
    let scaled = |p: Point| Point::new(p.x * scale.x, p.y * scale.y);
    let point = |p: Point| insert.at + copy + scaled(p - base).turned(insert.rotation);
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
