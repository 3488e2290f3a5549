//! The parts in a program: their places, and the cuts of a project into the parts of other components and through their support bars.
//! (book: language/part)

mod displaced;
mod waste;

use std::collections::BTreeMap;

use pathbuild_diagnostic::messages::part as messages;
use pathbuild_diagnostic::{Diagnostic, Point, TraceStep};
use pathbuild_path::{
    Curve, LostBar, MilledMove, NeighbourCuts, NeighbourGouge, Origin, Part, PartSettings, Path, PathCuts,
    PlacedCuts, PlacedPart, Placement, SeveredPart, Xy, gouging_moves,
};
use pathbuild_toolpath::tip_move;

use crate::database::Db;
use crate::inputs::{Settings, Target};
use crate::queries::closures::closure;
use crate::queries::embedding::{Instance, Outcome, direct_embeddings};
use crate::queries::index::lower_to_warnings;
use crate::queries::part::{file_parts, part_findings, parts_of, path_cuts};
use crate::queries::programs::{BoundPath, TracedProgram, traced_program};

/// Returns PB214 for cuts of one embedded path into the part of another, PB218 for cuts through its support bars, and PB217 for parts that such cuts
/// leave loose: one finding per part or bar and element, reported in the path that contains both. Also returns PB221 for paths that place a shared
/// part differently, and PB222 for cuts in loose waste.
pub(super) fn neighbour_problems(db: &dyn Db, target: Target) -> &[Diagnostic] {
    // Most paths embed no others; no query is needed then.
    if has_neighbours(db, target) { cuts_into_neighbours(db, target) } else { &[] }
}

fn has_neighbours(db: &dyn Db, target: Target) -> bool {
    Settings::get(db).language(db).part.is_some() && closure(db, target).reached.len() > 1
}

#[salsa::tracked]
fn cuts_into_neighbours(db: &dyn Db, target: Target) -> Vec<Diagnostic> {
    neighbour_findings(db, &[target])
}

/// Like [`neighbour_problems`], but for one or more targets with programs that are joined into one.
pub(super) fn neighbour_findings(db: &dyn Db, targets: &[Target]) -> Vec<Diagnostic> {
    let Some(program) = placed_program(db, targets) else { return Vec::new() };
    let mut found = program.findings();
    lower_to_warnings(db, &mut found);
    found
}

/// Returns the paths of one or more joined programs at their places; `None` if one of them has errors, or none has parts.
fn placed_program<'db>(db: &'db dyn Db, targets: &[Target]) -> Option<PlacedProgram<'db>> {
    let settings = Settings::get(db).language(db).part.as_ref()?;
    let closures: Vec<_> = targets.iter().map(|target| closure(db, *target)).collect();
    let has_parts = |file| file_parts(db, file).is_some_and(|found| !found.parts.is_empty());
    let is_known = closures.iter().all(|closure| !closure.has_errors() && closure.missing_options.is_empty());
    if !is_known || !closures.iter().flat_map(|closure| closure.files(db)).any(has_parts) {
        return None;
    }
    let mut program = PlacedProgram { db, settings, is_joined: targets.len() > 1, paths: Vec::new() };
    for closure in closures {
        let root = closure.root?;
        let start = path_cuts(db, root).map_or(Xy::origin(), |cuts| cuts.ends.0);
        program.add(root, Placement::from_origin(start), 0.0, None);
    }
    Some(program)
}

/// The paths of a program with their placements.
struct PlacedProgram<'db> {
    db: &'db dyn Db,
    settings: &'db PartSettings,
    /// Whether several programs are joined. Then only paths of different programs are compared.
    is_joined: bool,
    /// The paths, each after the path that embeds it.
    paths: Vec<PlacedPath<'db>>,
}

struct PlacedPath<'db> {
    instance: Instance<'db>,
    cuts: PlacedCuts<'db>,
    /// `None` for a target's own path.
    parent: Option<Embedder<'db>>,
}

