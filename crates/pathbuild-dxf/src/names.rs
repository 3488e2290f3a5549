//! Names of layers, line types and blocks: how they are compared, and the table in which each spelling is evaluated once per file.
//! (book: reference/dxf)

use std::collections::HashMap;

use smol_str::{SmolStr, StrExt};

/// Converts a name to upper case without surrounding blanks, for comparison.
pub(crate) fn case_folded(name: &str) -> SmolStr {
    let name = name.trim();
    if name.is_ascii() { name.to_ascii_uppercase_smolstr() } else { name.to_uppercase_smolstr() }
}

/// Trims a name and removes an external-reference prefix (`FILE$0$NAME`, `FILE|NAME`).
pub(crate) fn without_xref(name: &str) -> &str {
    let name = name.trim();
    if !has_xref_sign(name.as_bytes()) {
        return name;
    }
    let after_bar = name.rfind('|').map_or(0, |bar| bar + 1);
    let after_bound = xref_prefix_length(name);
    name[after_bar.max(after_bound)..].trim()
}

/// Whether a name may have an external-reference prefix.
fn has_xref_sign(name: &[u8]) -> bool {
    name.iter().any(|byte| matches!(byte, b'|' | b'$'))
}

/// Returns the length of the prefix up to and including the last `$digits$`.
fn xref_prefix_length(name: &str) -> usize {
    let Some(last) = name.rfind('$') else { return 0 };
    let before = name[..last].trim_end_matches(|c: char| c.is_ascii_digit());
    let has_digits = before.len() < last;
    match before.strip_suffix('$') {
        Some(prefix) if has_digits && !prefix.is_empty() => last + 1,
        _ => 0,
    }
}

/// A small hash table keyed by the spelling of a name. Drawings contain few different spellings, and most are short.
#[derive(Debug)]
pub(crate) struct Spellings<'a, T> {
    /// Short spellings by open addressing. Some slots are always free.
    short: [Option<(ShortSpelling, T)>; SHORT_NAME_SLOTS],
    free: usize,
    others: HashMap<&'a [u8], T>,
}

/// A spelling of up to 16 bytes, compared as a whole, because branches on single bytes cannot be predicted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct ShortSpelling {
    length: usize,
    /// The bytes; the two words overlap for short spellings.
    characters: [u64; 2],
}

/// Number of slots for short spellings.
const SHORT_NAME_SLOTS: usize = 1 << PLACE_BITS;
const PLACE_BITS: u32 = 5;

impl<T: Copy> Default for Spellings<'_, T> {
    fn default() -> Self {
        Self { short: [None; SHORT_NAME_SLOTS], free: SHORT_NAME_SLOTS / 4 * 3, others: HashMap::new() }
    }
}

impl<'a, T: Copy> Spellings<'a, T> {
    #[inline]
    pub(crate) fn get(&self, spelling: &[u8]) -> Option<T> {
        if let Some(short) = ShortSpelling::of(spelling) {
            let mut place = short.preferred_slot();
            while let Some((known, value)) = self.short[place] {
                if known == short {
                    return Some(value);
                }
                place = (place + 1) % SHORT_NAME_SLOTS;
            }
        }
        if self.others.is_empty() { None } else { self.others.get(spelling).copied() }
    }

    /// Adds a spelling that is not in the table yet.
    pub(crate) fn insert(&mut self, spelling: &'a [u8], value: T) {
        match ShortSpelling::of(spelling).filter(|_| self.free > 0) {
            Some(short) => {
                let mut place = short.preferred_slot();
                while self.short[place].is_some() {
                    place = (place + 1) % SHORT_NAME_SLOTS;
                }
                self.short[place] = Some((short, value));
                self.free -= 1;
            }
            None => _ = self.others.insert(spelling, value),
        }
    }
}

impl ShortSpelling {
    #[inline]
    fn of(spelling: &[u8]) -> Option<Self> {
        let length = spelling.len();
        let characters = match length {
            0..4 => [spelling.iter().fold(0, |word, byte| word << 8 | u64::from(*byte)), 0],
            4..=16 => {
                // Offset of the second four bytes from each end: 0 for up to 7 bytes, 4 for up to 15, 8 for 16.
                let second = length / 8 * 4;
                let four =
                    |at: usize| Some(u64::from(u32::from_le_bytes(*spelling.get(at..)?.first_chunk()?)));
                [four(0)? << 32 | four(second)?, four(length - 4)? << 32 | four(length - 4 - second)?]
            }
            _ => return None,
        };
        Some(Self { length, characters })
    }

    /// Returns the preferred slot, found by a hash that gives different slots to most usual names.
    #[inline]
    fn preferred_slot(&self) -> usize {
        const MULTIPLIER: u64 = 0x9E37_79B9_7F4A_7C15;
        let [a, b] = self.characters;
        ((a.rotate_left(50) ^ b).wrapping_mul(MULTIPLIER) >> (u64::BITS - PLACE_BITS)) as usize
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// The table finds the same values as a plain hash table, whatever the lengths and the number of the spellings.
        #[test]
        fn the_table_agrees_with_a_hash_table(spellings in prop::collection::vec("[AB]{0,3}|[0-9A-C. ]{0,20}", 0..60)) {
            let (mut table, mut plain) = (Spellings::default(), HashMap::new());
            for (number, spelling) in spellings.iter().enumerate() {
                prop_assert_eq!(table.get(spelling.as_bytes()), plain.get(spelling).copied(), "{}", spelling);
                if plain.insert(spelling, number).is_none() {
                    table.insert(spelling.as_bytes(), number);
                } else {
                    plain.insert(spelling, table.get(spelling.as_bytes()).unwrap_or_default());
                }
            }
        }
    }
}
