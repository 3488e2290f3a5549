//! Binding and walking along a path, without its bugs.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::{Bindings, Language, Path, RawPath, Walked};

use crate::bugs::catch_bugs;
use crate::db::Db;

/// A path, and what is wrong with its drawing or its values.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BoundPath {
    /// The path, where nothing is an error.
    pub path: Option<Path>,
    /// What is wrong with the drawing alone or, where nothing is, with the values.
    pub diagnostics: Vec<Diagnostic>,
}

/// Binds and checks a path's parameters.
pub(super) fn bind(raw: &RawPath, bindings: &Bindings, language: &Language) -> BoundPath {
    let mut diagnostics = raw.diagnostics.clone();
    if !raw.is_sound() {
        return BoundPath { path: None, diagnostics };
    }
    let bound = catch_bugs(|| pathbuild_path::bind(raw, bindings, language));
    let (path, found) = bound.unwrap_or_else(|bug| (None, vec![bug.in_path(raw.name.as_str())]));
    diagnostics.extend(found);
    BoundPath { path, diagnostics }
}

/// Walks along a path.
pub(super) fn walk(db: &dyn Db, path: &Path, language: &Language) -> Walked {
    let checkpoint = || db.unwind_if_revision_cancelled();
    catch_bugs(|| pathbuild_path::walk_watched(path, language.join_tolerance, &checkpoint))
        .unwrap_or_else(|bug| Walked::failed(bug.in_path(path.name.as_str())))
}
