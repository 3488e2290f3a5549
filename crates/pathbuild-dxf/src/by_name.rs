//! Lookup of layers and blocks by name.

use std::cell::OnceCell;

use crate::names::Name;

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
