//! The interface between commands and the database: resolves arguments, and checks paths and builds programs on all cores.

mod argument_matches;
mod graph;
mod library;
mod outputs;
mod resolve;
mod scene;
mod settings;
pub mod timings;
mod work;
mod workers;

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Arc, OnceLock};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{OverlaySystem, System, clean};
use pathbuild_db::{Database, Db, SourceFile};

use self::timings::Timings;
use self::workers::{Watchdog, Workers};
use crate::workspace::{ProgressCounter, Workspace};

pub use argument_matches::{Argument, ArgumentMatches};
pub use graph::{Direction, Embedding, EmbeddingEnd, Graph, GraphOutcome, Node};
#[cfg(not(target_family = "wasm"))]
pub(crate) use library::IGNORE_FILES;
pub(crate) use library::is_ignore_file;
pub use library::{ProgramMatches, compare_names, compare_paths};
pub use outputs::{OutputKind, OutputName, WriteSettings, stem_fault, without_positions, without_values};
pub(crate) use resolve::{MAX_READ_FOR_NAMES, no_drawing_error};
pub use resolve::{NamedPaths, NamesOf, NotOnePath, SelectedPath, Selection, several_paths_error};
pub use scene::HashedPath;
pub(crate) use scene::{ProgramDetails, drawn_source, examples, finished_parts, program_scene};
pub use settings::{limits, reading};
pub use work::{CheckedTarget, Checker, ProgramFacts, QProjectPair, pairs as q_project_pairs};

/// A database with the settings of a run.
#[derive(Debug)]
pub struct Session<'a> {
    db: Database,
    context: &'a Workspace,
    /// Whether the inputs of results are recorded.
    is_traced: bool,
    /// Thread that enforces time limits; started on first use.
    watchdog: OnceLock<Watchdog>,
    /// Progress display over all batches. If there is none, each parallel loop shows its own.
    progress: Option<Box<dyn ProgressCounter>>,
    workers: OnceLock<Option<Workers>>,
    /// Time spent in each phase.
    pub timings: Timings,
}

/// Upper bound on repetitions of work during which drawings changed. After that, a drawing that keeps changing is reported.
const MAX_ROUNDS: usize = 8;

impl<'a> Session<'a> {
    /// Opens a session on the files of a workspace.
    pub fn new(context: &'a Workspace) -> Self {
        Self::open(context, false)
    }

    /// Opens a session that traces inputs if `is_traced`, so that its results can be cached.
    pub fn open(context: &'a Workspace, is_traced: bool) -> Self {
        Self::with_system(context, is_traced, Arc::clone(&context.system))
    }

    /// Invalidates a drawing that may have changed, appeared or disappeared.
    pub fn touch_file(&mut self, path: &Utf8Path) {
        self.db.touch_file(path);
    }

    /// Invalidates the list of names in a directory.
    pub fn touch_directory(&mut self, path: &Utf8Path) {
        self.db.touch_directory(path);
    }

    /// Opens a session in which the drawing at `path` consists of these bytes, whether or not it exists on disk.
    pub fn with_drawing(context: &'a Workspace, path: &Utf8Path, bytes: Vec<u8>) -> Self {
        let overlay = OverlaySystem::new(Arc::clone(&context.system), path.to_owned(), bytes);
        Self::with_system(context, false, Arc::new(overlay))
    }

    /// Runs some work on a consistent state of the drawings. Repeats it if a drawing changes between two reads by the same work.
    pub fn with_stable_files<R>(&mut self, mut work: impl FnMut(&mut Self) -> R) -> R {
        let mut rounds = 0;
        loop {
            let result = catch_unwind(AssertUnwindSafe(|| work(self)));
            rounds += 1;
            if !self.db.apply_noted_changes() || rounds == MAX_ROUNDS {
                return result.unwrap_or_else(|panic| resume_unwind(panic));
            }
        }
    }

    fn with_system(context: &'a Workspace, is_traced: bool, system: Arc<dyn System>) -> Self {
        let db = Database::new(system);
        settings::apply(&db, context, is_traced);
        Self {
            db,
            context,
            is_traced,
            watchdog: OnceLock::new(),
            progress: None,
            workers: OnceLock::new(),
            timings: Timings::default(),
        }
    }

    /// Returns the workspace of the session.
    pub fn workspace(&self) -> &'a Workspace {
        self.context
    }

    /// Returns the database of the session.
    pub fn db(&self) -> &Database {
        &self.db
    }

    /// Returns the drawing with this path, whether it exists or not.
    pub fn file(&self, path: &Utf8Path) -> SourceFile {
        if self.is_normal(path) { self.db.file(path) } else { self.db.file(&self.normalize(path)) }
    }

    /// Normalizes a path: relative to the working directory if inside it, without `.` and `x/..`.
    pub fn normalize(&self, path: &Utf8Path) -> Utf8PathBuf {
        normalize(path, &self.context.working_directory)
    }

    pub(crate) fn absolute(&self, path: &Utf8Path) -> Utf8PathBuf {
        clean(&self.context.working_directory.join(path))
    }

    /// Returns the path of a file relative to `directory`, which is an absolute path; `file` unchanged if the file is not below the directory. `file`
    /// may be relative or absolute.
    pub(crate) fn place_below(&self, directory: &Utf8Path, file: &Utf8Path) -> Utf8PathBuf {
        self.absolute(file).strip_prefix(directory).unwrap_or(file).to_owned()
    }

    /// Returns the configured output directory of all programs; `None` if programs are written beside their drawings.
    pub fn out_dir(&self) -> Option<Utf8PathBuf> {
        self.context.settings.general.out_dir.value.as_ref().map(|directory| self.normalize(directory))
    }

    /// Like [`normalize`](Self::normalize), but does not copy a path that is normal already.
    fn normalize_owned(&self, path: Utf8PathBuf) -> Utf8PathBuf {
        if self.is_normal(&path) { path } else { self.normalize(&path) }
    }

    fn is_normal(&self, path: &Utf8Path) -> bool {
        is_normal(path, &self.context.working_directory)
    }
}

fn normalize(path: &Utf8Path, working_directory: &Utf8Path) -> Utf8PathBuf {
    if is_normal(path, working_directory) {
        return path.to_owned();
    }
    clean(path.strip_prefix(working_directory).unwrap_or(path))
}

/// Whether a path is known to be normal, as nearly all paths are: without redundant components, and not an absolute path inside the working
/// directory. Always false on Windows.
fn is_normal(path: &Utf8Path, working_directory: &Utf8Path) -> bool {
    let is_redundant = |part: &str| matches!(part, "" | "." | "..");
    let below_root =
        path.as_str().strip_prefix('/').filter(|_| !path.as_str().starts_with(working_directory.as_str()));
    !cfg!(windows) && !below_root.unwrap_or(path.as_str()).split('/').any(is_redundant)
}
