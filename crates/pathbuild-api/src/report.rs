//! Results of requests about many paths.

use pathbuild_workspace::Workspace;
use pathbuild_workspace::emit::{ProgramOutcome, State};
use pathbuild_workspace::list::{self, ListedPath};
use pathbuild_workspace::session::{End, Graph, GraphOutcome, Node};

use crate::Finding;

/// The outcome of a check.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct CheckReport {
    /// Errors and warnings, in the order of the program.
    pub findings: Vec<Finding>,
    /// Findings that the baseline or `severity-in` accepts for a stated reason. (book: howto/ci)
    pub accepted: Vec<Finding>,
    /// Number of paths.
    pub paths: usize,
    /// Number of drawings.
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
    /// Findings about directories, inputs, and drawings as a whole. Those about paths are in [`PathSummary::findings`];
    /// [`Library::check`](crate::Library::check) gives all findings, without duplicates.
    pub findings: Vec<Finding>,
}

/// The figures of a path. Lengths are in mm.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct PathSummary {
    /// Its name, as the layer spells it.
    pub name: String,
    /// Its drawing.
    pub file: String,
    /// Material (M).
    pub material: Option<String>,
    /// Upper face of the material (T).
    pub thickness: Option<f64>,
    /// Cutter diameter (O).
    pub tool: Option<f64>,
    /// Lowest and highest x, y, z of the tool tip while it cuts.
    pub cutting_box: [Option<(f64, f64)>; 3],
    /// Length of all moves; `None` if there is no program.
    pub length: Option<f64>,
    /// Estimated working time in minutes; `None` if there is no program, or if the rapid feed is not set.
    pub minutes: Option<f64>,
    /// The program on disk.
    pub program: ProgramState,
    /// Findings about the path and the paths that it embeds: a fault of an embedded path is listed for each path that embeds it.
    pub findings: Vec<Finding>,
}

/// The state of a path's program on disk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ProgramState {
    /// There is none.
    None,
    /// It is what `emit` would write.
    Current,
    /// It differs from that.
    Stale,
    /// There is one, but the path has errors, so there is nothing to compare it with.
    Unknown,
}

/// The text of a program.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ProgramText {
    /// The file that `emit` writes.
    pub file: String,
    /// Its bytes, in the encoding and with the line ends that `emit` writes.
    pub text: Vec<u8>,
    /// Warnings about the path.
    pub findings: Vec<Finding>,
}

/// The outcome of writing or comparing programs.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct EmitReport {
    /// The files, in the order of the paths. A path with errors has none.
    pub files: Vec<OutputFile>,
    /// Errors and warnings, in the order of the program.
    pub findings: Vec<Finding>,
}

/// A file that `emit` writes.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct OutputFile {
    /// Its name.
    pub file: String,
    /// The path.
    pub path: String,
    /// The outcome.
    pub state: FileState,
    /// Length of the program in mm.
    pub length: f64,
    /// Estimated working time in minutes.
    pub minutes: f64,
}

/// The outcome for a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FileState {
    /// It was written.
    Written,
    /// It was current already, and was not touched.
    Unchanged,
    /// Compared: it is current.
    Current,
    /// Compared: it is not.
    Outdated,
    /// Compared: it does not exist.
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
            findings: Finding::all(workspace, path.diagnostics),
        }
    }
}

impl OutputFile {
    pub(crate) fn of(outcome: ProgramOutcome) -> Vec<Self> {
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

// Which path embeds which.

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
