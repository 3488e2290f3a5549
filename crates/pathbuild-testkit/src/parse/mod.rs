//! The text form of drawings. The README.md of this crate describes it for authors.

mod arcs;
mod cursor;
mod curves;
mod header;
mod inserts;
mod lexer;
mod line_type;
mod modifiers;
mod shapes;
mod statement;
mod texts;

pub(crate) use lexer::tokens;

use pathbuild_draw::{DrawError, Sheet};

use crate::furniture::finish;
use statement::Parser;

/// Parses a drawing in text form.
///
/// # Errors
/// All errors in the text, each with its line and column.
pub fn sheet(text: &str) -> Result<Sheet, Vec<DrawError>> {
    let mut parser = Parser::default();
    for (number, line) in (1..).zip(text.lines()) {
        parser.line(line, number);
    }
    let (draft, furniture) = parser.finish()?;
    finish(draft, furniture)
}
