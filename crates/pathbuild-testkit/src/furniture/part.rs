use super::frame::{insert, text};
use super::{CENTRE, HATCH, HATCH_LINES, HIDDEN, MEASURES, OUTLINE, Room, by_layer};
use pathbuild_draw::Block;
use pathbuild_draw::model::{Dimension, Entity, Horizontal, Point, Polyline, PolylineKind, Shape, Vertex};

/// Lower left and upper right corner of the part.
const LOW: Point = Point::new(-5.0, 60.0);
const HIGH: Point = Point::new(200.0, 225.0);

/// Draws the part in two views, with holes, screws, centre lines and dimensions.
pub(super) fn draw(room: &mut Room) {
    let corner = room.random.between(5.0, 20.0, 2.5);
    outline(room, corner);
    side_view(room);
    room.blocks.push(screw());
    for (index, at) in holes(room).into_iter().enumerate() {
        let diameter = room.random.pick(&[3.3, 4.2, 5.5, 6.6, 8.0, 12.0]);
        hole(room, at, diameter);
        if index % 2 == 0 {
            insert(room, "DIN912_M6", at, OUTLINE);
        }
        if index == 0 {
            dimension(room, LOW, at, 1);
        }
    }
    dimension(room, LOW, HIGH, 2);
}

/// Draws a polyline with rounded and chamfered corners.
fn outline(room: &mut Room, corner: f64) {
    let at = |x: f64, y: f64, bulge: f64| Vertex { point: Point::new(x, y), bulge };
    let vertices = vec![
        at(LOW.x + corner, LOW.y, 0.0),
        at(HIGH.x, LOW.y, 0.0),
        at(HIGH.x, HIGH.y - corner, 0.414_213_562_373),
        at(HIGH.x - corner, HIGH.y, 0.0),
        at(LOW.x, HIGH.y, 0.0),
        at(LOW.x, LOW.y + corner, 0.0),
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

fn side_view(room: &mut Room) {
    let thickness = room.random.pick(&[2.0, 4.0, 5.0, 8.0, 10.0]);
    room.rectangle(Point::new(LOW.x, 240.0), Point::new(HIGH.x, 240.0 + thickness), OUTLINE);
    let step = room.random.between(15.0, 40.0, 2.5);
    for x in [LOW.x + step, HIGH.x - step] {
        room.line(Point::new(x, 240.0), Point::new(x, 240.0 + thickness), HIDDEN);
    }
}

fn holes(room: &mut Room) -> Vec<Point> {
    let count = 2 + room.random.below(2);
    (0..count)
        .map(|_| {
            let x = room.random.between(LOW.x + 15.0, HIGH.x - 15.0, 0.25);
            Point::new(x, room.random.between(LOW.y + 15.0, HIGH.y - 15.0, 0.25))
        })
        .collect()
}

fn hole(room: &mut Room, at: Point, diameter: f64) {
    room.add(Entity::circle(at, diameter), OUTLINE);
    let reach = diameter / 2.0 + 3.0;
    room.line(at.polar(reach, 180.0), at.polar(reach, 0.0), CENTRE);
    room.line(at.polar(reach, 270.0), at.polar(reach, 90.0), CENTRE);
}

/// The head of a screw, seen from above.
fn screw() -> Block {
    let corner = |index: u8| Point::default().polar(2.886_751_345_948, f64::from(index) * 60.0);
    let sides = (0..6).map(|index| Entity::line(corner(index), corner(index + 1)));
    let circles = [10.0, 6.0].map(|diameter| Entity::circle((0.0, 0.0), diameter));
    let entities = circles.into_iter().chain(sides).map(|entity| by_layer(entity, "0")).collect();
    Block { name: "DIN912_M6".to_owned(), base: Point::default(), entities }
}

/// Draws a horizontal dimension with its block, as CAD programs write it.
fn dimension(room: &mut Room, from: Point, to: Point, index: usize) {
    let y = LOW.y - 6.0 - 4.0 * index as f64;
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
pub(super) fn hatch(room: &mut Room) {
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
