//! Reads the parts of a line: words that do not have the simplest form, assignments, O words, comments and correction formulas.

use memchr::{memchr, memchr2};
use pathbuild_diagnostic::messages::gcode as say;

use super::block::{
    Assignment, Binary, Code, Comment, CommentStyle, Formula, LineParts, Number, OWord, OWordKind, Op, Span,
    Target, Value, Word, decode,
};
use super::expression::Syntax;
use super::line::{Line, UnreadableLine};
use super::number::{self, UnusualNotation};
use crate::dialect::{Blanks, NotationSupport, Spelling};

impl Line<'_> {
    pub(super) fn word(&mut self, letter: u8) -> Result<(), UnreadableLine> {
        let start = self.at;
        if letter == b'O' && self.spelling().grammar.as_ref().is_some_and(|grammar| grammar.o_words) {
            return self.o_word();
        }
        self.at += 1;
        if matches!(self.peek(), Some(b' ' | b'\t')) {
            self.blank_after_letter(start);
        }
        let value = match self.peek() {
            Some(byte) if number::begins(byte) && !self.begins_signed_expression(byte) => {
                Value::Number(self.number()?)
            }
            _ if self.is_flag(letter) => {
                self.at = start + 1;
                Value::Number(Number { value: 0.0, decimals: 0 })
            }
            Some(b'#' | b'[' | b'+' | b'-' | b'a'..=b'z' | b'A'..=b'Z') => {
                self.value_of_word(start, letter)?
            }
            _ => return Err(self.word_without_number(start, letter)),
        };
        let span = Span::new(start, self.at);
        if letter == b'N' && self.spelling().block_numbers.is_some() {
            return self.block_number(value, span);
        }
        self.out.words.push(Word { letter, value, span });
        Ok(())
    }

    /// Whether a letter may have no number here: after G28 it names an axis, and after an M word it is an option. S needs its number: after M3, it is
    /// the speed.
    fn is_flag(&self, letter: u8) -> bool {
        let Some(Word { letter: command, value: Value::Number(number), .. }) = self.out.words.first() else {
            return false;
        };
        let takes_flags = *command == b'M' && letter != b'S' || *command == b'G' && number.value == 28.0;
        let is_text = self.peek().is_some_and(|byte| byte.is_ascii_lowercase());
        self.spelling().flags && takes_flags && !is_text
    }

    fn blank_after_letter(&mut self, start: usize) {
        if self.spelling().blanks == Blanks::Separate {
            self.report(&say::BLANK_AFTER_LETTER, Span::new(start, self.at + 1), |d| d);
        }
        self.skip_blanks();
    }

    /// Whether a signed expression such as `-[`, `-#` or `-SIN[` begins here.
    fn begins_signed_expression(&self, byte: u8) -> bool {
        matches!(byte, b'+' | b'-')
            && self.bytes[self.at + 1..]
                .iter()
                .find(|byte| !matches!(byte, b' ' | b'\t'))
                .is_some_and(|byte| matches!(byte, b'#' | b'[') || byte.is_ascii_alphabetic())
    }

    fn value_of_word(&mut self, start: usize, letter: u8) -> Result<Value, UnreadableLine> {
        let syntax = match self.spelling().grammar {
            Some(grammar) if !self.next_letter_begins_word() => Syntax::Dialect(grammar),
            None if matches!(self.peek(), Some(b'#' | b'[' | b'+' | b'-')) => {
                return Err(self.report_no_expressions(start));
            }
            _ => return Err(self.word_without_number(start, letter)),
        };
        self.compile_value(syntax).map(Value::Expression)
    }

    /// Whether the next letter begins a word and not the name of a function.
    fn next_letter_begins_word(&self) -> bool {
        let letters = self.bytes[self.at..].iter().take_while(|byte| byte.is_ascii_alphabetic()).count();
        letters == 1
    }

    fn word_without_number(&mut self, start: usize, letter: u8) -> UnreadableLine {
        if self.begins_macro(start) {
            return self.report_no_expressions(start);
        }
        let span = Span::new(start, start + 1);
        self.fault(&say::WORD_WITHOUT_NUMBER, span, |d| d.with("letter", char::from(letter)))
    }

    fn report_no_expressions(&mut self, start: usize) -> UnreadableLine {
        let message =
            if self.spelling().macros { &say::MACRO_NOT_FOLLOWED } else { &say::UNKNOWN_EXPRESSION };
        self.fault(message, Span::new(start, self.bytes.len()), |d| d)
    }

    fn begins_macro(&self, start: usize) -> bool {
        let rest = &self.bytes[start..];
        let is_there = |keyword: &&[u8]| {
            rest.get(..keyword.len()).is_some_and(|text| text.eq_ignore_ascii_case(keyword))
        };
        self.spelling().macros && MACRO_KEYWORDS.iter().any(is_there)
    }

    /// Reads a number and reports unusual features of its notation.
    pub(super) fn number(&mut self) -> Result<Number, UnreadableLine> {
        let start = self.at;
        if let Some((number, end)) = number::scan_plain(self.bytes, start) {
            self.at = end;
            return Ok(number);
        }
        match number::scan(self.bytes, start, self.spelling()) {
            Ok(scanned) => {
                self.at = scanned.end;
                if let Some(oddity) = scanned.oddity {
                    self.report_unusual_number(oddity, Span::new(start, scanned.end));
                }
                Ok(scanned.number)
            }
            Err(malformed) => {
                let end = malformed.end.max(start + 1);
                let found = decode(&self.bytes[start..end]).into_owned();
                Err(self.fault(&say::NO_NUMBER, Span::new(start, end), |d| d.quoting("found", found)))
            }
        }
    }

    fn report_unusual_number(&mut self, oddity: UnusualNotation, span: Span) {
        let letter = self.bytes[..span.start as usize].iter().rev().find(|byte| byte.is_ascii_alphabetic());
        let letter = letter.map_or(String::new(), |byte| char::from(byte.to_ascii_uppercase()).to_string());
        let number: String = decode(&self.bytes[span.range()])
            .chars()
            .filter(|character| !character.is_whitespace())
            .collect();
        let message = match oddity {
            UnusualNotation::BlankInside => &say::BLANK_IN_NUMBER,
            UnusualNotation::DecimalComma => &say::COMMA_FOR_POINT,
        };
        self.report(message, span, |d| d.quoting("letter", letter).quoting("number", number));
    }

    fn block_number(&mut self, value: Value, span: Span) -> Result<(), UnreadableLine> {
        let most = self.spelling().block_numbers.unwrap_or(u32::MAX);
        let fits = |number: &Number| {
            let whole = number.decimals == 0 || self.spelling().fractional_block_numbers;
            whole && number.value >= 0.0 && number.value <= f64::from(most)
        };
        match value {
            Value::Number(number) if fits(&number) && self.out.is_empty() => {
                self.out.number = Some(number);
                Ok(())
            }
            _ => {
                let found = decode(&self.bytes[span.range()]).into_owned();
                Err(self.fault(&say::BLOCK_NUMBER, span, |d| {
                    d.quoting("found", found).with("most", u64::from(most))
                }))
            }
        }
    }

    /// Reads a number without a letter, which is the tool after M6 in some dialects and an error otherwise.
    pub(super) fn bare_number(&mut self) -> Result<(), UnreadableLine> {
        let start = self.at;
        let follows_tool_change = self.out.words.last().is_some_and(|word| {
            word.letter == b'M' && matches!(word.value, Value::Number(Number { value, .. }) if value == 6.0)
        });
        let number = self.number()?;
        let span = Span::new(start, self.at);
        if self.spelling().bare_tool_number && follows_tool_change {
            self.out.words.push(Word { letter: b'T', value: Value::Number(number), span });
            return Ok(());
        }
        let found = decode(&self.bytes[span.range()]).into_owned();
        let comment = comment_sign(self.spelling());
        Err(self.fault(&say::NUMBER_WITHOUT_LETTER, span, |d| {
            d.quoting("found", found).quoting("comment", comment)
        }))
    }

    pub(super) fn setting(&mut self) -> Result<(), UnreadableLine> {
        let start = self.at;
        let Some(grammar) = self.spelling().grammar else {
            return Err(self.report_no_expressions(start));
        };
        let syntax = Syntax::Dialect(grammar);
        self.at += 1;
        self.skip_blanks();
        let target = if grammar.has_names && self.peek() == Some(b'<') {
            Target::Named(self.name()?)
        } else {
            Target::Numbered(self.compile_value(syntax)?)
        };
        self.skip_blanks();
        if self.peek() != Some(b'=') {
            return Err(self.fault(&say::ASSIGNMENT_EXPECTED, self.current_span(), |d| d));
        }
        self.at += 1;
        let value = Value::Expression(self.compile_value(syntax)?);
        self.out.settings.push(Assignment { target, value, span: Span::new(start, self.at) });
        Ok(())
    }
}

