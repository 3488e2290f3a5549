//! The entities of a drawing as this crate sees them: points in the plane, and texts with the circles that determine their elements.
//! (book: language/parameter-texts)

use std::borrow::Cow;
use std::mem::take;

use nalgebra::Vector2;
use pathbuild_diagnostic::{Diagnostic, Place};
use pathbuild_dxf::{Drawing, Geometry, HorizontalAlign, LayoutObstacle, MText, Point3, Text, VerticalAlign};

use crate::approx::above;
use crate::element::{Shape, Source, diagnostic_point};
use crate::geometry::{Arc, Curve, Line, Xy, direction};
use crate::text::as_seen;

/// A text of the drawing, with the entity that draws it.
#[derive(Clone, Copy)]
pub(super) struct FoundText<'d> {
    pub(super) source: Source,
    pub(super) text: AnyText<'d>,
}

/// A single-line or multi-line text of a drawing.
#[derive(Clone, Copy)]
#[expect(missing_docs, reason = "the names say it")]
pub enum AnyText<'d> {
    Text(&'d Text),
    MText(&'d MText),
}

impl<'d> FoundText<'d> {
    /// Returns the text's string with its `%%` codes, which are not replaced yet.
    pub(super) fn string(&self) -> &'d str {
        self.text.string()
    }

    pub(super) fn circle(&self) -> TextCircle {
        self.text.circle()
    }

    pub(super) fn anchor(&self) -> Xy {
        self.text.anchor()
    }

    pub(super) fn is_mtext(&self) -> bool {
        matches!(self.text, AnyText::MText(_))
    }
}

impl<'d> AnyText<'d> {
    /// Returns the text, if the entity is one.
    pub fn of(geometry: &'d Geometry) -> Option<Self> {
        match geometry {
            Geometry::Text(text) => Some(Self::Text(text)),
            Geometry::MText(text) => Some(Self::MText(text)),
            Geometry::Line(_) | Geometry::Arc(_) | Geometry::Circle(_) => None,
        }
    }

    /// Returns the text's string with its `%%` codes, which are not replaced yet.
    pub fn string(self) -> &'d str {
        match self {
            Self::Text(text) => &text.string,
            Self::MText(text) => &text.plain,
        }
    }

    /// Returns the circle that determines the text's element.
    pub fn circle(self) -> TextCircle {
        match self {
            Self::Text(text) => TextCircle::of_text(text),
            Self::MText(text) => TextCircle::of_mtext(text),
        }
    }

    /// Returns the formatting because of which the place of the text is unknown.
    pub(super) fn obstacle(self) -> Option<LayoutObstacle> {
        match self {
            Self::Text(_) => None,
            Self::MText(text) => text.obstacle,
        }
    }

    pub(super) fn anchor(self) -> Xy {
        let (Self::Text(Text { anchor, .. }) | Self::MText(MText { anchor, .. })) = self;
        xy(*anchor)
    }
}

/// The circle around a text that determines the text's element, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "a circle's parts")]
pub struct TextCircle {
    pub centre: Xy,
    pub radius: f64,
}

/// Width of a character relative to its height.
const LETTER_WIDTH: f64 = 0.6;

impl TextCircle {
    /// Returns the circle of a single-line text.
    pub fn of_text(text: &Text) -> Self {
        let letter = LETTER_WIDTH * text.height;
        let string = visible_text(&text.string, text.counts_invisible);
        let (row, indent) = visible_row(&string, counts_blanks(&string, text.counts_invisible));
        let length = row.chars().count();
        let mut offset = offset(text.horizontal, text.vertical, letter * length as f64, text.height);
        offset.x += letter * indent as f64 / 2.0;
        let width = letter * (length - indent) as f64;
        if text.backwards {
            offset.x = -offset.x;
        }
        if text.upside_down {
            offset.y = -offset.y;
        }
        let anchor = Xy::new(text.anchor.x, text.anchor.y);
        Self {
            centre: anchor + rotated(offset, text.rotation),
            radius: libm::sqrt(width * width + text.height * text.height) / 2.0,
        }
    }

