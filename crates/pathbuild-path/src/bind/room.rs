//! Memory of paths that nobody keeps, for the next ones.

use std::cell::Cell;

use crate::path::{CutParameters, Helix, Hole, Path, Segment};
use crate::reuse::Reuse;

/// Empty lists with room for what comes.
#[derive(Default)]
pub(super) struct Room {
    pub(super) segments: Vec<Segment>,
    pub(super) cuts: Vec<CutParameters>,
    pub(super) holes: Vec<Hole>,
    pub(super) helices: Vec<Helix>,
}

thread_local! {
    static KEPT: Cell<Room> = Cell::default();
}

/// Room for no more of a kind is kept.
const MOST_KEPT: usize = 1024;

impl Room {
    /// What is kept on this thread.
    pub(super) fn take() -> Self {
        KEPT.take()
    }
}

impl Reuse for Path {
    fn reuse(self) {
        let Self { mut segments, mut cuts, mut holes, mut helices, .. } = self;
        segments.clear();
        cuts.clear();
        holes.clear();
        helices.clear();
        let rooms = [segments.capacity(), cuts.capacity(), holes.capacity(), helices.capacity()];
        if rooms.into_iter().all(|room| room <= MOST_KEPT) {
            KEPT.set(Room { segments, cuts, holes, helices });
        }
    }

    fn shrink_to_fit(&mut self) {
        self.segments.shrink_to_fit();
        self.cuts.shrink_to_fit();
        self.holes.shrink_to_fit();
        self.helices.shrink_to_fit();
    }
}