/// The keywords of macro statements, in upper case.
const MACRO_KEYWORDS: [&[u8]; 11] =
    [b"WHILE", b"DO", b"END", b"IF", b"THEN", b"GOTO", b"POPEN", b"PCLOS", b"DPRNT", b"BPRNT", b"SETVN"];

/// The supported keywords of O words, in lower case.
const O_WORDS: [(&[u8], OWordKind); 15] = [
    (b"sub", OWordKind::Sub),
    (b"endsub", OWordKind::EndSub),
    (b"return", OWordKind::Return),
    (b"call", OWordKind::Call),
    (b"repeat", OWordKind::Repeat),
    (b"endrepeat", OWordKind::EndRepeat),
    (b"if", OWordKind::If),
    (b"elseif", OWordKind::ElseIf),
    (b"else", OWordKind::Else),
    (b"endif", OWordKind::EndIf),
    (b"while", OWordKind::While),
    (b"endwhile", OWordKind::EndWhile),
    (b"do", OWordKind::Do),
    (b"break", OWordKind::Break),
    (b"continue", OWordKind::Continue),
];

impl Line<'_> {
    /// Reads an O word, such as `o100 call [1] [2]`. If its keyword is not supported, the rest of the line is skipped.
    fn o_word(&mut self) -> Result<(), UnreadableLine> {
        let start = self.at;
        self.at += 1;
        self.skip_blanks();
        let name = if self.peek() == Some(b'<') {
            self.name()?
        } else {
            self.read_while(|byte| byte.is_ascii_digit())
        };
        self.skip_blanks();
        let keyword = self.read_while(|byte| byte.is_ascii_alphabetic()).range();
        let known = O_WORDS.iter().find(|(known, _)| self.bytes[keyword.clone()].eq_ignore_ascii_case(known));
        let kind = known.filter(|_| !name.range().is_empty()).map_or(OWordKind::Other, |(_, kind)| *kind);
        if kind == OWordKind::Other {
            self.at = self.bytes.len();
        }
        if let Some(grammar) = self.spelling().grammar {
            self.arguments(Syntax::Dialect(grammar))?;
        }
        self.out.o_word = Some(OWord { span: Span::new(start, self.at), name, kind });
        Ok(())
    }

    fn read_while(&mut self, belongs: impl Fn(u8) -> bool) -> Span {
        let start = self.at;
        while self.peek().is_some_and(&belongs) {
            self.at += 1;
        }
        Span::new(start, self.at)
    }

    fn arguments(&mut self, syntax: Syntax) -> Result<(), UnreadableLine> {
        loop {
            let end = self.at;
            self.skip_blanks();
            if self.peek() != Some(b'[') {
                self.at = end;
                return Ok(());
            }
            let argument = self.compile_value(syntax)?;
            self.out.arguments.push(argument);
        }
    }
}

