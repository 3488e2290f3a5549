//! Comments, and the characters allowed in them.

use crate::dialect::{Dialect, within_comment};

/// The characters that may be written. (book: reference/configuration, `charset`)
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Charset {
    /// Umlauts and the like are transliterated, anything else becomes `?`, because some controllers take bytes above 127 for commands.
    #[default]
    Ascii,
    /// All characters are written as they are.
    Utf8,
}

/// How comments are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Remarks {
    pub(super) charset: Charset,
    /// Whether "(" is kept within a comment, as `PathDxf2GCode` does.
    pub(super) compatible: bool,
}

impl Remarks {
    /// Formats a comment of the native dialect.
    pub(super) fn comment(self, text: &str) -> String {
        if !self.compatible {
            return Dialect::Native.comment(text, self.charset);
        }
        let parts: Vec<String> =
            text.split('(').map(|part| within_comment(part, Some(Dialect::Native), self.charset)).collect();
        format!("({})", parts.join("("))
    }
}

/// The ASCII replacement of a character.
pub fn transliterated(character: char) -> &'static str {
    match character {
        'ä' | 'æ' => "ae",
        'ö' | 'œ' => "oe",
        'ü' => "ue",
        'Ä' | 'Æ' => "Ae",
        'Ö' | 'Œ' => "Oe",
        'Ü' => "Ue",
        'ß' => "ss",
        'à' | 'á' | 'â' | 'ã' | 'å' => "a",
        'è' | 'é' | 'ê' | 'ë' => "e",
        'ì' | 'í' | 'î' | 'ï' => "i",
        'ò' | 'ó' | 'ô' | 'õ' | 'ø' => "o",
        'ù' | 'ú' | 'û' | 'µ' | 'μ' => "u",
        'À' | 'Á' | 'Â' | 'Ã' | 'Å' => "A",
        'È' | 'É' | 'Ê' | 'Ë' => "E",
        'Ì' | 'Í' | 'Î' | 'Ï' => "I",
        'Ò' | 'Ó' | 'Ô' | 'Õ' | 'Ø' => "O",
        'Ù' | 'Ú' | 'Û' => "U",
        'ç' => "c",
        'Ç' => "C",
        'ñ' => "n",
        'Ñ' => "N",
        '°' => "deg",
        '±' => "+-",
        '⌀' => "D",
        '×' => "x",
        '–' | '—' => "-",
        '\u{a0}' => " ",
        _ => "?",
    }
}
