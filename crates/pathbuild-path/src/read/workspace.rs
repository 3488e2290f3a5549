//! Memory that is needed while a path is read, and kept for the next one: elements and candidates are large, and made for every path.

use std::cell::Cell;

use super::elements::Elements;
use crate::assign::Candidate;

/// Empty lists with room for what comes.
#[derive(Default)]
pub(super) struct Workspace {
    elements: Vec<Elements>,
    candidates: Vec<Vec<Candidate>>,
}

thread_local! {
    static KEPT: Cell<Workspace> = Cell::default();
}

/// So many lists of a kind are kept, if each has room for no more than so much.
const LISTS: usize = 4;
const ROOM: usize = 1024;

impl Workspace {
    /// Works in what is kept on this thread.
    pub(super) fn with<R>(work: impl FnOnce(&mut Self) -> R) -> R {
        let mut workspace = KEPT.take();
        let result = work(&mut workspace);
        KEPT.set(workspace);
        result
    }

    pub(super) fn elements(&mut self) -> Elements {
        self.elements.pop().unwrap_or_default()
    }

    pub(super) fn candidates(&mut self) -> Vec<Candidate> {
        self.candidates.pop().unwrap_or_default()
    }

    /// Takes back what is no longer needed; it is empty.
    pub(super) fn keep_elements(&mut self, elements: Elements) {
        if self.elements.len() < LISTS && elements.room() <= ROOM {
            self.elements.push(elements);
        }
    }

    pub(super) fn keep_candidates(&mut self, mut candidates: Vec<Candidate>) {
        candidates.clear();
        if self.candidates.len() < LISTS && candidates.capacity() <= ROOM {
            self.candidates.push(candidates);
        }
    }
}
