//! Writes SVG, and defines the colours of the pictures. All text from drawings passes through [`escaped`].

use std::fmt::Write;

use pathbuild_diagnostic::escaping;

use crate::scene::{Point, Scene};

/// Font families of all texts, the first of which is preferred.
const FONT: &str = "DejaVu Sans, Verdana, sans-serif";

/// An SVG picture under construction.
pub(super) struct Canvas {
    text: String,
    /// The path element at the end of the text, if it may still grow.
    open_path: Option<OpenPath>,
}

/// A path element without its end, to which similar paths are added.
struct OpenPath {
    attributes: String,
    count: usize,
}

/// Maximum number of paths in one element. With an element for each path, rendering the picture takes ten times the memory; a single element for all
/// paths would take as much, for its edges.
const MAX_MERGED_PATHS: usize = 1000;

/// The part of a text that is placed at the text's point.
#[derive(Clone, Copy)]
pub(super) enum Anchor {
    Start,
    Middle,
}

impl Canvas {
    pub(super) fn new(width: f64, height: f64) -> Self {
        Self::sized([width, height], "", [width, height])
    }

    /// Creates a picture on paper: with its size in mm, and its size in the units of the picture.
    pub(super) fn paper(size: Point, units: Point) -> Self {
        Self::sized(size, "mm", units)
    }

    fn sized(size: Point, unit: &str, view: Point) -> Self {
        let mut text = String::with_capacity(1 << 14);
        let ([width, height], [across, down]) = (size.map(svg_number), view.map(svg_number));
        _ = writeln!(
            text,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}{unit}\" height=\"{height}{unit}\" viewBox=\"0 0 {across} {down}\" font-family=\"{FONT}\">"
        );
        let mut canvas = Self { text, open_path: None };
        canvas.raw(&format!("<rect width=\"{across}\" height=\"{down}\" fill=\"#fff\"/>"));
        canvas
    }

    pub(super) fn finish(mut self) -> String {
        self.raw("</svg>");
        self.text
    }

    /// Writes a line of SVG without escaping it.
    pub(super) fn raw(&mut self, line: &str) {
        if self.open_path.take().is_some() {
            self.text.push_str("\"/>\n");
        }
        self.text.push_str(line);
        self.text.push('\n');
    }

    pub(super) fn open(&mut self, attributes: &str) {
        self.raw(&format!("<g {attributes}>"));
    }

    pub(super) fn close(&mut self) {
        self.raw("</g>");
    }

    /// Adds a tooltip to the enclosing element.
    pub(super) fn title(&mut self, text: &str) {
        self.raw(&format!("<title>{}</title>", escaped(text)));
    }

    /// Adds a clip path named `frame`.
    pub(super) fn clip(&mut self, [[x, y], [right, bottom]]: [Point; 2]) {
        self.raw(&format!(
            "<clipPath id=\"frame\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>",
            svg_number(x),
            svg_number(y),
            svg_number(right - x),
            svg_number(bottom - y)
        ));
    }

    /// Hides everything that is already drawn in an area. A clip path for the other areas would cost a renderer the memory of two more images of the page.
    pub(super) fn cover(&mut self, [[x, y], [right, bottom]]: [Point; 2]) {
        self.rect([x, y], [right - x, bottom - y], "fill=\"#fff\"");
    }

    pub(super) fn path(&mut self, data: &str, attributes: &str) {
        self.raw(&format!("<path d=\"{data}\" {attributes}/>"));
    }

    /// Adds a path to the element of the paths before it, if they have the same attributes. The path must look the same alone and among them: it must
    /// be a line, or a filled shape whose outline runs round in the same direction as all others.
    pub(super) fn merged_path(&mut self, data: &str, attributes: &str) {
        match &mut self.open_path {
            Some(open) if open.attributes == attributes && open.count < MAX_MERGED_PATHS => open.count += 1,
            _ => {
                self.raw(&format!("<path {attributes} d=\""));
                self.text.pop();
                self.open_path = Some(OpenPath { attributes: attributes.to_owned(), count: 1 });
            }
        }
        self.text.push_str(data);
    }

    /// Adds a rectangle with this upper left corner and size.
    pub(super) fn rect(&mut self, at: Point, size: Point, attributes: &str) {
        let ([x, y], [width, height]) = (at.map(svg_number), size.map(svg_number));
        self.raw(&format!("<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" {attributes}/>"));
    }

    pub(super) fn circle(&mut self, [x, y]: Point, radius: f64, attributes: &str) {
        self.raw(&format!(
            "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {attributes}/>",
            svg_number(x),
            svg_number(y),
            svg_number(radius)
        ));
    }

    pub(super) fn line(&mut self, from: Point, to: Point, attributes: &str) {
        let [[x1, y1], [x2, y2]] = [from, to].map(|end| end.map(svg_number));
        self.raw(&format!("<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\" {attributes}/>"));
    }

    /// Writes a text at a point on its baseline.
    pub(super) fn text(&mut self, [x, y]: Point, size: f64, anchor: Anchor, attributes: &str, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
        };
        self.raw(&format!(
            "<text x=\"{}\" y=\"{}\" font-size=\"{}\"{anchor} {attributes}>{}</text>",
            svg_number(x),
            svg_number(y),
            svg_number(size),
            escaped(text)
        ));
    }
}

