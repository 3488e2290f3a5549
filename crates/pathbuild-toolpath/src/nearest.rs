//! The edge that is nearest to the tool tip. (book: program/gcode)
//!
//! Distances are compared approximately, which is not transitive: the choice is that of one scan in segment order. Only edges near the
//! tip can matter to that scan, and an R-tree finds them, so that a chain of many thousand segments does not take the square of it.

use pathbuild_path::Xy;
use pathbuild_path::approx::above;
use rstar::RTree;
use rstar::primitives::GeomWithData;

use crate::chain::{Run, Strand};
use crate::fold::{Tip, distance};

/// The edges of a chain that are still to be milled.
pub(crate) struct OpenEdges<'a> {
    strands: &'a [Strand<'a>],
    /// How many edges of each strand are done, from the top.
    done: Vec<usize>,
    ends: RTree<End>,
}

/// An end of a strand of which edges are left.
type End = GeomWithData<[f64; 2], usize>;

impl<'a> OpenEdges<'a> {
    pub(crate) fn new(strands: &'a [Strand<'a>]) -> Self {
        let ends = strands.iter().enumerate().flat_map(|(index, strand)| ends(strand, index));
        Self { strands, done: vec![0; strands.len()], ends: RTree::bulk_load(ends.collect()) }
    }

    /// Takes the next edge: of those whose edge above is done, the one with an end nearest to the tip; the first on a tie.
    pub(crate) fn take_nearest(&mut self, tip: Tip) -> Option<Run> {
        let mut best: Option<(f64, Run)> = None;
        for index in self.contenders(tip) {
            let (least, run) = self.run(index, tip);
            if best.is_none_or(|(nearest, _)| above(nearest, least)) {
                best = Some((least, run));
            }
        }
        let (_, run) = best?;
        self.done[run.strand] += 1;
        if self.done[run.strand] == self.strands[run.strand].depths.len() {
            for end in ends(&self.strands[run.strand], run.strand) {
                self.ends.remove(&end);
            }
        }
        Some(run)
    }

    /// A strand's next edge, and how far its nearer end is.
    fn run(&self, index: usize, tip: Tip) -> (f64, Run) {
        let (strand, edge) = (&self.strands[index], self.done[index]);
        let to = |at: Xy| distance(tip, Tip { at, z: strand.depths[edge] });
        let (to_start, to_end) = (to(strand.curve.start()), to(strand.curve.end()));
        let is_backwards = !above(to_end, to_start);
        let least = if is_backwards { to_end } else { to_start };
        (least, Run { strand: index, edge, is_backwards })
    }

    /// The strands that decide the scan, in segment order: the nearest, and those that cannot be told from it, from one to the next.
    /// Whatever is farther than the first gap that comparing tells is passed over in any order.
    fn contenders(&self, tip: Tip) -> Vec<usize> {
        let mut found: Vec<(f64, usize)> = Vec::new();
        let mut reach = f64::INFINITY;
        for (end, squared) in self.ends.nearest_neighbor_iter_with_distance_2([tip.at.x, tip.at.y]) {
            // The distance in space is at least that in the plane.
            if libm::sqrt(squared) > reach {
                break;
            }
            let (least, _) = self.run(end.data, tip);
            found.push((least, end.data));
            reach = reach.min(least * (1.0 + MARGIN) + MARGIN);
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let gap = found.windows(2).position(|pair| above(pair[1].0, pair[0].0));
        let last = gap.unwrap_or(found.len().saturating_sub(1));
        let mut contenders: Vec<usize> = match found.get(last) {
            Some((farthest, _)) if above(reach, *farthest) => {
                found[..=last].iter().map(|(_, strand)| *strand).collect()
            }
            // Edge upon edge within the tolerance, as far as was looked: then all are scanned.
            _ => (0..self.strands.len()).filter(|index| self.is_open(*index)).collect(),
        };
        contenders.sort_unstable();
        contenders.dedup();
        contenders
    }

    fn is_open(&self, strand: usize) -> bool {
        self.done[strand] < self.strands[strand].depths.len()
    }
}

/// How far beyond the nearest is looked, as a part of the distance and in mm: many times what approximate comparison allows.
const MARGIN: f64 = 1e-4;

fn ends(strand: &Strand<'_>, index: usize) -> [End; 2] {
    [strand.curve.start(), strand.curve.end()].map(|at| GeomWithData::new([at.x, at.y], index))
}
