//! Recognises typical mistakes that affect a whole text, and reports each as a single error with the corrected text.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::parameters as messages;

use crate::letter::{Letter, Letters};
use crate::matrix::ElementClass;
use crate::number::parse_number;
use crate::text::{LetterValue, ParameterText, ValueKind};

/// A text that is malformed as a whole, so that none of its pieces is used.
pub(crate) struct Misreading {
    /// The single error to report, without a place.
    pub(crate) problem: Diagnostic,
    /// The letters that it may have been meant to give.
    pub(crate) unread: Letters,
}

/// The mistake in a text as a whole, if there is one.
pub(crate) fn in_text(text: ParameterText<'_>, class: ElementClass) -> Option<Misreading> {
    if text.is_plain {
        return None;
    }
    if let Some(problem) = commas(text).or_else(|| lower_case(text, class)) {
        return Some(Misreading { problem, unread: Letters::ALL });
    }
    // A remark gives no parameters, but in place of the path's own text it may hide them.
    let unread = if class == ElementClass::PathStart { Letters::ALL } else { Letters::default() };
    remark(text, class).map(|problem| Misreading { problem, unread })
}

/// Recognises commas as separators: `O2,T2,B0`.
fn commas(text: ParameterText<'_>) -> Option<Diagnostic> {
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
fn lower_case(text: ParameterText<'_>, class: ElementClass) -> Option<Diagnostic> {
    let upper = |piece: &LetterValue| {
        let letter = text.letter(piece)?.to_ascii_uppercase();
        piece
            .letter
            .is_none()
            .then(|| Letter::new(letter))
            .flatten()
            .filter(|upper| class.use_of(*upper).counts())
    };
    if text.pieces().iter().filter(|piece| upper(piece).is_some()).count() < 2 {
        return None;
    }
    let written = |piece: &LetterValue| match upper(piece) {
        Some(letter) => format!("{}{}", letter.as_char(), text.value(piece)),
        None => format!("{}{}", text.letter(piece).unwrap_or_default(), text.value(piece)),
    };
    let written = text.pieces().iter().map(written).collect::<Vec<_>>().join(" ");
    Some(Diagnostic::new(&messages::LOWER_CASE_TEXT).quoting("text", written).with_text(text.whole()))
}

/// Recognises remarks: words without any effective parameter, such as `Deckel links` or `Halter rechts, 2 Stück`.
fn remark(text: ParameterText<'_>, class: ElementClass) -> Option<Diagnostic> {
    let counts = |piece: &LetterValue| piece.letter.is_some_and(|letter| class.use_of(letter).counts());
    let is_word = |piece: &LetterValue| {
        let value = text.value(piece).trim_end_matches([',', ';', '.', ':', '!', '?']);
        let is_text = counts(piece) && piece.letter.is_some_and(Letter::is_text);
        !is_text
            && value.chars().nth(1).is_some()
            && text.letter(piece).is_some_and(char::is_alphabetic)
            && value.chars().all(char::is_alphabetic)
    };
    let is_parameter = |piece: &LetterValue| counts(piece) && !is_word(piece);
    let pieces = text.pieces();
    let is_remark = pieces.iter().any(is_word) && !pieces.iter().any(is_parameter);
    is_remark
        .then(|| Diagnostic::new(&messages::REMARK).quoting("text", text.as_str()).with_text(text.whole()))
}

/// Recognises a number with a unit or a punctuation mark: `O3mm`.
pub(crate) fn unit(letter: Letter, value: &str) -> Option<Diagnostic> {
    let end = value.find(|character: char| !matches!(character, '+' | '-' | '.' | ',' | '0'..='9'));
    let (number, rest) = value.split_at(end.unwrap_or(value.len()));
    let number = number.trim_end_matches(['.', ',']);
    let is_unit = UNITS.iter().any(|unit| rest.eq_ignore_ascii_case(unit));
    if !is_unit || number.len() == value.len() || parse_number(number).is_none() {
        return None;
    }
    let problem = Diagnostic::new(&messages::NUMBER_WITH_UNIT).with("letter", letter.as_char());
    Some(problem.quoting("value", value).quoting("meant", format!("{}{number}", letter.as_char())))
}

/// Suffixes of numbers in mm or mm/min.
const UNITS: [&str; 8] = ["", ";", ":", "mm", "mm;", "mm,", "mm/min", "/min"];

/// Recognises an equals sign between letter and number: `B=2`. `problem`: the error about the reference.
pub(crate) fn equals_sign(letter: Letter, value: &str, problem: &Diagnostic) -> Option<Diagnostic> {
    let number = value.strip_prefix('=').filter(|number| parse_number(number).is_some())?;
    if letter.is_text() || problem.message != &messages::UNKNOWN_REFERENCE {
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

/// Recognises the intended meaning of a piece without a letter: a zero instead of O, or a path name without `>`.
pub(crate) fn in_piece(
    text: ParameterText<'_>,
    piece: &LetterValue,
    class: ElementClass,
) -> Option<Diagnostic> {
    let value = text.value(piece);
    let before = text.pieces().iter().take_while(|other| *other != piece).last();
    let is_apart = |sign: &LetterValue| sign.letter == Some(Letter::Embed) && text.value(sign).is_empty();
    let (message, meant) = match text.letter(piece)? {
        first if class == ElementClass::Subpath && before.is_some_and(is_apart) => {
            (&messages::NAME_APART_FROM_SIGN, format!(">{first}{value}"))
        }
        first if before.is_some_and(|letter| is_without_value(text, letter)) => {
            let meant =
                format!("{}{first}{value}", before.map(|letter| text.piece_text(letter)).unwrap_or_default());
            parse_number(meant.get(1..).unwrap_or_default())?;
            (&messages::VALUE_APART, meant)
        }
        digit if class == ElementClass::Subpath && digit.is_ascii_digit() => {
            (&messages::NAME_WITHOUT_SIGN, format!(">{digit}{value}"))
        }
        '0' if class.use_of(Letter::O).counts() && parse_number(value).is_some() => {
            (&messages::ZERO_FOR_O, format!("O{value}"))
        }
        _ => return None,
    };
    Some(Diagnostic::new(message).quoting("meant", meant).with("element", class.word()))
}