/// Escapes a text for SVG: puts it on one line, makes invisible characters with special effects visible, escapes XML, and breaks up
/// commands of CI runners.
pub fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    let mut before = ' ';
    for character in escaping::line(text).chars() {
        match character {
            '#' if before == '#' => escaped.push_str("&#35;"),
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            other => escaped.push(other),
        }
        before = character;
    }
    escaped
}

/// Formats a number with at most two decimals, never as -0.
pub(super) fn svg_number(value: f64) -> String {
    let text = format!("{:.2}", value + 0.0);
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Formats a length with at most three decimals.
pub(super) fn mm(value: f64) -> String {
    let text = format!("{:.3}", value + 0.0);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

// Colours of the pictures. Kinds of moves also differ in line style, and depths in lightness, so that they can be distinguished in print
// and by the colour-blind. (Okabe and Ito's palette, darkened to a contrast of 4.5 for texts and 3 for lines; depths from light to dark)

pub(super) const RAPID_COLOUR: &str = "#c07800";
pub(super) const BAR_COLOUR: &str = "#cc79a7";
pub(super) const PROBE_COLOUR: &str = "#007a58";
pub(super) const ERROR_COLOUR: &str = "#c45200";
pub(super) const WARNING_COLOUR: &str = "#8a6a00";
pub(super) const TEXT_COLOUR: &str = "#4a5a68";
pub(super) const OTHER_COLOUR: &str = "#b8bfc6";
pub(super) const INK_COLOUR: &str = "#14202b";
pub(super) const KERF_COLOUR: &str = "#e6edf3";

/// Colours of depths as red, green and blue, from shallow to deep.
const DEPTH_COLOURS: [[f64; 3]; 5] = [
    [115.0, 192.0, 232.0],
    [52.0, 148.0, 209.0],
    [24.0, 104.0, 172.0],
    [30.0, 61.0, 130.0],
    [42.0, 20.0, 84.0],
];

/// The range of depths that the colours of a scene cover.
#[derive(Clone, Copy, Debug)]
pub(super) struct Depths {
    /// Highest and lowest Z of all cuts in mm; `None` without cuts.
    pub(super) range: Option<(f64, f64)>,
}

impl Depths {
    pub(super) fn of(scene: &Scene) -> Self {
        let moves = scene.paths.iter().flat_map(|path| &path.moves);
        let depths = moves.filter(|movement| movement.kind.cuts()).filter_map(crate::scene::SceneMove::depth);
        let range = depths.fold(None, |range: Option<(f64, f64)>, z| {
            Some(range.map_or((z, z), |(high, low)| (high.max(z), low.min(z))))
        });
        Self { range }
    }

    /// Returns the colour of a depth; the middle one if the depth is unknown.
    pub(super) fn color(&self, z: Option<f64>) -> String {
        let share = match (self.range, z) {
            (Some((high, low)), Some(z)) if high > low => ((high - z) / (high - low)).clamp(0.0, 1.0),
            _ => 0.5,
        };
        color(share)
    }
}

/// Returns the colour at a fraction (0 to 1) of the range of depths.
pub(super) fn color(share: f64) -> String {
    gradient(&DEPTH_COLOURS, share)
}

/// Returns the colour at a fraction (0 to 1) of a gradient through these colours, given as red, green and blue.
pub(super) fn gradient(colours: &[[f64; 3]], share: f64) -> String {
    let last = (colours.len() - 1) as f64;
    let place = share * last;
    let stop = place.floor().min(last - 1.0);
    let [below, above] = [stop, stop + 1.0].map(|stop| colours[index(stop)]);
    let [red, green, blue] =
        [0, 1, 2].map(|part| index((below[part] + (above[part] - below[part]) * (place - stop)).round()));
    format!("#{red:02x}{green:02x}{blue:02x}")
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255")]
fn index(value: f64) -> usize {
    value as usize
}

/// Wraps a text to a width, at spaces or, within long words, anywhere.
pub(super) fn wrap_text(text: &str, width: f64, size: f64) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.last_mut().expect("there is a line always");
        if last.is_empty() || text_width(last, size) + text_width(word, size) + 0.32 * size > width {
            if !last.is_empty() {
                lines.push(String::new());
            }
        } else {
            last.push(' ');
        }
        for letter in word.chars() {
            let last = lines.last_mut().expect("there is a line always");
            if !last.is_empty() && text_width(last, size) + character_width(letter) * size > width {
                lines.push(String::new());
            }
            lines.last_mut().expect("there is a line always").push(letter);
        }
    }
    lines
}

/// Returns an upper estimate of the width of a text.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    text.chars().map(character_width).sum::<f64>() * size
}

/// Returns the width of a character relative to the letter size. A few classes of characters are precise enough for wrapping lines.
fn character_width(letter: char) -> f64 {
    match letter {
        ' ' | '.' | ',' | ':' | ';' | '\'' | '|' | 'i' | 'j' | 'l' | 'I' => 0.34,
        '(' | ')' | '[' | ']' | 'f' | 't' | 'r' | '-' | '/' => 0.42,
        'm' | 'w' | 'M' | 'W' | '@' | '%' | '→' | '×' => 1.0,
        '0'..='9' | 'a'..='z' | '_' | 'ä' | 'ö' | 'ü' | 'ß' => 0.64,
        'A'..='Z' | 'Ä' | 'Ö' | 'Ü' | '#' | 'Ø' | '…' | '<' | '>' => 0.84,
        _ => 1.0,
    }
}
