//! Jumping over sections that hold nothing of interest, without looking at their pairs.
//!
//! `ENDSEC` on a line of its own after a line `0` can only be the pair that ends a section: where a code stands it would be no number.
//! So a search for the word finds the end at the speed of memory. A `0/SECTION` found first means that the end is missing.

use memchr::memmem::{self, Finder};

use crate::pairs::{Pair, Pairs};

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
        let finder = Finder::new("SEC");
        let mut from = self.consumed();
        while let Some(found) = finder.find(&self.bytes()[from..]) {
            let at = from + found;
            if let Some(start) = self.pair_start(at).filter(|start| *start >= self.consumed()) {
                self.jump_to(start);
                return match self.next() {
                    Ok(pair) if pair.is("SECTION") => SectionEnd::Missing(pair),
                    _ => SectionEnd::Ended,
                };
            }
            from = at + 3;
        }
        self.jump_to(self.bytes().len());
        SectionEnd::CutOff { line: self.line() }
    }

    /// Where the pair `0/ENDSEC` or `0/SECTION` begins whose value has `SEC` at `at`, if it is one.
    fn pair_start(&self, at: usize) -> Option<usize> {
        let (before, from_here) = self.bytes().split_at(at);
        let (before, after) = match (before.strip_suffix(b"END"), from_here.strip_prefix(b"SECTION")) {
            (Some(before), _) => (before, &from_here[3..]),
            (None, Some(after)) => (before, after),
            (None, None) => return None,
        };
        self.zero_line_before(before, after)
    }

    /// Where the line `0` begins that is the line before a keyword, given what is before and after the keyword.
    fn zero_line_before(&self, before: &[u8], after: &[u8]) -> Option<usize> {
        let at_line_end = trim_blanks(after).first().is_none_or(|byte| matches!(byte, b'\r' | b'\n'));
        let code_line = trim_blanks_end(before).strip_suffix(&[self.line_end()]).filter(|_| at_line_end)?;
        let before_zero = code_line.trim_ascii_end().strip_suffix(b"0")?;
        let before_line = trim_blanks_end(before_zero);
        let is_whole_line = before_line.is_empty() || before_line.ends_with(&[self.line_end()]);
        is_whole_line.then_some(before_line.len())
    }
}

/// Whether the pair `0/EOF` is at the end of the file, whatever short padding follows it.
pub(crate) fn ends_with_eof(pairs: &Pairs<'_>) -> bool {
    const TAIL: usize = 4096;
    let bytes = pairs.bytes();
    let tail = bytes.len().saturating_sub(TAIL).max(pairs.consumed());
    memmem::rfind_iter(&bytes[tail..], "EOF").any(|found| {
        let (before, after) = bytes.split_at(tail + found);
        pairs.zero_line_before(before, &after[3..]).is_some()
    })
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
