//! Short texts as numbers, which are compared at once: names and texts that are looked up for each element.

/// A text of at most 15 bytes as a number that no other one has, and that is not 0.
pub(crate) fn packed(text: &str) -> Option<u128> {
    let bytes = text.as_bytes();
    let length = bytes.len();
    if length > MOST {
        return None;
    }
    // Where both parts overlap they are the same.
    let number = if let (Some(first), Some(last)) = (bytes.first_chunk::<8>(), bytes.last_chunk::<8>()) {
        u128::from(u64::from_le_bytes(*first)) | u128::from(u64::from_le_bytes(*last)) << (8 * (length - 8))
    } else if let (Some(first), Some(last)) = (bytes.first_chunk::<4>(), bytes.last_chunk::<4>()) {
        u128::from(u32::from_le_bytes(*first)) | u128::from(u32::from_le_bytes(*last)) << (8 * (length - 4))
    } else {
        bytes.iter().rev().fold(0, |number, byte| number << 8 | u128::from(*byte))
    };
    Some(number | (length as u128 + 1) << (8 * MOST))
}

/// Longest text that has a number.
const MOST: usize = 15;

/// What the last few of some keys stand for, which are short texts or other numbers that are not 0. All are compared, since it is hard to
/// foresee which it will be.
pub(crate) struct Recent<T> {
    /// 0 where there is none yet.
    keys: [u128; RECENT],
    values: [T; RECENT],
    next: usize,
}

/// How many are remembered.
const RECENT: usize = 8;

impl<T: Copy + Default> Recent<T> {
    pub(crate) fn new() -> Self {
        Self { keys: [0; RECENT], values: [T::default(); RECENT], next: 0 }
    }

    pub(crate) fn get(&self, key: u128) -> Option<T> {
        let numbered = self.keys.iter().enumerate();
        let found = numbered.fold(RECENT, |found, (at, it)| if *it == key { at } else { found });
        self.values.get(found).copied()
    }

    pub(crate) fn insert(&mut self, key: u128, value: T) {
        self.keys[self.next] = key;
        self.values[self.next] = value;
        self.next = (self.next + 1) % RECENT;
    }
}
