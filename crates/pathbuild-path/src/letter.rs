//! The parameter letters, each declared in one line: its value, its bound, its effect, and the elements on which it is permitted, which is the table
//! of book: language/letters. Binding, messages and the manual follow from these lines.

macro_rules! letters {
    ($(
        $(#[$doc:meta])*
        $letter:ident $character:literal $value:ident $writing:ident $bound:ident $usual:literal $effect:ident $uses:literal,
    )*) => {
        /// The letter of a parameter.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[expect(missing_docs, reason = "the letters are the names; book: language/letters has the table")]
        pub enum Letter {
            $($(#[$doc])* $letter,)*
        }

        /// The declarations of the letters, in their order.
        static DECLARATIONS: [Declaration; [$($character),*].len()] = [$(Declaration {
            letter: Letter::$letter,
            character: $character,
            value: ValueType::$value,
            writing: Writing::$writing,
            bound: Bound::$bound,
            usual: $usual,
            effect: LetterEffect::$effect,
            uses: LetterUse::of_classes($uses),
        }),*];
    };
}

// The fields of each letter are those of `Declaration`. Its uses are a mark of `LetterUse` for each `ElementClass`. M of a path is only required if the
// path is embedded; `>` and M of a subpath are checked together with the embedded path.
letters! {
    //                                                            start
    //                                                            |  milling, marking, support, sweep
    //                                                            |  |     drilled hole, mark
    //                                                            |  |     |   helical circle, mark, support
    //                                                            |  |     |   |    unknown circle
    //                                                            |  |     |   |    |  subpath
    //           value   writing  bound           usual  effect   |  |     |   |    |  |  probe
    A        'A' Length  Variable Positive        "8"    Cuts    "o  ....  ..  ppp  p  .  .",
    B        'B' Length  Variable Any             "-0.3" Cuts    "o  !-!.  !-  !-!  o  .  .",
    C        'C' Length  Variable Positive        "1"    Cuts    "o  ---.  oo  ...  o  .  .",
    D        'D' Length  Variable Any             "0.3"  Cuts    "o  -!!.  -!  -!!  o  .  .",
    E        'E' Text    Variable Any             ""     Nothing "o  ....  ..  ...  .  .  .",
    F        'F' Feed    Variable Positive        "150"  Moves   "o  ooo.  oo  ooo  o  .  .",
    H        'H' Length  Variable Any             "0.3"  Cuts    ".  ....  ..  ...  .  o  o",
    I        'I' Length  Variable Positive        "0.5"  Cuts    "o  CCC.  ..  !!!  o  .  .",
    L        'L' Text    Variable Any             ""     Nothing ".  ....  ..  ...  .  .  o",
    M        'M' Text    Variable Any             ""     Nothing "o  pppp  pp  ppp  p  !  p",
    N        'N' Integer Literal  Any             "1"    Cuts    ".  oooo  ..  ...  .  o  .",
    O        'O' Length  Literal  Positive        "2"    Cuts    "!  pppp  pp  ppp  p  !  p",
    P        'P' Length  Variable PositiveForBars "1"    Cuts    "o  ..!.  ..  ..!  o  .  .",
    Q        'Q' Text    Variable Any             ""     Nothing ".  ooo.  oo  ooo  o  .  .",
    R        'R' Text    Variable Any             ""     Nothing "o  ....  ..  ...  .  .  .",
    S        'S' Length  Variable Any             "5.5"  Moves   "o  ---o  pp  ppp  p  .  p",
    T        'T' Length  Variable Positive        "5"    Cuts    "!  pppp  pp  ppp  p  !  !",
    U        'U' Length  Variable PositiveForBars "5"    Cuts    "o  ..!.  ..  ..!  o  .  .",
    W        'W' Length  Variable Positive        "4"    Cuts    "o  ccc.  ..  ...  .  .  .",
    Z        'Z' Feed    Variable Positive        "50"   Moves   "o  ....  ..  ...  .  .  o",
    /// `>`: the path to embed.
    Embed    '>' Text    Variable Any             ""     Cuts    ".  ....  ..  ...  .  !  .",
    /// `@`: the path from which parameters are borrowed.
    At       '@' Text    Literal  Any             ""     Cuts    "o  ....  ..  ...  .  .  .",
    /// `:`: the definition or value of a variable.
    Variable ':' Text    Variable Any             ""     Cuts    "o  ....  ..  ...  .  o  .",
}

/// What is true of a letter wherever it stands.
struct Declaration {
    letter: Letter,
    character: char,
    value: ValueType,
    writing: Writing,
    bound: Bound,
    /// A usual value for help, without the letter; empty for texts.
    usual: &'static str,
    effect: LetterEffect,
    uses: [LetterUse; ElementClass::COUNT],
}

/// The type of a letter's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ValueType {
    Text,
    Integer,
    /// A number of mm.
    Length,
    /// A number of mm/min.
    Feed,
}

/// How the value of a letter may be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Writing {
    /// Without variables: the value is needed before variables have values. (The help of PB206 names these letters.)
    Literal,
    /// With variables.
    Variable,
}

/// The bound of a letter's value. Bounds that are the values of other letters are in `check_limits`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Bound {
    Any,
    /// Greater than 0.
    Positive,
    /// Greater than 0 on paths and on elements with bars.
    PositiveForBars,
}

/// What a letter's value decides about a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LetterEffect {
    /// Comments, labels, materials, names of files, and permissions.
    Nothing,
    /// Feeds, and moves above the material.
    Moves,
    /// Where and how deep the path cuts.
    Cuts,
}

/// A set of letters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Letters(u32);

