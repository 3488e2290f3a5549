//! Splits parameter texts into letters and values, and explains common mistakes. (book: language/parameter-texts)

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::num::NonZeroU32;
use std::ops::Range;

use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, TextFault};

use crate::letter::{ElementClass, Letter, LetterUse, Letters, ValueType};
use crate::look_alikes;
use crate::numbers::{parse_integer, parse_number};
use crate::variables::Definition;

/// The parameter texts of a path, parsed once for all stages.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ParameterTexts {
    /// All texts, concatenated.
    string: String,
    pieces: Vec<LetterValue>,
    texts: Vec<Text>,
}

/// Identifies a text of a path: its number, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TextId(NonZeroU32);

/// The ranges of a text and its pieces, and properties of the whole text.
#[derive(Clone, Debug, PartialEq)]
struct Text {
    string: Range<u32>,
    pieces: Range<u32>,
    letters: Letters,
    is_plain: bool,
    swallowed: Option<u32>,
}

/// A parameter text, split into pieces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ParameterText<'t> {
    string: &'t str,
    pieces: &'t [LetterValue],
    pub(crate) letters: Letters,
    /// Whether all pieces of the text have different letters and valid values without references to variables.
    pub(crate) is_plain: bool,
    /// Byte offset of the first parameter that a `~` joined to the value before it although blanks separate them.
    swallowed: Option<u32>,
}

/// A letter with its value, before variables are substituted.
#[derive(Clone, Debug, PartialEq)]
pub struct LetterValue {
    /// The letter; `None` if the piece begins with another character (PB202).
    pub letter: Option<Letter>,
    pub(crate) written: ValueKind,
    /// The byte range in the text.
    span: Range<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ValueKind {
    /// A number, for a letter with a numeric value.
    Number(f64),
    /// A text, for a letter with a text value.
    Text,
    /// A value that contains references, so it is unknown before variables are bound.
    Reference,
    /// A value that is not a number, although the letter requires one.
    NoNumber,
}

impl ParameterTexts {
    /// Adds a text as drawn: lines that end in `~` are joined with the next ones, and `%%` codes are replaced.
    pub(crate) fn push_drawn(&mut self, text: &str) -> TextId {
        // Texts with the same content are usually near each other.
        let is_same = |known: &&Text| known.swallowed.is_none() && self.string[range(&known.string)] == *text;
        if let Some(same) = self.texts.iter().rev().take(COMPARED_TEXTS).find(is_same) {
            let same = same.clone();
            return self.add(same);
        }
        // Most texts contain neither codes nor continuation lines.
        let is_plain = !text.bytes().any(|byte| matches!(byte, b'%' | b'~'));
        if is_plain { self.push(text) } else { self.push_lines(&without_percent_codes(text)) }
    }

    /// Adds a text whose codes are already replaced, and joins its lines.
    fn push_lines(&mut self, text: &str) -> TextId {
        let (joined, swallowed) = join_lines(text);
        let id = self.push(&joined);
        if let Some(text) = self.texts.last_mut() {
            text.swallowed = swallowed;
        }
        id
    }

    /// Adds a text whose lines are already joined and whose codes are already replaced.
    pub(crate) fn push(&mut self, text: &str) -> TextId {
        let (start, first) = (self.string.len(), self.pieces.len());
        self.string.push_str(text);
        let (mut letters, mut is_plain, mut end) = (Letters::default(), true, 0);
        while let Some(piece) = next_piece(text, end) {
            let is_new = piece.letter.is_some_and(|letter| letters.insert(letter));
            is_plain &= is_new && matches!(piece.written, ValueKind::Number(_) | ValueKind::Text);
            end = piece.span.end as usize;
            self.pieces.push(piece);
        }
        let (string, pieces) =
            (number(start)..number(self.string.len()), number(first)..number(self.pieces.len()));
        self.add(Text { string, pieces, letters, is_plain, swallowed: None })
    }

    fn add(&mut self, text: Text) -> TextId {
        self.texts.push(text);
        TextId(NonZeroU32::MIN.saturating_add(number(self.texts.len() - 1)))
    }

