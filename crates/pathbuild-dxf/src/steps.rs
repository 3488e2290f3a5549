//! A budget for reading blocks: a few blocks inserted in each other expand to more than any file holds.

use crate::collect::too_many_entities;
use crate::faults::Fatal;

/// The remaining budget.
pub(crate) struct Steps {
    left: usize,
    most_entities: usize,
}

/// Number of block entities, wanted or not, that may be visited per entity of the limit.
const STEPS_AN_ENTITY: usize = 16;

impl Steps {
    /// The budget of a drawing with this limit of entities.
    pub(crate) fn new(most_entities: usize) -> Self {
        Self { left: most_entities.saturating_mul(STEPS_AN_ENTITY), most_entities }
    }

    /// Spends some of the budget.
    ///
    /// # Errors
    /// PB005 if it is exhausted.
    pub(crate) fn take(&mut self, count: usize) -> Result<(), Fatal> {
        self.left = self.left.checked_sub(count).ok_or_else(|| too_many_entities(self.most_entities))?;
        Ok(())
    }
}
