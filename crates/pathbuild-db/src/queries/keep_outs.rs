//! The clamps of a drawing, their places in a program, and the moves that hit them. (book: language/keep-outs)

use std::collections::BTreeMap;

use pathbuild_diagnostic::messages::paths as messages;
use pathbuild_diagnostic::{Diagnostic, Message, Number, Point, Sentence, Text, words};
use pathbuild_path::approx::coincide;
use pathbuild_path::{Curve, KeepOut, KeepOutMap, TipMove};
use pathbuild_toolpath::{ProbeOrigin, StepOrigin, kind_of_move, tip_move};
use rustc_hash::FxHashSet;

use super::programs::Occurrences;
use crate::database::Db;
use crate::inputs::{Settings, Target};
use crate::queries::closures::closure;
use crate::queries::index::keep_outs;
use crate::queries::programs::{TracedProgram, traced_program};

/// A clamp as placed in a program.
#[derive(Clone, Debug)]
pub struct PlacedKeepOut {
    /// The clamp, placed and raised.
    pub placed: KeepOut,
    /// The clamp as drawn.
    pub drawn: KeepOut,
    /// File name of the drawing that contains the clamp.
    pub drawing: String,
    /// Index into [`Trace::occurrences`](pathbuild_toolpath::Trace::occurrences) of a path in the drawing that contains the clamp.
    pub occurrence: u32,
}

/// Returns the clamps around the program of a target, from all its drawings. Duplicates at the same place are returned once. Empty without a program.
pub fn placed_keep_outs(db: &dyn Db, target: Target) -> Vec<PlacedKeepOut> {
    program_with_keep_outs(db, target).map(|traced| compute_placed_keep_outs(db, traced)).unwrap_or_default()
}

/// Returns the program of a target, if its drawings have clamps.
fn program_with_keep_outs(db: &dyn Db, target: Target) -> Option<&TracedProgram> {
    if has_keep_outs(db, target) { traced_program(db, target).as_deref() } else { None }
}

fn has_keep_outs(db: &dyn Db, target: Target) -> bool {
    let has_some = |file| !keep_outs(db, file).is_empty();
    Settings::get(db).language(db).keep_out.is_some()
        && closure(db, target).files(db).into_iter().any(has_some)
}

fn compute_placed_keep_outs(db: &dyn Db, traced: &TracedProgram) -> Vec<PlacedKeepOut> {
    let mut known = FxHashSet::default();
    let mut all = Vec::new();
    for (number, occurrence) in (0_u32..).zip(&traced.trace.occurrences) {
        let file = traced.paths[occurrence.id].file;
        for drawn in keep_outs(db, file) {
            let placed = drawn.placed(&occurrence.placement, occurrence.raised);
            let start = placed.outline.first().map_or(placed.at, Curve::start);
            let place = [placed.at.x, placed.at.y, start.x, start.y, placed.height].map(Number);
            if known.insert(place) {
                let drawing = file.path(db).file_name().unwrap_or_default().to_owned();
                all.push(PlacedKeepOut { placed, drawn: drawn.clone(), drawing, occurrence: number });
            }
        }
    }
    all
}

/// Returns PB407 for moves that hit clamps: one per kind of move, element and clamp, reported in the path that contains both.
pub(super) fn keep_out_collisions(db: &dyn Db, target: Target) -> &[Diagnostic] {
    // Most programs have no clamps around them; no query is needed then.
    if has_keep_outs(db, target) { moves_into_keep_outs(db, target) } else { &[] }
}

#[salsa::tracked]
fn moves_into_keep_outs(db: &dyn Db, target: Target) -> Vec<Diagnostic> {
    program_with_keep_outs(db, target).map(|traced| Search::new(db, traced).findings()).unwrap_or_default()
}

/// Searches a program for moves that hit clamps.
struct Search<'t> {
    db: &'t dyn Db,
    traced: &'t TracedProgram,
    clamps: Vec<PlacedKeepOut>,
}

/// Key of a finding, beside the kind of move: an element, and the clamp that its moves hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct CollisionKey {
    clamp: usize,
    /// The innermost path that contains both the clamp and the element.
    occurrence: u32,
    /// The element in that path.
    element: Option<u32>,
    /// The probe, if the probing program makes the moves.
    probe: Option<ProbeOrigin>,
}

/// Moves of one kind into one clamp: their number, and their lowest Z in mm.
#[derive(Clone, Copy, Debug)]
pub struct Collision {
    move_kind: &'static Text,
    moves: u64,
    lowest: f64,
    /// Whether one of the moves is not vertical. Only such a move can be led over the clamp.
    is_sideways: bool,
}

impl Collision {
    /// Creates a collision without moves.
    fn new(move_kind: &'static Text) -> Self {
        Self { move_kind, moves: 0, lowest: f64::INFINITY, is_sideways: false }
    }

    /// Counts a move that hits the clamp.
    fn add(&mut self, way: &TipMove) {
        self.moves += 1;
        self.lowest = self.lowest.min(way.lowest());
        self.is_sideways |= !way.is_vertical();
    }

