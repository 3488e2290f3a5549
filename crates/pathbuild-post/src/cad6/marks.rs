//! Placeholder characters in texts during evaluation: for the positions of variables, for bytes that are not valid UTF-8, and for texts
//! that must not be evaluated.
//!
//! They are private-use characters, which definitions must not contain.

/// Marks the position of a variable.
pub(super) const VARIABLE: char = '\u{10FF00}';
/// Marks the position of a variable that does not exist.
pub(super) const UNDEFINED: char = '\u{10FF01}';
/// First of the characters that stand for texts.
const FIRST_TEXT: u32 = 0x0010_0000;
/// Number of texts that can be distinguished.
pub(super) const MOST_TEXTS: usize = 0xFE00;
/// First of the 256 characters that stand for bytes.
const FIRST_BYTE: u32 = 0x0010_FE00;

/// Whether a character is one of these placeholders.
pub(super) fn is_private(c: char) -> bool {
    u32::from(c) >= FIRST_TEXT
}

/// The placeholder of a text.
pub(super) fn char_of_text(index: usize) -> char {
    let index = u32::try_from(index.min(MOST_TEXTS - 1)).unwrap_or(0);
    char::from_u32(FIRST_TEXT + index).unwrap_or(char::REPLACEMENT_CHARACTER)
}

/// Index of the text that a character stands for.
pub(super) fn text_of(c: char) -> Option<usize> {
    let index = usize::try_from(u32::from(c).checked_sub(FIRST_TEXT)?).ok()?;
    (index < MOST_TEXTS).then_some(index)
}

/// Whether a character marks the position of a variable.
pub(super) fn is_mark(c: char) -> bool {
    c == VARIABLE
}

/// The placeholder of a byte.
pub(super) fn char_of(byte: u8) -> char {
    char::from_u32(FIRST_BYTE + u32::from(byte)).unwrap_or(char::REPLACEMENT_CHARACTER)
}

/// The byte that a character stands for.
pub(super) fn byte_of(c: char) -> Option<u8> {
    u8::try_from(u32::from(c).checked_sub(FIRST_BYTE)?).ok()
}