    /// Returns the circle of a multi-line text.
    pub fn of_mtext(text: &MText) -> Self {
        let letter = LETTER_WIDTH * text.height;
        let room = text.width.map_or(f64::INFINITY, |width| width / letter);
        let plain = visible_text(&text.plain, text.counts_invisible);
        let counts_blanks = counts_blanks(&plain, text.counts_invisible);
        // Only the part with letters counts: the rows from the first to the last with letters, and the columns from `indent` to `longest`.
        let (mut rows, mut first, mut last) = (0, None, 0);
        let (mut indent, mut longest) = (usize::MAX, 0);
        for line in plain.split('\n') {
            let (line, mut blanks) = visible_row(line, counts_blanks);
            for length in (Rows { words: line.split(' '), room, next: None }) {
                rows += 1;
                if length > 0 || counts_blanks {
                    first.get_or_insert(rows - 1);
                    last = rows;
                    indent = indent.min(take(&mut blanks));
                    longest = longest.max(length);
                }
            }
        }
        let first = first.unwrap_or_default();
        let mut offset =
            offset(text.paragraphs, text.vertical, letter * longest as f64, text.height * f64::from(rows));
        offset.x += letter * indent as f64 / 2.0;
        offset.x += text.width.unwrap_or_default()
            * (fraction_before_anchor(text.paragraphs) - fraction_before_anchor(text.horizontal));
        offset.y += text.height * f64::from(rows - last - first) / 2.0;
        let width = letter * (longest - indent) as f64;
        let height = text.height * f64::from(last - first);
        let anchor = Xy::new(text.anchor.x, text.anchor.y);
        Self {
            centre: anchor + rotated(offset, text.rotation),
            radius: (libm::sqrt(width * width + height * height) / 2.0).min(0.7 * height),
        }
    }

    /// Returns the distance between the centres of this circle and another one.
    pub fn distance_to_centre(&self, centre: Xy) -> f64 {
        (centre - self.centre).norm()
    }

    /// Returns the distance from the centre of this circle to the rim of another one.
    pub(crate) fn distance_to_circle(&self, centre: Xy, radius: f64) -> f64 {
        ((self.centre - centre).norm() - radius).abs()
    }

    /// Returns the distance from the circle's centre to an arc, if the radial projection of the centre lies on the arc.
    pub fn distance_to_arc(&self, arc: &Arc) -> Option<f64> {
        arc.spans(self.centre - arc.centre).then(|| self.distance_to_circle(arc.centre, arc.radius))
    }

    /// Returns the distance from the circle's centre to a line, if the foot of the perpendicular lies on the line.
    pub fn distance_to_line(&self, line: &Line) -> Option<f64> {
        let direction = line.end - line.start;
        let length = direction.norm();
        if length == 0.0 {
            return None;
        }
        let out = self.centre - line.start;
        let foot = out.dot(&direction) / length;
        (0.0..=length).contains(&foot).then(|| (direction.perp(&out) / length).abs())
    }

    /// Returns the distance in mm between the circle and a shape; 0 if they touch.
    pub fn gap_to(&self, shape: &Shape) -> f64 {
        let distance = match shape {
            Shape::Curve(curve) => self.distance_to_curve(curve) - self.radius,
            Shape::Circle { centre, radius } => self.distance_to_centre(*centre) - self.radius - radius,
        };
        distance.max(0.0)
    }

    /// Returns the distance from the circle's centre to the nearest point of a curve.
    pub(crate) fn distance_to_curve(&self, curve: &Curve) -> f64 {
        let beside = match curve {
            Curve::Line(line) => self.distance_to_line(line),
            Curve::Arc(arc) => self.distance_to_arc(arc),
        };
        let to_ends = (curve.start() - self.centre).norm().min((curve.end() - self.centre).norm());
        beside.map_or(to_ends, |distance| distance.min(to_ends))
    }
}

/// Returns the characters of a text that count for its size: in compatible mode all, otherwise those that CAD programs show.
fn visible_text(text: &str, is_compatible: bool) -> Cow<'_, str> {
    if is_compatible { Cow::Borrowed(text) } else { as_seen(text) }
}

/// Whether blanks at the ends of rows count for the size of a text. In a text of nothing but blanks they do, so that it has a size.
fn counts_blanks(text: &str, is_compatible: bool) -> bool {
    is_compatible || text.trim().is_empty()
}

