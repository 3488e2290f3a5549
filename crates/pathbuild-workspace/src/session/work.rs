//! Parallel work on many targets. Threads call queries on their own clones of the database; no query spawns threads.

use std::collections::HashMap;
use std::sync::OnceLock;
use std::time::Duration;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{FileKind, System, join};
use pathbuild_db::{
    Closure, Database, Db, Instance, MissingOption, Role, SourceFile, Target, Trace, check_file,
    check_target, closure, embeds_others, file_index, locate, path_names, q_project_findings, summary, trace,
};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::outputs;
use pathbuild_path::{PathName, PathSignature, is_q_project, tested_by_q_project};
use rayon::prelude::*;

use super::Session;
use super::timings::{CHECKING_PATHS, READING_DRAWINGS, Timings};
use super::workers::{Watchdog, Workers};

/// The outcome of checking a target.
#[derive(Debug)]
pub struct CheckedTarget {
    /// The target that was checked.
    pub target: Target,
    /// Diagnostics of the target and of everything it embeds, with their locations.
    pub diagnostics: Vec<Diagnostic>,
    /// The drawings that the target uses, its own first.
    pub files: Vec<SourceFile>,
    /// Options that the target needs but that are not set.
    pub missing_options: Vec<MissingOption>,
    /// Facts about the target's program; `None` if there are errors.
    pub emitted: Option<ProgramFacts>,
    /// All inputs of the check; `None` unless the session traces them.
    pub trace: Option<Trace>,
}

/// Facts about a program that are known before it is built.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProgramFacts {
    /// Name of the path, as the drawing spells it.
    pub path: Box<str>,
    /// Value of R, which is appended to the names of the program's files.
    pub suffix: Box<str>,
    /// Whether the path, or any path that it embeds, contains probes.
    pub has_probes: bool,
}

/// A checker of single targets, which runs on a worker thread with its own clone of the database.
#[derive(Debug)]
pub struct Checker<'a> {
    db: &'a Database,
    is_traced: bool,
    limit: Duration,
    watchdog: &'a OnceLock<Watchdog>,
    timings: &'a Timings,
}

/// Upper bound on items per rayon chunk. Other threads cannot take over items of a chunk, so they may have to wait at the end. But each chunk clones
/// the database and has to fill the caches of the clone anew, so shorter chunks would cost more than the waiting.
const ITEMS_PER_CHUNK: usize = 32;

/// Number of programs per rayon chunk. Building a program costs about 1000 times as much as cloning the database, so programs are scheduled one by
/// one.
const PROGRAMS_PER_CHUNK: usize = 1;

