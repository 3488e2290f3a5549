//! The surroundings of the path in a typical drawing: a frame with a title block, a parts list, the part itself with holes, centre lines,
//! hatching and dimensions, and screws as blocks. None of it is on a path layer, and the same seed gives the same result.

use std::sync::{Arc, OnceLock};

use crate::draw::model::{
    Attachment, Dimension, Direction, Entity, Horizontal, Insert, Layer, Line, LineEnds, MText, Point,
    Polyline, PolylineKind, Shape, Text, Version, Vertex, Vertical,
};
use crate::draw::{Block, Draft, DrawError, Sheet, Template};
use crate::random::Random;

/// Minimum size of a drawing in bytes of ASCII with CRLF in R2000, and the range above it.
const MIN_BYTES: usize = 38_500;
const BYTE_RANGE: usize = 8_000;

/// Number of variants of the surroundings.
const VARIANTS: usize = 16;

/// Maximum number of hatch lines. A drawing with a large path has fewer.
const HATCH_LINES: usize = 160;

/// Cache of the surroundings as DXF, by version and variant: even thousands of drawings use only a few of them.
static TEMPLATES: [[OnceLock<Arc<Template>>; VARIANTS]; Version::ALL.len()] =
    [const { [const { OnceLock::new() }; VARIANTS] }; Version::ALL.len()];

/// Finishes a drawing with the surroundings that follow from a seed, padded to a typical size. Without a seed, there are none.
///
/// # Errors
/// The errors of [`Draft::finish`].
pub(crate) fn finish(mut draft: Draft, seed: Option<u64>) -> Result<Sheet, Vec<DrawError>> {
    let Some(seed) = seed else { return draft.finish() };
    add_layers(&mut draft);
    let sheet = draft.finish()?;
    let mut random = Random::new(seed, 1);
    let variant = random.below(VARIANTS);
    let room = Surroundings::of(variant);
    let blocks: Vec<&Block> = sheet.blocks().iter().chain(&room.blocks).collect();
    let inner = blocks.iter().flat_map(|block| &block.entities);
    let all = sheet.entities().iter().chain(&room.entities).chain(inner);
    let size = estimate(sheet.layers().len(), blocks.len(), all);
    let target = MIN_BYTES + random.below(BYTE_RANGE);
    // The estimate assumes CRLF: with one byte less per line, more lines are needed for the same size.
    let target = if sheet.options().line_ends == LineEnds::CrLf { target } else { target * 20 / 17 };
    let hatch_lines = (target.saturating_sub(size) / HATCH_LINE_BYTES).min(HATCH_LINES);
    let version = sheet.options().version;
    let template = TEMPLATES[version as usize][variant].get_or_init(|| Arc::new(template(variant, version)));
    Ok(sheet.within(Arc::clone(template), HATCH_LINES - hatch_lines))
}

/// Returns the surroundings alone, with all hatch lines as the last entities. The first third of the other entities, mainly the frame, precedes the
/// path, as when a user draws.
fn template(variant: usize, version: Version) -> Template {
    let mut room = Surroundings::of(variant);
    hatch(&mut room);
    let mut draft = Draft::new();
    draft.options.version = version;
    add_layers(&mut draft);
    draft.blocks = room.blocks;
    draft.entities = room.entities;
    if version < Version::R13 {
        draft.entities.retain(|entity| !matches!(entity.shape, Shape::MText(_)));
    }
    let early = (draft.entities.len() - HATCH_LINES) / 3;
    let sheet =
        draft.finish().unwrap_or_else(|errors| unreachable!("the furniture has a fault: {}", errors[0]));
    Template::new(&sheet, early)
}

fn add_layers(draft: &mut Draft) {
    for (name, line_type, colour) in LAYERS {
        if !draft.layers.iter().any(|known| known.name.eq_ignore_ascii_case(name)) {
            draft.layers.push(Layer { line_type: line_type.to_owned(), colour, ..Layer::new(name) });
        }
    }
}

