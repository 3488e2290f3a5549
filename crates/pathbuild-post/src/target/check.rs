//! Checks a text against the words accepted by its target.

use std::ops::Range;

use pathbuild_diagnostic::{Diagnostic, TextFault, messages::posts};

use super::{LinePart, Target};
use pathbuild_gcode::dialect::{Acceptance, LineLength};
use pathbuild_gcode::read::LONGEST_LINE;

/// Maximum number of errors reported.
const MOST_ERRORS: usize = 20;

/// Returns what the target would refuse, by line of the text.
pub(crate) fn check(text: &[u8], target: &Target) -> Vec<Diagnostic> {
    let mut errors = Vec::new();
    for (number, line) in (1_u64..).zip(text.split(|&byte| byte == b'\n')) {
        let line = String::from_utf8_lossy(line);
        let line = line.trim_end_matches('\r');
        Checker { target, number, line, after_change: false, errors: &mut errors }.line();
        if errors.len() >= MOST_ERRORS {
            break;
        }
    }
    errors
}

struct Checker<'a> {
    target: &'a Target,
    number: u64,
    line: &'a str,
    /// Whether the previous word was M6.
    after_change: bool,
    errors: &'a mut Vec<Diagnostic>,
}

impl Checker<'_> {
    fn line(&mut self) {
        let (mut at, mut bare) = (0, 0);
        for piece in self.target.pieces(self.line) {
            let text = match piece {
                LinePart::Code(code) => {
                    self.code(code, at);
                    bare += code.bytes().filter(|byte| !byte.is_ascii_whitespace()).count();
                    code
                }
                LinePart::Comment(comment) => {
                    self.comment(comment, at);
                    comment
                }
            };
            at += text.len();
        }
        self.length(bare);
    }

    fn length(&mut self, bare: usize) {
        let (length, longest) = match self.target.longest {
            Some(LineLength::Bare(longest)) => (bare, longest),
            Some(LineLength::Whole(longest)) => (self.line.len(), longest),
            // The limit for reading it back.
            None => (self.line.len(), LONGEST_LINE),
        };
        if length > longest {
            let diagnostic = Diagnostic::new(&posts::LINE_TOO_LONG).with("length", length);
            self.report(diagnostic.with("longest", longest), 0..self.line.len());
        }
    }

    fn report(&mut self, diagnostic: Diagnostic, span: Range<usize>) {
        if self.errors.len() >= MOST_ERRORS {
            return;
        }
        let diagnostic = diagnostic.quoting("dialect", self.target.name).with("line", self.number);
        let diagnostic = diagnostic.at_line(u32::try_from(self.number).unwrap_or(u32::MAX), None);
        self.errors.push(diagnostic.with_text(TextFault::new(self.line, span)));
    }

    fn reject(&mut self, span: Range<usize>) {
        let word = self.line[span.clone()].trim().to_owned();
        self.report(Diagnostic::new(&posts::WORD_REJECTED).quoting("word", word), span);
    }

    /// Checks a comment, because some bytes act even there.
    fn comment(&mut self, text: &str, start: usize) {
        let acts = |c: char| !c.is_ascii() || matches!(c, '!' | '?' | '~');
        if let Some((at, c)) = text.char_indices().find(|(_, c)| self.target.has_real_time_bytes && acts(*c))
        {
            self.reject(start + at..start + at + c.len_utf8());
        }
    }

    fn code(&mut self, code: &str, start: usize) {
        let mut at = 0;
        while let Some(c) = code[at..].chars().next() {
            let is_first = start + at == 0;
            at += match c {
                c if c.is_whitespace() => c.len_utf8(),
                '%' if is_first && self.target.percent => 1,
                '/' if is_first => 1,
                c if c.is_ascii_alphabetic() => self.word(&code[at..], start + at),
                '0'..='9' if self.after_change => self.bare_number(&code[at..]),
                c => {
                    self.reject(start + at..start + at + c.len_utf8());
                    c.len_utf8()
                }
            };
        }
    }

    fn bare_number(&mut self, text: &str) -> usize {
        self.after_change = false;
        text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len())
    }

    /// Checks the word at the beginning of a text and returns its length.
    fn word(&mut self, text: &str, start: usize) -> usize {
        let rest = text[1..].trim_start_matches([' ', '\t']);
        let digits = rest.find(|c: char| !matches!(c, '0'..='9' | '.' | '+' | '-')).unwrap_or(rest.len());
        let letter = text.as_bytes()[0].to_ascii_uppercase();
        let Ok(value) = rest[..digits].parse::<f64>() else {
            self.reject(start..start + 1);
            return 1;
        };
        let length = text.len() - rest.len() + digits;
        if !self.takes(letter, value) {
            self.reject(start..start + length);
        }
        self.after_change = self.target.bare_tool_number && letter == b'M' && value == 6.0;
        length
    }

    fn takes(&self, letter: u8, value: f64) -> bool {
        let words = self.target.words;
        match letter {
            b'G' => tenths(value).is_some_and(|code| words.g(code) != Acceptance::Unknown),
            b'M' => tenths(value).is_some_and(|code| words.m(code) == Acceptance::Taken),
            b'N' => self.target.line_numbers,
            letter => words.letters.contains(letter),
        }
    }
}

/// Ten times the number of a code.
fn tenths(value: f64) -> Option<u16> {
    let tenths = value * 10.0;
    let is_code = (tenths - tenths.round()).abs() < 1e-6 && (0.0..=60_000.0).contains(&tenths);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
    is_code.then_some(tenths.round() as u16)
}
