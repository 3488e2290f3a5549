use std::ops::Range;

use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, Message, TextFault};

/// A text file that maps byte offsets to lines and columns. The time to look up an offset does not grow with the file.
#[derive(Clone, Debug)]
pub(super) struct Source<'a> {
    file: &'a Utf8Path,
    text: &'a str,
    /// Offset of the beginning of each line.
    lines: Vec<usize>,
    /// Number of characters before each block.
    characters: Vec<usize>,
}

/// Size in bytes of the blocks for which characters are counted.
const BLOCK: usize = 1 << 10;

/// Number of bytes of a line that are shown on each side of a fault.
const AROUND: usize = 200;

impl<'a> Source<'a> {
    /// A file with this text.
    pub(super) fn new(file: &'a Utf8Path, text: &'a str) -> Self {
        let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        let lines = std::iter::once(0).chain(ends.map(|(end, _)| end + 1)).collect();
        let counts = text.as_bytes().chunks(BLOCK).scan(0, |before, block| {
            let count = *before;
            *before += beginnings(block);
            Some(count)
        });
        Self { file, text, lines, characters: counts.collect() }
    }

    /// A diagnostic that underlines a byte range, or the part of it in its first line.
    pub(super) fn fault(&self, message: &'static Message, span: Range<usize>) -> Diagnostic {
        let start = self.text.floor_char_boundary(span.start);
        let number = self.line_index(start);
        let begin = self.lines[number];
        let column = self.character(start) - self.character(begin) + 1;
        let (from, end) = (self.shown_from(begin, start), self.shown_to(start, span.end));
        Diagnostic::new(message)
            .in_file(self.file)
            .at_line(self.line_number(start), u32::try_from(column).ok())
            .with_text(TextFault::new(
                &self.text[from..end],
                start - from..span.end.min(end).saturating_sub(from),
            ))
    }

    /// Number of the line that contains a byte, counted from 1.
    pub(super) fn line_number(&self, byte: usize) -> u32 {
        u32::try_from(self.line_index(byte) + 1).unwrap_or(u32::MAX)
    }

    /// The text in a byte range.
    pub(super) fn slice(&self, span: Range<usize>) -> &'a str {
        self.text.get(span).unwrap_or_default()
    }

    fn line_index(&self, byte: usize) -> usize {
        self.lines.partition_point(|line| *line <= byte).saturating_sub(1)
    }

    /// Number of characters that begin before a byte.
    fn character(&self, byte: usize) -> usize {
        let block = (byte / BLOCK).min(self.characters.len().saturating_sub(1));
        let rest = &self.text.as_bytes()[block * BLOCK..byte];
        self.characters.get(block).copied().unwrap_or_default() + beginnings(rest)
    }

    /// First byte that is shown of a line with a fault at `start`.
    fn shown_from(&self, begin: usize, start: usize) -> usize {
        begin.max(self.text.floor_char_boundary(start.saturating_sub(AROUND)))
    }

    /// End of the part that is shown if the fault ends at `end`.
    fn shown_to(&self, start: usize, end: usize) -> usize {
        let most =
            self.text.ceil_char_boundary((end.clamp(start, start + AROUND)) + AROUND).min(self.text.len());
        self.text[start..most].find(['\n', '\r']).map_or(most, |length| start + length)
    }
}

/// Number of characters that begin in these bytes.
fn beginnings(bytes: &[u8]) -> usize {
    bytes.iter().filter(|byte| byte.cast_signed() >= -0x40).count()
}
