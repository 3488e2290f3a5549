//! `pathbuild emit`: the files of one or more paths. (spec/05-command-line.md, spec/60-gcode.md)

mod asked;
mod compare;
mod configured;
mod deliver;
mod deps;
mod job;
mod kept;
mod options;
mod stale;
mod write_queue;

use std::collections::HashMap;

use pathbuild_db::Target;
use pathbuild_diagnostic::{Diagnostic, Note};

use crate::args::EmitArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use pathbuild_workspace::posting::{Poster, Wishes, run_post_build};
use pathbuild_workspace::session::{CheckedTarget, Session};

use asked::Asked;
pub(in crate::commands) use configured::Configured;
use deliver::{Delivered, Means, State, Task};
use job::{Job, Maker};
use kept::{Memory, Run};
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
    let memory = Memory::open(context, &session, args, poster);
    let outcome = memory.as_ref().filter(|_| args.check).and_then(|memory| memory.outcome(context, &session));
    if let Some((delivered, mut diagnostics)) = outcome {
        let is_current = show_all(context, &[delivered], &mut diagnostics);
        return conclude(context, session, diagnostics, is_current);
    }
    if memory.is_some() {
        session.note_traces();
    }
    session.prefetch(&args.inputs);
    let made = session.settled(|session| make(context, session, args, poster));
    let Made { asked, checked, jobs, delivered, mut diagnostics } = match made {
        Ok(made) => made,
        Err(refusal) => return context.usage(&refusal),
    };
    let is_current = show_all(context, &delivered, &mut diagnostics);
    if let Some(file) = &args.deps {
        let inserted: Vec<_> = delivered.iter().map(|delivered| delivered.inserted.clone()).collect();
        diagnostics.extend(deps::write(context, &session, file, &jobs, poster, &inserted));
    }
    let (stale, looked) = stale::deal_with(context, &session, &asked, &jobs, poster, args.remove_stale);
    diagnostics.extend(stale);
    if let Some(memory) = memory {
        let (task, covered) = (Task::new(args), &asked.covered);
        memory.keep(
            &session,
            &Run { task, covered, checked, jobs, delivered, diagnostics: &diagnostics, looked },
        );
    }
    conclude(context, session, diagnostics, is_current)
}

/// What came of a run.
struct Made {
    asked: Asked,
    checked: Vec<CheckedTarget>,
    jobs: Vec<Job>,
    delivered: Vec<Delivered>,
    diagnostics: Vec<Diagnostic>,
}

/// Makes the programs, and writes, compares or prints them.
///
/// # Errors
/// Why the arguments make no sense.
fn make(
    context: &Context,
    session: &mut Session<'_>,
    args: &EmitArgs,
    poster: Option<&Poster>,
) -> Result<Made, Box<str>> {
    let task = Task::new(args);
    let mut diagnostics = Vec::new();
    let ask = if args.join.is_some() { Asked::in_order } else { Asked::new };
    let asked = ask(context, session, &args.inputs, &mut diagnostics).ok_or(NOTHING_TO_EMIT)?;
    if task == Task::Print && args.join.is_none() && asked.targets.len() > 1 {
        return Err("`-o -` takes one path: it would be several programs".into());
    }
    let checked = session.check(&asked.targets);
    if let Some(refusal) = options::missing(context, task, &checked) {
        return Err(refusal.into());
    }
    diagnostics.extend(found(session, &checked));
    let maker = Maker { context, session, poster };
    let jobs = match &args.join {
        Some(name) => maker.joined(name, &checked, &mut diagnostics).into_iter().collect(),
        None => maker.jobs(&checked, &mut diagnostics),
    };
    if task == Task::Print && jobs.iter().any(|job| job.files.len() > 1) {
        return Err("`-o -` takes one program: this path has Z-probes and becomes several files".into());
    }
    let means = Means { writing: options::writing(context), poster };
    let delivered = deliver_all(session, &jobs, task, &means);
    Ok(Made { asked, checked, jobs, delivered, diagnostics })
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
        let mut jobs = Maker { context, session, poster }.jobs(&checked, &mut diagnostics);
        jobs.retain(|job| job.claim(session, owners, &mut diagnostics));
        let means = Means { writing: options::writing(context), poster };
        let delivered = deliver_all(session, &jobs, task, &means);
        show_all(context, &delivered, &mut diagnostics);
        diagnostics
    })
}

const NOTHING_TO_EMIT: &str = "nothing to emit: name drawings, paths or directories, or set `library` and `[emit] targets` in pathbuild.toml";

/// What is wrong with the paths, and with the drawings that they are made from.
fn found(session: &Session<'_>, checked: &[CheckedTarget]) -> Vec<Diagnostic> {
    let files = checked.iter().flat_map(|checked| &checked.files);
    let mut found: Vec<Diagnostic> =
        files.flat_map(|file| pathbuild_db::check_file(session.db(), *file)).cloned().collect();
    found.extend(checked.iter().flat_map(|checked| &checked.diagnostics).cloned());
    found
}

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
