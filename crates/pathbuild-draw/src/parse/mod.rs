//! The text form of drawings. README.md of this crate describes it for those who write it.

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

use crate::draft::Draft;
use crate::error::DrawError;
use statement::Parser;

/// Reads a drawing; its texts have no places yet.
pub(crate) fn draft(text: &str) -> Result<Draft, Vec<DrawError>> {
    let mut parser = Parser::default();
    for (number, line) in (1..).zip(text.lines()) {
        parser.line(line, number);
    }
    parser.finish()
}
