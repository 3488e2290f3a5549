//! Cuts into the parts of other components of a project. (book: language/part)

use std::collections::BTreeMap;

use pathbuild_diagnostic::messages::part as messages;
use pathbuild_diagnostic::{Diagnostic, Point};
use pathbuild_path::{Part, PartSettings, Placement, Way, Xy, cuts_into};
use pathbuild_toolpath::{StepOrigin, cutting_way};

use super::programs::Occurrences;
use crate::database::Db;
use crate::inputs::{Settings, SourceFile, Target};
use crate::queries::closures::closure;
use crate::queries::index::parts;
use crate::queries::part::soften;
use crate::queries::programs::{TracedProgram, traced_program};

/// PB214 for cuts of one embedded path into the part of another: one per part and element, reported in the path that contains both.
pub(super) fn gouged_neighbours(db: &dyn Db, target: Target) -> &[Diagnostic] {
    // Most programs have no parts in them; no query is needed then.
    if has_neighbours(db, target) { cuts_into_neighbours(db, target) } else { &[] }
}

fn has_neighbours(db: &dyn Db, target: Target) -> bool {
    let has_parts = |file| !parts(db, file).is_empty();
    Settings::get(db).language(db).part.is_some()
        && closure(db, target).reached.len() > 1
        && closure(db, target).files(db).into_iter().any(has_parts)
}

#[salsa::tracked]
fn cuts_into_neighbours(db: &dyn Db, target: Target) -> Vec<Diagnostic> {
    let (Some(settings), Some(traced)) =
        (&Settings::get(db).language(db).part, traced_program(db, target).as_deref())
    else {
        return Vec::new();
    };
    let mut found = NeighbourSearch::new(db, traced, settings).findings();
    for problem in &mut found {
        soften(db, problem);
    }
    found
}

/// Searches a program for cuts into the parts of others.
struct NeighbourSearch<'t> {
    db: &'t dyn Db,
    traced: &'t TracedProgram,
    settings: &'t PartSettings,
    /// The cutting moves with their radii and origins.
    cuts: Vec<(Way, f64)>,
    origins: Vec<StepOrigin>,
}

/// A part as placed in a program.
struct PlacedPart {
    part: Part,
    occurrence: u32,
    file: SourceFile,
    placement: Placement,
    raised: f64,
}

/// Distance in mm between two places of a drawing below which they are the same: paths of one drawing that are embedded together.
const SAME_PLACE: f64 = 0.01;

impl<'t> NeighbourSearch<'t> {
    fn new(db: &'t dyn Db, traced: &'t TracedProgram, settings: &'t PartSettings) -> Self {
        let TracedProgram { program, trace, parts } = traced;
        let (mut cuts, mut origins) = (Vec::new(), Vec::new());
        for (number, movement) in program.moves() {
            let origin = trace.steps.get(number as usize - 1).filter(|origin| origin.element.is_some());
            if let (Some(origin), Some(way)) = (origin, cutting_way(&movement)) {
                let path = &parts[trace.occurrences[origin.occurrence as usize].id].path;
                cuts.push((way, path.tool / 2.0));
                origins.push(*origin);
            }
        }
        Self { db, traced, settings, cuts, origins }
    }

    fn findings(&self) -> Vec<Diagnostic> {
        let mut found = Vec::new();
        for placed in self.placed() {
            let others: Vec<usize> =
                (0..self.cuts.len()).filter(|cut| self.is_foreign(&placed, self.origins[*cut])).collect();
            let cuts: Vec<(Way, f64)> = others.iter().map(|cut| self.cuts[*cut]).collect();
            let mut deepest: BTreeMap<(u32, Option<u32>), (Xy, f64, f64)> = BTreeMap::new();
            for (number, at, depth, _) in
                cuts_into(&placed.part, &cuts, placed.raised, self.settings.tolerance)
            {
                let occurrences = Occurrences { db: self.db, traced: self.traced };
                let origin = self.origins[others[number]];
                let tool = 2.0 * cuts[number].1;
                let place = occurrences.common(origin, placed.occurrence);
                let deepest = deepest.entry(place).or_insert((at, depth, tool));
                if depth > deepest.1 {
                    *deepest = (at, depth, tool);
                }
            }
            found.extend(deepest.iter().map(|(place, deepest)| self.finding(&placed, *place, *deepest)));
        }
        found
    }

