//! Suggests similar names.

use crate::name::PathName;

/// Maximum number of suggestions.
const MOST: usize = 5;

/// Known names that differ from a name by at most one character, ignoring leading zeros: `8999.1P` for `8999.01P`.
pub fn near_names(name: &PathName, mut known: Vec<PathName>) -> Vec<PathName> {
    let wanted = plain(name);
    known.retain(|other| strsim::levenshtein(&wanted, &plain(other)) <= 1);
    known.sort();
    known.dedup();
    known.truncate(MOST);
    known
}

/// A name without leading zeros.
fn plain(name: &PathName) -> String {
    let name = name.folded();
    let parts: Vec<&str> = name.split('.').map(|part| part.trim_start_matches('0')).collect();
    parts.join(".")
}