/// The layers of the surroundings with their line types and colours.
const LAYERS: [(&str, &str, u8); 9] = [
    (FRAME, "CONTINUOUS", 8),
    (TITLE, "CONTINUOUS", 7),
    (LIST, "CONTINUOUS", 7),
    (OUTLINE, "CONTINUOUS", 3),
    (HIDDEN, "HIDDEN", 2),
    (CENTRE, "DASHDOT", 1),
    (HATCH, "CONTINUOUS", 9),
    (MEASURES, "CONTINUOUS", 4),
    (NOTES, "DASHED", 6),
];

const FRAME: &str = "RAHMEN";
const TITLE: &str = "SCHRIFTFELD";
const LIST: &str = "STÜCKLISTE";
const OUTLINE: &str = "KONTUR";
const HIDDEN: &str = "VERDECKT";
const CENTRE: &str = "MITTELLINIEN";
const HATCH: &str = "SCHRAFFUR";
const MEASURES: &str = "MAßE";
const NOTES: &str = "HINWEISE 1-4";

/// The surroundings under construction.
struct Surroundings {
    random: Random,
    entities: Vec<Entity>,
    blocks: Vec<Block>,
}

impl Surroundings {
    fn of(variant: usize) -> Self {
        let mut room =
            Self { random: Random::new(variant as u64, 2), entities: Vec::new(), blocks: Vec::new() };
        draw_frame(&mut room);
        draw_part(&mut room);
        room
    }

    fn add(&mut self, entity: Entity, layer: &str) {
        self.entities.push(by_layer(entity, layer));
    }

    fn line(&mut self, from: Point, to: Point, layer: &str) {
        self.add(Entity::line(from, to), layer);
    }

    fn rectangle(&mut self, low: Point, high: Point, layer: &str) {
        let corners = [low, Point::new(high.x, low.y), high, Point::new(low.x, high.y)];
        for (index, corner) in corners.iter().enumerate() {
            self.line(*corner, corners[(index + 1) % 4], layer);
        }
    }
}

/// Returns an entity with BYLAYER colour and line type, like nearly all entities of CAD programs.
fn by_layer(entity: Entity, layer: &str) -> Entity {
    Entity { layer: Some(layer.to_owned()), line_type: None, ..entity }
}

const PARTS: [(&str, &str); 12] = [
    ("Grundplatte", "EN AW-5083"),
    ("Zylinderschraube M6x20", "ISO 4762"),
    ("Paßfeder", "C45+C"),
    ("Führungssäule Ø12", "16MnCr5"),
    ("Größenanschlag", "PVC grau"),
    ("Spannkörper", "S235JR"),
    ("Federstück", "POM"),
    ("Träger, außen", "Pappel M8"),
    ("Stützfuß", "EPDM 60 Shore"),
    ("Zwischenlage 0,5", "1.4301"),
    ("Rändelmutter", "Messing"),
    ("Lagerbock für Welle", "GG-20"),
];

/// Draws an A3 sheet: border, title block, parts list, remarks.
fn draw_frame(room: &mut Surroundings) {
    let sheet = border();
    room.blocks.push(sheet);
    insert(room, "RAHMEN_A3", Point::new(0.0, 0.0), FRAME);
    title_block(room);
    parts_list(room);
    remarks(room);
}

fn insert(room: &mut Surroundings, block: &str, at: Point, layer: &str) {
    let scale = Point::new(1.0, 1.0).at_height(1.0);
    let shape =
        Insert { block: block.to_owned(), at, scale, rotation: 0.0, count: (1, 1), spacing: (0.0, 0.0) };
    room.add(Entity::new(Shape::Insert(shape)), layer);
}

fn text(value: &str, anchor: Point, height: f64, horizontal: Horizontal) -> Entity {
    Entity::new(Shape::Text(Text {
        value: value.to_owned(),
        anchor,
        height,
        rotation: 0.0,
        horizontal,
        vertical: Vertical::Baseline,
        backwards: false,
        upside_down: false,
    }))
}

