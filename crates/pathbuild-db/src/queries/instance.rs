//! Paths with their variables bound, and what is done along them.

use std::panic::{AssertUnwindSafe, catch_unwind};

use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::{Bindings, Path, RawPath, Walked};

use super::raw::{NameKey, raw_path};
use super::reading::internal_error;
use super::surveys::surveyed;
use crate::database::Db;
use crate::inputs::SourceFile;
use crate::settings::Settings;

/// A path of a file with values for its variables. Made inside queries only.
#[salsa::interned(debug)]
pub struct Instance<'db> {
    /// The drawing that defines it.
    #[returns(copy)]
    pub file: SourceFile,
    /// The path.
    #[returns(copy)]
    pub name: NameKey<'db>,
    /// The values.
    #[returns(ref)]
    pub bindings: Bindings,
}

impl<'db> Instance<'db> {
    /// What is drawn. It is there wherever an instance was made; after an edit it may be gone.
    pub fn raw(self, db: &'db dyn Db) -> Option<&'db RawPath> {
        raw_path(db, self.file(db), self.name(db))
    }
}

/// A path, and what is wrong with its drawing or its values.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BoundPath {
    /// The path, where nothing is an error.
    pub path: Option<Path>,
    /// What is wrong with the drawing alone or, where nothing is, with the values.
    pub diagnostics: Vec<Diagnostic>,
}

/// Binds and checks a path's parameters.
#[salsa::tracked(lru = 0)]
pub fn path<'db>(db: &'db dyn Db, instance: Instance<'db>) -> BoundPath {
    bind(db, instance)
}

/// The path, where nothing is an error: for whoever asks what it embeds.
pub(super) fn bound_path<'db>(db: &'db dyn Db, instance: Instance<'db>) -> Option<&'db Path> {
    let survey = surveyed(db, instance.file(db));
    let known = survey.and_then(|survey| survey.path(&instance.name(db).name(db)));
    let kept = known.and_then(|known| known.path_with(instance.bindings(db)));
    kept.or_else(|| path(db, instance).path.as_ref())
}

/// Walks along a path. Empty where there is no sound path.
#[salsa::tracked(lru = 0)]
pub fn chains<'db>(db: &'db dyn Db, instance: Instance<'db>) -> Walked {
    path(db, instance).path.as_ref().map(|path| walk(db, path)).unwrap_or_default()
}

/// What [`path`] gives, not kept: whoever judges a path needs it once, and making it again takes less than keeping it.
pub(super) fn bind<'db>(db: &'db dyn Db, instance: Instance<'db>) -> BoundPath {
    instance.raw(db).map(|raw| bind_raw(db, raw, instance.bindings(db))).unwrap_or_default()
}

/// The same of a raw path.
pub(super) fn bind_raw(db: &dyn Db, raw: &RawPath, bindings: &Bindings) -> BoundPath {
    let mut diagnostics = raw.diagnostics.clone();
    if !raw.is_sound() {
        return BoundPath { path: None, diagnostics };
    }
    let language = Settings::get(db).language(db);
    let bind = || pathbuild_path::bind(raw, bindings, language);
    let (path, found) = catch_unwind(AssertUnwindSafe(bind))
        .unwrap_or_else(|payload| (None, vec![internal_error(&*payload).in_path(raw.name.as_str())]));
    diagnostics.extend(found);
    BoundPath { path, diagnostics }
}

/// What [`chains`] gives, not kept.
pub(super) fn walk(db: &dyn Db, path: &Path) -> Walked {
    let join_tolerance = Settings::get(db).language(db).join_tolerance;
    catch_unwind(AssertUnwindSafe(|| pathbuild_path::walk(path, join_tolerance)))
        .unwrap_or_else(|payload| Walked::failed(internal_error(&*payload).in_path(path.name.as_str())))
}

/// See [`bound`](super::bound).
pub(super) fn bound(db: &mut dyn Db, kept: usize) {
    path::set_lru_capacity(db, kept);
    chains::set_lru_capacity(db, kept);
}
