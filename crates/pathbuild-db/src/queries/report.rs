//! Findings as they are reported.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;

use super::closures::closure;
use super::index::file_index;
use super::keep_outs::entered_keep_outs;
use super::raw::locate_in;
use crate::db::Db;
use crate::inputs::{SourceFile, Target};

/// Findings about a file as a whole. Its paths are targets of their own.
pub fn check_file(db: &dyn Db, file: SourceFile) -> &[Diagnostic] {
    file_index(db, file).diagnostics()
}

/// Findings about a path, everything it embeds, and clamps in its way. They are not located yet.
pub fn check_target(db: &dyn Db, target: Target) -> impl Iterator<Item = &Diagnostic> {
    closure(db, target).diagnostics.iter().chain(entered_keep_outs(db, target))
}

/// Fills in line and handle of the element that a diagnostic is about. Called last, so that no query depends on lines.
pub fn locate(db: &dyn Db, mut diagnostic: Diagnostic) -> Diagnostic {
    if let (Some(file), Some(path), Some(_)) = (&diagnostic.file, &diagnostic.path, diagnostic.place.element)
    {
        let (file, path) = (db.file(file), PathName::new(path));
        locate_in(db, file, &path, &mut diagnostic);
    }
    diagnostic.place.element = None;
    diagnostic
}
