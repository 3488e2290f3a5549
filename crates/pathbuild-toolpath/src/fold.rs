//! Computes the program of a path in a single walk over it and its embedded paths, keeping track of the position of the tool.

use std::collections::{BTreeMap, VecDeque};

use pathbuild_path::approx::{at_least, coincide, is_negligible, near};
use pathbuild_path::{
    ElementClass, Hole, Item, Letter, Origin, Path, PathOptions, PathRole, PlacedSubpath, Placement,
    SegmentKind, Sweep, WalkedPath, Xy, fallback,
};
use rstar::RTree;
use rstar::primitives::GeomWithData;

use crate::program::{
    Comment, Count, ElementKind, FIRST_FEED, Height, MoveClass, Names, Occurrence, OmittedCurves,
    PlannedMove, ProbeOrigin, ProbePoint, Program, ProgramStep, StepOrigin, Tip, Trace,
};

/// Source of the paths to be joined: the emitted path and all paths that it embeds.
pub trait FoldPaths {
    /// Identifier of a path with given values of its variables.
    type Id: Copy;

    /// Returns the path with this identifier.
    fn path(&self, id: Self::Id) -> &Path;

    /// Returns the walk along the path.
    fn walked(&self, id: Self::Id) -> &WalkedPath;

    /// Returns the path embedded by a subpath segment, which is given as an index into [`Path::segments`]; `None` if no such path was found.
    fn embedded(&self, id: Self::Id, segment: usize) -> Option<Self::Id>;

    /// Called regularly. Implementations may unwind here if the result is no longer needed.
    fn checkpoint(&self) {}
}

/// Computes the program of a path. `moves` is an estimate of the number of moves. None of the paths may have errors.
pub fn fold<P: FoldPaths>(
    parts: &P,
    root: P::Id,
    drawing: &str,
    options: PathOptions,
    moves: u64,
) -> Program {
    fold_with(parts, root, drawing, options, moves, None).0
}

/// Like [`fold`], but also returns the origin of each step.
pub fn fold_traced<P: FoldPaths>(
    parts: &P,
    root: P::Id,
    drawing: &str,
    options: PathOptions,
) -> (Program, Trace<P::Id>) {
    let (program, trace) = fold_with(parts, root, drawing, options, 0, Some(Trace::default()));
    (program, trace.unwrap_or_default())
}

fn fold_with<P: FoldPaths>(
    parts: &P,
    root: P::Id,
    drawing: &str,
    options: PathOptions,
    moves: u64,
    trace: Option<Trace<P::Id>>,
) -> (Program, Option<Trace<P::Id>>) {
    let path = parts.path(root);
    let sweep_height = path.sweep_height(&options, PathRole::Emitted).unwrap_or_default();
    let mut program = Program {
        path: path.name.as_str().into(),
        output_suffix: path.output_suffix.as_str().into(),
        drawing: drawing.into(),
        tool: path.tool,
        sweep_height,
        thickness: path.thickness,
        compatible: options.compatible,
        ..Program::default()
    };
    let mut fold = Fold {
        parts,
        feed: fallback(Letter::F, ElementClass::PathStart, path.numbers(), &options, PathRole::Emitted)
            .map_or(0.0, |(feed, _)| feed),
        compatible: options.compatible,
        options,
        clearance: sweep_height,
        last_feed: FIRST_FEED,
        tip: Tip { at: Xy::origin(), z: program.start_height() },
        steps: Vec::with_capacity(usize::try_from(moves).unwrap_or(0).min(MAX_RESERVED_STEPS)),
        names: Names::default(),
        probes: Vec::new(),
        left_out: BTreeMap::new(),
        mergeable: None,
        current_origin: StepOrigin::default(),
        trace,
    };
    fold.add_path(root, Placement::from_origin(path.start), 0.0, sweep_height);
    program.steps = fold.steps;
    // If there are more steps than estimated, the list may have reserved twice the memory that it needs.
    program.steps.shrink_to_fit();
    program.names = fold.names;
    program.left_out = fold.left_out.into_values().collect();
    let order = nearest_neighbour_order(&fold.probes);
    program.probes = order.iter().map(|number| fold.probes[*number].clone()).collect();
    let trace = fold
        .trace
        .map(|trace| Trace { probes: order.iter().map(|number| trace.probes[*number]).collect(), ..trace });
    (program, trace)
}

