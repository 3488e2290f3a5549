//! The check that the cuts of a drawing leave its parts as drawn. (book: language/part)

use std::collections::{BTreeMap, BTreeSet};

use pathbuild_diagnostic::messages::part as messages;
use pathbuild_diagnostic::{Code, Diagnostic, Severity};

use super::bars::{LostBar, lost_bars};
use super::cuts::{CutIndex, IndexedCut, PathCuts};
use super::enclosure::Enclosure;
use super::gouge::{ClassifiedCut, ClassifiedCuts, Gouge, classify_cuts, gouges};
use super::intervals::offset_curve;
use super::leftover::{
    AdjacentCut, Leftover, LeftoverMaterial, LeftoverSearch, Leftovers, UnreachableOutline,
};
use super::prepared::{PreparedPart, Side};
use super::{Part, PartRing, PartSettings};
use crate::boxes::{may_be_near, widened_box};
use crate::element::diagnostic_point;
use crate::geometry::{Curve, Xy};

/// The result of checking a drawing's parts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PartFindings {
    /// The outlines that no path cuts out: for each, the index of its part, and of the ring in the part.
    pub uncut: Vec<(usize, usize)>,
    /// The outlines in openings that are cut out like parts, with support bars or a cut all round; with the same indices as `uncut`.
    pub inner: Vec<(usize, usize)>,
    /// The findings about each path, by the index of the path.
    pub of_paths: Vec<Vec<Diagnostic>>,
    /// For each path, the indices of the parts that may belong to it and to which it comes within O, and of those that its cuts spoil.
    pub parts: Vec<Vec<usize>>,
    /// The material that each path leaves at outlines, by path.
    pub left: Vec<Vec<LeftoverMaterial>>,
    /// The parts that nothing holds: for each, its index, and that of the path whose cut makes it loose.
    pub loose: Vec<(usize, usize)>,
    /// For each path, the centre lines of its support bars that are cut away.
    pub lost_bars: Vec<Vec<Curve>>,
    /// For each part, the stretches of its outlines that the cutter does not reach.
    pub corners: Vec<Vec<Curve>>,
}

/// Depth in micrometres up to which a cut into a part is a warning. Depths are rounded to micrometres, as in the message, before they are compared.
const MAX_WARNING_DEPTH: f64 = 100.0;

/// Checks the cuts of all paths of a drawing against its parts. `is_complete`: whether the cuts of all its paths are known; otherwise
/// missing cuts are not reported.
pub fn check_parts(
    parts: &[Part],
    paths: &[&PathCuts],
    is_complete: bool,
    settings: &PartSettings,
) -> PartFindings {
    let none = PartFindings {
        uncut: Vec::new(),
        inner: Vec::new(),
        of_paths: vec![Vec::new(); paths.len()],
        parts: vec![Vec::new(); paths.len()],
        left: vec![Vec::new(); paths.len()],
        loose: Vec::new(),
        lost_bars: vec![Vec::new(); paths.len()],
        corners: Vec::new(),
    };
    if parts.is_empty() {
        return none;
    }
    let mut findings = none;
    let cuts = CutIndex::new(paths);
    let embeds_others = paths.iter().any(|path| !path.embedded.is_empty());
    for (number, part) in parts.iter().enumerate() {
        let part = PreparedPart::new(part);
        let check = PartCheck::new(&part, &cuts, settings);
        let leftovers = if is_complete { check.leftovers() } else { Leftovers::default() };
        if is_complete && !embeds_others {
            // PB215 already reports a nest with leftover material.
            let is_reported = |nest: &usize| leftovers.stretches.iter().any(|left| left.nest == *nest);
            let uncut = check.nests_without_cuts().filter(|nest| !is_reported(nest));
            findings.uncut.extend(uncut.map(|ring| (number, ring)));
        }
        findings.inner.extend(check.inner_parts().map(|ring| (number, ring)));
        for (path, problem) in check.problems(is_complete, &leftovers) {
            if problem.code() == Code::LoosePart {
                findings.loose.push((number, path));
            }
            findings.of_paths[path].push(problem);
        }
        findings.corners.push(leftovers.corners);
        for left in leftovers.stretches {
            findings.left[left.path].push(left.material);
        }
        let entering = check.entering_paths();
        for (path, is_owner) in check.owners.iter().enumerate() {
            if *is_owner || entering.contains(&path) {
                findings.parts[path].push(number);
            }
        }
    }
    findings.add_lost_bars(&lost_bars(&cuts, settings.tolerance), paths);
    findings
}

