//! Paths with bound variables.

use pathbuild_path::{Bindings, Path, WalkedPath};

use crate::db::Db;
use crate::inputs::{Settings, SourceFile};
use crate::queries::index::{BoundPath, NameKey, PathSummary, bind, parts, path_index, walk_within_limit};
use crate::queries::nearby_ends::LayerEnds;
use crate::queries::part::judge_path;
use crate::queries::raw::{raw_path, read_layers};

/// A path of a file with values for its variables. Created inside queries only.
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

/// The summary of a path. For example values it is part of the drawing's index.
pub fn summary<'db>(db: &'db dyn Db, instance: Instance<'db>) -> &'db PathSummary {
    match path_index(db, instance.file(db), instance.name(db)) {
        Some(index) if index.examples == *instance.bindings(db) => &index.summary,
        _ => summary_with_values(db, instance),
    }
}

#[salsa::tracked]
fn summary_with_values<'db>(db: &'db dyn Db, instance: Instance<'db>) -> PathSummary {
    let file = instance.file(db);
    let Some(raw) = raw_path(db, file, instance.name(db)) else { return PathSummary::default() };
    let read_all = || read_layers(db, file, &|_| true);
    let mut part_problems = Vec::new();
    let mut judge = |path: &Path, walked: &WalkedPath| {
        part_problems = judge_path(db, parts(db, file), path, walked);
    };
    let summary = PathSummary::new(db, raw, instance.bindings(db), &LayerEnds::new(&read_all), &mut judge);
    PathSummary { part_problems, ..summary }
}

/// The bound and checked path. Only programs need it, so few are kept.
#[salsa::tracked(lru = 256)]
pub fn path<'db>(db: &'db dyn Db, instance: Instance<'db>) -> BoundPath {
    let language = Settings::get(db).language(db);
    let raw = raw_path(db, instance.file(db), instance.name(db));
    raw.map(|raw| bind(raw, instance.bindings(db), language)).unwrap_or_default()
}

/// The walk along a path, for its program. Empty for an unsound path. Few are kept.
#[salsa::tracked(lru = 256)]
pub fn chains<'db>(db: &'db dyn Db, instance: Instance<'db>) -> WalkedPath {
    let language = Settings::get(db).language(db);
    path(db, instance).path.as_ref().map(|path| walk_within_limit(db, path, language)).unwrap_or_default()
}
