//! Characters that are easily mistaken for characters of parameter texts. They are used for hints only: no text is repaired.

use pathbuild_diagnostic::messages::outputs;
use pathbuild_diagnostic::{Diagnostic, Message, Note, Value, nearest};

/// Cyrillic and Greek letters, and the Latin letters or digits that they look like.
const LETTERS: [(&str, &str); 3] = [
    ("АВЕЅІЈКМНОРСТУХЗ", "ABESIJKMHOPCTYX3"),
    ("ΑΒΕΖΗΙΚΜΝΟΡΤΥΧ", "ABEZHIKMNOPTYX"),
    ("асеорхуіѕ", "aceopxyis"),
];

/// Returns the keyboard character that a character looks like: a minus for longer dashes, and Latin letters and digits for Cyrillic, Greek and
/// full-width ones.
pub(crate) fn ascii(character: char) -> Option<char> {
    match character {
        '\u{2010}'..='\u{2015}' | '\u{2212}' | '\u{fe63}' => Some('-'),
        '\u{ff01}'..='\u{ff5e}' => char::from_u32(u32::from(character) - 0xfee0),
        _ if character.is_ascii() => None,
        _ => LETTERS.iter().find_map(|(foreign, latin)| {
            foreign.chars().zip(latin.chars()).find(|(known, _)| *known == character).map(|(_, latin)| latin)
        }),
    }
}

/// Returns a text with each look-alike replaced by the keyboard character that it looks like.
pub(crate) fn with_keyboard_characters(text: &str) -> String {
    text.chars().map(|character| ascii(character).unwrap_or(character)).collect()
}

/// Returns the first look-alike in a text and the character that it looks like, as arguments of a message.
pub(crate) fn first_look_alike(text: &str) -> Option<Vec<(&'static str, Value)>> {
    let (character, plain) = text.chars().find_map(|character| Some((character, ascii(character)?)))?;
    let code = Value::quoted(format!("U+{:04X}", u32::from(character)));
    Some(vec![("character", character.into()), ("code", code), ("plain", plain.into())])
}

pub(crate) fn look_alike_problem(message: &'static Message, text: &str) -> Option<Diagnostic> {
    let mut problem = Diagnostic::new(message);
    problem.arguments.extend(first_look_alike(text)?);
    Some(problem)
}

/// Returns a number with letters that look like digits replaced by these digits, as in `O,3` or `l.5`.
pub(crate) fn with_digits(value: &str) -> String {
    let digit = |character| match character {
        'O' | 'o' => '0',
        'l' | 'I' | '|' => '1',
        other => other,
    };
    value.chars().map(digit).collect()
}

/// Returns the name of a layer with all look-alikes replaced, also those of digits.
pub(crate) fn plain_name(layer: &str) -> String {
    with_digits(&with_keyboard_characters(layer))
}

/// Returns a note about the layer with the name most like that of a path: if possible, one that differs only in look-alike characters.
pub fn near_layer<'l>(path: &str, layers: impl Iterator<Item = &'l str> + Clone) -> Option<Note> {
    let is_alike = |layer: &&str| {
        with_keyboard_characters(layer).eq_ignore_ascii_case(path) && first_look_alike(layer).is_some()
    };
    if let Some(layer) = layers.clone().find(is_alike) {
        let mut arguments = first_look_alike(layer)?;
        arguments.push(("layer", Value::quoted(layer)));
        return Some(Note { message: &outputs::LOOK_ALIKE_LAYER, arguments });
    }
    let layer = nearest(path, layers)?;
    Some(Note { message: &outputs::NEAR_LAYER, arguments: vec![("layer", Value::quoted(layer))] })
}
