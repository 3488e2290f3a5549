//! Which letter is allowed on which element: the one table of book: language/letters, from which binding, messages and the manual take it.

use crate::letter::Letter;

/// What an element is, as far as parameters are concerned: a row.
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
    /// A circle whose cutter diameter is unknown or larger than it: nothing is said about letters that some circle knows.
    UnknownCircle,
    Subpath,
    Probe,
    /// An element that is itself at fault, or whose text is not read: every letter passes.
    Unread,
}

/// What a letter does on an element: a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Use {
    /// `!`: the element's own value or the path's; an error where neither gives one.
    Needed,
    /// `o`: the element's own value, else the path's, else none.
    Allowed,
    /// `C`: needed by a chain; counts in the first segment of a chain, and has no effect elsewhere.
    ChainNeeded,
    /// `c`: counts in the first segment of a chain, and has no effect elsewhere.
    Chain,
    /// `-`: allowed without effect, PB210.
    Ignored,
    /// `p`: the path's alone; PB202 in the element's own text.
    PathOnly,
    /// `.`: PB202.
    Unknown,
}

/// The letters of the columns.
const COLUMNS: &str = "F B D I C W P U S N Q T O M A H Z L > : E R @";

/// The rows. (M of a path is needed only where it is embedded; > and M of a subpath are judged with what it embeds.)
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

    /// Whether the letter counts in the element's own text.
    pub const fn counts(self) -> bool {
        matches!(self, Self::Needed | Self::Allowed | Self::ChainNeeded | Self::Chain)
    }
}

impl ElementClass {
    /// What a letter does on this element.
    pub fn use_of(self, letter: Letter) -> Use {
        CELLS.get(self as usize).map_or(Use::Allowed, |cells| cells[letter as usize])
    }

    /// The letters that its texts know, for help.
    pub fn known_letters(self) -> impl Iterator<Item = char> {
        Letter::ALL
            .into_iter()
            .filter(move |(_, letter)| self.use_of(*letter).counts())
            .map(|(character, _)| character)
    }

    /// The letters that must be given.
    pub(crate) fn needed_letters(self) -> impl Iterator<Item = Letter> {
        Letter::ALL
            .into_iter()
            .map(|(_, letter)| letter)
            .filter(move |letter| self.use_of(*letter) == Use::Needed)
    }

    /// Whether it has support bars, or says what the support bars of others are like.
    pub(crate) fn has_bars(self) -> bool {
        matches!(self, Self::PathStart | Self::Support | Self::HelicalSupport)
    }
}