    /// Returns the text with this number; `None` if there is no such text.
    pub fn get(&self, text: TextId) -> Option<ParameterText<'_>> {
        self.texts.get(text.0.get() as usize - 1).map(|text| self.text(text))
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = ParameterText<'_>> {
        self.texts.iter().map(|text| self.text(text))
    }

    /// Returns the first text, if there is one.
    pub fn first(&self) -> Option<ParameterText<'_>> {
        self.texts.first().map(|text| self.text(text))
    }

    fn text(&self, text: &Text) -> ParameterText<'_> {
        let Text { string, pieces, letters, is_plain, swallowed } = text;
        ParameterText {
            string: &self.string[range(string)],
            pieces: &self.pieces[range(pieces)],
            letters: *letters,
            is_plain: *is_plain,
            swallowed: *swallowed,
        }
    }
}

/// Number of preceding texts that a new text is compared with before it is parsed.
const COMPARED_TEXTS: usize = 8;

fn number(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX)
}

fn range(numbers: &Range<u32>) -> Range<usize> {
    numbers.start as usize..numbers.end as usize
}

impl From<&str> for ParameterTexts {
    /// Creates a single text from lines with their `%%` codes already replaced.
    fn from(text: &str) -> Self {
        let mut texts = Self::default();
        texts.push_lines(text);
        texts
    }
}

