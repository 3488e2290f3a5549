//! Names as entities spell them, each looked at once a file.

use std::collections::HashMap;

use crate::names::is_same;

/// What is known of some spellings. Drawings have few, so the first ones are compared one after the other.
#[derive(Debug)]
pub(crate) struct Spellings<'a, T> {
    first: Vec<(&'a [u8], T)>,
    others: HashMap<&'a [u8], T>,
}

/// How many are compared one after the other.
const FIRST: usize = 16;

impl<T> Default for Spellings<'_, T> {
    fn default() -> Self {
        Self { first: Vec::new(), others: HashMap::new() }
    }
}

impl<'a, T: Copy> Spellings<'a, T> {
    /// What is known of this one.
    #[inline]
    pub(crate) fn get(&self, spelling: &[u8]) -> Option<T> {
        let first = self.first.iter().find(|(known, _)| is_same(known, spelling));
        match first {
            Some((_, value)) => Some(*value),
            None if self.others.is_empty() => None,
            None => self.others.get(spelling).copied(),
        }
    }

    /// This is known of one that was not known.
    pub(crate) fn insert(&mut self, spelling: &'a [u8], value: T) {
        if self.first.len() < FIRST {
            self.first.reserve_exact(FIRST - self.first.len());
            self.first.push((spelling, value));
        } else {
            self.others.insert(spelling, value);
        }
    }
}
