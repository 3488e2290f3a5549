//! Builds drawings from bytes, on a small grid so that ends meet.

use std::fmt::Write;

/// A source of decisions. After the last byte, the first alternative is always taken.
pub(crate) struct Choices<'a>(std::slice::Iter<'a, u8>);

impl<'a> Choices<'a> {
    pub(crate) fn new(data: &'a [u8]) -> Self {
        Self(data.iter())
    }

    pub(crate) fn has_more(&self) -> bool {
        !self.0.as_slice().is_empty()
    }

    fn below(&mut self, end: u8) -> u8 {
        self.0.next().copied().unwrap_or_default() % end
    }

    fn of<T: Copy>(&mut self, items: &[T]) -> T {
        items[usize::from(self.below(u8::try_from(items.len()).unwrap_or(u8::MAX)))]
    }

    /// A coordinate in mm: on the grid, or slightly off it.
    fn coordinate(&mut self) -> f64 {
        let place = 10.0 * f64::from(self.below(6));
        match self.below(16) {
            0 => place + 0.0004,
            1 => place + 1e-7,
            2 => -place,
            3 => place * 1e4,
            _ => place,
        }
    }
}

const LINE_TYPES: [&str; 9] =
    ["CONTINUOUS", "DIVIDE", "BORDER", "CENTER", "DASHED", "HIDDEN", "DASHDOT", "DOT", "PHANTOM"];

const LAYERS: [&str; 6] = ["1001.1P", "1001.1P~A", "1001.2P", "8001.1P", "0", CLAMPS];

/// The layer of clamps.
const CLAMPS: &str = "clamps";

const CLAMP_TEXTS: [&str; 6] = ["Z25", "Z4", "Z0", "25", "Z25 T2", "Z1e9"];

const WORDS: [&str; 40] = [
    "T5",
    "O2",
    "MX",
    "I1",
    "B0",
    "B-1",
    "D0.5",
    "F100",
    "S20",
    "H2",
    "C0.5",
    "A10",
    "P2",
    "U1",
    "W3",
    "R7",
    "Z30",
    "N",
    "E.*",
    ":A1",
    ":A=1;2",
    ":B=x",
    "I=A",
    "B=A",
    "F=B",
    ">1001.1P",
    ">1001.2P",
    ">8001.1P :A2",
    ">9999.1P",
    "@1001.2P",
    "Q1",
    "K2",
    "O=A",
    "T=A",
    "I0.001",
    "B-100",
    "S1e9",
    "X~",
    "\\P",
    "%%c",
];

const RADII: [f64; 9] = [0.5, 0.75, 1.0, 3.0, 1.0004, 1.001, 2.0, 7.5, 0.0];

const ANGLES: [f64; 9] = [0.0, 90.0, 180.0, 270.0, 360.0, 450.0, 36.87, -90.0, 1e-7];

/// A drawing determined by the bytes.
pub(crate) fn dxf(choices: &mut Choices<'_>) -> String {
    let mut text = String::from("0\nSECTION\n2\nENTITIES\n");
    // A start and an end make a valid path likely.
    entity(&mut text, "CIRCLE", "1001.1P", "PHANTOM", &[(10, 0.0), (20, 0.0), (40, 0.5)]);
    written(&mut text, "TEXT", "1001.1P", 0.0, 0.0, "T5 O2 I1 B0 MX");
    while choices.has_more() {
        any(&mut text, choices);
    }
    text.push_str("0\nENDSEC\n0\nEOF\n");
    text
}

fn any(text: &mut String, choices: &mut Choices<'_>) {
    let kind = choices.below(14);
    let layer = choices.of(&LAYERS);
    let line_type = choices.of(&LINE_TYPES);
    let (x, y) = (choices.coordinate(), choices.coordinate());
    let at = [(10, x), (20, y)];
    match kind {
        0..=4 => {
            let to = [(11, choices.coordinate()), (21, choices.coordinate())];
            entity(text, "LINE", layer, line_type, &[at, to].concat());
        }
        5 => {
            let angles = [(50, choices.of(&ANGLES)), (51, choices.of(&ANGLES))];
            let radius = [(40, 10.0 * choices.of(&RADII))];
            entity(text, "ARC", layer, line_type, &[&at[..], &radius, &angles].concat());
        }
        6 | 7 => entity(text, "CIRCLE", layer, line_type, &[at[0], at[1], (40, choices.of(&RADII))]),
        8 => entity(text, "CIRCLE", layer, "PHANTOM", &[at[0], at[1], (40, 1.0)]),
        9 => {
            let mut content =
                (0..=choices.below(5)).map(|_| choices.of(&WORDS)).collect::<Vec<_>>().join(" ");
            content.truncate(200);
            written(text, "TEXT", layer, x, y, &content);
        }
        10 => {
            let content = (0..=choices.below(3)).map(|_| choices.of(&WORDS)).collect::<Vec<_>>().join("\\P");
            written(text, "MTEXT", layer, x, y, &content);
        }
        11 => clamp(text, choices, x, y),
        12 => {
            let radius = choices.of(&RADII);
            entity(text, "CIRCLE", CLAMPS, line_type, &[at[0], at[1], (40, radius)]);
            written(text, "TEXT", CLAMPS, x, y, choices.of(&CLAMP_TEXTS));
        }
        _ => {
            let mut pairs = vec![(90, 3.0), (70, f64::from(choices.below(2)))];
            for _ in 0..3 {
                let bulge = choices.of(&[0.0, 1.0, -1.0, 0.414_213_562_373_095_1, 1e-9]);
                pairs.extend([(10, choices.coordinate()), (20, choices.coordinate()), (42, bulge)]);
            }
            entity(text, "LWPOLYLINE", layer, line_type, &pairs);
        }
    }
}

/// Draws a rectangle, usually closed, with a height in it.
fn clamp(text: &mut String, choices: &mut Choices<'_>, x: f64, y: f64) {
    let (right, top) = (x + choices.coordinate(), y + choices.coordinate());
    let closed = if choices.below(8) == 7 { 0.0 } else { 1.0 };
    let corners = [(10, x), (20, y), (10, right), (20, y), (10, right), (20, top), (10, x), (20, top)];
    entity(text, "LWPOLYLINE", CLAMPS, "CONTINUOUS", &[&[(90, 4.0), (70, closed)][..], &corners].concat());
    let (middle, height) = ([f64::midpoint(x, right), f64::midpoint(y, top)], choices.of(&CLAMP_TEXTS));
    written(text, "TEXT", CLAMPS, middle[0], middle[1], height);
}

fn entity(text: &mut String, kind: &str, layer: &str, line_type: &str, pairs: &[(u16, f64)]) {
    _ = write!(text, "0\n{kind}\n8\n{layer}\n6\n{line_type}\n");
    for (code, value) in pairs {
        _ = write!(text, "{code}\n{value}\n");
    }
}

/// Draws a text with a height of 1 mm.
pub(crate) fn written(text: &mut String, kind: &str, layer: &str, x: f64, y: f64, content: &str) {
    let attachment = if kind == "MTEXT" { "71\n5\n" } else { "" };
    _ = write!(text, "0\n{kind}\n8\n{layer}\n10\n{x}\n20\n{y}\n40\n1\n{attachment}1\n{content}\n");
}
