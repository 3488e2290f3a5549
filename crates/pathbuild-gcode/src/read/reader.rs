//! Reads a file line by line.

use memchr::memchr;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Diagnostic, Message, Text};

use super::block::{Block, Comment, CommentStyle, LineParts, Span, end_of_line};
use super::encoding::BYTE_ORDER_MARK;
use super::line::{Line, plain_words};
use super::problems::{Problems, SourcePosition};
use super::word::{begins_message, plain_formula};
use crate::dialect::{LineLength, Percent, Rules};

/// Maximum length of a line in bytes. No machine accepts lines of a comparable length.
pub const LONGEST_LINE: usize = 65_536;

/// An iterator over the blocks of a file, which lends them one by one.
///
/// ```
/// # use pathbuild_gcode::{dialect::Dialect, read::BlockReader};
/// let mut reader = BlockReader::new(b"G01 X1.5\n", Dialect::Rs274.rules());
/// let block = reader.next_block().expect("one line");
/// assert_eq!((block.line, block.words.len()), (1, 2));
/// ```
#[derive(Debug)]
pub struct BlockReader<'t> {
    text: &'t [u8],
    rules: &'static Rules,
    end_of_line: u8,
    /// Offset of the next line.
    at: usize,
    /// The line last read, counted from 1.
    line: u32,
    state: State,
    parts: LineParts,
    problems: Problems,
    /// Whether subprograms may follow the end of the program.
    has_subprograms: bool,
}

/// A place between two lines of a file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Offset of the next line.
    at: usize,
    /// Number of the line before the place, counted from 1.
    line: u32,
}

/// The part of the file that the reader has reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// Nothing but comments and blank lines has been read.
    Leader,
    Program,
    /// The program ended in this line.
    Ended(u32),
}

impl<'t> BlockReader<'t> {
    /// Creates a reader at the beginning of a file.
    pub fn new(text: &'t [u8], rules: &'static Rules) -> Self {
        let text = text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(text);
        Self {
            text,
            rules,
            end_of_line: end_of_line(text),
            at: 0,
            line: 0,
            state: State::Leader,
            parts: LineParts::default(),
            problems: Problems::default(),
            has_subprograms: false,
        }
    }

    pub(crate) fn place(&self) -> Place {
        Place { at: self.at, line: self.line }
    }

    /// Creates another reader of the same file, from a place within its program.
    pub(crate) fn reader_from(&self, Place { at, line }: Place) -> Self {
        Self { at, line, state: State::Program, ..Self::new(self.text, self.rules) }
    }

    pub(crate) fn reader_from_start(&self) -> Self {
        Self::new(self.text, self.rules)
    }

    /// Whether a place is at or after the reader's position.
    pub(crate) fn is_before(&self, place: Place) -> bool {
        self.at <= place.at
    }

    /// Lets subprograms follow the end of the program.
    pub(crate) fn allow_subprograms(&mut self) {
        self.has_subprograms = true;
    }