impl Line<'_> {
    pub(super) fn round_comment(&mut self) -> Result<(), UnreadableLine> {
        let start = self.at;
        if self.spelling().formulas && self.bytes.get(start + 1) == Some(&b'=') && self.word_ends_at(start) {
            return self.formula();
        }
        let Some(length) = memchr(b')', &self.bytes[start..]) else {
            return Err(self.fault(&say::UNCLOSED_COMMENT, Span::new(start, self.bytes.len()), |d| d));
        };
        let text = Span::new(start + 1, start + length);
        if !self.spelling().nested_comments
            && let Some(inner) = memchr(b'(', &self.bytes[text.range()])
        {
            let inner = start + 1 + inner;
            return Err(self.fault(&say::NESTED_COMMENT, Span::new(inner, inner + 1), |d| d));
        }
        self.check_comment(self.spelling().round_comments, "(", Span::new(start, start + 1))?;
        self.out.comments.push(Comment { style: CommentStyle::Round, text });
        self.at = start + length + 1;
        Ok(())
    }

    fn word_ends_at(&self, at: usize) -> bool {
        self.out.words.last().is_some_and(|word| {
            self.bytes[word.span.end as usize..at].iter().all(|byte| matches!(byte, b' ' | b'\t'))
        })
    }

    fn formula(&mut self) -> Result<(), UnreadableLine> {
        let start = self.at;
        let applied = self.bytes.get(start + 2) == Some(&b'=');
        self.at += if applied { 3 } else { 2 };
        let code = self.compile_expression(Syntax::Formula)?;
        self.closing_bracket(b')')?;
        let word = Span::new(self.out.words.len() - 1, self.out.words.len()).start;
        self.out.formulas.push(Formula { word, applied, code, span: Span::new(start, self.at) });
        Ok(())
    }

    pub(super) fn comment_to_end(&mut self, byte: u8) -> Result<(), UnreadableLine> {
        let spelling = self.spelling();
        let (style, usual, sign) = match byte {
            b';' => (CommentStyle::Semicolon, spelling.semicolon_comments, ";"),
            b'!' => (CommentStyle::Bang, spelling.bang_comments, "!"),
            _ if self.bytes.get(self.at + 1) == Some(&b'/') => {
                (CommentStyle::Slashes, spelling.slash_comments, "//")
            }
            _ => return self.unknown_character(),
        };
        let sign_span = Span::new(self.at, self.at + sign.len());
        self.check_comment(usual, sign, sign_span)?;
        let text = Span::new(self.at + sign.len(), self.bytes.len());
        self.out.comments.push(Comment { style, text });
        self.at = self.bytes.len();
        Ok(())
    }

    /// If the first word is a command with a message, reads what follows it and its S and P, up to a semicolon or a checksum, as the message. Parts
    /// of the message that have been read as words are dropped.
    pub(super) fn message(&mut self) {
        if !begins_message(&self.out.words, self.spelling()) {
            return;
        }
        let values = self.out.words[1..].iter().take_while(|word| matches!(word.letter, b'S' | b'P')).count();
        if let Some(dropped) = self.out.words.get(1 + values) {
            self.at = dropped.span.start as usize;
            self.out.words.truncate(1 + values);
        }
        self.skip_blanks();
        let rest = &self.bytes[self.at..];
        let is_word = matches!(rest, [b'S' | b'P' | b's' | b'p', b'0'..=b'9' | b'.', ..]);
        let checksum = if self.spelling().checksums { b'*' } else { b';' };
        let length = memchr2(b';', checksum, rest).unwrap_or(rest.len());
        if is_word || length == 0 {
            return;
        }
        let text = Span::new(self.at, self.at + length);
        self.out.comments.push(Comment { style: CommentStyle::Message, text });
        self.at += length;
    }

    fn check_comment(
        &mut self,
        style: NotationSupport,
        sign: &'static str,
        span: Span,
    ) -> Result<(), UnreadableLine> {
        match style {
            NotationSupport::Usual => Ok(()),
            NotationSupport::Doubtful => {
                let comment = comment_sign(self.spelling());
                self.report(&say::FOREIGN_COMMENT, span, |d| {
                    d.quoting("sign", sign).quoting("comment", comment)
                });
                Ok(())
            }
            NotationSupport::Unknown => self.unknown_character(),
        }
    }
}

