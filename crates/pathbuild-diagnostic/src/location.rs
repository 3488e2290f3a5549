//! Numbers, points, and positions in files, as they occur in diagnostics.

use std::fmt;
use std::hash::{Hash, Hasher};
use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::words::Lang;

/// A point in a drawing, in mm and in the drawing's coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Point {
    /// X in mm.
    pub x: Number,
    /// Y in mm.
    pub y: Number,
}

impl Point {
    /// Creates the point (x, y), in mm.
    pub fn new(x: f64, y: f64) -> Self {
        Self { x: Number(x), y: Number(y) }
    }

    /// Formats the point with enough decimals to distinguish it from other points in the same sentence.
    pub(crate) fn distinct_from(self, others: &[Self]) -> String {
        let shown = |point: Self| (point.x.to_string(), point.y.to_string());
        let alike: Vec<Self> = others.iter().copied().filter(|other| shown(*other) == shown(self)).collect();
        let x = self.x.distinct_from(alike.iter().map(|other| other.x));
        let y = self.y.distinct_from(alike.iter().map(|other| other.y));
        format!("({x}, {y})")
    }
}

/// A DXF handle, which identifies an entity within its file. It is displayed in hexadecimal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Handle(pub u64);

impl fmt::Display for Handle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:X}", self.0)
    }
}

/// Index of an element in the source map of its path, which contains the element's line and handle.
///
/// Edits elsewhere in the drawing shift lines and handles, but not these indices, so that they do not
/// change any value of later stages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct ElementId(pub u32);

/// Declares the types of entities, each with its name in DXF files: first those that a path consists of, then the others.
macro_rules! entities {
    ($($own:ident $own_name:literal,)* ; $($foreign:ident $foreign_name:literal,)* ; $other:ident $other_name:literal) => {
        /// The types of DXF entities that pathbuild distinguishes.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
        #[expect(missing_docs, reason = "the DXF names say it")]
        pub enum EntityKind {
            $($own,)* $($foreign,)* $other,
        }

        impl EntityKind {
            /// Returns the type of an entity that is not part of a path, by its name in upper case.
            pub fn foreign(name: &[u8]) -> Self {
                let known = [$(Self::$foreign,)*].into_iter().find(|kind| kind.name().as_bytes() == name);
                known.unwrap_or(Self::$other)
            }

            /// Returns the name of the type in DXF files, which users of CAD programs know.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$own => $own_name,)*
                    $(Self::$foreign => $foreign_name,)*
                    Self::$other => $other_name,
                }
            }
        }
    };
}

entities! {
    Line "LINE",
    Arc "ARC",
    Circle "CIRCLE",
    Text "TEXT",
    MText "MTEXT",
    LwPolyline "LWPOLYLINE",
    Polyline "POLYLINE",
    Ellipse "ELLIPSE",
    Spline "SPLINE",
    Insert "INSERT",
    ;
    ArcText "ARCALIGNEDTEXT",
    AttDef "ATTDEF",
    Attrib "ATTRIB",
    Body "BODY",
    Dimension "DIMENSION",
    ExtrudedSurface "EXTRUDEDSURFACE",
    Face "3DFACE",
    Hatch "HATCH",
    Helix "HELIX",
    LoftedSurface "LOFTEDSURFACE",
    MLine "MLINE",
    Mesh "MESH",
    MultiLeader "MULTILEADER",
    NurbSurface "NURBSURFACE",
    PlaneSurface "PLANESURFACE",
    Proxy "ACAD_PROXY_ENTITY",
    Ray "RAY",
    Region "REGION",
    RevolvedSurface "REVOLVEDSURFACE",
    RText "RTEXT",
    Shape "SHAPE",
    Solid "SOLID",
    Solid3D "3DSOLID",
    Surface "SURFACE",
    SweptSurface "SWEPTSURFACE",
    Trace "TRACE",
    XLine "XLINE",
    ;
    Other "entity"
}

/// A position in a file. Each part may be unknown.
///
/// Stages after the reader only know elements by number; `line` and `handle` are filled in when a diagnostic is reported
/// ([`Diagnostic::locate`](crate::Diagnostic::locate)).
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Place {
    /// Line in the file, counted from 1. For ASCII DXF, this is the line of the entity's `0` group code.
    pub line: Option<u32>,
    /// Column in characters, counted from 1. Only for text files such as the configuration and G-code.
    pub column: Option<u32>,
    /// Number of the element in the source map of its path.
    pub element: Option<ElementId>,
    /// DXF handle of the entity.
    pub handle: Option<Handle>,
    /// Type of the DXF entity.
    pub entity: Option<EntityKind>,
    /// Name of the layer, as written in the drawing.
    pub layer: Option<Box<str>>,
    /// Point in the drawing.
    pub point: Option<Point>,
}

