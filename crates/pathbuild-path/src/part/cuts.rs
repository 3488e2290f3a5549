//! The cuts of a drawing's paths against its parts. (book: language/part)

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use pathbuild_diagnostic::messages::part as messages;
use pathbuild_diagnostic::{Diagnostic, Severity};
use rstar::{AABB, Envelope, RTree};

use super::intervals::{GAP, Stretch, at as at_along, joined, within};
use super::leftover::{Leftover, LeftoverSearch, Leftovers};
use super::loose::is_cut_out;
use super::prepared::{Boxed, PreparedPart, index, near};
use super::{DrawnParts, Part, PartSettings};
use crate::element::shown;
use crate::geometry::{Curve, Xy};
use crate::keep_out::{Way, around};
use crate::names::SpeltName;
use crate::raw::DrawnElements;

/// The cuts of a path, in the coordinates and heights of its drawing.
#[derive(Clone, Debug)]
pub struct PathCuts {
    /// The path.
    pub name: SpeltName,
    /// Its drawn elements.
    pub drawn: Arc<DrawnElements>,
    /// Its moves in the material.
    pub cuts: Vec<PartCut>,
    /// The support bars that it leaves.
    pub bars: Vec<StandingBar>,
    /// Whether it embeds others, which may cut what it does not.
    pub has_subpaths: bool,
}

/// A move in the material.
#[derive(Clone, Copy, Debug)]
pub struct PartCut {
    /// The way of the tool tip.
    pub way: Way,
    /// Half of O in mm.
    pub radius: f64,
    /// Index into [`DrawnElements::elements`].
    pub element: u32,
}

/// A support bar.
#[derive(Clone, Copy, Debug)]
pub struct StandingBar {
    /// Its middle line, as far as the cuts beside it do not reach; `None` if they leave nothing of a half bar.
    pub middle: Option<Curve>,
    /// The way along which the tool stays above the plate because of the bar.
    pub foot: Curve,
    /// Z of its top.
    pub top: f64,
    /// Index into [`DrawnElements::elements`].
    pub element: u32,
}

/// What the check of a drawing's parts found.
#[derive(Clone, Debug, Default)]
pub struct PartFindings {
    /// Findings about the drawing.
    pub of_file: Vec<Diagnostic>,
    /// Findings about each path.
    pub of_paths: Vec<Vec<Diagnostic>>,
}

/// Height in mm above the plate up to which a cut counts as going through it.
pub(crate) const THROUGH: f64 = 0.001;

/// Depth in mm up to which a cut into a part is a warning.
const SHALLOW: f64 = 0.1;

/// Checks the cuts of all paths of a drawing against its parts. `is_complete`: whether the cuts of all its paths are known; otherwise what
/// is not cut is not reported.
pub fn check_parts(
    drawn: &DrawnParts,
    paths: &[PathCuts],
    is_complete: bool,
    settings: &PartSettings,
) -> PartFindings {
    let cuts: Vec<IndexedCuts<'_>> = paths.iter().map(IndexedCuts::new).collect();
    let mut findings = PartFindings { of_file: Vec::new(), of_paths: vec![Vec::new(); paths.len()] };
    let embeds_others = paths.iter().any(|path| path.has_subpaths);
    for (part, places) in drawn.parts.iter().zip(&drawn.places) {
        let part = PreparedPart::new(part);
        let near_paths: Vec<Vec<usize>> =
            (0..places.len()).map(|ring| part.near_paths(ring, &cuts)).collect();
        if is_complete && !embeds_others {
            for ring in part.nests_without(&near_paths) {
                let problem = Diagnostic::new(&messages::OUTLINE_NOT_CUT);
                findings.of_file.push(Diagnostic { place: places[ring].clone(), ..problem });
            }
        }
        let owners: BTreeSet<usize> = near_paths.iter().flatten().copied().collect();
        let union = PartCheck { part: &part, cuts: &cuts, owners: &owners, settings };
        for owner in &owners {
            let gouges = gouges(&part, &cuts[*owner], THROUGH, settings.tolerance);
            findings.of_paths[*owner].extend(gouges.iter().map(|gouge| paths[*owner].gouge_problem(gouge)));
        }
        if is_complete {
            for (owner, problem) in union.leftovers().into_iter().chain(union.loose()) {
                findings.of_paths[owner].push(problem);
            }
        }
    }
    if !drawn.parts.is_empty() {
        for (offender, problem) in bars_cut_away(&cuts, settings.tolerance) {
            findings.of_paths[offender].push(problem);
        }
    }
    findings
}

