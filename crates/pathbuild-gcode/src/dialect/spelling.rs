//! How a dialect is spelt: what the reader needs to cut lines into words.

/// The lexical rules of a dialect.
#[derive(Debug)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts, not states")]
pub struct Spelling {
    /// Letters of words may be small.
    pub small_letters: bool,
    /// `( )`.
    pub round_comments: Style,
    /// `(` within a round comment is an error where this is false, an ordinary character where it is true.
    pub nested_comments: bool,
    /// `;` to the end of the line.
    pub semicolon_comments: Style,
    /// `//` to the end of the line.
    pub slash_comments: Style,
    /// `!` to the end of the line.
    pub bang_comments: Style,
    /// What blanks mean.
    pub blanks: Blanks,
    /// What `%` means.
    pub percent: Percent,
    /// What `/` in front of a line means.
    pub slash: Slash,
    /// How long a line may be.
    pub line_length: Option<LineLength>,
    /// The largest block number N; `None` where there are no block numbers.
    pub block_numbers: Option<u32>,
    /// Whether block numbers may have decimals.
    pub fractional_block_numbers: bool,
    /// `[ ]` and `#`, where they are known.
    pub grammar: Option<Grammar>,
    /// A number may have a decimal comma (with a warning).
    pub decimal_comma: bool,
    /// `(=...)` behind a number is its correction formula. (book: language/probes)
    pub formulas: bool,
    /// A number without a letter behind M6 is the tool's.
    pub bare_tool_number: bool,
    /// Bytes that act at once wherever they stand, comments included: `!`, `?`, `~` and everything above 127.
    pub real_time_bytes: bool,
    /// What a comment begins with that the control obeys: it writes files, runs programs or stops.
    pub active_comments: &'static [&'static str],
    /// M codes behind which, and behind their S and P, the rest of the line is a message for the person at the machine.
    pub message_codes: &'static [u16],
}

/// Whether a spelling is the dialect's own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// It is.
    Usual,
    /// Read, with a warning: the dialect is not known to take it.
    Doubtful,
    /// Not known at all.
    Unknown,
}

/// What blanks mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blanks {
    /// Nothing, even inside a number: `X1 2` is X12.
    Ignored,
    /// They separate: `M06 05` is M6 and 5.
    Separate,
}

/// What a line beginning with `%` means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Percent {
    /// The first begins the program, the second ends it.
    Frame,
    /// It begins the program.
    Start,
    /// The first begins the program, also behind a block number, and the rest of its line is the program's name.
    Title,
    /// The control refuses it.
    Refused,
}

/// What `/` in front of a line means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slash {
    /// A switch at the machine decides whether the line is run.
    Optional,
    /// It is thrown away and the line is run.
    Dropped,
    /// Nothing: it is no word's beginning.
    Unknown,
}

/// The longest line that a control takes, in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineLength {
    /// As it stands in the file, without its end.
    Whole(usize),
    /// Without blanks and comments.
    Bare(usize),
}

/// What may stand in place of a number.
#[derive(Debug)]
pub struct Grammar {
    /// Which operators there are and how tightly they bind.
    pub operators: Operators,
    /// `#<name>`.
    pub names: bool,
    /// A sign in front of `[`, `#` or a function.
    pub signs: bool,
    /// Parameters are numbered from 1 to this.
    pub parameters: u32,
    /// O words (subroutines, branches).
    pub o_words: bool,
}

/// How operators bind. Everything is left-associative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operators {
    /// `**`, then `* / MOD`, then `+ - AND OR XOR`.
    Nist,
    /// `**`, then `* / MOD`, then `+ -`, then comparisons, then `AND OR XOR`.
    LinuxCnc,
}
