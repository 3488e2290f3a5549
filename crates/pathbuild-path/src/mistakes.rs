//! What a draughtsman meant by a text that is wrong as a whole: one error that shows the text as it should be.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::parameters as messages;

use crate::letter::Letter;
use crate::matrix::ElementClass;
use crate::number::parse_number;
use crate::text::{LetterValue, ParameterText, Written};

/// The one error of a text that is misunderstood as a whole; without a place.
pub(crate) fn in_text(text: ParameterText<'_>, class: ElementClass) -> Option<Diagnostic> {
    if text.is_plain {
        return None;
    }
    commas(text).or_else(|| lower_case(text, class)).or_else(|| remark(text))
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

/// `Deckel links`: words, none of which can be a parameter.
fn remark(text: ParameterText<'_>) -> Option<Diagnostic> {
    let is_word = |piece: &LetterValue| {
        let value = text.value(piece);
        let is_text = piece.letter.is_some_and(Letter::is_text);
        !is_text
            && value.chars().nth(1).is_some()
            && text.letter(piece).is_some_and(char::is_alphabetic)
            && value.chars().all(char::is_alphabetic)
    };
    let is_remark = !text.pieces().is_empty() && text.pieces().iter().all(is_word);
    is_remark.then(|| Diagnostic::new(&messages::REMARK).with("text", text.as_str()).with_text(text.whole()))
}

/// What a piece without a letter was meant to be: a zero for O, or a path's name without its sign.
pub(crate) fn in_piece(
    text: ParameterText<'_>,
    piece: &LetterValue,
    class: ElementClass,
) -> Option<Diagnostic> {
    let value = text.value(piece);
    let (message, meant) = match text.letter(piece)? {
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
