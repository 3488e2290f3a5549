//! What a draughtsman meant by a text that is wrong as a whole: one error that shows the text as it should be.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::{parameters as messages, variables};

use crate::letter::{Letter, Letters};
use crate::matrix::ElementClass;
use crate::number::parse_number;
use crate::text::{LetterValue, ParameterText, Written};

/// A text that is misunderstood as a whole: none of its pieces is read.
pub(crate) struct Misreading {
    /// The one error that is reported, without a place.
    pub(crate) problem: Diagnostic,
    /// The letters that it may have been meant to give.
    pub(crate) unread: Letters,
}

/// What is wrong with a text as a whole.
pub(crate) fn in_text(text: ParameterText<'_>, class: ElementClass) -> Option<Misreading> {
    if text.is_plain {
        return None;
    }
    if let Some(problem) = commas(text).or_else(|| lower_case(text, class)) {
        return Some(Misreading { problem, unread: Letters::ALL });
    }
    // A remark says nothing about its element, but in the place of the path's own text it may hide that.
    let unread = if class == ElementClass::PathStart { Letters::ALL } else { Letters::default() };
    remark(text, class).map(|problem| Misreading { problem, unread })
}

/// `O2,T2,B0`.
fn commas(text: ParameterText<'_>) -> Option<Diagnostic> {
    let is_separator =
        |value: &str, at: usize| value[at + 1..].chars().next().and_then(Letter::new).is_some();
    let has_separator = |piece: &&LetterValue| {
        let value = text.value(piece);
        piece.written == Written::NoNumber && value.match_indices(',').any(|(at, _)| is_separator(value, at))
    };
    let piece = text.pieces().iter().find(has_separator)?;
    let string = text.as_str();
    let separated =
        string.char_indices().map(|(at, it)| if it == ',' && is_separator(string, at) { ' ' } else { it });
    let problem = Diagnostic::new(&messages::COMMAS).with("text", separated.collect::<String>());
    Some(problem.with_text(text.fault(piece)))
}

/// `o2 t2 i0.5 b0`.
fn lower_case(text: ParameterText<'_>, class: ElementClass) -> Option<Diagnostic> {
    let upper = |piece: &LetterValue| {
        let letter = text.letter(piece)?.to_ascii_uppercase();
        piece.letter.is_none().then(|| Letter::new(letter)).flatten().filter(|it| class.use_of(*it).counts())
    };
    if text.pieces().iter().filter(|piece| upper(piece).is_some()).count() < 2 {
        return None;
    }
    let written = |piece: &LetterValue| match upper(piece) {
        Some(letter) => format!("{}{}", letter.as_char(), text.value(piece)),
        None => format!("{}{}", text.letter(piece).unwrap_or_default(), text.value(piece)),
    };
    let written = text.pieces().iter().map(written).collect::<Vec<_>>().join(" ");
    Some(Diagnostic::new(&messages::LOWER_CASE_TEXT).with("text", written).with_text(text.whole()))
}

/// `Deckel links` or `Halter rechts, 2 Stück`: words, and no parameter that counts.
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
    is_remark.then(|| Diagnostic::new(&messages::REMARK).with("text", text.as_str()).with_text(text.whole()))
}

/// `O3mm`: a number with its unit, or with a punctuation mark behind it.
pub(crate) fn unit(letter: Letter, value: &str) -> Option<Diagnostic> {
    let end = value.find(|character: char| !matches!(character, '+' | '-' | '.' | ',' | '0'..='9'));
    let (number, rest) = value.split_at(end.unwrap_or(value.len()));
    let number = number.trim_end_matches(['.', ',']);
    let is_unit = UNITS.iter().any(|unit| rest.eq_ignore_ascii_case(unit));
    if !is_unit || number.len() == value.len() || parse_number(number).is_none() {
        return None;
    }
    let problem = Diagnostic::new(&messages::NUMBER_WITH_UNIT).with("letter", letter.as_char());
    Some(problem.with("value", value).with("meant", format!("{}{number}", letter.as_char())))
}

/// What may stand behind a number that is meant in mm or in mm/min.
const UNITS: [&str; 8] = ["", ";", ":", "mm", "mm;", "mm,", "mm/min", "/min"];

/// `B=2`: an equals sign where the value follows its letter. `problem`: what is wrong with the reference.
pub(crate) fn equals_sign(letter: Letter, value: &str, problem: &Diagnostic) -> Option<Diagnostic> {
    let number = value.strip_prefix('=').filter(|number| parse_number(number).is_some())?;
    if letter.is_text() || problem.message != &variables::UNKNOWN_REFERENCE {
        return None;
    }
    let mut problem = problem.clone();
    problem.message = &variables::EQUALS_SIGN;
    Some(problem.with("meant", format!("{}{number}", letter.as_char())))
}

/// Whether a letter stands alone, or with a sign only: a blank separates it from its number.
pub(crate) fn is_without_value(text: ParameterText<'_>, piece: &LetterValue) -> bool {
    piece.letter.is_some_and(|letter| !letter.is_text()) && matches!(text.value(piece), "" | "-" | "+")
}

/// What a piece without a letter was meant to be: a zero for O, or a path's name without its sign.
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
    Some(Diagnostic::new(message).with("meant", meant).with("element", class.word()))
}
