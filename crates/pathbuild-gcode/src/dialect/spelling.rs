//! The spelling rules of a dialect, which the reader needs to split lines into words.

/// The lexical rules of a dialect.
#[derive(Debug)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts, not states")]
pub struct Spelling {
    /// Whether words may have lower-case letters.
    pub small_letters: bool,
    /// `( )`.
    pub round_comments: Style,
    /// Whether `(` within a round comment is an ordinary character; otherwise it is an error.
    pub nested_comments: bool,
    /// `;` to the end of the line.
    pub semicolon_comments: Style,
    /// `//` to the end of the line.
    pub slash_comments: Style,
    /// `!` to the end of the line.
    pub bang_comments: Style,
    /// Meaning of blanks.
    pub blanks: Blanks,
    /// Meaning of `%`.
    pub percent: Percent,
    /// Meaning of `/` at the beginning of a line.
    pub slash: Slash,
    /// Maximum length of a line.
    pub line_length: Option<LineLength>,
    /// Largest block number N; `None` if there are no block numbers.
    pub block_numbers: Option<u32>,
    /// Whether block numbers may have decimals.
    pub fractional_block_numbers: bool,
    /// The syntax of `[ ]` and `#`, if they are supported.
    pub grammar: Option<Grammar>,
    /// Whether numbers may have a decimal comma, which causes a warning.
    pub decimal_comma: bool,
    /// Whether `(=...)` after a number is its correction formula. (book: language/probes)
    pub formulas: bool,
    /// Whether a number without a letter after M6 is the tool number.
    pub bare_tool_number: bool,
    /// Whether `!`, `?`, `~` and all bytes above 127 act immediately, even in comments.
    pub real_time_bytes: bool,
    /// Beginnings of comments that the control obeys: it writes files, runs programs or stops.
    pub active_comments: &'static [&'static str],
    /// M codes after which the rest of the line, except for S and P, is a message for the operator.
    pub message_codes: &'static [u16],
}

/// Whether a notation belongs to the dialect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// It does.
    Usual,
    /// It is read with a warning, because the dialect is not known to support it.
    Doubtful,
    /// It is not supported.
    Unknown,
}

/// Meaning of blanks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blanks {
    /// They are ignored, even inside a number: `X1 2` is X12.
    Ignored,
    /// They separate words: `M06 05` is M6 and 5.
    Separate,
}

/// Meaning of a line that begins with `%`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Percent {
    /// The first begins the program, the second ends it.
    Frame,
    /// It begins the program.
    Start,
    /// The first begins the program, even after a block number, and the rest of its line is the name of the program.
    Title,
    /// The control rejects it.
    Refused,
}

/// Meaning of `/` at the beginning of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slash {
    /// A switch on the machine decides whether the line is executed.
    Optional,
    /// It is discarded and the line is executed.
    Dropped,
    /// It is not supported.
    Unknown,
}

/// Maximum length of a line, in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineLength {
    /// Of the line as it is in the file, without the line break.
    Whole(usize),
    /// Without blanks and comments.
    Bare(usize),
}

/// What may replace a number.
#[derive(Debug)]
pub struct Grammar {
    /// The operators and their precedence.
    pub operators: Operators,
    /// `#<name>`.
    pub names: bool,
    /// Whether a sign may precede `[`, `#` or a function.
    pub signs: bool,
    /// Parameters are numbered from 1 to this.
    pub parameters: u32,
    /// Whether there are O words (subroutines, branches).
    pub o_words: bool,
}

/// The precedence of operators. All are left-associative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operators {
    /// `**`, then `* / MOD`, then `+ - AND OR XOR`.
    Nist,
    /// `**`, then `* / MOD`, then `+ -`, then comparisons, then `AND OR XOR`.
    LinuxCnc,
}