/// Returns the border, with marks at the middle of each side.
fn border() -> Block {
    let corners = [(-10.0, -10.0), (390.0, -10.0), (390.0, 267.0), (-10.0, 267.0)].map(Point::from);
    let side = |index: usize| Line { from: corners[index], to: corners[(index + 1) % 4] };
    let mark = |from: (f64, f64), to: (f64, f64)| Line { from: from.into(), to: to.into() };
    let marks = [
        mark((190.0, -15.0), (190.0, -5.0)),
        mark((190.0, 262.0), (190.0, 272.0)),
        mark((-15.0, 128.5), (-5.0, 128.5)),
        mark((385.0, 128.5), (395.0, 128.5)),
    ];
    let lines = (0..4).map(side).chain(marks);
    let entities = lines.map(|line| by_layer(Entity::new(Shape::Line(line)), "0")).collect();
    Block { name: "RAHMEN_A3".to_owned(), base: Point::default(), entities }
}

fn title_block(room: &mut Surroundings) {
    let (low, high) = (Point::new(210.0, -10.0), Point::new(390.0, 30.0));
    room.rectangle(low, high, TITLE);
    for y in [0.0, 10.0, 20.0] {
        room.line(Point::new(low.x, y), Point::new(high.x, y), TITLE);
    }
    room.line(Point::new(270.0, low.y), Point::new(270.0, high.y), TITLE);
    let day = format!(
        "{:02}.{:02}.20{:02}",
        1 + room.random.below(28),
        1 + room.random.below(12),
        11 + room.random.below(14)
    );
    let number = format!("Zeichnung {}", 1000 + room.random.below(7000));
    let rows = [
        ("Maßstab", "1:1"),
        ("Geprüft", "M. Müller"),
        ("Datum", day.as_str()),
        ("Benennung", number.as_str()),
    ];
    for (index, (name, value)) in rows.iter().enumerate() {
        let y = low.y + 10.0 * index as f64 + 2.5;
        room.add(text(name, Point::new(212.5, y), 3.5, Horizontal::Left), TITLE);
        room.add(text(value, Point::new(330.0, y), 5.0, Horizontal::Centre), TITLE);
    }
}

fn parts_list(room: &mut Surroundings) {
    let rows = 1 + room.random.below(3);
    let low = Point::new(210.0, 34.0);
    let high = Point::new(390.0, low.y + 6.0 * (rows + 1) as f64);
    room.rectangle(low, high, LIST);
    for x in [222.0, 237.0, 320.0] {
        room.line(Point::new(x, low.y), Point::new(x, high.y), LIST);
    }
    list_row(room, high.y, ["Pos", "Stück", "Benennung", "Werkstoff"]);
    for row in 1..=rows {
        let y = high.y - 6.0 * row as f64;
        room.line(Point::new(low.x, y), Point::new(high.x, y), LIST);
        let (name, material) = room.random.pick(&PARTS);
        let (position, count) = (row.to_string(), (1 + room.random.below(8)).to_string());
        list_row(room, y, [&position, &count, name, material]);
    }
}

fn list_row(room: &mut Surroundings, top: f64, columns: [&str; 4]) {
    for (value, x) in columns.into_iter().zip([212.0, 224.0, 239.0, 322.0]) {
        room.add(text(value, Point::new(x, top - 4.5), 2.5, Horizontal::Left), LIST);
    }
}

fn remarks(room: &mut Surroundings) {
    let value = "{\\fArial|b0|i0;Alle Maße in mm\\PFreimaßtoleranz ISO 2768-m\\PKanten gebrochen 0,2 %%d45\\POberfläche \\U+2205 gefräst}";
    let shape = MText {
        value: value.to_owned(),
        anchor: Point::new(-5.0, 262.0),
        height: 3.5,
        attachment: Attachment::TopLeft,
        direction: Direction::Rotation(0.0),
        chunk: None,
        width: 90.0,
    };
    room.add(Entity::new(Shape::MText(shape)), NOTES);
    room.line(Point::new(-5.0, 240.0), Point::new(60.0, 240.0), NOTES);
}