impl<'t> ParameterText<'t> {
    /// The text as shown in diagnostics.
    pub fn as_str(self) -> &'t str {
        self.string
    }

    /// All pieces in the order written.
    pub fn pieces(self) -> &'t [LetterValue] {
        self.pieces
    }

    /// Returns the first piece with this letter.
    pub fn piece(self, letter: Letter) -> Option<&'t LetterValue> {
        self.pieces.get(self.index(letter)?)
    }

    /// Returns the index of the first piece with this letter.
    pub(crate) fn index(self, letter: Letter) -> Option<usize> {
        self.pieces.iter().position(|piece| piece.letter == Some(letter))
    }

    /// Returns the first character of a piece, whether it is a parameter letter or not.
    pub(crate) fn first_character(self, piece: &LetterValue) -> Option<char> {
        self.string[piece.span()].chars().next()
    }

    pub(crate) fn piece_text(self, piece: &LetterValue) -> &'t str {
        &self.string[piece.span()]
    }

    /// Returns the value of a piece as written.
    pub fn value(self, piece: &LetterValue) -> &'t str {
        let mut characters = self.string[piece.span()].chars();
        characters.next();
        characters.as_str()
    }

    /// Returns the letters that pieces without a letter may stand for: B for `b2`, any letter for a lone `2`, none for `X9`.
    pub(crate) fn unread_letters(self) -> Letters {
        let meant = |piece: &LetterValue| {
            let first = self.first_character(piece).unwrap_or_default();
            match Letter::new(first.to_ascii_uppercase()) {
                Some(letter) => Letters::of(&[letter]),
                None if first.is_ascii_alphabetic() => Letters::default(),
                None => Letters::ALL,
            }
        };
        let unread = self.pieces.iter().filter(|piece| piece.letter.is_none());
        unread.fold(Letters::default(), |all, piece| all.union(meant(piece)))
    }

    /// Returns all letters that the text sets or may have been intended to set, whatever its element.
    pub(crate) fn possible_letters(self) -> Letters {
        match mistake_in_text(self, ElementClass::Unread) {
            Some(misreading) => misreading.unread,
            None => self.letters.union(self.unread_letters()),
        }
    }

    pub(crate) fn repeats(self, letter: Letter) -> bool {
        !self.is_plain && self.pieces.iter().filter(|piece| piece.letter == Some(letter)).nth(1).is_some()
    }

    /// Returns the whole text with a piece underlined.
    pub fn fault(self, piece: &LetterValue) -> TextFault {
        TextFault::new(self.string, piece.span())
    }

    /// Returns the whole text with the first piece of a letter underlined, if there is one.
    pub(crate) fn fault_of(self, letter: Letter) -> Option<TextFault> {
        self.piece(letter).map(|piece| self.fault(piece))
    }

    /// The whole text, underlined.
    pub fn whole_text_fault(self) -> TextFault {
        TextFault::new(self.string, 0..self.string.len())
    }

    /// Returns the problems that do not depend on variables, without places: PB202, PB204 to PB206, and as warnings PB210 and PB211. Texts that are
    /// ignored have none.
    pub fn problems(self, class: ElementClass) -> Vec<Diagnostic> {
        if class == ElementClass::Unread {
            return Vec::new();
        }
        if let Some(misreading) = mistake_in_text(self, class) {
            return vec![misreading.problem];
        }
        let (mut letters, mut variables) = (Letters::default(), BTreeSet::new());
        let of_piece = |piece: &LetterValue| {
            // A letter must not be repeated; variables may occur several times under different names.
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

    fn problem(self, piece: &LetterValue, is_repeated: bool, class: ElementClass) -> Option<Diagnostic> {
        let first = self.string[piece.span()].chars().next()?;
        let Some(letter) = piece.letter else {
            if class == ElementClass::PathStart
                && let Some((definition, meant)) = separated_definition(self, piece)
            {
                let is_first =
                    self.pieces.iter().skip_while(|other| *other != definition).nth(1) == Some(piece);
                let problem = Diagnostic::new(&messages::VALUE_APART).quoting("meant", meant);
                return is_first.then_some(problem);
            }
            let mistake = mistake_in_piece(self, piece, class).or_else(|| self.word_problem(piece, class));
            return Some(mistake.unwrap_or_else(|| unknown_letter_problem(first, class)));
        };
        let letter_use = class.use_of(letter);
        if matches!(letter_use, LetterUse::Unknown | LetterUse::PathOnly) {
            if letter == Letter::Embed {
                return Some(
                    Diagnostic::new(&messages::NAME_ON_OTHER_ELEMENT)
                        .with("letter", first)
                        .with("element", class.word()),
                );
            }
            return Some(
                self.word_problem(piece, class).unwrap_or_else(|| unknown_letter_problem(first, class)),
            );
        }
        if is_repeated {
            return Some(self.repeated_letter_problem(letter, piece));
        }
        if letter.is_literal() && self.value(piece).contains('=') {
            return Some(Diagnostic::new(&messages::VARIABLE_NOT_ALLOWED).with("letter", first));
        }
        if letter_use == LetterUse::Ignored {
            return Some(self.no_effect_problem(letter, piece, class));
        }
        self.unseparated_parameter_problem(letter, piece, class)
    }

    /// Returns PB211 for a text value that contains what looks like a parameter of the element: `Qslot,B1`, or B1 with a space before it on the line
    /// after `Qslot~`. A number that runs on like this is an error in itself.
    fn unseparated_parameter_problem(
        self,
        letter: Letter,
        piece: &LetterValue,
        class: ElementClass,
    ) -> Option<Diagnostic> {
        // Commas separate the values of a variable, and the other signs have rules of their own.
        if !letter.is_text() || matches!(letter, Letter::Embed | Letter::At | Letter::Variable) {
            return None;
        }
        let is_separator = |character: char| ",;:/".contains(character) || is_special_space(character);
        let is_parameter = |part: &&str| {
            let mut characters = part.chars();
            let letter = characters.next().and_then(Letter::new).filter(|letter| !letter.is_text());
            letter.is_some_and(|letter| {
                class.use_of(letter).counts() && parse_number(characters.as_str()).is_some()
            })
        };
        let mut parts = self.value(piece).split(is_separator).skip(1);
        let swallowed = self.swallowed.filter(|at| piece.span.contains(at));
        let swallowed = swallowed.map(|at| &self.string[at as usize..piece.span().end]).filter(is_parameter);
        let (message, parameter) = match swallowed {
            Some(parameter) => (&messages::SWALLOWED_PARAMETER, parameter),
            None => (&messages::UNSEPARATED_PARAMETER, parts.find(is_parameter)?),
        };
        let problem = Diagnostic::new(message).with("letter", letter.as_char());
        Some(problem.quoting("value", self.value(piece)).quoting("parameter", parameter))
    }

    /// Returns PB202 for a word among parameters: `B2 tief`.
    fn word_problem(self, piece: &LetterValue, class: ElementClass) -> Option<Diagnostic> {
        let word = self.piece_text(piece);
        let is_word = word.chars().nth(2).is_some() && word.chars().all(char::is_alphabetic);
        let known: pathbuild_diagnostic::Value =
            class.known_letters().map(|known| known.to_string()).collect();
        is_word.then(|| {
            let problem = match self.piece(Letter::Q) {
                _ if !class.use_of(Letter::Q).counts() => Diagnostic::new(&messages::WORD_WITHOUT_Q),
                Some(comment) => {
                    Diagnostic::new(&messages::WORD_AFTER_COMMENT).quoting("comment", self.value(comment))
                }
                None => Diagnostic::new(&messages::WORD),
            };
            problem.quoting("word", word).with("known", known).with("element", class.word())
        })
    }

    /// Returns PB210. The advice depends on the intention: a depth with a letter that has no effect should be replaced by the other depth, not just
    /// removed.
    fn no_effect_problem(self, letter: Letter, piece: &LetterValue, class: ElementClass) -> Diagnostic {
        let counts = |other| class.use_of(other) == LetterUse::Needed;
        let problem = match letter {
            Letter::B if counts(Letter::D) => Diagnostic::new(&messages::BOTTOM_OF_MARK),
            Letter::D if counts(Letter::B) => Diagnostic::new(&messages::DEPTH_OF_MILLING),
            _ => return Diagnostic::new(&messages::WITHOUT_EFFECT).with("letter", letter.as_char()),
        };
        problem.with("letter", letter.as_char()).quoting("value", self.value(piece))
    }

    fn repeated_letter_problem(self, letter: Letter, piece: &LetterValue) -> Diagnostic {
        match (letter, self.value(piece).chars().next()) {
            (Letter::Variable, Some(name)) => {
                Diagnostic::new(&messages::VARIABLE_TWICE).with("variable", name)
            }
            _ => Diagnostic::new(&messages::TWICE).with("letter", letter.as_char()),
        }
    }
}

impl LetterValue {
    fn span(&self) -> Range<usize> {
        range(&self.span)
    }
}

impl ValueKind {
    /// Classifies a value of a letter.
    pub(crate) fn of(letter: Letter, value: &str) -> Self {
        let number = match letter.value_type() {
            ValueType::Text => None,
            ValueType::Integer => parse_integer(value).map(|number| number as f64),
            ValueType::Length | ValueType::Feed => parse_number(value),
        };
        match number {
            Some(number) => Self::Number(number),
            None if value.bytes().any(|byte| byte == b'=') => Self::Reference,
            None if letter.is_text() => Self::Text,
            None => Self::NoNumber,
        }
    }
}

fn unknown_letter_problem(letter: char, class: ElementClass) -> Diagnostic {
    let upper = Letter::new(letter.to_ascii_uppercase()).filter(|upper| class.use_of(*upper).counts());
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

/// Joins lines ending in `~`, by which a long value continues on the next line. Spaces after the `~` are ignored, because they are
/// invisible in a CAD program. Also returns the offset of the first parameter that follows a `~` and blanks.
fn join_lines(text: &str) -> (Cow<'_, str>, Option<u32>) {
    if !text.contains('~') {
        return (Cow::Borrowed(text), None);
    }
    let mut swallowed = None;
    let mut joined = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(tilde) = rest.find('~') {
        let after = &rest[tilde + 1..];
        let line_end =
            after.trim_start_matches(|character: char| character.is_whitespace() && !is_line_end(character));
        let is_continued = line_end.starts_with(is_line_end);
        joined.push_str(&rest[..tilde + usize::from(!is_continued)]);
        rest = after;
        if is_continued {
            rest = line_end.trim_start_matches(|character| u8::try_from(character).is_ok_and(is_blank));
            let next_line = line_end.strip_prefix('\r').unwrap_or(line_end);
            let next_line = next_line.strip_prefix('\n').unwrap_or(next_line);
            let is_number = |piece: LetterValue| matches!(piece.written, ValueKind::Number(_));
            if swallowed.is_none()
                && rest.len() < next_line.len()
                && next_piece(rest, 0).is_some_and(is_number)
            {
                swallowed = Some(number(joined.len()));
            }
        }
    }
    joined.push_str(rest);
    (Cow::Owned(joined), swallowed)
}

fn is_line_end(character: char) -> bool {
    matches!(character, '\n' | '\r')
}

/// Whether a byte separates pieces. Non-breaking spaces do not.
fn is_blank(byte: u8) -> bool {
    byte <= b' ' && matches!(byte, b' ' | b'\t' | b'\n' | b'\r')
}

/// Returns the first blank-separated piece of a text, usually a letter with its value, at or after a byte offset.
fn next_piece(text: &str, from: usize) -> Option<LetterValue> {
    let bytes = text.as_bytes();
    let start = from + bytes[from..].iter().position(|byte| !is_blank(*byte))?;
    let length = bytes[start..].iter().position(|byte| is_blank(*byte));
    let end = length.map_or(bytes.len(), |length| start + length);
    // All letters are ASCII.
    let letter = Letter::new(char::from(bytes[start]));
    let written = letter.map_or(ValueKind::Text, |letter| ValueKind::of(letter, &text[start + 1..end]));
    Some(LetterValue { letter, written, span: number(start)..number(end) })
}

/// Replaces `%%c`, `%%d` and `%%p` by `_D`, `_G` and `_+`, and drops `%%u` and `%%o`, which underline and overline.
pub(crate) fn without_percent_codes(text: &str) -> Cow<'_, str> {
    replace_percent_codes(text, |code| code.letters)
}

/// Replaces `%%c`, `%%d` and `%%p` by the characters that CAD programs show, and drops `%%u` and `%%o`.
pub fn as_seen(text: &str) -> Cow<'_, str> {
    replace_percent_codes(text, |code| code.seen)
}

