//! `list` and `stats`: the paths of a library with the figures that a workshop needs.

use std::collections::BTreeMap;

use camino::Utf8PathBuf;
use pathbuild_db::{Database, Role, SourceFile, Target, closure, may_define, path_names, program, summary};
use pathbuild_diagnostic::messages::outputs as messages;
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_gcode::statistics::{AxisRanges, cutting_box, statistics};
use pathbuild_path::{PathName, PathSignature};
use serde_json::{Value as Json, json};

use crate::config::types::Pattern;
use crate::findings::Findings;
use crate::inputs::Input;
use crate::post_processor::{PostArguments, PostProcessor};
use crate::session::{CheckedTarget, Session};
use crate::workspace::{Failure, Workspace};
use crate::{Inputs, emit};

/// A request to list paths.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    /// Drawings, directories, and patterns for path names; without drawings or directories, all known paths.
    pub inputs: &'a Inputs,
    /// Name or file of the post-processor that replaces the configured one; `None` for the configured one.
    pub post: Option<&'a str>,
}

/// The listed paths, with the number of searched drawings and their diagnostics.
#[derive(Clone, Debug, Default)]
pub struct PathListing {
    /// The paths, drawing by drawing, in file order.
    pub paths: Vec<ListedPath>,
    /// Number of drawings that were searched.
    pub drawings: usize,
    /// Diagnostics of directories and drawings, of patterns that match no path, and of programs that could not be generated.
    pub diagnostics: Vec<Diagnostic>,
}

/// A listed path. Lengths are in mm.
#[derive(Clone, Debug)]
pub struct ListedPath {
    /// Name of the path, as the layer spells it.
    pub name: PathName,
    /// Path of the drawing's file.
    pub drawing: Utf8PathBuf,
    /// Diagnostics of the path and of what it embeds.
    pub diagnostics: Vec<Diagnostic>,
    /// Figures from the path's parameters and its program.
    pub figures: Figures,
    /// State of the program on disk.
    pub program: ProgramState,
}

impl ListedPath {
    /// Creates the entry of a path that could not be processed, with the error that prevented it.
    pub fn unknown(name: PathName, drawing: Utf8PathBuf, problem: Diagnostic) -> Self {
        Self {
            diagnostics: vec![problem.in_file(&drawing).in_path(name.as_str())],
            name,
            drawing,
            figures: Figures::default(),
            program: ProgramState::None,
        }
    }
}

/// State of a path's program on disk.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum ProgramState {
    /// There is no program on disk, or none can be generated for the path, for example because it has errors.
    #[default]
    None,
    /// The program is up to date.
    Current,
    /// The program differs from what `emit` would write.
    Stale,
    /// The program exists but cannot be compared, because an error that `check` does not report, or an option that is not set, keeps it from being
    /// generated.
    Unknown,
}

impl Request<'_> {
    /// Lists the paths.
    ///
    /// # Errors
    /// If a pattern or the post-processor is invalid, with the reason.
    pub fn run(&self, session: &mut Session<'_>) -> Result<PathListing, Failure> {
        let post_processor = PostProcessor::for_run(session.workspace(), self.post, PostArguments::default())
            .map_err(Failure::Post)?;
        let arguments = ListArguments::new(session, self.inputs).map_err(Failure::Usage)?;
        Ok(session.with_stable_files(|session| arguments.list(session, post_processor.as_ref())))
    }
}

impl ListArguments {
    fn list(&self, session: &mut Session<'_>, post_processor: Option<&PostProcessor>) -> PathListing {
        let mut listed = PathListing::default();
        let files = self.files(session, &mut listed.diagnostics);
        session.parse_ahead(&files);
        let mut paths: Vec<(SourceFile, PathName)> = Vec::new();
        for file in &files {
            listed.diagnostics.extend(session.errors_without_paths(*file).cloned());
            let names = path_names(session.db(), *file).iter().filter(|name| self.matches(name));
            paths.extend(names.map(|name| (*file, name.clone())));
        }
        listed.drawings = files.len();
        let build_errors;
        (listed.paths, build_errors) = list_paths(session, &paths, post_processor);
        listed.diagnostics.extend(build_errors);
        let unmatched = self
            .unmatched_patterns(&listed.paths)
            .filter(|text| !files.iter().any(|file| may_hide_path(session, *file, text)))
            .map(|text| Diagnostic::new(&messages::NO_PATH_LIKE).quoting("name", text));
        listed.diagnostics.extend(unmatched);
        listed.diagnostics = session.with_hints(std::mem::take(&mut listed.diagnostics));
        listed
    }
}

