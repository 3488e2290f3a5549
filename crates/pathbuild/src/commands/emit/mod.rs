//! `pathbuild emit`: the files of one or more paths. (spec/05-command-line.md, spec/60-gcode.md)

mod asked;
mod compare;
mod configured;
mod deliver;
mod deps;
mod job;
mod options;
mod stale;
mod store;
mod write_queue;

use std::collections::HashMap;

use pathbuild_db::Target;
use pathbuild_diagnostic::{Diagnostic, Note};

use crate::args::EmitArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use pathbuild_workspace::posting::{Poster, Wishes, run_post_build};
use pathbuild_workspace::session::{CheckedTarget, Found, Scope, Session};

use asked::Asked;
pub(in crate::commands) use configured::Configured;
use deliver::{Delivered, Means, State, Task};
use job::{Job, Maker, without_clashes};
use store::{Known, Run, Store};
use write_queue::deliver_all;

/// Runs the command.
pub fn run(context: &Context, args: &EmitArgs) -> ExitStatus {
    let wishes = Wishes {
        date: args.date.as_deref().map(Into::into),
        dialect: args.dialect.as_deref().map(Into::into),
        run_post_build: args.run_post_build,
    };
    match Poster::of_run(context, args.post.as_deref(), wishes) {
        Ok(poster) => match refusal(args, poster.as_ref()) {
            Some(refusal) => context.usage(refusal),
            None => emit(context, args, poster.as_ref()),
        },
        Err(problems) => context.fail(problems),
    }
}

/// Options that mean something only where programs are written through a post.
fn refusal(args: &EmitArgs, poster: Option<&Poster>) -> Option<&'static str> {
    let is_for_posts = args.date.is_some() || args.dialect.is_some() || args.run_post_build;
    match poster {
        None if args.join.is_some() => Some(
            "--join needs --post (or `post` in pathbuild.toml): the native program has one path and no tool changes",
        ),
        None if is_for_posts => Some(
            "--date, --dialect and --run-post-build are for posts: give --post, or set `post` in pathbuild.toml",
        ),
        _ => None,
    }
}

fn emit(context: &Context, args: &EmitArgs, poster: Option<&Poster>) -> ExitStatus {
    let mut session = Session::with_hashes(context);
    let mut found = session.directories_only(&args.inputs);
    let store = found.as_mut().and_then(|found| {
        Store::open(context, args, poster, Scope::of(found), std::mem::take(&mut found.listings))
    });
    if store.is_some() {
        session.note_traces();
    }
    session.prefetch(&args.inputs);
    let making = Making { context, args, poster, store: store.as_ref(), found };
    let made = match session.settled(|session| making.make(session)) {
        Ok(made) => made,
        Err(refusal) => return context.usage(&refusal),
    };
    let Made { asked, checked, jobs, delivered, mut diagnostics } = made;
    tell_known(context, &asked, checked.len());
    let is_current = show_all(context, &delivered, &mut diagnostics);
    if let Some(file) = &args.deps {
        let inserted: Vec<_> = delivered.iter().map(|delivered| delivered.inserted.clone()).collect();
        diagnostics.extend(deps::write(context, &session, file, &jobs, poster, &inserted));
    }
    diagnostics.extend(stale::deal_with(context, &session, &asked, &jobs, poster, args.remove_stale));
    if let Some(store) = store {
        let (task, checked, drawings) = (Task::new(args), &checked, &asked.drawings);
        store.keep(&session, &Run { task, drawings, checked, jobs: &jobs, delivered: &delivered, poster });
    }
    conclude(context, session, diagnostics, is_current)
}

/// What a run makes, and from what.
struct Making<'a> {
    context: &'a Context,
    args: &'a EmitArgs,
    poster: Option<&'a Poster>,
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
    fn make(&self, session: &mut Session<'_>) -> Result<Made, Box<str>> {
        let Self { context, args, poster, store, found } = self;
        let task = Task::new(args);
        let mut diagnostics = Vec::new();
        let asked = match args.join {
            Some(_) => Asked::in_order(context, session, &args.inputs, &mut diagnostics),
            None => Asked::new(context, session, *store, &args.inputs, found.as_ref(), &mut diagnostics),
        };
        let asked = asked.ok_or(NOTHING_TO_EMIT)?;
        if task == Task::Print && args.join.is_none() && asked.targets.len() > 1 {
            return Err("`-o -` takes one path: it would be several programs".into());
        }
        let (known, open) = known(session, *store, &asked.targets, task, &mut diagnostics);
        let checked = session.check(&open);
        if let Some(refusal) = options::missing(context, task, &checked) {
            return Err(refusal.into());
        }
        diagnostics.extend(checked.iter().flat_map(|checked| store::found(session, checked)));
        let maker = Maker { context, session, poster: *poster };
        let jobs = if let Some(name) = &args.join {
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
        let means = Means { writing: options::writing(context), poster: *poster };
        let delivered = deliver(session, &jobs, task, &means);
        Ok(Made { asked, checked, jobs, delivered, diagnostics })
    }
}

