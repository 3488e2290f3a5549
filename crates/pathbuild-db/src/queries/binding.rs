//! Binds and walks a path, guarded against panics.

use std::panic::resume_unwind;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::{Bindings, ExaminedPath, Language, Path, RawPath, WalkedPath};

use crate::bugs::{TimeoutPanic, catch_bugs};
use crate::db::Db;
use crate::settings::Settings;

/// A bound path and its diagnostics.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BoundPath {
    /// The path, unless a diagnostic is an error.
    pub path: Option<Path>,
    /// Diagnostics of the drawing and of the values.
    pub diagnostics: Vec<Diagnostic>,
}

/// Binds and checks the parameters of a path for its program.
pub(super) fn bind(raw: &RawPath, bindings: &Bindings, language: &Language) -> BoundPath {
    let BoundPath { path, diagnostics } = examine(raw, bindings, language);
    BoundPath { path: path.filter(|path| !path.has_faults()), diagnostics }
}

/// Binds a path as far as it is known, even if it has errors, so that its other errors are found as well.
pub(super) fn examine(raw: &RawPath, bindings: &Bindings, language: &Language) -> BoundPath {
    let mut diagnostics = raw.diagnostics.clone();
    let examined = catch_bugs(|| pathbuild_path::examine(raw, bindings, language));
    let ExaminedPath { path, problems } = examined
        .unwrap_or_else(|bug| ExaminedPath { path: None, problems: vec![bug.in_path(raw.name.as_str())] });
    diagnostics.extend(problems);
    BoundPath { path, diagnostics }
}

/// Walks a path. The time limit is enforced here as PB005, not only by the driver, because indexes are built before any target is queried.
pub(super) fn walk(db: &dyn Db, path: &Path, language: &Language) -> WalkedPath {
    catch_bugs(|| walk_within_limit(db, path, language)).unwrap_or_else(|problem| {
        // The machine may be less busy next time, so the result is not memoized beyond this revision.
        db.report_untracked_read();
        WalkedPath::failed(problem.in_path(path.name.as_str()))
    })
}

/// Walks a path whose findings are known already. Unwinds at the time limit, which could not be reported here.
pub(super) fn walk_within_limit(db: &dyn Db, path: &Path, language: &Language) -> WalkedPath {
    let limit = Settings::get(db).reading(db).walk_time;
    let begun = db.system().now();
    let checkpoint = || {
        db.unwind_if_revision_cancelled();
        if begun.is_some_and(|begun| begun.elapsed() > limit) {
            resume_unwind(Box::new(TimeoutPanic(limit)));
        }
    };
    pathbuild_path::walk_watched(path, language.join_tolerance, &checkpoint)
}
