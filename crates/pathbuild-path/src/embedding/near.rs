//! What to say of a path that is not found: names that may have been meant, else what the drawings have.

use pathbuild_diagnostic::messages::paths as messages;
use pathbuild_diagnostic::{Diagnostic, Value, is_slip};

use crate::names::PathName;

/// Names that a note lists at most.
const MOST: usize = 5;

/// Adds a note to a finding about a path that none of the searched drawings defines: the names of which `name` may be a misspelling, else
/// all names there are in these drawings.
pub fn with_near_names(problem: Diagnostic, name: &PathName, mut known: Vec<PathName>) -> Diagnostic {
    known.sort();
    known.dedup();
    let similar = known.iter().filter(|other| is_slip(name.as_str(), other.as_str()));
    let similar: Vec<&PathName> = similar.take(MOST).collect();
    match (similar.as_slice(), known.as_slice()) {
        ([], []) => problem,
        ([], known) => {
            let others = (known.len() > MOST).then_some("...");
            let known = known.iter().take(MOST).map(PathName::as_str).chain(others).collect::<Value>();
            problem.note(&messages::NAMES_THERE, vec![("names", known)])
        }
        (similar, _) => {
            let similar = similar.iter().map(|name| name.as_str()).collect::<Value>();
            problem.note(&messages::NEAR_NAMES, vec![("names", similar)])
        }
    }
}
