//! Binding and walking along a path, without its bugs.

use std::panic::resume_unwind;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::{Bindings, Language, Path, RawPath, Walked};

use crate::bugs::{TooLong, catch_bugs};
use crate::db::Db;
use crate::settings::Settings;

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

/// Walks along a path. What takes too long is PB005 here, and not only where it is watched: indexes of drawings are made before anybody asks
/// for a target.
pub(super) fn walk(db: &dyn Db, path: &Path, language: &Language) -> Walked {
    catch_bugs(|| walk_in_time(db, path, language)).unwrap_or_else(|problem| {
        // Another time the machine may be less busy: whoever asks after the next change walks again.
        db.report_untracked_read();
        Walked::failed(problem.in_path(path.name.as_str()))
    })
}

/// The same where findings have been asked for already: unwinds with what keeps it from the end, which nobody would hear of else.
pub(super) fn walk_in_time(db: &dyn Db, path: &Path, language: &Language) -> Walked {
    let limit = Settings::get(db).reading(db).walk_time;
    let begun = db.system().now();
    let checkpoint = || {
        db.unwind_if_revision_cancelled();
        if begun.is_some_and(|begun| begun.elapsed() > limit) {
            resume_unwind(Box::new(TooLong(limit)));
        }
    };
    pathbuild_path::walk_watched(path, language.join_tolerance, &checkpoint)
}