/// Whether the first of these words is a command after which the rest of the line is a message.
pub(super) fn begins_message(words: &[Word], spelling: &Spelling) -> bool {
    let is_one = |number: Number| spelling.message_codes.iter().any(|code| f64::from(*code) == number.value);
    matches!(words, [Word { letter: b'M', value: Value::Number(number), .. }, ..] if is_one(*number))
}

pub(super) fn comment_sign(spelling: &Spelling) -> &'static str {
    match spelling {
        spelling if spelling.slash_comments == NotationSupport::Usual => "//",
        spelling if spelling.round_comments == NotationSupport::Unknown => ";",
        _ => "(",
    }
}

/// Reads `(=1.000+0.441*[#51-2.000]+...)` at `start` as the formula of the last word and returns the offset after it. Returns `None` for any other
/// notation, and leaves the parts unchanged, so that the reader of expressions can read the formula.
///
/// In a program with probes, nearly all bytes belong to such formulas.
#[inline]
pub(super) fn plain_formula(bytes: &[u8], start: usize, parts: &mut LineParts) -> Option<usize> {
    let word = parts.words.len().checked_sub(1)?;
    if bytes.get(start..start + 2) != Some(b"(=") || parts.words[word].span.end as usize != start {
        return None;
    }
    let first = parts.code.len();
    let applied = bytes.get(start + 2) == Some(&b'=');
    let Some(end) = sum(bytes, start + 2 + usize::from(applied), &mut parts.code) else {
        parts.code.truncate(first);
        return None;
    };
    let [code, word, span] =
        [(first, parts.code.len()), (word, word), (start, end)].map(|(a, b)| Span::new(a, b));
    let code = Code { first: code.start, end: code.end };
    parts.formulas.push(Formula { word: word.start, applied, code, span });
    Some(end)
}

