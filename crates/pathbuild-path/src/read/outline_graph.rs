//! The graph of the curves on a layer with parts: rings, and chains that are not closed. (book: language/part)

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

use rstar::RTree;
use rstar::primitives::GeomWithData;

use crate::boxes::{BoxIndex, square};
use crate::disjoint_sets::{root, unite};
use crate::geometry::{Curve, Xy};
use crate::read::rings::{JOIN_DISTANCE, NumberedCurves, self_crossing};

/// Largest distance in mm between two loose ends that were probably meant to meet.
pub(super) const NEAR_MISS_DISTANCE: f64 = 0.5;

/// Curves that meet at nodes. Half-edge `2 * n` runs along curve n, `2 * n + 1` against it.
pub(super) struct Graph {
    curves: Vec<Curve>,
    /// The node at which each half-edge begins.
    tails: Vec<usize>,
    /// Indices of the curves that have not been dropped.
    numbers: Vec<usize>,
    /// Indices of the curves that have different faces on their two sides.
    dividing: BTreeSet<usize>,
    /// The faces that the dividing curves bound, as half-edges; a face lies on the left of its half-edges.
    faces: Vec<Vec<usize>>,
}

impl Graph {
    pub(super) fn new(curves: Vec<Curve>) -> Self {
        let ends: Vec<Xy> = curves.iter().flat_map(|curve| [curve.start(), curve.end()]).collect();
        let boxes = BoxIndex::new(ends.iter().map(|at| square(*at, JOIN_DISTANCE)));
        let mut tails = vec![usize::MAX; ends.len()];
        let mut open = Vec::new();
        for first in 0..ends.len() {
            if tails[first] != usize::MAX {
                continue;
            }
            tails[first] = first;
            open.push(first);
            while let Some(end) = open.pop() {
                for other in boxes.near(square(ends[end], 0.0)) {
                    if tails[other] == usize::MAX && (ends[other] - ends[end]).norm() <= JOIN_DISTANCE {
                        tails[other] = first;
                        open.push(other);
                    }
                }
            }
        }
        let numbers = (0..curves.len()).collect();
        let mut graph = Self { numbers, curves, tails, dividing: BTreeSet::new(), faces: Vec::new() };
        graph.drop_duplicates();
        graph.faces = graph.faces_of(&graph.numbers.iter().copied());
        graph.dividing = graph.dividing_curves();
        if graph.dividing.len() < graph.numbers.len() {
            graph.faces = graph.faces_of(&graph.dividing.iter().copied());
        }
        graph
    }

    /// Drops curves that are drawn twice. Curves are equal if their nodes and their midpoints are equal.
    fn drop_duplicates(&mut self) {
        let nodes = |number: &usize| {
            let (one, other) = (self.tails[2 * number], self.tails[2 * number + 1]);
            (one.min(other), one.max(other))
        };
        let mut all = std::mem::take(&mut self.numbers);
        all.sort_by_key(nodes);
        for parallel in all.chunk_by(|one, other| nodes(one) == nodes(other)) {
            let first = self.numbers.len();
            for number in parallel {
                let at = self.curves[*number].middle();
                let differs = |known: &usize| (self.curves[*known].middle() - at).norm() > JOIN_DISTANCE;
                if self.numbers[first..].iter().all(differs) {
                    self.numbers.push(*number);
                }
            }
        }
        self.numbers.sort_unstable();
    }

    /// Returns the point where a half-edge begins.
    pub(super) fn end(&self, half_edge: usize) -> Xy {
        let curve = &self.curves[half_edge / 2];
        if half_edge.is_multiple_of(2) { curve.start() } else { curve.end() }
    }

    /// Returns the pairs of loose ends that almost meet, each as the half-edges that begin there.
    pub(super) fn near_misses(&self) -> Vec<(usize, usize)> {
        let mut degrees = vec![0; self.tails.len()];
        let ends = || self.numbers.iter().flat_map(|number| [2 * number, 2 * number + 1]);
        for end in ends() {
            degrees[self.tails[end]] += 1;
        }
        let loose: Vec<usize> = ends().filter(|end| degrees[self.tails[*end]] == 1).collect();
        let numbered = loose.iter().map(|end| GeomWithData::new([self.end(*end).x, self.end(*end).y], *end));
        let tree = RTree::bulk_load(numbered.collect());
        let nearest = |end: usize| {
            let at = self.end(end);
            let near = tree.locate_within_distance([at.x, at.y], NEAR_MISS_DISTANCE * NEAR_MISS_DISTANCE);
            let others = near.map(|near| near.data).filter(|other| *other != end);
            let distance = |other: &usize| (self.end(*other) - at).norm();
            others.min_by(|one, other| distance(one).total_cmp(&distance(other)).then(one.cmp(other)))
        };
        let pairs = loose.iter().filter_map(|end| Some((*end, nearest(*end)?)));
        let mut pairs: Vec<(usize, usize)> =
            pairs.map(|(one, other)| (one.min(other), one.max(other))).collect();
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }

