//! The parameter letters, and where each is allowed. (spec/30-parameters.md)

/// A parameter's letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[expect(missing_docs, reason = "the letters are the names; spec/30-parameters.md has the table")]
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
    /// `@`: another path's parameters.
    At,
    /// `:`: a variable's definition or value.
    Variable,
}

/// A set of letters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Letters(u32);

/// What an element is, as far as parameters are concerned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "glossary in spec/00-overview.md")]
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

/// What a letter does in an element's text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Use {
    /// It counts.
    Used,
    /// It counts in the first segment of a chain, and has no effect elsewhere.
    ChainFirst,
    /// It is allowed and has no effect: PB210.
    Ignored,
    /// It is not known here: PB202.
    Unknown,
}

impl Letter {
    const ALL: [(char, Self); 23] = [
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

    /// How many there are.
    pub(crate) const COUNT: usize = Self::ALL.len();

    /// The letters by their characters, which are all ASCII.
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
    pub fn new(character: char) -> Option<Self> {
        Self::BY_CHARACTER.get(character as usize).copied().flatten()
    }

    /// The character.
    pub fn as_char(self) -> char {
        Self::ALL[self as usize].0
    }

    /// Whether its value must not contain a variable.
    pub fn is_literal(self) -> bool {
        matches!(self, Self::N | Self::O | Self::At)
    }

    /// Whether its value is text, not a number.
    pub fn is_text(self) -> bool {
        use Letter::{At, E, Embed, L, M, Q, R, Variable};
        matches!(self, E | L | M | Q | R | Embed | At | Variable)
    }
}

impl Letters {
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

    /// Whether all of these are in it.
    pub(crate) const fn contain(self, others: Self) -> bool {
        others.0 & !self.0 == 0
    }

    /// Whether any of these is in it.
    pub(crate) const fn has_any(self, others: Self) -> bool {
        others.0 & self.0 != 0
    }

    /// Those of both.
    pub(crate) const fn and(self, others: Self) -> Self {
        Self(self.0 | others.0)
    }

    /// Adds a letter; whether it was not there.
    pub(crate) fn insert(&mut self, letter: Letter) -> bool {
        let is_new = !self.contains(letter);
        self.0 |= 1 << letter as u32;
        is_new
    }
}

/// Those that count in the first segment of a chain.
pub(crate) const CHAIN_LETTERS: Letters = Letters::of(&[Letter::I, Letter::C, Letter::W]);

impl ElementClass {
    /// What a letter does in a text of this element. (The table of spec/30-parameters.md; "p" is not known in the element's own text.)
    pub fn use_of(self, letter: Letter) -> Use {
        use Letter::{B, D, S};
        let is_ignored = match self {
            Self::Unread => return Use::Used,
            Self::Mill => const { Letters::of(&[D, S]) },
            Self::Mark => const { Letters::of(&[B, S]) },
            Self::Support => const { Letters::of(&[S]) },
            Self::DrilledHole | Self::HelicalCircle => const { Letters::of(&[D]) },
            Self::DrilledMark | Self::HelicalMark => const { Letters::of(&[B]) },
            _ => Letters::default(),
        };
        if self.used_letters().contains(letter) {
            Use::Used
        } else if self.is_chain_member() && CHAIN_LETTERS.contains(letter) {
            Use::ChainFirst
        } else if is_ignored.contains(letter) {
            Use::Ignored
        } else {
            Use::Unknown
        }
    }

    /// The letters that count in its texts, those of a chain's first segment among them.
    pub(crate) fn effective_letters(self) -> Letters {
        let used = self.used_letters();
        if self.is_chain_member() { used.and(CHAIN_LETTERS) } else { used }
    }

    fn is_chain_member(self) -> bool {
        matches!(self, Self::Mill | Self::Mark | Self::Support)
    }

    fn used_letters(self) -> Letters {
        use Letter::{A, At, B, C, D, E, Embed, F, H, I, L, M, N, O, P, Q, R, S, T, U, Variable, W, Z};
        match self {
            Self::PathStart => {
                const { Letters::of(&[F, B, D, I, C, W, P, U, S, T, O, M, A, Z, Variable, E, R, At]) }
            }
            Self::Mill => const { Letters::of(&[F, B, N, Q]) },
            Self::Mark => const { Letters::of(&[F, D, N, Q]) },
            Self::Support => const { Letters::of(&[F, B, D, P, U, N, Q]) },
            Self::Sweep => const { Letters::of(&[S, N]) },
            Self::DrilledHole => const { Letters::of(&[F, B, C, Q]) },
            Self::DrilledMark => const { Letters::of(&[F, D, C, Q]) },
            Self::HelicalCircle => const { Letters::of(&[F, B, I, Q]) },
            Self::HelicalMark => const { Letters::of(&[F, D, I, Q]) },
            Self::HelicalSupport => const { Letters::of(&[F, B, D, I, P, U, Q]) },
            Self::UnknownCircle => const { Letters::of(&[F, B, D, I, C, P, U, Q]) },
            Self::Subpath => const { Letters::of(&[N, T, O, M, H, Embed, Variable]) },
            Self::Probe => const { Letters::of(&[T, H, Z, L]) },
            Self::Unread => Letters::default(),
        }
    }

    /// The letters that its texts know, for help.
    pub fn known_letters(self) -> impl Iterator<Item = char> {
        Letter::ALL
            .into_iter()
            .filter(move |(_, letter)| matches!(self.use_of(*letter), Use::Used | Use::ChainFirst))
            .map(|(character, _)| character)
    }
}
