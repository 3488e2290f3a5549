//! Outlines of finished parts that are open, or that cross themselves or other outlines. (book: language/part)

use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};

use pathbuild_diagnostic::messages::part as messages;
use pathbuild_diagnostic::{Diagnostic, Message, Point};
use rstar::RTree;
use rstar::primitives::GeomWithData;

use crate::boxes::{BoxIndex, square};
use crate::element::diagnostic_point;
use crate::geometry::{Curve, Line, Xy};
use crate::keep_out::Outline;
use crate::read::outline_graph::{Graph, NEAR_MISS_DISTANCE};
use crate::read::rings::{
    Crossing, JOIN_DISTANCE, MAX_COMPARED_PAIRS, NumberedCurves, crossed_rings, crossings, curves_of,
    nesting, self_crossing,
};

/// Largest gap that is reported as a mistake, relative to the length of the outline. Arcs that represent threads, leaders and letters have
/// larger gaps.
const MAX_RELATIVE_GAP: f64 = 0.1;

/// Minimum share of the length of crossing chains that must lie between their crossings, so that the chains are taken for an outline with overlong
/// ends.
const MIN_CHAIN_SHARE: f64 = 0.9;

/// An outline that cannot be compared with cuts.
pub(super) struct BrokenOutline {
    /// The number of a curve at the place of the problem.
    pub(super) curve: usize,
    pub(super) at: Xy,
    /// The finding; `None` for ends that almost meet, which are reported in pairs, and for the closed half of an outline, which is reported at its
    /// open half.
    pub(super) problem: Option<Diagnostic>,
    /// The ends of a chain that crosses itself.
    overlong: Option<(Point, Point)>,
    border: Outline,
}

/// The outlines of a layer, sorted into those that can be compared with cuts and those that cannot.
pub(super) struct SortedOutlines {
    pub(super) rings: Vec<NumberedCurves>,
    /// For each ring, the rings around it, from the outermost.
    pub(super) around: Vec<Vec<usize>>,
    pub(super) broken: Vec<BrokenOutline>,
    /// Open chains that are not attached to a ring: outlines with a large gap, or lines that belong to no outline.
    pub(super) open: Vec<NumberedCurves>,
    /// The boxes of the broken outlines.
    boxes: BoxIndex,
    /// The ends of chains that cross themselves.
    overlong: BTreeSet<(Point, Point)>,
}

impl SortedOutlines {
    pub(super) fn new(graph: &Graph) -> Self {
        let mut rings = graph.outer_rings();
        rings.sort_by_key(|ring| ring[0].0);
        let curves: Vec<Vec<Curve>> = rings.iter().map(curves_of).collect();
        let mut around = nesting(&curves);
        let is_outermost: Vec<bool> = around.iter().map(Vec::is_empty).collect();
        let mut broken = Vec::new();
        let mut is_left_out = vec![false; rings.len()];
        for (number, ring) in rings.iter().enumerate() {
            let Some(crossing) = self_crossing(&curves[number]) else { continue };
            is_left_out[number] = is_outermost[number];
            broken.push(BrokenOutline::crossing_ring(&messages::OUTLINE_CROSSES_ITSELF, ring, &crossing));
        }
        for (number, crossing) in crossed_rings(&rings, &is_outermost) {
            if !std::mem::replace(&mut is_left_out[number], true) {
                broken.push(BrokenOutline::crossing_ring(
                    &messages::OUTLINE_CROSSES_RIM,
                    &rings[number],
                    &crossing,
                ));
            }
        }
        let outermost = curves.into_iter().zip(&is_outermost).filter(|(_, is_outermost)| **is_outermost);
        let rims = OutermostRings::new(outermost.map(|(ring, _)| ring).collect());
        let open_chains = graph.open_chains();
        let hanging = if open_chains.is_empty() { Vec::new() } else { graph.hanging_chains() };
        let mut curves_of_halves = BTreeSet::new();
        for half in open_halves(&rings, &hanging).into_iter().filter(|half| is_outermost[half.ring]) {
            curves_of_halves.extend(half.curves);
            if !std::mem::replace(&mut is_left_out[half.ring], true) {
                // The gap is reported with the open half.
                let closed = &rings[half.ring];
                broken.push(BrokenOutline::new(closed[0].0, closed[0].1.start(), None, &curves_of(closed)));
            }
            broken.push(half.outline);
        }
        let mut others = Vec::new();
        for chain in open_chains.into_iter().filter(|chain| !curves_of_halves.contains(&chain[0].0)) {
            match BrokenOutline::of_chain(&chain, &rims) {
                Some(outline) => broken.push(outline),
                None => others.push(chain),
            }
        }
        let overshooting = overshooting_outlines(&others);
        let mut open = if overshooting.is_empty() { others } else { Vec::new() };
        let hanging: BTreeSet<usize> = hanging.iter().flatten().map(|(number, _)| *number).collect();
        open.retain(|chain| !chain.iter().any(|(number, _)| hanging.contains(number)));
        broken.extend(overshooting);
        if is_left_out.contains(&true) {
            let mut is_kept = is_left_out.into_iter().map(|is_left_out| !is_left_out);
            rings.retain(|_| is_kept.next().unwrap_or(true));
            around = nesting(&rings.iter().map(curves_of).collect::<Vec<_>>());
        }
        let boxes = BoxIndex::new(broken.iter().map(|broken| broken.border.extent()));
        let overlong = broken.iter().filter_map(|broken| broken.overlong).collect();
        Self { rings, around, broken, open, boxes, overlong }
    }