/// Lower left and upper right corner of the part.
const PART_LOW: Point = Point::new(-5.0, 60.0);
const PART_HIGH: Point = Point::new(200.0, 225.0);

/// Draws the part in two views, with holes, screws, centre lines and dimensions.
fn draw_part(room: &mut Surroundings) {
    let corner = room.random.between(5.0, 20.0, 2.5);
    outline(room, corner);
    side_view(room);
    room.blocks.push(screw());
    for (index, at) in hole_positions(room).into_iter().enumerate() {
        let diameter = room.random.pick(&[3.3, 4.2, 5.5, 6.6, 8.0, 12.0]);
        hole(room, at, diameter);
        if index % 2 == 0 {
            insert(room, "DIN912_M6", at, OUTLINE);
        }
        if index == 0 {
            dimension(room, PART_LOW, at, 1);
        }
    }
    dimension(room, PART_LOW, PART_HIGH, 2);
}

/// Draws a polyline with rounded and chamfered corners.
fn outline(room: &mut Surroundings, corner: f64) {
    let at = |x: f64, y: f64, bulge: f64| Vertex { point: Point::new(x, y), bulge };
    let vertices = vec![
        at(PART_LOW.x + corner, PART_LOW.y, 0.0),
        at(PART_HIGH.x, PART_LOW.y, 0.0),
        at(PART_HIGH.x, PART_HIGH.y - corner, 0.414_213_562_373),
        at(PART_HIGH.x - corner, PART_HIGH.y, 0.0),
        at(PART_LOW.x, PART_HIGH.y, 0.0),
        at(PART_LOW.x, PART_LOW.y + corner, 0.0),
    ];
    room.add(
        Entity::new(Shape::Polyline(Polyline { kind: PolylineKind::Light, vertices, closed: true })),
        OUTLINE,
    );
    let inner = [(20.0, 75.0), (110.0, 75.0), (110.0, 130.0), (20.0, 130.0)].map(Point::from);
    for (index, from) in inner.iter().enumerate() {
        room.line(*from, inner[(index + 1) % 4], HIDDEN);
    }
    room.add(Entity::arc((150.0, 110.0), 25.5, 15.0, 195.0), OUTLINE);
    room.add(Entity::arc((150.0, 110.0), 31.25, 15.0, 195.0), OUTLINE);
}

fn side_view(room: &mut Surroundings) {
    let thickness = room.random.pick(&[2.0, 4.0, 5.0, 8.0, 10.0]);
    room.rectangle(Point::new(PART_LOW.x, 240.0), Point::new(PART_HIGH.x, 240.0 + thickness), OUTLINE);
    let step = room.random.between(15.0, 40.0, 2.5);
    for x in [PART_LOW.x + step, PART_HIGH.x - step] {
        room.line(Point::new(x, 240.0), Point::new(x, 240.0 + thickness), HIDDEN);
    }
}

fn hole_positions(room: &mut Surroundings) -> Vec<Point> {
    let count = 2 + room.random.below(2);
    (0..count)
        .map(|_| {
            let x = room.random.between(PART_LOW.x + 15.0, PART_HIGH.x - 15.0, 0.25);
            Point::new(x, room.random.between(PART_LOW.y + 15.0, PART_HIGH.y - 15.0, 0.25))
        })
        .collect()
}

fn hole(room: &mut Surroundings, at: Point, diameter: f64) {
    room.add(Entity::circle(at, diameter), OUTLINE);
    let reach = diameter / 2.0 + 3.0;
    room.line(at.polar(reach, 180.0), at.polar(reach, 0.0), CENTRE);
    room.line(at.polar(reach, 270.0), at.polar(reach, 90.0), CENTRE);
}

/// Returns the head of a screw, seen from above.
fn screw() -> Block {
    let corner = |index: u8| Point::default().polar(2.886_751_345_948, f64::from(index) * 60.0);
    let sides = (0..6).map(|index| Entity::line(corner(index), corner(index + 1)));
    let circles = [10.0, 6.0].map(|diameter| Entity::circle((0.0, 0.0), diameter));
    let entities = circles.into_iter().chain(sides).map(|entity| by_layer(entity, "0")).collect();
    Block { name: "DIN912_M6".to_owned(), base: Point::default(), entities }
}

