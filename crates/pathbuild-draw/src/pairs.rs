//! Reads the DXF pairs that the crate `dxf` writes, and corrects the crate's errors and omissions.
//!
//! The crate knows which groups an entity has. But it duplicates handles; omits the handles of tables, the owners, and model and paper space; writes
//! an empty group 430; drops alignment points at the origin; does not know frozen layers; escapes carets and umlauts; and puts the time and a random
//! number into each file. Strings are therefore replaced by placeholders while they pass through the crate and restored in this module, and handles
//! are assigned anew.

use std::borrow::Cow;

use encoding_rs::Encoding;
use indexmap::IndexSet;

/// A group code with its value, borrowed from the crate's output or the drawing, or created here.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pair<'a> {
    /// The group code, which determines the meaning and type of the value.
    pub code: i32,
    /// The value as text, whatever its type.
    pub value: Cow<'a, str>,
}

impl<'a> Pair<'a> {
    /// Creates a pair from a group code and its value as text.
    pub fn new(code: i32, value: impl Into<Cow<'a, str>>) -> Self {
        Self { code, value: value.into() }
    }

    /// Creates a pair for a handle or a pointer to one.
    pub fn handle(code: i32, handle: u64) -> Self {
        Self::new(code, format!("{handle:X}"))
    }

    /// Creates a pair for an integer, aligned as CAD programs do.
    pub fn integer(code: i32, number: i64) -> Self {
        Self::new(code, format!("{number:>6}"))
    }

    /// Returns the pair with its value borrowed.
    pub fn borrowed(&self) -> Pair<'_> {
        Pair { code: self.code, value: Cow::Borrowed(&self.value) }
    }

    /// Returns the pair with its value cloned.
    pub fn to_owned_pair(&self) -> Pair<'static> {
        Pair { code: self.code, value: Cow::Owned(self.value.clone().into_owned()) }
    }
}

/// An entity or other object of DXF: the pairs from one group 0 to the next.
pub type Record<'a> = Vec<Pair<'a>>;

/// Splits DXF into records.
pub fn records(text: &str) -> Vec<Record<'_>> {
    let mut lines = text.lines();
    let mut records: Vec<Record<'_>> = Vec::new();
    while let (Some(code), Some(value)) = (lines.next(), lines.next()) {
        let pair = Pair::new(code.trim().parse().unwrap_or_default(), value);
        match records.last_mut() {
            Some(record) if pair.code != 0 => record.push(pair),
            _ => records.push(vec![pair]),
        }
    }
    records
}

