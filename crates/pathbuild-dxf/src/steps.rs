//! How much is looked at in blocks: a few of them, inserted in each other, come to more than any file holds.

use crate::collect::too_many_entities;
use crate::faults::Fatal;

/// What may still be looked at.
pub(crate) struct Steps {
    left: usize,
    most_entities: usize,
}

/// So many entities of blocks are looked at, wanted or not, for each one that the limit allows.
const STEPS_AN_ENTITY: usize = 16;

impl Steps {
    /// For a drawing of at most so many entities.
    pub(crate) fn new(most_entities: usize) -> Self {
        Self { left: most_entities.saturating_mul(STEPS_AN_ENTITY), most_entities }
    }

    /// Takes so many.
    ///
    /// # Errors
    /// PB005 where there are no more.
    pub(crate) fn take(&mut self, count: usize) -> Result<(), Fatal> {
        self.left = self.left.checked_sub(count).ok_or_else(|| too_many_entities(self.most_entities))?;
        Ok(())
    }
}
