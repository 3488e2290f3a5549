//! The entities that the reader looks at.

use pathbuild_diagnostic::EntityKind;

/// A kind of record in ENTITIES or in a block. POLYLINE's parts are records of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Line,
    Arc,
    Circle,
    Text,
    MText,
    LwPolyline,
    Polyline,
    Vertex,
    SequenceEnd,
    Ellipse,
    Spline,
    Insert,
}

/// Length of the longest name.
const LONGEST: usize = "LWPOLYLINE".len();

impl Kind {
    /// The kind of this name; `None` for all others. (`3DLINE` is the LINE of R10 that has a z.)
    #[inline]
    pub(crate) fn of(name: &[u8]) -> Option<Self> {
        let name = name.trim_ascii();
        Self::exact(name).or_else(|| match name {
            _ if name.len() > LONGEST || !name.iter().any(u8::is_ascii_lowercase) => None,
            _ => Self::exact(&name.to_ascii_uppercase()),
        })
    }

    #[inline]
    fn exact(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"LINE" | b"3DLINE" => Self::Line,
            b"ARC" => Self::Arc,
            b"CIRCLE" => Self::Circle,
            b"TEXT" => Self::Text,
            b"MTEXT" => Self::MText,
            b"LWPOLYLINE" => Self::LwPolyline,
            b"POLYLINE" => Self::Polyline,
            b"VERTEX" => Self::Vertex,
            b"SEQEND" => Self::SequenceEnd,
            b"ELLIPSE" => Self::Ellipse,
            b"SPLINE" => Self::Spline,
            b"INSERT" => Self::Insert,
            _ => return None,
        })
    }

    /// Whether it is part of a POLYLINE.
    pub(crate) fn is_part(self) -> bool {
        matches!(self, Self::Vertex | Self::SequenceEnd)
    }

    /// The codes below 80 that it repeats, as bits.
    #[inline]
    pub(crate) fn repeated_codes(self) -> u64 {
        const fn bits(codes: &[u32]) -> u64 {
            let mut bits = 0;
            let mut index = 0;
            while index < codes.len() {
                bits |= 1 << codes[index];
                index += 1;
            }
            bits
        }
        const CHUNKS: u64 = bits(&[1, 3]);
        const DIRECTIONS: u64 = bits(&[11, 50]);
        const VERTICES: u64 = bits(&[10, 20, 42]);
        const CONTROL: u64 = bits(&[10, 20, 30, 40, 41]);
        match self {
            Self::MText => CHUNKS | DIRECTIONS,
            Self::LwPolyline => VERTICES,
            Self::Spline => CONTROL,
            _ => 0,
        }
    }

    /// As it is called in diagnostics.
    pub(crate) fn entity_kind(self) -> EntityKind {
        match self {
            Self::Line => EntityKind::Line,
            Self::Arc => EntityKind::Arc,
            Self::Circle => EntityKind::Circle,
            Self::Text => EntityKind::Text,
            Self::MText => EntityKind::MText,
            Self::LwPolyline => EntityKind::LwPolyline,
            Self::Polyline | Self::Vertex | Self::SequenceEnd => EntityKind::Polyline,
            Self::Ellipse => EntityKind::Ellipse,
            Self::Spline => EntityKind::Spline,
            Self::Insert => EntityKind::Insert,
        }
    }
}
