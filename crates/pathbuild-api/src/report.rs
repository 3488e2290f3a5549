//! Results of requests about many paths.

use std::collections::{BTreeMap, BTreeSet};

use camino::Utf8PathBuf;
use pathbuild_diagnostic::messages::drawing::WIDTH_IGNORED;
use pathbuild_diagnostic::{Code, Diagnostic, EntityKind, Lang};
use pathbuild_path::PathName;
use pathbuild_workspace::Workspace;
use pathbuild_workspace::check::CheckedFile;
use pathbuild_workspace::emit::{Emission, ProgramOutcome, State};
use pathbuild_workspace::list::{self, ListedPath};
use pathbuild_workspace::session::{EmbeddingEnd, Graph, GraphOutcome, Node};

use crate::baseline::SettledFindings;
use crate::{Finding, WrittenBaseline};

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
    /// The drawings that were checked, sorted by name.
    pub files: Vec<CheckedDrawing>,
    /// The baseline that was written instead of reporting the findings; `None` if that was not requested.
    pub baseline: Option<WrittenBaseline>,
    /// Time spent in each phase, for pathbuild's command line.
    #[doc(hidden)]
    pub timings: Vec<String>,
}

/// A drawing that was checked.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct CheckedDrawing {
    /// File of the drawing.
    pub file: String,
    /// Names of the checked paths, in file order, as their layers spell them.
    pub paths: Vec<String>,
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
    /// Findings that `severity-in` accepts for a stated reason. (book: howto/ci)
    pub accepted: Vec<Finding>,
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
    /// There is a program that cannot be compared: the path has errors, or an option that it needs is not set.
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
    /// Findings that `severity-in` accepts for a stated reason. (book: howto/ci)
    pub accepted: Vec<Finding>,
    /// Notes of the post-processor, in the language of the library.
    pub notes: Vec<String>,
    /// Elements that lie on the layer of a path, but are not part of its program.
    pub left_out: Vec<LeftOutElements>,
    /// Names of the files that were removed because they were stale.
    pub removed: Vec<String>,
    /// Names of stale programs, which a comparison reports as errors (PB520): programs of earlier drawings, or adjusted ones that no longer match the
    /// program of their path.
    pub outdated: Vec<String>,
    /// Commands that the post-processor requests for files that were written. See [`EmitOptions::post_builds`](crate::EmitOptions::post_builds).
    pub post_builds: Vec<PostBuild>,
}

/// Elements of a path that are not part of its program.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct LeftOutElements {
    /// Name of the path, or of the drawing's file if the elements belong to no path.
    pub path: String,
    /// Type of the elements, for example `SPLINE`.
    pub entity: String,
    /// Number of elements.
    pub count: usize,
}

/// A command that a post-processor requests for its output.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct PostBuild {
    /// The program to run, followed by its arguments.
    pub command: Vec<String>,
    /// Name of the file that the post-processor wrote.
    pub file: String,
}

/// A file that `emit` writes.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct OutputFile {
    /// Name of the file, relative to the library's directory if it lies below it.
    pub file: String,
    /// Name of the path whose program the file contains.
    pub path: String,
    /// Whether the file is the program itself. Otherwise, the file accompanies the program, as a setup sheet does.
    pub is_program: bool,
    /// Outcome of writing or comparing the file.
    pub state: FileState,
    /// Content of the file if it was requested instead of writing the file, in the encoding and with the line ends that `emit` writes.
    pub text: Option<Vec<u8>>,
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
    /// The file was written over a program that had been edited, whose changes are lost.
    Overwritten,
    /// The file was already current, and was not touched.
    Unchanged,
    /// The file was compared and is current.
    Current,
    /// The file was compared and is not current.
    Outdated,
    /// There is no file on disk to compare with.
    Missing,
    /// The content of the file was requested instead of writing it.
    Printed,
}