    /// Returns the outer rings of all connected curves, counterclockwise, each curve with its number. Curves with the same face on both sides are
    /// dropped: dangling chains, and lines from one ring to another. A ring that crosses itself may run either way round.
    pub(super) fn outer_rings(&self) -> Vec<NumberedCurves> {
        let outer = self.faces.iter().filter(|face| {
            let area = self.area(face);
            area < -JOIN_DISTANCE * JOIN_DISTANCE
                || area <= JOIN_DISTANCE * JOIN_DISTANCE && self.is_figure_of_eight(face)
        });
        let ring = |face: &Vec<usize>| {
            let backwards = face.iter().rev().map(|half_edge| half_edge ^ 1);
            backwards.map(|half_edge| (half_edge / 2, self.directed_curve(half_edge))).collect()
        };
        outer.map(ring).collect()
    }

    /// Whether a face without an area is one of the two sides of a ring in the shape of an eight, where the areas of both halves cancel out. Only one
    /// of the two sides is accepted.
    fn is_figure_of_eight(&self, face: &[usize]) -> bool {
        let curves: Vec<Curve> = face.iter().map(|half_edge| self.directed_curve(*half_edge)).collect();
        face[0].is_multiple_of(2) && self_crossing(&curves).is_some()
    }

    /// Returns the numbers of the curves that have different faces on their two sides.
    fn dividing_curves(&self) -> BTreeSet<usize> {
        let mut face_of = vec![0; 2 * self.curves.len()];
        for (number, face) in self.faces.iter().enumerate() {
            for half_edge in face {
                face_of[*half_edge] = number;
            }
        }
        let divides = |curve: &usize| face_of[2 * curve] != face_of[2 * curve + 1];
        self.numbers.iter().copied().filter(divides).collect()
    }

    /// Iterates over the curves that have the same face on both sides.
    fn open_curves(&self) -> impl Iterator<Item = usize> {
        self.numbers.iter().copied().filter(|number| !self.dividing.contains(number))
    }

    /// Returns the longest chain of each connected group of curves that belong to no ring. Ends that almost meet are treated as joined, except for
    /// the two ends of a chain.
    pub(super) fn open_chains(&self) -> Vec<NumberedCurves> {
        if self.dividing.len() == self.numbers.len() {
            return Vec::new();
        }
        let mut forest = Forest::new(self);
        let mut known = BTreeSet::new();
        let open = self.open_curves();
        let roots: Vec<usize> = open.map(|number| root(&mut forest.trees, self.tails[2 * number])).collect();
        roots.into_iter().filter(|root| known.insert(*root)).map(|root| forest.longest_chain(root)).collect()
    }

    /// Returns the longest chain from a ring in each connected group of curves that belong to no ring. Ends that almost meet are treated as joined.
    pub(super) fn hanging_chains(&self) -> Vec<NumberedCurves> {
        let mut forest = Forest::new(self);
        let ends = self.dividing.iter().flat_map(|number| [2 * number, 2 * number + 1]);
        let on_rings: BTreeSet<usize> = ends.map(|half_edge| self.tails[half_edge]).collect();
        let mut known = BTreeSet::new();
        let is_open = |node: &usize| forest.outgoing.contains_key(node);
        let open: Vec<usize> = on_rings.into_iter().filter(is_open).collect();
        let firsts: Vec<usize> =
            open.into_iter().filter(|node| known.insert(root(&mut forest.trees, *node))).collect();
        firsts.into_iter().map(|node| forest.chain(forest.half_edges_to_farthest(node))).collect()
    }

    fn directed_curve(&self, half_edge: usize) -> Curve {
        let curve = self.curves[half_edge / 2];
        if half_edge.is_multiple_of(2) { curve } else { curve.reversed() }
    }