    /// Continues the same file with further bytes. The bytes read so far must have ended with a line break.
    pub(crate) fn continue_with(self, text: &[u8]) -> BlockReader<'_> {
        let Self { rules, line, state, parts, problems, has_subprograms, .. } = self;
        let end_of_line = end_of_line(text);
        BlockReader { text, rules, end_of_line, at: 0, line, state, parts, problems, has_subprograms }
    }

    /// Returns the next line that is not blank and can be read.
    pub fn next_block(&mut self) -> Option<Block<'_>> {
        let text = loop {
            self.parts.clear();
            if let Some(line) = self.next_plain_line() {
                break line;
            }
            let line = self.next_line()?;
            if self.read(line) {
                break line;
            }
        };
        Some(Block { line: self.line, text, parts: &self.parts })
    }

    /// Ends the program at this point (M2, M30). The lines after it are not read. The first of them that is not `%`, blank or a comment is reported,
    /// unless subprograms may follow.
    pub fn end_program(&mut self) {
        if !matches!(self.state, State::Ended(_)) {
            self.state = State::Ended(self.line);
        }
    }

    /// Whether the program was ended by `%` or [`end_program`](Self::end_program).
    pub fn is_ended(&self) -> bool {
        matches!(self.state, State::Ended(_))
    }

    /// Returns the number of the line last read, counted from 1.
    pub fn line(&self) -> u32 {
        self.line
    }

    /// Returns the problems in the lines that were read.
    pub fn into_problems(self) -> Problems {
        self.problems
    }

    /// Returns the next line of the program that is not blank, without its line break.
    fn next_line(&mut self) -> Option<&'t [u8]> {
        while self.at < self.text.len() {
            let rest = &self.text[self.at..];
            let length = memchr(self.end_of_line, rest).unwrap_or(rest.len());
            self.at += length + 1;
            self.line = self.line.saturating_add(1);
            let line = trim_end(&rest[..length]);
            if line.is_empty() {
                continue;
            }
            if let State::Ended(end) = self.state {
                if line == b"%" || is_remark(line) {
                    continue;
                }
                if !self.has_subprograms {
                    let dialect = self.rules.dialect.name();
                    let message =
                        if self.rules.runs_past_end { &say::RUN_AFTER_END } else { &say::AFTER_END };
                    self.report(message, line, |d| {
                        d.with("line", u64::from(end)).quoting("dialect", dialect)
                    });
                }
                self.at = self.text.len();
                return None;
            }
            return Some(line);
        }
        None
    }

    /// Reads a line of plain words, as most lines are, without searching for its end first. If the line contains anything else, nothing
    /// is consumed.
    fn next_plain_line(&mut self) -> Option<&'t [u8]> {
        if self.state != State::Program {
            return None;
        }
        let rest = &self.text[self.at.min(self.text.len())..];
        let length = self.read_plain_words(&rest[..rest.len().min(LONGEST_LINE)]);
        let end = match rest.get(length..)? {
            [b'\n', ..] => 1,
            [b'\r', b'\n', ..] => 2,
            _ => 0,
        };
        let has_message = begins_message(&self.parts.words, &self.rules.spelling);
        if end == 0 || self.parts.words.is_empty() || has_message || length > self.safe_length() {
            self.parts.clear();
            return None;
        }
        self.at += length + end;
        self.line = self.line.saturating_add(1);
        Some(&rest[..length])
    }

    /// Reads words, and formulas if the dialect has them, as long as they have the simplest form. Returns the offset of the first other byte.
    fn read_plain_words(&mut self, line: &[u8]) -> usize {
        let mut at = plain_words(line, 0, &mut self.parts.words);
        while self.rules.spelling.formulas && line.get(at) == Some(&b'(') {
            let Some(end) = plain_formula(line, at, &mut self.parts) else { break };
            at = plain_words(line, end, &mut self.parts.words);
        }
        at
    }

    /// Returns a length in bytes up to which every line satisfies the dialect's limit.
    fn safe_length(&self) -> usize {
        match self.rules.spelling.line_length {
            Some(LineLength::Whole(most) | LineLength::BeforeSemicolon(most) | LineLength::Bare(most)) => {
                most
            }
            None => LONGEST_LINE,
        }
    }

    /// Reads a line into the parts. Returns false if it cannot be read, or is a `%` without any text.
    fn read(&mut self, line: &[u8]) -> bool {
        if line.len() > LONGEST_LINE {
            let shown = &line[..256];
            self.report(&say::LINE_MUCH_TOO_LONG, shown, |d| {
                d.with("length", line.len()).with("most", LONGEST_LINE)
            });
            return false;
        }
        if self.rules.spelling.real_time_bytes {
            self.check_real_time(line);
        }
        if let Some(at) = memchr(b'\r', line) {
            // Controls that end the line at a carriage return obey the rest, even if it is in a comment.
            let at = SourcePosition { line: self.line, text: line, span: Span::new(at, at + 1) };
            self.problems.add(&say::RETURN_IN_LINE, at, |d| d);
            return false;
        }
        let start = match self.percent(line) {
            PercentEffect::Nothing => 0,
            PercentEffect::Passed(start) => start,
            PercentEffect::Comment(text) => {
                self.parts.comments.push(Comment { style: CommentStyle::Percent, text });
                return !text.range().is_empty();
            }
        };
        if self.read_words(line, start).is_err() {
            return false;
        }
        self.check_length(line);
        if self.state == State::Leader && !(self.parts.words.is_empty() && self.parts.settings.is_empty()) {
            self.state = State::Program;
        }
        true
    }

    fn read_words(&mut self, line: &[u8], start: usize) -> Result<(), super::line::UnreadableLine> {
        Line {
            bytes: line,
            at: start,
            out: &mut self.parts,
            rules: self.rules,
            problems: &mut self.problems,
            number: self.line,
            has_checksum: false,
        }
        .read()
    }

    fn percent(&mut self, line: &[u8]) -> PercentEffect {
        let is_blank = |byte: &&u8| matches!(byte, b' ' | b'\t');
        let mut blanks = line.iter().take_while(is_blank).count();
        if self.rules.spelling.percent == Percent::Title {
            blanks += block_number_length(&line[blanks..]);
        }
        if line.get(blanks) != Some(&b'%') {
            return PercentEffect::Nothing;
        }
        let behind = blanks + 1;
        match self.rules.spelling.percent {
            Percent::Start if self.state == State::Leader => PercentEffect::Passed(behind),
            Percent::Start => {
                self.report(&say::SECOND_PERCENT, &line[..behind], |d| d);
                PercentEffect::Passed(behind)
            }
            Percent::Refused => {
                self.report(&say::UNKNOWN_PERCENT, &line[..behind], |d| d);
                PercentEffect::Passed(behind)
            }
            Percent::Title if self.state == State::Leader => {
                self.state = State::Program;
                PercentEffect::Comment(Span::new(behind, line.len()))
            }
            Percent::Frame | Percent::Title => {
                let text = Span::new(behind, line.len());
                if self.state == State::Leader {
                    self.state = State::Program;
                } else {
                    self.end_program();
                }
                if !text.range().is_empty() {
                    self.report(&say::TEXT_AFTER_PERCENT, line, |d| d);
                }
                PercentEffect::Comment(text)
            }
        }
    }

    fn check_real_time(&mut self, line: &[u8]) {
        let Some((byte, effect)) = first_real_time_byte(line) else { return };
        let found = match line[byte] {
            printable @ b' '..=b'~' => char::from(printable).to_string(),
            other => format!("0x{other:02X}"),
        };
        let at = SourcePosition { line: self.line, text: line, span: Span::new(byte, byte + 1) };
        let dialect = self.rules.dialect.name();
        self.problems.add(&say::REAL_TIME_CHARACTER, at, |d| {
            d.quoting("dialect", dialect).quoting("found", found).with("effect", effect)
        });
    }

    fn check_length(&mut self, line: &[u8]) {
        let (length, most) = match self.rules.spelling.line_length {
            Some(LineLength::Whole(most)) if line.len() > most => (line.len(), most),
            Some(LineLength::BeforeSemicolon(most)) => (LineLength::before_semicolon(line), most),
            Some(LineLength::Bare(most)) if line.len() > most => (LineLength::bare(line), most),
            _ => return,
        };
        if length > most {
            self.report(&say::LINE_TOO_LONG, line, |d| d.with("length", length).with("most", most));
        }
    }

    fn report(
        &mut self,
        message: &'static Message,
        line: &[u8],
        values: impl FnOnce(Diagnostic) -> Diagnostic,
    ) {
        let at = SourcePosition { line: self.line, text: line, span: Span::new(0, line.len()) };
        let dialect = self.rules.dialect.name();
        self.problems.add(message, at, |diagnostic| values(diagnostic).quoting("dialect", dialect));
    }
}

