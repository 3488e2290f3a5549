//! Reads the comments of a line, and correction formulas, which look like comments.

use memchr::memchr;
use pathbuild_diagnostic::messages::gcode as say;

use super::block::{Comment, CommentStyle, Formula, Span, Value};
use super::expression::Syntax;
use super::line::{Broken, Line};
use crate::dialect::{Spelling, Style};

impl Line<'_> {
    pub(super) fn round_comment(&mut self) -> Result<(), Broken> {
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

    fn formula(&mut self) -> Result<(), Broken> {
        let start = self.at;
        let applied = self.bytes.get(start + 2) == Some(&b'=');
        self.at += if applied { 3 } else { 2 };
        let code = self.compiled_expression(Syntax::Formula)?;
        self.closing_bracket(b')')?;
        let word = Span::new(self.out.words.len() - 1, self.out.words.len()).start;
        self.out.formulas.push(Formula { word, applied, code, span: Span::new(start, self.at) });
        Ok(())
    }

    pub(super) fn comment_to_end(&mut self, byte: u8) -> Result<(), Broken> {
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

    /// Whether the words so far include a command whose line ends with a message.
    pub(super) fn has_message(&self) -> bool {
        let codes = self.spelling().message_codes;
        let [first, rest @ ..] = self.out.words.as_slice() else { return false };
        let is_one = |value: Value| matches!(value, Value::Number(number) if codes.iter().any(|code| f64::from(*code) == number.value));
        !codes.is_empty()
            && first.letter == b'M'
            && is_one(first.value)
            && rest.iter().all(|word| matches!(word.letter, b'S' | b'P'))
    }

    /// Reads the rest of the line up to a semicolon as a message, unless it is S or P with a number.
    pub(super) fn message(&mut self) {
        self.skip_blanks();
        let rest = &self.bytes[self.at..];
        let is_word = matches!(rest, [b'S' | b'P' | b's' | b'p', b'0'..=b'9' | b'.', ..]);
        let length = memchr(b';', rest).unwrap_or(rest.len());
        if is_word || length == 0 {
            return;
        }
        let text = Span::new(self.at, self.at + length);
        self.out.comments.push(Comment { style: CommentStyle::Message, text });
        self.at += length;
    }

    fn check_comment(&mut self, style: Style, sign: &'static str, span: Span) -> Result<(), Broken> {
        match style {
            Style::Usual => Ok(()),
            Style::Doubtful => {
                let comment = comment_sign(self.spelling());
                self.report(&say::FOREIGN_COMMENT, span, |d| {
                    d.quoting("sign", sign).quoting("comment", comment)
                });
                Ok(())
            }
            Style::Unknown => self.unknown_character(),
        }
    }
}

/// The comment notation of a dialect.
pub(super) fn comment_sign(spelling: &Spelling) -> &'static str {
    if spelling.slash_comments == Style::Usual { "//" } else { "(" }
}
