//! Pairs as ASCII and binary DXF, in the encoding of the version.

use encoding_rs::{Encoding, UTF_8, WINDOWS_1252};
use pathbuild_draw::pairs::{self, Pair};

use super::model::{LineEnds, Options, TextEncoding, Version};

/// Writes ASCII DXF.
pub(crate) fn ascii(pairs: &[Pair<'_>], options: &Options) -> Vec<u8> {
    let line_end: &[u8] = match options.line_ends {
        LineEnds::CrLf => b"\r\n",
        LineEnds::Lf => b"\n",
        LineEnds::Cr => b"\r",
    };
    let mut bytes = if options.byte_order_mark { b"\xef\xbb\xbf".to_vec() } else { Vec::new() };
    bytes.extend(pairs::ascii(pairs, encoding(options), line_end));
    bytes
}

/// Writes binary DXF. A malformed number is written as 0, since the format cannot represent it.
pub(crate) fn binary(pairs: &[Pair<'_>], options: &Options) -> Vec<u8> {
    let encoding = encoding(options);
    let mut bytes = b"AutoCAD Binary DXF\r\n\x1a\0".to_vec();
    for pair in pairs {
        let code = u16::try_from(pair.code).unwrap_or_default();
        match u8::try_from(code) {
            _ if options.version >= Version::R13 => bytes.extend(code.to_le_bytes()),
            Ok(short) if short < 255 => bytes.push(short),
            _ => {
                bytes.push(255);
                bytes.extend(code.to_le_bytes());
            }
        }
        append_value(pair, encoding, options.version, &mut bytes);
    }
    bytes
}

/// Appends a value in the type that the DXF reference gives for its group code.
fn append_value(pair: &Pair<'_>, encoding: Option<&'static Encoding>, version: Version, bytes: &mut Vec<u8>) {
    let value = pair.value.trim();
    match pair.code {
        10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => {
            bytes.extend(value.parse::<f64>().unwrap_or_default().to_le_bytes());
        }
        290..=299 if version >= Version::R13 => bytes.push(value.parse().unwrap_or_default()),
        60..=79 | 170..=179 | 270..=299 | 370..=389 | 400..=409 | 1060..=1070 => {
            bytes.extend(value.parse::<i16>().unwrap_or_default().to_le_bytes());
        }
        90..=99 | 420..=429 | 440..=459 | 1071 => {
            bytes.extend(value.parse::<i32>().unwrap_or_default().to_le_bytes());
        }
        160..=169 => bytes.extend(value.parse::<i64>().unwrap_or_default().to_le_bytes()),
        310..=319 | 1004 => append_chunk(value, bytes),
        _ => {
            pairs::encode(&pair.value, encoding, bytes);
            bytes.push(0);
        }
    }
}

fn append_chunk(hex: &str, bytes: &mut Vec<u8>) {
    let digits: Vec<u32> = hex.chars().filter_map(|c| c.to_digit(16)).collect();
    let chunk: Vec<u8> =
        digits.chunks_exact(2).filter_map(|two| u8::try_from(two[0] * 16 + two[1]).ok()).take(255).collect();
    bytes.extend(u8::try_from(chunk.len()));
    bytes.extend(chunk);
}

/// The encoding of a sheet's strings; `None` for ASCII only.
pub(crate) fn encoding(options: &Options) -> Option<&'static Encoding> {
    match options.encoding {
        // A byte order mark implies UTF-8 for the whole file.
        TextEncoding::Proper if options.version >= Version::R2007 || options.byte_order_mark => Some(UTF_8),
        TextEncoding::Proper => code_page(options.code_page.as_deref().unwrap_or("ANSI_1252")),
        TextEncoding::Utf8 => Some(UTF_8),
        TextEncoding::Escaped => None,
    }
}

/// The encoding for a value of $DWGCODEPAGE. `None` if it is unknown: ASCII with escapes is correct in any encoding.
fn code_page(name: &str) -> Option<&'static Encoding> {
    let lower = name.to_ascii_lowercase();
    let number = lower.strip_prefix("ansi_").or_else(|| lower.strip_prefix("dos"));
    let label = match number {
        Some("932") => "shift_jis".to_owned(),
        Some("936") => "gbk".to_owned(),
        Some("949") => "euc-kr".to_owned(),
        Some("950") => "big5".to_owned(),
        Some("874") => "windows-874".to_owned(),
        Some("866") => "ibm866".to_owned(),
        Some(number) if lower.starts_with("ansi_") => format!("windows-{number}"),
        _ => return (lower == "ascii" || lower == "undefined").then_some(WINDOWS_1252),
    };
    Encoding::for_label(label.as_bytes())
}
