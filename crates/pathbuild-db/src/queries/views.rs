//! What somebody wants to see: programs with where their moves come from, what is drawn, and what else there is in a drawing.

use std::sync::Arc;

use pathbuild_dxf::Drawing;
use pathbuild_path::{Bindings, InForce, Path, PathName, PathRole, RawPath, SourceMap, parameters_in_force};
use pathbuild_toolpath::{Occurrence, Program, Trace, fold_traced};
use rustc_hash::FxHashMap;

use super::closures::closure;
use super::instance::{Instance, path};
use super::programs::Embedded;
use super::raw::raw_file;
use super::rereading::read_layers;
use crate::db::Db;
use crate::inputs::{Role, SourceFile, Target};
use crate::settings::Settings;

/// A program, and where each of its steps comes from.
#[derive(Debug)]
pub struct Traced {
    /// The same as [`program`](super::program) gives for what is emitted. What is only checked sweeps as a check has it.
    pub program: Program,
    /// Its paths are indices into [`Traced::parts`].
    pub trace: Trace<usize>,
    /// The paths in the program with their values, each once.
    pub parts: Vec<Part>,
}

/// A path with values for its variables.
#[derive(Debug)]
pub struct Part {
    /// The drawing that defines it.
    pub file: SourceFile,
    /// The path, every parameter known.
    pub path: Path,
    /// The values.
    pub bindings: Bindings,
}

/// A path as it is drawn, and where in the file.
#[derive(Clone, Copy, Debug)]
pub struct DrawnPath<'db> {
    /// What is drawn.
    pub raw: &'db RawPath,
    /// Where that is in the file.
    pub positions: &'db SourceMap,
}

/// The program of a target with its origins; `None` where there is no program. One is kept.
#[salsa::tracked(no_eq, lru = 1)]
pub fn traced_program(db: &dyn Db, target: Target) -> Option<Arc<Traced>> {
    let closure = closure(db, target);
    if closure.has_errors() || !closure.missing_options.is_empty() {
        return None;
    }
    let drawing = target.file(db).path(db).file_name().unwrap_or_default();
    let root = closure.root?;
    let mut options = Settings::get(db).fold(db);
    let is_only_embedded = !root.bindings(db).is_empty();
    if *target.role(db) != Role::Emitted && (is_only_embedded || options.sweep_height.is_none()) {
        // As a check has it.
        options.sweep_height = path(db, root).path.as_ref().map(Path::embedded_sweep_height);
    }
    let (program, trace) = fold_traced(&Embedded { db }, root, drawing, options);
    let mut instances: Vec<Instance<'_>> = Vec::new();
    let mut numbers: FxHashMap<Instance<'_>, usize> = FxHashMap::default();
    let occurrences = trace.occurrences.into_iter().map(|occurrence| {
        let id = *numbers.entry(occurrence.id).or_insert_with(|| {
            instances.push(occurrence.id);
            instances.len() - 1
        });
        let Occurrence { parent, placement, raised, sweep_height, .. } = occurrence;
        Occurrence { id, parent, placement, raised, sweep_height }
    });
    let trace = Trace { occurrences: occurrences.collect(), steps: trace.steps };
    let part = |instance: Instance<'_>| {
        let path = path(db, instance).path.clone()?;
        Some(Part { file: instance.file(db), path, bindings: instance.bindings(db).clone() })
    };
    let parts = instances.into_iter().map(part).collect::<Option<Vec<_>>>()?;
    Some(Arc::new(Traced { program, trace, parts }))
}

/// A path as it is drawn; `None` where the drawing has none of that name.
pub fn drawn_path<'db>(db: &'db dyn Db, file: SourceFile, name: &PathName) -> Option<DrawnPath<'db>> {
    let entry = raw_file(db, file).entry(name)?;
    Some(DrawnPath { raw: &entry.raw, positions: &entry.map })
}

/// The effective parameters of each element of a path with these values of its variables. S is as in [`traced_program`]: where an option is
/// missing, and for paths with variables, the path counts as embedded.
pub fn in_force(
    db: &dyn Db,
    file: SourceFile,
    name: &PathName,
    bindings: &Bindings,
    is_emitted: bool,
) -> Vec<InForce> {
    let settings = Settings::get(db);
    let options = settings.fold(db);
    let is_emitted = is_emitted && bindings.is_empty() && options.sweep_height.is_some();
    let role = if is_emitted { PathRole::Emitted } else { PathRole::Embedded };
    let of_path = |raw: &RawPath| parameters_in_force(raw, bindings, &options, role, settings.language(db));
    raw_file(db, file).entry(name).map(|entry| of_path(&entry.raw)).unwrap_or_default()
}

/// What is on the layers of a drawing that hold neither paths nor clamps. The drawing is read once more for that. One is kept.
#[salsa::tracked(no_eq, lru = 1)]
pub fn other_layers(db: &dyn Db, file: SourceFile) -> Arc<Drawing> {
    let language = Settings::get(db).language(db);
    let is_other = |layer: &str| !language.path_pattern.is_layer(layer) && !language.is_keep_out(layer);
    Arc::new(read_layers(db, file, &is_other))
}
