//! Builds a graph from the closures of targets.

use std::collections::{HashMap, HashSet};

use camino::Utf8PathBuf;
use pathbuild_db::{
    Closure, Database, Destination, Instance, Role, Target, closure, locate, path_index, summary,
};
use pathbuild_diagnostic::messages::files;
use pathbuild_diagnostic::{Code, Diagnostic};
use pathbuild_path::{Bindings, PathName};

use super::{Embedding, End, Graph, Node};
use crate::session::Session;
use crate::session::work::about;

impl Session<'_> {
    /// The graph of everything that these targets embed.
    pub fn graph(&self, targets: &[Target]) -> Graph {
        let mut builder = GraphBuilder::default();
        let mut parts = Vec::with_capacity(targets.len());
        for (result, target) in
            self.map_guarded(targets, |db, target| part(db, *target)).into_iter().zip(targets)
        {
            match result {
                Ok(part) => {
                    let located = part.problems.iter().map(|problem| locate(&self.db, problem.clone()));
                    builder.graph.problems.extend(located);
                    parts.push(part);
                }
                Err(problem) => builder.graph.problems.push(about(&self.db, *target, *problem)),
            }
        }
        // Add the requested paths first, so that they come first even if another target embeds them.
        for part in &parts {
            builder.add_root(part);
        }
        for part in &parts {
            builder.add(part, Completeness::Whole);
        }
        for part in &parts {
            builder.add(part, Completeness::Cut);
        }
        builder.graph
    }
}

/// What one target embeds.
struct TargetGraph {
    /// The first node is the target.
    nodes: Vec<Node>,
    embeddings: Vec<(usize, End)>,
    /// Why the graph of this target is incomplete.
    problems: Vec<Diagnostic>,
}

impl TargetGraph {
    /// Nodes with missing embeddings, because the target embeds them too deep or embeds too many paths.
    fn cut(&self) -> HashSet<usize> {
        let cut = |(from, to): &(usize, End)| match to {
            End::Nowhere(_, Code::NestingTooDeep | Code::LimitReached) => Some(*from),
            _ => None,
        };
        self.embeddings.iter().filter_map(cut).collect()
    }
}

/// Whether all embeddings of a path are known.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Completeness {
    /// All are known.
    Whole,
    /// Some are too deep below the target or beyond a limit. Another target may have shown them all.
    Cut,
}

fn part(db: &Database, target: Target) -> TargetGraph {
    let reached = closure(db, target);
    let is_asked_with_examples = *target.role(db) == Role::Checked;
    let mut nodes = Vec::new();
    for (index, step) in reached.reached.iter().enumerate() {
        let mut node = node(db, step.instance);
        node.is_example = index == 0 && is_asked_with_examples && !node.bindings.is_empty();
        nodes.push(node);
    }
    let number = number(reached);
    let too_many_paths = too_many_paths(reached);
    let beyond = if too_many_paths.is_empty() { Code::NestingTooDeep } else { Code::LimitReached };
    let end = |to| match to {
        // The closure does not contain paths that are embedded too deep or beyond a limit.
        Destination::Path(child) => number
            .get(&child)
            .map_or_else(|| End::Nowhere(Some(node(db, child).name), beyond), |to| End::Node(*to)),
        Destination::Nowhere { name, code } => End::Nowhere(name, code),
    };
    let embeddings = reached.edges(db).into_iter().map(|edge| (number[&edge.from], end(edge.to)));
    TargetGraph { embeddings: embeddings.collect(), nodes, problems: too_many_paths }
}

/// PB005 if the target embeds more paths than the limit allows, so that some are missing.
fn too_many_paths(closure: &Closure<'_>) -> Vec<Diagnostic> {
    let is_limit = |problem: &&Diagnostic| *problem.message == files::TOO_MANY_PATHS;
    closure.diagnostics.iter().filter(is_limit).cloned().collect()
}

fn number<'db>(closure: &Closure<'db>) -> HashMap<Instance<'db>, usize> {
    closure.reached.iter().enumerate().map(|(index, step)| (step.instance, index)).collect()
}

fn node(db: &Database, instance: Instance<'_>) -> Node {
    let index = path_index(db, instance.file(db), instance.name(db)).as_ref();
    let name = index.map(|index| (*index.header.name).clone());
    Node {
        name: name.unwrap_or_else(|| PathName::new(instance.name(db).folded(db))),
        file: instance.file(db).path(db).clone(),
        bindings: instance.bindings(db).clone(),
        is_example: false,
        is_sound: summary(db, instance).signature.is_some(),
    }
}

/// A graph under construction. The maps are never iterated.
#[derive(Default)]
struct GraphBuilder {
    graph: Graph,
    nodes: HashMap<(PathName, Utf8PathBuf, Bindings), usize>,
    /// Nodes whose embeddings are complete. They are the same for every target that reaches the node.
    complete: HashSet<usize>,
}

impl GraphBuilder {
    fn add_root(&mut self, part: &TargetGraph) {
        let Some(node) = part.nodes.first() else { return };
        let root = self.node(node.clone());
        // Nodes are numbered in order of appearance, so an existing root was requested before.
        if self.graph.roots.len() == root {
            self.graph.roots.push(root);
        }
    }

    /// Adds the embeddings of those nodes of a part that have the given reach.
    fn add(&mut self, part: &TargetGraph, completeness: Completeness) {
        let numbers: Vec<usize> = part.nodes.iter().map(|node| self.node(node.clone())).collect();
        let cut = part.cut();
        let is_asked = |from: &usize| cut.contains(from) == (completeness == Completeness::Cut);
        let mut added: HashMap<(usize, End), usize> = HashMap::new();
        for (from, to) in part.embeddings.iter().filter(|(from, _)| is_asked(from)) {
            let from = numbers[*from];
            if self.complete.contains(&from) {
                continue;
            }
            let to = match to {
                End::Node(to) => End::Node(numbers[*to]),
                nowhere @ End::Nowhere(..) => nowhere.clone(),
            };
            let embeddings = &mut self.graph.embeddings;
            let index = *added.entry((from, to.clone())).or_insert(embeddings.len());
            match embeddings.get_mut(index) {
                Some(known) => known.count += 1,
                None => embeddings.push(Embedding { from, to, count: 1 }),
            }
        }
        self.complete.extend((0..numbers.len()).filter(is_asked).map(|node| numbers[node]));
    }

    fn node(&mut self, node: Node) -> usize {
        let key = (node.name.clone(), node.file.clone(), node.bindings.clone());
        if let Some(known) = self.nodes.get(&key) {
            self.graph.nodes[*known].is_example &= node.is_example;
            return *known;
        }
        let number = self.graph.nodes.len();
        self.nodes.insert(key, number);
        self.graph.nodes.push(node);
        number
    }
}
