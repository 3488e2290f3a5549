//! How names of layers, line types and blocks are compared. (book: reference/dxf)

use std::borrow::Cow;
use std::cmp::Ordering;

use smol_str::{SmolStr, StrExt};

use crate::encoding::{Decoder, is_plain};

/// A trimmed name that is compared ignoring case.
#[derive(Clone, Debug)]
pub(crate) enum Name<'a> {
    /// An ASCII name as spelt.
    Spelt(&'a [u8]),
    /// Any other name, in upper case.
    Folded(SmolStr),
}

impl<'a> Name<'a> {
    /// The name in a decoded text.
    pub(crate) fn new(text: Cow<'a, str>) -> Self {
        match text {
            Cow::Borrowed(text) if text.is_ascii() => Self::Spelt(trimmed(text).as_bytes()),
            text => Self::Folded(folded(text.trim())),
        }
    }

    /// The name in a string that starts on this line.
    pub(crate) fn decoded(bytes: &'a [u8], line: u32, decoder: &mut Decoder<'_>) -> Self {
        if is_plain(bytes) && has_graphic_ends(bytes) {
            return Self::Spelt(bytes);
        }
        Self::new(decoder.decode(bytes, line))
    }

    /// The part after an external-reference prefix, if there is one.
    pub(crate) fn behind_xref(&self) -> Option<Self> {
        if !has_xref_sign(self.bytes()) {
            return None;
        }
        let text = String::from_utf8_lossy(self.bytes());
        let behind = without_xref(&text);
        (behind.len() < text.len()).then(|| Self::Folded(folded(behind)))
    }

    /// A hash; equal names have equal hashes.
    pub(crate) fn hash(&self) -> u64 {
        const MULTIPLIER: u64 = 0x9E37_79B9_7F4A_7C15;
        let (words, rest) = self.bytes().as_chunks();
        let rest = rest.iter().fold(0, |word, byte| word << 8 | u64::from(*byte));
        let words = words.iter().map(|word| u64::from_le_bytes(*word)).chain([rest]);
        // Drops the bit in which upper and lower case differ.
        let add =
            |hash: u64, word: u64| (hash.rotate_left(29) ^ (word & !(ONES * 0x20))).wrapping_mul(MULTIPLIER);
        words.fold(0, add)
    }

    /// The name as UTF-8.
    fn bytes(&self) -> &[u8] {
        match self {
            Self::Spelt(bytes) => bytes,
            Self::Folded(text) => text.as_bytes(),
        }
    }

    fn upper_case(&self) -> impl Iterator<Item = u8> {
        self.bytes().iter().map(u8::to_ascii_uppercase)
    }
}

/// 0x01 in each byte.
const ONES: u64 = u64::from_le_bytes([1; 8]);

impl Ord for Name<'_> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.upper_case().cmp(other.upper_case())
    }
}

impl PartialOrd for Name<'_> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Name<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.bytes().eq_ignore_ascii_case(other.bytes())
    }
}

impl Eq for Name<'_> {}

/// Trims a name and removes an external-reference prefix (`FILE$0$NAME`, `FILE|NAME`).
pub(crate) fn without_xref(name: &str) -> &str {
    let name = trimmed(name);
    if !has_xref_sign(name.as_bytes()) {
        return name;
    }
    let after_bar = name.rfind('|').map_or(0, |bar| bar + 1);
    let after_bound = bound_prefix(name);
    name[after_bar.max(after_bound)..].trim()
}

/// Whether a name may have an external-reference prefix.
fn has_xref_sign(name: &[u8]) -> bool {
    name.iter().any(|byte| matches!(byte, b'|' | b'$'))
}

/// Trims blanks; few texts have any.
fn trimmed(text: &str) -> &str {
    if has_graphic_ends(text.as_bytes()) { text } else { text.trim() }
}

fn has_graphic_ends(text: &[u8]) -> bool {
    let is_graphic = |byte: Option<&u8>| byte.is_some_and(u8::is_ascii_graphic);
    is_graphic(text.first()) && is_graphic(text.last())
}

/// Folds a name for comparison.
pub(crate) fn folded(name: &str) -> SmolStr {
    if name.is_ascii() { name.to_ascii_uppercase_smolstr() } else { name.to_uppercase_smolstr() }
}

/// Whether two spellings, usually short ones, are equal. Inlined without function calls.
#[inline]
pub(crate) fn is_same(a: &[u8], b: &[u8]) -> bool {
    match (a.len() == b.len(), a.len()) {
        (true, 8..=16) => has_same_ends::<8>(a, b),
        (true, 4..=7) => has_same_ends::<4>(a, b),
        _ => a == b,
    }
}

#[inline]
fn has_same_ends<const N: usize>(a: &[u8], b: &[u8]) -> bool {
    a.first_chunk::<N>() == b.first_chunk() && a.last_chunk::<N>() == b.last_chunk()
}

/// Length of the prefix up to and including the last `$digits$`.
fn bound_prefix(name: &str) -> usize {
    let Some(last) = name.rfind('$') else { return 0 };
    let before = name[..last].trim_end_matches(|c: char| c.is_ascii_digit());
    let has_digits = before.len() < last;
    match before.strip_suffix('$') {
        Some(prefix) if has_digits && !prefix.is_empty() => last + 1,
        _ => 0,
    }
}
