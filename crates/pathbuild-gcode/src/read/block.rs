//! The parts of a line of G-code.

use std::borrow::Cow;
use std::ops::{Deref, Range};

use pathbuild_diagnostic::{Diagnostic, TextFault};

/// The bytes `start..end` of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "a range")]
pub struct Span {
    pub start: u32,
    pub end: u32,
}

impl Span {
    /// Creates a span from offsets, which fit into 32 bits because lines are short.
    pub(crate) fn new(start: usize, end: usize) -> Self {
        let index = |byte| u32::try_from(byte).unwrap_or(u32::MAX);
        Self { start: index(start), end: index(end) }
    }

    /// Converts the span to a range of indices.
    pub fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// A number, whose value is the double nearest to its text; the text is in the span of its word.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    /// Value in the unit of the program.
    pub value: f64,
    /// Number of decimals.
    pub decimals: u8,
}

/// The value after a letter or `=`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the types say it")]
pub enum Value {
    Number(Number),
    Expression(Code),
}

/// A letter and its value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Word {
    /// The letter in upper case.
    pub letter: u8,
    /// The value after the letter.
    pub value: Value,
    /// Range of letter and value in the line.
    pub span: Span,
}

/// An assignment to a parameter: `#5=...` or `#<name>=...`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Assignment {
    pub target: Target,
    pub value: Value,
    pub span: Span,
}

/// The parameter that an assignment sets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// A numbered parameter; the code calculates its number.
    Numbered(Code),
    /// A named parameter, by the range of its name in the line, without `<` and `>`.
    Named(Span),
}

/// A comment, with its notation and position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Comment {
    pub style: CommentStyle,
    /// Range of the text without the comment marks.
    pub text: Span,
}

/// The notation of a comment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CommentStyle {
    /// A comment in `( )`.
    Round,
    /// A comment from `;` to the end of the line.
    Semicolon,
    /// A comment from `//` to the end of the line.
    Slashes,
    /// A comment from `!` to the end of the line.
    Bang,
    /// The text after `%`.
    Percent,
    /// The text after M0 or M117 on controls that display it.
    Message,
}

/// The correction formula after a number: `Z1.000(=1.000+0.5*[#51-5.000])`. (book: language/probes)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Formula {
    /// Index of the word to which the formula belongs.
    pub word: u32,
    /// Whether the formula begins with `(==`, so that the number before it is already its result.
    pub applied: bool,
    /// The compiled formula.
    pub code: Code,
    /// Range from `(` to `)`.
    pub span: Span,
}

/// An O word: it defines or calls a subroutine, or determines which line is executed next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OWord {
    /// Range from the letter to its last value.
    pub span: Span,
    /// Range of the word's number, or of its name without `<` and `>`.
    pub name: Span,
    /// The keyword of the word.
    pub kind: OWordKind,
}

/// The keyword of an O word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the keywords say it")]
pub enum OWordKind {
    Sub,
    EndSub,
    Return,
    Call,
    Repeat,
    EndRepeat,
    If,
    ElseIf,
    Else,
    EndIf,
    While,
    EndWhile,
    Do,
    Break,
    Continue,
    /// An unknown keyword, or any keyword after a name that is calculated. Its values are not read.
    Other,
}

/// A line that could be read and is not blank.
#[derive(Clone, Copy, Debug)]
pub struct Block<'a> {
    /// Line number, counted from 1.
    pub line: u32,
    /// The line without its line break.
    pub text: &'a [u8],
    pub(super) parts: &'a LineParts,
}

/// The parts of a line, each in the order of the text. The reader reuses them for the next line to avoid allocations.
#[derive(Debug, Default)]
pub struct LineParts {
    /// Block number (N).
    pub number: Option<Number>,
    /// Whether the line begins with `/`, so that a switch on the machine can skip it.
    pub optional: bool,
    /// The words.
    pub words: Vec<Word>,
    /// Assignments to parameters. They take effect after all values of the line have been read.
    pub settings: Vec<Assignment>,
    /// The comments.
    pub comments: Vec<Comment>,
    /// The correction formulas.
    pub formulas: Vec<Formula>,
    /// The O word, if the line has one.
    pub o_word: Option<OWord>,
    /// The values in brackets after the O word.
    pub arguments: Vec<Code>,
    pub(super) code: Vec<Op>,
}

impl LineParts {
    pub(super) fn clear(&mut self) {
        self.number = None;
        self.optional = false;
        self.words.clear();
        self.settings.clear();
        self.comments.clear();
        self.formulas.clear();
        self.o_word = None;
        self.arguments.clear();
        self.code.clear();
    }

    pub(super) fn is_empty(&self) -> bool {
        self.words.is_empty() && self.settings.is_empty() && self.number.is_none()
    }
}

impl Deref for Block<'_> {
    type Target = LineParts;

    fn deref(&self) -> &LineParts {
        self.parts
    }
}

impl<'a> Block<'a> {
    /// Returns the range of the whole block.
    pub(crate) fn span(&self) -> Span {
        Span::new(0, self.text.len())
    }