impl CheckReport {
    pub(crate) fn new(settled: SettledFindings, files: Vec<CheckedFile>, timings: Vec<String>) -> Self {
        let SettledFindings { findings, accepted, baseline } = settled;
        let names = |paths: &[PathName]| paths.iter().map(|path| path.as_str().to_owned()).collect();
        let drawing = |CheckedFile { file, paths }: CheckedFile| CheckedDrawing {
            file: file.into_string(),
            paths: names(&paths),
        };
        Self {
            findings,
            accepted,
            paths: files.iter().map(|file| file.paths.len()).sum(),
            drawings: files.len(),
            files: files.into_iter().map(drawing).collect(),
            baseline,
            timings,
        }
    }
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

impl EmitReport {
    pub(crate) fn new(workspace: &Workspace, emission: Emission) -> Self {
        let Emission { delivered, removed, outdated, diagnostics } = emission;
        let names = |files: Vec<Utf8PathBuf>| files.into_iter().map(Utf8PathBuf::into_string).collect();
        let left_out = LeftOutElements::of(&diagnostics);
        let (findings, accepted) = Finding::reported_and_accepted(workspace.findings(diagnostics));
        let post_builds = delivered.iter().filter_map(PostBuild::requested).collect();
        let (files, notes) = OutputFile::of_programs(delivered, workspace.lang());
        let (removed, outdated) = (names(removed), names(outdated));
        Self { files, findings, accepted, notes, left_out, removed, outdated, post_builds }
    }
}

impl LeftOutElements {
    /// Counts the elements of each path that are not part of its program, by type.
    fn of(diagnostics: &[Diagnostic]) -> Vec<Self> {
        let is_left_out =
            |found: &&Diagnostic| found.code() == Code::UnsupportedCurve && *found.message != WIDTH_IGNORED;
        let curves = diagnostics.iter().filter(is_left_out);
        let curves: BTreeSet<_> = curves.map(|found| (&found.path, &found.file, &found.place)).collect();
        let mut counts: BTreeMap<(&str, &str), usize> = BTreeMap::new();
        for (path, file, place) in curves {
            let name = path.as_deref().or_else(|| file.as_ref().and_then(|file| file.file_name()));
            let kind = place.entity.map_or("", EntityKind::name);
            *counts.entry((name.unwrap_or_default(), kind)).or_default() += 1;
        }
        let elements = |((path, entity), count): ((&str, &str), usize)| Self {
            path: path.to_owned(),
            entity: entity.to_owned(),
            count,
        };
        counts.into_iter().map(elements).collect()
    }
}

impl PostBuild {
    fn requested(outcome: &ProgramOutcome) -> Option<Self> {
        let (command, file) = outcome.post_build.as_ref().filter(|(_, file)| outcome.has_written(file))?;
        Some(Self { command: command.clone(), file: file.to_string() })
    }
}

impl OutputFile {
    /// Converts the outcomes of programs. Also returns the notes of their post-processors, each note once. Public for `watch` of pathbuild's command
    /// line.
    #[doc(hidden)]
    pub fn of_programs(outcomes: Vec<ProgramOutcome>, lang: Lang) -> (Vec<Self>, Vec<String>) {
        let (mut all, mut notes) = (Vec::new(), Vec::new());
        for ProgramOutcome { path, files, length, minutes, notes: added, .. } in outcomes {
            for (index, (file, state)) in files.into_iter().enumerate() {
                let (state, text) = FileState::of(state);
                let (file, path, is_program) = (file.into_string(), path.to_string(), index == 0);
                all.push(Self { file, path, is_program, state, text, length, minutes });
            }
            for note in added.iter().map(|note| note.text(lang)) {
                if !notes.contains(&note) {
                    notes.push(note);
                }
            }
        }
        (all, notes)
    }
}

impl FileState {
    /// Converts a state. Also returns the content of a printed file.
    fn of(state: State) -> (Self, Option<Vec<u8>>) {
        match state {
            State::Written => (Self::Written, None),
            State::Overwritten => (Self::Overwritten, None),
            State::Unchanged => (Self::Unchanged, None),
            State::Current => (Self::Current, None),
            State::Outdated => (Self::Outdated, None),
            State::Missing => (Self::Missing, None),
            State::Printed(text) => (Self::Printed, Some(text)),
        }
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

/// A path and another path that it embeds directly, or from which it takes parameters by @.
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
    /// Whether the other path is not embedded, but lends its parameters.
    pub is_lender: bool,
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
            Some(Self { file, path, embedded_file, embedded_path, is_lender: embedding.is_lender })
        };
        graph.embeddings.iter().filter_map(edge).collect()
    }
}