impl Letter {
    /// The letters by their characters, all of which are ASCII.
    const BY_CHARACTER: [Option<Self>; 128] = {
        let mut letters = [None; 128];
        let mut index = 0;
        while index < DECLARATIONS.len() {
            letters[DECLARATIONS[index].character as usize] = Some(DECLARATIONS[index].letter);
            index += 1;
        }
        letters
    };

    /// Returns the letter for a character; `None` if the character is not a letter of the language.
    pub const fn new(character: char) -> Option<Self> {
        if character.is_ascii() { Self::BY_CHARACTER[character as usize] } else { None }
    }

    /// Returns every letter of the language.
    pub fn all() -> impl Iterator<Item = Self> {
        DECLARATIONS.iter().map(|declaration| declaration.letter)
    }

    fn declaration(self) -> &'static Declaration {
        &DECLARATIONS[self as usize]
    }

    /// Returns the letter's character.
    pub fn as_char(self) -> char {
        self.declaration().character
    }

    pub(crate) fn value_type(self) -> ValueType {
        self.declaration().value
    }

    /// Whether the value of the letter is a text rather than a number.
    pub fn is_text(self) -> bool {
        self.value_type() == ValueType::Text
    }

    /// Whether the value of the letter must not contain variables.
    pub(crate) fn is_literal(self) -> bool {
        self.declaration().writing == Writing::Literal
    }

    pub(crate) fn bound(self) -> Bound {
        self.declaration().bound
    }

    /// Whether the value must be greater than 0, at least where there are bars.
    pub fn is_positive(self) -> bool {
        self.bound() != Bound::Any
    }

    /// Returns a usual value for help, without the letter.
    pub(crate) fn usual_value(self) -> &'static str {
        self.declaration().usual
    }

    pub(crate) fn effect(self) -> LetterEffect {
        self.declaration().effect
    }

    /// Whether the path's start gives the letter to elements rather than to the path as a whole.
    pub(crate) fn is_inherited(self) -> bool {
        let [start, elements @ ..] = &self.declaration().uses;
        start.counts() && elements.iter().any(|usage| usage.takes_value())
    }

    /// Whether the letter applies to a whole chain and is given by its first segment.
    pub(crate) fn is_of_chain(self) -> bool {
        self.declaration().uses.iter().any(|usage| matches!(usage, LetterUse::Chain | LetterUse::ChainNeeded))
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

    pub(crate) fn iter(self) -> impl Iterator<Item = Letter> {
        Letter::all().filter(move |letter| self.contains(*letter))
    }

    /// Adds a letter. Returns whether it was new.
    pub(crate) fn insert(&mut self, letter: Letter) -> bool {
        let is_new = !self.contains(letter);
        self.0 |= 1 << letter as u32;
        is_new
    }
}

impl FromIterator<Letter> for Letters {
    fn from_iter<T: IntoIterator<Item = Letter>>(letters: T) -> Self {
        letters.into_iter().fold(Self::default(), |all, letter| Self(all.0 | 1 << letter as u32))
    }
}

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

impl LetterUse {
    /// Reads the marks of a letter, one for each class of elements.
    const fn of_classes(marks: &str) -> [Self; ElementClass::COUNT] {
        let (marks, mut uses) = (marks.as_bytes(), [Self::Unknown; ElementClass::COUNT]);
        let (mut index, mut class) = (0, 0);
        while index < marks.len() {
            if marks[index] != b' ' {
                uses[class] = Self::of(marks[index]);
                class += 1;
            }
            index += 1;
        }
        assert!(class == ElementClass::COUNT, "a mark for each class");
        uses
    }

    const fn of(mark: u8) -> Self {
        match mark {
            b'!' => Self::Needed,
            b'o' => Self::Allowed,
            b'C' => Self::ChainNeeded,
            b'c' => Self::Chain,
            b'-' => Self::Ignored,
            b'p' => Self::PathOnly,
            b'.' => Self::Unknown,
            _ => panic!("unknown mark"),
        }
    }

    /// Whether the element takes a value, from its own text or the path's.
    const fn takes_value(self) -> bool {
        !matches!(self, Self::Unknown | Self::Ignored)
    }

    /// Whether the letter has an effect in the element's own text.
    pub const fn counts(self) -> bool {
        matches!(self, Self::Needed | Self::Allowed | Self::ChainNeeded | Self::Chain)
    }
}

impl ElementClass {
    /// The number of classes with uses of their own.
    const COUNT: usize = Self::Unread as usize;

    /// Returns the use of a letter on this element.
    pub fn use_of(self, letter: Letter) -> LetterUse {
        letter.declaration().uses.get(self as usize).copied().unwrap_or(LetterUse::Allowed)
    }

    /// Whether elements of this class take a value of the letter, from their own text or the path's.
    pub(crate) fn takes(self, letter: Letter) -> bool {
        self.use_of(letter).takes_value()
    }

    /// Returns the letters that have an effect in the text of an element of this class, for help. @ is left out: it needs a text of its own.
    pub fn known_letters(self) -> impl Iterator<Item = char> {
        Letter::all()
            .filter(move |letter| *letter != Letter::At && self.use_of(*letter).counts())
            .map(Letter::as_char)
    }

    pub(crate) fn needed_letters(self) -> impl Iterator<Item = Letter> {
        Letter::all().filter(move |letter| self.use_of(*letter) == LetterUse::Needed)
    }

    /// Whether elements of this class have support bars, or give the parameters for the support bars of others.
    pub(crate) fn has_bars(self) -> bool {
        matches!(self, Self::PathStart | Self::Support | Self::HelicalSupport)
    }
}