impl Session<'_> {
    /// Returns one target for each path of a file.
    pub fn targets(&self, file: SourceFile, role: &Role) -> Vec<Target> {
        let names = path_names(&self.db, file).iter();
        names.map(|name| self.db.target(file, name.as_str(), role.clone())).collect()
    }

    /// Whether the session records which files each result depends on, so that results can be cached.
    pub fn is_traced(&self) -> bool {
        self.is_traced
    }

    /// Parses drawings on all cores.
    pub fn parse_ahead(&self, files: &[SourceFile]) {
        let read = |db: &Database, file: &SourceFile| _ = file_index(db, *file);
        self.timings.measure(&READING_DRAWINGS, || self.map_parallel(files, read));
    }

    /// Processes many items in batches. Parsed data of a batch is evicted before the next one, so that memory grows with the results and
    /// not with the size of the library.
    pub fn in_batches<T, R>(
        &mut self,
        all: &[T],
        size: usize,
        mut work: impl FnMut(&Self, &[T]) -> Vec<R>,
    ) -> Vec<R> {
        self.progress = Some(self.context.reporter.progress(all.len()));
        let mut results = Vec::with_capacity(all.len());
        for batch in all.chunks(size) {
            results.extend(work(self, batch));
            self.db.drop_unused();
        }
        self.progress = None;
        results
    }

    /// Returns the size of a batch for building `count` programs: only a few per thread at a time, since each may have hundreds of thousands of
    /// steps.
    pub fn programs_per_batch(&self, count: usize) -> usize {
        const PROGRAMS: usize = 6;
        // For a few programs, starting threads costs more than it saves.
        PROGRAMS * if count > PROGRAMS { self.threads() } else { 1 }
    }

    /// Checks targets, and returns the results in the order of the targets.
    pub fn check(&self, targets: &[Target]) -> Vec<CheckedTarget> {
        self.map_with_checker(targets, |checker, target| checker.check(*target))
    }

    /// Returns the diagnostics of a checked path and of the drawings that it uses. `emit` writes no program if any of them is an error.
    pub fn path_diagnostics(&self, checked: &CheckedTarget) -> Vec<Diagnostic> {
        let of_files = checked.files.iter().flat_map(|file| check_file(&self.db, *file));
        of_files.chain(&checked.diagnostics).cloned().collect()
    }

    /// Processes items on all cores, and returns the results in the order of the items.
    pub fn map_with_checker<T: Sync, R: Send>(
        &self,
        items: &[T],
        work: impl Fn(&Checker<'_>, &T) -> R + Sync,
    ) -> Vec<R> {
        let (is_traced, limit, watchdog) = (self.is_traced, self.limit(), &self.watchdog);
        let timings = &self.timings;
        let work = |db: &Database, item: &T| work(&Checker { db, is_traced, limit, watchdog, timings }, item);
        self.timings.measure(&CHECKING_PATHS, || self.map_parallel(items, work))
    }

    /// Runs further queries about a target that was checked.
    ///
    /// # Errors
    /// PB005 if they take too long, PB001 if a drawing changed in the meantime, PB006 if they trigger a bug.
    pub fn query_target<R>(
        &self,
        target: Target,
        ask: impl Fn(&Database) -> R,
    ) -> Result<R, Box<Diagnostic>> {
        let limit = self.limit();
        let _watched = self.watchdog.get_or_init(|| Watchdog::start(limit)).begin(&self.db);
        let answer = self.db.run_guarded(limit, || ask(&self.db));
        answer.map_err(|problem| Box::new(with_file_and_path(&self.db, target, *problem)))
    }

    pub(super) fn limit(&self) -> Duration {
        self.context.settings.limits.seconds_per_path.value
    }

    /// Processes items independently: an item that takes too long or triggers a bug does not affect the others. The results are in the order of the
    /// items.
    pub fn map_guarded<T: Sync, R: Send>(
        &self,
        items: &[T],
        work: impl Fn(&Database, &T) -> R + Sync,
    ) -> Vec<Result<R, Box<Diagnostic>>> {
        if items.is_empty() {
            return Vec::new();
        }
        let limit = self.limit();
        let watchdog = self.watchdog.get_or_init(|| Watchdog::start(limit));
        let work = |db: &Database, item: &T| {
            let _watched = watchdog.begin(db);
            db.run_guarded(limit, || work(db, item))
        };
        self.map_in_chunks(items, PROGRAMS_PER_CHUNK, work)
    }

    /// Processes items that need no database, such as programs, in parallel. Returns the results in the order of the items.
    pub fn map_programs<T: Sync, R: Send>(&self, items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
        self.map_in_chunks(items, PROGRAMS_PER_CHUNK, |_, item| work(item))
    }

    /// Processes items in parallel, and returns the results in the order of the items. A single item is processed on this thread: starting threads
    /// takes longer than most paths.
    pub(super) fn map_parallel<T: Sync, R: Send>(
        &self,
        items: &[T],
        work: impl Fn(&Database, &T) -> R + Sync,
    ) -> Vec<R> {
        self.map_in_chunks(items, ITEMS_PER_CHUNK, work)
    }

    fn map_in_chunks<T: Sync, R: Send>(
        &self,
        items: &[T],
        chunk_size: usize,
        work: impl Fn(&Database, &T) -> R + Sync,
    ) -> Vec<R> {
        if items.len() <= 1 || self.context.jobs == Some(1) {
            return items.iter().map(|item| work(&self.db, item)).collect();
        }
        let Some(workers) = self.workers() else {
            return items.iter().map(|item| work(&self.db, item)).collect();
        };
        let db = self.db.clone();
        let own = self.progress.is_none().then(|| self.context.reporter.progress(items.len()));
        let progress = self.progress.as_ref().or(own.as_ref());
        let work = |db: &mut Database, item| {
            let result = work(db, item);
            progress.inspect(|progress| progress.advance());
            result
        };
        workers.work(|| items.par_iter().with_max_len(chunk_size).map_with(db, work).collect())
    }

    /// Starts the worker threads early, while other work remains to be done before they are needed.
    pub(super) fn start_workers(&self) {
        if self.context.jobs != Some(1) {
            self.workers();
        }
    }

    fn threads(&self) -> usize {
        let shared = || self.workers().map_or(1, Workers::count);
        if self.context.jobs == Some(1) { 1 } else { shared() }
    }

    /// Returns the worker threads, which are started on first use; `None` if the system provides none.
    fn workers(&self) -> Option<&Workers> {
        self.workers.get_or_init(|| Workers::start(self.context.jobs)).as_ref()
    }
}