/// Whether a drawing may define a path according to its file name, but has errors and no known path.
fn may_hide_path(session: &Session<'_>, file: SourceFile, name: &str) -> bool {
    may_define(session.db(), file.path(session.db()), &PathName::new(name))
        && session.errors_without_paths(file).next().is_some()
}

/// Lists a single path of a drawing.
pub fn of_path(
    session: &mut Session<'_>,
    file: SourceFile,
    name: &PathName,
    post_processor: Option<&PostProcessor>,
) -> Vec<ListedPath> {
    let path = [(file, name.clone())];
    session.with_stable_files(|session| list_paths(session, &path, post_processor).0)
}

/// Lists all paths of some drawings.
pub fn of_drawings(
    session: &mut Session<'_>,
    files: &[SourceFile],
    post_processor: Option<&PostProcessor>,
) -> Vec<ListedPath> {
    session.with_stable_files(|session| {
        let names = files.iter().map(|file| (*file, path_names(session.db(), *file)));
        let paths = names.flat_map(|(file, names)| names.iter().map(move |name| (file, name.clone())));
        let paths: Vec<(SourceFile, PathName)> = paths.collect();
        list_paths(session, &paths, post_processor).0
    })
}

fn list_paths(
    session: &mut Session<'_>,
    paths: &[(SourceFile, PathName)],
    post_processor: Option<&PostProcessor>,
) -> (Vec<ListedPath>, Vec<Diagnostic>) {
    let size = session.programs_per_batch(paths.len());
    let mut listed = session.in_batches(paths, size, list_without_programs);
    let build_errors = compare_programs_on_disk(session, post_processor, paths, &mut listed);
    (listed, build_errors)
}

/// Compares the programs on disk with the paths. Returns the errors that kept programs from being generated but that `check` does not report.
fn compare_programs_on_disk(
    session: &mut Session<'_>,
    post_processor: Option<&PostProcessor>,
    paths: &[(SourceFile, PathName)],
    listed: &mut [ListedPath],
) -> Vec<Diagnostic> {
    let sound = paths.iter().zip(&*listed).filter(|(_, listed)| listed.figures.length.is_some());
    let targets = sound.map(|((file, name), _)| session.db().target(*file, name.as_str(), Role::Emitted));
    let targets: Vec<Target> = targets.collect();
    let states = emit::freshness_on_disk(session, post_processor, &targets);
    let mut problems = Vec::new();
    for ((file, name), listed) in paths.iter().zip(listed) {
        let target = session.db().target(*file, name.as_str(), Role::Emitted);
        listed.program = match states.get(&target) {
            None => ProgramState::None,
            Some(Ok(true)) => ProgramState::Current,
            Some(Ok(false)) => ProgramState::Stale,
            Some(Err(found)) => {
                listed.diagnostics.extend_from_slice(found);
                problems.extend_from_slice(found);
                ProgramState::Unknown
            }
        };
    }
    problems
}

fn invalid_pattern_error(session: &Session<'_>, name: &str, reason: &Value) -> String {
    let what =
        session.workspace().phrase("`{}` is not a pattern of names", "`{}` ist kein Muster für Namen", name);
    format!("{what}: {}", reason.render(session.workspace().lang()))
}

/// The arguments, divided into places (drawings and directories) and patterns for path names.
struct ListArguments {
    places: Inputs,
    patterns: Vec<Pattern>,
}

