//! Stretches of an outline at which material is left. (book: language/part)

use std::collections::{BTreeMap, BTreeSet};

use rstar::RTree;

use super::cuts::{IndexedCuts, PartCut, StandingBar, THROUGH};
use super::intervals::{GAP, Stretch, at as at_along, common, joined, rest, within};
use super::prepared::{Boxed, PreparedPart, Side, index, near};
use crate::element::{Cut, Role};
use crate::geometry::{Arc, Curve, Line, Xy};
use crate::keep_out::around;

/// Length in mm below which nothing is reported.
const SHORTEST: f64 = 0.1;

/// Gap in mm between stretches of neighbouring curves.
const BETWEEN_CURVES: f64 = 1e-6;

/// A stretch of an outline at which material is left.
#[derive(Clone, Debug)]
pub(super) struct Leftover {
    /// Index of the path among the owners' paths, and the element, of the nearest cut.
    pub(super) path: usize,
    pub(super) element: u32,
    pub(super) from: Xy,
    pub(super) to: Xy,
    /// Its length in mm along the outline.
    pub(super) length: f64,
    /// The largest distance in mm between the outline and the cut.
    pub(super) thickness: f64,
    /// If the cut beside it does not go through the plate, its lowest height in mm.
    pub(super) height: Option<f64>,
}

/// What is left of a part.
#[derive(Clone, Debug, Default)]
pub(super) struct Leftovers {
    pub(super) stretches: Vec<Leftover>,
    /// The longest stretch that no cutter of this diameter reaches: its middle, the total length of all, and the nearest cut.
    pub(super) corner: Option<(Xy, f64, usize, u32)>,
}

/// A cut beside the part.
struct SideCut<'c> {
    cut: &'c PartCut,
    curve: Curve,
    path: usize,
    side: Side,
}

/// Searches the rings of a part for leftovers.
pub(super) struct LeftoverSearch<'s> {
    part: &'s PreparedPart<'s>,
    tolerance: f64,
    /// The parts of cuts that go through the plate.
    through: Vec<SideCut<'s>>,
    through_boxes: RTree<Boxed>,
    /// The lowest cuts of each element that is milled beside the part.
    beside: Vec<SideCut<'s>>,
    beside_boxes: RTree<Boxed>,
    bars: Vec<(&'s StandingBar, f64)>,
    paths: &'s [IndexedCuts<'s>],
    owners: &'s BTreeSet<usize>,
}

/// A ring, curve by curve, as stretches in mm along it.
#[derive(Default)]
struct RingStretches {
    left: Vec<Stretch>,
    never: Vec<Stretch>,
    unreachable: Vec<Stretch>,
    length: f64,
}

