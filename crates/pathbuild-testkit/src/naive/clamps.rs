//! Finds moves into clamps by a simple geometric model: passes along straight lines, and rapid moves between them. Clamps are axis-parallel
//! rectangles here, and none is located where the tool plunges or retracts. (book: language/keep-outs)

use std::collections::BTreeMap;

use pathbuild_path::{KeepOut, Path, Segment, SegmentKind, SubpathName, Xy};

use super::{Finding, Instance, Model};

/// Tolerance in mm within which lengths are equal.
const LENGTH_TOLERANCE: f64 = 1e-6;

/// X and Y in mm, or cosine and sine of an angle.
type Pair = [f64; 2];

/// A path as placed in a program.
struct Occurrence {
    instance: Instance,
    path: Path,
    /// Index of the embedding occurrence, and the element that embeds this one.
    parent: Option<(usize, Option<String>)>,
    place: Place,
}

#[derive(Clone, Copy)]
struct Place {
    origin: Pair,
    turn: Pair,
    raised: f64,
}

/// A straight move at constant height.
struct Move {
    occurrence: usize,
    element: Option<String>,
    what: &'static str,
    ends: [Pair; 2],
    z: f64,
}

/// A path with everything it embeds, expanded.
struct ExpandedPath<'m> {
    model: &'m Model,
    occurrences: Vec<Occurrence>,
    moves: Vec<Move>,
}

impl Model {
    /// Returns findings about moves of a path without errors that hit clamps.
    pub(super) fn entered_clamps(&self, root: &Instance) -> Vec<Finding> {
        let mut unfolded = ExpandedPath { model: self, occurrences: Vec::new(), moves: Vec::new() };
        let place = Place { origin: [0.0; 2], turn: [1.0, 0.0], raised: 0.0 };
        unfolded.expand(root.clone(), None, |_| place);
        unfolded.findings()
    }
}

impl ExpandedPath<'_> {
    /// Adds a path, its moves, and everything it embeds.
    fn expand(
        &mut self,
        instance: Instance,
        parent: Option<(usize, Option<String>)>,
        place: impl Fn(&Path) -> Place,
    ) {
        let Some(path) = self.model.sound_path(&instance) else { return };
        let (number, place) = (self.occurrences.len(), place(&path));
        self.occurrences.push(Occurrence { instance, path: path.clone(), parent, place });
        for segment in &path.segments {
            self.segment(number, &path, segment, place);
        }
    }

    fn segment(&mut self, number: usize, path: &Path, segment: &Segment, place: Place) {
        let instance = &self.occurrences[number].instance;
        let drawing = &self.model.drawings[instance.0];
        let element = drawing.handle(&path.name, path.origin(segment).id);
        let ends = path.ends(segment).map(|end| place.of(pair(end)));
        let mut go = |what, z: f64| {
            let (element, z) = (element.clone(), z + place.raised);
            self.moves.push(Move { occurrence: number, element, what, ends, z });
        };
        match &segment.kind {
            SegmentKind::Cut(cut) => {
                let cut = &path.cuts[*cut as usize];
                let infeed = cut.chain.infeed.unwrap_or(f64::INFINITY);
                let passes: Vec<f64> = passes(path.thickness, infeed, cut.bottom).collect();
                for z in &passes {
                    go("cut", *z);
                }
                if passes.len().is_multiple_of(2) {
                    // Passes alternate in direction, so an even number ends where the first began.
                    go("rapid move", path.embedded_sweep_height());
                }
            }
            SegmentKind::Sweep { height } => {
                go("rapid move", height.unwrap_or(path.embedded_sweep_height()));
            }
            SegmentKind::Subpath(subpath) => {
                let SubpathName::Found { name, .. } = &subpath.name else { return };
                let Some(child) = self.model.child(instance, name, subpath) else { return };
                let [start, end] = [subpath.start, subpath.end].map(|at| place.of(pair(at)));
                let raised = place.raised + subpath.height;
                let lies =
                    |inner: &Path| Place::from_to([inner.start, inner.end].map(pair), [start, end], raised);
                self.expand(child, Some((number, element)), lies);
            }
            SegmentKind::Hole(_) | SegmentKind::Helix(_) => {}
        }
    }

    /// Returns one finding for each clamp, each element of the innermost path that contains both, and each kind of move.
    fn findings(&self) -> Vec<Finding> {
        // The number of moves, their lowest Z, and the path of the first one.
        let mut entries: BTreeMap<_, (u32, f64, usize)> = BTreeMap::new();
        for (number, occurrence) in self.occurrences.iter().enumerate() {
            let drawing = &self.model.drawings[occurrence.instance.0];
            for (clamp, drawn) in drawing.clamps.iter().enumerate() {
                for motion in self.moves.iter().filter(|motion| self.is_in(motion, occurrence, drawn)) {
                    let (holder, element) = self.common(number, motion);
                    let entry = entries.entry((number, clamp, holder, element, motion.what));
                    let (moves, lowest, _) = entry.or_insert((0, f64::INFINITY, motion.occurrence));
                    (*moves, *lowest) = (*moves + 1, lowest.min(motion.z));
                }
            }
        }
        let finding = |(entry, (moves, lowest, mover)): ((usize, usize, usize, _, _), (u32, f64, usize))| {
            let (number, clamp, holder, element, what) = entry;
            let of_component = if what == "rapid move" && mover != holder {
                format!(" in path {}", self.occurrences[mover].path.name)
            } else {
                String::new()
            };
            let [around, holder] = [number, holder].map(|number: usize| &self.occurrences[number]);
            let clamp = &self.model.drawings[around.instance.0].clamps[clamp];
            let lowest = lowest - holder.place.raised;
            let at = holder.place.back(around.place.of(pair(clamp.at)));
            let [x, y] = at.map(|coordinate| (coordinate * 1000.0).round() / 1000.0 + 0.0);
            let is_own = around.instance.0 == holder.instance.0
                && minus(at, pair(clamp.at)).iter().all(|gap| gap.abs() < LENGTH_TOLERANCE);
            let from = if is_own {
                format!("at ({}, {}),", clamp.at.x, clamp.at.y)
            } else {
                let drawing = &self.model.drawings[around.instance.0].path;
                format!(
                    "from {} at ({x}, {y}) of this drawing,",
                    drawing.rsplit('/').next().unwrap_or_default()
                )
            };
            Finding {
                code: "PB407".to_owned(),
                file: self.model.drawings[holder.instance.0].path.clone(),
                path: Some(holder.path.name.to_string()),
                handle: element,
                words: vec![
                    format!("the clamp of layer {} {from}", clamp.layer),
                    format!(": {what}{of_component}, lowest Z {lowest}, moves: {moves}"),
                ],
            }
        };
        entries.into_iter().map(finding).collect()
    }

    /// Whether a move hits a clamp: it is lower than the clamp, and closer than the cutter's radius.
    fn is_in(&self, motion: &Move, around: &Occurrence, clamp: &KeepOut) -> bool {
        let radius = self.occurrences[0].path.tool / 2.0;
        motion.z < clamp.height + around.place.raised - LENGTH_TOLERANCE
            && distance(motion.ends.map(|end| around.place.back(end)), &corners(clamp))
                < radius - LENGTH_TOLERANCE
    }

    /// Returns the innermost path that contains a clamp's drawing and a move, and the element of that path that leads to the move.
    fn common(&self, clamp: usize, motion: &Move) -> (usize, Option<String>) {
        let parent = |number: usize| self.occurrences[number].parent.as_ref();
        let around_clamp: Vec<usize> =
            std::iter::successors(Some(clamp), |number| parent(*number).map(|outer| outer.0)).collect();
        let mut at = (motion.occurrence, motion.element.clone());
        while let Some(outer) = parent(at.0).filter(|_| !around_clamp.contains(&at.0)) {
            at = outer.clone();
        }
        at
    }
}

