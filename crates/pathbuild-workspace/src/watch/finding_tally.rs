//! Counts how often the checks of a session report each finding. (book: reference/commands, `watch`)

use std::collections::HashSet;
use std::hash::{Hash, Hasher};

use pathbuild_diagnostic::Diagnostic;
use rustc_hash::FxHashMap;

use crate::findings::identity;

/// The number of checks that report each finding. Several drawings may have the same finding.
#[derive(Debug, Default)]
pub(super) struct FindingTally(FxHashMap<CountedFinding, usize>);

impl FindingTally {
    /// Replaces previous findings by current ones.
    pub(super) fn replace(&mut self, before: &[Diagnostic], now: &[Diagnostic]) {
        for found in now {
            *self.0.entry(CountedFinding(found.clone())).or_default() += 1;
        }
        for found in before.iter().cloned().map(CountedFinding) {
            match self.0.get_mut(&found) {
                Some(count) if *count > 1 => *count -= 1,
                _ => _ = self.0.remove(&found),
            }
        }
    }

    /// Returns all findings, each once.
    pub(super) fn all(&self) -> Vec<Diagnostic> {
        self.0.keys().map(|found| found.0.clone()).collect()
    }
}

/// Returns the findings that are not among `others`.
pub(super) fn without(findings: &[Diagnostic], others: &[Diagnostic]) -> Vec<Diagnostic> {
    let others: HashSet<_> = others.iter().map(identity).collect();
    findings.iter().filter(|found| !others.contains(&identity(found))).cloned().collect()
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
