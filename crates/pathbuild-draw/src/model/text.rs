use super::Point;

/// A text of one line.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// The string as it stands in the file.
    pub value: String,
    /// The point that the alignment is relative to; the left one of the two for aligned and fitted texts.
    pub anchor: Point,
    /// In mm.
    pub height: f64,
    /// Degrees, counterclockwise.
    pub rotation: f64,
    /// Group 72.
    pub horizontal: Horizontal,
    /// Group 73.
    pub vertical: Vertical,
    /// The letters run from right to left (71 bit 2).
    pub backwards: bool,
    /// 71 bit 4.
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
    /// 3, with the other end
    Aligned(Point),
    /// 4: in the middle both ways
    Middle,
    /// 5, with the other end
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

/// A text of several lines.
#[derive(Clone, Debug, PartialEq)]
pub struct MText {
    /// The string with its formatting codes, as it stands in the file.
    pub value: String,
    /// Insertion point.
    pub anchor: Point,
    /// Height of a line's letters in mm.
    pub height: f64,
    /// Which point of the text the anchor is.
    pub attachment: Attachment,
    /// How the rotation is written.
    pub direction: Direction,
    /// Longest piece in characters, the rest in chunks before it (group 3); `None`: 250 as the CADs do.
    pub chunk: Option<usize>,
    /// Width of the box (group 41), 0 for none.
    pub width: f64,
}

/// Group 71 of MTEXT, 1 to 9 line by line from the upper left.
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

/// How the direction of an MTEXT stands in the file.
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
