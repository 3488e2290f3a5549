//! Parses pairs of group code and value carefully, one by one, and finds pairs without parsing those before them; `groups` is the
//! fast path. (book: reference/dxf)
//!
//! A line ends with LF, CRLF, CRCRLF or, in files of old Macs, a lone CR; whether LF or CR ends lines is decided once per file. Codes may
//! be padded; values are returned unchanged.

use std::ops::Range;
use std::sync::LazyLock;

use memchr::memmem::{Finder, FinderRev, rfind_iter};
use memchr::{memchr, memchr_iter, memchr2};

/// A group code and its value.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair<'a> {
    pub(crate) code: i32,
    /// 1-based line of the code.
    pub(crate) line: u32,
    /// The value without its line end, not trimmed.
    pub(crate) value: &'a [u8],
}

/// The reason why there is no further pair.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Stop<'a> {
    /// The input ends. An incomplete pair and blank lines at the end are ignored.
    End {
        /// The line at which the next code or value is missing.
        line: u32,
    },
    /// A line that should hold a group code holds something else.
    BadCode {
        /// The faulty line.
        line: u32,
        /// Content of the line, shortened.
        found: &'a [u8],
    },
}

/// Iterator over the pairs of a file or a part of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pairs<'a> {
    bytes: &'a [u8],
    at: usize,
    line: u32,
    line_end: u8,
}

impl Pair<'_> {
    /// The value without surrounding blanks.
    pub(crate) fn trimmed(&self) -> &[u8] {
        self.value.trim_ascii()
    }

    /// Whether this is `0/KEYWORD`, ignoring case and surrounding blanks.
    #[inline]
    pub(crate) fn is(&self, keyword: &str) -> bool {
        let keyword = keyword.as_bytes();
        let is_begin = |byte: u8| byte <= b' ' || byte.to_ascii_uppercase() == keyword[0];
        self.code == 0
            && self.value.len() >= keyword.len()
            && is_begin(self.value[0])
            && (self.value == keyword || self.trimmed().eq_ignore_ascii_case(keyword))
    }
}

impl<'a> Pairs<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, line: 1, line_end: line_end(bytes) }
    }

    pub(crate) fn next(&mut self) -> Result<Pair<'a>, Stop<'a>> {
        let line = self.line;
        let code = self.code()?;
        if self.at >= self.bytes.len() {
            return Err(Stop::End { line: line.saturating_add(1) });
        }
        let value = without_cr(self.next_line());
        self.line = line.saturating_add(2);
        Ok(Pair { code, line, value })
    }

    /// The input from its start, including the pairs that have been consumed.
    #[inline]
    pub(crate) fn bytes(&self) -> &'a [u8] {
        self.bytes
    }

    pub(crate) fn consumed(&self) -> usize {
        self.at
    }

    /// The line of the next pair.
    pub(crate) fn line(&self) -> u32 {
        self.line
    }

    pub(crate) fn line_end(&self) -> u8 {
        self.line_end
    }

    /// Returns the pairs of the same file from another position on; `line` is the line at that position.
    pub(crate) fn at(&self, at: usize, line: u32) -> Self {
        Self { at, line, ..*self }
    }

    /// Returns the pairs that come before `end`.
    pub(crate) fn until(&self, end: &Self) -> Self {
        Self { bytes: &self.bytes[..end.at], ..*self }
    }

    /// Jumps ahead to `at`, which must be the start of a line.
    pub(crate) fn jump_to(&mut self, at: usize) {
        let lines = memchr_iter(self.line_end, &self.bytes[self.at..at]).count();
        self.line = self.line.saturating_add(u32::try_from(lines).unwrap_or(u32::MAX));
        self.at = at;
    }

    /// Returns the line of the next pair, counted from the start of the file.
    pub(crate) fn counted_line(&self) -> u32 {
        let mut pairs = Self { at: 0, line: 1, ..*self };
        pairs.jump_to(self.at);
        pairs.line
    }

    /// Parses the line of a group code, which may be padded with any number of blanks.
    fn code(&mut self) -> Result<i32, Stop<'a>> {
        let at = self.at;
        let line = self.next_line();
        let code = std::str::from_utf8(line.trim_ascii()).ok().and_then(|text| text.parse().ok());
        code.ok_or_else(|| self.missing_code_error(at, line))
    }

    /// Consumes a line and returns it without its end.
    fn next_line(&mut self) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        let length = line_length(self.line_end, rest);
        self.at = (self.at + length + 1).min(self.bytes.len());
        &rest[..length]
    }

    /// Returns why a line has no group code: the end of the file if only blanks follow, otherwise a bad code. The line is not consumed.
    #[cold]
    fn missing_code_error(&mut self, at: usize, line: &'a [u8]) -> Stop<'a> {
        self.at = at;
        let rest = &self.bytes[at..];
        if rest.len() <= LONGEST_PADDING && rest.trim_ascii_start().is_empty() {
            return Stop::End { line: self.line };
        }
        Stop::BadCode { line: self.line, found: &line[..line.len().min(MAX_EXCERPT_BYTES)] }
    }
}

/// Maximum number of trailing blanks, in bytes, that are treated as the end of the file.
const LONGEST_PADDING: usize = 1 << 16;

/// Largest number of bytes of a faulty line shown in a message.
const MAX_EXCERPT_BYTES: usize = 60;

/// Returns the length of the first line without its end.
#[inline]
pub(crate) fn line_length(line_end: u8, lines: &[u8]) -> usize {
    memchr(line_end, lines).unwrap_or(lines.len())
}

