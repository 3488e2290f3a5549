//! Bytes to pairs of group code and value: the innermost loop, without allocation. (reference/dxf.md section 4, point 1)
//!
//! A line ends with LF, CRLF, CRCRLF, or, in files of old Macs, with CR alone; which of the two bytes ends lines is decided once a
//! file. Codes may be padded, values are given as they stand.

use memchr::{memchr, memchr_iter};

/// A group code and its value.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair<'a> {
    /// The group code; codes of more than six digits are cut, nobody knows them anyway.
    pub(crate) code: i32,
    /// 1-based line of the code.
    pub(crate) line: u32,
    /// The value without its line end, not trimmed.
    pub(crate) value: &'a [u8],
}

/// Why there is no further pair.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Stop<'a> {
    /// The input ends; an incomplete pair and blank lines before do not count.
    End {
        /// The line after the last.
        line: u32,
    },
    /// A line where a group code should stand holds something else.
    BadCode {
        /// That line.
        line: u32,
        /// What it holds, cut to some length.
        found: &'a [u8],
    },
}

/// The pairs of a file or of a part of one.
#[derive(Clone, Debug)]
pub(crate) struct Pairs<'a> {
    bytes: &'a [u8],
    at: usize,
    line: u32,
    line_end: u8,
}

impl Pair<'_> {
    /// The value without blanks around it.
    pub(crate) fn trimmed(&self) -> &[u8] {
        self.value.trim_ascii()
    }

    /// Whether this is `0/KEYWORD`.
    pub(crate) fn is(&self, keyword: &str) -> bool {
        self.code == 0 && self.trimmed().eq_ignore_ascii_case(keyword.as_bytes())
    }
}

impl<'a> Pairs<'a> {
    /// The pairs of a whole file.
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, line: 1, line_end: line_end(bytes) }
    }

    /// The next pair.
    #[inline]
    pub(crate) fn next(&mut self) -> Result<Pair<'a>, Stop<'a>> {
        let line = self.line;
        let code = self.code()?;
        if self.at >= self.bytes.len() {
            return Err(Stop::End { line: line.saturating_add(1) });
        }
        let value = self.value();
        self.line = line.saturating_add(2);
        Ok(Pair { code, line, value })
    }

    /// Skips pairs up to the next whose code is 0, and returns that one.
    #[inline]
    pub(crate) fn next_zero(&mut self) -> Result<Pair<'a>, Stop<'a>> {
        loop {
            let pair = self.next()?;
            if pair.code == 0 {
                return Ok(pair);
            }
        }
    }

    /// The whole input.
    pub(crate) fn bytes(&self) -> &'a [u8] {
        self.bytes
    }

    /// How many bytes of it are consumed.
    pub(crate) fn consumed(&self) -> usize {
        self.at
    }

    /// The line of the next pair.
    pub(crate) fn line(&self) -> u32 {
        self.line
    }

    /// The byte that ends lines.
    pub(crate) fn line_end(&self) -> u8 {
        self.line_end
    }

    /// Goes on at a later place, which must be the beginning of a line.
    pub(crate) fn jump_to(&mut self, at: usize) {
        let lines = memchr_iter(self.line_end, &self.bytes[self.at..at]).count();
        self.line = self.line.saturating_add(u32::try_from(lines).unwrap_or(u32::MAX));
        self.at = at;
    }

    /// Reads the line of a group code.
    #[inline]
    fn code(&mut self) -> Result<i32, Stop<'a>> {
        let rest = &self.bytes[self.at..];
        let mut at = blanks(rest, 0);
        let negative = rest.get(at) == Some(&b'-');
        at += usize::from(negative);
        let first_digit = at;
        let mut code = 0_i32;
        while let Some(digit) = rest.get(at).map(|byte| byte.wrapping_sub(b'0')).filter(|digit| *digit < 10) {
            code = if code < 100_000 { code * 10 + i32::from(digit) } else { code };
            at += 1;
        }
        let has_digits = at > first_digit;
        let at = self.after_line_end(rest, at).filter(|_| has_digits);
        let Some(at) = at else { return Err(self.no_code()) };
        self.at += at;
        Ok(if negative { -code } else { code })
    }

    /// The index behind the line end that follows at `at`, blanks allowed before it; `None` when something else follows.
    #[inline]
    fn after_line_end(&self, rest: &[u8], at: usize) -> Option<usize> {
        let mut at = at;
        loop {
            match rest.get(at) {
                None => return Some(at),
                Some(&byte) if byte == self.line_end => return Some(at + 1),
                Some(b' ' | b'\t' | b'\r') => at += 1,
                Some(_) => return None,
            }
        }
    }

    /// Reads the line of a value.
    #[inline]
    fn value(&mut self) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        let length = memchr(self.line_end, rest).unwrap_or(rest.len());
        self.at = (self.at + length + 1).min(self.bytes.len());
        without_cr(&rest[..length])
    }

    #[cold]
    fn no_code(&self) -> Stop<'a> {
        let rest = &self.bytes[self.at..];
        if rest.trim_ascii().is_empty() {
            return Stop::End { line: self.line };
        }
        let length = memchr(self.line_end, rest).unwrap_or(rest.len());
        let shown = length.min(MOST_SHOWN);
        Stop::BadCode { line: self.line, found: without_cr(&rest[..shown]) }
    }
}

/// Most bytes of a line that are shown when it is wrong.
const MOST_SHOWN: usize = 60;

/// LF, unless the first line ends with a CR and no LF follows it.
fn line_end(bytes: &[u8]) -> u8 {
    let Some(first) = memchr::memchr2(b'\n', b'\r', bytes) else { return b'\n' };
    let after = bytes[first..].iter().find(|byte| **byte != b'\r');
    if after == Some(&b'\n') { b'\n' } else { b'\r' }
}

#[inline]
fn blanks(bytes: &[u8], from: usize) -> usize {
    let mut at = from;
    while matches!(bytes.get(at), Some(b' ' | b'\t')) {
        at += 1;
    }
    at
}

#[inline]
fn without_cr(mut line: &[u8]) -> &[u8] {
    while let [before @ .., b'\r'] = line {
        line = before;
    }
    line
}
