use super::Point;

/// A single-line text.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// The string as it appears in the file.
    pub value: String,
    /// The alignment point; the left one of the two for aligned and fitted texts.
    pub anchor: Point,
    /// Letter height in mm.
    pub height: f64,
    /// Rotation in degrees, counterclockwise.
    pub rotation: f64,
    /// Group 72.
    pub horizontal: Horizontal,
    /// Group 73.
    pub vertical: Vertical,
    /// Whether the text is mirrored horizontally (group 71, bit 2).
    pub backwards: bool,
    /// Whether the text is upside down (group 71, bit 4).
    pub upside_down: bool,
}

/// Group 72 of TEXT.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Horizontal {
    /// 0
    #[default]
    Left,
    /// 1
    Centre,
    /// 2
    Right,
    /// 3, with the second alignment point
    Aligned(Point),
    /// 4: centred in both directions
    Middle,
    /// 5, with the second alignment point
    Fit(Point),
}

/// Group 73 of TEXT.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Vertical {
    #[default]
    Baseline,
    Bottom,
    Middle,
    Top,
}

/// A multi-line text.
#[derive(Clone, Debug, PartialEq)]
pub struct MText {
    /// The string with its formatting codes, as in the file.
    pub value: String,
    /// Insertion point.
    pub anchor: Point,
    /// Letter height in mm.
    pub height: f64,
    /// The point of the text that lies at the anchor.
    pub attachment: Attachment,
    /// The rotation, in the form in which it is written.
    pub direction: Direction,
    /// Maximum length in characters of the final chunk; longer texts are split, with the earlier chunks in group 3. `None` for 250, as CAD
    /// programs use.
    pub chunk: Option<usize>,
    /// Width of the box (group 41); 0 for no limit.
    pub width: f64,
}

/// Group 71 of MTEXT: 1 to 9, row by row from the upper left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Attachment {
    TopLeft,
    TopCentre,
    TopRight,
    MiddleLeft,
    MiddleCentre,
    MiddleRight,
    BottomLeft,
    BottomCentre,
    BottomRight,
}

/// The form in which the direction of an MTEXT is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Direction {
    /// Group 50, in degrees.
    Rotation(f64),
    /// Groups 11, 21, 31.
    Vector(Point),
}

impl Direction {
    /// The rotation in degrees.
    pub fn degrees(self) -> f64 {
        match self {
            Self::Rotation(degrees) => degrees,
            Self::Vector(vector) => Point::default().direction(vector),
        }
    }
}

impl Attachment {
    /// The value of group 71.
    pub fn number(self) -> i16 {
        self as i16 + 1
    }

    /// From a row (0 top to 2 bottom) and a column (0 left to 2 right).
    pub fn from_row_column(row: usize, column: usize) -> Self {
        use Attachment::{
            BottomCentre, BottomLeft, BottomRight, MiddleCentre, MiddleLeft, MiddleRight, TopCentre, TopLeft,
            TopRight,
        };
        [
            [TopLeft, TopCentre, TopRight],
            [MiddleLeft, MiddleCentre, MiddleRight],
            [BottomLeft, BottomCentre, BottomRight],
        ][row.min(2)][column.min(2)]
    }
}