    /// Returns the operations of an expression in this block, with operands first.
    pub fn code(&self, code: Code) -> &'a [Op] {
        &self.parts.code[code.range()]
    }

    /// Returns a part of the line.
    pub fn slice(&self, span: Span) -> &'a [u8] {
        self.text.get(span.range()).unwrap_or_default()
    }

    /// Returns a part of the line as text, decoded as UTF-8 or else as Windows-1252.
    pub fn text_of(&self, span: Span) -> Cow<'a, str> {
        decode(self.slice(span))
    }

    /// Returns the formula of the word with this index.
    pub fn formula(&self, word: usize) -> Option<&'a Formula> {
        self.parts.formulas.iter().find(|formula| formula.word as usize == word)
    }
}

/// A compiled expression: a range of the operations of its block.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Code {
    pub(super) first: u32,
    pub(super) end: u32,
}

impl Code {
    pub(super) fn range(self) -> Range<usize> {
        self.first as usize..self.end as usize
    }
}

/// An operation on a stack of numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Op {
    /// Pushes a number.
    Number(f64),
    /// Replaces a number by the value of the parameter with that number.
    Parameter,
    /// Pushes the value of the parameter whose name is this part of the line.
    Named(Span),
    /// Pushes 1 if there is a parameter with this name, otherwise 0.
    Exists(Span),
    /// Replaces the topmost number by the function's value.
    Function(Function),
    /// Replaces the two topmost numbers y, x by the angle of (x, y) in degrees.
    Atan,
    /// Replaces the two topmost numbers by the operator's result.
    Binary(Binary),
}

/// Functions of one number; angles are in degrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Function {
    Negate,
    Abs,
    Acos,
    Asin,
    Cos,
    Exp,
    /// Rounds down to an integer.
    Fix,
    /// Rounds up to an integer.
    Fup,
    Ln,
    Round,
    Sin,
    Sqrt,
    Tan,
}

/// Operators on two numbers. Comparisons and logical operators return 1 or 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Binary {
    Power,
    Times,
    Divide,
    Modulo,
    Plus,
    Minus,
    And,
    Or,
    Xor,
    Equal,
    NotEqual,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

/// Maximum number of bytes shown of the faulty part of a line, and of the text on either side of it.
const EXCERPT_BYTES: usize = 160;

/// Decodes UTF-8, or else Windows-1252.
pub(crate) fn decode(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => pathbuild_encoding::WINDOWS_1252.decode_without_bom_handling(bytes).0,
    }
}

/// Returns the column of a byte, in characters counted from 1.
pub(crate) fn column(line: &[u8], byte: usize) -> u32 {
    let before = decode(&line[..byte.min(line.len())]).chars().count();
    u32::try_from(before + 1).unwrap_or(u32::MAX)
}

/// Returns the line with its faulty part marked. Of a long line, only the text around that part is kept.
pub(crate) fn fault(line: &[u8], span: Span) -> TextFault {
    let start = (span.start as usize).min(line.len());
    let end = (span.end as usize).clamp(start, line.len()).min(start + EXCERPT_BYTES);
    let before = excerpt_before(&line[..start]);
    let marked = decode(&line[start..end]);
    let after = excerpt_after(&line[end..]);
    TextFault::new(&format!("{before}{marked}{after}"), before.len()..before.len() + marked.len())
}

fn excerpt_before(bytes: &[u8]) -> Cow<'_, str> {
    if bytes.len() <= EXCERPT_BYTES {
        return decode(bytes);
    }
    let cut = (bytes.len() - EXCERPT_BYTES..bytes.len())
        .find(|&at| bytes[at] & 0xC0 != 0x80)
        .unwrap_or(bytes.len());
    format!("...{}", decode(&bytes[cut..])).into()
}

fn excerpt_after(bytes: &[u8]) -> Cow<'_, str> {
    if bytes.len() <= EXCERPT_BYTES {
        return decode(bytes);
    }
    let cut = (0..EXCERPT_BYTES).rev().find(|&at| bytes[at] & 0xC0 != 0x80).unwrap_or(0);
    format!("{}...", decode(&bytes[..cut])).into()
}

/// Adds the text of the line to each diagnostic that only has the number of its line.
pub fn quote<'d>(diagnostics: impl IntoIterator<Item = &'d mut Diagnostic>, file: &[u8]) {
    let is_bare = |one: &&mut Diagnostic| one.text.is_none() && one.place.line.is_some();
    let mut bare: Vec<&mut Diagnostic> = diagnostics.into_iter().filter(is_bare).collect();
    bare.sort_by_key(|one| one.place.line);
    let end_of_line = end_of_line(file);
    let mut lines = (1_u32..).zip(file.split(|byte| *byte == end_of_line)).peekable();
    for diagnostic in bare {
        let wanted = diagnostic.place.line.unwrap_or(0);
        while lines.next_if(|(number, _)| *number < wanted).is_some() {}
        if let Some((_, line)) = lines.peek().filter(|(number, _)| *number == wanted) {
            let line = line.trim_ascii_end();
            diagnostic.text = Some(fault(line, Span::new(0, line.len())));
            diagnostic.place.column.get_or_insert(1);
        }
    }
}

/// Returns the character that ends the lines of a file: LF, or CR in files that contain only CR.
pub(super) fn end_of_line(file: &[u8]) -> u8 {
    if memchr::memchr(b'\n', file).is_none() { b'\r' } else { b'\n' }
}