    /// Whether a broken outline encloses a ring, which is then not the outer edge of a part.
    pub(super) fn is_enclosed(&self, ring: &NumberedCurves) -> bool {
        let mut near = self.boxes.near(square(ring[0].1.start(), 0.0));
        near.any(|number| self.broken[number].border.encloses(&curves_of(ring)))
    }

    /// Whether these are the ends of a chain that crosses itself: they are too long, and there is no gap.
    pub(super) fn are_overlong(&self, one: Xy, other: Xy) -> bool {
        self.overlong.contains(&points_in_order(one, other))
    }
}

impl BrokenOutline {
    fn new(curve: usize, at: Xy, problem: Option<Diagnostic>, border: &[Curve]) -> Self {
        Self { curve, at, problem, overlong: None, border: Outline::new(border) }
    }

    /// Describes a ring that crosses itself or another one.
    fn crossing_ring(message: &'static Message, ring: &NumberedCurves, crossing: &Crossing) -> Self {
        let problem = Diagnostic::new(message).with("point", diagnostic_point(crossing.at));
        Self::new(ring[crossing.first.0].0, crossing.at, Some(problem), &curves_of(ring))
    }

    /// Returns the outline that an open chain was probably meant to be: its ends cross or almost meet, or it is drawn round a ring.
    fn of_chain(chain: &NumberedCurves, rims: &OutermostRings) -> Option<Self> {
        Self::crossing(chain, rims).or_else(|| Self::with_gap(chain, rims))
    }

    fn crossing(chain: &NumberedCurves, rims: &OutermostRings) -> Option<Self> {
        let own = curves_of(chain);
        let crossing = self_crossing(&own)?;
        let between = crossing.between(&own);
        let border = Outline::new(&between);
        let is_most = length(&between) >= MIN_CHAIN_SHARE * length(&own);
        (is_most || rims.has_any_inside(&border)).then(|| Self {
            overlong: own
                .first()
                .zip(own.last())
                .map(|(first, last)| points_in_order(first.start(), last.end())),
            border,
            ..Self::crossing_ring(&messages::OUTLINE_CROSSES_ITSELF, chain, &crossing)
        })
    }

    fn with_gap(chain: &NumberedCurves, rims: &OutermostRings) -> Option<Self> {
        let own = curves_of(chain);
        let (curve, at, other) = ends_of_chain(chain)?;
        let gap = (at - other).norm();
        let closing = Line { start: own.last()?.end(), end: own.first()?.start() };
        let problem = (gap > NEAR_MISS_DISTANCE).then(|| gap_problem(at, other));
        let closed = Self::new(curve, at, problem, &[&own[..], &[Curve::Line(closing)]].concat());
        let is_small = gap <= NEAR_MISS_DISTANCE || gap <= MAX_RELATIVE_GAP * length(&own);
        (is_small || rims.has_any_inside(&closed.border)).then_some(closed)
    }
}