/// Returns the type of a record: the value of group 0.
pub fn kind<'r>(record: &'r [Pair<'_>]) -> &'r str {
    record.first().map_or("", |pair| pair.value.as_ref())
}

/// Returns the value of the first pair with a group code.
pub fn value<'r>(record: &'r [Pair<'_>], code: i32) -> Option<&'r str> {
    record.iter().find(|pair| pair.code == code).map(|pair| pair.value.as_ref())
}

/// Removes all pairs of some codes.
pub fn drop_codes(record: &mut Record<'_>, codes: &[i32]) {
    record.retain(|pair| !codes.contains(&pair.code));
}

/// Inserts the handle, and the owner if there is one, after group 0, in place of those that the crate wrote. `code` is the group code of the handle.
pub fn identify(record: &mut Record<'_>, code: i32, handle: Option<u64>, owner: Option<u64>) {
    drop_codes(record, &[5, 105, 330]);
    let handle = handle.map(|handle| Pair::handle(code, handle));
    let owner = owner.map(|owner| Pair::handle(330, owner));
    record.splice(1..1, handle.into_iter().chain(owner));
}

/// Removes unwanted output of the crate from an entity: dangling pointers (347, 390), an empty colour name (430), transparency (440), shadow mode
/// (284), and a line weight that is only that of the layer (370).
pub fn remove_unwanted_pairs(record: &mut Record<'_>) {
    record.retain(|pair| match pair.code {
        347 | 390 | 430 | 440 | 284 => false,
        370 => pair.value.trim() != "-1",
        _ => true,
    });
}

/// Groups of MTEXT that are written. The crate adds groups for columns and a background, which older programs cannot read.
const MTEXT: [i32; 25] =
    [0, 5, 330, 100, 67, 8, 6, 62, 48, 60, 10, 20, 30, 40, 41, 71, 72, 3, 1, 7, 73, 44, 210, 220, 230];

/// Reduces an MTEXT to its usual groups and the given groups of its direction. The crate writes further groups 50 for columns, which are dropped.
pub fn reduce_mtext(record: &mut Record<'_>, direction: &[i32]) {
    let mut is_first = true;
    record.retain(|pair| {
        let is_count = pair.code == 50 && !std::mem::take(&mut is_first);
        !is_count && (MTEXT.contains(&pair.code) || direction.contains(&pair.code))
    });
}

/// Default length in characters of an MTEXT's chunks.
pub const CHUNK: usize = 250;

/// Splits the text of an MTEXT into chunks: all but the last are in groups 3.
pub fn chunks(value: &str, size: usize) -> Vec<String> {
    let chars: Vec<char> = value.chars().collect();
    chars.chunks(size.max(1)).map(|chunk| chunk.iter().collect()).collect()
}

/// Placeholders for strings while they pass through the crate `dxf`, which would change some of their characters.
#[derive(Debug, Default)]
pub struct StringPlaceholders {
    strings: IndexSet<String>,
}

impl StringPlaceholders {
    /// Returns the string itself if the crate leaves it unchanged, otherwise a placeholder.
    pub fn placeholder_for(&mut self, string: &str) -> String {
        let is_safe = |c: char| (' '..='~').contains(&c) && !matches!(c, '^' | '<');
        if string.chars().all(is_safe) {
            return string.to_owned();
        }
        let (number, _) = self.strings.insert_full(string.to_owned());
        format!("<{number}>")
    }

    /// Replaces the placeholders in a record by their strings.
    pub fn restore_strings<'a>(&'a self, record: &mut Record<'a>) {
        for pair in record {
            if let Some(string) = self.original_string(&pair.value) {
                pair.value = Cow::Borrowed(string);
            }
        }
    }

    fn original_string(&self, placeholder: &str) -> Option<&str> {
        let number = placeholder.strip_prefix('<')?.strip_suffix('>')?;
        self.strings.get_index(number.parse().ok()?).map(String::as_str)
    }
}

/// Writes DXF in its ASCII form: one line for the code, one for the value. Without an encoding, texts
/// are ASCII, with all other characters as `\U+XXXX`.
pub fn ascii(pairs: &[Pair<'_>], encoding: Option<&'static Encoding>, line_end: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(pairs.len() * 16);
    for pair in pairs {
        bytes.extend(format!("{:>3}", pair.code).bytes());
        bytes.extend(line_end);
        encode(&pair.value, encoding, &mut bytes);
        bytes.extend(line_end);
    }
    bytes
}

/// Appends a string. Characters missing from the encoding become `\U+XXXX`, and control characters are written in caret
/// notation, such as `^J` for a line feed.
pub fn encode(string: &str, encoding: Option<&'static Encoding>, bytes: &mut Vec<u8>) {
    for c in string.chars() {
        match c {
            '\0'..='\x1f' => bytes.extend([b'^', c as u8 + b'@']),
            _ if c.is_ascii() => bytes.push(c as u8),
            _ => encode_foreign(c, encoding, bytes),
        }
    }
}

fn encode_foreign(c: char, encoding: Option<&'static Encoding>, bytes: &mut Vec<u8>) {
    let mut buffer = [0; 4];
    let char_text: &str = c.encode_utf8(&mut buffer);
    if let Some(encoding) = encoding {
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
