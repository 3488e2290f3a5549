//! Splits G-code text into blocks of words, line by line. (book: program/reading)
//!
//! Reading is purely lexical; the interpreter decides which letters and codes exist and what they do. A line that cannot be read is
//! reported and skipped.

mod block;
mod comment;
mod expression;
mod formula;
mod line;
mod number;
mod problems;
mod reader;
mod real_time;
mod text;
mod word;

pub use block::{
    Block, Comment, CommentStyle, Formula, Number, OWord, OWordKind, Setting, Span, Target, Value, Word,
};
pub use expression::{Binary, Code, Function, Op};
pub use problems::{At, Problems};
pub(crate) use reader::Place;
pub use reader::{BlockReader, LONGEST_LINE};
pub use text::quote;
