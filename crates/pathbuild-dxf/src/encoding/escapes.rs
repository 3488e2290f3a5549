//! Escapes for characters outside the file's code page: `\U+XXXX` and `\M+nXXXX` in all strings of all versions, `^I` and similar codes in
//! texts.

use std::borrow::Cow;

use memchr::memchr_iter;
use pathbuild_encoding::{BIG5, EUC_KR, Encoding, GBK, SHIFT_JIS};

/// Replaces an escape that is no character.
const REPLACEMENT: char = char::REPLACEMENT_CHARACTER;

/// Decodes all escapes. The flag tells whether all of them were characters; the others become U+FFFD.
pub(super) fn unescape(text: Cow<'_, str>) -> (Cow<'_, str>, bool) {
    let bytes = text.as_bytes();
    if !memchr_iter(b'\\', bytes).any(|at| matches!(bytes[at..], [_, b'U' | b'M', b'+', ..])) {
        return (text, true);
    }
    let mut decoded = String::with_capacity(text.len());
    let mut all_known = true;
    let mut rest = &*text;
    while let Some(backslash) = rest.find('\\') {
        decoded.push_str(&rest[..backslash]);
        rest = &rest[backslash..];
        let (character, length) = escape(rest).unwrap_or((Some('\\'), 1));
        all_known &= character.is_some();
        decoded.push(character.unwrap_or(REPLACEMENT));
        rest = &rest[length..];
    }
    decoded.push_str(rest);
    (Cow::Owned(decoded), all_known)
}

/// The character and the length of the escape at the start of `text`. The inner `None` is an escape that is no character.
fn escape(text: &str) -> Option<(Option<char>, usize)> {
    unicode(text).or_else(|| multibyte(text))
}

/// `\U+XXXX`, or two of them that form a surrogate pair.
fn unicode(text: &str) -> Option<(Option<char>, usize)> {
    const LENGTH: usize = 7;
    let unit = utf16_unit(text)?;
    let next = utf16_unit(&text[LENGTH..]);
    let both = next.map(|next| char::decode_utf16([unit, next]));
    if let Some(Some(Ok(character))) =
        both.map(|mut both| both.next()).filter(|_| (0xD800..0xDC00).contains(&unit))
    {
        return Some((Some(character), 2 * LENGTH));
    }
    Some((char::from_u32(u32::from(unit)), LENGTH))
}

fn utf16_unit(text: &str) -> Option<u16> {
    hexadecimal(text.strip_prefix("\\U+")?.get(..4)?)
}

/// `\M+nXXXX`: two bytes in the code page n.
fn multibyte(text: &str) -> Option<(Option<char>, usize)> {
    let rest = text.strip_prefix("\\M+")?;
    let page = rest.bytes().next().filter(|digit| (b'1'..=b'5').contains(digit))?;
    let bytes = hexadecimal(rest.get(1..5)?)?.to_be_bytes();
    let bytes = if bytes[0] == 0 { &bytes[1..] } else { &bytes[..] };
    let decoded = multibyte_encoding(page)
        .and_then(|encoding| encoding.decode_without_bom_handling_and_without_replacement(bytes));
    Some((decoded.and_then(|text| text.chars().next()), 8))
}

/// The encoding for a digit of `\M+`. The fourth, Johab, is unsupported because no drawing uses it.
fn multibyte_encoding(digit: u8) -> Option<&'static Encoding> {
    match digit {
        b'1' => Some(SHIFT_JIS),
        b'2' => Some(BIG5),
        b'3' => Some(EUC_KR),
        b'5' => Some(GBK),
        _ => None,
    }
}

fn hexadecimal(digits: &str) -> Option<u16> {
    let all_digits = digits.bytes().all(|byte| byte.is_ascii_hexdigit());
    u16::from_str_radix(digits, 16).ok().filter(|_| all_digits)
}

/// Decodes the caret codes of a one-line text: `^I` is a tab, `^J` and `^M^J` a line feed, `^ ` a caret. Others stay as they are.
pub(crate) fn without_carets(text: Cow<'_, str>) -> Cow<'_, str> {
    if !text.contains('^') {
        return text;
    }
    let replaced = text.replace("^M^J", "\n");
    let mut decoded = String::with_capacity(replaced.len());
    let mut rest = &*replaced;
    while let Some(caret) = rest.find('^') {
        decoded.push_str(&rest[..caret]);
        let (character, length) = control(&rest[caret..]).unwrap_or(('^', 1));
        decoded.push(character);
        rest = &rest[caret + length..];
    }
    decoded.push_str(rest);
    Cow::Owned(decoded)
}

/// The character and length of the caret code at the start of `text`.
pub(crate) fn control(text: &str) -> Option<(char, usize)> {
    let mut characters = text.chars();
    characters.next().filter(|first| *first == '^')?;
    let character = match characters.next()? {
        ' ' => '^',
        'I' => '\t',
        'J' | 'M' => '\n',
        _ => return None,
    };
    Some((character, 2))
}
