//! The check that the cuts of a drawing leave its parts as drawn. (book: language/part)

use std::collections::BTreeMap;

use pathbuild_diagnostic::messages::part as messages;
use pathbuild_diagnostic::{Diagnostic, Severity};

use super::bars::bars_cut_away;
use super::cuts::{CutIndex, PathCuts};
use super::gouge::{Gouge, JudgedCut, gouges, judged};
use super::leftover::{Leftover, LeftoverSearch, Leftovers, UnreachableOutline};
use super::loose::is_cut_out;
use super::prepared::PreparedPart;
use super::{DrawnParts, Part, PartSettings};
use crate::element::shown;
use crate::geometry::Curve;
use crate::keep_out::around;

/// What the check of a drawing's parts found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PartFindings {
    /// Findings about the drawing.
    pub of_file: Vec<Diagnostic>,
    /// Findings about each path.
    pub of_paths: Vec<Vec<Diagnostic>>,
}

/// Depth in mm up to which a cut into a part is a warning.
const SHALLOW: f64 = 0.1;

/// Checks the cuts of all paths of a drawing against its parts. `is_complete`: whether the cuts of all its paths are known; otherwise what
/// is not cut is not reported.
pub fn check_parts(
    drawn: &DrawnParts,
    paths: &[&PathCuts],
    is_complete: bool,
    settings: &PartSettings,
) -> PartFindings {
    let mut findings = PartFindings { of_file: Vec::new(), of_paths: vec![Vec::new(); paths.len()] };
    if drawn.parts.is_empty() {
        return findings;
    }
    let cuts = CutIndex::new(paths);
    let embeds_others = paths.iter().any(|path| path.has_subpaths);
    for (part, places) in drawn.parts.iter().zip(&drawn.places) {
        let part = PreparedPart::new(part);
        let check = PartCheck::new(&part, &cuts, settings);
        if is_complete && !embeds_others {
            let problem = || Diagnostic::new(&messages::OUTLINE_NOT_CUT);
            let uncut = check.nests_without_cuts();
            findings
                .of_file
                .extend(uncut.map(|ring| Diagnostic { place: places[ring].clone(), ..problem() }));
        }
        for (path, problem) in check.problems(is_complete) {
            findings.of_paths[path].push(problem);
        }
    }
    for (path, problem) in bars_cut_away(&cuts, settings.tolerance) {
        findings.of_paths[path].push(problem);
    }
    findings
}

/// Checks the cuts of one path against the parts of its drawing, for other values of its variables than those of
/// [`check_parts`].
pub fn check_path(parts: &[Part], path: &PathCuts, settings: &PartSettings) -> Vec<Diagnostic> {
    let paths = [path];
    let cuts = CutIndex::new(&paths);
    let mut found = Vec::new();
    for part in parts {
        let part = PreparedPart::new(part);
        found.extend(PartCheck::new(&part, &cuts, settings).gouged().map(|(_, problem)| problem));
    }
    found
}

/// A part with the paths that cut it.
struct PartCheck<'s> {
    part: &'s PreparedPart<'s>,
    cuts: &'s CutIndex<'s>,
    settings: &'s PartSettings,
    /// For each ring, whether each path comes within O of it.
    near_paths: Vec<Vec<bool>>,
    /// For each path, whether it cuts the part.
    owners: Vec<bool>,
    /// Cuts of the owners by number.
    judged: BTreeMap<usize, JudgedCut<'s>>,
}

impl<'s> PartCheck<'s> {
    fn new(part: &'s PreparedPart<'s>, cuts: &'s CutIndex<'s>, settings: &'s PartSettings) -> Self {
        let near_paths: Vec<Vec<bool>> =
            part.part.rings.iter().map(|ring| near_paths(part.part, &ring.curves, cuts)).collect();
        let is_owner = |path: usize| near_paths.iter().any(|near| near[path]);
        let owners: Vec<bool> = (0..cuts.paths.len()).map(is_owner).collect();
        let near = cuts.near(part.extent()).into_iter().filter(|cut| owners[cuts.cuts[*cut].path]);
        let judged = judged(part, cuts, near, settings.tolerance);
        Self { part, cuts, settings, near_paths, owners, judged }
    }

    /// One ring of each nest that no path comes near.
    fn nests_without_cuts(&self) -> impl Iterator<Item = usize> {
        let rings = &self.part.part.rings;
        let is_near = |nest: usize| {
            let mut near = rings.iter().zip(&self.near_paths).filter(|(ring, _)| ring.nest == nest);
            near.any(|(_, paths)| paths.contains(&true))
        };
        (0..rings.len()).filter(move |ring| rings[*ring].nest == *ring && !is_near(*ring))
    }

    /// The findings about the owners, each with its path. What is not cut is judged on the cuts of all of them together.
    fn problems(&self, is_complete: bool) -> Vec<(usize, Diagnostic)> {
        let mut found: Vec<_> = self.gouged().collect();
        if is_complete {
            found.extend(self.left_over());
            found.extend(self.loose());
        }
        found
    }

