//! Rings of curves: their areas, which of them lie inside others, and where they cross. (book: language/part)

use std::collections::{BTreeMap, BTreeSet};

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use crate::boxes::{BoxIndex, widened_box};
use crate::geometry::{Curve, Xy};
use crate::keep_out::Outline;
use crate::part::{Stretch, add_stretches_within, join_stretches};

/// Largest distance in mm between ends that are treated as joined.
pub(super) const JOIN_DISTANCE: f64 = 0.01;

/// Maximum number of pairs that are compared to find a crossing, or a ring in an open outline: enough for outlines of a hundred thousand short lines.
/// Only outlines with long lines close beside each other need more comparisons; such outlines are not reported.
pub(super) const MAX_COMPARED_PAIRS: usize = 1_000_000;

/// Consecutive curves, each with its number.
pub(super) type NumberedCurves = Vec<(usize, Curve)>;

pub(super) fn curves_of(chain: &NumberedCurves) -> Vec<Curve> {
    chain.iter().map(|(_, curve)| *curve).collect()
}

/// Returns the area of a ring in mm².
fn area(ring: &[Curve]) -> f64 {
    let origin = ring[0].start();
    ring.iter().map(|curve| curve.area_from(origin)).sum::<f64>().abs()
}

/// Returns for each ring the rings around it, from the outermost.
pub(super) fn nesting(rings: &[Vec<Curve>]) -> Vec<Vec<usize>> {
    if rings.len() == 1 {
        return vec![Vec::new()];
    }
    let outlines: Vec<Outline> = rings.iter().map(|ring| Outline::new(ring)).collect();
    let boxes = outlines.iter().enumerate();
    let boxes = boxes.map(|(n, outline)| GeomWithData::new(Rectangle::from_aabb(outline.extent()), n));
    let boxes: RTree<GeomWithData<Rectangle<[f64; 2]>, usize>> = RTree::bulk_load(boxes.collect());
    // Rings that cross may contain points of each other: only the larger one encloses the other.
    let areas: Vec<f64> = rings.iter().map(|ring| area(ring)).collect();
    let around: Vec<Vec<usize>> = (0..rings.len())
        .map(|ring| {
            let curve = &rings[ring][0];
            let point = curve.middle();
            let near = boxes.locate_in_envelope_intersecting(AABB::from_point([point.x, point.y]));
            let others = near.map(|near| near.data).filter(|other| is_larger(*other, ring, &areas));
            let mut around: Vec<usize> = others.filter(|other| outlines[*other].contains(point)).collect();
            around.sort_unstable();
            around
        })
        .collect();
    let sorted = |inner: &Vec<usize>| {
        let mut inner = inner.clone();
        inner.sort_by_key(|ring| around[*ring].len());
        inner
    };
    around.iter().map(sorted).collect()
}

/// Whether a ring is larger than another one. Of two copies, the first in the file counts as larger.
fn is_larger(ring: usize, other: usize, areas: &[f64]) -> bool {
    let [own, others] = [ring, other].map(|ring| (areas[ring] / AREA_STEP).round());
    own > others || own == others && ring < other
}

/// Step in mm² to which areas are rounded, so that copies have the same area.
const AREA_STEP: f64 = 0.001;

/// A place where two curves of a sequence cross, with the index of each curve and the distance in mm along it.
pub(super) struct Crossing {
    pub(super) at: Xy,
    pub(super) first: (usize, f64),
    pub(super) second: (usize, f64),
}

impl Crossing {
    /// Returns the loop that the sequence forms between its two passes through the crossing.
    pub(super) fn between(&self, curves: &[Curve]) -> Vec<Curve> {
        let ((first, from), (second, to)) = (self.first, self.second);
        let begin = curves[first].section(from, curves[first].length());
        let end = curves[second].section(0.0, to);
        [&[begin], &curves[first + 1..second], &[end]].concat()
    }
}

/// Returns a crossing of the first curve in a sequence that crosses a later one, with the last curve that it crosses.
pub(super) fn self_crossing(curves: &[Curve]) -> Option<Crossing> {
    let boxes = BoxIndex::new(curves.iter().map(|curve| widened_box(curve, 0.0)));
    let mut compared = 0;
    (0..curves.len()).find_map(|first| {
        let near = boxes.near(widened_box(&curves[first], JOIN_DISTANCE));
        let later: Vec<usize> = near.filter(|second| *second > first).collect();
        later.into_iter().rev().find_map(|second| {
            compared += 1;
            if compared > MAX_COMPARED_PAIRS {
                return None;
            }
            let (from, to) =
                (crossing(&curves[first], &curves[second])?, crossing(&curves[second], &curves[first])?);
            let at = curves[first].at(from);
            Some(Crossing { at, first: (first, from), second: (second, to) })
        })
    })
}

