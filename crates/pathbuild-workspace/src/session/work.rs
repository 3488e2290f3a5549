//! Asking for many targets at once, on all cores. Threads work outside queries only, each over its own clone of the database.

use std::sync::OnceLock;
use std::time::Duration;

use pathbuild_db::{
    Closure, Database, Instance, MissingOption, Role, SourceFile, Target, Trace, check_target, closure,
    file_index, locate, path_names, summary, trace,
};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::{PathName, PathSignature};
use rayon::prelude::*;

use super::timings::{CHECKING, READING, Timings};
use super::watchdog::Watchdog;
use super::workers::Workers;
use super::{Session, WantedPath};

/// What came of a target.
#[derive(Debug)]
pub struct CheckedTarget {
    /// What was asked for.
    pub target: Target,
    /// What is wrong with it and all it embeds, located.
    pub diagnostics: Vec<Diagnostic>,
    /// The drawings that it was made from, its own first.
    pub files: Vec<SourceFile>,
    /// Options that it needs and that nobody gave.
    pub missing_options: Vec<MissingOption>,
    /// What it becomes, where nothing is wrong.
    pub emitted: Option<Emitted>,
    /// Everything that it was made from, in a session that notes it.
    pub trace: Option<Trace>,
}

/// What is known of a program before it is made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Emitted {
    /// The path, as the drawing spells it.
    pub path: Box<str>,
    /// R: what is added to the names of its files.
    pub suffix: Box<str>,
    /// Whether there are probes in it or in anything that it embeds.
    pub has_probes: bool,
}

/// Asks for one target after the other, on one of the threads that work.
#[derive(Debug)]
pub struct Asking<'a> {
    db: &'a Database,
    is_traced: bool,
    limit: Duration,
    watchdog: &'a OnceLock<Watchdog>,
    timings: &'a Timings,
}

/// So many items at most are worked on in a row: no other thread can take them over, which would wait at the end for as many. Each row has a
/// database of its own, whose lists grow anew: shorter rows cost more than waiting does.
const IN_A_ROW: usize = 32;

/// A program takes a thousand times as long as a database of its own does.
const ALONE: usize = 1;

impl Session<'_> {
    /// A target for each path of a file.
    pub fn targets(&self, file: SourceFile, role: &Role) -> Vec<Target> {
        let names = path_names(&self.db, file).iter();
        names.map(|name| self.db.target(file, name.as_str(), role.clone())).collect()
    }

    /// The target for a path that was named.
    pub fn target(&self, path: &WantedPath, role: Role) -> Target {
        self.target_in(path.file, &path.name, role)
    }

    /// The target for a path of a drawing.
    pub fn target_in(&self, file: SourceFile, name: &PathName, role: Role) -> Target {
        self.db.target(file, name.as_str(), role)
    }

    /// Whether it is noted what targets were made from.
    pub fn is_traced(&self) -> bool {
        self.is_traced
    }

    /// Indexes drawings, on all cores.
    pub fn read_ahead(&self, files: &[SourceFile]) {
        let read = |db: &Database, file: &SourceFile| _ = file_index(db, *file);
        self.timings.measure(&READING, || self.spread(files, read));
    }

    /// Works through many things in batches of that size. What is read for one batch is not kept for the next, so that memory grows with what
    /// is found in a library, not with what is drawn.
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

    /// The same where programs are made: a few a thread at a time, each of which may have hundreds of thousands of steps.
    pub fn in_batches_of_programs<T, R>(
        &mut self,
        all: &[T],
        work: impl FnMut(&Self, &[T]) -> Vec<R>,
    ) -> Vec<R> {
        const PROGRAMS: usize = 6;
        // Threads are not started for a few programs.
        let threads = if all.len() > PROGRAMS { self.threads() } else { 1 };
        self.in_batches(all, PROGRAMS * threads, work)
    }

    /// Checks targets; the order of the results is that of the targets.
    pub fn check(&self, targets: &[Target]) -> Vec<CheckedTarget> {
        self.each(targets, |asking, target| asking.check(*target))
    }

    /// Works on each of these, on all cores. The order of the results is that of the items.
    pub fn each<T: Sync, R: Send>(&self, items: &[T], work: impl Fn(&Asking<'_>, &T) -> R + Sync) -> Vec<R> {
        let (is_traced, limit, watchdog) = (self.is_traced, self.limit(), &self.watchdog);
        let timings = &self.timings;
        let work = |db: &Database, item: &T| work(&Asking { db, is_traced, limit, watchdog, timings }, item);
        self.timings.measure(&CHECKING, || self.spread(items, work))
    }

    /// Asks about a target what its check did not ask.
    ///
    /// # Errors
    /// PB005 where that takes too long, PB001 where a drawing changed meanwhile, PB006 where it shows a bug.
    pub fn of_target<R>(&self, target: Target, ask: impl Fn(&Database) -> R) -> Result<R, Box<Diagnostic>> {
        let limit = self.limit();
        let _watched = self.watchdog.get_or_init(|| Watchdog::start(limit)).begin(&self.db);
        let asked = self.db.guarded(limit, || ask(&self.db));
        asked.map_err(|problem| Box::new(about(&self.db, target, *problem)))
    }

    pub(super) fn limit(&self) -> Duration {
        self.context.settings.limits.seconds_per_path.value
    }

    /// Works on each item for itself: one that takes too long or shows a bug does not keep the others from being done. The order of the
    /// results is that of the items.
    pub fn guarded<T: Sync, R: Send>(
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
            db.guarded(limit, || work(db, item))
        };
        self.spread_in_rows(items, ALONE, work)
    }

    /// Works on each item, in the order of the items whatever the number of threads. One item is worked on here: starting threads takes
    /// longer than most paths.
    pub(super) fn spread<T: Sync, R: Send>(
        &self,
        items: &[T],
        work: impl Fn(&Database, &T) -> R + Sync,
    ) -> Vec<R> {
        self.spread_in_rows(items, IN_A_ROW, work)
    }

    fn spread_in_rows<T: Sync, R: Send>(
        &self,
        items: &[T],
        most_in_a_row: usize,
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
        workers.work(|| items.par_iter().with_max_len(most_in_a_row).map_with(db, work).collect())
    }

    /// Starts the worker threads while there is something else to do before there is work for them.
    pub(super) fn rouse_workers(&self) {
        if self.context.jobs != Some(1) {
            self.workers();
        }
    }

    /// How many threads work.
    fn threads(&self) -> usize {
        let shared = || self.workers().map_or(1, Workers::count);
        if self.context.jobs == Some(1) { 1 } else { shared() }
    }

    /// The worker threads, started when they are first wanted; `None` where the system gives none.
    fn workers(&self) -> Option<&Workers> {
        self.workers.get_or_init(|| Workers::start(self.context.jobs)).as_ref()
    }
}

