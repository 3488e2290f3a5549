//! Finding the layers and blocks of a file by their names.

use std::cell::OnceCell;

use crate::names::Name;

/// Things with names. Of those with the same name the first is found.
#[derive(Debug)]
pub(crate) struct ByName<'a, T> {
    named: Vec<(Name<'a>, T)>,
    /// Hashes of the names and where they are, in order; wanted only where there are many.
    order: OnceCell<Vec<(u64, usize)>>,
}

/// So many names are compared one after the other: drawings have few layers and blocks, and hardly any is ever looked for.
const FEW: usize = 32;

impl<T> Default for ByName<'_, T> {
    fn default() -> Self {
        Self { named: Vec::new(), order: OnceCell::new() }
    }
}

impl<'a, T> ByName<'a, T> {
    /// Adds something behind all others.
    pub(crate) fn push(&mut self, name: Name<'a>, thing: T) {
        self.named.push((name, thing));
        self.order.take();
    }

    /// All with their names.
    pub(crate) fn iter(&self) -> impl DoubleEndedIterator<Item = &(Name<'a>, T)> {
        self.named.iter()
    }

    /// What has this name.
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

    /// Names are compared only where hashes are the same: that of a file full of such is as fast.
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
