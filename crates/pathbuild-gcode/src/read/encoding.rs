//! Signs of the encoding in which an editor saved a program.

/// The bytes that some editors write before UTF-8.
pub const BYTE_ORDER_MARK: &[u8] = b"\xEF\xBB\xBF";

/// Whether a text is in UTF-16: with a byte order mark, or beginning with two ASCII characters.
pub fn is_utf_16(text: &[u8]) -> bool {
    match text {
        [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] => true,
        [first, 0, second, 0, ..] | [0, first, 0, second, ..] => {
            [first, second].into_iter().all(|byte| byte.is_ascii_graphic() || byte.is_ascii_whitespace())
        }
        _ => false,
    }
}
