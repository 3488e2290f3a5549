//! Programs of paths: made, then written, compared or printed. (spec/05-command-line.md, `emit`; spec/60-gcode.md)

mod asked;
mod compare;
mod configured;
mod current;
mod deliver;
mod deps;
mod job;
mod older;
mod options;
mod provenance;
mod stale;
mod store;
mod write_queue;

use std::collections::HashMap;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::Target;
use pathbuild_diagnostic::Diagnostic;

use crate::Inputs;
use crate::posting::Poster;
use crate::session::{CheckedTarget, Found, Scope, Session};
use crate::workspace::Workspace;

use asked::Asked;
pub(crate) use configured::Configured;
pub use current::{Current, current};
use deliver::Means;
pub use deliver::{Delivered, State, Task};
use job::{Job, Maker, without_clashes};
pub(crate) use options::write_options;
pub use provenance::Provenances;
use stale::Dealt;
use store::{Known, Run, Store};
use write_queue::deliver_all;

/// What is to become programs.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    /// Drawings, paths and directories; without any, what `[emit] targets` means.
    pub inputs: &'a Inputs,
    /// What is done with the files.
    pub task: Task,
    /// The post that programs are written through; `None`: natively.
    pub poster: Option<&'a Poster>,
    /// The name of the one program that all paths become, in the order of the inputs.
    pub join: Option<&'a str>,
    /// The file for `make` and `ninja`.
    pub deps: Option<&'a Utf8Path>,
    /// Whether stale programs are removed.
    pub removes_stale: bool,
}

/// What came of it.
#[derive(Debug)]
pub struct Emission {
    /// What became of the files of each program, in the order of the targets.
    pub delivered: Vec<Delivered>,
    /// The stale programs that were removed.
    pub removed: Vec<Utf8PathBuf>,
    /// Adjusted programs that are of another program than the path's now.
    pub outdated: Vec<Utf8PathBuf>,
    /// Everything that was found, in any order and as often as it was met.
    pub diagnostics: Vec<Diagnostic>,
}

impl Request<'_> {
    /// A session for it.
    pub fn session<'w>(&self, workspace: &'w Workspace) -> Session<'w> {
        if workspace.keeps_results() && !self.is_always_made() {
            Session::traced(workspace)
        } else {
            Session::new(workspace)
        }
    }

    /// Whether nothing that is known from earlier runs is enough.
    fn is_always_made(&self) -> bool {
        matches!(self.task, Task::Print | Task::Write { force: true })
            || self.deps.is_some()
            || self.join.is_some()
            || self.poster.is_some_and(Poster::runs_post_build)
    }

    /// Makes the programs, in its session.
    ///
    /// # Errors
    /// Why the request makes no sense.
    pub fn run(&self, session: &mut Session<'_>) -> Result<Emission, String> {
        let mut found = session.directories_only(self.inputs);
        let store = found.as_mut().and_then(|found| {
            Store::open(session.workspace(), self, Scope::of(found), std::mem::take(&mut found.listings))
        });
        session.prefetch(self.inputs);
        let making = Making { request: self, store: store.as_ref(), found };
        let made = session.settled(|session| making.make(session))?;
        let Made { asked, checked, jobs, mut delivered, mut diagnostics } = made;
        tell_known(session.workspace(), &asked, checked.len());
        let older = older::programs(session, self, &asked.targets, &jobs, &delivered);
        let problems = delivered.iter().chain(&older).flat_map(|delivered| &delivered.problems);
        diagnostics.extend(problems.cloned());
        if let Some(file) = self.deps {
            let inserted: Vec<_> = delivered.iter().map(|delivered| delivered.inserted.clone()).collect();
            diagnostics.extend(deps::write(session, file, &jobs, self.poster, &inserted));
        }
        let stale = match self.task {
            Task::Print => Vec::new(),
            _ => stale::stale(session, &asked, &jobs, &delivered, self.poster),
        };
        let Dealt { removed, outdated } =
            stale::deal_with(session, stale, self.removes_stale, &mut diagnostics);
        if let Some(store) = store {
            let (task, drawings, poster) = (self.task, &asked.drawings, self.poster);
            let (checked, jobs, delivered) = (&checked, &jobs, &delivered);
            store.keep(session, &Run { task, drawings, checked, jobs, delivered, poster });
        }
        delivered.extend(older);
        Ok(Emission { delivered, removed, outdated, diagnostics: session.with_elsewhere(diagnostics) })
    }
}

/// What a run makes, and from what.
struct Making<'a> {
    request: &'a Request<'a>,
    store: Option<&'a Store>,
    found: Option<Found>,
}

/// What came of a run.
struct Made {
    asked: Asked,
    /// The targets of which not enough was known.
    checked: Vec<CheckedTarget>,
    jobs: Vec<Job>,
    delivered: Vec<Delivered>,
    diagnostics: Vec<Diagnostic>,
}