/// Draws a horizontal dimension with its block, as CAD programs write it.
fn dimension(room: &mut Surroundings, from: Point, to: Point, index: usize) {
    let y = PART_LOW.y - 6.0 - 4.0 * index as f64;
    let (left, right) = (Point::new(from.x, y), Point::new(to.x, y));
    let length = to.x - from.x;
    let label = format!("{length}").replace('.', ",");
    let middle = (left + right) * 0.5 + Point::new(0.0, 1.0);
    let mut entities = vec![Entity::line(left, right), Entity::line(from, left), Entity::line(to, right)];
    entities.extend([(left, 1.0), (right, -1.0)].map(|(tip, side)| arrow(tip, side)));
    entities.push(text(&label, middle, 2.5, Horizontal::Centre));
    let name = format!("*D{index}");
    let entities = entities.into_iter().map(|entity| by_layer(entity, MEASURES)).collect();
    room.blocks.push(Block { name: name.clone(), base: Point::default(), entities });
    let shape = Dimension { from, to, line: right, label, text: middle, block: name };
    room.add(Entity::new(Shape::Dimension(shape)), MEASURES);
}

fn arrow(tip: Point, side: f64) -> Entity {
    let (a, b) = (tip + Point::new(side * 2.5, 0.4), tip + Point::new(side * 2.5, -0.4));
    Entity::new(Shape::Solid([tip, a, b, b]))
}

/// Draws hatching: slanted lines over a quarter of the part.
fn hatch(room: &mut Surroundings) {
    let (low, high) = (Point::new(112.5, 140.0), Point::new(197.5, 222.5));
    let (width, height) = (high.x - low.x, high.y - low.y);
    for index in 1..=HATCH_LINES {
        // Offset of the line y = x + offset, which is clipped to the field.
        let offset = (width + height) * index as f64 / (HATCH_LINES + 1) as f64 - width;
        let from = Point::new(low.x + (-offset).max(0.0), low.y + offset.max(0.0));
        let to = Point::new(low.x + (height - offset).min(width), low.y + (width + offset).min(height));
        room.line(from, to, HATCH);
    }
}

/// Estimated size in bytes of the fixed parts (header, usual tables, empty blocks and objects), of a layer, and of a block.
const EMPTY_DRAWING_BYTES: usize = 14_500;
const LAYER_BYTES: usize = 155;
const BLOCK_BYTES: usize = 500;

/// Estimated size of a hatch line in bytes.
const HATCH_LINE_BYTES: usize = 167;

/// Estimates the size of a drawing in bytes in R2000, precise to a few per cent.
fn estimate<'a>(layers: usize, blocks: usize, entities: impl Iterator<Item = &'a Entity>) -> usize {
    EMPTY_DRAWING_BYTES + LAYER_BYTES * layers + BLOCK_BYTES * blocks + entities.map(entity).sum::<usize>()
}

fn entity(entity: &Entity) -> usize {
    let shape = match &entity.shape {
        Shape::Line(_) => 140,
        Shape::Arc(_) => 170,
        Shape::Circle(_) => 120,
        Shape::Polyline(polyline) => 110 + 30 * polyline.vertices.len(),
        Shape::Ellipse(_) => 185,
        Shape::Solid(_) => 205,
        Shape::Spline(spline) => 180 + 50 * (spline.control.len() + spline.fit.len()),
        Shape::Insert(_) => 155,
        Shape::Text(text) => 140 + text.value.len(),
        Shape::MText(text) => 205 + text.value.len(),
        Shape::Dimension(_) => 400,
        Shape::Raw(pairs) => pairs.iter().map(|pair| 7 + pair.value.len()).sum(),
    };
    shape + entity.line_type.as_ref().map_or(0, |name| 7 + name.len())
}