impl PartFindings {
    /// Adds PB218, once for each element that takes bars away from a path.
    fn add_lost_bars(&mut self, lost: &[LostBar], paths: &[&PathCuts]) {
        let mut of_elements: BTreeMap<(usize, u32, usize), Vec<&LostBar>> = BTreeMap::new();
        for bar in lost {
            self.lost_bars[bar.path].extend(&bar.sections);
            of_elements.entry((bar.cut_by, bar.element, bar.path)).or_default().push(bar);
        }
        for ((cut_by, element, path), bars) in of_elements {
            let problem = LostBar::problem(bars, paths[path], &messages::BAR_CUT_AWAY);
            self.of_paths[cut_by].extend(problem.map(|problem| paths[cut_by].at_element(element, problem)));
        }
    }
}

/// A part with the paths that cut it.
struct PartCheck<'s> {
    part: &'s PreparedPart<'s>,
    cuts: &'s CutIndex<'s>,
    settings: &'s PartSettings,
    /// For each ring, whether a cut that may cut it out comes near.
    is_cut: Vec<bool>,
    /// For each path, whether it may own the part and comes within O of one of its rings. Only these paths, the owners, can leave material at the
    /// part.
    owners: Vec<bool>,
    /// For each path, whether it is an owner that cuts parts out.
    contours: Vec<bool>,
    /// The classified cuts of all paths near the part.
    judged: ClassifiedCuts<'s>,
}

impl<'s> PartCheck<'s> {
    fn new(part: &'s PreparedPart<'s>, cuts: &'s CutIndex<'s>, settings: &'s PartSettings) -> Self {
        let judged = classify_cuts(part, cuts, cuts.near(part.extent()), settings.tolerance);
        let rings = 0..part.part.rings.len();
        let may_cut: Vec<bool> = cuts.paths.iter().map(|path| part.part.may_belong_to(&path.name)).collect();
        let near = |ring: usize| near_paths(part.part, ring, &may_cut, cuts, &judged);
        let near: Vec<NearPaths> = rings.map(near).collect();
        let is_owner = |path: usize| near.iter().any(|near| near.paths[path]);
        let owners: Vec<bool> = (0..cuts.paths.len()).map(is_owner).collect();
        let contours = owners.iter().zip(&cuts.contours).map(|(own, contour)| *own && *contour).collect();
        let is_cut = near.iter().map(|near| near.is_cut).collect();
        Self { part, cuts, settings, is_cut, owners, contours, judged }
    }

    /// Returns the outermost ring of each nest that no path cuts out.
    fn nests_without_cuts(&self) -> impl Iterator<Item = usize> {
        let part = self.part.part;
        let is_cut = |nest: usize| (0..).zip(&self.is_cut).any(|(ring, cut)| *cut && part.nest(ring) == nest);
        (0..part.rings.len()).filter(move |ring| part.nest(*ring) == *ring && !is_cut(*ring))
    }

    /// Returns the rings in openings that paths cut out like parts: support bars stand along their outside, or cuts follow it all round. Bars and
    /// cuts at the edge of a ring around them do not count, because they hold or clear the waste of that ring.
    fn inner_parts(&self) -> impl Iterator<Item = usize> {
        let rings = self.part.part.rings.iter().enumerate();
        let inner = rings.filter(|(_, drawn)| !drawn.around.is_empty());
        let is_cut = |ring: usize, drawn: &PartRing| {
            self.has_bars_outside(ring, drawn) || self.has_cut_around(ring, drawn)
        };
        inner.filter(move |(ring, drawn)| is_cut(*ring, drawn)).map(|(ring, _)| ring)
    }

    /// Whether support bars stand along the outside of a ring.
    fn has_bars_outside(&self, ring: usize, drawn: &PartRing) -> bool {
        let rings = || self.part.part.rings.iter().enumerate();
        let is_near = |ring: &PartRing, bar: &Curve, reach: f64| {
            ring.curves.iter().any(|curve| may_be_near(curve, bar, reach) && curve.distance(bar) < reach)
        };
        let paths = self.cuts.paths.iter().filter(|path| self.part.part.may_belong_to(&path.name));
        let bars = paths.flat_map(|path| path.bars.iter().map(|bar| (bar.foot, path.radius)));
        bars.filter(|(bar, radius)| is_near(drawn, bar, 2.0 * radius)).any(|(bar, radius)| {
            let middle = bar.middle();
            let Side::Openings(around) = self.part.side(middle) else { return false };
            let reach = radius + self.settings.tolerance;
            !around.contains(&ring)
                && !rings().any(|(ring, other)| around.contains(&ring) && is_near(other, &bar, reach))
        })
    }

