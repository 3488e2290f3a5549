//! Names as entities spell them, each looked at once a file.

use std::collections::HashMap;

/// What is known of some spellings. Drawings have few, and most are short.
#[derive(Debug)]
pub(crate) struct Spellings<'a, T> {
    /// Short ones, each at its place or, if that is taken, at one of those that follow. Some places are always free.
    short: [Option<(Short, T)>; PLACES],
    free: usize,
    others: HashMap<&'a [u8], T>,
}

/// A spelling of up to 16 characters. Which one comes next cannot be foreseen, so they are compared as a whole, and not by looking at
/// those that were there before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Short {
    length: usize,
    /// The characters, some of them twice.
    characters: [u64; 2],
}

/// How many places there are for short spellings.
const PLACES: usize = 1 << PLACE_BITS;
const PLACE_BITS: u32 = 5;

impl<T: Copy> Default for Spellings<'_, T> {
    fn default() -> Self {
        Self { short: [None; PLACES], free: PLACES / 4 * 3, others: HashMap::new() }
    }
}

impl<'a, T: Copy> Spellings<'a, T> {
    /// What is known of this one.
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

    /// This is known of one that was not known.
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
                // 0 for up to 7 characters, 4 for up to 15, 8 for 16: where the second four are, counted from each end.
                let second = length / 8 * 4;
                let four =
                    |at: usize| Some(u64::from(u32::from_le_bytes(*spelling.get(at..)?.first_chunk()?)));
                [four(0)? << 32 | four(second)?, four(length - 4)? << 32 | four(length - 4 - second)?]
            }
            _ => return None,
        };
        Some(Self { length, characters })
    }

    /// A number that usual names do not have in common.
    #[inline]
    fn place(&self) -> usize {
        const MULTIPLIER: u64 = 0x9E37_79B9_7F4A_7C15;
        let [a, b] = self.characters;
        ((a.rotate_left(50) ^ b).wrapping_mul(MULTIPLIER) >> (u64::BITS - PLACE_BITS)) as usize
    }
}
