//! Finds the edge nearest to the tool tip. (book: program/gcode)
//!
//! Distances are compared approximately, which is not transitive, so the result is defined by a single scan in segment order. Only edges
//! near
//! the tip can affect that scan, and only the first of the edges that begin at the same point and depth. An R-tree of points finds them,
//! which avoids quadratic time for chains or stars of many thousand segments.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Bound;

use pathbuild_path::Xy;
use pathbuild_path::approx::above;
use rstar::RTree;
use rstar::primitives::GeomWithData;

use crate::chain::{Run, Strand};
use crate::fold::{Tip, distance};

/// The edges of a chain that have not been milled yet.
pub(crate) struct OpenEdges<'a> {
    strands: &'a [Strand<'a>],
    /// Number of edges of each strand that are done, counted from the top.
    done: Vec<usize>,
    /// Both ends of each strand, as indices into `points`.
    ends: Vec<[usize; 2]>,
    points: Vec<Point>,
    tree: RTree<GeomWithData<[f64; 2], usize>>,
}

/// An end point of one or more strands.
struct Point {
    at: Xy,
    /// The strands with edges left, by the depth of their next edge.
    levels: BTreeMap<Coordinate, BTreeSet<usize>>,
}

/// A coordinate in mm that can be used as a key.
#[derive(Clone, Copy)]
struct Coordinate(f64);

impl<'a> OpenEdges<'a> {
    pub(crate) fn new(strands: &'a [Strand<'a>]) -> Self {
        let (mut points, mut known) = (Vec::new(), BTreeMap::new());
        let mut point = |at: Xy| {
            *known.entry((Coordinate(at.x), Coordinate(at.y))).or_insert_with(|| {
                points.push(Point { at, levels: BTreeMap::new() });
                points.len() - 1
            })
        };
        let ends = strands.iter().map(|strand| [strand.curve.start(), strand.curve.end()].map(&mut point));
        let ends: Vec<[usize; 2]> = ends.collect();
        let entry = |(number, point): (usize, &Point)| GeomWithData::new([point.at.x, point.at.y], number);
        let tree = RTree::bulk_load(points.iter().enumerate().map(entry).collect());
        let mut open = Self { strands, done: vec![0; strands.len()], ends, points, tree };
        (0..strands.len()).for_each(|strand| open.enter(strand));
        open
    }

    /// Takes the next edge: among those whose upper edges are done, the one with an end nearest to the tip, and the first of these if there
    /// are several.
    pub(crate) fn take_nearest(&mut self, tip: Tip) -> Option<Run> {
        let mut best: Option<(f64, Run)> = None;
        for index in self.contenders(tip) {
            let (least, run) = self.run(index, tip);
            if best.is_none_or(|(nearest, _)| above(nearest, least)) {
                best = Some((least, run));
            }
        }
        let (_, run) = best?;
        self.leave(run.strand);
        self.done[run.strand] += 1;
        if self.is_open(run.strand) {
            self.enter(run.strand);
        } else {
            self.forget_points(run.strand);
        }
        Some(run)
    }

    /// The next edge of a strand, and the distance to its nearer end.
    fn run(&self, index: usize, tip: Tip) -> (f64, Run) {
        let (strand, edge) = (&self.strands[index], self.done[index]);
        let to = |at: Xy| distance(tip, Tip { at, z: strand.depths[edge] });
        let (to_start, to_end) = (to(strand.curve.start()), to(strand.curve.end()));
        let is_backwards = !above(to_end, to_start);
        let least = if is_backwards { to_end } else { to_start };
        (least, Run { strand: index, edge, is_backwards })
    }

    /// The strands that decide the scan, in segment order: the nearest ones, and those that cannot be distinguished from these or from each
    /// other. Strands beyond the first distinguishable gap are skipped in any order, as well as those after another one at the same
    /// distance.
    fn contenders(&self, tip: Tip) -> Vec<usize> {
        let place = [tip.at.x, tip.at.y];
        let mut found: Vec<(f64, usize)> = Vec::new();
        let mut reach = f64::INFINITY;
        if let Some(nearest) = self.tree.nearest_neighbor(place) {
            self.look(nearest.data, tip, &mut found, &mut reach);
        }
        // The distance in space is at least the distance in the plane. Asking for points one by one would sort all those at equal
        // distance.
        for point in self.tree.locate_within_distance(place, reach * reach) {
            self.look(point.data, tip, &mut found, &mut reach);
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let gap = found.windows(2).position(|pair| above(pair[1].0, pair[0].0));
        let last = gap.unwrap_or(found.len().saturating_sub(1));
        let mut contenders: Vec<usize> = match found.get(last) {
            Some((farthest, _)) if above(reach, *farthest) => {
                found[..=last].iter().map(|(_, strand)| *strand).collect()
            }
            // If edges are within the tolerance of each other as far as the search reached, all of them are scanned.
            _ => (0..self.strands.len()).filter(|index| self.is_open(*index)).collect(),
        };
        contenders.sort_unstable();
        contenders.dedup();
        contenders
    }

    /// Finds the first strand of each depth at a point within the reach, and reduces the reach accordingly.
    fn look(&self, point: usize, tip: Tip, found: &mut Vec<(f64, usize)>, reach: &mut f64) {
        let Point { at, levels } = &self.points[point];
        let mut look = |(depth, strands): (&Coordinate, &BTreeSet<usize>)| {
            let is_near = distance(tip, Tip { at: *at, z: depth.0 }) <= *reach;
            if let Some(first) = strands.first().filter(|_| is_near) {
                let (least, _) = self.run(*first, tip);
                found.push((least, *first));
                *reach = reach.min(least * (1.0 + MARGIN) + MARGIN);
            }
            is_near
        };
        let here = Coordinate(tip.z);
        _ = levels.range(..=here).rev().all(&mut look);
        _ = levels.range((Bound::Excluded(here), Bound::Unbounded)).all(&mut look);
    }

    fn is_open(&self, strand: usize) -> bool {
        self.done[strand] < self.strands[strand].depths.len()
    }

    /// Inserts the next edge of a strand at both its ends.
    fn enter(&mut self, strand: usize) {
        let depth = Coordinate(self.strands[strand].depths[self.done[strand]]);
        for end in self.ends[strand] {
            self.points[end].levels.entry(depth).or_default().insert(strand);
        }
    }

    /// Removes the next edge of a strand.
    fn leave(&mut self, strand: usize) {
        let depth = Coordinate(self.strands[strand].depths[self.done[strand]]);
        for end in self.ends[strand] {
            let levels = &mut self.points[end].levels;
            if let Some(strands) = levels.get_mut(&depth) {
                strands.remove(&strand);
                if strands.is_empty() {
                    levels.remove(&depth);
                }
            }
        }
    }

    /// Removes the ends of a completed strand from the tree, if no other strand has an edge left there.
    fn forget_points(&mut self, strand: usize) {
        for end in self.ends[strand] {
            let Point { at, levels } = &self.points[end];
            if levels.is_empty() {
                self.tree.remove(&GeomWithData::new([at.x, at.y], end));
            }
        }
    }
}

/// How far beyond the nearest edge to search, as a fraction of the distance and in mm: many times the tolerance of comparisons.
const MARGIN: f64 = 1e-4;

impl PartialEq for Coordinate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Coordinate {}

impl PartialOrd for Coordinate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Coordinate {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}
