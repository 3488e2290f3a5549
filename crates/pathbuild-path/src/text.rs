//! Parameter texts: letters and values. (spec/10-drawing.md, "Inside a text")

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::ops::Range;

use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, TextFault};

use crate::letter::{ElementClass, Letter, Letters, Use};

/// A parameter text, not yet asked what its values mean.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ParameterText(Box<str>);

/// A letter with its value, still with variables in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Piece {
    /// The letter; `None` for a character that is none (PB202).
    pub letter: Option<Letter>,
    span: Range<usize>,
    value_start: usize,
}

impl ParameterText {
    /// A text, `%%` codes already replaced.
    pub fn new(text: &str) -> Self {
        Self(joined(text).into())
    }

    /// The text as it is shown in diagnostics.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// All pieces in the order they are written. They are found as they are asked for: that is as soon done as to remember them.
    pub fn pieces(&self) -> impl Iterator<Item = Piece> + Clone + '_ {
        let mut end = 0;
        std::iter::from_fn(move || {
            let piece = next_piece(&self.0, end)?;
            end = piece.span.end;
            Some(piece)
        })
    }

    /// The first piece of a letter.
    pub fn piece(&self, letter: Letter) -> Option<Piece> {
        self.pieces().find(|piece| piece.letter == Some(letter))
    }

    /// A piece's value as written.
    pub fn value(&self, piece: &Piece) -> &str {
        &self.0[piece.value_start..piece.span.end]
    }

    /// The whole text with a piece underlined.
    pub fn fault(&self, piece: &Piece) -> TextFault {
        TextFault::new(&self.0, piece.span.clone())
    }

    /// The whole text with part of a piece's value underlined; `within` counts bytes of the value.
    pub fn fault_within(&self, piece: &Piece, within: Range<usize>) -> TextFault {
        TextFault::new(&self.0, piece.value_start + within.start..piece.value_start + within.end)
    }

    /// The whole text underlined.
    pub fn whole(&self) -> TextFault {
        TextFault::new(&self.0, 0..self.0.len())
    }

    /// What is wrong whatever the values are: PB202, PB204 and PB206, and as warnings PB210. Without places. Nothing is wrong with a
    /// text that is not read.
    pub fn problems(&self, class: ElementClass) -> Vec<Diagnostic> {
        if class == ElementClass::Unread {
            return Vec::new();
        }
        let (mut letters, mut variables) = (Letters::default(), BTreeSet::new());
        let of_piece = |piece: Piece| {
            // Letters are the same letter; variables only when they are the same variable.
            let is_repeated = match piece.letter {
                None => false,
                Some(Letter::Variable) => !variables.insert(self.value(&piece).chars().next()),
                Some(letter) => !letters.insert(letter),
            };
            let problem = self.problem(&piece, is_repeated, class)?;
            Some(problem.with_text(self.fault(&piece)))
        };
        self.pieces().filter_map(of_piece).collect()
    }

    fn problem(&self, piece: &Piece, is_repeated: bool, class: ElementClass) -> Option<Diagnostic> {
        let first = self.0[piece.span.start..].chars().next()?;
        let Some(letter) = piece.letter else {
            return Some(unknown_letter(first, class));
        };
        let how = class.use_of(letter);
        if how == Use::Unknown {
            return Some(unknown_letter(first, class));
        }
        if is_repeated {
            return Some(self.twice(letter, piece));
        }
        if letter.is_literal() && self.value(piece).contains('=') {
            return Some(Diagnostic::new(&messages::VARIABLE_NOT_ALLOWED).with("letter", first));
        }
        (how == Use::Ignored).then(|| Diagnostic::new(&messages::WITHOUT_EFFECT).with("letter", first))
    }

    fn twice(&self, letter: Letter, piece: &Piece) -> Diagnostic {
        match (letter, self.value(piece).chars().next()) {
            (Letter::Variable, Some(name)) => {
                Diagnostic::new(&messages::VARIABLE_TWICE).with("variable", name)
            }
            _ => Diagnostic::new(&messages::TWICE).with("letter", letter.as_char()),
        }
    }
}

fn unknown_letter(letter: char, class: ElementClass) -> Diagnostic {
    let upper = letter.to_uppercase().next().and_then(Letter::new);
    let known: pathbuild_diagnostic::Value = class.known_letters().map(|known| known.to_string()).collect();
    let message = match upper {
        Some(upper) if upper.as_char() != letter => &messages::LOWER_CASE_LETTER,
        _ => &messages::UNKNOWN_LETTER,
    };
    let upper = upper.map_or(letter, Letter::as_char);
    Diagnostic::new(message)
        .with("letter", letter)
        .with("upper", upper)
        .with("known", known)
        .with("element", class.word())
}

/// Joins what `~` at the end of a line continues: a long value goes on in the next line.
fn joined(text: &str) -> Cow<'_, str> {
    if !text.contains('~') {
        return Cow::Borrowed(text);
    }
    let mut joined = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(tilde) = rest.find('~') {
        let after = &rest[tilde + 1..];
        let is_continued = after.starts_with(['\n', '\r']);
        joined.push_str(&rest[..tilde + usize::from(!is_continued)]);
        rest = if is_continued {
            after.trim_start_matches(|it| u8::try_from(it).is_ok_and(is_blank))
        } else {
            after
        };
    }
    joined.push_str(rest);
    Cow::Owned(joined)
}

/// What separates pieces: not a non-breaking space.
fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\n' | b'\r')
}

/// The first piece of a text from a byte on.
fn next_piece(text: &str, from: usize) -> Option<Piece> {
    let bytes = text.as_bytes();
    let start = from + bytes[from..].iter().position(|byte| !is_blank(*byte))?;
    let end =
        bytes[start..].iter().position(|byte| is_blank(*byte)).map_or(bytes.len(), |length| start + length);
    let first = text[start..].chars().next()?;
    Some(Piece { letter: Letter::new(first), span: start..end, value_start: start + first.len_utf8() })
}

/// Replaces `%%c`, `%%d` and `%%p` by `_D`, `_G` and `_+`.
pub(crate) fn without_percent_codes(text: &str) -> Cow<'_, str> {
    if !text.contains('%') {
        return Cow::Borrowed(text);
    }
    let mut replaced = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find("%%") {
        let code = rest[at + 2..].chars().next();
        let replacement = match code {
            Some('c' | 'C') => "_D",
            Some('d' | 'D') => "_G",
            Some('p' | 'P') => "_+",
            _ => {
                replaced.push_str(&rest[..=at]);
                rest = &rest[at + 1..];
                continue;
            }
        };
        replaced.push_str(&rest[..at]);
        replaced.push_str(replacement);
        rest = &rest[at + 3..];
    }
    replaced.push_str(rest);
    Cow::Owned(replaced)
}