/// Returns a row without the blanks at its end, and the number of blanks at its start; if blanks count, the whole row and 0.
fn visible_row(row: &str, counts_blanks: bool) -> (&str, usize) {
    if counts_blanks {
        return (row, 0);
    }
    let row = row.trim_end();
    (row, row.chars().take_while(|character| character.is_whitespace()).count())
}

/// Iterator over the lengths, in characters, of the rows into which a CAD program wraps a line of text at spaces.
struct Rows<'t> {
    words: std::str::Split<'t, char>,
    /// The width of a row in characters.
    room: f64,
    /// The length of the word that did not fit.
    next: Option<usize>,
}

impl Iterator for Rows<'_> {
    type Item = usize;

    fn next(&mut self) -> Option<usize> {
        let mut words = self.words.by_ref().map(|word| word.chars().count());
        let mut row = self.next.take().or_else(|| words.next())?;
        for word in words {
            let longer = row + 1 + word;
            if above(longer as f64, self.room) {
                self.next = Some(word);
                break;
            }
            row = longer;
        }
        Some(row)
    }
}

/// Returns the vector from the anchor to the centre of an unrotated text.
fn offset(horizontal: HorizontalAlign, vertical: VerticalAlign, width: f64, height: f64) -> Vector2<f64> {
    let right = width * (0.5 - fraction_before_anchor(horizontal));
    let up = match vertical {
        VerticalAlign::Baseline | VerticalAlign::Bottom => height / 2.0,
        VerticalAlign::Middle => 0.0,
        VerticalAlign::Top => -height / 2.0,
    };
    Vector2::new(right, up)
}

/// Returns the fraction of the width of a box that lies to the left of its anchor.
fn fraction_before_anchor(horizontal: HorizontalAlign) -> f64 {
    match horizontal {
        HorizontalAlign::Left => 0.0,
        HorizontalAlign::Centre => 0.5,
        HorizontalAlign::Right => 1.0,
    }
}

fn rotated(offset: Vector2<f64>, degrees: f64) -> Vector2<f64> {
    let along = direction(degrees);
    Vector2::new(along.x * offset.x - along.y * offset.y, along.y * offset.x + along.x * offset.y)
}

pub(super) fn xy(point: Point3) -> Xy {
    Xy::new(point.x, point.y)
}

pub(super) fn plane_arc(arc: &pathbuild_dxf::Arc) -> Arc {
    Arc::from_angles(xy(arc.centre), arc.radius, arc.start_angle, arc.end_angle, arc.clockwise)
}

/// Returns the curve of a line or an arc.
pub(super) fn curve(geometry: &Geometry) -> Option<Curve> {
    match geometry {
        Geometry::Line(line) => Some(Curve::Line(Line { start: xy(line.start), end: xy(line.end) })),
        Geometry::Arc(arc) => Some(Curve::Arc(plane_arc(arc))),
        Geometry::Circle(_) | Geometry::Text(_) | Geometry::MText(_) => None,
    }
}

impl Shape {
    /// Returns the shape of a line, an arc or a circle.
    pub fn of(geometry: &Geometry) -> Option<Self> {
        match geometry {
            Geometry::Circle(circle) => {
                Some(Self::Circle { centre: xy(circle.centre), radius: circle.radius })
            }
            geometry => curve(geometry).map(Self::Curve),
        }
    }
}

/// Returns the start, centre or anchor of an entity.
pub(super) fn anchor_of(geometry: &Geometry) -> Xy {
    match geometry {
        Geometry::Line(line) => xy(line.start),
        Geometry::Arc(arc) => plane_arc(arc).start,
        Geometry::Circle(circle) => xy(circle.centre),
        Geometry::Text(Text { anchor, .. }) | Geometry::MText(MText { anchor, .. }) => xy(*anchor),
    }
}

pub(super) fn at_entity(drawing: &Drawing, entity: usize, point: Xy, problem: Diagnostic) -> Diagnostic {
    let (kind, origin) = (drawing.entities[entity].kind, drawing.origins[entity]);
    let layer = &drawing.layers[drawing.entities[entity].layer as usize];
    let place = Place {
        line: Some(origin.line),
        handle: origin.handle,
        entity: Some(kind),
        layer: Some(layer.name.clone()),
        point: Some(diagnostic_point(point)),
        ..Place::default()
    };
    Diagnostic { place, ..problem }
}
