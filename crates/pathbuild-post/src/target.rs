//! The controls that posts write for: the words that each accepts, and the check of a text before it is written. Texts from drawings, file
//! names and options are inserted into lines in such a way that no control executes any part of them.

use std::ops::Range;

use pathbuild_diagnostic::messages::posts;
use pathbuild_diagnostic::{Diagnostic, TextFault};
use pathbuild_gcode::dialect::{
    Charset, Dialect, LineLength, NotationSupport, Percent, Rules, Spelling, ascii, comment_safe_text,
    is_active_comment,
};
use pathbuild_gcode::read::LONGEST_LINE;

use crate::line_words::{CommentMarks, words};

/// A control that posts write for. It accepts the words and notations that are usual in its dialect, but not those that the reader of this
/// dialect accepts with a warning.
#[derive(Clone, Copy, Debug)]
pub(super) struct Target {
    /// The dialect in which the output is read back.
    pub(super) reader: Dialect,
    rules: &'static Rules,
    spelling: &'static Spelling,
}

impl Target {
    /// Finds the target by the name of its dialect.
    pub(super) fn of(name: &str) -> Option<Self> {
        let reader: Dialect = name.parse().ok()?;
        Some(Self { reader, rules: reader.rules(), spelling: &reader.rules().spelling })
    }

    pub(super) fn names() -> Vec<&'static str> {
        Dialect::ALL.iter().map(|dialect| dialect.name()).collect()
    }

    pub(super) fn has_cycles(&self) -> bool {
        self.rules.words.has_g(810)
    }

    /// Whether the control has G38.2, with which a probe that touches nothing is an error.
    pub(super) fn has_probe_alarm(&self) -> bool {
        self.rules.words.has_g(382)
    }

    pub(super) fn switches_spindle(&self) -> bool {
        self.rules.words.has_m(30)
    }

    /// Whether some controls read lengths without a decimal point as thousandths.
    pub(super) fn needs_decimal_points(&self) -> bool {
        self.rules.least_increments
    }

    /// Returns the length of the mark that opens a comment at the beginning of a text, and the mark that closes the comment; an empty one
    /// if the comment extends to the end of the line. `None` if no comment begins there.
    pub(super) fn comment_marks(&self, text: &str) -> Option<(usize, &'static str)> {
        let Spelling { round_comments, semicolon_comments, slash_comments, .. } = self.spelling;
        let signs = [(round_comments, "(", ")"), (semicolon_comments, ";", ""), (slash_comments, "//", "")];
        let found = signs
            .into_iter()
            .find(|(style, open, _)| **style == NotationSupport::Usual && text.starts_with(open));
        found.map(|(_, open, close)| (open.len(), close))
    }

    /// Returns the length in bytes of the comment at the beginning of a text; `None` if no comment begins there.
    fn comment_length(&self, text: &str) -> Option<usize> {
        let (open, close) = self.comment_marks(text)?;
        let end = text[open..].find(close).filter(|_| !close.is_empty());
        Some(end.map_or(text.len(), |end| open + end + close.len()))
    }

    /// Returns the length in bytes of the part of a line that contains code. If the line begins with a message code of the target, such as M117, a
    /// text for the display follows it.
    pub(crate) fn code_length(&self, line: &str) -> usize {
        let digits = line
            .strip_prefix('M')
            .map_or("", |rest| &rest[..rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len())]);
        let shows = digits.parse().is_ok_and(|code: u16| self.spelling.message_codes.contains(&code));
        if shows { 1 + digits.len() } else { line.len() }
    }

    /// Splits a line into code and comments.
    fn pieces<'a>(&self, line: &'a str) -> Vec<LinePart<'a>> {
        let mut pieces = Vec::new();
        let mut begins = 0;
        let mut at = 0;
        if self.spelling.percent == Percent::Title
            && let Some(percent) = line.find('%').filter(|at| is_block_number(&line[..*at]))
        {
            return vec![LinePart::Code(&line[..percent]), LinePart::Comment(&line[percent..])];
        }
        let code = self.code_length(line);
        if code < line.len() {
            return vec![LinePart::Code(&line[..code]), LinePart::Comment(&line[code..])];
        }
        while at < line.len() {
            match self.comment_length(&line[at..]) {
                Some(length) => {
                    pieces.push(LinePart::Code(&line[begins..at]));
                    pieces.push(LinePart::Comment(&line[at..at + length]));
                    at += length;
                    begins = at;
                }
                None => at += line[at..].chars().next().map_or(1, char::len_utf8),
            }
        }
        pieces.push(LinePart::Code(&line[begins..]));
        pieces
    }
}

