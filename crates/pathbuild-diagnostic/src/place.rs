use std::fmt;
use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::Number;

/// A point in the plane of a drawing, in mm and in its own coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Point {
    /// The X coordinate.
    pub x: Number,
    /// The Y coordinate.
    pub y: Number,
}

impl Point {
    /// The point (x, y) in mm.
    pub fn new(x: f64, y: f64) -> Self {
        Self { x: Number(x), y: Number(y) }
    }

    /// The point with as many decimals as tell it from other points of the same sentence that would look like it.
    pub(crate) fn apart_from(self, others: &[Self]) -> String {
        let shown = |point: Self| (point.x.to_string(), point.y.to_string());
        let alike: Vec<Self> = others.iter().copied().filter(|other| shown(*other) == shown(self)).collect();
        let x = self.x.apart_from(alike.iter().map(|other| other.x));
        let y = self.y.apart_from(alike.iter().map(|other| other.y));
        format!("({x}, {y})")
    }
}

/// A DXF handle: the identity of an entity, displayed in hexadecimal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Handle(pub u64);

impl fmt::Display for Handle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:X}", self.0)
    }
}

/// The index of an element in the source map of its file, which contains the element's line and handle.
///
/// Elements are counted per path, so that edits elsewhere in the drawing, which shift lines and handles, do not change any value of later
/// stages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct ElementId(pub u32);

/// The types of DXF entities that pathbuild distinguishes.
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
    /// The name in DXF files, known to users of CAD programs.
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

/// A place in a file. Each part may be unknown.
///
/// Stages after the reader only know elements by number; `line` and `handle` are filled in when a diagnostic is reported
/// ([`Diagnostic::locate`](crate::Diagnostic::locate)).
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Place {
    /// The line in the file, counted from 1. For ASCII DXF, the line of the entity's `0` group code.
    pub line: Option<u32>,
    /// The column in characters, counted from 1, for text files such as the configuration and G-code.
    pub column: Option<u32>,
    /// The element, for looking it up in the source map of its file.
    pub element: Option<ElementId>,
    /// The DXF handle.
    pub handle: Option<Handle>,
    /// The type of the DXF entity.
    pub entity: Option<EntityKind>,
    /// The layer as spelt in the drawing.
    pub layer: Option<Box<str>>,
    /// The point in the drawing.
    pub point: Option<Point>,
}

/// A source text with its faulty part: a parameter text of a drawing, or a line of the configuration or of G-code.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct TextFault {
    /// The text; for a long one, an excerpt around the fault.
    pub text: Box<str>,
    /// Byte offset of the fault in `text`.
    pub start: u32,
    /// Byte offset of the end of the fault.
    pub end: u32,
}

/// Maximum length in bytes of a text that is kept in full.
const LONGEST: usize = 4 * AROUND;

/// Number of bytes of a longer text kept before a fault; twice as many are kept from its start.
const AROUND: usize = 1000;

impl TextFault {
    /// A text with a faulty byte range, which is clamped to the text and to character boundaries. Only an excerpt of a long text is kept,
    /// so that a thousand faults do not keep a thousand copies.
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
