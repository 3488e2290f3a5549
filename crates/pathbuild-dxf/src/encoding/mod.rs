//! Decodes strings. (book: reference/dxf: "encoding")
//!
//! Strings are decoded one by one, never the file as a whole: in double-byte code pages, a byte of a character may look like a backslash
//! but never like a line end. ASCII, which nearly all strings are, is borrowed.

mod code_page;
mod escapes;

use std::borrow::Cow;

use oem_cp::code_table_type::TableType;
use pathbuild_diagnostic::messages::reading::{UNDECODABLE, UNKNOWN_CODE_PAGE};
use pathbuild_diagnostic::{Diagnostic, TextFault};
use pathbuild_encoding::{Encoding, UTF_8, WINDOWS_1252, decode_latin1};

use crate::faults::shown;
use crate::header::Header;
use code_page::{CodePage, code_page};
pub(crate) use escapes::{control, without_carets};

/// Decodes the strings of one file.
#[derive(Debug)]
pub(crate) struct Decoder<'a> {
    charset: Charset<'a>,
    /// The name of the encoding in PB008.
    name: Cow<'a, str>,
    doubt: Option<Diagnostic>,
}

#[derive(Clone, Copy, Debug)]
enum Charset<'a> {
    Standard(&'static Encoding),
    Dos(&'static TableType),
    /// UTF-8 if the whole file is valid UTF-8, else `ANSI_1252`. Decided at the first byte that is not ASCII.
    Either(&'a [u8]),
    /// Declared, but unknown.
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
            CodePage::Standard(encoding) => (Charset::Standard(encoding), shown(declared).into()),
            CodePage::Dos(page) => (Charset::Dos(page), shown(declared).into()),
            CodePage::Unknown => (Charset::Unknown, shown(declared).into()),
        };
        Self { charset, name, doubt: None }
    }

    /// Decodes a string that starts on this line. Undecodable bytes become U+FFFD and one PB008 per file.
    #[inline]
    pub(crate) fn decode<'b>(&mut self, bytes: &'b [u8], line: u32) -> Cow<'b, str> {
        // ASCII is valid Latin-1, which is borrowed and recognised faster than UTF-8.
        if is_plain(bytes) { decode_latin1(bytes) } else { self.decode_others(bytes, line) }
    }

    /// Decodes to UTF-8 bytes.
    pub(crate) fn decode_bytes<'b>(&mut self, bytes: &'b [u8], line: u32) -> Cow<'b, [u8]> {
        if is_plain(bytes) {
            return bytes.into();
        }
        Cow::Owned(self.decode_others(bytes, line).into_owned().into_bytes())
    }

    /// Returns PB008 if any string was doubtful.
    pub(crate) fn into_doubt(self) -> Option<Diagnostic> {
        self.doubt
    }

    fn decode_others<'b>(&mut self, bytes: &'b [u8], line: u32) -> Cow<'b, str> {
        let ascii = std::str::from_utf8(bytes).ok().filter(|_| bytes.is_ascii());
        let (text, bytes_known) = match ascii {
            Some(ascii) => (Cow::Borrowed(ascii), true),
            None => self.decode_beyond_ascii(bytes),
        };
        let (text, escapes_known) = escapes::unescape(text);
        if !(bytes_known && escapes_known) {
            self.doubt.get_or_insert_with(|| doubt(self.charset, &self.name, &text, line));
        }
        text
    }

    fn decode_beyond_ascii<'b>(&mut self, bytes: &'b [u8]) -> (Cow<'b, str>, bool) {
        match self.charset {
            Charset::Standard(encoding) => standard(encoding, bytes),
            Charset::Dos(page) => dos(page, bytes),
            Charset::Unknown => (standard(WINDOWS_1252, bytes).0, false),
            Charset::Either(file) => {
                // If a single string is not UTF-8, the file is not; testing the string first is cheaper.
                let is_utf8 = [bytes, file].into_iter().all(|text| std::str::from_utf8(text).is_ok());
                let encoding = if is_utf8 { UTF_8 } else { WINDOWS_1252 };
                self.charset = Charset::Standard(encoding);
                standard(encoding, bytes)
            }
        }
    }
}

/// Whether a string needs no decoding: ASCII without a backslash.
#[inline]
pub(crate) fn is_plain(bytes: &[u8]) -> bool {
    match (bytes.first_chunk(), bytes.last_chunk()) {
        (Some(first), Some(last)) if bytes.len() <= 16 => !(has_other(*first) || has_other(*last)),
        _ => bytes.iter().all(|byte| byte.is_ascii() && *byte != b'\\'),
    }
}

/// Whether any of these characters is a backslash or not ASCII.
#[inline]
fn has_other(characters: [u8; 8]) -> bool {
    const ONES: u64 = u64::from_le_bytes([1; 8]);
    let word = u64::from_le_bytes(characters);
    let zero_where_backslash = word ^ (ONES * u64::from(b'\\'));
    // Among ASCII bytes, only a zero gets its top bit set by subtracting one.
    (word | zero_where_backslash.wrapping_sub(ONES)) & (ONES * 0x80) != 0
}

fn doubt(charset: Charset<'_>, encoding: &str, text: &str, line: u32) -> Diagnostic {
    let message = if matches!(charset, Charset::Unknown) { &UNKNOWN_CODE_PAGE } else { &UNDECODABLE };
    let fault = TextFault::new(text, 0..text.len());
    Diagnostic::new(message).quoting("encoding", encoding).at_line(line, None).with_text(fault)
}

fn standard<'b>(encoding: &'static Encoding, bytes: &'b [u8]) -> (Cow<'b, str>, bool) {
    let (text, had_errors) = encoding.decode_without_bom_handling(bytes);
    // The WHATWG Windows pages map bytes without a character to the control character of the same number.
    let has_holes = encoding.is_single_byte() && text.chars().any(|c| ('\u{80}'..='\u{9f}').contains(&c));
    (text, !had_errors && !has_holes)
}

fn dos<'b>(page: &TableType, bytes: &[u8]) -> (Cow<'b, str>, bool) {
    // Two pages map bytes without a character to the control character of the same number.
    let is_hole = |character: char| ('\u{80}'..='\u{9f}').contains(&character);
    let text = page.decode_string_lossy(bytes).replace(is_hole, "\u{fffd}");
    let is_known = !text.contains(char::REPLACEMENT_CHARACTER);
    (Cow::Owned(text), is_known)
}
