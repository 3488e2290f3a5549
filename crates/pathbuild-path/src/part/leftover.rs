//! Stretches of an outline at which material is left. (book: language/part)

use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Vector2;
use rstar::AABB;

use super::cuts::{CutIndex, IndexedCut, IndexedSweep, StandingBar, THROUGH_HEIGHT};
use super::gouge::{ClassifiedCut, ClassifiedCuts};
use super::intervals::{
    JOIN_GAP, NEIGHBOUR_JOIN_GAP, Stretch, add_stretches_within, difference, gaps_between, intersection,
    join_ends, join_stretches, offset_curve,
};
use super::loose::{first_enclosing, is_surrounded};
use super::prepared::PreparedPart;
use crate::boxes::{square, widened_box};
use crate::geometry::{Arc, Curve, Line, Xy};

/// Length in mm from which leftover material is reported.
const MIN_REPORTED_LENGTH: f64 = 0.1;

/// Number of samples along a stretch by which the thickness of the material is determined.
const SAMPLES: u32 = 16;

/// A stretch of an outline at which material is left.
#[derive(Clone, Debug)]
pub(super) struct Leftover {
    /// The nest of the ring.
    pub(super) nest: usize,
    /// The path and the element of the nearest cut, or of the sweep.
    pub(super) path: usize,
    pub(super) element: u32,
    pub(super) from: Xy,
    pub(super) to: Xy,
    /// The length of the stretch in mm, along the outline.
    pub(super) length: f64,
    /// The largest distance in mm, at some samples, between the outline and the edge of the nearest cut; O for a sweep.
    pub(super) thickness: f64,
    pub(super) beside: AdjacentCut,
    pub(super) material: LeftoverMaterial,
}

/// What runs along a stretch at which material is left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum AdjacentCut {
    ThroughCut,
    /// A through cut with a round tip that reaches the outline only above the plate's lower face, with its lowest height in mm.
    RoundTip(f64),
    /// A cut that does not go through the plate, with its lowest height in mm.
    ShallowCut(f64),
    Sweep,
}

/// Material that is left at an outline.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftoverMaterial {
    /// The stretch of the outline.
    pub outline: Vec<Curve>,
    /// Distance in mm from the outline to which the material extends.
    pub reach: f64,
}

impl Leftover {
    /// Whether another stretch is longer. Of stretches with the same length, the leftmost wins, as for cuts into the part.
    pub(super) fn is_exceeded_by(&self, other: &Self) -> bool {
        let is_left = || (other.from.x, other.from.y) < (self.from.x, self.from.y);
        other.length > self.length + NEIGHBOUR_JOIN_GAP
            || (other.length >= self.length - NEIGHBOUR_JOIN_GAP && is_left())
    }
}

/// The stretches of outlines that the cutters beside them cannot reach without entering the part elsewhere.
#[derive(Clone, Debug)]
pub(super) struct UnreachableOutline {
    /// The middle of the longest stretch.
    pub(super) at: Xy,
    /// The length of all stretches in mm.
    pub(super) length: f64,
    /// The path and the element of the cut that is nearest to `at`.
    pub(super) path: usize,
    pub(super) element: u32,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Leftovers {
    pub(super) stretches: Vec<Leftover>,
    pub(super) unreachable: Option<UnreachableOutline>,
    /// The stretches of outlines that `unreachable` describes.
    pub(super) corners: Vec<Curve>,
}

pub(super) struct LeftoverSearch<'s> {
    part: &'s PreparedPart<'s>,
    cuts: &'s CutIndex<'s>,
    /// The cuts near the part that go through the plate or shape an outline, by number.
    judged: &'s ClassifiedCuts<'s>,
    /// For each path, whether it cuts the part out.
    contours: &'s [bool],
    tolerance: f64,
    /// The elements, with their paths, that cut into the part but not through the plate: grooves, which have no influence on the part's outline.
    grooves: BTreeSet<(usize, u32)>,
    /// Whether the cuts and support bars of the paths that cut the part out close a ring round it, so that the edge of the plate is nowhere the edge
    /// of the part. Computed when first needed.
    has_closed_ring: OnceCell<bool>,
}

