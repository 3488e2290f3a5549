//! Converts binary DXF to ASCII. (book: reference/dxf; 24 of 3306 files from the wild)
//!
//! Binary files are too rare for a reader of their own. Each pair is rewritten as two lines, which also gives it the line number that
//! diagnostics refer to. Numbers are written with enough digits to be read back exactly. Conversion stops at the end of ENTITIES unless a
//! clipping boundary follows, so the text stays within a few times the size of the file.

use std::io::Write;

use memchr::{memchr, memmem};

/// The first bytes of a binary file.
const SENTINEL: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";

/// The object with the clipping boundary of an insertion.
const FILTER: &[u8] = b"SPATIAL_FILTER";

/// Number of bytes at the end of a file that are searched for the end mark.
const SEARCHED_BYTES: usize = 4096;

/// Returns the ASCII form of a binary file, or `None` if the file is not binary. A truncated or misaligned file gives truncated or
/// misaligned text.
pub(crate) fn to_ascii(file: &[u8]) -> Option<Vec<u8>> {
    let bytes = file.strip_prefix(SENTINEL)?;
    let mut rest = BinaryGroups { bytes, codes: GroupCodeSize::of(bytes) };
    let mut text = Vec::with_capacity(bytes.len() * 2);
    let mut section = Section::Other;
    while let Some(code) = rest.code() {
        let start = text.len();
        _ = writeln!(text, "{code}");
        let value = text.len();
        if rest.value(code, &mut text).is_none() {
            text.truncate(start);
            break;
        }
        section = section.after(code, &text[value..]);
        text.push(b'\n');
        if section == Section::AfterEntities && memmem::find(rest.bytes, FILTER).is_none() {
            if ends_with_eof(rest.bytes) {
                text.extend_from_slice(b"0\nEOF\n");
            }
            break;
        }
    }
    Some(text)
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum GroupCodeSize {
    /// Up to R12: one byte, or FF and two bytes.
    OneByte,
    /// Since R13: two bytes.
    TwoBytes,
}

/// The unread rest of the file.
struct BinaryGroups<'a> {
    bytes: &'a [u8],
    codes: GroupCodeSize,
}

/// The section that has been reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Section {
    Other,
    /// The last pair, apart from comments, was `0/SECTION`.
    Begun,
    Entities,
    AfterEntities,
}

impl GroupCodeSize {
    /// Detects the size from the first pair, which is `0/SECTION` or a comment (999).
    fn of(bytes: &[u8]) -> Self {
        match bytes {
            [0, 0, ..] | [0xE7, 0x03, ..] => Self::TwoBytes,
            _ => Self::OneByte,
        }
    }
}

impl Section {
    fn after(self, code: i16, value: &[u8]) -> Self {
        match (self, code, value) {
            (_, 0, b"SECTION") | (Self::Begun, 999, _) => Self::Begun,
            (Self::Begun, 2, b"ENTITIES") => Self::Entities,
            (Self::Entities, 0, b"ENDSEC") => Self::AfterEntities,
            (Self::Begun, ..) => Self::Other,
            (other, ..) => other,
        }
    }
}

impl BinaryGroups<'_> {
    fn code(&mut self) -> Option<i16> {
        if self.codes == GroupCodeSize::TwoBytes {
            return self.take().map(i16::from_le_bytes);
        }
        match self.take()? {
            [0xFF] => self.take().map(i16::from_le_bytes),
            [code] => Some(i16::from(code)),
        }
    }

    /// Writes the value of a group; `None` if the file ends within it. A group of unknown type ends the conversion with a line that the reader
    /// rejects as a group code.
    fn value(&mut self, code: i16, text: &mut Vec<u8>) -> Option<()> {
        match value_type(code) {
            ValueType::String => self.string(text)?,
            ValueType::Double => _ = write!(text, "{:?}", f64::from_le_bytes(self.take()?)),
            ValueType::Short => _ = write!(text, "{}", i16::from_le_bytes(self.take()?)),
            ValueType::Long => _ = write!(text, "{}", i32::from_le_bytes(self.take()?)),
            ValueType::LongLong => _ = write!(text, "{}", i64::from_le_bytes(self.take()?)),
            ValueType::Byte => _ = write!(text, "{}", u8::from_le_bytes(self.take()?)),
            ValueType::Chunk => {
                let [length] = self.take()?;
                self.bytes = self.bytes.get(usize::from(length)..)?;
            }
            ValueType::Unknown => {
                self.bytes = &[];
                _ = write!(text, "\ngroup of unknown type before this");
            }
        }
        Some(())
    }

    /// Copies a string up to its NUL. Line ends inside it are escaped as CAD programs do in ASCII files.
    fn string(&mut self, text: &mut Vec<u8>) -> Option<()> {
        let length = memchr(0, self.bytes)?;
        for byte in &self.bytes[..length] {
            match byte {
                b'\n' => text.extend_from_slice(b"^J"),
                b'\r' => text.extend_from_slice(b"^M"),
                _ => text.push(*byte),
            }
        }
        self.bytes = &self.bytes[length + 1..];
        Some(())
    }

    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (taken, rest) = self.bytes.split_first_chunk()?;
        self.bytes = rest;
        Some(*taken)
    }
}

#[derive(Clone, Copy, Debug)]
enum ValueType {
    String,
    Double,
    Byte,
    Short,
    Long,
    LongLong,
    /// Bytes preceded by their count. The reader needs none of them, so they become an empty value.
    Chunk,
    Unknown,
}

fn value_type(code: i16) -> ValueType {
    match code {
        310..=319 | 1004 => ValueType::Chunk,
        0..=9 | 100..=109 | 300..=369 | 390..=399 | 410..=419 | 430..=439 | 470..=489 | 999..=1009 => {
            ValueType::String
        }
        10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => ValueType::Double,
        60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => ValueType::Short,
        90..=99 | 420..=429 | 440..=459 | 1071 => ValueType::Long,
        160..=169 => ValueType::LongLong,
        290..=299 => ValueType::Byte,
        _ => ValueType::Unknown,
    }
}

/// Whether a value `EOF` occurs near the end of the file. A short padding may follow it.
fn ends_with_eof(rest: &[u8]) -> bool {
    let tail = &rest[rest.len().saturating_sub(SEARCHED_BYTES)..];
    memmem::find(tail, b"\0EOF\0").is_some()
}
