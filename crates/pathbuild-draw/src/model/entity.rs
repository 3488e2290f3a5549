use pathbuild_diagnostic::Handle;

use super::{Arc, Circle, Line, Pair, Point, Shape};

/// An entity of a drawing: a shape, how it is drawn, and the parameter text that belongs to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Entity {
    /// The shape.
    pub shape: Shape,
    /// The layer; `None` is the draft's current one.
    pub layer: Option<String>,
    /// The line type's name; `None` writes none, which is BYLAYER.
    pub line_type: Option<String>,
    /// A text that [`Draft::finish`](crate::Draft::finish) places so that it belongs to this entity.
    pub note: Option<Note>,
    /// Where it lies.
    pub orientation: Orientation,
    /// In paper space.
    pub paper: bool,
    /// Not shown (group 60).
    pub invisible: bool,
    /// Colour number.
    pub colour: Option<u8>,
    /// The text style of TEXT and MTEXT.
    pub style: Option<String>,
    /// A handle of its own; else it gets the next free one.
    pub handle: Option<Handle>,
    /// Pairs that are changed when all is written, to make broken entities.
    pub changes: Vec<Change>,
    /// The line of the text form it comes from, 0 if none.
    pub line: u32,
}

/// The normal of the plane that an entity lies in.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Orientation {
    /// 0,0,1: nothing is written.
    #[default]
    Upright,
    /// 0,0,-1, as CADs leave it after mirroring. The shape is given as it is seen; the writer converts it to object coordinates.
    Mirrored,
    /// Any other. The shape's numbers are written as they are.
    Tilted(Point),
}

/// A parameter text beside its element.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// The string as it will stand in the file; MTEXT takes formatting codes.
    pub value: String,
    /// As which entity it is written; `None`: as the sheet's options say.
    pub kind: Option<NoteKind>,
    /// Height of the letters in mm; `None`: as the sheet's options say, smaller where there is no room.
    pub height: Option<f64>,
}

/// The two kinds of texts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "the DXF names say it")]
pub enum NoteKind {
    Text,
    #[default]
    MText,
}

/// A change of an entity's pairs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Change {
    /// The first pair of this code gets this value, or the pair is added at the end.
    Set(Pair),
    /// All pairs of this code are left out.
    Unset(i32),
}

impl Entity {
    /// An entity of a shape, CONTINUOUS, on the current layer.
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

    /// With another line type.
    pub fn typed(mut self, line_type: &str) -> Self {
        self.line_type = Some(line_type.to_owned());
        self
    }

    /// On a layer of its own.
    pub fn on(mut self, layer: &str) -> Self {
        self.layer = Some(layer.to_owned());
        self
    }

    /// With a parameter text. An empty one is none.
    pub fn note(mut self, value: &str) -> Self {
        self.note = (!value.is_empty()).then(|| Note { value: value.to_owned(), kind: None, height: None });
        self
    }
}
