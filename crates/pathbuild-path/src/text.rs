//! Parameter texts: letters and values. (spec/10-drawing.md, "Inside a text")

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::num::NonZeroU32;
use std::ops::Range;

use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, TextFault};

use crate::letter::{ElementClass, Letter, Letters, Use};
use crate::number::{parse_integer, parse_number};
use crate::packed::{Recent, packed};

/// The parameter texts of a path, read once: what they say is asked for by several stages.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ParameterTexts {
    /// All wordings behind each other.
    string: String,
    pieces: Vec<Piece>,
    wordings: Vec<Wording>,
    /// How many texts there are.
    count: u32,
}

/// A text of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextId {
    /// Which it is, counted from 1.
    number: NonZeroU32,
    /// The number of what it says: what is milled alike is mostly written alike.
    pub(crate) wording: u32,
}

/// Where a wording and its pieces are, and what is known of it as a whole.
#[derive(Clone, Debug, PartialEq)]
struct Wording {
    string: Range<u32>,
    pieces: Range<u32>,
    letters: Letters,
    firsts: Firsts,
    is_plain: bool,
}

/// For each letter that a text has, where its first piece is among its pieces, or, in an endless text, some piece before.
type Firsts = [u8; Letter::COUNT];

/// A parameter text.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ParameterText<'t> {
    string: &'t str,
    pieces: &'t [Piece],
    firsts: Option<&'t Firsts>,
    /// All that it has.
    pub(crate) letters: Letters,
    /// Whether each of its pieces has another letter and its value is what it should be, without a reference to a variable.
    pub(crate) is_plain: bool,
}

/// A letter with its value, still with variables in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// The letter; `None` for a character that is none (PB202).
    pub letter: Option<Letter>,
    /// What its value is before variables are put in.
    pub(crate) written: Written,
    /// Its bytes in the text.
    span: Range<u32>,
}

/// What a value is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Written {
    /// A number, of a letter whose value is one.
    Number(f64),
    /// Text, of a letter whose value is text.
    Text,
    /// Neither of them before variables have values.
    Reference,
    /// No number, where the letter asks for one.
    NoNumber,
}

impl ParameterTexts {
    /// Adds a text as it is drawn. `recent`: what the last ones of these texts say.
    pub(crate) fn push_drawn(&mut self, text: &str, recent: &mut Recent<u32>) -> TextId {
        let drawn = packed(text);
        if let Some(wording) = drawn.and_then(|drawn| recent.get(drawn)) {
            return self.add(wording);
        }
        // Nearly all texts are what they look like.
        let is_plain = !text.bytes().any(|byte| matches!(byte, b'%' | b'~'));
        let wording =
            if is_plain { self.wording(text) } else { self.wording(&joined(&without_percent_codes(text))) };
        if let Some(drawn) = drawn {
            recent.insert(drawn, wording);
        }
        self.add(wording)
    }

    /// Adds a text whose lines are joined and codes replaced.
    pub(crate) fn push(&mut self, text: &str) -> TextId {
        let wording = self.wording(text);
        self.add(wording)
    }

    fn add(&mut self, wording: u32) -> TextId {
        let number = NonZeroU32::MIN.saturating_add(self.count);
        self.count = number.get();
        TextId { number, wording }
    }

    /// Reads a text; the number of what it says.
    fn wording(&mut self, text: &str) -> u32 {
        let (start, first) = (self.string.len(), self.pieces.len());
        self.string.push_str(text);
        let (mut letters, mut firsts) = (Letters::default(), [0; Letter::COUNT]);
        let (mut is_plain, mut end) = (true, 0);
        while let Some(piece) = next_piece(text, end) {
            let is_new = piece.letter.is_some_and(|letter| letters.insert(letter));
            if let Some(letter) = piece.letter.filter(|_| is_new) {
                firsts[letter as usize] = u8::try_from(self.pieces.len() - first).unwrap_or(u8::MAX);
            }
            is_plain &= is_new && matches!(piece.written, Written::Number(_) | Written::Text);
            end = piece.span.end as usize;
            self.pieces.push(piece);
        }
        let (string, pieces) =
            (number(start)..number(self.string.len()), number(first)..number(self.pieces.len()));
        self.wordings.push(Wording { string, pieces, letters, firsts, is_plain });
        number(self.wordings.len() - 1)
    }

    /// One of these texts.
    pub fn get(&self, text: TextId) -> Option<ParameterText<'_>> {
        self.wordings.get(text.wording as usize).map(|wording| self.text(wording))
    }

    /// The first of these texts.
    pub fn first(&self) -> Option<ParameterText<'_>> {
        self.wordings.first().map(|wording| self.text(wording))
    }

    fn text<'t>(&'t self, wording: &'t Wording) -> ParameterText<'t> {
        let Wording { string, pieces, letters, firsts, is_plain } = wording;
        ParameterText {
            string: &self.string[range(string)],
            pieces: &self.pieces[range(pieces)],
            firsts: Some(firsts),
            letters: *letters,
            is_plain: *is_plain,
        }
    }

    /// Whether nothing is wrong with a text, see [`ParameterText::is_right`].
    pub(crate) fn is_right(&self, text: TextId, class: ElementClass) -> bool {
        let wording = self.wordings.get(text.wording as usize);
        wording.is_some_and(|it| is_right(it.is_plain, it.letters, class))
    }

    /// Adds to no texts all those of others.
    pub(crate) fn copy(&mut self, others: &Self) {
        let Self { string, pieces, wordings, count } = self;
        string.reserve(others.string.len());
        string.push_str(&others.string);
        pieces.reserve(others.pieces.len());
        pieces.extend_from_slice(&others.pieces);
        wordings.reserve(others.wordings.len());
        wordings.extend_from_slice(&others.wordings);
        *count = others.count;
    }

    pub(crate) fn shrink_to_fit(&mut self) {
        self.string.shrink_to_fit();
        self.pieces.shrink_to_fit();
        self.wordings.shrink_to_fit();
    }

    /// Forgets all texts.
    pub(crate) fn clear(&mut self) {
        let Self { string, pieces, wordings, count } = self;
        string.clear();
        pieces.clear();
        wordings.clear();
        *count = 0;
    }

    /// For how many pieces there is room.
    pub(crate) fn room(&self) -> usize {
        self.pieces.capacity().max(self.string.capacity() / 16)
    }
}

