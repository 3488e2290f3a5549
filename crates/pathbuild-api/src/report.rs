//! Results of requests about many paths.

use pathbuild_workspace::Workspace;
use pathbuild_workspace::emit::{ProgramOutcome, State};
use pathbuild_workspace::list::{self, ListedPath};
use pathbuild_workspace::session::{EmbeddingEnd, Graph, GraphOutcome, Node};

use crate::Finding;

/// The result of [`Library::check`](crate::Library::check).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct CheckReport {
    /// Errors and warnings, in the order in which `pathbuild check` prints them.
    pub findings: Vec<Finding>,
    /// Findings that the baseline or `severity-in` accepts for a stated reason. (book: howto/ci)
    pub accepted: Vec<Finding>,
    /// Number of paths that were checked.
    pub paths: usize,
    /// Number of drawings that were checked.
    pub drawings: usize,
}

/// Paths with their figures.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct PathListing {
    /// The paths, ordered by drawing and then as in the file.
    pub paths: Vec<PathSummary>,
    /// Number of drawings that were searched.
    pub drawings: usize,
    /// Findings about directories, inputs, and drawings as a whole. Findings about paths are in [`PathSummary::findings`];
    /// [`Library::check`](crate::Library::check) gives all findings, without duplicates.
    pub findings: Vec<Finding>,
}

/// The figures of a path. Lengths are in mm.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct PathSummary {
    /// Name of the path, as the layer spells it.
    pub name: String,
    /// File of the drawing that contains the path.
    pub file: String,
    /// Material (M), as the drawing writes it; `None` if it states none.
    pub material: Option<String>,
    /// Upper face of the material (T), in mm.
    pub thickness: Option<f64>,
    /// Cutter diameter (O), in mm.
    pub tool: Option<f64>,
    /// Lowest and highest x, y, z of the tool tip while it cuts, in mm; `None` if nothing is cut.
    pub cutting_box: [Option<(f64, f64)>; 3],
    /// Length of all moves in mm; `None` if there is no program.
    pub length: Option<f64>,
    /// Estimated working time in minutes; `None` if there is no program, or if the rapid feed is not set.
    pub minutes: Option<f64>,
    /// State of the path's program on disk.
    pub program: ProgramState,
    /// Findings about the path and the paths that it embeds: a fault of an embedded path is listed for each path that embeds it.
    pub findings: Vec<Finding>,
}

/// The state of a path's program on disk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ProgramState {
    /// There is no program.
    None,
    /// The program is what `emit` would write.
    Current,
    /// The program differs from what `emit` would write.
    Stale,
    /// There is a program, but the path has errors, so the program cannot be compared.
    Unknown,
}

/// The program of a path, as `emit` would write it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ProgramText {
    /// Name of the file that `emit` would write.
    pub file: String,
    /// Content of the file in bytes, in the encoding and with the line ends that `emit` writes.
    pub text: Vec<u8>,
    /// Warnings about the path.
    pub findings: Vec<Finding>,
}

/// The result of writing or comparing programs.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct EmitReport {
    /// The files, in the order of the paths. A path with errors has none.
    pub files: Vec<OutputFile>,
    /// Errors and warnings, in the order in which `pathbuild emit` prints them.
    pub findings: Vec<Finding>,
}

/// A file that `emit` writes.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct OutputFile {
    /// Name of the file, relative to the library's directory if it lies below it.
    pub file: String,
    /// Name of the path whose program the file contains.
    pub path: String,
    /// Outcome of writing or comparing the file.
    pub state: FileState,
    /// Length of the program in mm.
    pub length: f64,
    /// Estimated working time in minutes.
    pub minutes: f64,
}

/// The outcome of writing or comparing a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FileState {
    /// The file was written.
    Written,
    /// The file was already current, and was not touched.
    Unchanged,
    /// The file was compared and is current.
    Current,
    /// The file was compared and is not current.
    Outdated,
    /// The file should be compared, but does not exist.
    Missing,
}

impl PathSummary {
    pub(crate) fn new(workspace: &Workspace, path: ListedPath) -> Self {
        Self {
            name: path.name.as_str().to_owned(),
            file: path.drawing.into_string(),
            material: path.figures.material.map(Into::into),
            thickness: path.figures.thickness,
            tool: path.figures.tool,
            cutting_box: path.figures.cutting_box,
            length: path.figures.length,
            minutes: path.figures.minutes,
            program: match path.program {
                list::ProgramState::None => ProgramState::None,
                list::ProgramState::Current => ProgramState::Current,
                list::ProgramState::Stale => ProgramState::Stale,
                list::ProgramState::Unknown => ProgramState::Unknown,
            },
            findings: Finding::from_diagnostics(workspace, path.diagnostics),
        }
    }
}

impl OutputFile {
    pub(crate) fn from_outcome(outcome: ProgramOutcome) -> Vec<Self> {
        let ProgramOutcome { path, files, length, minutes, .. } = outcome;
        let file = |(file, state): (camino::Utf8PathBuf, State)| {
            let state = match state {
                State::Written => FileState::Written,
                State::Unchanged => FileState::Unchanged,
                State::Current => FileState::Current,
                State::Outdated => FileState::Outdated,
                State::Missing => FileState::Missing,
                // A printed program has no file.
                State::Printed(_) => return None,
            };
            Some(Self { file: file.into_string(), path: path.to_string(), state, length, minutes })
        };
        files.into_iter().filter_map(file).collect()
    }
}

/// The embeddings of paths in other paths.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct GraphReport {
    /// Pairs of an embedding path and a path that it embeds, each pair once, sorted by drawing and name of the embedding path.
    pub edges: Vec<GraphEdge>,
    /// Number of paths with errors, which may embed more paths than are listed. [`Library::check`](crate::Library::check) finds these errors.
    pub incomplete: usize,
    /// Errors of directories, of the named drawings, and of the inputs.
    pub findings: Vec<Finding>,
}

/// A path and another path that it embeds directly.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub struct GraphEdge {
    /// File of the drawing that contains the embedding path.
    pub file: String,
    /// Name of the embedding path, as its layer spells it.
    pub path: String,
    /// File of the drawing that contains the embedded path.
    pub embedded_file: String,
    /// Name of the embedded path, as its layer spells it.
    pub embedded_path: String,
}

impl GraphReport {
    pub(crate) fn new(workspace: &Workspace, outcome: GraphOutcome) -> Self {
        let GraphOutcome { graph, diagnostics, incomplete } = outcome;
        let mut edges = GraphEdge::from_graph(&graph);
        edges.sort();
        edges.dedup();
        Self { edges, incomplete, findings: Finding::from_diagnostics(workspace, diagnostics) }
    }
}

impl GraphEdge {
    fn from_graph(graph: &Graph) -> Vec<Self> {
        let names = |node: &Node| (node.file.to_string(), node.name.as_str().to_owned());
        let edge = |embedding: &pathbuild_workspace::session::Embedding| {
            // Segments that embed no existing path are omitted: `check` reports them.
            let EmbeddingEnd::Node(to) = embedding.to else { return None };
            let (file, path) = names(&graph.nodes[embedding.from]);
            let (embedded_file, embedded_path) = names(&graph.nodes[to]);
            Some(Self { file, path, embedded_file, embedded_path })
        };
        graph.embeddings.iter().filter_map(edge).collect()
    }
}