/// Maximum number of steps for which memory is reserved in advance. Beyond that, reallocation is cheap compared with computing the steps.
pub(crate) const MAX_RESERVED_STEPS: usize = 1 << 16;

pub(crate) struct Fold<'a, P: FoldPaths> {
    parts: &'a P,
    options: PathOptions,
    /// Default feed F in mm/min, for elements without a feed in paths without a feed.
    feed: f64,
    pub(crate) compatible: bool,
    /// S of the emitted path in mm, above which there are no obstacles.
    clearance: f64,
    /// Feed F in mm/min of the last move that had one.
    last_feed: f64,
    pub(crate) tip: Tip,
    steps: Vec<ProgramStep>,
    names: Names,
    probes: Vec<ProbePoint>,
    /// Curves on the layers of paths, but left out of the program, by name of the path.
    left_out: BTreeMap<Box<str>, OmittedCurves>,
    /// Index of the last sweep if only comments follow it and a further sweep may replace it (see [`sweep`](Self::sweep)).
    mergeable: Option<usize>,
    /// The path and element from which the current steps originate.
    current_origin: StepOrigin,
    /// Trace to which the origin of each step is added, if requested.
    trace: Option<Trace<P::Id>>,
}

/// A path at its place in the program, with absolute heights and lengths in mm.
#[derive(Clone, Copy)]
pub(crate) struct PlacedPath<'a> {
    pub(crate) path: &'a Path,
    pub(crate) placement: Placement,
    /// Height h by which the path is raised.
    pub(crate) raised: f64,
    /// Height h + T of the material's upper face.
    pub(crate) surface: f64,
    /// Sweep height h + S.
    pub(crate) sweep_height: f64,
    /// F of the path in mm/min, or the default feed (--feed).
    pub(crate) feed: f64,
}

impl<'a, P: FoldPaths> Fold<'a, P> {
    fn add_path(&mut self, id: P::Id, placement: Placement, raised: f64, sweep_height: f64) {
        self.parts.checkpoint();
        let outside = self.begin_path(id, placement, raised, sweep_height);
        let path = self.parts.path(id);
        self.note_left_out(path);
        let place = PlacedPath {
            path,
            placement,
            raised,
            surface: raised + path.thickness,
            sweep_height: raised + sweep_height,
            feed: path.feed.unwrap_or(self.feed),
        };
        let probe_feed =
            fallback(Letter::Z, ElementClass::Probe, path.numbers(), &self.options, PathRole::Embedded);
        let probe_feed = probe_feed.map_or(0.0, |(feed, _)| feed);
        self.probes.extend(path.probes.iter().map(|probe| ProbePoint {
            at: placement.place(probe.at),
            drawn_at: probe.at,
            height: probe.height + raised,
            feed: probe.feed.unwrap_or(probe_feed),
            label: probe.label.clone(),
        }));
        if let Some(trace) = &mut self.trace {
            let occurrence = self.current_origin.occurrence;
            trace.probes.extend((0..path.probes.len()).map(|probe| ProbeOrigin { occurrence, probe }));
        }
        let origin = |segment: usize| path.origin(&path.segments[segment]);
        let walked = self.parts.walked(id);
        for item in &walked.items {
            if let Some(segment) = item.segment() {
                self.begin_element(path.segments[segment].element);
            }
            match item {
                Item::Chain(chain) => self.mill_chain(&place, chain, walked.members(chain)),
                Item::Hole { segment, hole } => {
                    self.drill_hole(&place, &origin(*segment), &path.holes[*hole as usize]);
                }
                Item::Helix { segment, helix } => {
                    self.mill_helix(&place, &origin(*segment), &path.helices[*helix as usize]);
                }
                Item::Sweep(sweep) => self.sweep_along(&place, sweep),
                Item::Subpath(subpath) => self.add_subpath(&place, id, subpath),
            }
        }
        self.current_origin = outside;
    }

