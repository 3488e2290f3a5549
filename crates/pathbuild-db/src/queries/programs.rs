//! Queries for displays: programs with the origins of their moves, the places in a program at which findings about two of its paths are
//! reported, the drawn paths, and the layers of a drawing without paths or clamps.

use std::sync::Arc;

use pathbuild_diagnostic::messages::gcode as messages;
use pathbuild_diagnostic::{Code, Diagnostic, Point, TraceStep, Value};
use pathbuild_dxf::Drawing;
use pathbuild_path::{
    Bindings, ElementParameters, Origin, Path, PathName, PathOptions, PathRole, RawPath, Segment,
    SegmentKind, SourceMap, WalkedPath, Xy, element_parameters,
};
use pathbuild_toolpath::{FoldPaths, Occurrence, Program, StepOrigin, Trace, fold_traced};
use rustc_hash::FxHashMap;

use super::embedding::{Instance, chains, path};
use crate::database::Db;
use crate::inputs::{Role, Settings, SourceFile, Target};
use crate::queries::closures::closure;
use crate::queries::embedding::{Outcome, direct_embeddings};
use crate::queries::raw::{raw_file, read_layers};

/// A program with the origin of each step.
#[derive(Debug)]
pub struct TracedProgram {
    /// The program, equal to that of [`program`](crate::queries::program) where that has one.
    pub program: Program,
    /// The origin of each step. Paths are given as indices into [`TracedProgram::paths`].
    pub trace: Trace<usize>,
    /// The paths in the program with their values, each once.
    pub paths: Vec<BoundPath>,
}

/// A path of a program, with values for its variables.
#[derive(Debug)]
pub struct BoundPath {
    /// The drawing that defines the path.
    pub file: SourceFile,
    /// The path with all parameters bound.
    pub path: Arc<Path>,
    /// The values of the path's variables.
    pub bindings: Bindings,
}

/// A path as it is drawn, with its positions in the file.
#[derive(Clone, Copy, Debug)]
pub struct DrawnPath<'db> {
    /// The drawn elements.
    pub raw: &'db RawPath,
    /// The positions of the elements in the file.
    pub positions: &'db SourceMap,
}

/// Returns the heights in mm by which embedded paths are raised in the program of a target, in the order in which they begin. Empty if none is raised.
pub fn heights_of_shims(db: &dyn Db, target: Target) -> Vec<f64> {
    let is_raised =
        |segment: &Segment| matches!(&segment.kind, SegmentKind::Subpath(embedded) if embedded.height != 0.0);
    let has_shims = |instance: &Instance<'_>| {
        path(db, *instance).path.as_ref().is_some_and(|path| path.segments.iter().any(is_raised))
    };
    if !closure(db, target).reached.iter().any(has_shims) {
        return Vec::new();
    }
    let Some(traced) = traced_program(db, target) else { return Vec::new() };
    let embedded = traced.trace.occurrences.iter().filter(|occurrence| occurrence.parent.is_some());
    embedded.map(|occurrence| occurrence.raised).collect()
}

/// Returns the program of a target with the origins of its steps, even if it harms a part; `None` if its moves are unknown. Only the last one is
/// kept.
#[salsa::tracked(no_eq, lru = 1)]
pub fn traced_program(db: &dyn Db, target: Target) -> Option<Arc<TracedProgram>> {
    let closure = closure(db, target);
    if closure.has_unknown_moves() {
        return None;
    }
    let drawing = target.file(db).path(db).file_name().unwrap_or_default();
    let root = closure.root?;
    let (program, trace) = fold_traced(&ClosurePaths { db }, root, drawing, fold_options(db, target, root));
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
    let trace = Trace { occurrences: occurrences.collect(), steps: trace.steps, probes: trace.probes };
    let bound = |instance: Instance<'_>| {
        let path = path(db, instance).path.clone()?;
        Some(BoundPath { file: instance.file(db), path, bindings: instance.bindings(db).clone() })
    };
    let paths = instances.into_iter().map(bound).collect::<Option<Vec<_>>>()?;
    Some(Arc::new(TracedProgram { program, trace, paths }))
}

