use encoding_rs::{Encoding, UTF_8, WINDOWS_1252};

use crate::model::{Options, TextEncoding, Version};

/// Encodes the strings of a sheet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Encoder {
    /// The encoding; `None` for ASCII only.
    encoding: Option<&'static Encoding>,
}

impl Encoder {
    pub(crate) fn of(options: &Options) -> Self {
        let encoding = match options.encoding {
            // A byte order mark implies UTF-8 for the whole file.
            TextEncoding::Proper if options.version >= Version::R2007 || options.byte_order_mark => {
                Some(UTF_8)
            }
            TextEncoding::Proper => code_page(options.code_page.as_deref().unwrap_or("ANSI_1252")),
            TextEncoding::Utf8 => Some(UTF_8),
            TextEncoding::Escaped => None,
        };
        Self { encoding }
    }

    /// Appends a string. Characters missing from the encoding become `\U+XXXX`, control characters become carets.
    pub(crate) fn append(self, string: &str, bytes: &mut Vec<u8>) {
        for c in string.chars() {
            match c {
                '\0'..='\x1f' => bytes.extend([b'^', c as u8 + b'@']),
                _ if c.is_ascii() => bytes.push(c as u8),
                _ => self.append_foreign(c, bytes),
            }
        }
    }

    fn append_foreign(self, c: char, bytes: &mut Vec<u8>) {
        let mut buffer = [0; 4];
        let char_text: &str = c.encode_utf8(&mut buffer);
        if let Some(encoding) = self.encoding {
            let (encoded, _, unmappable) = encoding.encode(char_text);
            if !unmappable {
                return bytes.extend_from_slice(&encoded);
            }
        }
        let mut units = [0; 2];
        for unit in c.encode_utf16(&mut units) {
            bytes.extend(format!("\\U+{unit:04X}").bytes());
        }
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
