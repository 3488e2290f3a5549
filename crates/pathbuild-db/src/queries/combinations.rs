//! The combinations of variable values that a path is checked with. (book: language/variables)

use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, Severity};
use pathbuild_path::{Bindings, Combinations, PathName};

use super::raw::raw_by_name;
use crate::db::Db;
use crate::inputs::SourceFile;

/// The combinations of a path's variable values, with a warning if there are more than `limit`. `None` for a path without variables or with
/// errors.
pub fn combinations(
    db: &dyn Db,
    file: SourceFile,
    name: &PathName,
    limit: usize,
) -> Option<(Vec<Bindings>, Option<Diagnostic>)> {
    let raw = raw_by_name(db, file, name).filter(|raw| raw.is_sound() && !raw.definitions.is_empty())?;
    let Combinations { chosen, all } = Combinations::new(&raw.definitions, limit);
    let is_cut = (chosen.len() as u64) < all;
    let warning = || {
        let mut warning = Diagnostic::new(&messages::COMBINATIONS_CUT)
            .with("checked", chosen.len())
            .with("all", all)
            .in_path(raw.name.as_str())
            .in_file(file.path(db));
        warning.severity = Severity::Warning;
        match &raw.start {
            Some(start) => start.origin.at(warning),
            None => warning,
        }
    };
    let warning = is_cut.then(warning);
    Some((chosen, warning))
}
