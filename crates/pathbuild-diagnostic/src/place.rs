use std::fmt;
use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::Number;

/// A place in a drawing's plane, in millimetres of the drawing's own coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Point {
    /// To the right.
    pub x: Number,
    /// Upwards.
    pub y: Number,
}

impl Point {
    /// The point (x, y), in millimetres.
    pub fn new(x: f64, y: f64) -> Self {
        Self { x: Number(x), y: Number(y) }
    }
}

/// A DXF handle: the number that the CAD shows as an entity's identity, written in hexadecimal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Handle(pub u64);

impl fmt::Display for Handle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:X}", self.0)
    }
}

/// The index of an element in its file's source map, which knows the element's line and handle.
///
/// Elements are counted within one path, so that an edit elsewhere in the drawing, which shifts lines and handles, leaves every
/// value of later stages as it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct ElementId(pub u32);

/// The type of a DXF entity, as far as pathbuild names one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[expect(missing_docs, reason = "the DXF names say it")]
pub enum EntityKind {
    Line,
    Arc,
    Circle,
    Text,
    MText,
    LwPolyline,
    Polyline,
    Ellipse,
    Spline,
    Insert,
    Other,
}

impl EntityKind {
    /// The name in DXF files, as a CAD's user knows it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Line => "LINE",
            Self::Arc => "ARC",
            Self::Circle => "CIRCLE",
            Self::Text => "TEXT",
            Self::MText => "MTEXT",
            Self::LwPolyline => "LWPOLYLINE",
            Self::Polyline => "POLYLINE",
            Self::Ellipse => "ELLIPSE",
            Self::Spline => "SPLINE",
            Self::Insert => "INSERT",
            Self::Other => "entity",
        }
    }
}

/// Where in a file something is. Every part may be unknown.
///
/// The stages behind the reader know elements only by number; `line` and `handle` are filled in when a diagnostic is reported
/// ([`Diagnostic::locate`](crate::Diagnostic::locate)).
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Place {
    /// 1-based line in the file. For ASCII DXF the line of the entity's `0` group code.
    pub line: Option<u32>,
    /// 1-based column (in characters) in that line, for text files such as the configuration and G-code.
    pub column: Option<u32>,
    /// The element, to be looked up in the source map of its file.
    pub element: Option<ElementId>,
    /// The DXF handle.
    pub handle: Option<Handle>,
    /// The type of the DXF entity.
    pub entity: Option<EntityKind>,
    /// The layer, as the drawing spells it.
    pub layer: Option<Box<str>>,
    /// The place in the drawing.
    pub point: Option<Point>,
}

/// A piece of source text with the faulty part of it: a parameter text of a drawing, a line of the configuration or of G-code.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct TextFault {
    /// The text; of a long one, what is around the fault.
    pub text: Box<str>,
    /// First byte of the fault in `text`.
    pub start: u32,
    /// The byte after the fault's last.
    pub end: u32,
}

/// Bytes of a text that is shown as a whole.
const LONGEST: usize = 4 * AROUND;

/// Bytes of a longer one that are shown before a fault; twice as many from where it begins.
const AROUND: usize = 1000;

impl TextFault {
    /// The text with the faulty byte range; a range outside the text, or off its character borders, is cut to what there is. Of a long
    /// text only what is around the fault is kept: a thousand faults of one text do not keep it a thousand times.
    pub fn new(text: &str, span: Range<usize>) -> Self {
        if text.len() > LONGEST {
            let from = text.floor_char_boundary(span.start.min(text.len()).saturating_sub(AROUND));
            let to = text.ceil_char_boundary(span.start.saturating_add(2 * AROUND).min(text.len()));
            return Self::new(
                &text[from..to],
                span.start.saturating_sub(from)..span.end.saturating_sub(from),
            );
        }
        let start = text.floor_char_boundary(span.start.min(text.len()));
        let end = text.ceil_char_boundary(span.end.clamp(start, text.len()));
        let index = |byte: usize| u32::try_from(byte).unwrap_or(u32::MAX);
        Self { text: text.into(), start: index(start), end: index(end) }
    }

    /// The faulty byte range.
    pub fn span(&self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}