/// Returns the outlines that open chains form between the points where they cross each other, if hardly any part of the chains lies beyond those
/// points: for example, lines that overshoot all corners, as in `#`.
fn overshooting_outlines(chains: &[NumberedCurves]) -> Vec<BrokenOutline> {
    let curves: Vec<(usize, usize, Curve)> = (0..)
        .zip(chains)
        .flat_map(|(chain, curves)| curves.iter().map(move |(number, curve)| (chain, *number, *curve)))
        .collect();
    let cuts = crossings(&curves.iter().map(|(.., curve)| *curve).collect::<Vec<_>>());
    if cuts.iter().all(Vec::is_empty) {
        return Vec::new();
    }
    let mut pieces = Vec::new();
    for (index, ((.., curve), cuts)) in curves.iter().zip(&cuts).enumerate() {
        let ends = [&[0.0], &cuts[..], &[curve.length()]].concat();
        pieces.extend(ends.windows(2).map(|ends| (index, curve.section(ends[0], ends[1]))));
    }
    let graph = Graph::new(pieces.iter().map(|(_, curve)| *curve).collect());
    let outline = |ring: NumberedCurves| {
        let own: BTreeSet<usize> = ring.iter().map(|(piece, _)| curves[pieces[*piece].0].0).collect();
        let whole: f64 = own.iter().map(|chain| length(&curves_of(&chains[*chain]))).sum();
        let inside = curves_of(&ring);
        let at = inside[0].start();
        let problem = Diagnostic::new(&messages::OUTLINE_CROSSES_ITSELF).with("point", diagnostic_point(at));
        let is_most = length(&inside) >= MIN_CHAIN_SHARE * whole;
        let curve = curves[pieces[ring[0].0].0].1;
        is_most.then(|| BrokenOutline::new(curve, at, Some(problem), &inside))
    };
    graph.outer_rings().into_iter().filter_map(outline).collect()
}

/// The open half of an outline with a gap; a line across the outline closes the other half.
struct OpenHalf {
    /// Index of the ring that the closed half forms.
    ring: usize,
    outline: BrokenOutline,
    /// The numbers of the curves on both sides of the gap.
    curves: Vec<usize>,
}

type NumberedPoint = GeomWithData<[f64; 2], usize>;

/// Returns the open halves of outlines. Such a half is attached to the ring on both sides of the gap and lies outside the ring; chains inside the
/// ring are taken for lines across the part.
fn open_halves(rings: &[NumberedCurves], hanging: &[NumberedCurves]) -> Vec<OpenHalf> {
    if hanging.is_empty() {
        return Vec::new();
    }
    let nodes = (0..)
        .zip(rings)
        .flat_map(|(ring, chain)| chain.iter().map(move |(_, curve)| numbered(curve.start(), ring)));
    let nodes = RTree::bulk_load(nodes.collect());
    let sides = sides_outside(rings, hanging, &nodes);
    let ends = (0..).zip(&sides).map(|(number, side)| numbered(side.end, number));
    let ends = RTree::bulk_load(ends.collect());
    let half = |(number, side): (usize, &OpenSide<'_>)| {
        side.closed_at_ring(&nodes).or_else(|| side.closed_by_other(number, &sides, &ends))
    };
    let mut known = BTreeSet::new();
    let halves = sides.iter().enumerate().filter_map(half);
    halves.filter(|half| half.curves.iter().all(|curve| known.insert(*curve))).collect()
}

fn numbered(at: Xy, number: usize) -> NumberedPoint {
    GeomWithData::new([at.x, at.y], number)
}

/// Returns the chains that begin at a ring and lie outside it. `nodes` are the ends of the rings' curves, each with the number of its ring.
fn sides_outside<'c>(
    rings: &[NumberedCurves],
    hanging: &'c [NumberedCurves],
    nodes: &RTree<NumberedPoint>,
) -> Vec<OpenSide<'c>> {
    let mut borders: BTreeMap<usize, Outline> = BTreeMap::new();
    let ring_at = |at: Xy| {
        nodes.locate_within_distance([at.x, at.y], JOIN_DISTANCE * JOIN_DISTANCE).map(|node| node.data).min()
    };
    let mut sides: Vec<OpenSide<'c>> =
        hanging.iter().filter_map(|chain| OpenSide::new(chain, ring_at)).collect();
    sides.retain(|side| {
        let border = borders.entry(side.ring).or_insert_with(|| Outline::new(&curves_of(&rings[side.ring])));
        !border.contains(side.middle())
    });
    sides
}

/// Maximum number of nearby ends with which an end is compared.
const MAX_NEIGHBOURS: usize = 32;

/// A chain that leaves a ring.
struct OpenSide<'c> {
    chain: &'c NumberedCurves,
    ring: usize,
    begin: Xy,
    end: Xy,
    length: f64,
}

impl<'c> OpenSide<'c> {
    /// Creates the side that a chain forms; `None` if `ring_at` finds no ring where the chain begins.
    fn new(chain: &'c NumberedCurves, ring_at: impl Fn(Xy) -> Option<usize>) -> Option<Self> {
        let (begin, end) = (chain.first()?.1.start(), chain.last()?.1.end());
        Some(Self { chain, ring: ring_at(begin)?, begin, end, length: length(&curves_of(chain)) })
    }

    fn middle(&self) -> Xy {
        let (_, curve) = &self.chain[self.chain.len() / 2];
        curve.middle()
    }

    /// Whether a point of the ring is not the point where this chain begins.
    fn is_elsewhere(&self, at: Xy) -> bool {
        (at - self.begin).norm() > JOIN_DISTANCE
    }

