//! What is wrong, as it is reported.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;

use super::raw::{file_diagnostics, position_of};
use super::reach::closure;
use crate::database::Db;
use crate::inputs::{SourceFile, Target};

/// What is wrong with a file as a whole; its paths are targets of their own.
pub fn check_file(db: &dyn Db, file: SourceFile) -> &[Diagnostic] {
    file_diagnostics(db, file)
}

/// What is wrong with a path and all it embeds, not located yet.
pub fn check_target(db: &dyn Db, target: Target) -> &[Diagnostic] {
    &closure(db, target).diagnostics
}

/// Fills in the line and handle of the element that a diagnostic is about. Asked at the very end, so that no query depends on lines.
pub fn locate(db: &dyn Db, mut diagnostic: Diagnostic) -> Diagnostic {
    if let (Some(file), Some(path)) = (&diagnostic.file, &diagnostic.path) {
        let (file, path) = (db.file(file), PathName::new(path));
        position_of(db, file, &path, &mut diagnostic);
    }
    diagnostic.place.element = None;
    diagnostic
}