/// The path that embeds another one.
#[derive(Clone, Copy)]
struct Embedder<'db> {
    /// Index into [`PlacedProgram::paths`].
    path: usize,
    /// The embedding segment.
    origin: &'db Origin,
    /// The number of cuts of the embedding path that come before the embedded one.
    cuts_before: usize,
}

/// Distance in mm below which two placements of one drawing are considered equal: its paths are then embedded together.
const PLACEMENT_TOLERANCE: f64 = 0.01;

fn diagnostic_point(at: Xy) -> Point {
    Point::new(at.x, at.y)
}

/// Whether two placements of one drawing are the same.
fn is_same(one: &Placement, other: &Placement) -> bool {
    let corners = [Xy::new(0.0, 0.0), Xy::new(1000.0, 0.0)];
    corners.into_iter().all(|at| (one.place(at) - other.place(at)).norm() <= PLACEMENT_TOLERANCE)
}

impl<'db> PlacedProgram<'db> {
    /// Adds a path with all that it embeds.
    fn add(
        &mut self,
        instance: Instance<'db>,
        placement: Placement,
        raised: f64,
        parent: Option<Embedder<'db>>,
    ) {
        let Some(cuts) = path_cuts(self.db, instance) else { return };
        let is_known = |part: &&_| self.is_known(instance, &placement, part);
        let own = if parent.is_some() || self.is_joined { parts_of(self.db, instance) } else { Vec::new() };
        let parts = own.into_iter().filter(|part| !is_known(part)).collect();
        let number = self.paths.len();
        self.paths.push(PlacedPath {
            instance,
            cuts: PlacedCuts::new(cuts, parts, placement, raised),
            parent,
        });
        for place in &cuts.embedded {
            let mut embeddings = direct_embeddings(self.db, instance).iter();
            let Some(embedding) = embeddings.find(|embedding| embedding.segment == place.segment) else {
                continue;
            };
            let Outcome::Found { child, .. } = &embedding.outcome else { continue };
            let Some(inner) = path_cuts(self.db, *child) else { continue };
            let onto = (placement.place(place.ends.0), placement.place(place.ends.1));
            let inner = Placement::aligning(inner.ends, onto, &placement);
            let parent = Embedder { path: number, origin: &embedding.origin, cuts_before: place.cuts_before };
            self.add(*child, inner, raised + place.height, Some(parent));
        }
    }

