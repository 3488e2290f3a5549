//! Converts errors in control texts to diagnostics that give their position in the text and in its file.

use std::ops::Range;

use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, TextFault};

use super::control_text::{ControlText, ControlTextKind};

/// Adds the position of an error: the name of the text, line and column in it, and line and column in the file.
pub(super) fn locate(
    diagnostic: Diagnostic,
    kind: ControlTextKind,
    text: &ControlText,
    span: Range<usize>,
    file: &Utf8Path,
) -> Diagnostic {
    let (line, column) = text.place(span.start);
    let (start, content) = text.line_around(span.start);
    let fault = TextFault::new(content, span.start - start..span.end.saturating_sub(start));
    let mut diagnostic = diagnostic
        .quoting("text", kind.name())
        .with("line", u64::from(line))
        .with("column", u64::from(column))
        .with_text(fault)
        .in_file(file);
    if let Some((line, column)) = text.place_in_file(span.start) {
        diagnostic = diagnostic.at_line(line, Some(column));
    }
    diagnostic
}