/// Checks the cuts of one path against the parts of its drawing, for other values of its variables than those of
/// [`check_parts`].
pub fn check_path(parts: &[Part], path: &PathCuts, settings: &PartSettings) -> Vec<Diagnostic> {
    let cuts = IndexedCuts::new(path);
    let mut found = Vec::new();
    for part in parts {
        let part = PreparedPart::new(part);
        let is_near = |ring: usize| !part.near_paths(ring, std::slice::from_ref(&cuts)).is_empty();
        if (0..part.part.rings.len()).any(is_near) {
            let gouges = gouges(&part, &cuts, THROUGH, settings.tolerance);
            found.extend(gouges.iter().map(|gouge| path.gouge_problem(gouge)));
        }
    }
    found
}

/// A cut into a part by an element.
#[derive(Clone, Debug, PartialEq)]
struct Gouge {
    /// Index into [`DrawnElements::elements`].
    element: u32,
    /// The centre of the cutter where it goes deepest into the part.
    at: Xy,
    /// How deep, in mm.
    depth: f64,
    /// Over what length, in mm along the way of the cutter.
    length: f64,
}

/// The cuts into a placed part, by their numbers. `level`: the height in mm of the plate below the part.
pub fn cuts_into(part: &Part, cuts: &[(Way, f64)], level: f64, tolerance: f64) -> Vec<(usize, Xy, f64, f64)> {
    let prepared = PreparedPart::new(part);
    let extent = prepared.extent();
    let mut found = Vec::new();
    for (number, (way, radius)) in cuts.iter().enumerate() {
        let Some(curve) = way.below(level + THROUGH) else { continue };
        if !around(&curve, *radius).intersects(&extent) {
            continue;
        }
        let entered = prepared.entered(&curve, *radius, tolerance);
        let deepest = entered.iter().map(|stretch| prepared.deepest(&curve, *stretch, *radius));
        let deepest = deepest.reduce(|best, next| if next.1 > best.1 { next } else { best });
        if let Some((at, depth)) = deepest {
            found.push((number, at, depth, entered.iter().map(|(from, to)| to - from).sum()));
        }
    }
    found
}

/// The cuts of a path into a part of its drawing, one for each element.
fn gouges(part: &PreparedPart<'_>, cuts: &IndexedCuts<'_>, level: f64, tolerance: f64) -> Vec<Gouge> {
    let mut found: BTreeMap<u32, (Gouge, BTreeMap<i64, f64>)> = BTreeMap::new();
    for cut in cuts.in_box(part.extent()) {
        let Some(curve) = cut.way.below(level) else { continue };
        for stretch in part.entered(&curve, cut.radius, tolerance) {
            let (at, depth) = part.deepest(&curve, stretch, cut.radius);
            let new = Gouge { element: cut.element, at, depth, length: 0.0 };
            let (gouge, passes) = found.entry(cut.element).or_insert_with(|| (new.clone(), BTreeMap::new()));
            if depth > gouge.depth {
                *gouge = new;
            }
            // Passes at several depths run along the same stretch.
            #[expect(clippy::cast_possible_truncation, reason = "a height in micrometres")]
            let pass = (cut.way.lowest() * 1000.0).round() as i64;
            *passes.entry(pass).or_default() += stretch.1 - stretch.0;
        }
    }
    let longest = |passes: BTreeMap<i64, f64>| passes.into_values().fold(0.0, f64::max);
    found.into_values().map(|(gouge, passes)| Gouge { length: longest(passes), ..gouge }).collect()
}