    /// Returns PB407 without the places of the finding and of the clamp. Heights are given relative to the path, which is `raised` by this many mm.
    pub fn diagnostic(
        &self,
        message: &'static Message,
        tool: f64,
        clamp: &PlacedKeepOut,
        raised: f64,
    ) -> Diagnostic {
        Diagnostic::new(message)
            .with("tool", tool)
            .quoting("layer", clamp.drawn.layer.as_str())
            .with("height", clamp.placed.height - raised)
            .with("what", self.move_kind)
            .with("z", self.lowest - raised)
            .with("count", self.moves)
    }
}

/// Returns the collisions of a cutter's moves with clamps, ordered by the key that `key` derives from the origin of a move and the index of the clamp, and
/// by the English name of the kind of move. Each has the origin of its first move.
pub fn collisions<O: Copy, K: Ord>(
    clamps: &[PlacedKeepOut],
    cutter: f64,
    moves: impl Iterator<Item = (O, &'static Text, TipMove)>,
    key: impl Fn(O, usize) -> K,
) -> BTreeMap<(K, &'static str), (O, Collision)> {
    let map = KeepOutMap::new(clamps.iter().map(|clamp| (clamp.placed.height, &*clamp.placed.outline)));
    let mut collisions = BTreeMap::new();
    for (origin, move_kind, way) in moves {
        for clamp in map.entered_clamps(&way, cutter / 2.0, 0.0) {
            let entry = collisions.entry((key(origin, clamp), move_kind.en));
            let (_, collision) = entry.or_insert((origin, Collision::new(move_kind)));
            collision.add(&way);
        }
    }
    collisions
}

impl<'t> Search<'t> {
    fn new(db: &'t dyn Db, traced: &'t TracedProgram) -> Self {
        Self { db, traced, clamps: compute_placed_keep_outs(db, traced) }
    }

    fn findings(&self) -> Vec<Diagnostic> {
        let TracedProgram { program, trace, .. } = self.traced;
        // The last lift belongs to no step.
        let milling = program
            .moves()
            .filter_map(|(number, movement)| Some((*trace.steps.get(number as usize - 1)?, None, movement)));
        let probing = program.probing_moves().map(|(number, movement)| {
            let probe = trace.probes[number];
            (StepOrigin { occurrence: probe.occurrence, element: None }, Some(probe), movement)
        });
        let moves = milling.chain(probing).filter_map(|(step, probe, movement)| {
            Some(((step, probe), kind_of_move(&movement), tip_move(&movement)?))
        });
        let key = |(step, probe), clamp: usize| {
            let (occurrence, element) =
                self.occurrences().innermost_common_path(step, self.clamps[clamp].occurrence);
            CollisionKey { clamp, occurrence, element, probe }
        };
        collisions(&self.clamps, program.largest_cutter(), moves, key)
            .iter()
            .map(|((entry, _), ((first, _), collision))| self.finding(entry, first.occurrence, collision))
            .collect()
    }

    fn finding(&self, entry: &CollisionKey, mover: u32, collision: &Collision) -> Diagnostic {
        let TracedProgram { program, trace, .. } = self.traced;
        let around = &trace.occurrences[entry.occurrence as usize];
        let clamp = &self.clamps[entry.clamp];
        let message = match entry.probe {
            Some(_) => &messages::PROBING_INTO_CLAMP,
            None if collision.move_kind != &words::RAPID_MOVE || !collision.is_sideways => {
                &messages::CUTS_INTO_CLAMP
            }
            None if mover != entry.occurrence => &messages::COMPONENT_INTO_CLAMP,
            None => &messages::MOVES_INTO_CLAMP,
        };
        let found = collision
            .diagnostic(message, program.largest_cutter(), clamp, around.raised)
            .with("clamp", self.place_of(clamp, entry.occurrence));
        let all = self.occurrences();
        let found = if mover == entry.occurrence {
            found
        } else {
            let sweep_height = clamp.placed.height - trace.occurrences[mover as usize].raised;
            found
                .quoting("component", all.bound_path(mover).path.name.as_str())
                .with("sweep_height", sweep_height)
        };
        match entry.probe.filter(|probe| probe.occurrence == entry.occurrence) {
            Some(ProbeOrigin { occurrence, probe }) => {
                all.at_origin(occurrence, &all.bound_path(occurrence).path.probes[probe].origin, found)
            }
            None => all.at_element(entry.occurrence, entry.element, found),
        }
    }

    /// Describes the place of a clamp in the drawing of a path, which contains the clamp itself or embeds a drawing that does.
    fn place_of(&self, clamp: &PlacedKeepOut, occurrence: u32) -> Sentence {
        let TracedProgram { paths, trace, .. } = self.traced;
        let [around, owner] =
            [occurrence, clamp.occurrence].map(|occurrence| &trace.occurrences[occurrence as usize]);
        let (at, drawn) = (around.placement.unplace(clamp.placed.at), clamp.drawn.at);
        if paths[around.id].file == paths[owner.id].file && coincide(at, drawn) {
            return Sentence::new(&words::CLAMP_OF_DRAWING).with("point", Point::new(drawn.x, drawn.y));
        }
        // Round, because placements of one clamp in several programs differ slightly, and findings about it are compared exactly.
        let [x, y] = [at.x, at.y].map(|coordinate| (coordinate * 1000.0).round() / 1000.0);
        Sentence::new(&words::CLAMP_OF_COMPONENT)
            .quoting("drawing", &clamp.drawing)
            .with("point", Point::new(x, y))
    }

    fn occurrences(&self) -> Occurrences<'t> {
        Occurrences { db: self.db, traced: self.traced }
    }
}
