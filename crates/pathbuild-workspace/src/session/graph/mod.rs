//! What embeds what, as values that need no database: what `graph`, `deps` and `rdeps` show. (book: reference/commands)

mod collect;

use std::collections::{BTreeSet, HashMap};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::{Code, Diagnostic};
use pathbuild_path::{Bindings, PathName};

/// Paths, and which embeds which.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    /// Each path with each set of values once, those that were asked for first.
    pub nodes: Vec<Node>,
    /// From embedding to embedded, in the order of the embedding path's segments.
    pub embeddings: Vec<Embedding>,
    /// The nodes that were asked for.
    pub roots: Vec<usize>,
    /// Why of some targets it is not known what they reach.
    pub problems: Vec<Diagnostic>,
}

/// A path with its values.
#[derive(Clone, Debug)]
pub struct Node {
    /// The path, as its drawing spells it.
    pub name: PathName,
    /// The drawing that defines it.
    pub file: Utf8PathBuf,
    /// The values of its variables.
    pub bindings: Bindings,
    /// Whether the values are examples that it is checked with, and nothing embeds it with them.
    pub is_example: bool,
    /// Whether its own drawing has no errors. Other paths may embed more than is known.
    pub is_sound: bool,
}

/// One or more subpath segments that embed the same.
#[derive(Clone, Debug, PartialEq)]
pub struct Embedding {
    /// The path that embeds: index into [`Graph::nodes`].
    pub from: usize,
    /// What it embeds.
    pub to: End,
    /// How many segments do.
    pub count: usize,
}

/// What a subpath segment leads to.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum End {
    /// A path: index into [`Graph::nodes`].
    Node(usize),
    /// Nothing: the name that it gives, and why.
    Nowhere(Option<PathName>, Code),
}

/// Which way to go along embeddings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// To what is embedded.
    Down,
    /// To what embeds.
    Up,
}

impl Graph {
    /// The nodes of a path, whatever its values; its example only where nothing embeds it.
    pub fn nodes_of(&self, name: &PathName, file: &Utf8Path) -> Vec<usize> {
        let is_it = |node: &Node| node.name == *name && node.file == *file;
        let mut found: Vec<usize> =
            (0..self.nodes.len()).filter(|index| is_it(&self.nodes[*index])).collect();
        if found.iter().any(|index| !self.nodes[*index].is_example) {
            found.retain(|index| !self.nodes[*index].is_example);
        }
        found
    }

    /// The embeddings of each node in a direction: indices into [`Graph::embeddings`].
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

    /// The part of the graph that is reached from some nodes, each given once: its roots.
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

    /// The node at the far end of an embedding.
    pub fn end(&self, embedding: usize, direction: Direction) -> Option<usize> {
        let embedding = &self.embeddings[embedding];
        match (direction, &embedding.to) {
            (Direction::Up, _) => Some(embedding.from),
            (Direction::Down, End::Node(to)) => Some(*to),
            (Direction::Down, End::Nowhere(..)) => None,
        }
    }
}
