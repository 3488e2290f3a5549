use super::{NoteKind, Pair};

/// Options for writing a sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// $ACADVER.
    pub version: Version,
    /// $DWGCODEPAGE, and the encoding of texts before R2007. `None` omits the variable and encodes texts as `ANSI_1252`.
    pub code_page: Option<String>,
    /// The encoding of texts.
    pub encoding: TextEncoding,
    /// $INSUNITS; `None` omits the variable.
    pub units: Option<i16>,
    /// The line ends of ASCII DXF.
    pub line_ends: LineEnds,
    /// Whether to write binary DXF.
    pub binary: bool,
    /// Whether to start with a byte order mark.
    pub byte_order_mark: bool,
    /// Parts of the file to omit.
    pub left_out: Vec<Part>,
    /// Header variables to add or override.
    pub header: Vec<(String, Pair)>,
    /// The entity that notes are written as.
    pub note_kind: NoteKind,
    /// Letter height of notes in mm, if there is room.
    pub note_height: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            version: Version::default(),
            code_page: Some("ANSI_1252".to_owned()),
            encoding: TextEncoding::default(),
            units: Some(4),
            line_ends: LineEnds::default(),
            binary: false,
            byte_order_mark: false,
            left_out: Vec::new(),
            header: Vec::new(),
            note_kind: NoteKind::default(),
            note_height: 2.0,
        }
    }
}

/// The supported versions of DXF.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Version {
    R10,
    R12,
    R13,
    R14,
    #[default]
    R2000,
    R2004,
    R2007,
    R2010,
    R2013,
    R2018,
}

impl Version {
    /// All versions, oldest first.
    pub const ALL: [Self; 10] = [
        Self::R10,
        Self::R12,
        Self::R13,
        Self::R14,
        Self::R2000,
        Self::R2004,
        Self::R2007,
        Self::R2010,
        Self::R2013,
        Self::R2018,
    ];

    /// The usual name, for example `R2000`.
    pub fn name(self) -> &'static str {
        match self {
            Self::R10 => "R10",
            Self::R12 => "R12",
            Self::R13 => "R13",
            Self::R14 => "R14",
            Self::R2000 => "R2000",
            Self::R2004 => "R2004",
            Self::R2007 => "R2007",
            Self::R2010 => "R2010",
            Self::R2013 => "R2013",
            Self::R2018 => "R2018",
        }
    }
}

/// The encoding of names and texts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TextEncoding {
    /// As the version demands: UTF-8 from R2007 on, and before that the code page, with `\U+XXXX` for missing characters.
    #[default]
    Proper,
    /// UTF-8 regardless of the version, as careless scripts do.
    Utf8,
    /// `\U+XXXX` for everything outside ASCII, as QCAD does.
    Escaped,
}

/// The line ends of ASCII DXF.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum LineEnds {
    #[default]
    CrLf,
    Lf,
    Cr,
}

/// Parts of a DXF file that simple writers omit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the DXF names say it")]
pub enum Part {
    Header,
    Tables,
    Blocks,
    Objects,
    Handles,
    /// The final pair 0/EOF.
    Eof,
}