    /// Records curves on the layers of the path that do not belong to its elements.
    fn note_left_out(&mut self, path: &Path) {
        if path.left_out.is_empty() {
            return;
        }
        self.left_out.entry(path.name.as_str().into()).or_insert_with(|| {
            let mut entities = BTreeMap::new();
            for (kind, _) in &path.left_out {
                *entities.entry(*kind).or_default() += 1;
            }
            OmittedCurves { path: path.name.as_str().into(), entities: entities.into_iter().collect() }
        });
    }

    /// Makes the given path the current one and returns the previous element.
    fn begin_path(&mut self, id: P::Id, placement: Placement, raised: f64, sweep_height: f64) -> StepOrigin {
        let outside = self.current_origin;
        if let Some(trace) = &mut self.trace {
            let parent = (!trace.occurrences.is_empty()).then_some(outside);
            let occurrence = u32::try_from(trace.occurrences.len()).unwrap_or(u32::MAX);
            trace.occurrences.push(Occurrence { id, parent, placement, raised, sweep_height });
            self.current_origin = StepOrigin { occurrence, element: None };
        }
        outside
    }

    pub(crate) fn begin_element(&mut self, element: u32) {
        self.current_origin.element = Some(element);
    }

    /// Adds an embedded path, which begins exactly at the start of the segment. The next element begins at the end of the segment, even if
    /// the embedded path ended up to 0.001 mm away from it.
    fn add_subpath(&mut self, outer: &PlacedPath<'a>, id: P::Id, subpath: &PlacedSubpath) {
        let Some(embedded) = self.parts.embedded(id, subpath.segment) else { return };
        let SegmentKind::Subpath(parameters) = &outer.path.segments[subpath.segment].kind else { return };
        let path = self.parts.path(embedded);
        let (start, end) = (outer.placement.place(subpath.start), outer.placement.place(subpath.end));
        let placement = Placement::aligning((path.start, path.end), (start, end), &outer.placement);
        let name = self.names.intern(path.name.as_str());
        self.comment(Comment::StartSubpath(name));
        self.add_path(embedded, placement, outer.raised + parameters.height, path.embedded_sweep_height());
        self.comment(Comment::EndSubpath(name));
        self.tip.at = end;
    }

    fn sweep_along(&mut self, place: &PlacedPath<'_>, sweep: &Sweep) {
        let height = sweep.height.map_or(place.sweep_height, |height| place.raised + height);
        let to = Tip { at: place.placement.place(sweep.end), z: height };
        self.travel(to, place.surface, height, place.feed);
    }

    /// Drills a hole. The tool stays at the bottom; the next element retracts it.
    fn drill_hole(&mut self, place: &PlacedPath<'_>, origin: &Origin, hole: &Hole) {
        let bottom = place.raised + hole.bottom;
        self.add_element_comment(ElementKind::DrilledHole, origin, bottom, place, hole.peck);
        self.add_question_comment(hole.comment.as_deref());
        self.plunge(bottom, place.surface, hole.feed.unwrap_or(self.feed));
    }

    /// Moves to another point at sweep height, then down or up to the point's height.
    pub(crate) fn travel(&mut self, to: Tip, surface: f64, sweep_height: f64, feed: f64) {
        if coincide(self.tip.at, to.at) {
            return self.plunge(to.z, surface, feed);
        }
        self.plunge(sweep_height, surface, feed);
        let distance = distance(Tip { at: self.tip.at, z: sweep_height }, to);
        if !is_negligible(distance) {
            self.sweep(to.at, distance);
        }
        self.plunge(to.z, surface, feed);
    }