/// Returns the options with which a target is folded. A checked path that has variables, or no S in the options, gets the sweep height that it
/// has when embedded.
pub(super) fn fold_options(db: &dyn Db, target: Target, root: Instance<'_>) -> PathOptions {
    let mut options = Settings::get(db).fold(db);
    let is_only_embedded = !root.bindings(db).is_empty();
    if *target.role(db) != Role::Emitted && (is_only_embedded || options.sweep_height.is_none()) {
        options.sweep_height = path(db, root).path.as_deref().map(Path::embedded_sweep_height);
    }
    options
}

/// Returns a path as it is drawn; `None` if the drawing has no path of that name.
pub fn drawn_path<'db>(db: &'db dyn Db, file: SourceFile, name: &PathName) -> Option<DrawnPath<'db>> {
    let entry = raw_file(db, file).entry(name)?;
    Some(DrawnPath { raw: &entry.raw, positions: &entry.map })
}

/// Returns the effective parameters of each element of a path for these variable values. S is the same as in [`traced_program`]: a path that has
/// variables or lacks an option is treated as embedded.
pub fn effective_parameters(
    db: &dyn Db,
    file: SourceFile,
    name: &PathName,
    bindings: &Bindings,
    is_emitted: bool,
) -> Vec<ElementParameters> {
    let settings = Settings::get(db);
    let options = settings.fold(db);
    let is_emitted = is_emitted && bindings.is_empty() && options.sweep_height.is_some();
    let role = if is_emitted { PathRole::Emitted } else { PathRole::Embedded };
    let of_path = |raw: &RawPath| element_parameters(raw, bindings, &options, role, settings.language(db));
    raw_file(db, file).entry(name).map(|entry| of_path(&entry.raw)).unwrap_or_default()
}

/// Returns the contents of a drawing's layers that hold neither paths nor clamps. The drawing is read again for this; only the last one is kept.
#[salsa::tracked(no_eq, lru = 1)]
pub fn remaining_layers(db: &dyn Db, file: SourceFile) -> Arc<Drawing> {
    let language = Settings::get(db).language(db);
    let is_other = |layer: &str| !language.path_pattern.is_layer(layer) && !language.is_keep_out(layer);
    Arc::new(read_layers(db, file, &is_other))
}

/// The paths of a closure with known moves, as the fold accesses them.
pub(super) struct ClosurePaths<'db> {
    pub(super) db: &'db dyn Db,
}

impl<'db> FoldPaths for ClosurePaths<'db> {
    type Id = Instance<'db>;

    fn path(&self, id: Instance<'db>) -> &Path {
        path(self.db, id).path.as_ref().expect("a path of a closure without errors is bound")
    }

    fn walked(&self, id: Instance<'db>) -> &WalkedPath {
        chains(self.db, id)
    }

    fn embedded(&self, id: Instance<'db>, segment: usize) -> Option<Instance<'db>> {
        let embedded = direct_embeddings(self.db, id);
        let place = embedded.binary_search_by_key(&segment, |embedding| embedding.segment).ok()?;
        match &embedded[place].outcome {
            Outcome::Found { child, .. } => Some(*child),
            _ => None,
        }
    }

    fn checkpoint(&self) {
        self.db.unwind_if_revision_cancelled();
    }
}

impl TracedProgram {
    /// Places a finding about a step of the program, by its number from 1, at the element to which the step belongs. The point and the heights of
    /// PB740, PB741 and PB793 become those of that element's drawing.
    pub fn at_element_of_step(&self, db: &dyn Db, step: u32, mut found: Diagnostic) -> Diagnostic {
        let last = self.trace.steps.len().saturating_sub(1);
        let Some(origin) = self.trace.steps.get((step as usize).saturating_sub(1).min(last)) else {
            return found;
        };
        let around = &self.trace.occurrences[origin.occurrence as usize];
        if found.message == &messages::RAPID_IN_MATERIAL && origin.element.is_some() {
            found.message = &messages::SWEEP_IN_MATERIAL;
        } else if found.message == &messages::RAPID_PLUNGE {
            found.message = &messages::PLUNGE_IN_DRAWING;
        }
        let has_places =
            matches!(found.code(), Code::RapidInMaterial | Code::RapidPlunge | Code::CutInHigherMaterial);
        for (name, value) in found.arguments.iter_mut().filter(|_| has_places) {
            match (*name, &*value) {
                ("z" | "height", Value::Number(height)) => *value = (height.0 - around.raised).into(),
                ("point", Value::Point(point)) => {
                    let drawn = around.placement.unplace(Xy::new(point.x.0, point.y.0));
                    *value = Point::new(drawn.x, drawn.y).into();
                }
                _ => {}
            }
        }
        Occurrences { db, traced: self }.at_element(origin.occurrence, origin.element, found)
    }
}

/// The occurrences of paths in a program.
#[derive(Clone, Copy)]
pub(super) struct Occurrences<'t> {
    pub(super) db: &'t dyn Db,
    pub(super) traced: &'t TracedProgram,
}