/// The meaning of a code such as `%%c`.
struct PercentCode {
    /// The code's replacement in parameters.
    letters: &'static str,
    /// What a CAD program shows.
    seen: &'static str,
}

impl PercentCode {
    /// Returns the code with this character after `%%`; `None` if there is none.
    fn new(character: char) -> Option<Self> {
        Some(match character {
            'c' | 'C' => Self { letters: "_D", seen: "\u{2300}" },
            'd' | 'D' => Self { letters: "_G", seen: "\u{b0}" },
            'p' | 'P' => Self { letters: "_+", seen: "\u{b1}" },
            'u' | 'U' | 'o' | 'O' => Self { letters: "", seen: "" },
            _ => return None,
        })
    }
}

fn replace_percent_codes(text: &str, replacement: impl Fn(PercentCode) -> &'static str) -> Cow<'_, str> {
    if !text.contains('%') {
        return Cow::Borrowed(text);
    }
    let mut replaced = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find("%%") {
        if let Some(code) = rest[at + 2..].chars().next().and_then(PercentCode::new) {
            replaced.push_str(&rest[..at]);
            replaced.push_str(replacement(code));
            rest = &rest[at + 3..];
        } else {
            replaced.push_str(&rest[..=at]);
            rest = &rest[at + 1..];
        }
    }
    replaced.push_str(rest);
    Cow::Owned(replaced)
}

/// A text that is malformed as a whole, so that none of its pieces is used.
pub(crate) struct Misreading {
    /// The single error to report, without a place.
    pub(crate) problem: Diagnostic,
    /// The letters that the text may have been meant to give.
    pub(crate) unread: Letters,
}

/// Returns the mistake in a text as a whole, if there is one.
pub(crate) fn mistake_in_text(text: ParameterText<'_>, class: ElementClass) -> Option<Misreading> {
    if text.is_plain {
        return None;
    }
    let mistake = comma_mistake(text)
        .or_else(|| lower_case_mistake(text, class))
        .or_else(|| run_together_mistake(text, class));
    if let Some(problem) = mistake {
        return Some(Misreading { problem, unread: Letters::ALL });
    }
    // A remark gives no parameters. If it stands in place of the path's own text, however, any letter may be missing because of that.
    let unread = if class == ElementClass::PathStart { Letters::ALL } else { Letters::default() };
    remark_mistake(text, class).map(|problem| Misreading { problem, unread })
}

/// Recognises commas as separators: `O2,T2,B0`.
fn comma_mistake(text: ParameterText<'_>) -> Option<Diagnostic> {
    let is_separator =
        |value: &str, at: usize| value[at + 1..].chars().next().and_then(Letter::new).is_some();
    let has_separator = |piece: &&LetterValue| {
        let value = text.value(piece);
        piece.written == ValueKind::NoNumber
            && value.match_indices(',').any(|(at, _)| is_separator(value, at))
    };
    let piece = text.pieces().iter().find(has_separator)?;
    let string = text.as_str();
    let separated = string
        .char_indices()
        .map(|(at, character)| if character == ',' && is_separator(string, at) { ' ' } else { character });
    let problem = Diagnostic::new(&messages::COMMAS).quoting("text", separated.collect::<String>());
    Some(problem.with_text(text.fault(piece)))
}

/// Recognises lower case: `o2 t2 i0.5 b0`.
fn lower_case_mistake(text: ParameterText<'_>, class: ElementClass) -> Option<Diagnostic> {
    let upper = |piece: &LetterValue| {
        let letter = Letter::new(text.first_character(piece)?.to_ascii_uppercase())?;
        let is_meant = piece.letter.is_none()
            && class.use_of(letter).counts()
            && ValueKind::of(letter, text.value(piece)) != ValueKind::NoNumber;
        is_meant.then_some(letter)
    };
    if text.pieces().iter().filter(|piece| upper(piece).is_some()).count() < 2 {
        return None;
    }
    let written = |piece: &LetterValue| match upper(piece) {
        Some(letter) => format!("{}{}", letter.as_char(), text.value(piece)),
        None => format!("{}{}", text.first_character(piece).unwrap_or_default(), text.value(piece)),
    };
    let written = text.pieces().iter().map(written).collect::<Vec<_>>().join(" ");
    Some(
        Diagnostic::new(&messages::LOWER_CASE_TEXT)
            .quoting("text", written)
            .with_text(text.whole_text_fault()),
    )
}

/// Recognises letters with numbers that are not separated by spaces: `B2F100` or `B2;F100`.
fn run_together_mistake(text: ParameterText<'_>, class: ElementClass) -> Option<Diagnostic> {
    let parts = |piece: &LetterValue| {
        let is_faulty = piece.written == ValueKind::NoNumber;
        is_faulty.then(|| parameters_in(text.piece_text(piece), class)).flatten()
    };
    let piece = text.pieces().iter().find(|piece| parts(piece).is_some())?;
    let separated = |piece: &LetterValue| match parts(piece) {
        Some(parts) => parts.join(" "),
        None => text.piece_text(piece).to_owned(),
    };
    let separated: Vec<String> = text.pieces().iter().map(separated).collect();
    let problem = Diagnostic::new(&messages::RUN_TOGETHER).quoting("text", separated.join(" "));
    Some(problem.with_text(text.fault(piece)))
}

/// Returns the parameters in a word that consists of several parameters: letters that have an effect, each with a number.
fn parameters_in(word: &str, class: ElementClass) -> Option<Vec<&str>> {
    let counts = |character| {
        Letter::new(character).is_some_and(|letter| !letter.is_text() && class.use_of(letter).counts())
    };
    let mut starts: Vec<usize> =
        word.char_indices().filter(|(_, letter)| counts(*letter)).map(|(at, _)| at).collect();
    starts.push(word.len());
    let parts = starts.windows(2).map(|part| word[part[0]..part[1]].trim_end_matches([',', ';', '/', '|']));
    let parts: Vec<&str> = parts.collect();
    let are_numbers = parts.iter().all(|part| parse_number(&part[1..]).is_some());
    (starts[0] == 0 && parts.len() > 1 && are_numbers).then_some(parts)
}

/// Recognises remarks: words or numbers of workpieces without any effective parameter, such as `Deckel links`, `Halter rechts, 2 Stück` or `3x M3`.
fn remark_mistake(text: ParameterText<'_>, class: ElementClass) -> Option<Diagnostic> {
    let counts = |piece: &LetterValue| piece.letter.is_some_and(|letter| class.use_of(letter).counts());
    let is_word = |piece: &LetterValue| {
        let value = text.value(piece).trim_end_matches([',', ';', '.', ':', '!', '?']);
        let is_text = counts(piece) && piece.letter.is_some_and(Letter::is_text);
        !is_text
            && value.chars().nth(1).is_some()
            && text.first_character(piece).is_some_and(char::is_alphabetic)
            && value.chars().all(char::is_alphabetic)
    };
    let is_parameter = |piece: &LetterValue| counts(piece) && !is_word(piece);
    let is_count = |piece: &LetterValue| {
        let count = text.piece_text(piece).trim_end_matches(['x', 'X', '\u{d7}']);
        !count.is_empty()
            && count.len() < text.piece_text(piece).len()
            && count.bytes().all(|byte| byte.is_ascii_digit())
    };
    let pieces = text.pieces();
    let is_remark =
        pieces.iter().any(|piece| is_word(piece) || is_count(piece)) && !pieces.iter().any(is_parameter);
    let message =
        if class.use_of(Letter::Q).counts() { &messages::REMARK } else { &messages::REMARK_WITHOUT_Q };
    is_remark
        .then(|| Diagnostic::new(message).quoting("text", text.as_str()).with_text(text.whole_text_fault()))
}

/// Recognises a number with a unit or a punctuation mark: `O3mm`.
pub(crate) fn unit_mistake(letter: Letter, value: &str) -> Option<Diagnostic> {
    let end = value.find(|character: char| !matches!(character, '+' | '-' | '.' | ',' | '0'..='9'));
    let (number, rest) = value.split_at(end.unwrap_or(value.len()));
    let number = number.trim_end_matches(['.', ',']);
    let is_unit = UNIT_SUFFIXES.iter().any(|unit| rest.eq_ignore_ascii_case(unit));
    if !is_unit || number.len() == value.len() || parse_number(number).is_none() {
        return None;
    }
    let problem = Diagnostic::new(&messages::NUMBER_WITH_UNIT).with("letter", letter.as_char());
    Some(problem.quoting("value", value).quoting("meant", format!("{}{number}", letter.as_char())))
}

/// Texts after a number that do not change its meaning: punctuation, and the units mm and mm/min.
const UNIT_SUFFIXES: [&str; 8] = ["", ";", ":", "mm", "mm;", "mm,", "mm/min", "/min"];

/// Recognises an equals sign between letter and number: `B=2`. `problem`: the error about the reference.
pub(crate) fn equals_sign_mistake(letter: Letter, value: &str, problem: &Diagnostic) -> Option<Diagnostic> {
    let number = value.strip_prefix('=').filter(|number| parse_number(number).is_some())?;
    let is_unknown =
        [&messages::UNKNOWN_REFERENCE, &messages::REFERENCE_WITHOUT_VARIABLES].contains(&problem.message);
    if letter.is_text() || !is_unknown {
        return None;
    }
    let mut problem = problem.clone();
    problem.message = &messages::EQUALS_SIGN;
    Some(problem.quoting("meant", format!("{}{number}", letter.as_char())))
}

/// Whether a letter stands alone or only with a sign, because a space separates it from its number.
pub(crate) fn is_without_value(text: ParameterText<'_>, piece: &LetterValue) -> bool {
    piece.letter.is_some_and(|letter| !letter.is_text()) && matches!(text.value(piece), "" | "-" | "+")
}

/// Returns the definition of a variable that spaces have separated from this piece, and the definition as it was meant: `:D 0 ~ 1`.
fn separated_definition<'t>(
    text: ParameterText<'t>,
    piece: &LetterValue,
) -> Option<(&'t LetterValue, String)> {
    let at = text.pieces().iter().position(|other| other == piece)?;
    let definition = text.pieces()[..at].iter().rfind(|other| other.letter.is_some())?;
    Some((definition, definition_in_pieces(text, definition)?))
}