    /// Moves up or down at the current point: rapidly upwards and above the material, drilling downwards below its surface.
    pub(crate) fn plunge(&mut self, to: f64, surface: f64, feed: f64) {
        let from = self.tip.z;
        if near(from, to) {
            return;
        }
        if to > surface || to > from {
            return self.lift(to, (from - to).abs());
        }
        if from > surface {
            self.lift(surface, (from - surface).abs());
        }
        if !near(to, surface) {
            let z = Height { z: to, at: self.tip.at };
            let count = Count { class: MoveClass::Drilling, length: (surface - to).abs(), feed: Some(feed) };
            // PathDxf2GCode writes no feed, so its plunges run at the previous feed.
            let feed = if self.compatible { self.last_feed } else { feed };
            self.step(PlannedMove::Drill { feed, z }, count);
        }
    }

    /// Adds `G00 Z`; `length` is the length used for statistics.
    pub(crate) fn lift(&mut self, to: f64, length: f64) {
        self.lift_corrected_at(to, self.tip.at, length);
    }

    /// Like [`lift`](Self::lift), but the height is corrected by probes for another point: the centre of a helical circle.
    pub(crate) fn lift_corrected_at(&mut self, to: f64, at: Xy, length: f64) {
        let count = Count { class: MoveClass::Sweep, length, feed: None };
        self.step(PlannedMove::Lift { z: Height { z: to, at } }, count);
    }

    /// Adds `G00 X Y`. Of several sweeps separated only by comments, only the last one is kept if they are so high that there cannot be obstacles,
    /// and always in compatible mode.
    pub(crate) fn sweep(&mut self, to: Xy, length: f64) {
        if let Some(index) = self.mergeable.take() {
            self.steps.remove(index);
            if let Some(trace) = &mut self.trace {
                trace.steps.remove(index);
            }
        }
        let index = self.steps.len();
        let count = Count { class: MoveClass::Sweep, length, feed: None };
        self.step(PlannedMove::Sweep { to }, count);
        let is_clear = self.compatible || at_least(self.tip.z, self.clearance);
        self.mergeable = is_clear.then_some(index);
    }

    /// Adds a move.
    pub(crate) fn step(&mut self, to: PlannedMove, count: Count) {
        self.mergeable = None;
        if let PlannedMove::Line { feed, .. } | PlannedMove::Arc { feed, .. } = to {
            self.last_feed = feed;
        }
        self.push(ProgramStep::Move { to, count });
        self.tip = to.end(self.tip);
    }

    pub(crate) fn comment(&mut self, comment: Comment) {
        self.push(ProgramStep::Comment(comment));
    }

    fn push(&mut self, step: ProgramStep) {
        self.steps.push(step);
        if let Some(trace) = &mut self.trace {
            trace.steps.push(self.current_origin);
        }
    }

    /// Adds the comment `(Q:...)`, if there is one.
    pub(crate) fn add_question_comment(&mut self, text: Option<&str>) {
        if let Some(text) = text {
            let name = self.names.intern(text);
            self.comment(Comment::Question(name));
        }
    }

    pub(crate) fn add_element_comment(
        &mut self,
        kind: ElementKind,
        origin: &Origin,
        bottom: f64,
        place: &PlacedPath<'_>,
        peck: Option<f64>,
    ) {
        let at = Xy::new(origin.point.x.0, origin.point.y.0);
        self.comment(Comment::Element {
            kind,
            at,
            bottom,
            surface: place.surface,
            cutter: place.path.tool,
            peck,
        });
    }

    pub(crate) fn feed_or_default(&self, own: Option<f64>) -> f64 {
        own.unwrap_or(self.feed)
    }

    pub(crate) fn checkpoint(&self) {
        self.parts.checkpoint();
    }
}

/// Returns the distance between two positions in space, in mm.
pub(crate) fn distance(a: Tip, b: Tip) -> f64 {
    let (plane, height) = ((b.at - a.at).norm_squared(), b.z - a.z);
    libm::sqrt(plane + height * height)
}