impl Making<'_> {
    /// Makes the programs of which not enough is known, and writes, compares or prints them.
    ///
    /// # Errors
    /// Why the arguments make no sense.
    fn make(&self, session: &mut Session<'_>) -> Result<Made, String> {
        let Self { request, store, found } = self;
        let Request { inputs, task, poster, join, .. } = **request;
        let context = session.workspace();
        let mut diagnostics = Vec::new();
        let asked = match join {
            Some(_) => Asked::in_order(session, inputs, &mut diagnostics),
            None => Asked::new(session, *store, inputs, found.as_ref(), &mut diagnostics),
        };
        let asked = asked.ok_or(NOTHING_TO_EMIT)?;
        if task == Task::Print && join.is_none() && asked.targets.len() > 1 {
            return Err("`-o -` takes one path: it would be several programs".into());
        }
        let (known, open) = known(session, *store, &asked.targets, task, &mut diagnostics);
        let checked = session.check(&open);
        if let Some(refusal) = options::missing(context, task, &checked) {
            return Err(refusal);
        }
        diagnostics.extend(checked.iter().flat_map(|checked| store::found(session, checked)));
        let maker = Maker { session, poster };
        let jobs = if let Some(name) = join {
            maker.joined(name, &checked, &mut diagnostics).into_iter().collect()
        } else {
            let mut jobs = maker.jobs(&checked, &mut diagnostics);
            jobs.extend(known);
            in_order(&mut jobs, &asked.targets);
            without_clashes(session, jobs, &mut diagnostics)
        };
        if task == Task::Print && jobs.iter().any(|job| job.files.len() > 1) {
            return Err("`-o -` takes one program: this path has Z-probes and becomes several files".into());
        }
        let means = Means::new(context, poster);
        let delivered = deliver(session, &jobs, task, &means);
        Ok(Made { asked, checked, jobs, delivered, diagnostics })
    }
}

/// Says, to whoever wants to know more, how much is as it was in an earlier run.
fn tell_known(context: &Workspace, asked: &Asked, open: usize) {
    let (paths, drawings) = (asked.targets.len(), asked.covered.len());
    let known = [(paths - open, paths), (drawings - asked.drawings.read().count(), drawings)];
    let phrases = [
        context.choose("paths whose results still hold", "Pfade, deren Ergebnisse noch gelten"),
        context.choose("drawings that are known", "Zeichnungen, die bekannt sind"),
    ];
    for (phrase, (known, all)) in phrases.iter().zip(known) {
        context.reporter.detail(&format!("{phrase}: {known} / {all}"));
    }
}

/// The jobs of paths of which enough is known for the task, and the other paths.
fn known(
    session: &Session<'_>,
    store: Option<&Store>,
    targets: &[Target],
    task: Task,
    diagnostics: &mut Vec<Diagnostic>,
) -> (Vec<Job>, Vec<Target>) {
    let db = session.db();
    let (mut jobs, mut open) = (Vec::new(), Vec::new());
    for target in targets {
        let known = store.and_then(|store| store.path(target.file(db).path(db), target.name(db), task));
        match known {
            Some(Known { diagnostics: found, program }) => {
                diagnostics.extend(found);
                jobs.extend(program.map(|program| Job::known(*target, program)));
            }
            None => open.push(*target),
        }
    }
    (jobs, open)
}

/// Puts jobs in the order of their targets.
fn in_order(jobs: &mut [Job], targets: &[Target]) {
    let places: HashMap<Target, usize> = targets.iter().copied().zip(0..).collect();
    jobs.sort_by_key(|job| places[&job.targets[0]]);
}

/// Does the jobs of which not everything is known; what became of each.
fn deliver(session: &mut Session<'_>, jobs: &[Job], task: Task, means: &Means<'_>) -> Vec<Delivered> {
    let open: Vec<&Job> = jobs.iter().filter(|job| job.known.is_none()).collect();
    let mut made = deliver_all(session, &open, task, means).into_iter();
    let delivered = jobs.iter().map(|job| match &job.known {
        Some(known) => known.delivered(task),
        None => made.next().unwrap_or_default(),
    });
    delivered.collect()
}

/// Which path each file was written for, by its name without regard to case.
pub(crate) type Owners = HashMap<String, Target>;

/// Writes the programs of some targets, for who keeps watching; what is wrong with them as programs. Checks have said what is wrong with their
/// drawings.
///
/// # Errors
/// Options that programs need and nobody gives.
pub(crate) fn write(
    session: &mut Session<'_>,
    poster: Option<&Poster>,
    targets: &[Target],
    owners: &mut Owners,
) -> Result<Emission, String> {
    session.settled(|session| {
        let context = session.workspace();
        let checked = session.check(targets);
        let task = Task::Write { force: false };
        if let Some(refusal) = options::missing(context, task, &checked) {
            return Err(refusal);
        }
        let mut diagnostics = Vec::new();
        let jobs = Maker { session, poster }.jobs(&checked, &mut diagnostics);
        let mut jobs = without_clashes(session, jobs, &mut diagnostics);
        jobs.retain(|job| job.claim(session, owners, &mut diagnostics));
        let means = Means::new(context, poster);
        let delivered = deliver(session, &jobs, task, &means);
        diagnostics.extend(delivered.iter().flat_map(|delivered| &delivered.problems).cloned());
        Ok(Emission { delivered, removed: Vec::new(), outdated: Vec::new(), diagnostics })
    })
}

const NOTHING_TO_EMIT: &str = "nothing to emit: name drawings, paths or directories, or set `library` and `[emit] targets` in pathbuild.toml";
