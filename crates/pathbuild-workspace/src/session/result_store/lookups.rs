//! Questions while they are collected, each with its number.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use pathbuild_cache::Lookup;

/// Questions, and the lists of directories that they were put to, each once.
#[derive(Debug, Default)]
pub(super) struct Lookups {
    /// The lists, by their numbers.
    pub lists: Vec<Vec<usize>>,
    /// The questions, by their numbers.
    pub all: Vec<Lookup>,
    list_numbers: HashMap<Vec<usize>, usize>,
    numbers: HashMap<Lookup, usize>,
}

impl Lookups {
    /// The number of the question which files in these directories may hold the path of this name.
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
