//! Finds pairs without parsing those before them: ends of sections, layers in the tables, variables of the header.
//!
//! A keyword on a line of its own, after a line with its group code, can only be that pair, because it would not parse as a code. A plain
//! text search therefore finds the pair at memory speed.

use std::ops::Range;
use std::sync::LazyLock;

use memchr::memmem::{Finder, FinderRev, rfind_iter};

use crate::pairs::{Pair, Pairs};

/// A keyword to search for.
pub(crate) type Keyword = LazyLock<Finder<'static>>;

/// The keyword of LAYER records.
pub(crate) static LAYER: Keyword = LazyLock::new(|| Finder::new("LAYER"));

static SECTION_OR_END: Keyword = LazyLock::new(|| Finder::new("SEC"));
static EOF: LazyLock<FinderRev<'static>> = LazyLock::new(|| FinderRev::new("EOF"));

/// How a skipped section ended.
pub(crate) enum SectionEnd<'a> {
    /// With `0/ENDSEC`; the pairs continue after it.
    Ended,
    /// With the `0/SECTION` of the next section.
    Missing(Pair<'a>),
    /// With the end of the input.
    CutOff {
        /// The last line.
        line: u32,
    },
}

impl<'a> Pairs<'a> {
    /// Skips to the end of the current section.
    pub(crate) fn skip_section(&mut self) -> SectionEnd<'a> {
        let from = self.consumed();
        let bytes = self.bytes();
        let found = SECTION_OR_END.find_iter(&bytes[from..]).find_map(|at| {
            let at = from + at;
            let end = || bytes[..at].ends_with(b"END").then_some(at - 3..at + 3);
            let begin = || bytes[at..].starts_with(b"SECTION").then_some(at..at + 7);
            self.pair_of(b"0", end().or_else(begin)?)
        });
        self.jump_to(found.unwrap_or(bytes.len()));
        match self.next() {
            Ok(pair) if pair.is("ENDSEC") => SectionEnd::Ended,
            Ok(pair) => SectionEnd::Missing(pair),
            Err(_) => SectionEnd::CutOff { line: self.line() },
        }
    }

    /// The pairs after the next one with this code and keyword. Lines in between are not counted.
    pub(crate) fn behind(&self, code: &str, keyword: &Keyword) -> Option<Self> {
        let mut pairs = self.at(self.place(code, keyword)?, self.line());
        pairs.next().ok()?;
        Some(pairs)
    }

    /// Position of the next pair with this code and keyword.
    pub(crate) fn place(&self, code: &str, keyword: &Keyword) -> Option<usize> {
        let from = self.consumed();
        let length = keyword.needle().len();
        let mut found = keyword.find_iter(&self.bytes()[from..]);
        found.find_map(|at| self.pair_of(code.as_bytes(), from + at..from + at + length))
    }

    /// Position of the last pair with this code and keyword before `end`.
    pub(crate) fn last_place(&self, code: &str, keyword: &str, end: usize) -> Option<usize> {
        let from = self.consumed();
        let mut found = rfind_iter(self.bytes().get(from..end)?, keyword);
        found.find_map(|at| self.pair_of(code.as_bytes(), from + at..from + at + keyword.len()))
    }

    /// Position of the unconsumed pair that has this code and the value at this range, if there is one.
    fn pair_of(&self, code: &[u8], value: Range<usize>) -> Option<usize> {
        let (before, after) = (&self.bytes()[..value.start], &self.bytes()[value.end..]);
        let before = trim_blanks_end(before).strip_suffix(&[self.line_end()])?;
        let start =
            before.iter().rposition(|byte| *byte == self.line_end()).map_or(0, |line_end| line_end + 1);
        let has_code = before[start..].trim_ascii() == code;
        let is_whole_line = trim_blanks(after).first().is_none_or(|byte| matches!(byte, b'\r' | b'\n'));
        (has_code && is_whole_line && start >= self.consumed()).then_some(start)
    }
}

/// Whether the file ends with `0/EOF`, apart from a short padding.
pub(crate) fn ends_with_eof(pairs: &Pairs<'_>) -> bool {
    const TAIL: usize = 4096;
    let bytes = pairs.bytes();
    let tail = bytes.len().saturating_sub(TAIL).max(pairs.consumed());
    EOF.rfind_iter(&bytes[tail..]).any(|at| pairs.pair_of(b"0", tail + at..tail + at + 3).is_some())
}

fn trim_blanks(mut bytes: &[u8]) -> &[u8] {
    while let [b' ' | b'\t', rest @ ..] = bytes {
        bytes = rest;
    }
    bytes
}

fn trim_blanks_end(mut bytes: &[u8]) -> &[u8] {
    while let [rest @ .., b' ' | b'\t'] = bytes {
        bytes = rest;
    }
    bytes
}
