//! Checks paths with all combinations of their variables' values. (book: language/variables)

use std::collections::BTreeMap;

use pathbuild_db::{Role, SourceFile, Target, combinations, locate};
use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, Message, Place, TextFault, Value};
use pathbuild_path::{Bindings, PathName};

use super::{CheckedTarget, Checker};

/// Upper bound on the combinations of values that are checked per path.
const MOST_COMBINATIONS: usize = 1000;

impl Checker<'_> {
    /// One target per combination of values, and a warning if there are too many combinations. A path without variables has a single
    /// target.
    pub fn combined_targets(&self, file: SourceFile, name: &PathName) -> (Vec<Target>, Option<Diagnostic>) {
        let target = |role| self.db().target(file, name.as_str(), role);
        match combinations(self.db(), file, name, MOST_COMBINATIONS) {
            None => (vec![target(Role::Checked)], None),
            Some((values, warning)) => {
                let targets = values.into_iter().map(|values| target(Role::CheckedWith(values))).collect();
                (targets, warning.map(|warning| locate(self.db(), warning)))
            }
        }
    }

    /// Merges the results of all combinations of a path. Each fault is reported once, with values that cause it unless all of them do.
    pub fn merged(&self, results: &[CheckedTarget]) -> Vec<Diagnostic> {
        let mut merged: Vec<MergedFault<'_>> = Vec::new();
        let mut indices: BTreeMap<Identity<'_>, usize> = BTreeMap::new();
        for result in results {
            for diagnostic in &result.diagnostics {
                let index = *indices.entry(Identity::of(diagnostic)).or_insert(merged.len());
                match merged.get_mut(index) {
                    // A single result may contain the same fault with different arguments.
                    Some(combination) if combination.last.target == result.target => {}
                    Some(combination) => {
                        combination.count += 1;
                        combination.last = result;
                    }
                    None => merged.push(MergedFault { diagnostic, first: result, last: result, count: 1 }),
                }
            }
        }
        merged.iter().map(|merged| self.with_values(merged, results.len())).collect()
    }

    fn with_values(&self, merged: &MergedFault<'_>, all: usize) -> Diagnostic {
        let diagnostic = merged.diagnostic.clone();
        let target = merged.first.target;
        let Role::CheckedWith(values) = target.role(self.db()) else { return diagnostic };
        let named = vec![
            ("values", Value::quoted(shown(values))),
            ("name", Value::quoted(&**target.name(self.db()))),
        ];
        match merged.count {
            count if count == all => diagnostic,
            1 => diagnostic.note(&messages::WITH_VALUES, named),
            count => {
                let counts = [("others", (count - 1).into()), ("all", all.into())];
                diagnostic.note(&messages::WITH_MORE_VALUES, named.into_iter().chain(counts).collect())
            }
        }
    }
}

/// A fault, and the combinations in which it occurs.
struct MergedFault<'a> {
    diagnostic: &'a Diagnostic,
    first: &'a CheckedTarget,
    last: &'a CheckedTarget,
    count: usize,
}

/// Two diagnostics with the same identity are the same fault; the values in their messages do not matter.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Identity<'a> {
    message: &'static str,
    file: Option<&'a str>,
    path: Option<&'a str>,
    place: &'a Place,
    text: Option<&'a TextFault>,
}

impl<'a> Identity<'a> {
    fn of(diagnostic: &'a Diagnostic) -> Self {
        let Message { key, .. } = diagnostic.message;
        Self {
            message: key,
            file: diagnostic.file.as_ref().map(|file| file.as_str()),
            path: diagnostic.path.as_deref(),
            place: &diagnostic.place,
            text: diagnostic.text.as_ref(),
        }
    }
}

/// Formats values as in a subpath's text: `:A0,5 :BX`.
fn shown(values: &Bindings) -> String {
    let values: Vec<String> = values.iter().map(|(name, value)| format!(":{name}{value}")).collect();
    values.join(" ")
}