/// Stretches of a ring that through cuts do not reach, as positions in mm along the ring.
#[derive(Default)]
struct RingStretches {
    /// Stretches at which material is left.
    left: Vec<Stretch>,
    /// Stretches that no cut comes near.
    never: Vec<Stretch>,
    /// Stretches along which only a sweep runs, each with the number of the sweep.
    swept: Vec<(Stretch, usize)>,
    unreachable: Vec<Stretch>,
}

impl RingStretches {
    /// Returns all stretches at which material is left.
    fn stretches_left(&self) -> impl Iterator<Item = Stretch> {
        self.left.iter().copied().chain(self.swept.iter().map(|(stretch, _)| *stretch))
    }
}

/// How well the cuts follow one of several nested rings, from best to worst.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum RingFit {
    /// Cuts come near at least a part of the ring.
    Followed,
    /// No cut comes near.
    Uncut,
    /// Most of the ring is cut away, so it is not the ring that is to be cut.
    Exceeded,
}

/// A curve of a ring with the cuts near it.
struct RingCurve<'r> {
    ring: usize,
    /// Distance in mm along the ring at which the curve begins.
    start: f64,
    curve: &'r Curve,
    near: Vec<usize>,
}

impl RingCurve<'_> {
    /// Converts stretches of the curve to stretches of its ring.
    fn on_ring(&self, stretches: Vec<Stretch>) -> impl Iterator<Item = Stretch> {
        shifted(stretches, self.start)
    }
}

