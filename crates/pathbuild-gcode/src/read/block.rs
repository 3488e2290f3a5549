//! What a line of G-code consists of.

use std::borrow::Cow;
use std::ops::Range;

use super::expression::{Code, Op};
use super::text::decode;

/// Bytes `start..end` of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "a range")]
pub struct Span {
    pub start: u32,
    pub end: u32,
}

impl Span {
    /// From byte `start` up to byte `end`; lines are short enough for 32 bits.
    pub(crate) fn new(start: usize, end: usize) -> Self {
        let index = |byte| u32::try_from(byte).unwrap_or(u32::MAX);
        Self { start: index(start), end: index(end) }
    }

    /// As a range of indices.
    pub fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// A number as it was written: its text is the word's span, its value the nearest double.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    /// The value, in the program's unit.
    pub value: f64,
    /// Digits behind the point.
    pub decimals: u8,
}

/// What stands behind a letter or `=`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the types say it")]
pub enum Value {
    Number(Number),
    Expression(Code),
}

/// A letter and its value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Word {
    /// In capitals.
    pub letter: u8,
    /// What it is set to.
    pub value: Value,
    /// Letter and value in the line.
    pub span: Span,
}

/// `#5=...` or `#<name>=...`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Setting {
    pub target: Target,
    pub value: Value,
    pub span: Span,
}

/// Which parameter is set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// The number is what the code comes to.
    Numbered(Code),
    /// The name's place in the line, without `<` and `>`.
    Named(Span),
}

/// A remark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Comment {
    pub style: CommentStyle,
    /// The text without its signs.
    pub text: Span,
}

/// How a comment is marked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CommentStyle {
    /// `( )`
    Round,
    /// `;`
    Semicolon,
    /// `//`
    Slashes,
    /// `!`
    Bang,
    /// What stands behind `%`.
    Percent,
    /// What stands behind M0 or M117 on controls that show it.
    Message,
}

/// The correction formula behind a number: `Z1.000(=1.000+0.5*[#51-5.000])`. (book: language/probes)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Formula {
    /// Index of the word it belongs to.
    pub word: u32,
    /// `(==`: the number is already the formula's value.
    pub applied: bool,
    /// What it computes.
    pub code: Code,
    /// From `(` to `)`.
    pub span: Span,
}

/// A line that could be read. Blank lines are none.
#[derive(Clone, Copy, Debug)]
pub struct Block<'a> {
    /// From 1.
    pub line: u32,
    /// The line without its end.
    pub text: &'a [u8],
    /// The block number N.
    pub number: Option<Number>,
    /// It begins with `/`: a switch at the machine can leave it out.
    pub optional: bool,
    /// In the order of the text.
    pub words: &'a [Word],
    /// In the order of the text. They take effect when every value of the line has been read.
    pub settings: &'a [Setting],
    /// In the order of the text.
    pub comments: &'a [Comment],
    /// In the order of the text.
    pub formulas: &'a [Formula],
    /// An O word and everything behind it.
    pub o_word: Option<Span>,
    pub(super) code: &'a [Op],
}

impl<'a> Block<'a> {
    /// The operations of an expression in this block, operands first.
    pub fn code(&self, code: Code) -> &'a [Op] {
        &self.code[code.range()]
    }

    /// A piece of the line.
    pub fn slice(&self, span: Span) -> &'a [u8] {
        self.text.get(span.range()).unwrap_or_default()
    }

    /// A piece of the line as text: UTF-8, or Windows-1252 where it is not.
    pub fn text_of(&self, span: Span) -> Cow<'a, str> {
        decode(self.slice(span))
    }

    /// The formula of a word, by the word's index.
    pub fn formula(&self, word: usize) -> Option<&'a Formula> {
        self.formulas.iter().find(|formula| formula.word as usize == word)
    }
}