impl<'t> Occurrences<'t> {
    /// Returns the innermost path that contains both an element and another path, and the element of that innermost path that is the given element or
    /// embeds it.
    pub(super) fn innermost_common_path(self, mut at: StepOrigin, other: u32) -> (u32, Option<u32>) {
        let around_other: Vec<u32> = self.path_and_embedders(other).collect();
        while !around_other.contains(&at.occurrence) {
            let Some(parent) = self.parent(at.occurrence) else { break };
            at = parent;
        }
        (at.occurrence, at.element)
    }

    /// Iterates over a path and the paths that embed it, from the inside out.
    pub(super) fn path_and_embedders(self, occurrence: u32) -> impl Iterator<Item = u32> + 't {
        let parent = move |inner: &u32| self.parent(*inner).map(|outer| outer.occurrence);
        std::iter::successors(Some(occurrence), parent)
    }

    fn parent(self, occurrence: u32) -> Option<StepOrigin> {
        self.traced.trace.occurrences[occurrence as usize].parent
    }

    /// Places a finding at an element of a path, or at the path's start.
    pub(super) fn at_element(self, occurrence: u32, element: Option<u32>, found: Diagnostic) -> Diagnostic {
        let path = &self.bound_path(occurrence).path;
        let element = element.and_then(|element| path.drawn.elements.get(element as usize));
        let origin = element.map_or(path.start_origin.clone(), |element| path.drawn.origin(element));
        self.at_origin(occurrence, &origin, found)
    }

    /// Places a finding at something drawn in a path.
    pub(super) fn at_origin(self, occurrence: u32, origin: &Origin, found: Diagnostic) -> Diagnostic {
        let bound = self.bound_path(occurrence);
        let found = found.in_file(bound.file.path(self.db)).in_path(bound.path.name.as_str());
        Diagnostic { trace: self.embeddings_leading_to(occurrence), ..origin.at(found) }
    }

    /// Returns the path of an occurrence.
    pub(super) fn bound_path(self, occurrence: u32) -> &'t BoundPath {
        &self.traced.paths[self.traced.trace.occurrences[occurrence as usize].id]
    }

    /// Returns the embeddings that lead to a path, outermost first.
    fn embeddings_leading_to(self, occurrence: u32) -> Vec<TraceStep> {
        let step = |inner: u32| {
            let StepOrigin { occurrence, element } = self.parent(inner)?;
            let bound = &self.traced.paths[self.traced.trace.occurrences[occurrence as usize].id];
            let element = bound.path.drawn.elements.get(element? as usize)?;
            Some(TraceStep {
                file: bound.file.path(self.db).clone(),
                path: bound.path.name.as_str().into(),
                point: bound.path.drawn.origin(element).point,
            })
        };
        let mut steps: Vec<TraceStep> = self.path_and_embedders(occurrence).filter_map(step).collect();
        steps.reverse();
        steps
    }
}