impl ListArguments {
    fn new(session: &Session<'_>, inputs: &Inputs) -> Result<Self, String> {
        let (mut places, mut patterns) = (Inputs::default(), Vec::new());
        for (input, text) in inputs.iter().zip(&inputs.inputs) {
            match input {
                Input::Name(name) if !session.is_directory(name.into()) => {
                    let wrong = |reason: Value| invalid_pattern_error(session, name, &reason);
                    patterns.push(Pattern::new(name).map_err(wrong)?);
                }
                Input::Name(name) => places.inputs.push(format!("./{name}")),
                Input::Place(_) => places.inputs.push(text.clone()),
            }
        }
        Ok(Self { places, patterns })
    }

    /// Returns the given drawings and those in the given directories; without any, those of the library, or those below the working directory if
    /// there is no library.
    fn files(&self, session: &Session<'_>, problems: &mut Vec<Diagnostic>) -> Vec<SourceFile> {
        let below = Inputs { inputs: vec![".".into()] };
        let is_below = self.places.inputs.is_empty() && !session.has_library();
        let selection = session.select(if is_below { &below } else { &self.places });
        problems.extend_from_slice(&selection.problems);
        selection.whole_drawings(session)
    }

    fn unmatched_patterns<'a>(&'a self, paths: &'a [ListedPath]) -> impl Iterator<Item = &'a str> {
        let is_unmet = |pattern: &&Pattern| !paths.iter().any(|path| pattern.matches(path.name.as_str()));
        self.patterns.iter().filter(is_unmet).map(Pattern::text)
    }

    fn matches(&self, name: &PathName) -> bool {
        self.patterns.is_empty() || self.patterns.iter().any(|pattern| pattern.matches(name.as_str()))
    }
}

/// Lists paths without the state of their programs on disk.
fn list_without_programs(session: &Session<'_>, paths: &[(SourceFile, PathName)]) -> Vec<ListedPath> {
    let checked =
        session.map_with_checker(paths, |checker, (file, name)| checker.check_leniently(*file, name));
    let rapid = session.workspace().settings.general.rapid.value;
    let figures = session.map_guarded(&checked, |db, checked| Figures::of(db, checked, rapid));
    let listed = |((checked, figures), (file, name)): (CheckedFigures, &(SourceFile, PathName))| {
        let db = session.db();
        let mut diagnostics = session.path_diagnostics(&checked);
        let figures = figures.unwrap_or_else(|problem| {
            diagnostics.push(problem.in_file(file.path(db)).in_path(name.as_str()));
            Figures::default()
        });
        ListedPath {
            name: name.clone(),
            drawing: file.path(db).clone(),
            diagnostics,
            figures,
            program: ProgramState::None,
        }
    };
    checked.into_iter().zip(figures).zip(paths).map(listed).collect()
}

/// A checked path with its figures, or the error that kept them from being computed.
type CheckedFigures = (CheckedTarget, Result<Figures, Box<Diagnostic>>);

/// Figures from a path's parameters and from its program.
#[derive(Clone, Debug, Default)]
pub struct Figures {
    /// Value of M, the name of the material.
    pub material: Option<Box<str>>,
    /// Values of T and O in mm; `None` if missing or invalid.
    pub thickness: Option<f64>,
    #[expect(missing_docs, reason = "see above")]
    pub tool: Option<f64>,
    /// Bounding box of the tool tip while cutting, in mm.
    pub cutting_box: AxisRanges,
    /// Length of the program in mm; `None` if there is no program.
    pub length: Option<f64>,
    /// Machining time in minutes; `None` if there is no program, or if `rapid` is not set.
    pub minutes: Option<f64>,
}

