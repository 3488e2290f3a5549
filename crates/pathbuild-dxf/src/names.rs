//! Names of layers, line types and blocks: how they are compared and looked up. (book: reference/dxf)

use std::borrow::Cow;
use std::cell::OnceCell;
use std::cmp::Ordering;
use std::collections::HashMap;

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

/// Named values. Of several with the same name the first is found.
#[derive(Debug)]
pub(crate) struct ByName<'a, T> {
    named: Vec<(Name<'a>, T)>,
    /// Hashes with indices, sorted. Built only for large tables.
    order: OnceCell<Vec<(u64, usize)>>,
}

/// Up to this size, names are compared one by one: drawings have few layers and blocks and look few of them up.
const FEW: usize = 32;

impl<T> Default for ByName<'_, T> {
    fn default() -> Self {
        Self { named: Vec::new(), order: OnceCell::new() }
    }
}

impl<'a, T> ByName<'a, T> {
    /// Appends a value.
    pub(crate) fn push(&mut self, name: Name<'a>, thing: T) {
        self.named.push((name, thing));
        self.order.take();
    }

    /// All names and values in file order.
    pub(crate) fn iter(&self) -> impl DoubleEndedIterator<Item = &(Name<'a>, T)> {
        self.named.iter()
    }

    /// Finds the value with this name.
    pub(crate) fn find(&self, name: &Name<'_>) -> Option<&T> {
        let place = if self.named.len() <= FEW {
            self.named.iter().position(|(other, _)| other == name)
        } else {
            self.find_among_many(name)
        };
        Some(&self.named[place?].1)
    }

    fn find_among_many(&self, name: &Name<'_>) -> Option<usize> {
        let hash = name.hash();
        let order = self.order.get_or_init(|| self.in_order());
        let before = |(other, place): &(u64, usize)| {
            other.cmp(&hash).then_with(|| self.named[*place].0.cmp(name)).is_lt()
        };
        let (_, place) = order.get(order.partition_point(before))?;
        (self.named[*place].0 == *name).then_some(*place)
    }

    /// Names are compared only if their hashes are equal, so even a table full of collisions takes linear time.
    fn in_order(&self) -> Vec<(u64, usize)> {
        let name = |place: &usize| &self.named[*place].0;
        let mut order: Vec<(u64, usize)> =
            self.named.iter().enumerate().map(|(place, (name, _))| (name.hash(), place)).collect();
        order.sort_unstable_by(|(a_hash, a), (b_hash, b)| {
            a_hash.cmp(b_hash).then_with(|| name(a).cmp(name(b))).then(a.cmp(b))
        });
        order
    }
}

/// A small hash table by spelling. Drawings have few spellings, and most are short.
#[derive(Debug)]
pub(crate) struct Spellings<'a, T> {
    /// Short spellings by open addressing. Some slots are always free.
    short: [Option<(Short, T)>; PLACES],
    free: usize,
    others: HashMap<&'a [u8], T>,
}

/// A spelling of up to 16 characters, compared as a whole, because branches on single characters cannot be predicted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Short {
    length: usize,
    /// The characters; the two words overlap for short spellings.
    characters: [u64; 2],
}

/// Number of slots for short spellings.
const PLACES: usize = 1 << PLACE_BITS;
const PLACE_BITS: u32 = 5;

impl<T: Copy> Default for Spellings<'_, T> {
    fn default() -> Self {
        Self { short: [None; PLACES], free: PLACES / 4 * 3, others: HashMap::new() }
    }
}

impl<'a, T: Copy> Spellings<'a, T> {
    /// Looks up a spelling.
    #[inline]
    pub(crate) fn get(&self, spelling: &[u8]) -> Option<T> {
        if let Some(short) = Short::of(spelling) {
            let mut place = short.place();
            while let Some((known, value)) = self.short[place] {
                if known == short {
                    return Some(value);
                }
                place = (place + 1) % PLACES;
            }
        }
        if self.others.is_empty() { None } else { self.others.get(spelling).copied() }
    }

    /// Adds a spelling that was not found.
    pub(crate) fn insert(&mut self, spelling: &'a [u8], value: T) {
        match Short::of(spelling).filter(|_| self.free > 0) {
            Some(short) => {
                let mut place = short.place();
                while self.short[place].is_some() {
                    place = (place + 1) % PLACES;
                }
                self.short[place] = Some((short, value));
                self.free -= 1;
            }
            None => _ = self.others.insert(spelling, value),
        }
    }
}

impl Short {
    #[inline]
    fn of(spelling: &[u8]) -> Option<Self> {
        let length = spelling.len();
        let characters = match length {
            0..4 => [spelling.iter().fold(0, |word, byte| word << 8 | u64::from(*byte)), 0],
            4..=16 => {
                // Offset of the second four characters from each end: 0 for up to 7 characters, 4 for up to 15, 8 for 16.
                let second = length / 8 * 4;
                let four =
                    |at: usize| Some(u64::from(u32::from_le_bytes(*spelling.get(at..)?.first_chunk()?)));
                [four(0)? << 32 | four(second)?, four(length - 4)? << 32 | four(length - 4 - second)?]
            }
            _ => return None,
        };
        Some(Self { length, characters })
    }

    /// A hash that separates usual names.
    #[inline]
    fn place(&self) -> usize {
        const MULTIPLIER: u64 = 0x9E37_79B9_7F4A_7C15;
        let [a, b] = self.characters;
        ((a.rotate_left(50) ^ b).wrapping_mul(MULTIPLIER) >> (u64::BITS - PLACE_BITS)) as usize
    }
}