/// A part with the paths that cut it, for what is judged on all their cuts together.
struct PartCheck<'s> {
    part: &'s PreparedPart<'s>,
    cuts: &'s [IndexedCuts<'s>],
    owners: &'s BTreeSet<usize>,
    settings: &'s PartSettings,
}

impl PartCheck<'_> {
    /// PB215, one for each element beside which material is left, and PB216. Each with its path.
    fn leftovers(&self) -> Vec<(usize, Diagnostic)> {
        let search = LeftoverSearch::new(self.part, self.cuts, self.owners, self.settings.tolerance);
        let Leftovers { stretches, corner } = search.leftovers();
        let mut of_elements: BTreeMap<(usize, u32, bool), Vec<Leftover>> = BTreeMap::new();
        for left in stretches {
            of_elements.entry((left.path, left.element, left.height.is_some())).or_default().push(left);
        }
        let mut found: Vec<(usize, Diagnostic)> = Vec::new();
        for ((path, element, _), stretches) in of_elements {
            let longer = |best: &Leftover, next: &Leftover| next.length > best.length;
            let count = stretches.len();
            let longest =
                stretches.into_iter().reduce(|best, next| if longer(&best, &next) { next } else { best });
            let Some(left) = longest else { continue };
            let problem = match left.height {
                Some(height) => Diagnostic::new(&messages::NOT_CUT_THROUGH).with("height", height),
                None => Diagnostic::new(&messages::LEFTOVER).with("thickness", left.thickness),
            };
            let problem = problem
                .with("from", shown(left.from))
                .with("to", shown(left.to))
                .with("length", left.length)
                .with("count", count);
            found.push((path, self.cuts[path].path.at_element(element, problem)));
        }
        if let Some((at, length, path, element)) = corner {
            let radius = self.cuts[path].path.cuts.iter().find(|cut| cut.element == element);
            let problem = Diagnostic::new(&messages::UNREACHABLE_CORNER)
                .with("tool", 2.0 * radius.map_or(0.0, |cut| cut.radius))
                .with("point", shown(at))
                .with("length", length);
            found.push((path, self.cuts[path].path.at_element(element, problem)));
        }
        found
    }

    /// PB217 if the part is cut out all round, in the first of its paths.
    fn loose(&self) -> Option<(usize, Diagnostic)> {
        if self.settings.is_held_otherwise {
            return None;
        }
        let all = self
            .owners
            .iter()
            .flat_map(|owner| self.cuts[*owner].path.cuts.iter().map(move |cut| (*owner, cut)));
        let through: Vec<(usize, u32, Curve, f64)> = all
            .filter_map(|(owner, cut)| Some((owner, cut.element, cut.way.below(THROUGH)?, cut.radius)))
            .collect();
        let sweeps: Vec<(Curve, f64)> =
            through.iter().map(|(_, _, curve, radius)| (*curve, *radius)).collect();
        if !is_cut_out(self.part, &sweeps) {
            return None;
        }
        let outer = &self.part.part.rings[0].curves;
        let distance =
            |curve: &Curve| outer.iter().map(|ring| ring.distance(curve)).fold(f64::INFINITY, f64::min);
        let first = through.iter().find(|(_, _, curve, radius)| distance(curve) < 2.0 * radius);
        let (owner, element, ..) = first.or(through.first())?;
        let problem = Diagnostic::new(&messages::LOOSE_PART).with("point", shown(outer[0].start()));
        Some((*owner, self.cuts[*owner].path.at_element(*element, problem)))
    }
}

/// Share of a bar that may be cut away.
const BAR_LOSS: f64 = 0.05;