impl<'s> LeftoverSearch<'s> {
    pub(super) fn new(
        part: &'s PreparedPart<'s>,
        paths: &'s [IndexedCuts<'s>],
        owners: &'s BTreeSet<usize>,
        tolerance: f64,
    ) -> Self {
        let (mut through, mut beside, mut bars) = (Vec::new(), Vec::new(), Vec::new());
        for owner in owners {
            let path = &paths[*owner];
            let side_cut = |cut: &'s PartCut, curve: Curve| {
                let middle = at_along(&curve, curve.length() / 2.0);
                SideCut { cut, curve, path: *owner, side: part.side(middle) }
            };
            let lowest = path.lowest();
            let mut is_into_part: BTreeMap<u32, bool> = BTreeMap::new();
            let mut candidates = Vec::new();
            for cut in path.in_box(part.extent()) {
                let below = cut.way.below(THROUGH);
                if let Some(curve) = below {
                    through.push(side_cut(cut, curve));
                }
                let element = &path.path.drawn.elements[cut.element as usize];
                let is_lowest = cut.way.lowest() <= lowest[&cut.element] + GAP;
                if is_lowest && element.role != Role::Cut(Cut::Mark) {
                    let curve = below.unwrap_or(cut.way.curve);
                    let into = is_into_part.entry(cut.element).or_default();
                    *into = *into || !part.entered(&curve, cut.radius, tolerance).is_empty();
                    candidates.push((cut, curve));
                }
            }
            // A groove that enters the part, above the plate, says nothing about its outline; a cut through it is reported as such.
            let is_beside = |cut: &PartCut| !is_into_part[&cut.element] || lowest[&cut.element] <= THROUGH;
            let candidates = candidates.into_iter().filter(|(cut, _)| is_beside(cut));
            beside.extend(candidates.map(|(cut, curve)| side_cut(cut, curve)));
            let radius = |bar: &StandingBar| {
                let of_element = path.path.cuts.iter().find(|cut| cut.element == bar.element);
                of_element.map_or(0.0, |cut| cut.radius)
            };
            bars.extend(path.path.bars.iter().map(|bar| (bar, radius(bar))));
        }
        let boxes = |cuts: &[SideCut<'_>], reach: f64| {
            index(cuts.iter().map(|side| around(&side.curve, reach * side.cut.radius + tolerance)))
        };
        let (through_boxes, beside_boxes) = (boxes(&through, 1.0), boxes(&beside, 2.0));
        Self { part, tolerance, through, through_boxes, beside, beside_boxes, bars, paths, owners }
    }

    /// What is left of all rings. Of rings in the same nest, one must be cut.
    pub(super) fn leftovers(&self) -> Leftovers {
        let rings = &self.part.part.rings;
        let mut nests: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (ring, drawn) in rings.iter().enumerate() {
            nests.entry(drawn.nest).or_default().push(ring);
        }
        let mut found = Leftovers::default();
        let mut longest_corner = 0.0;
        for members in nests.values() {
            let judged = members.iter().filter_map(|ring| Some((*ring, self.ring(*ring)?)));
            let left =
                |stretches: &RingStretches| stretches.left.iter().map(|(from, to)| to - from).sum::<f64>();
            let best = judged.min_by(|one, other| left(&one.1).total_cmp(&left(&other.1)));
            let Some((ring, stretches)) = best else { continue };
            let leftovers =
                stretches.left.iter().filter_map(|stretch| self.leftover(ring, *stretch, &stretches));
            found.stretches.extend(leftovers);
            for stretch in &stretches.unreachable {
                let length = stretch.1 - stretch.0;
                let middle = self.ring_point(ring, f64::midpoint(stretch.0, stretch.1), stretches.length);
                let total = found.corner.map_or(0.0, |corner| corner.1) + length;
                if length > longest_corner
                    && let Some(nearest) = self.nearest(ring, middle)
                {
                    longest_corner = length;
                    found.corner = Some((middle, total, nearest.path, nearest.cut.element));
                } else if let Some(corner) = &mut found.corner {
                    corner.1 = total;
                }
            }
        }
        found
    }

    /// The stretches of a ring; `None` if no cut beside the part comes near.
    fn ring(&self, ring: usize) -> Option<RingStretches> {
        let curves = &self.part.part.rings[ring].curves;
        let radius =
            curves.iter().flat_map(|curve| self.beside_near(ring, curve)).map(|side| side.cut.radius);
        let radius = radius.min_by(f64::total_cmp)?;
        let mut all = RingStretches::default();
        let (mut known, mut uncut) = (Vec::new(), Vec::new());
        for curve in curves {
            let length = curve.length();
            let shifted = |stretches: Vec<Stretch>| {
                stretches
                    .into_iter()
                    .map(|(from, to)| (from + all.length, to + all.length))
                    .collect::<Vec<_>>()
            };
            let covered = self.covered(curve);
            let close = self.close(ring, curve);
            let open = common(&close, &rest(&covered, 0.0, length));
            if !open.is_empty() {
                let corners = self.unreachable(curve, radius);
                let excused = joined([corners.clone(), self.feet(curve)].concat(), GAP);
                let left: Vec<Stretch> = open
                    .iter()
                    .flat_map(|(from, to)| rest(&clipped(&excused, *from, *to), *from, *to))
                    .collect();
                uncut.extend(shifted(left));
                all.unreachable.extend(shifted(common(&open, &corners)));
            }
            known.extend(shifted(joined([covered, close].concat(), GAP)));
            all.length += length;
        }
        all.never = rest(&joined(known, BETWEEN_CURVES), 0.0, all.length);
        let is_long = |(from, to): &Stretch| to - from >= SHORTEST;
        all.left = closed(joined(uncut, BETWEEN_CURVES), all.length).into_iter().filter(is_long).collect();
        all.unreachable = closed(joined(all.unreachable, BETWEEN_CURVES), all.length);
        all.unreachable.retain(is_long);
        Some(all)
    }

    fn beside_near(&self, ring: usize, curve: &Curve) -> impl Iterator<Item = &SideCut<'s>> {
        let near = near(&self.beside_boxes, around(curve, 0.0)).into_iter();
        near.map(|number| &self.beside[number]).filter(move |side| match &side.side {
            Side::Outside => ring == 0,
            Side::Openings(openings) => openings.contains(&ring),
            Side::Material => false,
        })
    }

    /// What is cut through the plate within the tolerance.
    fn covered(&self, curve: &Curve) -> Vec<Stretch> {
        let mut found = Vec::new();
        for number in near(&self.through_boxes, around(curve, 0.0)) {
            let side = &self.through[number];
            within(curve, &side.curve, side.cut.radius + self.tolerance, &mut found);
        }
        joined(found, GAP)
    }

    /// What a cut beside the part comes near: one that goes through the plate within O, another where it should.
    fn close(&self, ring: usize, curve: &Curve) -> Vec<Stretch> {
        let mut found = Vec::new();
        for side in self.beside_near(ring, curve) {
            let is_through = side.cut.way.below(THROUGH).is_some();
            let reach = if is_through { 2.0 * side.cut.radius } else { side.cut.radius + self.tolerance };
            within(curve, &side.curve, reach, &mut found);
        }
        joined(found, GAP)
    }

    /// The stretches that a cutter of this radius cannot reach without entering the part elsewhere.
    fn unreachable(&self, curve: &Curve, radius: f64) -> Vec<Stretch> {
        let length = curve.length();
        let Some(away) = beside(curve, radius) else { return vec![(0.0, length)] };
        let scale = length / away.length();
        let mut found = Vec::new();
        for (_, other) in self.part.curves_near(around(&away, radius)) {
            within(&away, other, radius - self.tolerance, &mut found);
        }
        joined(found.into_iter().map(|(from, to)| (from * scale, to * scale)).collect(), GAP)
    }

    /// The stretches at the feet of bars, where the cut goes down to the bar.
    fn feet(&self, curve: &Curve) -> Vec<Stretch> {
        let mut all = Vec::new();
        for (bar, radius) in &self.bars {
            let reach = radius + self.tolerance;
            let mut foot = Vec::new();
            within(curve, &bar.foot, reach, &mut foot);
            if foot.is_empty() {
                continue;
            }
            let mut low = Vec::new();
            for owner in self.owners {
                for cut in self.paths[*owner].near(curve) {
                    if let Some(below) = cut.way.below(bar.top + self.tolerance) {
                        within(curve, &below, cut.radius + self.tolerance, &mut low);
                    }
                }
            }
            all.extend(common(&joined(foot, GAP), &joined(low, GAP)));
        }
        joined(all, GAP)
    }

    /// Describes a stretch. `None` for the shoulder at the end of a cut, beyond which the edge of the plate is the edge of the part.
    fn leftover(&self, ring: usize, (from, to): Stretch, stretches: &RingStretches) -> Option<Leftover> {
        let whole = stretches.length;
        let place = |along: f64| self.ring_point(ring, along, whole);
        let nearest = self.nearest(ring, place(f64::midpoint(from, to)))?;
        let is_end = |end: f64| {
            let wrapped = [end - whole, end, end + whole];
            let touches = |at: f64| wrapped.iter().any(|end| (end - at).abs() <= BETWEEN_CURVES);
            stretches.never.iter().any(|never| touches(never.0) || touches(never.1))
        };
        let length = to - from;
        if length <= 2.0 * nearest.cut.radius && (is_end(from) || is_end(to)) {
            return None;
        }
        // Not at the ends, which may lie beside the end of the cut, where its edge is as far away as it can be.
        let sample = |number| place(from + length * (f64::from(number) + 0.5) / f64::from(SAMPLES));
        let samples = (0..SAMPLES).map(sample);
        let thickness = samples.map(|at| self.distance(at)).fold(0.0, f64::max);
        let is_through = nearest.cut.way.below(THROUGH).is_some();
        Some(Leftover {
            path: nearest.path,
            element: nearest.cut.element,
            from: place(from),
            to: place(to),
            length,
            thickness,
            height: (!is_through).then(|| nearest.cut.way.lowest()),
        })
    }

    /// The distance in mm from a point of an outline to the edge of the nearest cut, however deep: above a bar too.
    fn distance(&self, at: Xy) -> f64 {
        let point = Curve::Line(Line { start: at, end: at });
        let cuts = self.owners.iter().flat_map(|owner| self.paths[*owner].near(&point));
        let distances = cuts.map(|cut| cut.way.curve.distance_to(at) - cut.radius);
        distances.fold(f64::INFINITY, f64::min)
    }

    /// The cut beside the part whose edge is nearest to a point of a ring.
    fn nearest(&self, ring: usize, at: Xy) -> Option<&SideCut<'s>> {
        let point = Curve::Line(Line { start: at, end: at });
        let distance = |side: &SideCut<'_>| side.curve.distance_to(at) - side.cut.radius;
        self.beside_near(ring, &point).min_by(|one, other| distance(one).total_cmp(&distance(other)))
    }

    /// The point of a ring at a distance along it, which may be below 0 for a stretch across its start.
    fn ring_point(&self, ring: usize, along: f64, whole: f64) -> Xy {
        let curves = &self.part.part.rings[ring].curves;
        let mut along = if along < 0.0 { along + whole } else { along };
        for curve in curves {
            let length = curve.length();
            if along <= length {
                return at_along(curve, along);
            }
            along -= length;
        }
        curves[0].start()
    }
}

