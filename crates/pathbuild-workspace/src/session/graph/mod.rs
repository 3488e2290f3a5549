//! The graph of embeddings, as values independent of the database, for `graph`, `deps` and `rdeps`. (book: reference/commands)

mod collect;

use std::collections::{BTreeSet, HashMap};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::{Code, Diagnostic};
use pathbuild_path::{Bindings, PathName};

/// Paths, and which path embeds which.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    /// Each path once per set of values; the requested paths come first.
    pub nodes: Vec<Node>,
    /// Embeddings in the order of the embedding path's segments.
    pub embeddings: Vec<Embedding>,
    /// The requested nodes.
    pub roots: Vec<usize>,
    /// Why the embeddings of some targets are unknown.
    pub problems: Vec<Diagnostic>,
}

/// A path with the values of its variables.
#[derive(Clone, Debug)]
pub struct Node {
    /// Name of the path, as its drawing spells it.
    pub name: PathName,
    /// The drawing that defines it.
    pub file: Utf8PathBuf,
    /// Values of its variables.
    pub bindings: Bindings,
    /// Whether the values are only examples for checking, with which nothing embeds the path.
    pub is_example: bool,
    /// Whether its drawing has no errors. Otherwise the path may embed more than is known.
    pub is_sound: bool,
}

/// One or more subpath segments that embed the same path.
#[derive(Clone, Debug, PartialEq)]
pub struct Embedding {
    /// The embedding path, as an index into [`Graph::nodes`].
    pub from: usize,
    /// The embedded path.
    pub to: End,
    /// Number of segments.
    pub count: usize,
}

/// Target of a subpath segment.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum End {
    /// A path, as an index into [`Graph::nodes`].
    Node(usize),
    /// No path: the name in the segment, and the reason.
    Nowhere(Option<PathName>, Code),
}

/// Direction in which embeddings are followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From a path to the paths that it embeds.
    Down,
    /// From a path to the paths that embed it.
    Up,
}

impl Graph {
    /// The nodes of a path, for all sets of values. The example node counts only if nothing embeds the path.
    pub fn nodes_of(&self, name: &PathName, file: &Utf8Path) -> Vec<usize> {
        let is_it = |node: &Node| node.name == *name && node.file == *file;
        let mut indices: Vec<usize> =
            (0..self.nodes.len()).filter(|index| is_it(&self.nodes[*index])).collect();
        if indices.iter().any(|index| !self.nodes[*index].is_example) {
            indices.retain(|index| !self.nodes[*index].is_example);
        }
        indices
    }

    /// For each node, its embeddings in a direction, as indices into [`Graph::embeddings`].
    pub fn neighbours(&self, direction: Direction) -> Vec<Vec<usize>> {
        let mut neighbours = vec![Vec::new(); self.nodes.len()];
        for (index, embedding) in self.embeddings.iter().enumerate() {
            match (direction, &embedding.to) {
                (Direction::Down, _) => neighbours[embedding.from].push(index),
                (Direction::Up, End::Node(to)) => neighbours[*to].push(index),
                (Direction::Up, End::Nowhere(..)) => {}
            }
        }
        neighbours
    }

    /// The part of the graph that is reachable from some nodes, which become its roots. The nodes must be distinct.
    pub fn part(&self, roots: &[usize], direction: Direction) -> Self {
        let neighbours = self.neighbours(direction);
        let mut order: Vec<usize> = Vec::new();
        let mut number: HashMap<usize, usize> = HashMap::new();
        let mut kept: BTreeSet<usize> = BTreeSet::new();
        let mut open: Vec<usize> = roots.iter().rev().copied().collect();
        while let Some(node) = open.pop() {
            if number.contains_key(&node) {
                continue;
            }
            number.insert(node, order.len());
            order.push(node);
            kept.extend(&neighbours[node]);
            open.extend(neighbours[node].iter().rev().filter_map(|index| self.end(*index, direction)));
        }
        let renumbered = |embedding: &Embedding| Embedding {
            from: number[&embedding.from],
            to: match &embedding.to {
                End::Node(to) => End::Node(number[to]),
                nowhere @ End::Nowhere(..) => nowhere.clone(),
            },
            count: embedding.count,
        };
        Self {
            nodes: order.iter().map(|index| self.nodes[*index].clone()).collect(),
            embeddings: kept.iter().map(|index| renumbered(&self.embeddings[*index])).collect(),
            roots: roots.iter().map(|root| number[root]).collect(),
            problems: self.problems.clone(),
        }
    }

    /// The node at the far end of an embedding; `None` if there is no path.
    pub fn end(&self, embedding: usize, direction: Direction) -> Option<usize> {
        let embedding = &self.embeddings[embedding];
        match (direction, &embedding.to) {
            (Direction::Up, _) => Some(embedding.from),
            (Direction::Down, End::Node(to)) => Some(*to),
            (Direction::Down, End::Nowhere(..)) => None,
        }
    }
}