    /// Whether another path of the same drawing has already placed a part here.
    fn is_known(&self, instance: Instance<'db>, placement: &Placement, part: &Part) -> bool {
        let is_same = |other: &PlacedPath<'_>| {
            other.cuts.parts.iter().any(|known| std::ptr::eq(*known, part))
                && self.is_at(other, instance, placement)
        };
        self.paths.iter().any(is_same)
    }

    /// Whether the drawings of two paths have the same place in the program.
    fn is_at(&self, other: &PlacedPath<'_>, instance: Instance<'db>, placement: &Placement) -> bool {
        other.instance.file(self.db) == instance.file(self.db) && is_same(&other.cuts.placement, placement)
    }

    fn findings(&self) -> Vec<Diagnostic> {
        let mut found = self.cuts_into_own_parts();
        for owner in 0..self.paths.len() {
            let taken =
                (0..self.paths.len()).filter_map(|cutting| Some((cutting, self.damage(owner, cutting)?)));
            found.extend(self.cuts_into(owner, &self.paths[owner].cuts, taken));
            found.extend(self.severed(owner).iter().map(|severed| {
                let (path, origin) = self.innermost_common_path(severed.path, severed.element, owner);
                self.at(path, origin, self.severed_problem(owner, severed))
            }));
        }
        found.extend(self.displaced_paths());
        found.extend(self.cuts_in_loose_waste());
        found
    }

    /// Returns what the path `cutting` takes away from the parts and support bars of `owner`. If both belong to the same drawing at the same place,
    /// which the drawing's own check covers, only the bars that are lost because the embedding is turned. `None` if the two are not compared.
    fn damage(&self, owner: usize, cutting: usize) -> Option<NeighbourCuts> {
        let (owned, by, tolerance) =
            (&self.paths[owner].cuts, &self.paths[cutting].cuts, self.settings.tolerance);
        if self.is_foreign(owner, cutting) {
            return Some(owned.cuts_made_by(by, tolerance));
        }
        let bars = || owned.bars_lost_by_turning(by, tolerance);
        self.are_from_same_drawing(owner, cutting)
            .then(|| NeighbourCuts { bars: bars(), ..NeighbourCuts::default() })
    }

    /// Whether two paths of a program belong to the same drawing at the same place, or are the same path. In joined programs, they also belong to
    /// different programs.
    fn are_from_same_drawing(&self, owner: usize, cutting: usize) -> bool {
        let PlacedPath { instance, cuts, .. } = &self.paths[cutting];
        let is_compared = !self.is_joined || self.root(owner) != self.root(cutting);
        is_compared && self.is_at(&self.paths[owner], *instance, &cuts.placement)
    }

    /// Returns PB214 for cuts of other paths into the parts of a path, and PB218 for cuts through its support bars.
    fn cuts_into(
        &self,
        owner: usize,
        owned: &PlacedCuts<'_>,
        others: impl Iterator<Item = (usize, NeighbourCuts)>,
    ) -> Vec<Diagnostic> {
        let mut gouges: BTreeMap<_, (NeighbourGouge, usize, &Origin)> = BTreeMap::new();
        let mut bars: BTreeMap<_, (&Origin, BTreeMap<usize, LostBar>)> = BTreeMap::new();
        for (cutting, taken) in others {
            for gouge in taken.gouges {
                let (path, origin) = self.innermost_common_path(cutting, gouge.element, owner);
                let key = (gouge.part, path, origin.id.0);
                let deepest = gouges.entry(key).or_insert((gouge.clone(), cutting, origin));
                if gouge.depth > deepest.0.depth {
                    *deepest = (gouge, cutting, origin);
                }
            }
            for lost in taken.bars {
                let (path, origin) = self.innermost_common_path(cutting, lost.element, owner);
                let key = (path, origin.id.0, self.is_foreign(owner, cutting));
                let (_, of_element) = bars.entry(key).or_insert_with(|| (origin, BTreeMap::new()));
                let worst = of_element.entry(lost.bar).or_insert_with(|| lost.clone());
                if worst.is_exceeded_by(&lost) {
                    *worst = lost;
                }
            }
        }
        let gouges = gouges.into_iter().map(|((_, path, _), (gouge, cutting, origin))| {
            self.at(path, origin, self.gouge_problem(owned, cutting, &gouge))
        });
        let bars = bars.into_iter().filter_map(|((path, _, is_foreign), (origin, bars))| {
            let message =
                if is_foreign { &messages::NEIGHBOURS_BAR_CUT_AWAY } else { &messages::BAR_LOST_BY_TURNING };
            Some(self.at(path, origin, LostBar::problem(bars.values(), owned.cuts, message)?))
        });
        gouges.chain(bars).collect()
    }

    /// Returns PB214 for cuts of components into parts that are drawn in the project's own drawing.
    fn cuts_into_own_parts(&self) -> Vec<Diagnostic> {
        let parts = self.own_parts();
        let Some(project) = self.paths.first().filter(|_| !parts.is_empty()) else { return Vec::new() };
        let without_bars = PathCuts { bars: Vec::new(), ..project.cuts.cuts.clone() };
        let own = PlacedCuts::new(&without_bars, parts, project.cuts.placement, 0.0);
        let taken = self
            .paths
            .iter()
            .enumerate()
            .skip(1)
            .map(|(cutting, path)| (cutting, own.cuts_made_by(&path.cuts, self.settings.tolerance)));
        self.cuts_into(0, &own, taken)
    }

    /// Returns the parts that are drawn in the project's own drawing, except for parts that only show a component's part once more, or the sheet
    /// around it.
    fn own_parts(&self) -> Vec<&'db Part> {
        let Some((project, components)) = self.paths.split_first().filter(|_| !self.is_joined) else {
            return Vec::new();
        };
        let file = project.instance.file(self.db);
        // Components that are drawn in the project's own drawing have their parts there, too. Those parts lie at the drawn components, not where the
        // components are embedded.
        let parts = if components.iter().any(|component| component.instance.file(self.db) == file) {
            parts_of(self.db, project.instance)
        } else {
            file_parts(self.db, file).map(|found| found.parts.iter().collect()).unwrap_or_default()
        };
        let all = PlacedCuts::new(project.cuts.cuts, parts, project.cuts.placement, 0.0);
        let is_own =
            |part: &usize| !components.iter().any(|component| all.shows_part_of(*part, &component.cuts));
        (0..all.parts.len()).filter(is_own).map(|part| all.parts[part]).collect()
    }

    /// Returns the parts of a path that cuts of other paths, or its own in a turned embedding, leave loose.
    fn severed(&self, owner: usize) -> Vec<SeveredPart> {
        if self.settings.is_held_otherwise {
            return Vec::new();
        }
        let (others, own): (Vec<_>, Vec<_>) =
            (0..self.paths.len()).partition(|path| self.is_foreign(owner, *path));
        let with_cuts = |paths: Vec<usize>| -> Vec<_> {
            paths.into_iter().map(|path| (path, &self.paths[path].cuts)).collect()
        };
        self.paths[owner].cuts.severed_by(&with_cuts(own), &with_cuts(others))
    }

    fn severed_problem(&self, owner: usize, severed: &SeveredPart) -> Diagnostic {
        let is_foreign = self.is_foreign(owner, severed.path);
        let message = if is_foreign { &messages::SEVERED_NEIGHBOUR } else { &messages::SEVERED_BY_TURNING };
        let owner = &self.paths[owner].cuts;
        Diagnostic::new(message)
            .quoting("other", owner.cuts.name.as_str())
            .with("place", diagnostic_point(owner.start_of(severed.part)))
    }

    /// Returns the parts that cuts of other paths leave loose, with their placements.
    fn severed_parts(&self) -> Vec<(&'db Part, Placement)> {
        let parts = (0..self.paths.len()).flat_map(|owner| {
            let PlacedCuts { parts, placement, .. } = &self.paths[owner].cuts;
            self.severed(owner).into_iter().map(move |severed| (parts[severed.part], *placement))
        });
        parts.collect()
    }

    /// Returns the centre lines of the bars that cuts of other paths, or of their own path in a turned embedding, take away.
    fn lost_bars(&self) -> Vec<Curve> {
        let numbers = 0..self.paths.len();
        let pairs = numbers.clone().flat_map(|owner| numbers.clone().map(move |cutting| (owner, cutting)));
        let taken = pairs.flat_map(|(owner, cutting)| {
            let has_displaced_bars =
                self.are_from_same_drawing(owner, cutting) && self.paths[owner].cuts.has_displaced_bars();
            let (owned, by) = (&self.paths[owner].cuts, &self.paths[cutting].cuts);
            if has_displaced_bars || self.is_foreign(owner, cutting) {
                owned.bars_taken_by(by, self.settings.tolerance)
            } else {
                Vec::new()
            }
        });
        taken.flat_map(|lost| lost.sections).collect()
    }

    /// Whether a path is independent of the parts of another: it neither belongs to the same drawing at the same place nor is embedded in it. In
    /// joined programs, it also belongs to another program.
    fn is_foreign(&self, owner: usize, cutting: usize) -> bool {
        let PlacedPath { instance, cuts, .. } = &self.paths[cutting];
        let is_within = if self.is_joined {
            self.root(cutting) == self.root(owner)
        } else {
            self.path_and_embedders(cutting).any(|around| around == owner)
        };
        !is_within && !self.is_at(&self.paths[owner], *instance, &cuts.placement)
    }

    /// Iterates over a path and the paths that embed it, from the inside out.
    fn path_and_embedders(&self, path: usize) -> impl Iterator<Item = usize> {
        std::iter::successors(Some(path), |inner| Some(self.paths[*inner].parent?.path))
    }

    /// Returns the outermost path that embeds a path, or the path itself if no other embeds it. It is a target's own path.
    fn root(&self, path: usize) -> Option<usize> {
        self.path_and_embedders(path).last()
    }

    /// Returns the innermost path that contains both an element and another path, and the element of that innermost path that is the given element or
    /// embeds it.
    fn innermost_common_path(&self, path: usize, element: u32, other: usize) -> (usize, &'db Origin) {
        let origin = &self.paths[path].cuts.cuts.elements[element as usize].origin;
        self.embedding_beside(path, other).unwrap_or((path, origin))
    }

    /// Returns the innermost path that contains both paths, and its element that embeds the first one. `None` if the first path contains the other
    /// one, or if none contains both and no path embeds the first one.
    fn embedding_beside(&self, mut path: usize, other: usize) -> Option<(usize, &'db Origin)> {
        let around: Vec<usize> = self.path_and_embedders(other).collect();
        let mut found = None;
        while !around.contains(&path) {
            let Some(parent) = self.paths[path].parent else { break };
            path = parent.path;
            found = Some((path, parent.origin));
        }
        found
    }

    fn gouge_problem(&self, owner: &PlacedCuts<'_>, cutting: usize, gouge: &NeighbourGouge) -> Diagnostic {
        let cuts_part = !parts_of(self.db, self.paths[cutting].instance).is_empty();
        let message =
            if cuts_part { &messages::GOUGED_NEIGHBOUR } else { &messages::GOUGED_BY_PATH_WITHOUT_PART };
        Diagnostic::new(message)
            .with("tool", 2.0 * self.paths[cutting].cuts.cuts.radius)
            .with("depth", gouge.depth)
            .quoting("other", owner.cuts.name.as_str())
            .with("place", diagnostic_point(owner.start_of(gouge.part)))
            .with("point", diagnostic_point(gouge.at))
    }

    /// Places a finding at an element of a path, with the embeddings that lead there.
    fn at(&self, path: usize, origin: &Origin, problem: Diagnostic) -> Diagnostic {
        let place = |path: usize| {
            let PlacedPath { instance, cuts, .. } = &self.paths[path];
            (instance.file(self.db).path(self.db), cuts.cuts.name.as_str())
        };
        let step = |inner: usize| {
            let Embedder { path: outer, origin, .. } = self.paths[inner].parent?;
            let (file, name) = place(outer);
            Some(TraceStep { file: file.clone(), path: name.into(), point: origin.point })
        };
        let mut trace: Vec<TraceStep> = self.path_and_embedders(path).filter_map(step).collect();
        trace.reverse();
        let (file, name) = place(path);
        Diagnostic { trace, ..origin.at(problem.in_file(file).in_path(name)) }
    }
}

