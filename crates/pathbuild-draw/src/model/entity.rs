use pathbuild_diagnostic::Handle;

use super::{Arc, Circle, Line, Pair, Point, Shape};

/// An entity of a drawing: a shape, its attributes, and its parameter text.
#[derive(Clone, Debug, PartialEq)]
pub struct Entity {
    /// The shape.
    pub shape: Shape,
    /// The layer; `None` for the draft's current one.
    pub layer: Option<String>,
    /// The name of the line type; `None` for BYLAYER, which is not written.
    pub line_type: Option<String>,
    /// A text that [`Draft::finish`](crate::Draft::finish) positions so that it belongs to this entity.
    pub note: Option<Note>,
    /// The plane that the shape lies in.
    pub orientation: Orientation,
    /// Whether the entity is in paper space.
    pub paper: bool,
    /// Whether the entity is hidden (group 60).
    pub invisible: bool,
    /// Colour number.
    pub colour: Option<u8>,
    /// The text style of TEXT and MTEXT.
    pub style: Option<String>,
    /// An explicit handle; `None` for the next free one.
    pub handle: Option<Handle>,
    /// Changes to the written pairs, for tests with malformed entities.
    pub changes: Vec<Change>,
    /// The line of the text form that draws the entity; 0 if there is none.
    pub line: u32,
}

/// The normal of the plane that an entity lies in.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Orientation {
    /// (0, 0, 1), the default, which is not written.
    #[default]
    Upright,
    /// (0, 0, -1), as CAD programs leave it after mirroring. The shape is given in world coordinates; the writer converts it to object
    /// coordinates.
    Mirrored,
    /// Any other normal. The shape's coordinates are written unchanged.
    Tilted(Point),
}

/// A parameter text next to its element.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// The string as it appears in the file; MTEXT interprets formatting codes.
    pub value: String,
    /// The kind of entity to write; `None` for the sheet's default.
    pub kind: Option<NoteKind>,
    /// Letter height in mm; `None` for the sheet's default, reduced if there is no room.
    pub height: Option<f64>,
}

/// The kinds of text entities.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "the DXF names say it")]
pub enum NoteKind {
    Text,
    #[default]
    MText,
}

/// A change to the pairs of an entity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Change {
    /// Sets the first pair of this code, or appends the pair.
    Set(Pair),
    /// Removes all pairs of this code.
    Unset(i32),
}

impl Entity {
    /// An entity with this shape on the current layer. Curves have line type CONTINUOUS, all other shapes BYLAYER.
    pub fn new(shape: Shape) -> Self {
        let line_type = match shape {
            Shape::Insert(_)
            | Shape::Text(_)
            | Shape::MText(_)
            | Shape::Raw(_)
            | Shape::Solid(_)
            | Shape::Dimension(_) => None,
            _ => Some("CONTINUOUS".to_owned()),
        };
        Self {
            shape,
            layer: None,
            line_type,
            note: None,
            orientation: Orientation::Upright,
            paper: false,
            invisible: false,
            colour: None,
            style: None,
            handle: None,
            changes: Vec::new(),
            line: 0,
        }
    }

    /// A straight line, CONTINUOUS.
    pub fn line(from: impl Into<Point>, to: impl Into<Point>) -> Self {
        Self::new(Shape::Line(Line { from: from.into(), to: to.into() }))
    }

    /// An arc counterclockwise from `start` to `end` (degrees), CONTINUOUS.
    pub fn arc(centre: impl Into<Point>, radius: f64, start: f64, end: f64) -> Self {
        Self::new(Shape::Arc(Arc { centre: centre.into(), radius, start, end }))
    }

    /// A circle by its diameter, CONTINUOUS.
    pub fn circle(centre: impl Into<Point>, diameter: f64) -> Self {
        Self::new(Shape::Circle(Circle { centre: centre.into(), radius: diameter / 2.0 }))
    }

    /// A start marker.
    pub fn start(at: impl Into<Point>) -> Self {
        Self::circle(at, 1.0).typed("PHANTOM")
    }

    /// An end marker.
    pub fn end(at: impl Into<Point>) -> Self {
        Self::circle(at, 2.0).typed("PHANTOM")
    }

    /// A turn marker.
    pub fn turn(at: impl Into<Point>) -> Self {
        Self::circle(at, 1.5).typed("PHANTOM")
    }

    /// A Z-probe.
    pub fn probe(at: impl Into<Point>) -> Self {
        Self::circle(at, 6.0).typed("PHANTOM")
    }

    /// Sets the line type.
    pub fn typed(mut self, line_type: &str) -> Self {
        self.line_type = Some(line_type.to_owned());
        self
    }

    /// Sets the layer.
    pub fn on(mut self, layer: &str) -> Self {
        self.layer = Some(layer.to_owned());
        self
    }

    /// Adds a parameter text, unless it is empty.
    pub fn note(mut self, value: &str) -> Self {
        self.note = (!value.is_empty()).then(|| Note { value: value.to_owned(), kind: None, height: None });
        self
    }
}