impl<'s> LeftoverSearch<'s> {
    pub(super) fn new(
        part: &'s PreparedPart<'s>,
        cuts: &'s CutIndex<'s>,
        judged: &'s ClassifiedCuts<'s>,
        contours: &'s [bool],
        tolerance: f64,
    ) -> Self {
        let enters = |judged: &&ClassifiedCut<'_>| {
            judged.is_entering && judged.cut.element(cuts).lowest > THROUGH_HEIGHT
        };
        let grooves = judged.iter().filter(enters).map(|judged| judged.cut.number());
        let grooves = grooves.collect();
        Self { part, cuts, judged, contours, tolerance, grooves, has_closed_ring: OnceCell::new() }
    }

    /// Returns the material left at all rings. Of the rings of a nest, only the ring that the cuts follow best is considered.
    pub(super) fn leftovers(&self) -> Leftovers {
        let mut nests: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for ring in 0..self.part.part.rings.len() {
            nests.entry(self.part.part.nest(ring)).or_default().push(ring);
        }
        let mut found = Leftovers::default();
        let mut longest = 0.0;
        for members in nests.values() {
            let Some((ring, stretches)) = self.cut_ring(members) else { continue };
            let described =
                stretches.left.iter().filter_map(|stretch| self.leftover(ring, *stretch, &stretches));
            found.stretches.extend(described);
            found.stretches.extend(stretches.swept.iter().map(|swept| self.swept_leftover(ring, *swept)));
            self.add_unreachable(ring, &stretches, &mut longest, &mut found);
        }
        found
    }

    /// Returns the ring of a nest that the cuts follow best, with its stretches; `None` if no cut beside the part comes near any of them.
    fn cut_ring(&self, nest: &[usize]) -> Option<(usize, RingStretches)> {
        let judged = nest.iter().filter_map(|ring| Some((*ring, self.ring(*ring)?)));
        let [_, _, ..] = nest else { return judged.last() };
        let mut judged: Vec<_> =
            judged.map(|(ring, stretches)| (self.agreement(ring, &stretches), ring, stretches)).collect();
        judged.sort_by(|one, other| {
            let length_left = |stretches: &RingStretches| total_length(stretches.stretches_left());
            one.0.cmp(&other.0).then_with(|| length_left(&one.2).total_cmp(&length_left(&other.2)))
        });
        let is_exceeded = judged.iter().any(|(agreement, ..)| *agreement == RingFit::Exceeded);
        let (agreement, ring, mut stretches) = judged.into_iter().next()?;
        if is_exceeded && agreement == RingFit::Uncut {
            stretches.left = join_ends(std::mem::take(&mut stretches.never), self.part.ring_length(ring));
        }
        Some((ring, stretches))
    }

    fn ring_curves(&self, ring: usize) -> impl Iterator<Item = RingCurve<'s>> {
        self.part.ring_curves(ring).map(move |(start, curve)| {
            let near = self.cuts.near(widened_box(curve, 0.0)).collect();
            RingCurve { ring, start, curve, near }
        })
    }

    /// Returns how far the cuts follow a ring of a nest of several rings.
    fn agreement(&self, ring: usize, stretches: &RingStretches) -> RingFit {
        let length = self.part.ring_length(ring);
        let exceeded = self
            .ring_curves(ring)
            .map(|curve| total_length(self.stretches_within_cuts(&curve, -self.tolerance).into_iter()));
        if 2.0 * exceeded.sum::<f64>() > length {
            RingFit::Exceeded
        } else if total_length(stretches.never.iter().copied()) > length - MIN_REPORTED_LENGTH {
            RingFit::Uncut
        } else {
            RingFit::Followed
        }
    }

    /// Returns the stretches of a ring; `None` if no cut beside the part comes near the ring.
    fn ring(&self, ring: usize) -> Option<RingStretches> {
        let mut all = RingStretches::default();
        let mut is_near = false;
        let mut uncut = Vec::new();
        for curve in self.ring_curves(ring) {
            is_near = is_near || self.cuts_beside(&curve).next().is_some();
            let within = self.stretches_within_cuts(&curve, self.tolerance);
            let gaps = gaps_between(&within, (0.0, curve.curve.length()));
            if !gaps.is_empty() {
                self.add_gaps(&curve, &gaps, &mut all, &mut uncut);
            }
        }
        all.never = join_stretches(all.never, NEIGHBOUR_JOIN_GAP);
        if is_near {
            self.add_notches(ring, &mut all, &mut uncut);
            self.add_swept_stretches(ring, &mut all, &mut uncut);
        }
        let is_long = |(from, to): &Stretch| to - from >= MIN_REPORTED_LENGTH;
        let long = |stretches| {
            let mut joined =
                join_ends(join_stretches(stretches, NEIGHBOUR_JOIN_GAP), self.part.ring_length(ring));
            joined.retain(is_long);
            joined
        };
        (all.left, all.unreachable) = (long(uncut), long(all.unreachable));
        is_near.then_some(all)
    }

    /// Sorts the gaps that through cuts leave on a curve, except those beside support bars: gaps near a cut go to `uncut`, or to `all.unreachable`
    /// where the cutter does not fit; gaps that no cut comes near go to `all.never`.
    fn add_gaps(
        &self,
        curve: &RingCurve<'_>,
        gaps: &[Stretch],
        all: &mut RingStretches,
        uncut: &mut Vec<Stretch>,
    ) {
        let gaps = difference(gaps, &self.stretches_beside_bars(curve));
        if gaps.is_empty() {
            return;
        }
        let close = self.stretches_near_cuts(curve);
        let open = intersection(&close, &gaps);
        all.never.extend(curve.on_ring(difference(&gaps, &close)));
        if open.is_empty() {
            return;
        }
        let corners = self.unreachable_stretches(curve);
        uncut.extend(curve.on_ring(difference(&open, &corners)));
        all.unreachable.extend(curve.on_ring(intersection(&open, &corners)));
    }

    /// Returns the cuts near a curve that run beside the part, along the curve's ring.
    fn cuts_beside(&self, curve: &RingCurve<'_>) -> impl Iterator<Item = &'s ClassifiedCut<'s>> {
        let ring = curve.ring;
        let judged = curve.near.iter().filter_map(|number| self.judged.get(*number));
        judged.filter(move |judged| {
            let element = judged.cut.element(self.cuts);
            judged.side.is_beside(ring)
                && self.contours[judged.cut.path]
                && judged.cut.cut.way.lowest() <= element.lowest + JOIN_GAP
                && !self.grooves.contains(&judged.cut.number())
        })
    }

    /// Returns the stretches of a curve that are within `margin` mm of the edges of through cuts, or of the support bars between them.
    fn stretches_within_cuts(&self, curve: &RingCurve<'_>, margin: f64) -> Vec<Stretch> {
        let mut found = Vec::new();
        let mut last = None;
        for cut in curve.near.iter().map(|number| &self.cuts.cuts[*number]) {
            let Some(through) = cut.through_section().filter(|_| self.contours[cut.path]) else { continue };
            let supported = cut.element(self.cuts).supported;
            if supported.is_some() && last.replace(cut.number()) == Some(cut.number()) {
                continue;
            }
            let way = supported.unwrap_or(through);
            add_stretches_within(curve.curve, &way, self.lower_radius(cut) + margin, &mut found);
        }
        join_stretches(found, JOIN_GAP)
    }

    /// Returns half the width in mm of a cut at the plate's lower face. It is less than that of the cutter if the round corners of the tip end there.
    fn lower_radius(&self, cut: &IndexedCut<'_>) -> f64 {
        let corner = self.cuts.paths[cut.path].corner_radius;
        let above = corner + cut.element(self.cuts).lowest.min(0.0);
        if above <= 0.0 {
            cut.radius
        } else {
            cut.radius - corner + libm::sqrt(corner * corner - above * above)
        }
    }

    /// Returns the stretches of a curve near a cut beside the part: within O of a cut that goes through the plate, or reached by a cut that does not.
    fn stretches_near_cuts(&self, curve: &RingCurve<'_>) -> Vec<Stretch> {
        let mut found = Vec::new();
        for judged in self.cuts_beside(curve) {
            let radius = judged.cut.radius;
            let reach =
                if judged.cut.through_section().is_some() { 2.0 * radius } else { radius + self.tolerance };
            add_stretches_within(curve.curve, &judged.curve, reach, &mut found);
        }
        join_stretches(found, JOIN_GAP)
    }

    /// Adds the material left in notches that the contour passes: long stretches that neither a cut nor a support bar comes near, if cuts and bars
    /// close a ring round the part, or round waste in the opening.
    fn add_notches(&self, ring: usize, all: &mut RingStretches, uncut: &mut Vec<Stretch>) {
        let Some(radius) = self.smallest_radius() else { return };
        let is_notch = |(from, to): &Stretch| to - from >= 2.0 * radius;
        let long: Vec<Stretch> = all.never.iter().copied().filter(is_notch).collect();
        if long.is_empty() || !self.has_closed_ring(ring) {
            return;
        }
        let mut notches = difference(&long, &self.stretches_near_bars(ring));
        notches.retain(is_notch);
        all.never = difference(&all.never, &notches);
        for curve in self.ring_curves(ring) {
            let here = intersection(&notches, &[(curve.start, curve.start + curve.curve.length())]);
            if !here.is_empty() {
                let corners: Vec<Stretch> = curve.on_ring(self.unreachable_stretches(&curve)).collect();
                uncut.extend(difference(&here, &corners));
                all.unreachable.extend(intersection(&here, &corners));
            }
        }
    }

    /// Adds the stretches that no cut comes near, but along which a sweep runs as a cut would, together with what the cuts on both sides leave there.
    /// Nothing is added if other long stretches are not cut either: the edge of the plate may be the edge of the part.
    fn add_swept_stretches(&self, ring: usize, all: &mut RingStretches, uncut: &mut Vec<Stretch>) {
        let Some(radius) = self.smallest_radius() else { return };
        let is_long = |(from, to): &Stretch| to - from > 2.0 * radius;
        let embeds_others = self.cuts.paths.iter().any(|path| !path.embedded.is_empty());
        if embeds_others || all.never.is_empty() {
            return;
        }
        let mut never = all.never.clone();
        let mut left = join_stretches(std::mem::take(uncut), NEIGHBOUR_JOIN_GAP);
        let unswept = left.clone();
        let mut swept = Vec::new();
        for (number, beside) in self.stretches_beside_sweeps(ring) {
            let open = join_stretches([&never[..], &left].concat(), NEIGHBOUR_JOIN_GAP);
            let has_never = |stretch: &Stretch| !intersection(&never, &[*stretch]).is_empty();
            let mut here = intersection(&open, &beside);
            here.retain(|stretch| stretch.1 - stretch.0 >= MIN_REPORTED_LENGTH && has_never(stretch));
            never = difference(&never, &here);
            left = difference(&left, &here);
            swept.extend(here.into_iter().map(|here| (here, number)));
        }
        let is_other_edge = never.iter().any(is_long);
        *uncut = if is_other_edge { unswept } else { left };
        if !is_other_edge {
            all.swept = swept;
        }
    }

    /// Returns the numbers of the sweeps that run along a ring, at a distance of half of O and over more than O, with the stretches of the ring
    /// beside them.
    fn stretches_beside_sweeps(&self, ring: usize) -> BTreeMap<usize, Vec<Stretch>> {
        let mut found: BTreeMap<usize, Vec<Stretch>> = BTreeMap::new();
        for (start, curve) in self.part.ring_curves(ring) {
            for number in self.cuts.sweeps_beside(curve, self.tolerance) {
                let here = shifted(self.stretches_beside_sweep(curve, number), start);
                found.entry(number).or_default().extend(here);
            }
        }
        for (number, stretches) in &mut found {
            *stretches = join_stretches(std::mem::take(stretches), NEIGHBOUR_JOIN_GAP);
            stretches.retain(|(from, to)| to - from > 2.0 * self.cuts.sweeps[*number].radius);
        }
        found
    }

    /// Returns the stretches of a curve beside which a sweep runs where a cut along the curve would.
    fn stretches_beside_sweep(&self, curve: &Curve, number: usize) -> Vec<Stretch> {
        let IndexedSweep { path, sweep, radius } = &self.cuts.sweeps[number];
        let Some(away) = offset_curve(curve, *radius).filter(|_| self.contours[*path]) else {
            return Vec::new();
        };
        let scale = curve.length() / away.length();
        let mut found = Vec::new();
        add_stretches_within(&away, &sweep.curve, self.tolerance, &mut found);
        found.into_iter().map(|(from, to)| (from * scale, to * scale)).collect()
    }

    /// Returns the stretches of a ring within O of support bars.
    fn stretches_near_bars(&self, ring: usize) -> Vec<Stretch> {
        let mut found = Vec::new();
        for (start, curve) in self.part.ring_curves(ring) {
            let mut here = Vec::new();
            for (bar, radius) in self.bars() {
                add_stretches_within(curve, &bar.foot, 2.0 * radius, &mut here);
            }
            found.extend(shifted(here, start));
        }
        join_stretches(found, NEIGHBOUR_JOIN_GAP)
    }

    /// Whether cuts and bars close a ring round the part or, for an opening that lies alone, round waste in it.
    fn has_closed_ring(&self, ring: usize) -> bool {
        let sweeps = self.all_contour_cuts().filter_map(|cut| Some((cut.through_section()?, cut.radius)));
        let ways = sweeps.chain(self.bars().map(|(bar, radius)| (bar.foot, radius)));
        if ring == 0 {
            return *self.has_closed_ring.get_or_init(|| is_surrounded(self.part, &ways.collect::<Vec<_>>()));
        }
        let part = self.part.part;
        let is_alone =
            (0..part.rings.len()).filter(|other| part.nest(*other) == part.nest(ring)).count() == 1;
        let embeds_others = self.cuts.paths.iter().any(|path| !path.embedded.is_empty());
        let is_inside = |(way, _): &(Curve, f64)| self.part.side(way.middle()).is_beside(ring);
        is_alone && !embeds_others && first_enclosing(&ways.filter(is_inside).collect::<Vec<_>>()).is_some()
    }

    /// Returns the stretches of a curve that a cutter cannot reach without entering the part elsewhere. The cutter is the smallest one beside the
    /// curve or, if there is none, the smallest of all.
    fn unreachable_stretches(&self, curve: &RingCurve<'_>) -> Vec<Stretch> {
        let radii = self.cuts_beside(curve).map(|judged| judged.cut.radius);
        let smallest = radii.min_by(f64::total_cmp).or_else(|| self.smallest_radius());
        let Some(radius) = smallest else { return Vec::new() };
        let length = curve.curve.length();
        let Some(away) = offset_curve(curve.curve, radius) else {
            return if self.reaches_whole_arc(curve, radius) { Vec::new() } else { vec![(0.0, length)] };
        };
        let scale = length / away.length();
        let mut found = Vec::new();
        for other in self.curves_of_ring(curve.ring, widened_box(&away, radius)) {
            add_stretches_within(&away, other, radius - self.tolerance, &mut found);
        }
        join_stretches(found.into_iter().map(|(from, to)| (from * scale, to * scale)).collect(), JOIN_GAP)
    }

    /// Whether a curve is an inner arc with the cutter's radius: the cutter then reaches the whole arc from the arc's centre.
    fn reaches_whole_arc(&self, curve: &RingCurve<'_>, radius: f64) -> bool {
        let Curve::Arc(arc) = curve.curve else { return false };
        let reach = radius - self.tolerance;
        let mut near = self.curves_of_ring(curve.ring, square(arc.centre, reach));
        arc.radius >= reach && near.all(|other| other.distance_to(arc.centre) >= reach)
    }

    /// Returns the curves of a ring near a box. Only they limit the cutter beside the ring: other rings either lie behind the part's material, are
    /// alternatives in the same nest, or overlap this one, which makes no inner corner.
    fn curves_of_ring(&self, ring: usize, extent: AABB<[f64; 2]>) -> impl Iterator<Item = &Curve> {
        self.part.curves_near(extent).filter(move |(other, _)| *other == ring).map(|(_, curve)| curve)
    }

    /// Returns the stretches beside support bars, where the path is meant to cut only down to the bar.
    fn stretches_beside_bars(&self, curve: &RingCurve<'_>) -> Vec<Stretch> {
        let mut found = Vec::new();
        for (bar, radius) in self.bars() {
            add_stretches_within(curve.curve, &bar.foot, radius + self.tolerance, &mut found);
        }
        join_stretches(found, JOIN_GAP)
    }

    /// Returns the bars of the paths that cut the part out, each with half of its path's O.
    fn bars(&self) -> impl Iterator<Item = (&StandingBar, f64)> {
        let contours = self.cuts.paths.iter().zip(self.contours).filter(|(_, is_contour)| **is_contour);
        contours.flat_map(|(path, _)| path.bars.iter().map(|bar| (bar, path.radius)))
    }

    /// Returns the radius of the smallest cutter that cuts the part out.
    fn smallest_radius(&self) -> Option<f64> {
        self.all_contour_cuts().map(|cut| cut.radius).min_by(f64::total_cmp)
    }

    fn all_contour_cuts(&self) -> impl Iterator<Item = &IndexedCut<'s>> {
        self.cuts.cuts.iter().filter(|cut| self.contours[cut.path])
    }

    /// Describes the material left along a stretch of a ring. `None` for the rounded corner where a cut ends at the edge of the plate: beyond it, the
    /// edge of the plate is the edge of the part.
    fn leftover(&self, ring: usize, (from, to): Stretch, stretches: &RingStretches) -> Option<Leftover> {
        let whole = self.part.ring_length(ring);
        let place = |along: f64| self.part.ring_point(ring, along);
        let nearest = self.cut_beside(ring, f64::midpoint(from, to))?;
        let is_end = |end: f64| {
            let wrapped = [end - whole, end, end + whole];
            let touches = |at: f64| wrapped.iter().any(|end| (end - at).abs() <= NEIGHBOUR_JOIN_GAP);
            stretches.never.iter().any(|never| touches(never.0) || touches(never.1))
        };
        let length = to - from;
        if length <= 2.0 * nearest.radius && (is_end(from) || is_end(to)) {
            return None;
        }
        // Take no samples at the ends: the end of the cut may be there, where the distance to its edge is largest.
        let sample = |number| place(from + length * (f64::from(number) + 0.5) / f64::from(SAMPLES));
        let thickness = (0..SAMPLES).map(sample).map(|at| self.distance(at)).fold(0.0, f64::max);
        let is_through = nearest.through_section().is_some();
        let foot = nearest.radius - self.lower_radius(nearest);
        Some(Leftover {
            nest: self.part.part.nest(ring),
            path: nearest.path,
            element: nearest.cut.element,
            from: place(from),
            to: place(to),
            length,
            thickness,
            beside: if !is_through {
                AdjacentCut::ShallowCut(nearest.cut.way.lowest())
            } else if foot > 0.0 && thickness - foot <= self.tolerance {
                AdjacentCut::RoundTip(nearest.element(self.cuts).lowest)
            } else {
                AdjacentCut::ThroughCut
            },
            material: LeftoverMaterial {
                outline: self.part.ring_section(ring, (from, to)),
                reach: if is_through { thickness } else { 2.0 * nearest.radius },
            },
        })
    }

    /// Describes a stretch of a ring along which only a sweep runs.
    fn swept_leftover(&self, ring: usize, ((from, to), number): (Stretch, usize)) -> Leftover {
        let IndexedSweep { path, sweep, radius } = &self.cuts.sweeps[number];
        Leftover {
            nest: self.part.part.nest(ring),
            path: *path,
            element: sweep.element,
            from: self.part.ring_point(ring, from),
            to: self.part.ring_point(ring, to),
            length: to - from,
            thickness: 2.0 * radius,
            beside: AdjacentCut::Sweep,
            material: LeftoverMaterial {
                outline: self.part.ring_section(ring, (from, to)),
                reach: 2.0 * radius,
            },
        }
    }

    /// Adds the unreachable stretches of a ring. `longest`: the length in mm of the longest stretch so far, which `found` describes.
    fn add_unreachable(
        &self,
        ring: usize,
        stretches: &RingStretches,
        longest: &mut f64,
        found: &mut Leftovers,
    ) {
        for (from, to) in &stretches.unreachable {
            let middle = f64::midpoint(*from, *to);
            let at = self.part.ring_point(ring, middle);
            let Some(nearest) = self.cut_beside(ring, middle) else { continue };
            let (path, element) = (nearest.path, nearest.cut.element);
            found.corners.extend(self.part.ring_section(ring, (*from, *to)));
            let all = found.unreachable.get_or_insert(UnreachableOutline { at, length: 0.0, path, element });
            all.length += to - from;
            if to - from > *longest {
                *longest = to - from;
                *all = UnreachableOutline { at, path, element, ..*all };
            }
        }
    }

    /// Returns the distance in mm, at the plate's lower face, from a point of an outline to the edge of the nearest cut of any depth, even above a bar.
    fn distance(&self, at: Xy) -> f64 {
        let distance = |cut: &IndexedCut<'_>| cut.cut.way.curve.distance_to(at) - self.lower_radius(cut);
        let near = self.cuts.near(square(at, 0.0)).map(|number| &self.cuts.cuts[number]);
        let near = near.filter(|cut| self.contours[cut.path]).map(|cut| (distance(cut), cut.radius));
        // A cut whose box is near may be farther away than one whose box is not.
        let near = near.filter(|(distance, radius)| distance <= radius).map(|(distance, _)| distance);
        let nearest = near.min_by(f64::total_cmp);
        nearest.unwrap_or_else(|| self.all_contour_cuts().map(distance).fold(f64::INFINITY, f64::min))
    }

    /// Returns the cut that a finding at a place of a ring names: the nearest one within O, else the first one that the way straight out of the part
    /// meets, else the nearest of all.
    fn cut_beside(&self, ring: usize, along: f64) -> Option<&'s IndexedCut<'s>> {
        let at = self.part.ring_point(ring, along);
        let near = self.nearest_of(self.cuts.near(square(at, 0.0)).collect(), ring, at);
        let near = near.filter(|cut| cut.cut.way.curve.distance_to(at) <= 2.0 * cut.radius);
        let near = near.or_else(|| self.first_cut_outwards(ring, along));
        near.or_else(|| self.nearest_of((0..self.cuts.cuts.len()).collect(), ring, at))
    }

    /// Returns the cut beside the part with the edge nearest to a point of a ring. A cut that does not go through the plate is only considered where
    /// it reaches the ring.
    fn nearest_of(&self, near: Vec<usize>, ring: usize, at: Xy) -> Option<&'s IndexedCut<'s>> {
        let point = Curve::Line(Line { start: at, end: at });
        let curve = RingCurve { ring, start: 0.0, curve: &point, near };
        let distance = |judged: &ClassifiedCut<'_>| judged.curve.distance_to(at) - judged.cut.radius;
        let counts = |judged: &&ClassifiedCut<'_>| {
            judged.cut.through_section().is_some() || distance(judged) <= self.tolerance + JOIN_GAP
        };
        let nearest = self.cuts_beside(&curve).filter(counts).min_by(|one, other| {
            distance(one).total_cmp(&distance(other)).then_with(|| one.cut.number().cmp(&other.cut.number()))
        });
        nearest.map(|judged| judged.cut)
    }

    /// Returns the first through cut on the straight line that leaves the part at a right angle to the ring. Cuts farther than O from the part are
    /// not classified; they lie outside it.
    fn first_cut_outwards(&self, ring: usize, along: f64) -> Option<&'s IndexedCut<'s>> {
        let (curve, along) = self.part.ring_place(ring, along);
        let is_beside =
            |number: &usize| self.judged.get(*number).map_or(ring == 0, |judged| judged.side.is_beside(ring));
        let cuts = self.cuts.cuts.iter().enumerate();
        let beside = cuts.filter(|(number, cut)| self.contours[cut.path] && is_beside(number));
        let way =
            |cut: &IndexedCut<'s>| Some(cut.element(self.cuts).supported.unwrap_or(cut.through_section()?));
        let beside: Vec<_> = beside.filter_map(|(_, cut)| Some((cut, way(cut)?))).collect();
        let at = curve.at(along);
        let farthest = |(_, curve): &(&IndexedCut<'_>, Curve)| (curve.start() - at).norm() + curve.length();
        let reach = beside.iter().map(farthest).fold(0.0, f64::max);
        let out = Curve::Line(Line { start: at, end: at + outwards(curve, at)? * reach });
        let meets = |(cut, curve): (&'s IndexedCut<'s>, Curve)| {
            let mut met = Vec::new();
            add_stretches_within(&out, &curve, cut.radius, &mut met);
            Some((met.into_iter().map(|(from, _)| from).min_by(f64::total_cmp)?, cut))
        };
        let first = beside.into_iter().filter_map(meets).min_by(|(one, cut), (other, other_cut)| {
            one.total_cmp(other).then_with(|| cut.number().cmp(&other_cut.number()))
        });
        first.map(|(_, cut)| cut)
    }
}

fn shifted(stretches: Vec<Stretch>, distance: f64) -> impl Iterator<Item = Stretch> {
    stretches.into_iter().map(move |(from, to)| (from + distance, to + distance))
}

fn total_length(stretches: impl Iterator<Item = Stretch>) -> f64 {
    stretches.map(|(from, to)| to - from).sum()
}

/// Returns the direction at a right angle to a curve of a ring, out of the material on its left; `None` for a curve without length.
fn outwards(curve: &Curve, at: Xy) -> Option<Vector2<f64>> {
    let out = match curve {
        Curve::Line(Line { start, end }) => Vector2::new(end.y - start.y, start.x - end.x),
        Curve::Arc(Arc { centre, clockwise: true, .. }) => centre - at,
        Curve::Arc(Arc { centre, .. }) => at - centre,
    };
    out.try_normalize(0.0)
}