/// Returns the finished parts in the program of a target: those that its paths cut, and those drawn in the project's own drawing. Empty without a
/// program.
pub fn placed_parts(db: &dyn Db, target: Target) -> Vec<PlacedPart<'_>> {
    let Some(settings) = &Settings::get(db).language(db).part else { return Vec::new() };
    let Some(traced) = traced_program(db, target).as_deref() else { return Vec::new() };
    let program = has_neighbours(db, target).then(|| placed_program(db, &[target])).flatten();
    let severed = program.as_ref().map(PlacedProgram::severed_parts).unwrap_or_default();
    let (radius, tolerance) = (traced.program.tool / 2.0, settings.tolerance);
    let ways = milled_moves(traced);
    let placed = |drawn, placement, raised, thickness| PlacedPart {
        drawn,
        left: &[],
        corners: &[],
        lost_bars: &[],
        bars_lost_to_neighbours: Vec::new(),
        gouges: gouging_moves(drawn, &placement, [raised, thickness], &ways, [radius, tolerance]),
        is_loose: severed.iter().any(|(part, at)| std::ptr::eq(*part, drawn) && is_same(at, &placement)),
        radius,
        placement,
        top: raised + thickness,
        tolerance,
    };
    let mut all = Vec::new();
    for occurrence in &traced.trace.occurrences {
        let cutting = &traced.paths[occurrence.id];
        let found = file_parts(db, cutting.file);
        let findings = instance_of(db, target, cutting).and_then(|instance| part_findings(db, instance));
        let (Some(found), Some((findings, place))) = (found, findings) else { continue };
        let own = &findings.parts[place];
        let has_bars_on_circles = cutting.path.helices.iter().any(|helix| helix.bars.is_some());
        let has_displaced_bars = occurrence.placement.is_turned() && has_bars_on_circles;
        let placed_here = |part: usize| {
            let thickness = cutting.path.thickness;
            placed(&found.parts[part], occurrence.placement, occurrence.raised, thickness)
        };
        for (index, part) in own.iter().enumerate() {
            let mut part_of_path = placed_here(*part);
            part_of_path.is_loose |= findings.loose.iter().any(|(loose, _)| loose == part);
            part_of_path.corners = &findings.corners[*part];
            // The material left and the bars are known by path, not by part: list them with the first part only. Bars that stand elsewhere than
            // in the drawing are listed in `bars_lost_to_neighbours` below.
            if index == 0 {
                part_of_path.left = &findings.left[place];
                if !has_displaced_bars {
                    part_of_path.lost_bars = &findings.lost_bars[place];
                }
            }
            all.push(part_of_path);
        }
        // The path neither cuts these parts out nor enters them, but takes away what holds them.
        let loose = findings.loose.iter().filter(|(part, path)| *path == place && !own.contains(part));
        all.extend(loose.map(|(part, _)| PlacedPart { is_loose: true, ..placed_here(*part) }));
    }
    if let Some(program) = &program
        && let (Some(project), Some(root)) = (program.paths.first(), traced.trace.occurrences.first())
    {
        let is_new = |part: &&Part| !all.iter().any(|known| std::ptr::eq(known.drawn, *part));
        let own: Vec<&Part> = program.own_parts().into_iter().filter(is_new).collect();
        let thickness = traced.paths[root.id].path.thickness;
        all.extend(own.into_iter().map(|part| placed(part, project.cuts.placement, 0.0, thickness)));
        if let Some(first) = all.first_mut() {
            first.bars_lost_to_neighbours = program.lost_bars();
        }
    }
    all
}