impl Figures {
    fn of(db: &Database, checked: &CheckedTarget, rapid: Option<f64>) -> Self {
        let root = closure(db, checked.target).root;
        let signature = root.and_then(|root| summary(db, root).signature.as_ref());
        let figures = Self {
            material: signature.and_then(|path| path.material.as_deref()).map(Into::into),
            thickness: signature.map(|path: &PathSignature| path.thickness),
            tool: signature.map(|path| path.tool),
            ..Self::default()
        };
        let Some(program) = program(db, checked.target) else { return figures };
        let sum = statistics(program, rapid.unwrap_or_default()).sum();
        Self {
            cutting_box: cutting_box(program),
            length: Some(sum.length),
            minutes: rapid.map(|_| sum.minutes()).filter(|minutes| minutes.is_finite()),
            ..figures
        }
    }
}

/// A path with the numbers of its errors and warnings, counted with the configured severities.
#[derive(Clone, Debug)]
pub struct Row {
    /// The path with its figures.
    pub path: ListedPath,
    /// Number of errors of the path and of the paths that it embeds.
    pub errors: usize,
    /// Number of warnings of the path and of the paths that it embeds.
    pub warnings: usize,
}

/// State of a path and of its program on disk, combined into one value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum State {
    /// The path has errors.
    Errors,
    /// The program on disk is out of date.
    Stale,
    /// The program on disk cannot be compared, because an option is not set, or because the configuration lowers the severity of errors.
    Unknown,
    /// The program on disk is up to date.
    Current,
    /// The path has no errors, and there is no program on disk.
    Ok,
}

impl State {
    pub(super) const ALL: [Self; 5] = [Self::Errors, Self::Stale, Self::Unknown, Self::Current, Self::Ok];

    /// Returns the name of the state in JSON.
    pub(super) fn key(self) -> &'static str {
        match self {
            Self::Errors => "errors",
            Self::Stale => "stale",
            Self::Unknown => "unknown",
            Self::Current => "current",
            Self::Ok => "ok",
        }
    }
}

impl Row {
    /// Counts the findings of a path under a workspace's configuration.
    pub fn new(workspace: &Workspace, path: ListedPath) -> Self {
        let found = workspace.findings(path.diagnostics.clone());
        let errors = found.diagnostics.iter().filter(|found: &&Diagnostic| found.is_error()).count();
        Self { path, errors, warnings: found.diagnostics.len() - errors }
    }

    /// Returns the combined state of the path and its program.
    pub fn state(&self) -> State {
        match self.path.program {
            _ if self.errors > 0 => State::Errors,
            ProgramState::Stale => State::Stale,
            ProgramState::Current => State::Current,
            ProgramState::Unknown => State::Unknown,
            ProgramState::None => State::Ok,
        }
    }

    /// Returns the width and height of the area that the tool tip reaches while cutting, in mm; `None` if the path cuts nothing.
    pub fn size(&self) -> Option<[f64; 2]> {
        let [x, y, _] = self.path.figures.cutting_box;
        let width = |(low, high): (f64, f64)| high - low;
        Some([width(x?), width(y?)])
    }
}

/// Totals of a library or of some paths.
#[derive(Clone, Debug)]
pub struct Stats {
    /// Number of drawings.
    pub drawings: usize,
    /// Totals of all paths.
    pub all: Total,
    /// Number of paths with warnings.
    pub warnings: usize,
    /// Number of paths in each state.
    pub states: BTreeMap<State, usize>,
    /// Totals by the value of M (material); `None` for paths without M.
    pub materials: BTreeMap<Option<Box<str>>, Total>,
    /// Totals by the value of O (cutter diameter) in micrometres, an integer so that it can be a key.
    pub cutters: BTreeMap<Option<u64>, Total>,
}

/// Totals of some paths. Paths with errors are counted, but add no length.
#[derive(Clone, Copy, Debug, Default)]
pub struct Total {
    /// Number of paths.
    pub paths: usize,
    /// Total length of the paths' programs in mm.
    pub length: f64,
    /// Machining time in minutes, of the paths for which it is known.
    known_minutes: f64,
    /// Number of paths with a program of unknown time.
    untimed: usize,
}

impl Total {
    fn add(&mut self, row: &Row) {
        self.paths += 1;
        self.length += row.path.figures.length.unwrap_or_default();
        self.known_minutes += row.path.figures.minutes.unwrap_or_default();
        self.untimed += usize::from(row.path.figures.length.is_some() && row.path.figures.minutes.is_none());
    }