/// Says, to whoever wants to know more, how much is as it was in an earlier run.
fn tell_known(context: &Context, asked: &Asked, open: usize) {
    let (paths, drawings) = (asked.targets.len(), asked.covered.len());
    let known = [(paths - open, paths), (drawings - asked.drawings.read().count(), drawings)];
    let phrases = [
        context.choose("paths whose results still hold", "Pfade, deren Ergebnisse noch gelten"),
        context.choose("drawings that are known", "Zeichnungen, die bekannt sind"),
    ];
    for (phrase, (known, all)) in phrases.iter().zip(known) {
        context.printer.detail(format_args!("{phrase}: {known} / {all}"));
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

/// Says what was found; the status of the run.
fn conclude(
    context: &Context,
    session: Session<'_>,
    diagnostics: Vec<Diagnostic>,
    is_current: bool,
) -> ExitStatus {
    let findings = context.findings(session.with_elsewhere(diagnostics));
    context.show(&findings);
    // The run is over: to give back what every query holds, piece by piece, takes a twelfth of the time of a short one.
    std::mem::forget(session);
    if findings.errors() > 0 || !is_current { ExitStatus::Errors } else { ExitStatus::Success }
}

/// Says what became of all files, runs what posts want to be run on them, and collects what went wrong; whether all files are as they
/// should be.
fn show_all(context: &Context, delivered: &[Delivered], diagnostics: &mut Vec<Diagnostic>) -> bool {
    let mut is_current = true;
    let mut notes: Vec<&Note> = Vec::new();
    for delivered in delivered {
        is_current &= show(context, delivered);
        diagnostics.extend(delivered.problems.iter().cloned());
        if let Some((command, file)) =
            delivered.post_build.as_ref().filter(|(_, file)| delivered.has_written(file))
        {
            diagnostics.extend(run_post_build(command, file).err().map(|failure| *failure));
        }
        notes.extend(delivered.notes.iter().filter(|note| !notes.contains(note)).collect::<Vec<_>>());
    }
    for note in notes {
        context.printer.status(format_args!("{}", note.text(context.lang())));
    }
    is_current
}

/// Which path each file was written for, by its name without regard to case.
pub(in crate::commands) type Owners = HashMap<String, Target>;

/// Writes the programs of some targets, for who keeps watching; what is wrong with them as programs. Checks have said what is wrong with their
/// drawings.
pub(in crate::commands) fn write(
    context: &Context,
    session: &mut Session<'_>,
    poster: Option<&Poster>,
    targets: &[Target],
    owners: &mut Owners,
) -> Vec<Diagnostic> {
    session.settled(|session| {
        let checked = session.check(targets);
        let task = Task::Write { force: false };
        if let Some(refusal) = options::missing(context, task, &checked) {
            _ = context.usage(&refusal);
            return Vec::new();
        }
        let mut diagnostics = Vec::new();
        let jobs = Maker { context, session, poster }.jobs(&checked, &mut diagnostics);
        let mut jobs = without_clashes(session, jobs, &mut diagnostics);
        jobs.retain(|job| job.claim(session, owners, &mut diagnostics));
        let means = Means { writing: options::writing(context), poster };
        let delivered = deliver(session, &jobs, task, &means);
        show_all(context, &delivered, &mut diagnostics);
        diagnostics
    })
}

const NOTHING_TO_EMIT: &str = "nothing to emit: name drawings, paths or directories, or set `library` and `[emit] targets` in pathbuild.toml";

/// Says what became of the files of a path; whether all of them are as they should be.
fn show(context: &Context, delivered: &Delivered) -> bool {
    let mut is_current = true;
    for (index, (path, state)) in delivered.files.iter().enumerate() {
        let phrase = |en, de| context.choose(en, de);
        match state {
            State::Written | State::Unchanged => {
                let state = match state {
                    State::Written => phrase("written", "geschrieben"),
                    _ => phrase("unchanged", "unverändert"),
                };
                // The program comes first; what belongs to its probes has no length of its own.
                if index == 0 {
                    let (length, minutes) = (delivered.length, delivered.minutes);
                    context.printer.status(format_args!("{path}: {state}, {length:.0} mm, {minutes:.0} min"));
                } else {
                    context.printer.status(format_args!("{path}: {state}"));
                }
            }
            State::Printed(text) => context.printer.result_bytes(text),
            State::Current => {
                context.printer.result_line(format_args!("{path}: {}", phrase("current", "aktuell")));
            }
            State::Outdated | State::Missing => {
                let state = match state {
                    State::Missing => phrase("missing", "fehlt"),
                    _ => phrase("not current", "nicht aktuell"),
                };
                context.printer.result_line(format_args!("{path}: {state}"));
                is_current = false;
            }
        }
    }
    is_current
}
