//! Which path embeds which.

use pathbuild_workspace::Workspace;
use pathbuild_workspace::session::{End, Graph, GraphOutcome, Node};

use crate::Finding;

/// Which path embeds which.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct GraphReport {
    /// Each pair of paths once, sorted by the drawing and the path that embeds the other one.
    pub edges: Vec<GraphEdge>,
    /// Number of paths with errors, which may embed more than is listed. [`Library::check`](crate::Library::check) finds these errors.
    pub incomplete: usize,
    /// Errors of directories, of the named drawings, and of the inputs.
    pub findings: Vec<Finding>,
}

/// A path that embeds another one directly.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub struct GraphEdge {
    /// The drawing of the path that embeds the other one.
    pub file: String,
    /// The name of that path, as its layer spells it.
    pub path: String,
    /// The drawing of the embedded path.
    pub embedded_file: String,
    /// The name of the embedded path.
    pub embedded_path: String,
}

impl GraphReport {
    pub(crate) fn new(workspace: &Workspace, outcome: GraphOutcome) -> Self {
        let GraphOutcome { graph, diagnostics, incomplete } = outcome;
        let mut edges = GraphEdge::all(&graph);
        edges.sort();
        edges.dedup();
        Self { edges, incomplete, findings: Finding::all(workspace, diagnostics) }
    }
}

impl GraphEdge {
    fn all(graph: &Graph) -> Vec<Self> {
        let names = |node: &Node| (node.file.to_string(), node.name.as_str().to_owned());
        let edge = |embedding: &pathbuild_workspace::session::Embedding| {
            // A segment that embeds no path is a finding of `check`.
            let End::Node(to) = embedding.to else { return None };
            let (file, path) = names(&graph.nodes[embedding.from]);
            let (embedded_file, embedded_path) = names(&graph.nodes[to]);
            Some(Self { file, path, embedded_file, embedded_path })
        };
        graph.embeddings.iter().filter_map(edge).collect()
    }
}
