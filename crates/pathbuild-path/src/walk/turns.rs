//! Finds turn markers by position.

use std::collections::BTreeMap;

use super::ends::{Square, Squares, square};
use crate::approx::coincide;
use crate::geometry::Xy;
use crate::path::Path;

/// The turn markers of a path, as indices into [`Path::turns`].
pub(super) struct Turns {
    /// The markers in each square; of several at exactly the same point only the first.
    squares: BTreeMap<Square, Vec<usize>>,
    /// For each marker, the first one at exactly the same point.
    first: Vec<usize>,
    has_acted: Vec<bool>,
}

impl Turns {
    pub(super) fn new(path: &Path) -> Self {
        let (mut squares, mut known) = (BTreeMap::<_, Vec<usize>>::new(), BTreeMap::new());
        let mut first = |(number, at): (usize, Xy)| {
            *known.entry([at.x.to_bits(), at.y.to_bits()]).or_insert_with(|| {
                squares.entry(square(at)).or_default().push(number);
                number
            })
        };
        let first = path.turns.iter().map(|turn| turn.at).enumerate().map(&mut first).collect();
        Self { squares, first, has_acted: vec![false; path.turns.len()] }
    }

    /// The first marker at a point. Markers at the same point count as one: all of them are marked as used.
    pub(super) fn act(&mut self, path: &Path, at: Xy) -> Option<usize> {
        let mut found: Option<usize> = None;
        for square in Squares::around(at).each() {
            for turn in self.squares.get(&square).into_iter().flatten() {
                if coincide(path.turns[*turn].at, at) {
                    self.has_acted[*turn] = true;
                    found = Some(found.map_or(*turn, |first| first.min(*turn)));
                }
            }
        }
        found
    }

    /// The markers that were never used.
    pub(super) fn idle(&self) -> impl Iterator<Item = usize> {
        (0..self.first.len()).filter(|turn| !self.has_acted[self.first[*turn]])
    }
}