    /// Returns the machining time in minutes; `None` if the time of a program is unknown.
    pub fn minutes(&self) -> Option<f64> {
        (self.untimed == 0).then_some(self.known_minutes)
    }
}

/// Returns a diameter in whole micrometres; 0 for a negative one.
fn micrometres(tool: f64) -> u64 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a diameter within a drawing's limits"
    )]
    let rounded = (tool * 1000.0).round().max(0.0) as u64;
    rounded
}

impl Stats {
    /// Computes the totals of these paths, which were found in `drawings` drawings.
    pub fn of<'a>(rows: impl IntoIterator<Item = &'a Row>, drawings: usize) -> Self {
        let mut stats = Self {
            drawings,
            all: Total::default(),
            warnings: 0,
            states: State::ALL.iter().map(|state| (*state, 0)).collect(),
            materials: BTreeMap::new(),
            cutters: BTreeMap::new(),
        };
        for row in rows {
            stats.all.add(row);
            stats.warnings += usize::from(row.warnings > 0);
            *stats.states.entry(row.state()).or_default() += 1;
            stats.materials.entry(row.path.figures.material.clone()).or_default().add(row);
            stats.cutters.entry(row.path.figures.tool.map(micrometres)).or_default().add(row);
        }
        stats
    }
}

/// Returns a path as a JSON object. `file` is the displayed name of the path's drawing.
pub fn path_json(file: &str, row: &Row) -> Json {
    let path = &row.path;
    let axis = |ends: Option<(f64, f64)>| ends.map(|(low, high)| [low, high]);
    let [x, y, z] = path.figures.cutting_box.map(axis);
    json!({
        "path": path.name.as_str(),
        "file": file,
        "material": path.figures.material,
        "thickness": path.figures.thickness,
        "tool": path.figures.tool,
        "size": row.size(),
        "cutting_box": { "x": x, "y": y, "z": z },
        "length": path.figures.length,
        "minutes": path.figures.minutes,
        "state": row.state().key(),
        "errors": row.errors,
        "warnings": row.warnings,
        "program": match path.program {
            ProgramState::None | ProgramState::Unknown => None,
            ProgramState::Current => Some("current"),
            ProgramState::Stale => Some("stale"),
        },
    })
}

/// Returns a drawing with errors of its own as a JSON object, to be listed beside the objects of its paths; `None` if it has only warnings.
pub fn drawing_json(found: &Findings) -> Option<Json> {
    let (errors, warnings) = (found.error_count(), found.warning_count());
    (errors > 0).then(|| json!({ "path": null, "state": "errors", "errors": errors, "warnings": warnings }))
}

/// Returns totals as a JSON object.
pub fn stats_json(stats: &Stats) -> Json {
    let states =
        stats.states.iter().map(|(state, count): (&State, _)| (state.key().to_owned(), json!(count)));
    let materials = stats.materials.iter().map(|(name, total)| total_json(total, "material", json!(name)));
    #[expect(clippy::cast_precision_loss, reason = "a diameter within a drawing's limits")]
    let tool = |tool: &Option<u64>| tool.map(|tool| tool as f64 / 1000.0);
    let cutters = stats.cutters.iter().map(|(tool_, total)| total_json(total, "tool", json!(tool(tool_))));
    json!({
        "drawings": stats.drawings,
        "paths": stats.all.paths,
        "length": stats.all.length,
        "minutes": stats.all.minutes(),
        "states": states.collect::<serde_json::Map<_, _>>(),
        "with_warnings": stats.warnings,
        "materials": materials.collect::<Vec<_>>(),
        "cutters": cutters.collect::<Vec<_>>(),
    })
}

fn total_json(total: &Total, key: &str, value: Json) -> Json {
    let mut object = json!({ "paths": total.paths, "length": total.length, "minutes": total.minutes() });
    object[key] = value;
    object
}