impl Place {
    /// Returns the placement that maps the first inner point to the first outer point, and the direction between the inner points to the direction
    /// between the outer points.
    fn from_to(inner: [Pair; 2], outer: [Pair; 2], raised: f64) -> Self {
        let turn = times(direction(outer), conjugate(direction(inner)));
        Self { origin: minus(outer[0], times(turn, inner[0])), turn, raised }
    }

    fn of(&self, at: Pair) -> Pair {
        let turned = times(self.turn, at);
        [0, 1].map(|axis| self.origin[axis] + turned[axis])
    }

    fn back(&self, at: Pair) -> Pair {
        times(conjugate(self.turn), minus(at, self.origin))
    }
}

/// Returns the heights of the passes, from the surface down.
fn passes(surface: f64, infeed: f64, bottom: f64) -> impl Iterator<Item = f64> {
    let next = move |z: &f64| (*z > bottom + LENGTH_TOLERANCE).then(|| (z - infeed).max(bottom));
    std::iter::successors(Some(surface), next).skip(1)
}

/// Returns the minimum and maximum of X and Y of a rectangle.
fn corners(clamp: &KeepOut) -> [Pair; 2] {
    let points: Vec<Pair> = clamp.outline.iter().map(|curve| pair(curve.start())).collect();
    [0, 1].map(|axis| {
        let along = || points.iter().map(|point| point[axis]);
        [along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max)]
    })
}

/// Returns the distance between a line and a rectangle, for axis-parallel lines.
fn distance(ends: [Pair; 2], rectangle: &[Pair; 2]) -> f64 {
    let gap = [0, 1].map(|axis| {
        let (low, high) = (ends[0][axis].min(ends[1][axis]), ends[0][axis].max(ends[1][axis]));
        (rectangle[axis][0] - high).max(low - rectangle[axis][1]).max(0.0)
    });
    (gap[0] * gap[0] + gap[1] * gap[1]).sqrt()
}

fn pair(at: Xy) -> Pair {
    [at.x, at.y]
}

fn minus(a: Pair, b: Pair) -> Pair {
    [a[0] - b[0], a[1] - b[1]]
}

/// Returns the product of two complex numbers.
fn times(a: Pair, b: Pair) -> Pair {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn conjugate(a: Pair) -> Pair {
    [a[0], -a[1]]
}

fn direction([from, to]: [Pair; 2]) -> Pair {
    let along = minus(to, from);
    let length = (along[0] * along[0] + along[1] * along[1]).sqrt();
    along.map(|part| part / length)
}