    /// Whether cuts through the plate follow the whole outside of a ring within O, and none lies directly inside the ring.
    fn has_cut_around(&self, ring: usize, drawn: &PartRing) -> bool {
        let is_followed = |curve: &Curve, share: f64| {
            let extent = widened_box(curve, 0.0);
            self.cuts.near(extent).any(|number| self.is_beside_outside(ring, curve, share, number))
        };
        let shares = [0.25, 0.5, 0.75];
        drawn.curves.iter().all(|curve| shares.iter().all(|share| is_followed(curve, *share)))
            && !self.judged.iter().any(|judged| self.is_directly_in(ring, judged))
    }

    /// Whether a cut through the plate runs beside a point of a ring's curve, on its outside and within O. A cut nearer to where the edge of a ring
    /// around it would be cut is meant for that edge.
    fn is_beside_outside(&self, ring: usize, curve: &Curve, share: f64, number: usize) -> bool {
        let cut = &self.cuts.cuts[number];
        let IndexedCut { path, radius, .. } = cut;
        // The right of an opening's curves is inside it.
        let Some((through, away)) = cut.through_section().zip(offset_curve(curve, -radius)) else {
            return false;
        };
        let at = away.at(share * away.length());
        let Side::Openings(around) = self.part.side(at) else { return false };
        let rings = &self.part.part.rings;
        let error = through.distance_to(at);
        let reach = radius + self.settings.tolerance + 2.0 * error;
        let is_at_edge = |ring: &usize| rings[*ring].curves.iter().any(|curve| curve.distance_to(at) < reach);
        self.part.part.may_belong_to(&self.cuts.paths[*path].name)
            && error < *radius
            && !around.contains(&ring)
            && !around.iter().any(is_at_edge)
    }

    /// Whether a cut through the plate lies in a ring, but in none of the rings inside that ring.
    fn is_directly_in(&self, ring: usize, judged: &ClassifiedCut<'_>) -> bool {
        let Side::Openings(around) = &judged.side else { return false };
        let is_in_ring = |inner: &usize| {
            let start = self.part.part.rings[*inner].curves[0].start();
            *inner != ring
                && matches!(self.part.side(start), Side::Openings(around) if around.contains(&ring))
        };
        judged.cut.through_section().is_some() && around.contains(&ring) && !around.iter().any(is_in_ring)
    }

    /// Returns the findings about the part, each with the index of its path. Whether material is left depends on the cuts of all owners together.
    fn problems(&self, is_complete: bool, leftovers: &Leftovers) -> Vec<(usize, Diagnostic)> {
        let mut found: Vec<_> = self.gouge_findings().collect();
        found.extend(self.leftover_findings(leftovers));
        if is_complete {
            found.extend(self.loose_part_finding());
        }
        found
    }

    /// Returns PB213 for the cuts into the part.
    fn gouge_findings(&self) -> impl Iterator<Item = (usize, Diagnostic)> {
        let gouges = gouges(self.part, self.cuts, &self.judged);
        gouges.into_iter().map(|((path, element), gouge)| {
            let path_cuts = self.cuts.paths[path];
            let cut = &path_cuts.elements[element as usize];
            let mut problem = gouge_problem(&gouge, path_cuts.radius, cut.circle.is_some());
            let centre = cut.circle.or_else(|| (gouge.length() == 0.0).then_some(gouge.at));
            let is_rim =
                |centre: Xy| self.is_rim_circle(centre, (gouge.at - centre).norm() + path_cuts.radius);
            if cut.supported.is_none() && centre.is_some_and(is_rim) {
                problem =
                    Diagnostic::new(&messages::GOUGED_BY_ITS_HOLE).quoting("layer", &*self.part.part.layer);
            }
            (path, path_cuts.at_element(element, problem))
        })
    }

    /// Whether the part is a disc without openings, and this circle its rim.
    fn is_rim_circle(&self, centre: Xy, radius: f64) -> bool {
        let [rim] = &*self.part.part.rings else { return false };
        let is_on_circle = |point: &Xy| ((point - centre).norm() - radius).abs() <= self.settings.tolerance;
        rim.curves.iter().all(|curve| [curve.start(), curve.middle()].iter().all(is_on_circle))
    }

    /// Returns the paths with cuts that go into the part and must not.
    fn entering_paths(&self) -> BTreeSet<usize> {
        self.judged.spoiling.iter().map(|section| section.cut.path).collect()
    }

    fn leftovers(&self) -> Leftovers {
        let tolerance = self.settings.tolerance;
        LeftoverSearch::new(self.part, self.cuts, &self.judged, &self.contours, tolerance).leftovers()
    }

