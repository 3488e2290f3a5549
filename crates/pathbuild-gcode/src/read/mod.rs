//! G-code text to blocks of words, line by line. (book: program/reading)
//!
//! Purely lexical: which letters and codes there are, and what they do, is the interpreter's business. A line that cannot be read is
//! reported and left out; reading goes on with the next one.

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

pub use block::{Block, Comment, CommentStyle, Formula, Number, Setting, Span, Target, Value, Word};
pub use expression::{Binary, Code, Function, Op};
pub use problems::{At, Problems};
pub use reader::{BlockReader, LONGEST_LINE};
pub use text::quote;