/// Whether a text is empty or a block number.
fn is_block_number(text: &str) -> bool {
    let text = text.trim();
    text.is_empty()
        || text.strip_prefix('N').is_some_and(|digits| digits.bytes().all(|byte| byte.is_ascii_digit()))
}

#[derive(Clone, Copy, Debug)]
enum LinePart<'a> {
    Code(&'a str),
    Comment(&'a str),
}

/// Maximum number of errors reported by the check of a text.
const MAX_ERRORS: usize = 20;

/// Returns an error for everything in a text that the target would refuse, with its line.
pub(crate) fn check(text: &[u8], target: &Target) -> Vec<Diagnostic> {
    let mut errors = Vec::new();
    for (number, line) in (1_u64..).zip(text.split(|&byte| byte == b'\n')) {
        let line = String::from_utf8_lossy(line);
        let line = line.trim_end_matches('\r');
        TargetChecker { target, number, line, after_change: false, errors: &mut errors }.line();
        if errors.len() >= MAX_ERRORS {
            break;
        }
    }
    errors
}

struct TargetChecker<'a> {
    target: &'a Target,
    number: u64,
    line: &'a str,
    /// Whether the previous word was M6, after which the target accepts a tool number without T.
    after_change: bool,
    errors: &'a mut Vec<Diagnostic>,
}

impl TargetChecker<'_> {
    fn line(&mut self) {
        let mut at = 0;
        for piece in self.target.pieces(self.line) {
            let text = match piece {
                LinePart::Code(code) => {
                    self.code(code, at);
                    code
                }
                LinePart::Comment(comment) => {
                    self.comment(comment, at);
                    comment
                }
            };
            at += text.len();
        }
        self.length();
    }

    fn length(&mut self) {
        let bare = LineLength::bare(self.line.as_bytes());
        let (length, longest) = match self.target.spelling.line_length {
            Some(LineLength::Bare(longest)) => (bare, longest),
            Some(LineLength::BeforeSemicolon(longest)) => {
                (LineLength::before_semicolon(self.line.as_bytes()), longest)
            }
            Some(LineLength::Whole(longest)) => (self.line.len(), longest),
            // The line is only limited by the length up to which it can be read back.
            None => (self.line.len(), LONGEST_LINE),
        };
        if length > longest {
            let message = if bare == 0 { &posts::COMMENT_TOO_LONG } else { &posts::LINE_TOO_LONG };
            let diagnostic = Diagnostic::new(message).with("length", length);
            self.report(diagnostic.with("longest", longest), 0..self.line.len());
        }
    }

    fn report(&mut self, diagnostic: Diagnostic, span: Range<usize>) {
        if self.errors.len() >= MAX_ERRORS {
            return;
        }
        let diagnostic = diagnostic.quoting("dialect", self.target.reader.name()).with("line", self.number);
        let diagnostic = diagnostic.at_line(u32::try_from(self.number).unwrap_or(u32::MAX), None);
        self.errors.push(diagnostic.with_text(TextFault::new(self.line, span)));
    }

    fn reject(&mut self, span: Range<usize>) {
        let word = self.line[span.clone()].trim().to_owned();
        self.report(Diagnostic::new(&posts::WORD_REJECTED).quoting("word", word), span);
    }

    /// Checks a comment, because some controls act on certain bytes even within a comment.
    fn comment(&mut self, text: &str, start: usize) {
        let acts = |c: char| !c.is_ascii() || matches!(c, '!' | '?' | '~');
        if let Some((at, c)) =
            text.char_indices().find(|(_, c)| self.target.spelling.real_time_bytes && acts(*c))
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
                '%' if is_first && self.target.spelling.percent != Percent::Refused => 1,
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
        if !self.accepts_word(letter, value) {
            self.reject(start..start + length);
        }
        self.after_change = self.target.spelling.bare_tool_number && letter == b'M' && value == 6.0;
        length
    }

    fn accepts_word(&self, letter: u8, value: f64) -> bool {
        let words = self.target.rules.words;
        match letter {
            b'G' => tenths(value).is_some_and(|code| words.has_g(code)),
            b'M' => tenths(value).is_some_and(|code| words.has_m(code)),
            b'N' => self.target.spelling.block_numbers.is_some() && !self.target.spelling.checksums,
            letter => words.letters.contains(letter),
        }
    }
}

/// Returns ten times the number of a code; `None` if no code has such a number.
fn tenths(value: f64) -> Option<u16> {
    let tenths = value * 10.0;
    let is_code = (tenths - tenths.round()).abs() < 1e-6 && (0.0..=60_000.0).contains(&tenths);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
    is_code.then_some(tenths.round() as u16)
}