impl Checker<'_> {
    /// Returns this thread's clone of the database.
    pub fn db(&self) -> &Database {
        self.db
    }

    /// Whether the session records which files each result depends on, so that results can be cached.
    pub fn is_traced(&self) -> bool {
        self.is_traced
    }

    /// Checks a path in the role in which it is emitted. A path with variables or missing options is checked as if it were embedded: with example
    /// values, and with a sweep height (S) above everything that it embeds.
    pub fn check_leniently(&self, file: SourceFile, name: &PathName) -> CheckedTarget {
        let target = |role| self.db.target(file, name.as_str(), role);
        let index = file_index(self.db, file).path(name);
        if index.is_some_and(|path| path.header.definitions.is_empty()) {
            let emitted = self.check(target(Role::Emitted));
            if emitted.missing_options.is_empty() {
                return emitted;
            }
        }
        self.check(target(Role::Checked))
    }

    /// Checks a target. A timeout or a bug becomes a diagnostic of the target.
    pub fn check(&self, target: Target) -> CheckedTarget {
        let watchdog = self.watchdog.get_or_init(|| Watchdog::start(self.limit));
        let _watched = watchdog.begin(self.db);
        let work = || self.db.run_guarded(self.limit, || check(self.db, target, self.is_traced));
        let name = || format!("{} ({})", target.name(self.db), target.file(self.db).path(self.db));
        let checked = self.timings.measure_path(name, work);
        checked.unwrap_or_else(|problem| aborted_target(self.db, target, *problem))
    }
}

fn aborted_target(db: &Database, target: Target, problem: Diagnostic) -> CheckedTarget {
    CheckedTarget {
        target,
        diagnostics: vec![with_file_and_path(db, target, problem)],
        files: vec![target.file(db)],
        missing_options: Vec::new(),
        emitted: None,
        trace: None,
    }
}

pub(super) fn with_file_and_path(db: &Database, target: Target, problem: Diagnostic) -> Diagnostic {
    problem.in_file(target.file(db).path(db)).in_path(target.name(db))
}

fn check(db: &Database, target: Target, is_traced: bool) -> CheckedTarget {
    let reached = closure(db, target);
    let located = check_target(db, target).map(|diagnostic| locate(db, diagnostic.clone()));
    let diagnostics: Vec<Diagnostic> = located.collect();
    CheckedTarget {
        target,
        emitted: program_facts(db, reached, &diagnostics),
        diagnostics,
        files: reached.files(db),
        missing_options: reached.missing_options.clone(),
        trace: is_traced.then(|| trace(db, target).clone()),
    }
}