fn number(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX)
}

fn range(numbers: &Range<u32>) -> Range<usize> {
    numbers.start as usize..numbers.end as usize
}

impl From<&str> for ParameterTexts {
    /// A single text, `%%` codes already replaced.
    fn from(text: &str) -> Self {
        let mut texts = Self::default();
        texts.push(&joined(text));
        texts
    }
}

impl<'t> ParameterText<'t> {
    /// The text as it is shown in diagnostics.
    pub fn as_str(self) -> &'t str {
        self.string
    }

    /// All pieces in the order they are written.
    pub fn pieces(self) -> &'t [Piece] {
        self.pieces
    }

    /// The first piece of a letter.
    pub fn piece(self, letter: Letter) -> Option<&'t Piece> {
        self.pieces.get(self.index(letter)?)
    }

    /// Which of the pieces is the first of a letter.
    pub(crate) fn index(self, letter: Letter) -> Option<usize> {
        let firsts = self.firsts.filter(|_| self.letters.contains(letter))?;
        let from = usize::from(firsts[letter as usize]);
        let is_it = |piece: &Piece| piece.letter == Some(letter);
        self.pieces.get(from..)?.iter().position(is_it).map(|behind| from + behind)
    }

    /// A piece's value as written.
    pub fn value(self, piece: &Piece) -> &'t str {
        let mut characters = self.string[piece.span()].chars();
        characters.next();
        characters.as_str()
    }

    /// The whole text with a piece underlined.
    pub fn fault(self, piece: &Piece) -> TextFault {
        TextFault::new(self.string, piece.span())
    }

    /// The whole text with the first piece of a letter underlined, where there is one.
    pub(crate) fn fault_of(self, letter: Letter) -> Option<TextFault> {
        self.piece(letter).map(|piece| self.fault(piece))
    }

    /// The whole text underlined.
    pub fn whole(self) -> TextFault {
        TextFault::new(self.string, 0..self.string.len())
    }

    /// Whether nothing is wrong with it, as is soon seen of most texts.
    pub(crate) fn is_right(self, class: ElementClass) -> bool {
        is_right(self.is_plain, self.letters, class)
    }

    /// What is wrong whatever the values are: PB202, PB204 and PB206, and as warnings PB210. Without places. Nothing is wrong with a
    /// text that is not read.
    pub fn problems(self, class: ElementClass) -> Vec<Diagnostic> {
        if class == ElementClass::Unread {
            return Vec::new();
        }
        let (mut letters, mut variables) = (Letters::default(), BTreeSet::new());
        let of_piece = |piece: &Piece| {
            // Letters are the same letter; variables only when they are the same variable.
            let is_repeated = match piece.letter {
                None => false,
                Some(Letter::Variable) => !variables.insert(self.value(piece).chars().next()),
                Some(letter) => !letters.insert(letter),
            };
            let problem = self.problem(piece, is_repeated, class)?;
            Some(problem.with_text(self.fault(piece)))
        };
        self.pieces.iter().filter_map(of_piece).collect()
    }

    fn problem(self, piece: &Piece, is_repeated: bool, class: ElementClass) -> Option<Diagnostic> {
        let first = self.string[piece.span()].chars().next()?;
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

    fn twice(self, letter: Letter, piece: &Piece) -> Diagnostic {
        match (letter, self.value(piece).chars().next()) {
            (Letter::Variable, Some(name)) => {
                Diagnostic::new(&messages::VARIABLE_TWICE).with("variable", name)
            }
            _ => Diagnostic::new(&messages::TWICE).with("letter", letter.as_char()),
        }
    }
}

impl Piece {
    fn span(&self) -> Range<usize> {
        range(&self.span)
    }
}

impl Written {
    /// What a value is that a letter has, or that is put in for one.
    pub(crate) fn of(letter: Letter, value: &str) -> Self {
        let number = match letter {
            _ if letter.is_text() => None,
            Letter::N => parse_integer(value).map(|number| number as f64),
            _ => parse_number(value),
        };
        match number {
            Some(number) => Self::Number(number),
            None if value.bytes().any(|byte| byte == b'=') => Self::Reference,
            None if letter.is_text() => Self::Text,
            None => Self::NoNumber,
        }
    }
}

fn is_right(is_plain: bool, letters: Letters, class: ElementClass) -> bool {
    is_plain && class.effective_letters().contain(letters)
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
    byte <= b' ' && matches!(byte, b' ' | b'\t' | b'\n' | b'\r')
}

/// The first piece of a text from a byte on.
fn next_piece(text: &str, from: usize) -> Option<Piece> {
    let bytes = text.as_bytes();
    let start = from + bytes[from..].iter().position(|byte| !is_blank(*byte))?;
    let length = bytes[start..].iter().position(|byte| is_blank(*byte));
    let end = length.map_or(bytes.len(), |length| start + length);
    // All letters are ASCII.
    let letter = Letter::new(char::from(bytes[start]));
    let written = letter.map_or(Written::Text, |letter| Written::of(letter, &text[start + 1..end]));
    Some(Piece { letter, written, span: number(start)..number(end) })
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