/// Detects the line end: LF, unless the first line ends with a CR that no LF follows.
fn line_end(bytes: &[u8]) -> u8 {
    let Some(first) = memchr2(b'\n', b'\r', bytes) else { return b'\n' };
    let after = bytes[first..].iter().find(|byte| **byte != b'\r');
    if after == Some(&b'\n') { b'\n' } else { b'\r' }
}

/// Removes all trailing CRs.
#[inline]
pub(crate) fn without_cr(mut line: &[u8]) -> &[u8] {
    while let [before @ .., b'\r'] = line {
        line = before;
    }
    line
}

pub(crate) type Keyword = LazyLock<Finder<'static>>;

pub(crate) static LAYER: Keyword = LazyLock::new(|| Finder::new("LAYER"));

static SECTION: Keyword = LazyLock::new(|| Finder::new("SECTION"));
static SECTION_OR_END: Keyword = LazyLock::new(|| Finder::new("SEC"));
static EOF: LazyLock<FinderRev<'static>> = LazyLock::new(|| FinderRev::new("EOF"));

/// The end of a skipped section.
pub(crate) enum SectionEnd<'a> {
    /// The section ended with `0/ENDSEC`; the pairs continue after it.
    Ended,
    /// `0/ENDSEC` is missing: the next section begins with this pair.
    Missing(Pair<'a>),
    /// The input ended within the section.
    CutOff {
        /// The line after the last line end of the input.
        line: u32,
    },
}

impl<'a> Pairs<'a> {
    pub(crate) fn skip_section(&mut self) -> SectionEnd<'a> {
        let from = self.consumed();
        let bytes = self.bytes();
        let found = SECTION_OR_END.find_iter(&bytes[from..]).find_map(|at| {
            let at = from + at;
            let end = || bytes[..at].ends_with(b"END").then_some(at - 3..at + 3);
            let begin = || bytes[at..].starts_with(b"SECTION").then_some(at..at + 7);
            self.pair_start(b"0", end().or_else(begin)?)
        });
        self.jump_to(found.unwrap_or(bytes.len()));
        match self.next() {
            Ok(pair) if pair.is("ENDSEC") => SectionEnd::Ended,
            Ok(pair) => SectionEnd::Missing(pair),
            Err(_) => SectionEnd::CutOff { line: self.line() },
        }
    }

    /// Returns the name of the next section that has one of these names, and the pairs after it.
    pub(crate) fn next_section(&self, names: &[&str]) -> Option<(Pair<'a>, Self)> {
        let from = self.consumed();
        let mut found = SECTION.find_iter(&self.bytes()[from..]);
        found.find_map(|at| {
            let start = self.pair_start(b"0", from + at..from + at + SECTION.needle().len())?;
            let mut pairs = self.at(start, self.line());
            pairs.next().ok()?;
            let name = pairs.next().ok().filter(|name| name.code == 2)?;
            let is_name = |known: &&str| name.trimmed().eq_ignore_ascii_case(known.as_bytes());
            names.iter().find(|known| is_name(known))?;
            // Lines are only counted for the section that is returned.
            let mut pairs = *self;
            pairs.jump_to(start);
            let name = pairs.next().and_then(|_| pairs.next()).ok()?;
            Some((name, pairs))
        })
    }

    /// Returns the pairs after the next one with this code and keyword. Lines in between are not counted.
    pub(crate) fn after_next(&self, code: &str, keyword: &Keyword) -> Option<Self> {
        let mut pairs = self.at(self.find_pair(code, keyword)?, self.line());
        pairs.next().ok()?;
        Some(pairs)
    }

    /// Finds the position of the next pair with this code and keyword.
    pub(crate) fn find_pair(&self, code: &str, keyword: &Keyword) -> Option<usize> {
        let from = self.consumed();
        let length = keyword.needle().len();
        let mut found = keyword.find_iter(&self.bytes()[from..]);
        found.find_map(|at| self.pair_start(code.as_bytes(), from + at..from + at + length))
    }

    /// Finds the position of the last pair with this code and keyword before `end`.
    pub(crate) fn find_last_pair(&self, code: &str, keyword: &str, end: usize) -> Option<usize> {
        let from = self.consumed();
        let mut found = rfind_iter(self.bytes().get(from..end)?, keyword);
        found.find_map(|at| self.pair_start(code.as_bytes(), from + at..from + at + keyword.len()))
    }

    /// Returns the position of the unconsumed pair that has this code and the value at this range, if there is one.
    fn pair_start(&self, code: &[u8], value: Range<usize>) -> Option<usize> {
        let (before, after) = (&self.bytes()[..value.start], &self.bytes()[value.end..]);
        let before = trim_blanks_end(before).strip_suffix(&[self.line_end()])?;
        let start =
            before.iter().rposition(|byte| *byte == self.line_end()).map_or(0, |line_end| line_end + 1);
        let has_code = before[start..].trim_ascii() == code;
        let is_whole_line = trim_blanks(after).first().is_none_or(|byte| matches!(byte, b'\r' | b'\n'));
        (has_code && is_whole_line && start >= self.consumed()).then_some(start)
    }
}

/// Whether `0/EOF` occurs near the end of the file. A short padding may follow it.
pub(crate) fn ends_with_eof(pairs: &Pairs<'_>) -> bool {
    const SEARCHED_BYTES: usize = 4096;
    let bytes = pairs.bytes();
    let tail = bytes.len().saturating_sub(SEARCHED_BYTES).max(pairs.consumed());
    EOF.rfind_iter(&bytes[tail..]).any(|at| pairs.pair_start(b"0", tail + at..tail + at + 3).is_some())
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
