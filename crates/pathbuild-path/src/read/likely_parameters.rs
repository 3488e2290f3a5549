//! Determines whether a text that is not read as parameters was meant as a parameter text. (book: language/parameter-texts)

use crate::letter::{Letter, Letters};
use crate::look_alikes;
use crate::text::{ParameterText, ParameterTexts, ValueKind, is_special_space};

/// Letters without which a part would be spoilt. A stray text must contain one of them to be reported.
pub(super) const ESSENTIAL_LETTERS: Letters =
    Letters::of(&[Letter::B, Letter::D, Letter::F, Letter::I, Letter::W]);

/// Whether the undecoded bytes of a text may be a parameter text that [`super::stray_findings`] reports. If not, it is certain that nothing is reported.
pub fn may_be_stray_text(text: &[u8]) -> bool {
    let is_weighty = |byte: u8| matches!(byte.to_ascii_uppercase(), b'B' | b'D' | b'F' | b'I' | b'W' | b'Z');
    // Bytes beyond ASCII, and a code such as `\\U+2212`, may be a dash instead of a minus.
    let is_value =
        |byte: u8| byte.is_ascii_digit() || matches!(byte, b'+' | b'-' | b'.' | b',' | b'=' | b'\\' | 128..);
    // A colon begins a variable, as in `:D0.5`, which is never reported; a backslash begins a format code of MTEXT, as in `\\W0.8;`, or a
    // line break: `\\P`. A bar separates the properties of a font: `\\fArial|b0|i0;`.
    let is_inside = |byte: &u8| byte.is_ascii_alphabetic() || matches!(byte, b'\\' | b':' | b'|');
    let is_begin = |before: &[u8]| {
        !before.last().is_some_and(is_inside) || BEGINNING_CODES.iter().any(|code| before.ends_with(code))
    };
    let has_value = |after: &[u8]| {
        after.iter().find(|byte| !matches!(byte, b' ' | b':')).is_some_and(|byte| is_value(*byte))
    };
    let mut letters = text.iter().enumerate().filter(|(_, byte)| is_weighty(**byte));
    letters.any(|(at, _)| is_begin(&text[..at]) && has_value(&text[at + 1..])) || may_be_probe_text(text)
}

/// Codes after which a text can begin, other than those that end with a sign: a line break, and lines over, under and through letters.
const BEGINNING_CODES: [&[u8]; 13] =
    [b"\\P", b"\\L", b"\\l", b"\\O", b"\\o", b"\\K", b"\\k", b"%%u", b"%%U", b"%%o", b"%%O", b"%%k", b"%%K"];

/// Maximum length in bytes of a text that is taken for that of a probe. Longer ones are remarks.
const MAX_PROBE_TEXT: usize = 24;

/// Whether the undecoded bytes of a text may be the text of a probe, such as `LA T2.5`: a short text that consists of values for L, T, H and Z.
pub(super) fn may_be_probe_text(text: &[u8]) -> bool {
    let is_parameter = |word: &[u8]| match word {
        [b'L', value, ..] => value.is_ascii_uppercase() || value.is_ascii_digit(),
        [b'T' | b'H' | b'Z', value, ..] => value.is_ascii_digit() || matches!(value, b'.' | b'-' | b'='),
        _ => false,
    };
    let mut words = text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).peekable();
    text.len() <= MAX_PROBE_TEXT && words.peek().is_some() && words.all(is_parameter)
}

/// Returns a text without the mistakes that would be errors on the layer of a path, but do not hide its meaning: lower-case letters, dashes instead of
/// a minus, spaces, colons and equals signs before numbers, signs or nothing between parameters, signs around them, units, and marks at the end.
pub(super) fn without_mistakes(text: &str) -> String {
    let text = look_alikes::with_keyboard_characters(text).to_ascii_uppercase().replace("/MIN", "");
    let mut meant = String::with_capacity(text.len());
    let mut rest = text.chars().peekable();
    let mut is_begin = true;
    while let Some(character) = rest.next() {
        let begins_value = |next: char| next.is_ascii_digit() || matches!(next, '-' | '.');
        let after_spaces = || rest.clone().find(|next| *next != ' ');
        let follows_number = meant.ends_with(|last: char| last.is_ascii_digit());
        if follows_number && character.is_ascii_uppercase() && after_spaces().is_some_and(begins_value) {
            meant.push(' ');
            is_begin = true;
        }
        let is_lone_letter = is_begin && character.is_ascii_alphabetic();
        let is_between = ",;./+&".contains(character) && after_spaces().is_some_and(char::is_alphabetic);
        let is_around = "()[]\"'„“”".contains(character);
        let is_separator = is_between || is_around || is_special_space(character);
        is_begin = is_separator || character.is_whitespace();
        meant.push(if is_separator { ' ' } else { character });
        if is_lone_letter {
            let is_number = rest.clone().find(|next| !matches!(next, ' ' | '=')).is_some_and(begins_value);
            while let Some(skipped) = rest.next_if(|next| {
                matches!(next, ' ' | ':' | '-') || is_special_space(*next) || *next == '=' && is_number
            }) {
                if skipped == '-' {
                    meant.push(skipped);
                }
            }
        }
    }
    let words = meant.split(' ').map(|word| word.trim_end_matches(['!', ',', ';', ':', '.']));
    let numbers = words.filter(|word| !matches!(*word, "MM" | "-")).map(|word| {
        word.strip_suffix("MM")
            .filter(|number| number.ends_with(|last: char| last.is_ascii_digit()))
            .unwrap_or(word)
    });
    numbers.collect::<Vec<_>>().join(" ")
}

/// Returns the parameters in a text with mistakes, without the words that contain no number: `Z20` for `Clamp z20mm`.
pub(super) fn parameters_between_words(text: &str) -> String {
    let is_parameter = |word: &&str| {
        word.contains(char::is_alphabetic) && word.contains(|digit: char| digit.is_ascii_digit())
    };
    without_mistakes(text).split_whitespace().filter(is_parameter).collect::<Vec<_>>().join(" ")
}

/// Whether a text is meant as parameters without which a part would be spoilt.
pub(super) fn is_parameter_text(text: &str) -> bool {
    let mut texts = ParameterTexts::default();
    let readings = [texts.push_drawn(text), texts.push_drawn(&without_mistakes(text))];
    readings.into_iter().filter_map(|id| texts.get(id)).any(looks_like_parameters)
}

/// Whether a text consists of letters with numbers or variables, and perhaps a remark with Q, and gives a letter without which a part would be
/// spoilt.
pub(super) fn looks_like_parameters(text: ParameterText<'_>) -> bool {
    let is_number = |written: ValueKind| matches!(written, ValueKind::Number(_) | ValueKind::Reference);
    text.letters.has_any(ESSENTIAL_LETTERS)
        && text.pieces().iter().all(|piece| {
            piece
                .letter
                .is_some_and(|letter| letter == Letter::Q || !letter.is_text() && is_number(piece.written))
        })
}