    /// Returns the faces that these curves bound, as half-edges; a face lies on the left of its half-edges.
    fn faces_of(&self, curves: &(impl Iterator<Item = usize> + Clone)) -> Vec<Vec<usize>> {
        let half_edges = || curves.clone().flat_map(|curve| [2 * curve, 2 * curve + 1]);
        let node = |half_edge: &usize| self.tails[*half_edge];
        let mut outgoing: Vec<usize> = half_edges().collect();
        outgoing.sort_by_key(node);
        // The order round a node matters only if three or more half-edges begin there.
        let at_nodes = outgoing.chunk_by_mut(|one, other| node(one) == node(other));
        for edges in at_nodes.filter(|edges| edges.len() > 2) {
            let shortest =
                edges.iter().map(|edge| self.curves[edge / 2].length()).fold(10.0 * JOIN_DISTANCE, f64::min);
            let angle = |half_edge: usize| {
                let curve = self.directed_curve(half_edge);
                let way = curve.section(0.0, shortest / 2.0).end() - curve.start();
                libm::atan2(way.y, way.x)
            };
            edges.sort_by(|one, other| angle(*one).total_cmp(&angle(*other)).then(one.cmp(other)));
        }
        let next = |half_edge: usize| {
            let back = half_edge ^ 1;
            let first = outgoing.partition_point(|edge| node(edge) < node(&back));
            let end = outgoing.partition_point(|edge| node(edge) <= node(&back));
            let edges = &outgoing[first..end];
            let place = edges.iter().position(|edge| *edge == back).unwrap_or_default();
            edges[(place + edges.len() - 1) % edges.len()]
        };
        let mut is_done = vec![false; self.tails.len()];
        let mut faces = Vec::new();
        for first in half_edges() {
            let mut face = Vec::new();
            let mut half_edge = first;
            while !std::mem::replace(&mut is_done[half_edge], true) {
                face.push(half_edge);
                half_edge = next(half_edge);
            }
            if !face.is_empty() {
                faces.push(face);
            }
        }
        faces
    }

    /// Returns the area inside half-edges in mm², positive if they run counterclockwise.
    fn area(&self, face: &[usize]) -> f64 {
        let origin = self.end(face[0]);
        face.iter().map(|half_edge| self.directed_curve(*half_edge).area_from(origin)).sum()
    }
}

/// The curves with the same face on both sides, which form trees.
struct Forest<'g> {
    graph: &'g Graph,
    /// The node at which each half-edge begins.
    nodes: Vec<usize>,
    /// The half-edges that begin at each node.
    outgoing: BTreeMap<usize, Vec<usize>>,
    /// For each node, a node that is nearer to the root of its tree, or the root itself.
    trees: Vec<usize>,
}

impl<'g> Forest<'g> {
    /// Creates the forest of the curves that do not divide faces. Ends that almost meet become one node, except for the two ends of a tree.
    fn new(graph: &'g Graph) -> Self {
        let mut trees: Vec<usize> = (0..graph.tails.len()).collect();
        for number in graph.open_curves() {
            unite(&mut trees, graph.tails[2 * number], graph.tails[2 * number + 1]);
        }
        let mut joints: Vec<usize> = (0..graph.tails.len()).collect();
        for (one, other) in graph.near_misses() {
            let is_open = |end: usize| !graph.dividing.contains(&(end / 2));
            if is_open(one) && is_open(other) && unite(&mut trees, graph.tails[one], graph.tails[other]) {
                unite(&mut joints, graph.tails[one], graph.tails[other]);
            }
        }
        let nodes: Vec<usize> = graph.tails.iter().map(|tail| root(&mut joints, *tail)).collect();
        let mut outgoing: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for half_edge in graph.open_curves().flat_map(|number| [2 * number, 2 * number + 1]) {
            outgoing.entry(nodes[half_edge]).or_default().push(half_edge);
        }
        Self { graph, nodes, outgoing, trees }
    }

    /// Returns the longest chain in the tree that contains a node.
    fn longest_chain(&self, node: usize) -> NumberedCurves {
        let one_end = self.half_edges_to_farthest(self.nodes[node]).last().map_or(node, |last| last ^ 1);
        self.chain(self.half_edges_to_farthest(self.nodes[one_end]))
    }

    fn chain(&self, way: Vec<usize>) -> NumberedCurves {
        way.into_iter().map(|half_edge| (half_edge / 2, self.graph.directed_curve(half_edge))).collect()
    }

    /// Returns the half-edges from a node to the node that is farthest along the curves.
    fn half_edges_to_farthest(&self, node: usize) -> Vec<usize> {
        let mut reached: BTreeMap<usize, Option<usize>> = BTreeMap::from([(node, None)]);
        let (mut open, mut farthest) = (vec![(node, 0.0)], (node, 0.0));
        while let Some((node, length)) = open.pop() {
            if length > farthest.1 {
                farthest = (node, length);
            }
            for half_edge in self.outgoing.get(&node).into_iter().flatten() {
                let next = self.nodes[half_edge ^ 1];
                if let Entry::Vacant(entry) = reached.entry(next) {
                    entry.insert(Some(*half_edge));
                    open.push((next, length + self.graph.curves[half_edge / 2].length()));
                }
            }
        }
        let back = |half_edge: &usize| reached.get(&self.nodes[*half_edge]).copied().flatten();
        let last = reached.get(&farthest.0).copied().flatten();
        let mut way: Vec<usize> = std::iter::successors(last, back).collect();
        way.reverse();
        way
    }
}
