//! The graph of embeddings, as values independent of the database, for `graph`, `deps` and `rdeps`. (book: reference/commands)

use std::collections::{BTreeSet, HashMap, HashSet};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{
    Closure, Database, Db, Destination, Instance, Role, SourceFile, Target, closure, file_index, locate,
    path_index, summary,
};
use pathbuild_diagnostic::messages::files;
use pathbuild_diagnostic::{Code, Diagnostic};
use pathbuild_path::{Bindings, PathName};

use crate::Inputs;
use crate::session::Session;
use crate::session::work::with_file_and_path;

/// A graph with paths as nodes and embeddings as edges.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    /// The paths, each once for each set of values; the requested paths come first.
    pub nodes: Vec<Node>,
    /// The embeddings, in the order of the segments in the embedding path.
    pub embeddings: Vec<Embedding>,
    /// Indices of the requested nodes.
    pub roots: Vec<usize>,
    /// Diagnostics of targets with unknown embeddings.
    pub problems: Vec<Diagnostic>,
}

/// A path with the values of its variables.
#[derive(Clone, Debug)]
pub struct Node {
    /// Name of the path, as its drawing spells it.
    pub name: PathName,
    /// Path of the drawing that defines it.
    pub file: Utf8PathBuf,
    /// Values of the path's variables.
    pub bindings: Bindings,
    /// Whether the values are only examples for checking: no path embeds this one with these values.
    pub is_example: bool,
    /// Whether the path has no errors. A path with errors may embed more than is known.
    pub is_sound: bool,
}

/// An edge of the graph. It stands for all subpath segments of one path that embed the same other path, or for a path that takes the parameters of
/// another path with @, so that a change of the other path affects it as well.
#[derive(Clone, Debug, PartialEq)]
pub struct Embedding {
    /// Index of the embedding path in [`Graph::nodes`].
    pub from: usize,
    /// The embedded path, or the reason why there is none.
    pub to: EmbeddingEnd,
    /// Number of subpath segments with this embedding.
    pub count: usize,
    /// Whether the other path is not embedded, but lends its parameters.
    pub is_lender: bool,
}

/// The path that a subpath segment embeds, or the reason why there is none.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum EmbeddingEnd {
    /// Index of a path in [`Graph::nodes`].
    Node(usize),
    /// There is no such path. Contains the name in the segment, if it has one, and the code of the error.
    Nowhere(Option<PathName>, Code),
}

/// Direction in which embeddings are followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Embeddings are followed from a path to the paths that it embeds.
    Down,
    /// Embeddings are followed from a path to the paths that embed it.
    Up,
}

impl Graph {
    /// Returns the nodes of a path, one for each set of values. If other paths embed this path, the node with example values is left out, unless a
    /// path takes its parameters with @.
    pub fn nodes_of(&self, name: &PathName, file: &Utf8Path) -> Vec<usize> {
        let is_of_path = |node: &Node| node.name == *name && node.file == *file;
        let mut indices: Vec<usize> =
            (0..self.nodes.len()).filter(|index| is_of_path(&self.nodes[*index])).collect();
        if indices.iter().any(|index| !self.nodes[*index].is_example) {
            let lends = |index: &usize| {
                self.embeddings.iter().any(|other| other.is_lender && other.to == EmbeddingEnd::Node(*index))
            };
            indices.retain(|index| !self.nodes[*index].is_example || lends(index));
        }
        indices
    }

    /// Returns, for each node, its embeddings in a direction, as indices into [`Graph::embeddings`].
    pub fn neighbours(&self, direction: Direction) -> Vec<Vec<usize>> {
        let mut neighbours = vec![Vec::new(); self.nodes.len()];
        for (index, embedding) in self.embeddings.iter().enumerate() {
            match (direction, &embedding.to) {
                (Direction::Down, _) => neighbours[embedding.from].push(index),
                (Direction::Up, EmbeddingEnd::Node(to)) => neighbours[*to].push(index),
                (Direction::Up, EmbeddingEnd::Nowhere(..)) => {}
            }
        }
        neighbours
    }