/// Returns the definition that the piece of a variable and the pieces after it would give without the spaces between them. `None` unless that
/// definition is valid and the piece alone is not.
pub(crate) fn definition_in_pieces(text: ParameterText<'_>, definition: &LetterValue) -> Option<String> {
    let is_valid = |piece: &str| Definition::parse(&piece[Letter::Variable.as_char().len_utf8()..]).is_ok();
    let own = text.piece_text(definition);
    if definition.letter != Some(Letter::Variable) || is_valid(own) {
        return None;
    }
    let after = text.pieces().iter().skip_while(|piece| *piece != definition).skip(1);
    let values = after.take_while(|piece| piece.letter.is_none()).map(|piece| text.piece_text(piece));
    let meant: String = std::iter::once(own).chain(values).collect();
    is_valid(&meant).then_some(meant)
}

/// Whether a subpath's variable has no value, because a space separates the value from the variable's name: `:B 1`.
pub(crate) fn is_variable_without_value(
    text: ParameterText<'_>,
    piece: &LetterValue,
    class: ElementClass,
) -> bool {
    class == ElementClass::Subpath
        && piece.letter == Some(Letter::Variable)
        && text.value(piece).chars().count() == 1
}

/// Recognises the intended meaning of a piece without a letter, such as a zero instead of O, or a path name without `>`.
fn mistake_in_piece(text: ParameterText<'_>, piece: &LetterValue, class: ElementClass) -> Option<Diagnostic> {
    let value = text.value(piece);
    let before = text.pieces().iter().take_while(|other| *other != piece).last();
    let is_apart = |sign: &LetterValue| sign.letter == Some(Letter::Embed) && text.value(sign).is_empty();
    let has_name = || text.piece(Letter::Embed).is_some_and(|name| !text.value(name).is_empty());
    let (message, meant) = match text.first_character(piece)? {
        first if class == ElementClass::Subpath && before.is_some_and(is_apart) => {
            (&messages::NAME_APART_FROM_SIGN, format!(">{first}{value}"))
        }
        first if before.is_some_and(|letter| is_without_value(text, letter)) => {
            let meant =
                format!("{}{first}{value}", before.map(|letter| text.piece_text(letter)).unwrap_or_default());
            parse_number(meant.get(1..).unwrap_or_default())?;
            (&messages::VALUE_APART, meant)
        }
        first if before.is_some_and(|variable| is_variable_without_value(text, variable, class)) => {
            let variable = before.map(|variable| text.piece_text(variable)).unwrap_or_default();
            (&messages::VALUE_APART, format!("{variable}{first}{value}"))
        }
        '_' if value.starts_with(['D', 'G', '+']) => return Some(drawn_code_problem(text, piece)),
        first if look_alikes::ascii(first).and_then(Letter::new).is_some() => {
            let problem =
                look_alikes::look_alike_problem(&messages::LOOK_ALIKE_LETTER, text.piece_text(piece))?;
            return Some(
                problem.quoting("meant", look_alikes::with_keyboard_characters(text.piece_text(piece))),
            );
        }
        digit
            if class == ElementClass::Subpath
                && digit.is_ascii_digit()
                && parse_number(text.piece_text(piece)).is_none()
                && !has_name() =>
        {
            (&messages::NAME_WITHOUT_SIGN, format!(">{digit}{value}"))
        }
        '0' if class.use_of(Letter::O).counts() && parse_number(value).is_some() => {
            (&messages::ZERO_FOR_O, format!("O{value}"))
        }
        _ => return None,
    };
    Some(Diagnostic::new(message).quoting("meant", meant).with("element", class.word()))
}

/// Returns PB202 for a sign that CAD programs write as a code, such as `%%c` for the diameter.
fn drawn_code_problem(text: ParameterText<'_>, piece: &LetterValue) -> Diagnostic {
    let (code, sign) = match text.value(piece).chars().next() {
        Some('D') => ("%%c", "\u{2300}"),
        Some('G') => ("%%d", "\u{b0}"),
        _ => ("%%p", "\u{b1}"),
    };
    let value = text.value(piece).chars().skip(1).collect::<String>();
    Diagnostic::new(&messages::DRAWN_CODE)
        .quoting("sign", format!("{sign}{value}"))
        .quoting("code", code)
        .quoting("shown", text.piece_text(piece))
}

/// Whether a character looks like a space, but does not separate parameters.
pub(crate) fn is_special_space(character: char) -> bool {
    character.is_whitespace() && !character.is_ascii()
}

/// Replaces special spaces, which look like nothing or like ordinary ones, by a visible character.
pub(crate) fn with_visible_spaces(text: &str) -> String {
    text.replace(is_special_space, "\u{2423}")
}
