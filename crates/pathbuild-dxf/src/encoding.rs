//! Decodes strings. (book: reference/dxf: "encoding")
//!
//! Strings are decoded one by one, after the file has been split into lines: in double-byte code pages, a byte of a character may look like
//! a backslash, but never like a line end. ASCII, which nearly all strings are, is borrowed.

use std::borrow::Cow;

use memchr::memchr_iter;
use oem_cp::code_table::DECODING_TABLE_CP_MAP;
use oem_cp::code_table_type::TableType;
use pathbuild_diagnostic::messages::drawing::{INVALID_UTF8, UNDECODABLE, UNKNOWN_CODE_PAGE};
use pathbuild_diagnostic::{Diagnostic, TextFault};
use pathbuild_encoding::{
    BIG5, EUC_KR, Encoding, GBK, IBM866, ISO_8859_2, ISO_8859_3, ISO_8859_4, ISO_8859_5, ISO_8859_6,
    ISO_8859_7, ISO_8859_8, MACINTOSH, SHIFT_JIS, UTF_8, WINDOWS_874, WINDOWS_1250, WINDOWS_1251,
    WINDOWS_1252, WINDOWS_1253, WINDOWS_1254, WINDOWS_1255, WINDOWS_1256, WINDOWS_1257, WINDOWS_1258,
    decode_latin1,
};

use crate::faults::value_excerpt;
use crate::header::Header;

#[derive(Debug)]
pub(crate) struct Decoder<'a> {
    charset: Charset<'a>,
    /// The name of the encoding, for PB008.
    name: Cow<'a, str>,
    doubt: Option<Diagnostic>,
}

#[derive(Clone, Copy, Debug)]
enum Charset<'a> {
    Standard(&'static Encoding),
    Dos(&'static TableType),
    /// UTF-8 if the whole file is valid UTF-8, else `ANSI_1252`. Decided at the first byte that is not ASCII.
    Either(&'a [u8]),
    /// The declared encoding is unknown.
    Unknown,
}

impl<'a> Decoder<'a> {
    /// Chooses the encoding of `file` by its header. A byte order mark means UTF-8.
    pub(crate) fn new(file: &'a [u8], header: &Header<'_>, has_bom: bool) -> Self {
        let declared = header.code_page().unwrap_or_default();
        let is_utf8 = header.is_unicode() || has_bom;
        let (charset, name) = match code_page(declared) {
            _ if is_utf8 => (Charset::Standard(UTF_8), Cow::Borrowed("UTF-8")),
            CodePage::Usual => (Charset::Either(file), Cow::Borrowed("ANSI_1252")),
            CodePage::Standard(encoding) => (Charset::Standard(encoding), value_excerpt(declared).into()),
            CodePage::Dos(page) => (Charset::Dos(page), value_excerpt(declared).into()),
            CodePage::Unknown => (Charset::Unknown, value_excerpt(declared).into()),
        };
        Self { charset, name, doubt: None }
    }

    /// Decodes a string that starts on this line. Undecodable bytes become U+FFFD and one PB008 per file.
    #[inline]
    pub(crate) fn decode<'b>(&mut self, bytes: &'b [u8], line: u32) -> Cow<'b, str> {
        // ASCII is also valid Latin-1, which is checked and borrowed faster than UTF-8.
        if is_plain(bytes) { decode_latin1(bytes) } else { self.decode_others(bytes, line) }
    }

    /// Decodes a string that starts on this line to UTF-8 bytes.
    pub(crate) fn decode_bytes<'b>(&mut self, bytes: &'b [u8], line: u32) -> Cow<'b, [u8]> {
        if is_plain(bytes) {
            return bytes.into();
        }
        Cow::Owned(self.decode_others(bytes, line).into_owned().into_bytes())
    }

    /// Returns PB008 for the first string that could not be decoded with certainty, if there was one.
    pub(crate) fn into_decoding_warning(self) -> Option<Diagnostic> {
        self.doubt
    }

    fn decode_others<'b>(&mut self, bytes: &'b [u8], line: u32) -> Cow<'b, str> {
        let ascii = std::str::from_utf8(bytes).ok().filter(|_| bytes.is_ascii());
        let (text, bytes_known) = match ascii {
            Some(ascii) => (Cow::Borrowed(ascii), true),
            None => self.decode_beyond_ascii(bytes),
        };
        let (text, escapes_known) = unescape(text);
        if !(bytes_known && escapes_known) {
            self.doubt.get_or_insert_with(|| decoding_warning(self.charset, &self.name, &text, line));
        }
        text
    }

    fn decode_beyond_ascii<'b>(&mut self, bytes: &'b [u8]) -> (Cow<'b, str>, bool) {
        match self.charset {
            Charset::Standard(encoding) => decode_standard(encoding, bytes),
            Charset::Dos(page) => decode_dos(page, bytes),
            Charset::Unknown => (decode_standard(WINDOWS_1252, bytes).0, false),
            Charset::Either(file) => {
                // If a single string is not UTF-8, neither is the file; testing the string first is cheaper.
                let is_utf8 = [bytes, file].into_iter().all(|text| std::str::from_utf8(text).is_ok());
                let encoding = if is_utf8 { UTF_8 } else { WINDOWS_1252 };
                self.charset = Charset::Standard(encoding);
                decode_standard(encoding, bytes)
            }
        }
    }
}

