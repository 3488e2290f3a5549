//! Assigns indices to lookups while they are collected.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use pathbuild_cache::Lookup;

/// Lookups and their directory lists, without duplicates.
#[derive(Debug, Default)]
pub(super) struct Lookups {
    /// The directory lists, by index.
    pub lists: Vec<Vec<usize>>,
    /// The lookups, by index.
    pub all: Vec<Lookup>,
    list_numbers: HashMap<Vec<usize>, usize>,
    numbers: HashMap<Lookup, usize>,
}

impl Lookups {
    /// Index of the lookup of this path name in these directories.
    pub(super) fn number(&mut self, directories: Vec<usize>, name: &str) -> usize {
        let directories = self.list_number(directories);
        match self.numbers.entry(Lookup { directories, name: name.into() }) {
            Entry::Occupied(known) => *known.get(),
            Entry::Vacant(new) => {
                self.all.push(new.key().clone());
                *new.insert(self.all.len() - 1)
            }
        }
    }

    fn list_number(&mut self, directories: Vec<usize>) -> usize {
        match self.list_numbers.entry(directories) {
            Entry::Occupied(known) => *known.get(),
            Entry::Vacant(new) => {
                self.lists.push(new.key().clone());
                *new.insert(self.lists.len() - 1)
            }
        }
    }
}
