//! `pathbuild emit`: the files of one or more paths. (spec/05-command-line.md, spec/60-gcode.md)

mod asked;
mod compare;
mod deliver;
mod deps;
mod job;
mod options;
mod stale;

use pathbuild_diagnostic::Diagnostic;

use crate::args::EmitArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::session::{CheckedTarget, Session};

use asked::Asked;
use deliver::{Delivered, State, Task, deliver};

/// Runs the command.
pub fn run(context: &Context, args: &EmitArgs) -> ExitStatus {
    let session = Session::with_hashes(context);
    let mut diagnostics = Vec::new();
    let Some(asked) = Asked::new(context, &session, &args.inputs, &mut diagnostics) else {
        return context.usage(NOTHING_TO_EMIT);
    };
    let task = Task::new(args);
    if task == Task::Print && asked.targets.len() > 1 {
        return context.usage("`-o -` takes one path: it would be several programs");
    }
    let checked = session.check(&asked.targets);
    if let Some(refusal) = options::missing(context, task, &checked) {
        return context.usage(&refusal);
    }
    diagnostics.extend(found(&session, &checked));
    let jobs = job::jobs(context, &session, &checked, &mut diagnostics);
    if task == Task::Print && jobs.iter().any(|job| job.files.len() > 1) {
        return context.usage("`-o -` takes one program: this path has Z-probes and becomes several files");
    }
    let writing = options::writing(context);
    let delivered = session.guarded(&jobs, |db, job| deliver(db, job, task, &writing));
    let mut is_current = true;
    for (delivered, job) in delivered.into_iter().zip(&jobs) {
        let delivered = delivered.unwrap_or_else(|problem| job.given_up(&session, *problem));
        is_current &= show(context, &delivered);
        diagnostics.extend(delivered.problems);
    }
    if let Some(file) = &args.deps {
        diagnostics.extend(deps::write(context, &session, file, &jobs));
    }
    diagnostics.extend(stale::deal_with(context, &session, &asked, &jobs, args.remove_stale));
    let findings = context.findings(session.with_elsewhere(diagnostics));
    context.show(&findings);
    if findings.errors() > 0 || !is_current { ExitStatus::Errors } else { ExitStatus::Success }
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
            State::Printed(text) => context.printer.result(text),
            State::Current => {
                context.printer.result(format_args!("{path}: {}\n", phrase("current", "aktuell")));
            }
            State::Outdated | State::Missing => {
                let state = match state {
                    State::Missing => phrase("missing", "fehlt"),
                    _ => phrase("not current", "nicht aktuell"),
                };
                context.printer.result(format_args!("{path}: {state}\n"));
                is_current = false;
            }
        }
    }
    is_current
}
