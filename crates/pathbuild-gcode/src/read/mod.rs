//! Splits G-code text into blocks of words, line by line. (book: program/reading)
//!
//! Reading is purely lexical; the interpreter decides which letters and codes exist and what they do. A line that cannot be read is
//! reported and skipped.

mod block;
mod encoding;
mod expression;
mod line;
mod number;
mod problems;
mod reader;
mod word;

pub use block::{
    Assignment, Binary, Block, Code, Comment, CommentStyle, Formula, Function, LineParts, Number, OWord,
    OWordKind, Op, Span, Target, Value, Word, quote,
};
pub use encoding::{BYTE_ORDER_MARK, is_utf_16};
pub use problems::{Problems, SourcePosition};
pub(crate) use reader::Place;
pub use reader::{BlockReader, LONGEST_LINE};