// Determines the order in which Z-probes are measured. (book: language/probes)

/// Relative tolerance for the order of the R-tree, which rounding may change. Probes whose distance exceeds that of the tree's first one by no more
/// than this are compared by distances computed here, and of equally distant ones the first is taken.
const ROUNDING: f64 = 1e-12;

/// Starts at (0, 0) and repeatedly visits the nearest remaining probe; the first of these if there are several. Returns the indices of the probes.
fn nearest_neighbour_order(found: &[ProbePoint]) -> Vec<usize> {
    let mut waiting = UnvisitedProbes::new(found);
    let mut at = Xy::origin();
    let next = || {
        let number = waiting.take_nearest(at)?;
        at = found[number].at;
        Some(number)
    };
    std::iter::from_fn(next).collect()
}

struct UnvisitedProbes {
    /// Indices of the unvisited probes at each position.
    places: Vec<VecDeque<usize>>,
    tree: RTree<GeomWithData<[f64; 2], usize>>,
}

impl UnvisitedProbes {
    fn new(found: &[ProbePoint]) -> Self {
        let mut places = BTreeMap::<_, VecDeque<usize>>::new();
        for (number, probe) in found.iter().enumerate() {
            places.entry([probe.at.x, probe.at.y].map(f64::to_bits)).or_default().push_back(number);
        }
        let points = places.keys().enumerate();
        let points = points.map(|(place, at)| GeomWithData::new(at.map(f64::from_bits), place)).collect();
        Self { tree: RTree::bulk_load(points), places: places.into_values().collect() }
    }

    fn take_nearest(&mut self, at: Xy) -> Option<usize> {
        let near = self.tree.nearest_neighbor_iter([at.x, at.y]);
        let mut near = near.map(|place| ((Xy::from(*place.geom()) - at).norm(), place)).peekable();
        let (least, _) = *near.peek()?;
        let near = near.take_while(|(distance, _)| *distance <= least * (1.0 + ROUNDING));
        let first = |place: &GeomWithData<[f64; 2], usize>| self.places[place.data].front();
        let place = *near.min_by(|(a, p), (b, q)| a.total_cmp(b).then(first(p).cmp(&first(q))))?.1;
        let number = self.places[place.data].pop_front();
        if self.places[place.data].is_empty() {
            self.tree.remove(&place);
        }
        number
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn probe((x, y): (i32, i32), number: usize) -> ProbePoint {
        let at = Xy::new(f64::from(x), f64::from(y));
        ProbePoint { at, drawn_at: at, height: 0.0, feed: 1.0, label: Some(number.to_string().into()) }
    }

    /// Orders probes by comparing all remaining ones in each step.
    fn one_by_one(mut found: Vec<ProbePoint>) -> Vec<ProbePoint> {
        let (mut ordered, mut at) = (Vec::new(), Xy::origin());
        while !found.is_empty() {
            let distances: Vec<f64> = found.iter().map(|probe| (probe.at - at).norm()).collect();
            let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
            let next = distances.iter().position(|distance| *distance <= least).expect("the least is one");
            ordered.push(found.remove(next));
            at = ordered[ordered.len() - 1].at;
        }
        ordered
    }

    #[test]
    fn the_nearest_is_found_wherever_it_lies() {
        let grid = (0..400).map(|index| (index % 20 - 7, index / 20 - 7));
        let anywhere = (0..500).map(|index| (index * 7919 % 613, index * 104_729 % 577));
        let one_place = (0..50).map(|index| (5, index % 2));
        for points in [grid.collect::<Vec<_>>(), anywhere.collect(), one_place.collect(), Vec::new()] {
            let probes: Vec<ProbePoint> =
                points.into_iter().enumerate().map(|(number, at)| probe(at, number)).collect();
            let ordered: Vec<ProbePoint> =
                nearest_neighbour_order(&probes).into_iter().map(|number| probes[number].clone()).collect();
            assert_eq!(ordered, one_by_one(probes));
        }
    }
}