fn program_facts(db: &Database, reached: &Closure<'_>, found: &[Diagnostic]) -> Option<ProgramFacts> {
    if found.iter().any(Diagnostic::is_error) {
        return None;
    }
    let root = signature(db, reached.root?)?;
    let mut signatures = reached.reached.iter().filter_map(|reached| signature(db, *reached));
    Some(ProgramFacts {
        path: root.name.as_str().into(),
        suffix: root.output_suffix.as_str().into(),
        has_probes: signatures.any(|signature| signature.has_probes),
    })
}

fn signature<'db>(db: &'db Database, instance: Instance<'db>) -> Option<&'db PathSignature> {
    summary(db, instance).signature.as_ref()
}

impl Session<'_> {
    /// Returns, for each pair, the discrepancies between the drawing and its Q-project, or PB515 if the drawing does not exist.
    pub fn compare_q_projects(&self, pairs: &[QProjectPair]) -> Vec<Vec<Diagnostic>> {
        let judge = |db: &Database, [drawing, q_project]: &QProjectPair| {
            if is_missing(db.system(), drawing.path(db)) {
                return q_project_without_drawing(db, *drawing, *q_project).into_iter().collect();
            }
            let found = q_project_findings(db, *drawing, *q_project).iter().cloned();
            found.map(|problem| locate(db, problem)).collect::<Vec<_>>()
        };
        let given_up = |(result, [drawing, _]): (Result<_, Box<Diagnostic>>, &QProjectPair)| {
            result.unwrap_or_else(|problem| vec![problem.in_file(drawing.path(self.db()))])
        };
        self.map_guarded(pairs, judge).into_iter().zip(pairs).map(given_up).collect()
    }
}

fn is_missing(system: &dyn System, drawing: &Utf8Path) -> bool {
    system.kind(drawing) == FileKind::Missing
}

/// Returns PB515 for a Q-project without its drawing. A drawing that embeds nothing is not a Q-project, whatever its name.
fn q_project_without_drawing(
    db: &Database,
    drawing: SourceFile,
    q_project: SourceFile,
) -> Option<Diagnostic> {
    let name = drawing.path(db).file_name().unwrap_or_default();
    let problem = || Diagnostic::new(&outputs::WITHOUT_DRAWING).quoting("drawing", name);
    embeds_others(db, q_project).then(|| problem().in_file(q_project.path(db)))
}

/// A drawing and its Q-project.
pub type QProjectPair = [SourceFile; 2];

/// Pairs each Q-project with the drawing that it tests, provided that this drawing is among `drawings` as well, or does not exist.
pub fn pairs<'a>(
    system: &dyn System,
    drawings: impl Iterator<Item = &'a Utf8PathBuf> + Clone,
) -> Vec<[Utf8PathBuf; 2]> {
    // Fast path: even a library of ten thousand drawings has few Q-projects or none.
    if !drawings.clone().any(|drawing| may_be_q_project(drawing)) {
        return Vec::new();
    }
    let stem = |path: &'a Utf8PathBuf| Some((path.parent()?, path.file_stem()?));
    let by_stem: HashMap<_, &Utf8PathBuf> =
        drawings.clone().filter_map(|path| Some((stem(path)?, path))).collect();
    let pair = |q_project: &'a Utf8PathBuf| {
        let (directory, name) = stem(q_project)?;
        let tested = tested_by_q_project(name)?;
        let drawing = match by_stem.get(&(directory, tested)) {
            Some(drawing) => (*drawing).clone(),
            None => Some(join(directory, format!("{tested}.dxf")))
                .filter(|drawing| is_missing(system, drawing))?,
        };
        Some([drawing, q_project.clone()])
    };
    drawings.filter_map(pair).collect()
}

/// Whether the name may be that of a Q-project. This cheap test does not split the path into components.
fn may_be_q_project(drawing: &Utf8Path) -> bool {
    let stem = drawing.as_str().rsplit_once('.').map_or(drawing.as_str(), |(stem, _)| stem);
    is_q_project(stem)
}
