//! Splits a line into words, assignments to parameters, and comments. (book: program/reading)

use memchr::memchr;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Diagnostic, Message};

use super::block::{LineParts, Span, Value, Word, decode};
use super::number;
use super::problems::{Problems, SourcePosition};
use crate::dialect::{Rules, Slash, Spelling};

/// Error for a line that cannot be read, whose reason has been reported.
#[derive(Clone, Copy, Debug)]
pub(super) struct UnreadableLine;

/// Reads words as long as they have the simplest form. Returns the offset of the first byte that does not belong to such a word.
#[inline]
pub(super) fn plain_words(bytes: &[u8], start: usize, words: &mut Vec<Word>) -> usize {
    let mut at = start;
    while let Some(&letter) = bytes.get(at) {
        if letter == b' ' {
            at += 1;
            continue;
        }
        if !letter.is_ascii_uppercase() || matches!(letter, b'N' | b'O') {
            break;
        }
        let Some((number, end)) = number::scan_plain(bytes, at + 1) else { break };
        words.push(Word { letter, value: Value::Number(number), span: Span::new(at, end) });
        at = end;
    }
    at
}

/// A line that is being read, with the position reached.
pub(super) struct Line<'l> {
    pub(super) bytes: &'l [u8],
    pub(super) at: usize,
    pub(super) out: &'l mut LineParts,
    pub(super) rules: &'static Rules,
    pub(super) problems: &'l mut Problems,
    /// Line number, counted from 1.
    pub(super) number: u32,
    /// Whether a checksum has been read.
    pub(super) has_checksum: bool,
}

impl Line<'_> {
    /// Reads the rest of the line.
    pub(super) fn read(&mut self) -> Result<(), UnreadableLine> {
        self.block_delete();
        loop {
            self.at = plain_words(self.bytes, self.at, &mut self.out.words);
            self.message();
            let Some(byte) = self.peek() else { break };
            match byte {
                b' ' | b'\t' => self.at += 1,
                b'a'..=b'z' if !self.spelling().small_letters => self.small_letter(byte)?,
                b'a'..=b'z' | b'A'..=b'Z' => self.word(byte.to_ascii_uppercase())?,
                b'(' => self.round_comment()?,
                b';' | b'!' | b'/' => self.comment_to_end(byte)?,
                b'#' => self.setting()?,
                b'0'..=b'9' | b'+' | b'-' | b'.' => self.bare_number()?,
                b'@' | b'^' | b'$' if self.rules.words.letters.contains(byte) => self.word(byte)?,
                b'*' if self.spelling().checksums => self.checksum()?,
                _ => self.unknown_character()?,
            }
        }
        self.check_number_has_checksum();
        Ok(())
    }

    pub(super) fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    pub(super) fn skip_blanks(&mut self) {
        while matches!(self.peek(), Some(b' ' | b'\t')) {
            self.at += 1;
        }
    }

    /// Returns the range of the next character.
    pub(super) fn current_span(&self) -> Span {
        let length = self.bytes[self.at..]
            .iter()
            .skip(1)
            .position(|byte| byte & 0xC0 != 0x80)
            .map_or(1, |rest| rest + 1);
        Span::new(self.at, (self.at + length).min(self.bytes.len()))
    }

    /// Reports the problem that makes the line unreadable.
    pub(super) fn fault(
        &mut self,
        message: &'static Message,
        span: Span,
        values: impl FnOnce(Diagnostic) -> Diagnostic,
    ) -> UnreadableLine {
        self.report(message, span, values);
        UnreadableLine
    }

    pub(super) fn report(
        &mut self,
        message: &'static Message,
        span: Span,
        values: impl FnOnce(Diagnostic) -> Diagnostic,
    ) {
        let dialect = self.rules.dialect.name();
        let at = SourcePosition { line: self.number, text: self.bytes, span };
        self.problems.add(message, at, |diagnostic| values(diagnostic).quoting("dialect", dialect));
    }

    /// Reads a checksum that a host appended to a line for Marlin, as in `N5 G1 X2*98`: it is the exclusive or of all bytes before `*` and extends to
    /// the end of the line or to a comment.
    pub(super) fn checksum(&mut self) -> Result<(), UnreadableLine> {
        let star = self.at;
        let rest = &self.bytes[star + 1..];
        let length = memchr(b';', rest).unwrap_or(rest.len());
        let expected = self.bytes[..star].trim_ascii_start().iter().fold(0, |sum, byte| sum ^ byte);
        let found = decode(rest[..length].trim_ascii()).into_owned();
        self.at = star + 1 + length;
        let span = Span::new(star, star + 1 + rest[..length].trim_ascii_end().len());
        if found.parse() == Ok(expected) {
            self.has_checksum = true;
            return Ok(());
        }
        Err(self.fault(&say::WRONG_CHECKSUM, span, |d| {
            d.quoting("found", found).with("expected", u64::from(expected))
        }))
    }

    /// Warns about a block number without a checksum, and about a checksum without a block number.
    pub(super) fn check_number_has_checksum(&mut self) {
        if !self.spelling().checksums || self.has_checksum == self.out.number.is_some() {
            return;
        }
        let message =
            if self.has_checksum { &say::CHECKSUM_WITHOUT_NUMBER } else { &say::NUMBER_WITHOUT_CHECKSUM };
        self.report(message, Span::new(0, self.bytes.len()), |d| d);
    }

    pub(super) fn spelling(&self) -> &'static Spelling {
        &self.rules.spelling
    }

    /// Reports a lower-case letter, for a control that reads only upper case. The word is read nevertheless.
    fn small_letter(&mut self, letter: u8) -> Result<(), UnreadableLine> {
        let letter = letter.to_ascii_uppercase();
        self.report(&say::SMALL_LETTER, self.current_span(), |d| d.with("letter", char::from(letter)));
        self.word(letter)
    }

    fn block_delete(&mut self) {
        self.skip_blanks();
        if self.peek() != Some(b'/') || self.spelling().slash == Slash::Unknown {
            return;
        }
        match self.spelling().slash {
            Slash::Optional => {
                self.out.optional = true;
                self.report(&say::OPTIONAL_LINE, self.current_span(), |d| d);
            }
            _ => self.report(&say::SLASH_DROPPED, self.current_span(), |d| d),
        }
        self.at += 1;
        if self.spelling().slash_numbers && matches!(self.peek(), Some(b'1'..=b'9')) {
            self.at += 1;
        }
    }

    pub(super) fn unknown_character(&mut self) -> Result<(), UnreadableLine> {
        let span = self.current_span();
        let found = decode(&self.bytes[span.range()]).into_owned();
        if !self.rules.words.lenient {
            return Err(self.fault(&say::UNKNOWN_CHARACTER, span, |d| d.quoting("found", found)));
        }
        self.report(&say::UNKNOWN_CHARACTER_PASSED, span, |d| d.quoting("found", found));
        self.at = span.end as usize;
        Ok(())
    }
}
