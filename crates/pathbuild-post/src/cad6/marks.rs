//! Characters inside texts that are being worked out: where a variable stood, bytes that are no characters, and texts that are never read
//! again.
//!
//! They are private-use characters, which a definition must not contain itself.

/// A variable stood here.
pub(super) const VARIABLE: char = '\u{10FF00}';
/// A variable stood here that does not exist.
pub(super) const UNDEFINED: char = '\u{10FF01}';
/// The first of the characters that stand for texts.
const FIRST_TEXT: u32 = 0x0010_0000;
/// So many texts are told apart.
pub(super) const MOST_TEXTS: usize = 0xFE00;
/// The first of 256 characters, one for each byte.
const FIRST_BYTE: u32 = 0x0010_FE00;

/// Whether a character means one of these things.
pub(super) fn is_private(c: char) -> bool {
    u32::from(c) >= FIRST_TEXT
}

/// The character that stands for a text.
pub(super) fn char_of_text(index: usize) -> char {
    let index = u32::try_from(index.min(MOST_TEXTS - 1)).unwrap_or(0);
    char::from_u32(FIRST_TEXT + index).unwrap_or(char::REPLACEMENT_CHARACTER)
}

/// The text that a character stands for.
pub(super) fn text_of(c: char) -> Option<usize> {
    let index = usize::try_from(u32::from(c).checked_sub(FIRST_TEXT)?).ok()?;
    (index < MOST_TEXTS).then_some(index)
}

/// Whether a character says where a variable stood.
pub(super) fn is_mark(c: char) -> bool {
    c == VARIABLE
}

/// The character that stands for a byte.
pub(super) fn char_of(byte: u8) -> char {
    char::from_u32(FIRST_BYTE + u32::from(byte)).unwrap_or(char::REPLACEMENT_CHARACTER)
}

/// The byte that a character stands for.
pub(super) fn byte_of(c: char) -> Option<u8> {
    u8::try_from(u32::from(c).checked_sub(FIRST_BYTE)?).ok()
}