/// The effect of `%` at the beginning of a line.
enum PercentEffect {
    Nothing,
    /// The line continues at this offset.
    Passed(usize),
    /// The rest of the line is a comment.
    Comment(Span),
}

/// Returns the length of a block number before a program name, including the blanks after it.
fn block_number_length(line: &[u8]) -> usize {
    let [b'N' | b'n', digits @ ..] = line else { return 0 };
    1 + digits.iter().take_while(|byte| matches!(byte, b'0'..=b'9' | b' ' | b'\t')).count()
}

/// Whether a line after the end of the program consists of a comment.
fn is_remark(line: &[u8]) -> bool {
    match line.trim_ascii_start() {
        [b';', ..] => true,
        [b'(', inside @ .., b')'] => !inside.contains(&b')'),
        _ => false,
    }
}

fn trim_end(line: &[u8]) -> &[u8] {
    let blanks = line.iter().rev().take_while(|byte| matches!(byte, b' ' | b'\t' | b'\r')).count();
    &line[..line.len() - blanks]
}

/// Finds the first byte on which the control acts immediately, even within a comment, and returns its offset in the line and its effect. The control
/// discards other bytes above 127.
pub(super) fn first_real_time_byte(line: &[u8]) -> Option<(usize, &'static Text)> {
    line.iter().enumerate().find_map(|(at, &byte)| real_time_effect(byte).map(|effect| (at, effect)))
}

fn real_time_effect(byte: u8) -> Option<&'static Text> {
    Some(match byte {
        0x18 => &Text { en: "reset", de: "Zurücksetzen" },
        b'!' => &Text { en: "feed hold", de: "Vorschub anhalten" },
        b'~' => &Text { en: "resume after a hold", de: "nach einem Halt weiterfahren" },
        b'?' => &Text { en: "report the state", de: "Zustand melden" },
        0x84 => &Text { en: "safety door", de: "Schutztür" },
        0x85 => &Text { en: "cancel jogging", de: "Handfahrt abbrechen" },
        0x90..=0x94 => &Text { en: "change the feed", de: "Vorschub ändern" },
        0x95..=0x97 => &Text { en: "change the rapid speed", de: "Eilganggeschwindigkeit ändern" },
        0x99..=0x9E => &Text {
            en: "change the spindle's speed, or stop it",
            de: "Drehzahl der Spindel ändern, oder sie anhalten",
        },
        0xA0 | 0xA1 => &Text { en: "switch the coolant on or off", de: "Kühlung ein- oder ausschalten" },
        _ => return None,
    })
}
