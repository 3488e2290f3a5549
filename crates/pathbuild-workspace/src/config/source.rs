use std::ops::Range;

use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, Message, TextFault};

/// A text file, and how a byte of it becomes a line and column.
#[derive(Clone, Copy, Debug)]
pub(super) struct Source<'a> {
    pub(super) file: &'a Utf8Path,
    pub(super) text: &'a str,
}

impl<'a> Source<'a> {
    /// A diagnostic that underlines a byte range; of a range over several lines, its part in the first.
    pub(super) fn fault(&self, message: &'static Message, span: Range<usize>) -> Diagnostic {
        let start = self.text.floor_char_boundary(span.start);
        let line = self.line_around(start);
        let column = self.text[line.start..start].chars().count() + 1;
        let text = &self.text[line.clone()];
        Diagnostic::new(message)
            .in_file(self.file)
            .at_line(self.line_number(start), u32::try_from(column).ok())
            .with_text(TextFault::new(
                text,
                start - line.start..span.end.min(line.end).saturating_sub(line.start),
            ))
    }

    /// The line, from 1, in which a byte is.
    pub(super) fn line_number(&self, byte: usize) -> u32 {
        let before = &self.text[..self.text.floor_char_boundary(byte)];
        u32::try_from(before.matches('\n').count() + 1).unwrap_or(u32::MAX)
    }

    /// A byte range of the text, as it stands there.
    pub(super) fn slice(&self, span: Range<usize>) -> &'a str {
        self.text.get(span).unwrap_or_default()
    }

    fn line_around(&self, byte: usize) -> Range<usize> {
        let start = self.text[..byte].rfind('\n').map_or(0, |end| end + 1);
        let end = self.text[byte..].find(['\n', '\r']).map_or(self.text.len(), |length| byte + length);
        start..end.max(start)
    }
}
