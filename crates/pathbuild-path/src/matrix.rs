//! Which letters are permitted on which elements: the table of book: language/letters, used by binding, messages and the manual.

use crate::letter::Letter;

/// The class of an element with respect to parameters: a row of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "glossary in book: reference/glossary")]
pub enum ElementClass {
    PathStart,
    Mill,
    Mark,
    Support,
    Sweep,
    DrilledHole,
    DrilledMark,
    HelicalCircle,
    HelicalMark,
    HelicalSupport,
    /// A circle that cannot be classified, because the cutter diameter is unknown or larger than the circle: letters of all kinds of
    /// circles pass.
    UnknownCircle,
    Subpath,
    Probe,
    /// A faulty element, or one whose text is ignored: every letter passes.
    Unread,
}

/// The use of a letter on an element: a cell of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Use {
    /// `!`: from the element or the path; an error if neither gives it.
    Needed,
    /// `o`: from the element, or else from the path; optional.
    Allowed,
    /// `C`: required by a chain; given by its first segment, without effect on the others.
    ChainNeeded,
    /// `c`: given by the first segment of a chain, without effect on the others.
    Chain,
    /// `-`: permitted without effect, PB210.
    Ignored,
    /// `p`: from the path only; PB202 in the element's own text.
    PathOnly,
    /// `.`: not permitted, PB202.
    Unknown,
}

/// The letters of the columns.
const COLUMNS: &str = "F B D I C W P U S N Q T O M A H Z L > : E R @";

/// The rows. (M of a path is only required if it is embedded; `>` and M of a subpath are checked together with the embedded path.)
const ROWS: [(ElementClass, &str); 13] = [
    (ElementClass::PathStart, "o o o o o o o o o . . ! ! o o . o . . o o o o"),
    (ElementClass::Mill, "o ! - C c c . . - o o p p p . . . . . . . . ."),
    (ElementClass::Mark, "o - ! C c c . . - o o p p p . . . . . . . . ."),
    (ElementClass::Support, "o ! ! C c c ! ! - o o p p p . . . . . . . . ."),
    (ElementClass::Sweep, ". . . . . . . . o o . p p p . . . . . . . . ."),
    (ElementClass::DrilledHole, "o ! - . o . . . p . o p p p . . . . . . . . ."),
    (ElementClass::DrilledMark, "o - ! . o . . . p . o p p p . . . . . . . . ."),
    (ElementClass::HelicalCircle, "o ! - ! . . . . p . o p p p p . . . . . . . ."),
    (ElementClass::HelicalMark, "o - ! ! . . . . p . o p p p p . . . . . . . ."),
    (ElementClass::HelicalSupport, "o ! ! ! . . ! ! p . o p p p p . . . . . . . ."),
    (ElementClass::UnknownCircle, "o o o o o . o o p . o p p p p . . . . . . . ."),
    (ElementClass::Subpath, ". . . . . . . . . o . ! ! ! . o . . ! o . . ."),
    (ElementClass::Probe, ". . . . . . . . p . . ! p p . o o o . . . . ."),
];

/// The cells by row and letter.
const CELLS: [[Use; Letter::COUNT]; ROWS.len()] = {
    let mut cells = [[Use::Unknown; Letter::COUNT]; ROWS.len()];
    let (columns, mut row) = (COLUMNS.as_bytes(), 0);
    while row < ROWS.len() {
        let (class, marks) = (ROWS[row].0, ROWS[row].1.as_bytes());
        assert!(
            class as usize == row && marks.len() == columns.len(),
            "a row for each class, a cell for each column"
        );
        let mut column = 0;
        while column < columns.len() {
            let Some(letter) = Letter::new(columns[column] as char) else {
                panic!("a column for each letter")
            };
            cells[row][letter as usize] = Use::of(marks[column]);
            column += 2;
        }
        row += 1;
    }
    cells
};

impl Use {
    const fn of(mark: u8) -> Self {
        match mark {
            b'!' => Self::Needed,
            b'o' => Self::Allowed,
            b'C' => Self::ChainNeeded,
            b'c' => Self::Chain,
            b'-' => Self::Ignored,
            b'p' => Self::PathOnly,
            b'.' => Self::Unknown,
            _ => panic!("a mark of the table"),
        }
    }

    /// Whether the letter has an effect in the element's own text.
    pub const fn counts(self) -> bool {
        matches!(self, Self::Needed | Self::Allowed | Self::ChainNeeded | Self::Chain)
    }
}

impl ElementClass {
    /// The use of a letter on this element.
    pub fn use_of(self, letter: Letter) -> Use {
        CELLS.get(self as usize).map_or(Use::Allowed, |cells| cells[letter as usize])
    }

    /// The letters with an effect in its text, for help.
    pub fn known_letters(self) -> impl Iterator<Item = char> {
        Letter::ALL
            .into_iter()
            .filter(move |(_, letter)| self.use_of(*letter).counts())
            .map(|(character, _)| character)
    }

    /// The required letters.
    pub(crate) fn needed_letters(self) -> impl Iterator<Item = Letter> {
        Letter::ALL
            .into_iter()
            .map(|(_, letter)| letter)
            .filter(move |letter| self.use_of(*letter) == Use::Needed)
    }

    /// Whether it has support bars, or gives the parameters for the support bars of others.
    pub(crate) fn has_bars(self) -> bool {
        matches!(self, Self::PathStart | Self::Support | Self::HelicalSupport)
    }
}