    /// Returns the part of the graph that is reachable from some nodes, which become its roots. The nodes must be distinct.
    pub fn reachable_part(&self, roots: &[usize], direction: Direction) -> Self {
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
                EmbeddingEnd::Node(to) => EmbeddingEnd::Node(number[to]),
                nowhere @ EmbeddingEnd::Nowhere(..) => nowhere.clone(),
            },
            ..*embedding
        };
        Self {
            nodes: order.iter().map(|index| self.nodes[*index].clone()).collect(),
            embeddings: kept.iter().map(|index| renumbered(&self.embeddings[*index])).collect(),
            roots: roots.iter().map(|root| number[root]).collect(),
            problems: self.problems.clone(),
        }
    }

    /// Returns the node at the far end of an embedding; `None` if no path is embedded there.
    pub fn end(&self, embedding: usize, direction: Direction) -> Option<usize> {
        let embedding = &self.embeddings[embedding];
        match (direction, &embedding.to) {
            (Direction::Up, _) => Some(embedding.from),
            (Direction::Down, EmbeddingEnd::Node(to)) => Some(*to),
            (Direction::Down, EmbeddingEnd::Nowhere(..)) => None,
        }
    }
}

/// The graph for some arguments, with its diagnostics.
#[derive(Debug)]
pub struct GraphOutcome {
    /// The graph; its roots are the paths of the arguments.
    pub graph: Graph,
    /// Diagnostics of the arguments and of their drawings, and reasons why embeddings are unknown.
    pub diagnostics: Vec<Diagnostic>,
    /// Number of paths with errors, which may embed more than is known.
    pub incomplete: usize,
}

impl GraphOutcome {
    fn new(graph: Graph, problems: Vec<Diagnostic>) -> Self {
        let incomplete = graph.nodes.iter().filter(|node| !node.is_sound).count();
        let diagnostics = problems.into_iter().chain(graph.problems.iter().cloned()).collect();
        Self { graph, diagnostics, incomplete }
    }
}

struct GraphArguments {
    targets: Vec<Target>,
    files: Vec<SourceFile>,
    problems: Vec<Diagnostic>,
}

impl GraphArguments {
    fn new(session: &Session<'_>, inputs: &Inputs) -> Self {
        let selection = session.select(inputs);
        let files = selection.whole_drawings(session);
        session.parse_ahead(&files);
        let mut targets: Vec<Target> =
            files.iter().flat_map(|file| session.targets(*file, &Role::Checked)).collect();
        let is_whole: HashSet<SourceFile> = files.iter().copied().collect();
        let named = selection.paths.iter().filter(|path| !is_whole.contains(&path.file));
        targets.extend(named.map(|path| session.db().target(path.file, path.name.as_str(), Role::Checked)));
        let mut problems = selection.problems;
        problems.extend(files.iter().flat_map(|file| session.errors_without_paths(*file)).cloned());
        let problems = session.with_hints(problems);
        Self { targets, files, problems }
    }

    /// Returns the targets of the arguments, followed by all other targets, which may embed them.
    fn with_all_others(&mut self, session: &Session<'_>) -> Vec<Target> {
        let (files, problems) = session.all_drawings();
        self.problems.extend(problems);
        session.parse_ahead(&files);
        let arguments: HashSet<SourceFile> = self.files.iter().copied().collect();
        let others = files.into_iter().filter(|file| !arguments.contains(file));
        let others = others.flat_map(|file| session.targets(file, &Role::Checked));
        self.targets.iter().copied().chain(others).collect()
    }

    /// Returns the part of the whole library's graph that consists of the arguments and the paths that embed them.
    fn part_above(&self, db: &Database, whole: &Graph) -> Graph {
        let named = self.targets.iter().flat_map(|target| {
            let name = PathName::new(target.name(db));
            whole.nodes_of(&name, target.file(db).path(db))
        });
        let mut roots: Vec<usize> = Vec::new();
        for root in named {
            if !roots.contains(&root) {
                roots.push(root);
            }
        }
        whole.reachable_part(&roots, Direction::Up)
    }
}

