//! Asking for many targets at once, on all cores. Threads work outside queries only, each over its own clone of the database.

use std::time::{Duration, Instant};

use pathbuild_db::{
    Closure, Database, MissingOption, Reached, Role, SourceFile, Target, Trace, closure, locate, path,
    path_names, trace,
};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;
use rayon::prelude::*;

use super::timings::{CHECKING, READING};
use super::watchdog::Watchdog;
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

/// Stacks of worker threads: queries call each other once for each level of embedding.
const STACK_SIZE: usize = 16 << 20;

impl Session<'_> {
    /// A target for each path of a file.
    pub fn targets(&self, file: SourceFile, role: &Role) -> Vec<Target> {
        let names = path_names(&self.db, file).iter();
        names.map(|name| self.target_in(file, name, role.clone())).collect()
    }

    /// The target for a path that was named.
    pub fn target(&self, path: &WantedPath, role: Role) -> Target {
        self.target_in(path.file, &path.name, role)
    }

    /// The target for a path of a drawing: the same again, in a session that asks again.
    pub fn target_in(&self, file: SourceFile, name: &PathName, role: Role) -> Target {
        let new = |role| Target::new(&self.db, file, name.as_str().into(), role);
        match &self.targets {
            None => new(role),
            Some(known) => {
                let key = (file, name.as_str().into(), role.clone());
                *known.borrow_mut().entry(key).or_insert_with(|| new(role))
            }
        }
    }

    /// Reads files ahead, on all cores.
    pub fn read_ahead(&self, files: &[SourceFile]) {
        self.timings.measure(&READING, || {
            self.spread(files, |db, file| {
                path_names(db, *file);
            });
        });
    }

    /// Checks targets; the order of the results is that of the targets.
    pub fn check(&self, targets: &[Target]) -> Vec<CheckedTarget> {
        let is_traced = self.is_traced;
        let work = |db: &Database, target: &Target| {
            let begun = Instant::now();
            (check(db, *target, is_traced), begun.elapsed())
        };
        let results = self.timings.measure(&CHECKING, || self.guarded(targets, work));
        let given_up =
            |(result, target): (Result<(CheckedTarget, Duration), Box<Diagnostic>>, &Target)| match result {
                Ok((checked, time)) => {
                    let (db, name) = (&self.db, target.name(&self.db));
                    self.timings.add_path(|| format!("{name} ({})", target.file(db).path(db)), time);
                    checked
                }
                Err(problem) => given_up(&self.db, *target, *problem),
            };
        results.into_iter().zip(targets).map(given_up).collect()
    }

    /// Works on each item for itself: one that takes too long or shows a bug does not keep the others from being done. The order of the
    /// results is that of the items.
    pub fn guarded<T: Sync, R: Send>(
        &self,
        items: &[T],
        work: impl Fn(&Database, &T) -> R + Sync,
    ) -> Vec<Result<R, Box<Diagnostic>>> {
        let limit = self.context.settings.limits.seconds_per_path.value;
        let watchdog = self.watchdog.get_or_init(|| Watchdog::start(limit));
        let work = |db: &Database, item: &T| {
            let _watched = watchdog.begin(db);
            db.guarded(limit, || work(db, item))
        };
        self.spread(items, work)
    }

    /// Works on each item, in the order of the items whatever the number of threads. One item is worked on here: starting threads takes
    /// longer than most paths.
    pub(super) fn spread<T: Sync, R: Send>(
        &self,
        items: &[T],
        work: impl Fn(&Database, &T) -> R + Sync,
    ) -> Vec<R> {
        if items.len() <= 1 || self.context.jobs == Some(1) {
            return items.iter().map(|item| work(&self.db, item)).collect();
        }
        let threads = usize::from(self.context.jobs.unwrap_or(0));
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK_SIZE).build();
        let Ok(pool) = pool else { return items.iter().map(|item| work(&self.db, item)).collect() };
        let db = self.db.clone();
        let progress = self.context.printer.progress(items.len());
        let work = |db: &mut Database, item| {
            let result = work(db, item);
            progress.advance();
            result
        };
        pool.install(|| items.par_iter().map_with(db, work).collect())
    }
}

/// A target that nothing is known of but why it was not finished.
fn given_up(db: &Database, target: Target, problem: Diagnostic) -> CheckedTarget {
    let file = target.file(db);
    CheckedTarget {
        target,
        diagnostics: vec![problem.in_file(file.path(db)).in_path(target.name(db))],
        files: vec![file],
        missing_options: Vec::new(),
        emitted: None,
        trace: None,
    }
}

fn check(db: &Database, target: Target, is_traced: bool) -> CheckedTarget {
    let reached = closure(db, target);
    let located = reached.diagnostics.iter().map(|diagnostic| locate(db, diagnostic.clone()));
    CheckedTarget {
        target,
        diagnostics: located.collect(),
        files: reached.files(db),
        missing_options: reached.missing_options.clone(),
        emitted: emitted(db, reached),
        trace: is_traced.then(|| trace(db, target).clone()),
    }
}

fn emitted(db: &Database, reached: &Closure<'_>) -> Option<Emitted> {
    if reached.has_errors() {
        return None;
    }
    let root = path(db, reached.root?).path.as_ref()?;
    let has_probes = |reached: &Reached<'_>| {
        path(db, reached.instance).path.as_ref().is_some_and(|path| !path.probes.is_empty())
    };
    Some(Emitted {
        path: root.name.as_str().into(),
        suffix: root.output_suffix.clone(),
        has_probes: reached.reached.iter().any(has_probes),
    })
}