    /// Returns PB215 for each element beside which material is left, and PB216 for outlines that the cutter cannot reach.
    fn leftover_findings(
        &self,
        Leftovers { stretches, unreachable, .. }: &Leftovers,
    ) -> Vec<(usize, Diagnostic)> {
        let mut of_elements: BTreeMap<(usize, u32, bool), Vec<&Leftover>> = BTreeMap::new();
        for left in stretches {
            let is_through = left.beside == AdjacentCut::ThroughCut;
            of_elements.entry((left.path, left.element, !is_through)).or_default().push(left);
        }
        let mut found: Vec<(usize, Diagnostic)> = Vec::new();
        for ((path, element, _), stretches) in of_elements {
            let problem = leftover_problem(&stretches, self.cuts.paths[path].corner_radius);
            found.extend(problem.map(|problem| (path, self.cuts.paths[path].at_element(element, problem))));
        }
        found.extend(unreachable.iter().map(|UnreachableOutline { at, length, path, element }| {
            let path_cuts = self.cuts.paths[*path];
            let problem = Diagnostic::new(&messages::UNREACHABLE_CORNER)
                .with("tool", 2.0 * path_cuts.radius)
                .with("point", diagnostic_point(*at))
                .with("length", *length);
            (*path, path_cuts.at_element(*element, problem))
        }));
        found
    }

    /// Returns PB217 if the part is cut out all round: reported at a cut of its own paths or, if those alone do not suffice, at the cut of another
    /// path that separates it from the plate.
    fn loose_part_finding(&self) -> Option<(usize, Diagnostic)> {
        if self.settings.is_held_otherwise {
            return None;
        }
        let owner = self.contours.iter().position(|is_contour| *is_contour)?;
        let enclosure = Enclosure::new(self.part, self.cuts, &self.contours);
        let start = diagnostic_point(self.part.part.rings[0].curves[0].start());
        if let Some(cut) = enclosure.own_cut() {
            return Some(self.at(cut, Diagnostic::new(&messages::LOOSE_PART).with("point", start)));
        }
        let problem = Diagnostic::new(&messages::SEVERED_PART)
            .quoting("other", self.cuts.paths[owner].name.as_str())
            .with("point", start);
        Some(self.at(enclosure.severing_cut()?, problem))
    }

    fn at(&self, cut: &IndexedCut<'_>, problem: Diagnostic) -> (usize, Diagnostic) {
        (cut.path, self.cuts.paths[cut.path].at_element(cut.cut.element, problem))
    }
}

/// The paths that come within O of a ring.
struct NearPaths {
    /// For each path, whether it may cut the part and comes near.
    paths: Vec<bool>,
    /// Whether one of their cuts may cut the ring out.
    is_cut: bool,
}

/// Finds the paths whose cuts come within O of a ring of the part, among those that the part may belong to (`may_cut`).
fn near_paths(
    part: &Part,
    ring: usize,
    may_cut: &[bool],
    cuts: &CutIndex<'_>,
    judged: &ClassifiedCuts<'_>,
) -> NearPaths {
    let mut near = NearPaths { paths: vec![false; may_cut.len()], is_cut: false };
    for curve in &part.rings[ring].curves {
        for number in cuts.near(widened_box(curve, 0.0)) {
            let cut = &cuts.cuts[number];
            let is_known = near.is_cut && near.paths[cut.path];
            if !is_known && may_cut[cut.path] && cut.cut.way.curve.distance(curve) < 2.0 * cut.radius {
                near.paths[cut.path] = true;
                near.is_cut = near.is_cut
                    || cuts.may_cut_out(cut) && judged.get(number).is_some_and(|judged| judged.faces(ring));
            }
        }
        if near.is_cut && near.paths == may_cut {
            break;
        }
    }
    near
}

fn gouge_problem(gouge: &Gouge, radius: f64, is_circle: bool) -> Diagnostic {
    let length = gouge.length();
    let problem = if length == 0.0 {
        Diagnostic::new(&messages::GOUGE_BY_HOLE).with("tool", 2.0 * radius)
    } else {
        let message = if gouge.depth >= 2.0 * radius {
            &messages::GOUGE_INSIDE
        } else if is_circle {
            &messages::GOUGE_BY_CIRCLE
        } else {
            &messages::GOUGE
        };
        Diagnostic::new(message).with("length", length)
    };
    let mut problem = problem.with("depth", gouge.depth).with("point", diagnostic_point(gouge.at));
    if (1000.0 * gouge.depth).round() <= MAX_WARNING_DEPTH {
        problem.severity = Severity::Warning;
    }
    problem
}

