//! The entity types that the reader handles.

use pathbuild_diagnostic::EntityKind;

/// The type of a record in ENTITIES or in a block. VERTEX and SEQEND are records of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RecordKind {
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

/// Length of the longest type name.
const LONGEST: usize = "LWPOLYLINE".len();

impl RecordKind {
    /// The kind with this name, or `None`. (`3DLINE` is the three-dimensional LINE of R10.)
    #[inline]
    pub(crate) fn of(name: &[u8]) -> Option<Self> {
        Self::exact(name).or_else(|| Self::unusual(name))
    }

    /// The same for names in another case.
    #[inline(never)]
    fn unusual(name: &[u8]) -> Option<Self> {
        if name.iter().all(u8::is_ascii_uppercase) {
            return None;
        }
        let name = name.trim_ascii();
        let mut room = [0; LONGEST];
        let upper_case = room.get_mut(..name.len())?;
        upper_case.copy_from_slice(name);
        upper_case.make_ascii_uppercase();
        Self::exact(upper_case)
    }

    #[inline]
    fn exact(name: &[u8]) -> Option<Self> {
        // Comparing arrays needs no function calls.
        match name.len() {
            3 if name == b"ARC" => Some(Self::Arc),
            4 if name == b"LINE" => Some(Self::Line),
            4 if name == b"TEXT" => Some(Self::Text),
            5 if name == b"MTEXT" => Some(Self::MText),
            6 if name == b"CIRCLE" => Some(Self::Circle),
            6 if name == b"INSERT" => Some(Self::Insert),
            6 if name == b"VERTEX" => Some(Self::Vertex),
            6 if name == b"SEQEND" => Some(Self::SequenceEnd),
            6 if name == b"SPLINE" => Some(Self::Spline),
            6 if name == b"3DLINE" => Some(Self::Line),
            7 if name == b"ELLIPSE" => Some(Self::Ellipse),
            8 if name == b"POLYLINE" => Some(Self::Polyline),
            10 if name == b"LWPOLYLINE" => Some(Self::LwPolyline),
            _ => None,
        }
    }

    /// Whether it belongs to a POLYLINE.
    pub(crate) fn is_part(self) -> bool {
        matches!(self, Self::Vertex | Self::SequenceEnd)
    }

    /// Bit mask of the codes below 80 that this kind repeats.
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
        const VERTICES: u64 = bits(&[10, 20, 42]);
        const CONTROL: u64 = bits(&[10, 20, 30, 40, 41]);
        match self {
            Self::MText => CHUNKS,
            Self::LwPolyline => VERTICES,
            Self::Spline => CONTROL,
            _ => 0,
        }
    }

    /// The kind for diagnostics.
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