impl Asking<'_> {
    /// The database.
    pub fn db(&self) -> &Database {
        self.db
    }

    /// Whether it is noted what targets are made from.
    pub fn is_traced(&self) -> bool {
        self.is_traced
    }

    /// Checks a path as it is emitted; where that asks for more than is known, with variables or without options, as it is embedded: with
    /// example values, and S above what it embeds.
    pub fn check_as_known(&self, file: SourceFile, name: &PathName) -> CheckedTarget {
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

    /// Checks a target. If it takes too long or shows a bug, that is what is found.
    pub fn check(&self, target: Target) -> CheckedTarget {
        let watchdog = self.watchdog.get_or_init(|| Watchdog::start(self.limit));
        let _watched = watchdog.begin(self.db);
        let work = || self.db.guarded(self.limit, || check(self.db, target, self.is_traced));
        let name = || format!("{} ({})", target.name(self.db), target.file(self.db).path(self.db));
        let checked = self.timings.measure_path(name, work);
        checked.unwrap_or_else(|problem| given_up(self.db, target, *problem))
    }
}

/// A target that nothing is known of but why it was not finished.
fn given_up(db: &Database, target: Target, problem: Diagnostic) -> CheckedTarget {
    CheckedTarget {
        target,
        diagnostics: vec![about(db, target, problem)],
        files: vec![target.file(db)],
        missing_options: Vec::new(),
        emitted: None,
        trace: None,
    }
}

/// What is wrong with a target as a whole.
pub(super) fn about(db: &Database, target: Target, problem: Diagnostic) -> Diagnostic {
    problem.in_file(target.file(db).path(db)).in_path(target.name(db))
}

fn check(db: &Database, target: Target, is_traced: bool) -> CheckedTarget {
    let reached = closure(db, target);
    let located = check_target(db, target).map(|diagnostic| locate(db, diagnostic.clone()));
    let diagnostics: Vec<Diagnostic> = located.collect();
    CheckedTarget {
        target,
        emitted: emitted(db, reached, &diagnostics),
        diagnostics,
        files: reached.files(db),
        missing_options: reached.missing_options.clone(),
        trace: is_traced.then(|| trace(db, target).clone()),
    }
}

fn emitted(db: &Database, reached: &Closure<'_>, found: &[Diagnostic]) -> Option<Emitted> {
    if found.iter().any(Diagnostic::is_error) {
        return None;
    }
    let root = signature(db, reached.root?)?;
    let mut signatures = reached.reached.iter().filter_map(|reached| signature(db, reached.instance));
    Some(Emitted {
        path: root.name.as_str().into(),
        suffix: root.output_suffix.as_str().into(),
        has_probes: signatures.any(|signature| signature.has_probes),
    })
}

fn signature<'db>(db: &'db Database, instance: Instance<'db>) -> Option<&'db PathSignature> {
    summary(db, instance).signature.as_ref()
}
