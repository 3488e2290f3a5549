//! Names as entities spell them, each looked at once a file.

use std::collections::HashMap;

use crate::names::is_same;

/// What is known of some spellings. Drawings have few, so the first ones are compared one after the other.
#[derive(Debug)]
pub(crate) struct Spellings<'a, T> {
    first: [Option<(&'a [u8], T)>; FIRST],
    others: HashMap<&'a [u8], T>,
}

/// How many are compared one after the other.
const FIRST: usize = 16;

impl<T: Copy> Default for Spellings<'_, T> {
    fn default() -> Self {
        Self { first: [None; FIRST], others: HashMap::new() }
    }
}

impl<'a, T: Copy> Spellings<'a, T> {
    /// What is known of this one.
    #[inline]
    pub(crate) fn get(&self, spelling: &[u8]) -> Option<T> {
        let mut first = self.first.iter().map_while(Option::as_ref);
        let first = first.find(|(known, _)| is_same(known, spelling));
        match first {
            Some((_, value)) => Some(*value),
            None if self.others.is_empty() => None,
            None => self.others.get(spelling).copied(),
        }
    }

    /// This is known of one that was not known.
    pub(crate) fn insert(&mut self, spelling: &'a [u8], value: T) {
        match self.first.iter_mut().find(|known| known.is_none()) {
            Some(free) => *free = Some((spelling, value)),
            None => _ = self.others.insert(spelling, value),
        }
    }
}
