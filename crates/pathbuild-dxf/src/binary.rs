//! Binary DXF, rewritten as ASCII. (book: reference/dxf; 24 of 3306 files from the wild)
//!
//! Binary files are rare, so they get no reader of their own: pair by pair they become lines, which also gives each pair the line
//! number that diagnostics name it by. Numbers are written with as many digits as they need to be read back exactly. Only what comes
//! before the end of ENTITIES is rewritten, so that the text stays within a few times the size of the file.

use std::io::Write;

use memchr::{memchr, memmem};

/// What a binary file begins with.
const SENTINEL: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";

/// How much of a file's end is searched for its end mark.
const TAIL: usize = 4096;

/// The ASCII form of a binary file; `None` when it is none. Where the file is cut off or out of step, the text is as well.
pub(crate) fn to_ascii(file: &[u8]) -> Option<Vec<u8>> {
    let bytes = file.strip_prefix(SENTINEL)?;
    let mut rest = Values { bytes, codes: GroupCodes::of(bytes) };
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
        if section == Section::AfterEntities {
            if ends_with_eof(rest.bytes) {
                text.extend_from_slice(b"0\nEOF\n");
            }
            break;
        }
    }
    Some(text)
}

/// How many bytes a group code has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum GroupCodes {
    /// Up to R12: one, and two more after an FF.
    OneByte,
    /// Since R13.
    TwoBytes,
}

/// What is left of the file.
struct Values<'a> {
    bytes: &'a [u8],
    codes: GroupCodes,
}

/// Where in the file a pair is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Section {
    Other,
    /// `0/SECTION` was the last pair.
    Begun,
    Entities,
    AfterEntities,
}

impl GroupCodes {
    /// By the first pair, which is `0/SECTION` or a remark (999).
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

impl Values<'_> {
    /// The next group code.
    fn code(&mut self) -> Option<i16> {
        if self.codes == GroupCodes::TwoBytes {
            return self.take().map(i16::from_le_bytes);
        }
        match self.take()? {
            [0xFF] => self.take().map(i16::from_le_bytes),
            [code] => Some(i16::from(code)),
        }
    }

    /// Writes the value of a group. A code of unknown type is written so that the reader finds no code there.
    fn value(&mut self, code: i16, text: &mut Vec<u8>) -> Option<()> {
        match value_type(code) {
            Type::String => self.string(text)?,
            Type::Double => _ = write!(text, "{:?}", f64::from_le_bytes(self.take()?)),
            Type::Short => _ = write!(text, "{}", i16::from_le_bytes(self.take()?)),
            Type::Long => _ = write!(text, "{}", i32::from_le_bytes(self.take()?)),
            Type::LongLong => _ = write!(text, "{}", i64::from_le_bytes(self.take()?)),
            Type::Byte => _ = write!(text, "{}", u8::from_le_bytes(self.take()?)),
            Type::Chunk => {
                let [length] = self.take()?;
                self.bytes = self.bytes.get(usize::from(length)..)?;
            }
            Type::Unknown => {
                self.bytes = &[];
                _ = write!(text, "\ngroup of unknown type before this");
            }
        }
        Some(())
    }

    /// A string up to its NUL. Line ends in it are written as a CAD writes them in ASCII files.
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

/// How a value is stored.
#[derive(Clone, Copy, Debug)]
enum Type {
    String,
    Double,
    Byte,
    Short,
    Long,
    LongLong,
    /// Bytes after their number.
    Chunk,
    Unknown,
}

fn value_type(code: i16) -> Type {
    match code {
        310..=319 | 1004 => Type::Chunk,
        0..=9 | 100..=109 | 300..=369 | 390..=399 | 410..=419 | 430..=439 | 470..=489 | 999..=1009 => {
            Type::String
        }
        10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => Type::Double,
        60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => Type::Short,
        90..=99 | 420..=429 | 440..=459 | 1071 => Type::Long,
        160..=169 => Type::LongLong,
        290..=299 => Type::Byte,
        _ => Type::Unknown,
    }
}

/// Whether `0/EOF` is at the end, whatever short padding follows it.
fn ends_with_eof(rest: &[u8]) -> bool {
    let tail = &rest[rest.len().saturating_sub(TAIL)..];
    memmem::find(tail, b"\0EOF\0").is_some()
}
