//! Decodes the bytes of a file as text for the user.

use std::borrow::Cow;

use pathbuild_diagnostic::{Diagnostic, TextFault};

use super::block::Span;

/// Maximum number of bytes of a line shown on either side of an error.
const SHOWN: usize = 160;

/// Decodes UTF-8, or else Windows-1252.
pub(crate) fn decode(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => pathbuild_encoding::WINDOWS_1252.decode_without_bom_handling(bytes).0,
    }
}

/// The column of a byte, in characters counted from 1.
pub(crate) fn column(line: &[u8], byte: usize) -> u32 {
    let before = decode(&line[..byte.min(line.len())]).chars().count();
    u32::try_from(before + 1).unwrap_or(u32::MAX)
}

/// The line with its faulty part marked. Of a long line only the surroundings are kept.
pub(crate) fn fault(line: &[u8], span: Span) -> TextFault {
    let start = (span.start as usize).min(line.len());
    let end = (span.end as usize).clamp(start, line.len()).min(start + SHOWN);
    let before = shown_before(&line[..start]);
    let marked = decode(&line[start..end]);
    let after = shown_after(&line[end..]);
    TextFault::new(&format!("{before}{marked}{after}"), before.len()..before.len() + marked.len())
}

fn shown_before(bytes: &[u8]) -> Cow<'_, str> {
    if bytes.len() <= SHOWN {
        return decode(bytes);
    }
    let cut = (bytes.len() - SHOWN..bytes.len()).find(|&at| bytes[at] & 0xC0 != 0x80).unwrap_or(bytes.len());
    format!("...{}", decode(&bytes[cut..])).into()
}

fn shown_after(bytes: &[u8]) -> Cow<'_, str> {
    if bytes.len() <= SHOWN {
        return decode(bytes);
    }
    let cut = (0..SHOWN).rev().find(|&at| bytes[at] & 0xC0 != 0x80).unwrap_or(0);
    format!("{}...", decode(&bytes[..cut])).into()
}

/// Adds the text of the line to diagnostics that only have its number.
pub fn quote<'d>(diagnostics: impl IntoIterator<Item = &'d mut Diagnostic>, file: &[u8]) {
    let is_bare = |one: &&mut Diagnostic| one.text.is_none() && one.place.line.is_some();
    let mut bare: Vec<&mut Diagnostic> = diagnostics.into_iter().filter(is_bare).collect();
    bare.sort_by_key(|one| one.place.line);
    let end_of_line = end_of_line(file);
    let mut lines = (1_u32..).zip(file.split(|byte| *byte == end_of_line)).peekable();
    for diagnostic in bare {
        let wanted = diagnostic.place.line.unwrap_or(0);
        while lines.next_if(|(number, _)| *number < wanted).is_some() {}
        if let Some((_, line)) = lines.peek().filter(|(number, _)| *number == wanted) {
            let line = line.trim_ascii_end();
            diagnostic.text = Some(fault(line, Span::new(0, line.len())));
            diagnostic.place.column.get_or_insert(1);
        }
    }
}

/// The character that ends the lines of a file: LF, or CR in files that contain only CR.
pub(super) fn end_of_line(file: &[u8]) -> u8 {
    if memchr::memchr(b'\n', file).is_none() { b'\r' } else { b'\n' }
}