impl IndexedCuts<'_> {
    /// The lowest height that each element is milled to.
    fn lowest(&self) -> BTreeMap<u32, f64> {
        let mut lowest = BTreeMap::new();
        for cut in &self.path.cuts {
            let height: &mut f64 = lowest.entry(cut.element).or_insert(f64::INFINITY);
            *height = height.min(cut.way.lowest());
        }
        lowest
    }
}

/// Number of samples of a stretch, for its thickness.
const SAMPLES: u32 = 16;

/// A curve shifted to the right, out of the material, by `distance` mm. `None` for an inner arc with a smaller radius.
pub(super) fn beside(curve: &Curve, distance: f64) -> Option<Curve> {
    match curve {
        Curve::Line(Line { start, end }) => {
            let way = (end - start).try_normalize(0.0)?;
            let aside = nalgebra::Vector2::new(way.y, -way.x) * distance;
            Some(Curve::Line(Line { start: start + aside, end: end + aside }))
        }
        Curve::Arc(arc) => {
            let radius = if arc.clockwise { arc.radius - distance } else { arc.radius + distance };
            let scaled = |at: Xy| arc.centre + (at - arc.centre) * (radius / arc.radius);
            (radius > GAP)
                .then(|| Curve::Arc(Arc { radius, start: scaled(arc.start), end: scaled(arc.end), ..*arc }))
        }
    }
}

/// Joined stretches within a range.
fn clipped(stretches: &[Stretch], from: f64, to: f64) -> Vec<Stretch> {
    let clip = stretches.iter().map(|stretch| (stretch.0.max(from), stretch.1.min(to)));
    clip.filter(|(from, to)| to > from).collect()
}

/// Joins the last stretch of a ring with the first if they meet where it begins.
fn closed(mut stretches: Vec<Stretch>, whole: f64) -> Vec<Stretch> {
    let meets = |stretches: &[Stretch]| {
        stretches.len() > 1
            && stretches[0].0 < BETWEEN_CURVES
            && stretches[stretches.len() - 1].1 > whole - BETWEEN_CURVES
    };
    if meets(&stretches)
        && let Some(last) = stretches.pop()
    {
        stretches[0].0 = last.0 - whole;
    }
    stretches
}