/// Whether a string needs no decoding: ASCII without a backslash.
fn is_plain(bytes: &[u8]) -> bool {
    bytes.iter().all(|byte| byte.is_ascii() && *byte != b'\\')
}

fn decoding_warning(charset: Charset<'_>, encoding: &str, text: &str, line: u32) -> Diagnostic {
    let message = match charset {
        Charset::Unknown => &UNKNOWN_CODE_PAGE,
        _ if encoding == "UTF-8" => &INVALID_UTF8,
        _ => &UNDECODABLE,
    };
    let fault = TextFault::new(text, 0..text.len());
    Diagnostic::new(message).quoting("encoding", encoding).at_line(line, None).with_text(fault)
}

fn decode_standard<'b>(encoding: &'static Encoding, bytes: &'b [u8]) -> (Cow<'b, str>, bool) {
    let (text, had_errors) = encoding.decode_without_bom_handling(bytes);
    // The WHATWG Windows pages map bytes without a character to the control character of the same number.
    let has_holes = encoding.is_single_byte() && text.chars().any(|c| ('\u{80}'..='\u{9f}').contains(&c));
    (text, !had_errors && !has_holes)
}

fn decode_dos<'b>(page: &TableType, bytes: &[u8]) -> (Cow<'b, str>, bool) {
    // Two pages map bytes without a character to the control character of the same number.
    let is_hole = |character: char| ('\u{80}'..='\u{9f}').contains(&character);
    let text = page.decode_string_lossy(bytes).replace(is_hole, "\u{fffd}");
    let is_known = !text.contains(char::REPLACEMENT_CHARACTER);
    (Cow::Owned(text), is_known)
}

