use super::encoding::Encoder;
use super::record::Pair;
use crate::model::{LineEnds, Options, Version};

/// Writes ASCII DXF: one line for the code, one for the value.
pub(crate) fn ascii(pairs: &[Pair<'_>], options: &Options) -> Vec<u8> {
    let encoder = Encoder::of(options);
    let line_end: &[u8] = match options.line_ends {
        LineEnds::CrLf => b"\r\n",
        LineEnds::Lf => b"\n",
        LineEnds::Cr => b"\r",
    };
    let mut bytes = Vec::with_capacity(pairs.len() * 16);
    if options.byte_order_mark {
        bytes.extend(b"\xef\xbb\xbf");
    }
    for pair in pairs {
        append_code(pair.code, &mut bytes);
        bytes.extend(line_end);
        encoder.append(&pair.value, &mut bytes);
        bytes.extend(line_end);
    }
    bytes
}

/// Appends a group code, right-aligned in three columns.
fn append_code(code: i32, bytes: &mut Vec<u8>) {
    match u8::try_from(code) {
        Ok(short @ ..10) => bytes.extend([b' ', b' ', b'0' + short]),
        Ok(short @ 10..100) => bytes.extend([b' ', b'0' + short / 10, b'0' + short % 10]),
        _ => bytes.extend(code.to_string().bytes()),
    }
}

/// Writes binary DXF. A malformed number is written as 0, since the format cannot represent it.
pub(crate) fn binary(pairs: &[Pair<'_>], options: &Options) -> Vec<u8> {
    let encoder = Encoder::of(options);
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
        append_value(pair, encoder, options.version, &mut bytes);
    }
    bytes
}

/// Appends a value in the type that the DXF reference gives for its group code.
fn append_value(pair: &Pair<'_>, encoder: Encoder, version: Version, bytes: &mut Vec<u8>) {
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
            encoder.append(&pair.value, bytes);
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
