//! Names of layers, line types and blocks: how they are compared. (spec/10-drawing.md)

use std::borrow::Cow;
use std::cmp::Ordering;

use smol_str::{SmolStr, StrExt};

/// A name without blanks around it that is compared without regard to case.
#[derive(Clone, Debug)]
pub(crate) struct Name<'a> {
    /// Upper case unless it is ASCII.
    text: Cow<'a, str>,
}

impl<'a> Name<'a> {
    /// That of this text.
    pub(crate) fn new(text: Cow<'a, str>) -> Self {
        let text = match text {
            Cow::Borrowed(text) if text.is_ascii() => Cow::Borrowed(trimmed(text)),
            text => Cow::Owned(folded(text.trim()).into()),
        };
        Self { text }
    }

    /// Its text, which [`compare_ascii`] compares as names are compared.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }
}

impl Ord for Name<'_> {
    fn cmp(&self, other: &Self) -> Ordering {
        compare_ascii(&self.text, &other.text)
    }
}

impl PartialOrd for Name<'_> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Name<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Name<'_> {}

/// A name without blanks around it and without the prefix of an external reference (`FILE$0$NAME`, `FILE|NAME`).
pub(crate) fn without_xref(name: &str) -> &str {
    let name = trimmed(name);
    if !name.bytes().any(|byte| matches!(byte, b'|' | b'$')) {
        return name;
    }
    let after_bar = name.rfind('|').map_or(0, |bar| bar + 1);
    let after_bound = bound_prefix(name);
    name[after_bar.max(after_bound)..].trim()
}

/// A text without blanks around it, which hardly any has.
fn trimmed(text: &str) -> &str {
    let is_graphic = |byte: Option<&u8>| byte.is_some_and(u8::is_ascii_graphic);
    let bytes = text.as_bytes();
    if is_graphic(bytes.first()) && is_graphic(bytes.last()) { text } else { text.trim() }
}

/// What names are compared by.
pub(crate) fn folded(name: &str) -> SmolStr {
    if name.is_ascii() { name.to_ascii_uppercase_smolstr() } else { name.to_uppercase_smolstr() }
}

/// Whether two spellings, most of which are short, are the same. Takes no calls.
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

/// The order of ASCII names without regard to case. (Names that are already folded may be anything.)
pub(crate) fn compare_ascii(a: &str, b: &str) -> Ordering {
    a.bytes().map(|byte| byte.to_ascii_uppercase()).cmp(b.bytes().map(|byte| byte.to_ascii_uppercase()))
}

/// Length of everything up to and including the last `$digits$`.
fn bound_prefix(name: &str) -> usize {
    let Some(last) = name.rfind('$') else { return 0 };
    let before = name[..last].trim_end_matches(|c: char| c.is_ascii_digit());
    let has_digits = before.len() < last;
    match before.strip_suffix('$') {
        Some(prefix) if has_digits && !prefix.is_empty() => last + 1,
        _ => 0,
    }
}