/// Encoding declared for the texts of a file.
#[derive(Clone, Copy, Debug)]
pub(crate) enum CodePage {
    /// No declared encoding, or `ANSI_1252`, which many programs write regardless of the actual encoding.
    Usual,
    /// An encoding of the WHATWG standard.
    Standard(&'static Encoding),
    Dos(&'static TableType),
    /// An unknown name.
    Unknown,
}

/// Parses the value of `$DWGCODEPAGE`.
pub(crate) fn code_page(name: &[u8]) -> CodePage {
    if name == b"ANSI_1252" {
        return CodePage::Usual;
    }
    let name = String::from_utf8_lossy(name).trim().to_ascii_uppercase();
    match name.as_str() {
        "" | "ASCII" | "US_ASCII" | "UNDEFINED" => CodePage::Usual,
        "UTF-8" | "UTF8" => CodePage::Standard(UTF_8),
        "BIG5" => CodePage::Standard(BIG5),
        "GB2312" | "GBK" => CodePage::Standard(GBK),
        "KSC5601" => CodePage::Standard(EUC_KR),
        "SHIFT_JIS" => CodePage::Standard(SHIFT_JIS),
        name if name.starts_with("MAC") => CodePage::Standard(MACINTOSH),
        name => match (name.split_once("8859"), trailing_number(name)) {
            (Some(_), Some(part)) => iso_8859(part),
            (None, Some(page)) => code_page_by_number(page),
            (_, None) => CodePage::Unknown,
        },
    }
}

fn trailing_number(name: &str) -> Option<u32> {
    let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
    name[letters.len()..].parse().ok()
}

fn code_page_by_number(page: u32) -> CodePage {
    let encoding = match page {
        1252 => return CodePage::Usual,
        866 => IBM866,
        874 => WINDOWS_874,
        932 => SHIFT_JIS,
        936 => GBK,
        949 => EUC_KR,
        950 => BIG5,
        1250 => WINDOWS_1250,
        1251 => WINDOWS_1251,
        1253 => WINDOWS_1253,
        1254 => WINDOWS_1254,
        1255 => WINDOWS_1255,
        1256 => WINDOWS_1256,
        1257 => WINDOWS_1257,
        1258 => WINDOWS_1258,
        65001 => UTF_8,
        _ => {
            let page = u16::try_from(page).ok().and_then(|page| DECODING_TABLE_CP_MAP.get(&page));
            return page.map_or(CodePage::Unknown, CodePage::Dos);
        }
    };
    CodePage::Standard(encoding)
}

fn iso_8859(part: u32) -> CodePage {
    CodePage::Standard(match part {
        1 => WINDOWS_1252,
        2 => ISO_8859_2,
        3 => ISO_8859_3,
        4 => ISO_8859_4,
        5 => ISO_8859_5,
        6 => ISO_8859_6,
        7 => ISO_8859_7,
        8 => ISO_8859_8,
        9 => WINDOWS_1254,
        _ => return CodePage::Unknown,
    })
}

/// Replacement for an escape that does not denote a character.
const REPLACEMENT: char = char::REPLACEMENT_CHARACTER;

/// Decodes the escapes `\U+XXXX` and `\M+nXXXX`; those that denote no character become U+FFFD. Also returns whether all escapes denote a character.
fn unescape(text: Cow<'_, str>) -> (Cow<'_, str>, bool) {
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

/// Returns the character that the escape at the start of `text` denotes, and the length of the escape in bytes; the inner `None` means that it
/// denotes no character.
fn escape(text: &str) -> Option<(Option<char>, usize)> {
    unicode_escape(text).or_else(|| multibyte_escape(text))
}

/// Decodes `\U+XXXX`, or two of them that form a surrogate pair.
fn unicode_escape(text: &str) -> Option<(Option<char>, usize)> {
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

/// Decodes `\M+nXXXX`: two bytes in the code page n.
fn multibyte_escape(text: &str) -> Option<(Option<char>, usize)> {
    let rest = text.strip_prefix("\\M+")?;
    let page = rest.bytes().next().filter(|digit| (b'1'..=b'5').contains(digit))?;
    let bytes = hexadecimal(rest.get(1..5)?)?.to_be_bytes();
    let bytes = if bytes[0] == 0 { &bytes[1..] } else { &bytes[..] };
    let decoded = multibyte_encoding(page)
        .and_then(|encoding| encoding.decode_without_bom_handling_and_without_replacement(bytes));
    Some((decoded.and_then(|text| text.chars().next()), 8))
}

/// Returns the encoding for a digit of `\M+`. Digit 4, Johab, is unsupported because no drawing uses it.
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

/// Decodes the caret codes of a one-line text: `^I` is a tab, `^J`, `^M` and `^M^J` a line feed, `^ ` a caret. Others stay as they are.
pub(crate) fn without_carets(text: Cow<'_, str>) -> Cow<'_, str> {
    if !text.contains('^') {
        return text;
    }
    let replaced = text.replace("^M^J", "\n");
    let mut decoded = String::with_capacity(replaced.len());
    let mut rest = &*replaced;
    while let Some(caret) = rest.find('^') {
        decoded.push_str(&rest[..caret]);
        let (character, length) = caret_character(&rest[caret..]).unwrap_or(('^', 1));
        decoded.push(character);
        rest = &rest[caret + length..];
    }
    decoded.push_str(rest);
    Cow::Owned(decoded)
}

/// Returns the character that the caret code at the start of `text` stands for, and the length of the code in bytes.
pub(crate) fn caret_character(text: &str) -> Option<(char, usize)> {
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