impl Session<'_> {
    /// Returns the graph of the paths that the inputs embed, directly or through others.
    pub fn embedded_paths(&mut self, inputs: &Inputs) -> GraphOutcome {
        self.with_stable_files(|session| {
            let arguments = GraphArguments::new(session, inputs);
            GraphOutcome::new(session.graph(&arguments.targets), arguments.problems)
        })
    }

    /// Returns the graph of the paths in the library that embed the inputs, directly or through others.
    pub fn embedding_paths(&mut self, inputs: &Inputs) -> GraphOutcome {
        self.with_stable_files(|session| {
            let mut arguments = GraphArguments::new(session, inputs);
            let whole = session.graph(&arguments.with_all_others(session));
            let graph = arguments.part_above(session.db(), &whole);
            GraphOutcome { graph, ..GraphOutcome::new(whole, arguments.problems) }
        })
    }

    /// Returns the graph of everything that these targets embed.
    pub fn graph(&self, targets: &[Target]) -> Graph {
        let mut builder = GraphBuilder::default();
        let mut parts = Vec::with_capacity(targets.len());
        for (result, target) in
            self.map_guarded(targets, |db, target| target_graph(db, *target)).into_iter().zip(targets)
        {
            match result {
                Ok(part) => {
                    let located = part.problems.iter().map(|problem| locate(&self.db, problem.clone()));
                    builder.graph.problems.extend(located);
                    parts.push(part);
                }
                Err(problem) => builder.graph.problems.push(with_file_and_path(&self.db, *target, *problem)),
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

/// The graph of the paths that one target embeds.
struct TargetGraph {
    /// The paths; the first one is the target, and the last ones only lend their parameters.
    nodes: Vec<Node>,
    /// Number of paths that the target embeds, including itself.
    reached: usize,
    embeddings: Vec<(usize, EmbeddingEnd)>,
    /// Paths that take the parameters of another path with @, each with that path, as indices into `nodes`.
    loans: Vec<(usize, usize)>,
    /// Diagnostics that explain why the graph of this target is incomplete.
    problems: Vec<Diagnostic>,
}

impl TargetGraph {
    /// Returns the nodes with incomplete embeddings. They are incomplete because the target embeds the node too deeply, or embeds too many paths.
    fn incomplete_nodes(&self) -> HashSet<usize> {
        let cut = |(from, to): &(usize, EmbeddingEnd)| match to {
            EmbeddingEnd::Nowhere(_, Code::NestingTooDeep | Code::LimitReached) => Some(*from),
            _ => None,
        };
        self.embeddings.iter().filter_map(cut).collect()
    }
}

/// The extent to which a node's embeddings are known.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Completeness {
    /// All embeddings are known.
    Whole,
    /// Some embeddings are unknown, because they are too deep below the target or beyond a limit. The graph of another target may contain them.
    Cut,
}

fn target_graph(db: &Database, target: Target) -> TargetGraph {
    let reached = closure(db, target);
    let is_asked_with_examples = *target.role(db) == Role::Checked;
    let mut nodes = Vec::new();
    for (index, instance) in reached.reached.iter().enumerate() {
        let mut node = node(db, *instance);
        node.is_example = index == 0 && is_asked_with_examples && !node.bindings.is_empty();
        nodes.push(node);
    }
    let number: HashMap<Instance<'_>, usize> =
        reached.reached.iter().enumerate().map(|(index, instance)| (*instance, index)).collect();
    let too_many_paths = too_many_paths(reached);
    let beyond = if too_many_paths.is_empty() { Code::NestingTooDeep } else { Code::LimitReached };
    let end = |to| match to {
        // The closure does not contain paths that are embedded too deeply or beyond a limit.
        Destination::Path(child) => number.get(&child).map_or_else(
            || EmbeddingEnd::Nowhere(Some(node(db, child).name), beyond),
            |to| EmbeddingEnd::Node(*to),
        ),
        Destination::Nowhere { name, code } => EmbeddingEnd::Nowhere(name, code),
    };
    let embeddings = reached.edges(db).into_iter().map(|edge| (number[&edge.from], end(edge.to)));
    let embeddings = embeddings.collect();
    let reached = nodes.len();
    let loans = add_lenders(db, &mut nodes);
    TargetGraph { embeddings, nodes, reached, loans, problems: too_many_paths }
}

/// Adds the paths from which others take their parameters with @, unless they are among the nodes already. Returns the index of each borrower with
/// that of its lender.
fn add_lenders(db: &Database, nodes: &mut Vec<Node>) -> Vec<(usize, usize)> {
    let mut loans = Vec::new();
    for borrower in 0..nodes.len() {
        let file = nodes[borrower].file.clone();
        let index = file_index(db, db.file(&file));
        let lender =
            index.path(&nodes[borrower].name).and_then(|path| index.path(path.header.lender.as_ref()?));
        let Some(lender) = lender else { continue };
        let name = &*lender.header.name;
        let known = nodes.iter().position(|node| node.name == *name && node.file == file);
        loans.push((borrower, known.unwrap_or(nodes.len())));
        if known.is_none() {
            nodes.push(Node {
                name: name.clone(),
                file,
                bindings: lender.examples.clone(),
                is_example: !lender.examples.is_empty(),
                is_sound: lender.summary.signature.is_some(),
            });
        }
    }
    loans
}

/// Returns PB005 if the target embeds more paths than the limit allows, so that some are missing.
fn too_many_paths(closure: &Closure<'_>) -> Vec<Diagnostic> {
    let is_limit = |problem: &&Diagnostic| *problem.message == files::TOO_MANY_PATHS;
    closure.diagnostics.iter().filter(is_limit).cloned().collect()
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

/// A graph under construction. The maps are never iterated, so their order does not affect the graph.
#[derive(Default)]
struct GraphBuilder {
    graph: Graph,
    nodes: HashMap<(PathName, Utf8PathBuf, Bindings), usize>,
    /// Nodes for which all embeddings have been added. A node has the same embeddings in every target that reaches it.
    complete: HashSet<usize>,
}

impl GraphBuilder {
    fn add_root(&mut self, part: &TargetGraph) {
        let Some(node) = part.nodes.first() else { return };
        let root = self.node(node.clone());
        // Nodes are numbered in order of appearance, so a node with a lower number is a root already.
        if self.graph.roots.len() == root {
            self.graph.roots.push(root);
        }
    }

    /// Adds the embeddings of those nodes of a part that have the given completeness.
    fn add(&mut self, part: &TargetGraph, completeness: Completeness) {
        let numbers: Vec<usize> = part.nodes.iter().map(|node| self.node(node.clone())).collect();
        let cut = part.incomplete_nodes();
        let is_asked = |from: &usize| cut.contains(from) == (completeness == Completeness::Cut);
        for (from, to) in part.loans.iter().filter(|(from, _)| is_asked(from)) {
            if !self.complete.contains(&numbers[*from]) {
                let to = EmbeddingEnd::Node(numbers[*to]);
                self.graph.embeddings.push(Embedding { from: numbers[*from], to, count: 1, is_lender: true });
            }
        }
        let mut added: HashMap<(usize, EmbeddingEnd), usize> = HashMap::new();
        for (from, to) in part.embeddings.iter().filter(|(from, _)| is_asked(from)) {
            let from = numbers[*from];
            if self.complete.contains(&from) {
                continue;
            }
            let to = match to {
                EmbeddingEnd::Node(to) => EmbeddingEnd::Node(numbers[*to]),
                nowhere @ EmbeddingEnd::Nowhere(..) => nowhere.clone(),
            };
            let embeddings = &mut self.graph.embeddings;
            let index = *added.entry((from, to.clone())).or_insert(embeddings.len());
            match embeddings.get_mut(index) {
                Some(known) => known.count += 1,
                None => embeddings.push(Embedding { from, to, count: 1, is_lender: false }),
            }
        }
        self.complete.extend((0..part.reached).filter(is_asked).map(|node| numbers[node]));
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
