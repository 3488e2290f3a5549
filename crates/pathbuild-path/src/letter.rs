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

    /// Adds a letter; whether it was not there.
    pub(crate) fn insert(&mut self, letter: Letter) -> bool {
        let is_new = !self.contains(letter);
        self.0 |= 1 << letter as u32;
        is_new
    }
}

impl ElementClass {
    /// What a letter does in a text of this element. (The table of spec/30-parameters.md; "p" is not known in the element's own text.)
    pub fn use_of(self, letter: Letter) -> Use {
        use ElementClass as Class;
        use Letter::{A, At, B, C, D, E, Embed, F, H, I, L, M, N, O, P, Q, R, S, T, U, Variable, W, Z};
        let is_used = match self {
            Class::PathStart => {
                const { Letters::of(&[F, B, D, I, C, W, P, U, S, T, O, M, A, Z, Variable, E, R, At]) }
            }
            Class::Mill => const { Letters::of(&[F, B, N, Q]) },
            Class::Mark => const { Letters::of(&[F, D, N, Q]) },
            Class::Support => const { Letters::of(&[F, B, D, P, U, N, Q]) },
            Class::Sweep => const { Letters::of(&[S, N]) },
            Class::DrilledHole => const { Letters::of(&[F, B, C, Q]) },
            Class::DrilledMark => const { Letters::of(&[F, D, C, Q]) },
            Class::HelicalCircle => const { Letters::of(&[F, B, I, Q]) },
            Class::HelicalMark => const { Letters::of(&[F, D, I, Q]) },
            Class::HelicalSupport => const { Letters::of(&[F, B, D, I, P, U, Q]) },
            Class::UnknownCircle => const { Letters::of(&[F, B, D, I, C, P, U, Q]) },
            Class::Subpath => const { Letters::of(&[N, T, O, M, H, Embed, Variable]) },
            Class::Probe => const { Letters::of(&[T, H, Z, L]) },
            Class::Unread => return Use::Used,
        };
        let is_ignored = match self {
            Class::Mill => const { Letters::of(&[D, S]) },
            Class::Mark => const { Letters::of(&[B, S]) },
            Class::Support => const { Letters::of(&[S]) },
            Class::DrilledHole | Class::HelicalCircle => const { Letters::of(&[D]) },
            Class::DrilledMark | Class::HelicalMark => const { Letters::of(&[B]) },
            _ => Letters::default(),
        };
        let is_cut = matches!(self, Class::Mill | Class::Mark | Class::Support);
        if is_used.contains(letter) {
            Use::Used
        } else if is_cut && matches!(letter, I | C | W) {
            Use::ChainFirst
        } else if is_ignored.contains(letter) {
            Use::Ignored
        } else {
            Use::Unknown
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
