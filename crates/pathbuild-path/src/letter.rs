//! The parameter letters, and which of them are permitted on which elements: the table of book: language/letters, used by binding, messages
//! and the manual.

macro_rules! letters {
    ($($(#[$doc:meta])* $letter:ident $character:literal,)*) => {
        /// The letter of a parameter.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[expect(missing_docs, reason = "the letters are the names; book: language/letters has the table")]
        pub enum Letter {
            $($(#[$doc])* $letter,)*
        }

        impl Letter {
            pub(crate) const ALL: [(char, Self); [$($character),*].len()] = [$(($character, Self::$letter)),*];
        }
    };
}

letters! {
    A 'A',
    B 'B',
    C 'C',
    D 'D',
    E 'E',
    F 'F',
    H 'H',
    I 'I',
    L 'L',
    M 'M',
    N 'N',
    O 'O',
    P 'P',
    Q 'Q',
    R 'R',
    S 'S',
    T 'T',
    U 'U',
    W 'W',
    Z 'Z',
    /// `>`: the path to embed.
    Embed '>',
    /// `@`: the path from which parameters are borrowed.
    At '@',
    /// `:`: the definition or value of a variable.
    Variable ':',
}

/// A set of letters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Letters(u32);

impl Letter {
    pub(crate) const COUNT: usize = Self::ALL.len();

    /// The letters by their characters, all of which are ASCII.
    const BY_CHARACTER: [Option<Self>; 128] = {
        let mut letters = [None; 128];
        let mut index = 0;
        while index < Self::COUNT {
            let (character, letter) = Self::ALL[index];
            letters[character as usize] = Some(letter);
            index += 1;
        }
        letters
    };

    /// Returns the letter for a character; `None` if the character is not a letter of the language.
    pub const fn new(character: char) -> Option<Self> {
        if character.is_ascii() { Self::BY_CHARACTER[character as usize] } else { None }
    }

    /// Returns the letter's character.
    pub fn as_char(self) -> char {
        Self::ALL[self as usize].0
    }

    /// Whether the value of the letter must not contain variables.
    pub fn is_literal(self) -> bool {
        matches!(self, Self::N | Self::O | Self::At)
    }

    /// Whether the value of the letter is a text rather than a number.
    pub fn is_text(self) -> bool {
        use Letter::{At, E, Embed, L, M, Q, R, Variable};
        matches!(self, E | L | M | Q | R | Embed | At | Variable)
    }
}

impl Letters {
    pub(crate) const ALL: Self = Self(u32::MAX);

    pub(crate) const fn of(letters: &[Letter]) -> Self {
        let mut set = 0;
        let mut index = 0;
        while index < letters.len() {
            set |= 1 << letters[index] as u32;
            index += 1;
        }
        Self(set)
    }

    pub(crate) const fn contains(self, letter: Letter) -> bool {
        self.0 & 1 << letter as u32 != 0
    }

    /// Returns the union of two sets.
    pub(crate) const fn union(self, others: Self) -> Self {
        Self(self.0 | others.0)
    }

    pub(crate) const fn has_any(self, others: Self) -> bool {
        others.0 & self.0 != 0
    }

    /// Adds a letter. Returns whether it was new.
    pub(crate) fn insert(&mut self, letter: Letter) -> bool {
        let is_new = !self.contains(letter);
        self.0 |= 1 << letter as u32;
        is_new
    }
}

/// Letters that apply to a whole chain and are given by its first segment.
pub(crate) const CHAIN_LETTERS: Letters = Letters::of(&[Letter::I, Letter::W]);

/// The class of an element, which determines its permitted letters: a row of the table in the book.
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
    /// circles are accepted.
    UnknownCircle,
    Subpath,
    Probe,
    /// A faulty element, or one with an ignored text: every letter is accepted.
    Unread,
}

/// How a class of elements uses a letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LetterUse {
    /// `!`: from the element or the path; an error if neither gives it.
    Needed,
    /// `o`: from the element, or else from the path; optional.
    Allowed,
    /// `C`: required by a chain: from its first segment, or else from the path; without effect on the other segments.
    ChainNeeded,
    /// `c`: like `C`, but optional.
    Chain,
    /// `-`: permitted without effect, PB210.
    Ignored,
    /// `p`: from the path only; PB202 in the element's own text.
    PathOnly,
    /// `.`: not permitted, PB202.
    Unknown,
}

/// The letters of the columns in [`ROWS`], from left to right.
const COLUMNS: &str = "F B D I C W P U S N Q T O M A H Z L > : E R @";

/// The rows of the table. M of a path is only required if the path is embedded; `>` and M of a subpath are checked together with the embedded path.
const ROWS: [(ElementClass, &str); 13] = [
    (ElementClass::PathStart, "o o o o o o o o o . . ! ! o o . o . . o o o o"),
    (ElementClass::Mill, "o ! - C - c . . - o o p p p . . . . . . . . ."),
    (ElementClass::Mark, "o - ! C - c . . - o o p p p . . . . . . . . ."),
    (ElementClass::Support, "o ! ! C - c ! ! - o o p p p . . . . . . . . ."),
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

const CELLS: [[LetterUse; Letter::COUNT]; ROWS.len()] = {
    let mut cells = [[LetterUse::Unknown; Letter::COUNT]; ROWS.len()];
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
            cells[row][letter as usize] = LetterUse::of(marks[column]);
            column += 2;
        }
        row += 1;
    }
    cells
};

impl LetterUse {
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
    /// Returns the use of a letter on this element.
    pub fn use_of(self, letter: Letter) -> LetterUse {
        CELLS.get(self as usize).map_or(LetterUse::Allowed, |cells| cells[letter as usize])
    }

    /// Returns the letters that have an effect in the text of an element of this class, for help. @ is left out: it needs a text of its own.
    pub fn known_letters(self) -> impl Iterator<Item = char> {
        Letter::ALL
            .into_iter()
            .filter(move |(_, letter)| *letter != Letter::At && self.use_of(*letter).counts())
            .map(|(character, _)| character)
    }

    pub(crate) fn needed_letters(self) -> impl Iterator<Item = Letter> {
        Letter::ALL
            .into_iter()
            .map(|(_, letter)| letter)
            .filter(move |letter| self.use_of(*letter) == LetterUse::Needed)
    }

    /// Whether elements of this class have support bars, or give the parameters for the support bars of others.
    pub(crate) fn has_bars(self) -> bool {
        matches!(self, Self::PathStart | Self::Support | Self::HelicalSupport)
    }
}
