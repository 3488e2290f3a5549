//! The parameter letters. (book: language/letters)

/// The letter of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[expect(missing_docs, reason = "the letters are the names; book: language/letters has the table")]
pub enum Letter {
    A,
    B,
    C,
    D,
    E,
    F,
    H,
    I,
    L,
    M,
    N,
    O,
    P,
    Q,
    R,
    S,
    T,
    U,
    W,
    Z,
    /// `>`: the path to embed.
    Embed,
    /// `@`: the path whose parameters are borrowed.
    At,
    /// `:`: the definition or value of a variable.
    Variable,
}

/// A set of letters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Letters(u32);

impl Letter {
    pub(crate) const ALL: [(char, Self); 23] = [
        ('A', Self::A),
        ('B', Self::B),
        ('C', Self::C),
        ('D', Self::D),
        ('E', Self::E),
        ('F', Self::F),
        ('H', Self::H),
        ('I', Self::I),
        ('L', Self::L),
        ('M', Self::M),
        ('N', Self::N),
        ('O', Self::O),
        ('P', Self::P),
        ('Q', Self::Q),
        ('R', Self::R),
        ('S', Self::S),
        ('T', Self::T),
        ('U', Self::U),
        ('W', Self::W),
        ('Z', Self::Z),
        ('>', Self::Embed),
        ('@', Self::At),
        (':', Self::Variable),
    ];

    /// The number of letters.
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

    /// The letter of a character.
    pub const fn new(character: char) -> Option<Self> {
        if character.is_ascii() { Self::BY_CHARACTER[character as usize] } else { None }
    }

    /// The character.
    pub fn as_char(self) -> char {
        Self::ALL[self as usize].0
    }

    /// Whether its value must not contain variables.
    pub fn is_literal(self) -> bool {
        matches!(self, Self::N | Self::O | Self::At)
    }

    /// Whether its value is a text rather than a number.
    pub fn is_text(self) -> bool {
        use Letter::{At, E, Embed, L, M, Q, R, Variable};
        matches!(self, E | L | M | Q | R | Embed | At | Variable)
    }
}

impl Letters {
    /// All letters.
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

    /// The union of two sets.
    pub(crate) const fn and(self, others: Self) -> Self {
        Self(self.0 | others.0)
    }

    /// Whether the sets have a letter in common.
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
pub(crate) const CHAIN_LETTERS: Letters = Letters::of(&[Letter::I, Letter::C, Letter::W]);