/// PB218 for each element that cuts a bar away, with its path.
fn bars_cut_away(cuts: &[IndexedCuts<'_>], tolerance: f64) -> Vec<(usize, Diagnostic)> {
    let mut found = Vec::new();
    for of_bar in cuts {
        for bar in &of_bar.path.bars {
            let Some(middle) = &bar.middle else { continue };
            let mut gone: BTreeMap<(usize, u32), Vec<Stretch>> = BTreeMap::new();
            for (number, path) in cuts.iter().enumerate() {
                for cut in path.near(middle) {
                    let Some(below) = cut.way.below(bar.top - tolerance) else { continue };
                    let mut stretches = Vec::new();
                    within(middle, &below, cut.radius - tolerance, &mut stretches);
                    if !stretches.is_empty() {
                        gone.entry((number, cut.element)).or_default().append(&mut stretches);
                    }
                }
            }
            let length = middle.length();
            let of_elements = gone.into_iter().map(|(element, stretches)| {
                let lost: f64 = joined(stretches, GAP).iter().map(|(from, to)| to - from).sum();
                (element, lost)
            });
            for ((path, element), lost) in of_elements.filter(|(_, lost)| *lost > BAR_LOSS * length) {
                let problem = Diagnostic::new(&messages::BAR_CUT_AWAY)
                    .with("lost", lost)
                    .with("length", length)
                    .with("point", shown(at_along(middle, length / 2.0)))
                    .quoting("other", of_bar.path.name.as_str());
                found.push((path, cuts[path].path.at_element(element, problem)));
            }
        }
    }
    found
}

impl PathCuts {
    fn gouge_problem(&self, gouge: &Gouge) -> Diagnostic {
        let problem = Diagnostic::new(&messages::GOUGE)
            .with("depth", gouge.depth)
            .with("point", shown(gouge.at))
            .with("length", gouge.length);
        let mut problem = self.at_element(gouge.element, problem);
        if gouge.depth <= SHALLOW {
            problem.severity = Severity::Warning;
        }
        problem
    }

    fn at_element(&self, element: u32, problem: Diagnostic) -> Diagnostic {
        let element = &self.drawn.elements[element as usize];
        self.drawn.origin(element).at(problem).in_path(self.name.as_str())
    }
}

/// The cuts of a path with an index of their boxes, which are widened by the cutter's diameter.
pub(crate) struct IndexedCuts<'c> {
    pub(crate) path: &'c PathCuts,
    boxes: RTree<Boxed>,
}

impl<'c> IndexedCuts<'c> {
    pub(crate) fn new(path: &'c PathCuts) -> Self {
        Self {
            boxes: index(path.cuts.iter().map(|cut| around(&cut.way.curve, 2.0 * cut.radius + GAP))),
            path,
        }
    }

    /// The cuts whose cutter may come within its diameter of a curve.
    pub(crate) fn near(&self, curve: &Curve) -> impl Iterator<Item = &'c PartCut> {
        self.in_box(around(curve, 0.0))
    }

    /// The cuts whose cutter may come within its diameter of a box.
    pub(super) fn in_box(&self, extent: AABB<[f64; 2]>) -> impl Iterator<Item = &'c PartCut> {
        near(&self.boxes, extent).into_iter().map(|number| &self.path.cuts[number])
    }
}

impl PreparedPart<'_> {
    /// The paths that come within O of a ring.
    fn near_paths(&self, ring: usize, paths: &[IndexedCuts<'_>]) -> Vec<usize> {
        let curves = &self.part.rings[ring].curves;
        let comes_near = |path: &IndexedCuts<'_>| {
            self.part.may_belong_to(&path.path.name)
                && curves
                    .iter()
                    .any(|curve| path.near(curve).any(|cut| cut.way.curve.distance(curve) < 2.0 * cut.radius))
        };
        (0..paths.len()).filter(|path| comes_near(&paths[*path])).collect()
    }

    /// One ring of each nest that no path comes near.
    fn nests_without(&self, near_paths: &[Vec<usize>]) -> Vec<usize> {
        let rings = &self.part.rings;
        let is_near = |nest: usize| {
            (0..rings.len()).any(|ring| rings[ring].nest == nest && !near_paths[ring].is_empty())
        };
        (0..rings.len()).filter(|ring| rings[*ring].nest == *ring && !is_near(*ring)).collect()
    }
}
