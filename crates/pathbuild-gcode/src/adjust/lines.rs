//! Lines of a file, and errors in them.

use std::ops::Range;

use pathbuild_diagnostic::{Diagnostic, Message, TextFault};

use super::Source;

/// A line of a file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    pub(super) source: Source<'a>,
    /// Line number, counted from 1.
    pub(super) number: u32,
    /// Including the line break.
    pub(super) bytes: &'a [u8],
}

/// The byte order mark that some editors write at the start of a file; empty if there is none.
pub(super) fn mark(bytes: &[u8]) -> &[u8] {
    let mark = b"\xef\xbb\xbf";
    if bytes.starts_with(mark) { &bytes[..mark.len()] } else { &[] }
}

/// The lines of a file, without the byte order mark.
pub(super) fn lines(source: Source<'_>) -> impl Iterator<Item = Line<'_>> {
    let bytes = &source.bytes[mark(source.bytes).len()..];
    let lines = bytes.split_inclusive(|byte| *byte == b'\n');
    (1..).zip(lines).map(move |(number, bytes)| Line { source, number, bytes })
}

impl<'a> Line<'a> {
    /// The line without its line break.
    pub(super) fn content(self) -> &'a [u8] {
        let content = self.bytes.strip_suffix(b"\n").unwrap_or(self.bytes);
        content.strip_suffix(b"\r").unwrap_or(content)
    }

    /// Creates a diagnostic for a range of bytes.
    pub(super) fn fault(self, message: &'static Message, span: Range<usize>) -> Diagnostic {
        let content = self.content();
        let text = |range: Range<usize>| String::from_utf8_lossy(&content[range]);
        let span = span.start.min(content.len())..span.end.min(content.len());
        let column = u32::try_from(text(0..span.start).chars().count() + 1).unwrap_or(u32::MAX);
        // Of a very long line, only the part around the error is shown.
        let shown = span.start.saturating_sub(AROUND)..content.len().min(span.start + AROUND);
        let before = text(shown.start..span.start).len();
        let fault = text(span.start..span.end.min(shown.end)).len();
        Diagnostic::new(message)
            .in_file(self.source.file)
            .at_line(self.number, Some(column))
            .with_text(TextFault::new(&text(shown), before..before + fault))
    }
}

/// Number of bytes shown before an error, and from its start on.
const AROUND: usize = 500;
