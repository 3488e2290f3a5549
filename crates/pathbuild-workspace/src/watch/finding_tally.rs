//! Counts how often the checks of a session report each finding. (book: reference/commands, `watch`)

use std::collections::HashMap;
use std::hash::{Hash, Hasher};

use pathbuild_diagnostic::Diagnostic;

use crate::findings::identity;

/// The number of checks that report each finding. Several drawings may have the same finding.
#[derive(Debug, Default)]
pub(super) struct FindingTally(HashMap<CountedFinding, usize>);

impl FindingTally {
    /// Replaces previous findings by current ones. Returns the new findings, and the findings that no check reports any more.
    pub(super) fn replace(
        &mut self,
        before: &[Diagnostic],
        now: &[Diagnostic],
    ) -> (Vec<Diagnostic>, Vec<Diagnostic>) {
        let counted = |found: &Diagnostic| CountedFinding(found.clone());
        let is_known = |tally: &Self, found: &Diagnostic| tally.0.contains_key(&counted(found));
        let new = now.iter().filter(|found| !is_known(self, found)).cloned().collect();
        for found in now {
            *self.0.entry(counted(found)).or_default() += 1;
        }
        for found in before.iter().map(counted) {
            match self.0.get_mut(&found) {
                Some(count) if *count > 1 => *count -= 1,
                _ => _ = self.0.remove(&found),
            }
        }
        (new, before.iter().filter(|found| !is_known(self, found)).cloned().collect())
    }
}

/// A finding that is compared by its identity, without trace and notes.
#[derive(Debug)]
struct CountedFinding(Diagnostic);

impl PartialEq for CountedFinding {
    fn eq(&self, other: &Self) -> bool {
        identity(&self.0) == identity(&other.0)
    }
}

impl Eq for CountedFinding {}

impl Hash for CountedFinding {
    fn hash<H: Hasher>(&self, state: &mut H) {
        identity(&self.0).hash(state);
    }
}