/// Returns the instance of a path in a target's program.
fn instance_of<'db>(db: &'db dyn Db, target: Target, cutting: &BoundPath) -> Option<Instance<'db>> {
    let mut instances = closure(db, target).reached.iter().copied();
    instances.find(|instance| {
        instance.file(db) == cutting.file
            && instance.name(db).name(db) == *cutting.path.name
            && *instance.bindings(db) == cutting.bindings
    })
}

/// Returns the milling moves of a program.
fn milled_moves(traced: &TracedProgram) -> Vec<MilledMove> {
    let bottoms: Vec<BTreeMap<u32, f64>> =
        traced.paths.iter().map(|bound| bottoms_of_bar_elements(&bound.path)).collect();
    let milled = traced.program.moves().filter(|(_, movement)| movement.pace.feed().is_some());
    let placed = milled.filter_map(|(step, movement)| {
        let origin = traced.trace.steps.get(step as usize - 1)?;
        let occurrence = &traced.trace.occurrences[origin.occurrence as usize];
        let bottom = origin.element.and_then(|element| bottoms[occurrence.id].get(&element));
        let bottom = bottom.map_or(f64::INFINITY, |bottom| bottom + occurrence.raised);
        Some(MilledMove { way: tip_move(&movement)?, raised: occurrence.raised, bottom })
    });
    placed.collect()
}

/// Returns B of the elements with support bars, by index of the drawn element.
fn bottoms_of_bar_elements(path: &Path) -> BTreeMap<u32, f64> {
    let segments = path.segments.iter();
    segments.filter_map(|segment| Some((segment.element, path.bottom_between_bars(segment)?))).collect()
}