    /// PB213.
    fn gouged(&self) -> impl Iterator<Item = (usize, Diagnostic)> {
        let gouges = gouges(self.part, self.judged.values());
        gouges.into_iter().map(|((path, element), gouge)| {
            (path, self.cuts.paths[path].at_element(element, gouge_problem(&gouge)))
        })
    }

    /// PB215, one for each element beside which material is left, and PB216.
    fn left_over(&self) -> Vec<(usize, Diagnostic)> {
        let tolerance = self.settings.tolerance;
        let search = LeftoverSearch::new(self.part, self.cuts, &self.judged, &self.owners, tolerance);
        let Leftovers { stretches, unreachable } = search.leftovers();
        let mut of_elements: BTreeMap<(usize, u32, bool), Vec<Leftover>> = BTreeMap::new();
        for left in stretches {
            of_elements.entry((left.path, left.element, left.height.is_some())).or_default().push(left);
        }
        let mut found: Vec<(usize, Diagnostic)> = Vec::new();
        for ((path, element, _), stretches) in of_elements {
            let problem = leftover_problem(&stretches);
            found.extend(problem.map(|problem| (path, self.cuts.paths[path].at_element(element, problem))));
        }
        found.extend(unreachable.map(|UnreachableOutline { at, length, path, element }| {
            let path_cuts = self.cuts.paths[path];
            let problem = Diagnostic::new(&messages::UNREACHABLE_CORNER)
                .with("tool", 2.0 * path_cuts.radius)
                .with("point", shown(at))
                .with("length", length);
            (path, path_cuts.at_element(element, problem))
        }));
        found
    }

    /// PB217 if the part is cut out all round, in the first of its paths.
    fn loose(&self) -> Option<(usize, Diagnostic)> {
        if self.settings.is_held_otherwise {
            return None;
        }
        let own = self.cuts.cuts.iter().filter(|cut| self.owners[cut.path]);
        let through: Vec<_> = own.filter_map(|cut| Some((cut, cut.through?))).collect();
        let sweeps: Vec<(Curve, f64)> = through.iter().map(|(cut, curve)| (*curve, cut.radius)).collect();
        let near = |curve: &Curve, radius: f64| {
            rstar::Envelope::intersects(&around(curve, 2.0 * radius), &self.part.extent())
        };
        let paths = self.cuts.paths.iter().zip(&self.owners).filter(|(_, is_owner)| **is_owner);
        let bars = paths.flat_map(|(path, _)| path.bars.iter().map(|bar| (bar, path.radius)));
        let near_bars = bars.filter(|(bar, radius)| near(&bar.foot, *radius));
        if !is_cut_out(self.part, &sweeps, near_bars) {
            return None;
        }
        let outer = &self.part.part.rings[0].curves;
        let distance =
            |curve: &Curve| outer.iter().map(|ring| ring.distance(curve)).fold(f64::INFINITY, f64::min);
        let first = through.iter().find(|(cut, curve)| distance(curve) < 2.0 * cut.radius);
        let (cut, _) = first.or(through.first())?;
        let problem = Diagnostic::new(&messages::LOOSE_PART).with("point", shown(outer[0].start()));
        Some((cut.path, self.cuts.paths[cut.path].at_element(cut.cut.element, problem)))
    }
}

/// For each path, whether it comes within O of a ring of a part that it may cut.
fn near_paths(part: &Part, ring: &[Curve], cuts: &CutIndex<'_>) -> Vec<bool> {
    let may_cut: Vec<bool> = cuts.paths.iter().map(|path| part.may_belong_to(&path.name)).collect();
    let mut is_near = vec![false; may_cut.len()];
    for curve in ring {
        for number in cuts.near(around(curve, 0.0)) {
            let cut = &cuts.cuts[number];
            is_near[cut.path] = is_near[cut.path]
                || may_cut[cut.path] && cut.cut.way.curve.distance(curve) < 2.0 * cut.radius;
        }
        if is_near == may_cut {
            break;
        }
    }
    is_near
}

fn gouge_problem(gouge: &Gouge) -> Diagnostic {
    let mut problem = Diagnostic::new(&messages::GOUGE)
        .with("depth", gouge.depth)
        .with("point", shown(gouge.at))
        .with("length", gouge.length);
    if gouge.depth <= SHALLOW {
        problem.severity = Severity::Warning;
    }
    problem
}

/// PB215 for what an element leaves, with the longest stretch. `None` without any.
fn leftover_problem(stretches: &[Leftover]) -> Option<Diagnostic> {
    let longer = |best: &'_ Leftover, next: &'_ Leftover| next.length > best.length;
    let left = stretches.iter().reduce(|best, next| if longer(best, next) { next } else { best })?;
    let problem = match left.height {
        Some(height) => Diagnostic::new(&messages::NOT_CUT_THROUGH).with("height", height),
        None => Diagnostic::new(&messages::LEFTOVER).with("thickness", left.thickness),
    };
    let problem = problem.with("from", shown(left.from)).with("to", shown(left.to));
    Some(problem.with("length", left.length).with("count", stretches.len()))
}