    /// Returns the half that this chain forms if its end is near a point of the ring.
    fn closed_at_ring(&self, nodes: &RTree<NumberedPoint>) -> Option<OpenHalf> {
        let near = nodes.nearest_neighbor_iter([self.end.x, self.end.y]).take(MAX_NEIGHBOURS);
        let mut points = near.filter(|node| node.data == self.ring).map(|node| Xy::from(*node.geom()));
        self.closed(points.find(|at| self.is_elsewhere(*at))?, None)
    }

    /// Returns the half that this chain, with number `own`, forms with a later chain that ends nearby.
    fn closed_by_other(
        &self,
        own: usize,
        sides: &[OpenSide<'_>],
        ends: &RTree<NumberedPoint>,
    ) -> Option<OpenHalf> {
        let near = ends.nearest_neighbor_iter([self.end.x, self.end.y]).take(MAX_NEIGHBOURS);
        let mut others = near.map(|end| (end.data, &sides[end.data]));
        let is_other = |(number, other): &(usize, &OpenSide<'_>)| {
            *number != own && other.ring == self.ring && self.is_elsewhere(other.begin)
        };
        let (number, other) = others.find(is_other)?;
        if number > own { self.closed(other.end, Some(other)) } else { None }
    }

    /// Returns the outline that this chain forms with the ring, if a small gap separates its end from a point of the ring, or from the end of another
    /// chain.
    fn closed(&self, to: Xy, other: Option<&OpenSide<'_>>) -> Option<OpenHalf> {
        let gap = (to - self.end).norm();
        let whole = self.length + other.map_or(0.0, |other| other.length);
        if gap > MAX_RELATIVE_GAP * whole {
            return None;
        }
        let line = |start, end| Curve::Line(Line { start, end });
        let mut border = curves_of(self.chain);
        border.push(line(self.end, to));
        let back = other.map(|other| curves_of(other.chain)).unwrap_or_default();
        border.extend(back.into_iter().rev().map(Curve::reversed));
        border.push(line(other.map_or(to, |other| other.begin), self.begin));
        border.retain(|curve| curve.length() > 0.0);
        // Two ends that almost meet are reported in pairs.
        let is_reported = gap <= JOIN_DISTANCE || other.is_some() && gap <= NEAR_MISS_DISTANCE;
        let problem = (!is_reported).then(|| gap_problem(self.end, to));
        let outline = BrokenOutline::new(self.chain.last()?.0, self.end, problem, &border);
        let both = self.chain.iter().chain(other.into_iter().flat_map(|other| other.chain));
        Some(OpenHalf { ring: self.ring, outline, curves: both.map(|(number, _)| *number).collect() })
    }
}

/// Returns the number of the first drawn curve at one of a chain's ends, that end, and the other end.
pub(super) fn ends_of_chain(chain: &NumberedCurves) -> Option<(usize, Xy, Xy)> {
    let (first, last) = (chain.first()?, chain.last()?);
    let (start, end) = (first.1.start(), last.1.end());
    Some(if first.0 < last.0 { (first.0, start, end) } else { (last.0, end, start) })
}

/// Returns PB219 for two ends that should meet.
pub(super) fn gap_problem(end: Xy, other: Xy) -> Diagnostic {
    Diagnostic::new(&messages::OUTLINE_GAP)
        .with("point", diagnostic_point(end))
        .with("other", diagnostic_point(other))
        .with("distance", (other - end).norm())
}

/// Rings that lie in no other ring.
struct OutermostRings {
    rings: Vec<Vec<Curve>>,
    /// Spatial index of one point of each ring.
    points: BoxIndex,
    /// Number of comparisons that are left.
    budget: Cell<usize>,
}

impl OutermostRings {
    fn new(rings: Vec<Vec<Curve>>) -> Self {
        let points = BoxIndex::new(rings.iter().map(|ring| square(ring[0].start(), 0.0)));
        Self { rings, points, budget: Cell::new(MAX_COMPARED_PAIRS) }
    }

    fn has_any_inside(&self, border: &Outline) -> bool {
        let near: Vec<usize> = self.points.near(border.extent()).collect();
        self.budget.set(self.budget.get().saturating_sub(near.len()));
        self.budget.get() > 0 && near.into_iter().any(|ring| border.encloses(&self.rings[ring]))
    }
}

/// Returns two points in a fixed order, whichever of them is given first.
fn points_in_order(one: Xy, other: Xy) -> (Point, Point) {
    let (one, other) = (diagnostic_point(one), diagnostic_point(other));
    (one.min(other), one.max(other))
}

fn length(curves: &[Curve]) -> f64 {
    curves.iter().map(Curve::length).sum()
}
