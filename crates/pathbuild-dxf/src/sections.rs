//! Finding pairs without looking at those before: the ends of sections, the layers among the tables, a variable of the header.
//!
//! A keyword on a line of its own after a line with its group code can only be that pair: where a code stands it would be no number.
//! So a search for the word finds the pair at the speed of memory.

use std::ops::Range;
use std::sync::LazyLock;

use memchr::memmem::{Finder, FinderRev, rfind_iter};

use crate::pairs::{Pair, Pairs};

/// A keyword that is searched for.
pub(crate) type Keyword = LazyLock<Finder<'static>>;

/// The keyword of a record of the LAYER table.
pub(crate) static LAYER: Keyword = LazyLock::new(|| Finder::new("LAYER"));

static SECTION_OR_END: Keyword = LazyLock::new(|| Finder::new("SEC"));
static EOF: LazyLock<FinderRev<'static>> = LazyLock::new(|| FinderRev::new("EOF"));

/// The pair that a skipped section ended with, or should have ended before.
pub(crate) enum SectionEnd<'a> {
    /// `0/ENDSEC`; the pairs go on behind it.
    Ended,
    /// `0/SECTION` of the next one.
    Missing(Pair<'a>),
    /// The input ends first.
    CutOff {
        /// The last line.
        line: u32,
    },
}

impl<'a> Pairs<'a> {
    /// Jumps behind the end of the current section.
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

    /// Those behind the next pair of this code and keyword. Their lines are not counted.
    pub(crate) fn behind(&self, code: &str, keyword: &Keyword) -> Option<Self> {
        let mut pairs = self.at(self.place(code, keyword)?, self.line());
        pairs.next().ok()?;
        Some(pairs)
    }

    /// Where the next pair of this code and keyword begins.
    pub(crate) fn place(&self, code: &str, keyword: &Keyword) -> Option<usize> {
        let from = self.consumed();
        let length = keyword.needle().len();
        let mut found = keyword.find_iter(&self.bytes()[from..]);
        found.find_map(|at| self.pair_of(code.as_bytes(), from + at..from + at + length))
    }

    /// Where the last pair of this code and keyword before this place begins.
    pub(crate) fn last_place(&self, code: &str, keyword: &str, end: usize) -> Option<usize> {
        let from = self.consumed();
        let mut found = rfind_iter(self.bytes().get(from..end)?, keyword);
        found.find_map(|at| self.pair_of(code.as_bytes(), from + at..from + at + keyword.len()))
    }

    /// Where the pair begins whose code is this and whose value is here, if there is one that is not consumed.
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

/// Whether the pair `0/EOF` is at the end of the file, whatever short padding follows it.
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