/// Reads a height and the terms of the probes, up to and including the closing bracket.
fn sum(bytes: &[u8], start: usize, code: &mut Vec<Op>) -> Option<usize> {
    let (height, mut at) = number::scan_plain(bytes, start)?;
    code.push(Op::Number(height.value));
    loop {
        match bytes.get(at)? {
            b')' => return Some(at + 1),
            b'+' => at = term(bytes, at + 1, code)?,
            _ => return None,
        }
    }
}

/// Reads the term of a probe: `0.441*[#51-2.000]`.
fn term(bytes: &[u8], start: usize, code: &mut Vec<Op>) -> Option<usize> {
    let (weight, at) = number::scan_plain(bytes, start)?;
    let at = offset_after(bytes, at, b"*[#")?;
    let (probe, at) = number::scan_plain(bytes, at)?;
    let at = offset_after(bytes, at, b"-")?;
    let (height, at) = number::scan_plain(bytes, at)?;
    let at = offset_after(bytes, at, b"]")?;
    code.extend([
        Op::Number(weight.value),
        Op::Number(probe.value),
        Op::Parameter,
        Op::Number(height.value),
        Op::Binary(Binary::Minus),
        Op::Binary(Binary::Times),
        Op::Binary(Binary::Plus),
    ]);
    Some(at)
}

fn offset_after(bytes: &[u8], at: usize, signs: &[u8]) -> Option<usize> {
    bytes[at..].starts_with(signs).then_some(at + signs.len())
}