/// Replaces characters that the target or the configuration does not allow. In comments, this includes characters that the target would
/// act on; in code those are kept, so that the check reports them. Lines that are not UTF-8 are not changed.
pub(crate) fn with_permitted_characters(text: &[u8], target: Option<&Target>, charset: Charset) -> Vec<u8> {
    let is_ascii = charset == Charset::Ascii || target.is_some_and(|target| target.spelling.real_time_bytes);
    let mut plain = Vec::with_capacity(text.len());
    for line in text.split_inclusive(|&byte| byte == b'\n') {
        match std::str::from_utf8(line) {
            Ok(line) => plain.extend(plain_line(line, target, is_ascii).into_bytes()),
            Err(_) => plain.extend_from_slice(line),
        }
    }
    plain
}

fn plain_line(line: &str, target: Option<&Target>, is_ascii: bool) -> String {
    let line = if is_ascii { ascii(line) } else { line.to_owned() };
    let Some(target) = target else { return line };
    let piece = |piece| match piece {
        LinePart::Code(code) => code.to_owned(),
        LinePart::Comment(comment) => harmless_comment(comment, target),
    };
    target.pieces(&line).into_iter().map(piece).collect()
}

fn harmless_comment(comment: &str, target: &Target) -> String {
    let is_round = comment.starts_with('(');
    let replace = |(at, c): (usize, char)| match c {
        '(' if is_round && at > 0 && !target.spelling.nested_comments => '[',
        '!' | '?' if target.spelling.real_time_bytes => '.',
        '~' if target.spelling.real_time_bytes => '-',
        '%' if target.spelling.percent == Percent::Refused => '-',
        c => c,
    };
    comment.char_indices().map(replace).collect()
}

/// Inserter that adds texts to the lines of a post in such a way that they cannot be executed. It knows which marks begin and end comments.
#[derive(Debug)]
pub(crate) struct TextInserter<'a> {
    target: Option<&'a Target>,
    marks: CommentMarks,
    charset: Charset,
}

impl<'a> TextInserter<'a> {
    /// Creates an inserter with the comment marks of the target; without a target, with the definition's and the usual ones.
    pub(crate) fn new(target: Option<&'a Target>, marks: CommentMarks, charset: Charset) -> Self {
        Self { target, marks, charset }
    }

    /// Returns the text in a form that may be appended to the line; `None` if it would be outside a comment and be read as words.
    pub(crate) fn inserted_form(&self, line: &str, text: &str) -> Option<String> {
        let plain = comment_safe_text(text, self.target.map(|target| target.reader), self.charset);
        let is_title = line.trim_start().starts_with('%');
        match self.open_comment(line) {
            Some((before, close)) => {
                let plain = without_closing_mark(&plain, close);
                let all = format!("{before}{plain}");
                let guard =
                    if is_active_comment(&all) && !is_active_comment(before) { TEXT_PREFIX } else { "" };
                Some(format!("{guard}{plain}"))
            }
            None if is_title => Some(plain),
            // A comment that begins in the text would hide the words after it.
            None if self.open_comment(&format!("{line}{plain}")).is_some() => None,
            None if is_inert(&plain, &self.marks) => Some(plain),
            None => None,
        }
    }

    /// Returns the text of the comment that is open at the end of a line, and the mark that closes the comment.
    fn open_comment<'l>(&self, line: &'l str) -> Option<(&'l str, &str)> {
        let mut at = 0;
        while let Some(c) = line[at..].chars().next() {
            match self.marks_at(&line[at..]) {
                None => at += c.len_utf8(),
                Some((open, close)) => {
                    let inside = &line[at + open..];
                    match inside.find(close).filter(|_| !close.is_empty()) {
                        Some(end) => at += open + end + close.len(),
                        None => return Some((inside, close)),
                    }
                }
            }
        }
        None
    }

    /// Returns the length of the comment mark at the beginning of a text, and the mark that closes the comment.
    fn marks_at(&self, text: &str) -> Option<(usize, &str)> {
        match self.target {
            Some(target) => target.comment_marks(text),
            None => self.marks.opening_mark(text).or_else(|| text.starts_with("//").then_some((2, ""))),
        }
    }
}

/// Prefix for texts that a control would take for commands even within a comment.
const TEXT_PREFIX: &str = "text: ";

/// Replaces, in the text of a comment, all characters of the mark that would close the comment. Definitions may use any mark.
fn without_closing_mark(text: &str, close: &str) -> String {
    let instead = if close.contains(' ') { "_" } else { " " };
    text.replace(|c| close.contains(c), instead)
}

/// Whether a text is harmless even outside a comment, because it contains no words and none of the characters that controls use for parameters,
/// expressions and commands.
fn is_inert(text: &str, marks: &CommentMarks) -> bool {
    words(text, marks).words.is_empty()
        && !text.contains(['#', '[', ']', '%', '$', '{', '}', '"', '<', '>', '='])
}