/// Returns PB215 for the material left beside an element, reported at the longest of these stretches. `None` if there are no stretches.
fn leftover_problem(stretches: &[&Leftover], corner_radius: f64) -> Option<Diagnostic> {
    let longest =
        stretches.iter().reduce(|best, next| if best.is_exceeded_by(next) { next } else { best })?;
    let problem = match longest.beside {
        AdjacentCut::ThroughCut => Diagnostic::new(&messages::LEFTOVER).with("thickness", longest.thickness),
        AdjacentCut::RoundTip(height) => Diagnostic::new(&messages::ROUND_TIP)
            .with("thickness", longest.thickness)
            .with("height", height)
            .with("bottom", -corner_radius),
        AdjacentCut::ShallowCut(height) => Diagnostic::new(&messages::NOT_CUT_THROUGH).with("height", height),
        AdjacentCut::Sweep => Diagnostic::new(&messages::SWEEP_ALONG_OUTLINE),
    };
    let problem =
        problem.with("from", diagnostic_point(longest.from)).with("to", diagnostic_point(longest.to));
    Some(problem.with("length", longest.length).with("count", stretches.len()))
}

#[cfg(test)]
mod tests {
    use pathbuild_diagnostic::{ElementId, EntityKind, Lang, Point};

    use super::*;
    use crate::element::Origin;
    use crate::geometry::{Line, Xy};
    use crate::keep_out::TipMove;
    use crate::names::{LayerPattern, PathName};
    use crate::part::{CutElement, PartCut};

    fn rectangle([left, low]: [f64; 2], [right, high]: [f64; 2], pieces: u32) -> Vec<Line> {
        let corners = [[left, low], [right, low], [right, high], [left, high]].map(Xy::from);
        let side = |number: usize| {
            let (from, to) = (corners[number], corners[(number + 1) % 4]);
            let at = move |piece: u32| from + (to - from) * (f64::from(piece) / f64::from(pieces));
            (0..pieces).map(move |piece| Line { start: at(piece), end: at(piece + 1) })
        };
        (0..4).flat_map(side).collect()
    }

    /// Returns a contour round a plate of 40 x 20 mm, shifted 0.05 mm to the right. Each side is one element and consists of four lines.
    fn contour() -> PathCuts {
        let ways = rectangle([-0.95, -1.0], [41.05, 21.0], 4);
        let element = |number: u32| CutElement {
            origin: Origin {
                id: ElementId(number),
                entity: EntityKind::Line,
                layer: "1.1P".into(),
                point: Point::new(f64::from(number), 0.0),
            },
            lowest: 0.0,
            supported: None,
            bottom: f64::INFINITY,
            circle: None,
        };
        let cut = |(number, line): (u32, Line)| PartCut {
            way: TipMove { curve: Curve::Line(line), from_z: 0.0, to_z: 0.0 },
            element: number / 4,
        };
        PathCuts {
            name: PathName::new("1.1P").into(),
            radius: 1.0,
            thickness: 2.0,
            is_slot: false,
            corner_radius: 0.0,
            elements: (0..4).map(element).collect(),
            cuts: (0..).zip(ways).map(cut).collect(),
            sweeps: Vec::new(),
            bars: Vec::new(),
            ends: (Xy::origin(), Xy::origin()),
            embedded: Vec::new(),
        }
    }

    #[test]
    fn the_order_of_cuts_does_not_matter() {
        let plate = rectangle([0.0, 0.0], [40.0, 20.0], 1).into_iter().map(Curve::Line).collect();
        let rings = vec![PartRing { curves: plate, around: Vec::new() }];
        let parts = [Part { layer: "Part".into(), paths: None, rings }];
        let pattern = LayerPattern::new("Part").expect("a valid pattern");
        let settings = PartSettings { pattern, tolerance: 0.02, is_held_otherwise: false };
        let check = |cuts: &PathCuts| {
            let found = check_parts(&parts, &[cuts], true, &settings);
            let mut texts: Vec<String> = found.of_paths[0].iter().map(|found| found.text(Lang::En)).collect();
            texts.sort();
            texts
        };
        let mut cuts = contour();
        let expected = check(&cuts);
        assert_eq!(
            expected.len(),
            3,
            "a gouge on the left, a leftover on the right, and a loose part: {expected:?}"
        );
        let mut state = 1_u64;
        for _ in 0..500 {
            for last in (1..cuts.cuts.len()).rev() {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                let other = usize::try_from(state >> 33).unwrap_or_default() % (last + 1);
                cuts.cuts.swap(last, other);
            }
            assert_eq!(check(&cuts), expected, "{:?}", cuts.cuts);
        }
    }
}