/// A source text with its faulty part: a parameter text of a drawing, or a line of the configuration or of G-code.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct TextFault {
    /// Text that contains the fault; for a long text, an excerpt around the fault.
    pub text: Box<str>,
    /// Byte offset of the fault in `text`.
    pub start: u32,
    /// Byte offset of the end of the fault.
    pub end: u32,
}

/// Length in bytes up to which a text is stored in full.
const MAX_FULL_TEXT_BYTES: usize = 4 * EXCERPT_BYTES;

/// Number of bytes of a longer text that are stored before a fault. Twice as many are stored from the start of the fault on.
const EXCERPT_BYTES: usize = 1000;

impl TextFault {
    /// Creates a text with a faulty byte range, which is clamped to the text and to character boundaries. Of a long text, only an excerpt
    /// is stored, so that a thousand faults do not store a thousand copies.
    pub fn new(text: &str, span: Range<usize>) -> Self {
        if text.len() > MAX_FULL_TEXT_BYTES {
            let from = text.floor_char_boundary(span.start.min(text.len()).saturating_sub(EXCERPT_BYTES));
            let to = text.ceil_char_boundary(span.start.saturating_add(2 * EXCERPT_BYTES).min(text.len()));
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

    /// Returns the faulty range in bytes.
    pub fn span(&self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// An `f64` that can be compared exactly and hashed, so that values containing it are `Eq`.
///
/// Equality is bitwise, except that -0 equals 0. It is deliberately exact: whether two coordinates of a drawing coincide is decided by the
/// approximate comparisons of book: language/markers, never by this type.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Number(pub f64);

impl Number {
    fn bits(self) -> u64 {
        if self.0 == 0.0 { 0 } else { self.0.to_bits() }
    }

    /// Formats the number with enough decimals to distinguish it from the other numbers in the same sentence, to avoid "8 mm is greater
    /// than 8".
    pub(crate) fn distinct_from(self, others: impl Iterator<Item = Self>) -> String {
        let shown = self.to_string();
        let equal: Vec<Self> = others.filter(|other| *other != self && other.to_string() == shown).collect();
        let with = |number: Self, decimals: usize| format!("{:.decimals$}", number.0);
        let is_apart =
            |decimals: &usize| equal.iter().all(|other| with(*other, *decimals) != with(self, *decimals));
        let decimals = (4..=MAX_DECIMALS).find(is_apart).filter(|_| !equal.is_empty());
        decimals.map_or(shown, |decimals| without_trailing_zeros(&with(self, decimals)).to_owned())
    }

    /// Formats the number for a sentence: `0.5`, or `0,5` in German.
    pub fn prose(self, lang: Lang) -> String {
        with_decimal_separator(self.to_string(), lang)
    }
}

impl From<f64> for Number {
    fn from(value: f64) -> Self {
        Self(value)
    }
}

/// Maximum number of decimals. Smaller differences have no practical meaning.
const MAX_DECIMALS: usize = 9;

fn without_trailing_zeros(decimals: &str) -> &str {
    decimals.trim_end_matches('0').trim_end_matches('.')
}

/// Gives a formatted number the decimal separator of a language, for a sentence or a table. Coordinates, parameters and G-code keep their
/// decimal point in every language, because users type them.
pub fn with_decimal_separator(number: String, lang: Lang) -> String {
    match lang {
        Lang::En => number,
        Lang::De => number.replace('.', ","),
    }
}

impl PartialEq for Number {
    fn eq(&self, other: &Self) -> bool {
        self.bits() == other.bits()
    }
}

impl Eq for Number {}

impl Hash for Number {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.bits().hash(state);
    }
}

impl PartialOrd for Number {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Number {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        f64::from_bits(self.bits()).total_cmp(&f64::from_bits(other.bits()))
    }
}

/// Formats the number with at most three decimals, the precision of a drawing, and without trailing zeros. Very small values that would
/// appear as 0, such as a gap of 0.0004 mm, get two significant digits; rounding errors below a millionth of a micrometre become 0.
impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = self.0;
        if value != 0.0 && value.abs() < 0.0005 {
            let mut scaled = value.abs();
            let first_digit = (1..=MAX_DECIMALS).find(|_| {
                scaled *= 10.0;
                scaled >= 1.0
            });
            return match first_digit {
                Some(places) => f.write_str(without_trailing_zeros(&format!("{value:.*}", places + 1))),
                None => f.write_str("0"),
            };
        }
        let text = format!("{value:.3}");
        let text = without_trailing_zeros(&text);
        f.write_str(if text == "-0" { "0" } else { text })
    }
}
