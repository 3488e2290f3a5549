//! Writes SVG. All text from drawings passes through [`escaped`].

use std::fmt::Write;

use pathbuild_diagnostic::shown;

use crate::scene::Point;

/// The font, with fallbacks.
const FONT: &str = "DejaVu Sans, Verdana, sans-serif";

/// An SVG picture under construction, in px.
pub(super) struct Canvas {
    text: String,
}

/// The alignment of a text to its point.
#[derive(Clone, Copy)]
pub(super) enum Anchor {
    Start,
    Middle,
}

impl Canvas {
    pub(super) fn new(width: f64, height: f64) -> Self {
        let mut text = String::with_capacity(1 << 14);
        let (width, height) = (n(width), n(height));
        _ = writeln!(
            text,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" font-family=\"{FONT}\">"
        );
        let mut canvas = Self { text };
        canvas.raw(&format!("<rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>"));
        canvas
    }

    /// A sheet of paper: its size in mm, and its size in the units of the picture.
    pub(super) fn paper([width, height]: Point, [across, down]: Point) -> Self {
        let mut text = String::with_capacity(1 << 14);
        let [width, height, across, down] = [width, height, across, down].map(n);
        _ = writeln!(
            text,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" viewBox=\"0 0 {across} {down}\" font-family=\"{FONT}\">"
        );
        let mut canvas = Self { text };
        canvas.raw(&format!("<rect width=\"{across}\" height=\"{down}\" fill=\"#fff\"/>"));
        canvas
    }

    pub(super) fn finish(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }

    /// Writes a line of trusted SVG.
    pub(super) fn raw(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// Opens a group.
    pub(super) fn open(&mut self, attributes: &str) {
        self.raw(&format!("<g {attributes}>"));
    }

    /// Closes a group.
    pub(super) fn close(&mut self) {
        self.raw("</g>");
    }

    /// Adds the tooltip of the enclosing element.
    pub(super) fn title(&mut self, text: &str) {
        self.raw(&format!("<title>{}</title>", escaped(text)));
    }

    /// Defines a rectangle for clipping.
    pub(super) fn clip(&mut self, id: &str, [[x, y], [right, bottom]]: [Point; 2]) {
        self.raw(&format!(
            "<clipPath id=\"{id}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>",
            n(x),
            n(y),
            n(right - x),
            n(bottom - y)
        ));
    }

    pub(super) fn path(&mut self, data: &str, attributes: &str) {
        self.raw(&format!("<path d=\"{data}\" {attributes}/>"));
    }

    pub(super) fn circle(&mut self, [x, y]: Point, radius: f64, attributes: &str) {
        self.raw(&format!("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {attributes}/>", n(x), n(y), n(radius)));
    }

    pub(super) fn line(&mut self, from: Point, to: Point, attributes: &str) {
        let [[x1, y1], [x2, y2]] = [from, to].map(|end| end.map(n));
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
            n(x),
            n(y),
            n(size),
            escaped(text)
        ));
    }
}

/// Escapes a text for SVG: puts it on one line, makes characters with special effects visible, escapes XML, and breaks up commands of CI
/// runners.
pub fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    let mut before = ' ';
    for character in shown::line(text).chars() {
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

/// A number with at most two decimals, never -0.
pub(super) fn n(value: f64) -> String {
    let text = format!("{:.2}", value + 0.0);
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}