/// Returns the places in mm along each curve where others cross it, in ascending order. There are no places if too many curves would have to be
/// compared.
pub(super) fn crossings(curves: &[Curve]) -> Vec<Vec<f64>> {
    let boxes = BoxIndex::new(curves.iter().map(|curve| widened_box(curve, 0.0)));
    let mut compared = 0;
    let mut cuts = vec![Vec::new(); curves.len()];
    for (index, curve) in curves.iter().enumerate() {
        for other in boxes.near(widened_box(curve, JOIN_DISTANCE)).filter(|other| *other != index) {
            compared += 1;
            if compared > MAX_COMPARED_PAIRS {
                return vec![Vec::new(); curves.len()];
            }
            if crossing(&curves[other], curve).is_some() {
                cuts[index].extend(crossing(curve, &curves[other]));
            }
        }
        cuts[index].sort_by(f64::total_cmp);
    }
    cuts
}

/// Returns the rings that cross or overlap the rim of a larger one, each with a place where they do, which refers to the ring's own curves.
pub(super) fn crossed_rings(rings: &[NumberedCurves], is_outermost: &[bool]) -> Vec<(usize, Crossing)> {
    let all: Vec<(usize, usize, Curve)> = (0..)
        .zip(rings)
        .flat_map(|(ring, chain)| (0..).zip(chain).map(move |(place, (_, curve))| (ring, place, *curve)))
        .collect();
    let boxes = BoxIndex::new(all.iter().map(|(.., curve)| widened_box(curve, 0.0)));
    let areas: Vec<f64> = rings.iter().map(|ring| area(&curves_of(ring))).collect();
    let mut compared = 0;
    let mut found = Vec::new();
    let mut across: BTreeMap<(usize, usize), bool> = BTreeMap::new();
    for (ring, place, curve) in &all {
        for other in boxes.near(widened_box(curve, JOIN_DISTANCE)) {
            let (rim, _, rim_curve) = &all[other];
            let is_smaller = ring != rim && is_larger(*rim, *ring, &areas);
            if !is_outermost[*rim] || !is_smaller || compared > MAX_COMPARED_PAIRS {
                continue;
            }
            compared += 1;
            let crossed = crossing(rim_curve, curve).and_then(|_| crossing(curve, rim_curve));
            let along = crossed.or_else(|| {
                let overlap = overlap(curve, rim_curve)?;
                let is_across = *across
                    .entry((*ring, *rim))
                    .or_insert_with(|| is_partly_inside(&rings[*ring], &rings[*rim]));
                is_across.then_some(overlap)
            });
            found.extend(along.map(|along| {
                let place = (*place, along);
                (*ring, Crossing { at: curve.at(along), first: place, second: place })
            }));
        }
    }
    found
}

/// Returns the middle of the stretch of a curve on which it lies on another one, in mm along the curve.
fn overlap(along: &Curve, other: &Curve) -> Option<f64> {
    let mut near: Vec<Stretch> = Vec::new();
    add_stretches_within(along, other, JOIN_DISTANCE, &mut near);
    let is_long = |(from, to): &Stretch| to - from > MIN_OVERLAP;
    join_stretches(near, JOIN_DISTANCE).into_iter().find(is_long).map(|(from, to)| f64::midpoint(from, to))
}

/// Length in mm from which curves overlap, more than the length along which a curve is near one that it touches.
const MIN_OVERLAP: f64 = 4.0 * JOIN_DISTANCE;

/// Whether the middles of some of a ring's curves lie inside a rim, and those of others outside.
fn is_partly_inside(ring: &NumberedCurves, rim: &NumberedCurves) -> bool {
    let border = Outline::new(&curves_of(rim));
    let middles = ring.iter().map(|(_, curve)| curve.middle());
    let beside = middles.filter(|at| rim.iter().all(|(_, curve)| curve.distance_to(*at) > JOIN_DISTANCE));
    let sides: BTreeSet<bool> = beside.map(|at| border.contains(at)).collect();
    sides.len() == 2
}

/// Returns the place in mm along a curve where it crosses another one. A curve that ends on the other only touches it.
fn crossing(along: &Curve, other: &Curve) -> Option<f64> {
    let mut near: Vec<Stretch> = Vec::new();
    add_stretches_within(along, other, JOIN_DISTANCE, &mut near);
    let length = along.length();
    let crosses = |(from, to): &Stretch| {
        *from > 0.0
            && *to < length
            && is_left_or_inside(other, along.at(*from)) != is_left_or_inside(other, along.at(*to))
    };
    join_stretches(near, JOIN_DISTANCE).into_iter().find(crosses).map(|(from, to)| f64::midpoint(from, to))
}

/// Whether a point is on the left of a line, or inside the circle of an arc.
fn is_left_or_inside(curve: &Curve, at: Xy) -> bool {
    match curve {
        Curve::Line(line) => (line.end - line.start).perp(&(at - line.start)) > 0.0,
        Curve::Arc(arc) => (at - arc.centre).norm() < arc.radius,
    }
}