    /// The parts of the embedded paths, each place once, if the path cuts them.
    fn placed(&self) -> Vec<PlacedPart> {
        let mut all: Vec<PlacedPart> = Vec::new();
        for (number, occurrence) in (0_u32..).zip(&self.traced.trace.occurrences).skip(1) {
            let own = &self.traced.parts[occurrence.id];
            for part in parts(self.db, own.file).iter().filter(|part| part.may_belong_to(&own.path.name)) {
                let placed = PlacedPart {
                    part: part.placed(&occurrence.placement),
                    occurrence: number,
                    file: own.file,
                    placement: occurrence.placement,
                    raised: occurrence.raised,
                };
                let is_own = |origin: &StepOrigin| origin.occurrence == number;
                let mut cuts = self.cuts.iter().zip(&self.origins).filter(|(_, origin)| is_own(origin));
                let is_cut = cuts.any(|((way, radius), _)| {
                    let curves = placed.part.rings.iter().flat_map(|ring| &ring.curves);
                    curves.into_iter().any(|curve| curve.distance(&way.curve) < 2.0 * radius)
                });
                let is_known = all
                    .iter()
                    .any(|other| other.is_at(placed.file, &placed.placement) && other.is_same(&placed));
                if is_cut && !is_known {
                    all.push(placed);
                }
            }
        }
        all
    }

    /// Whether a cut has nothing to do with the path of a part: neither its own, nor of a path of the same drawing in the same place, nor
    /// embedded in it.
    fn is_foreign(&self, placed: &PlacedPart, origin: StepOrigin) -> bool {
        let occurrences = Occurrences { db: self.db, traced: self.traced };
        let occurrence = &self.traced.trace.occurrences[origin.occurrence as usize];
        let file = self.traced.parts[occurrence.id].file;
        let is_within = occurrences.outwards(origin.occurrence).any(|around| around == placed.occurrence);
        !is_within && !placed.is_at(file, &occurrence.placement)
    }

    fn finding(
        &self,
        placed: &PlacedPart,
        (occurrence, element): (u32, Option<u32>),
        (at, depth, tool): (Xy, f64, f64),
    ) -> Diagnostic {
        let TracedProgram { trace, parts, .. } = self.traced;
        let other = &parts[trace.occurrences[placed.occurrence as usize].id].path;
        let start = placed.part.rings[0].curves[0].start();
        let point = |at: Xy| Point::new(at.x, at.y);
        let found = Diagnostic::new(&messages::GOUGED_NEIGHBOUR)
            .with("tool", tool)
            .with("depth", depth)
            .quoting("other", other.name.as_str())
            .with("place", point(start))
            .with("point", point(at));
        Occurrences { db: self.db, traced: self.traced }.at_element(occurrence, element, found)
    }
}

impl PlacedPart {
    /// Whether a drawing lies where the drawing of this part lies.
    fn is_at(&self, file: SourceFile, placement: &Placement) -> bool {
        let corners = [Xy::new(0.0, 0.0), Xy::new(1000.0, 0.0)];
        let is_near = |corner| (self.placement.place(corner) - placement.place(corner)).norm() <= SAME_PLACE;
        self.file == file && corners.into_iter().all(is_near)
    }

    fn is_same(&self, other: &Self) -> bool {
        self.part.layer == other.part.layer
            && self.part.rings.len() == other.part.rings.len()
            && (self.part.rings[0].curves[0].start() - other.part.rings[0].curves[0].start()).norm()
                <= SAME_PLACE
    }
}
