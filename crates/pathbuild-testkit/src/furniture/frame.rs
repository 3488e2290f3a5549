use super::{FRAME, LIST, NOTES, Room, TITLE, by_layer};
use pathbuild_draw::Block;
use pathbuild_draw::model::{
    Attachment, Direction, Entity, Horizontal, Insert, Line, MText, Point, Shape, Text, Vertical,
};

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
pub(super) fn draw(room: &mut Room) {
    let sheet = border();
    room.blocks.push(sheet);
    insert(room, "RAHMEN_A3", Point::new(0.0, 0.0), FRAME);
    title_block(room);
    parts_list(room);
    remarks(room);
}

pub(super) fn insert(room: &mut Room, block: &str, at: Point, layer: &str) {
    let scale = Point::new(1.0, 1.0).at(1.0);
    let shape =
        Insert { block: block.to_owned(), at, scale, rotation: 0.0, count: (1, 1), spacing: (0.0, 0.0) };
    room.add(Entity::new(Shape::Insert(shape)), layer);
}

pub(super) fn text(value: &str, anchor: Point, height: f64, horizontal: Horizontal) -> Entity {
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

/// The border, with marks at the middle of each side.
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

fn title_block(room: &mut Room) {
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

fn parts_list(room: &mut Room) {
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

fn list_row(room: &mut Room, top: f64, columns: [&str; 4]) {
    for (value, x) in columns.into_iter().zip([212.0, 224.0, 239.0, 322.0]) {
        room.add(text(value, Point::new(x, top - 4.5), 2.5, Horizontal::Left), LIST);
    }
}

fn remarks(room: &mut Room) {
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
