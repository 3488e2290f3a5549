//! `pathbuild emit`: writes the programs of paths. (book: reference/commands, book: program/gcode)

use std::collections::{BTreeMap, BTreeSet};

use camino::Utf8Path;
use pathbuild_diagnostic::{Code, Diagnostic, EntityKind, Lang, Note};
use pathbuild_workspace::emit::{Emission, ProgramOutcome, Request, State, Task};
use pathbuild_workspace::post_processor::{PostArguments, run_post_build};

use crate::args::EmitArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::render::Format;
use crate::text::count;
use serde_json::{Value, json};

/// Runs the command: writes the files, or with `--check` compares them, and reports findings and outcomes.
pub fn run(context: &Context, args: &EmitArgs) -> ExitStatus {
    let request = Request {
        inputs: &args.inputs,
        task: task(args),
        post: args.post.as_deref(),
        post_arguments: PostArguments {
            date: args.date.map(|date| date.to_string().into()),
            dialect: args.dialect.as_deref().map(Into::into),
            run_post_build: args.run_post_build,
        },
        join: args.join.as_deref(),
        deps: args.deps.as_deref(),
        removes_stale: args.remove_stale,
    };
    let mut session = request.session(context);
    let emission = request.run(&mut session);
    // Leak instead of dropping: freeing all query results takes a twelfth of the time of a short run.
    std::mem::forget(session);
    match emission {
        Ok(emission) => conclude(context, request.task, emission),
        Err(failure) => context.failed(failure),
    }
}

fn task(args: &EmitArgs) -> Task {
    if args.check {
        Task::Compare { moves_only: args.moves }
    } else if args.output.is_some() {
        Task::Print
    } else {
        Task::Write { force: args.force }
    }
}

/// Shows findings and the outcome of all files, and returns the exit status.
fn conclude(context: &Context, task: Task, emission: Emission) -> ExitStatus {
    let Emission { delivered, removed, outdated, mut diagnostics } = emission;
    let mut is_current = show_all(context, &delivered);
    if matches!(task, Task::Compare { .. }) {
        is_current &= outdated.is_empty();
        for path in &outdated {
            context.json_row(|| row(context, path, &State::Outdated, None, false));
            show_state(context, path, &State::Outdated);
        }
    }
    diagnostics.extend(post_builds(&delivered));
    let left_out = left_out(&diagnostics);
    for path in removed {
        let removed = context.choose("stale, removed", "veraltet, entfernt");
        context.printer.status(format_args!("{path}: {removed}"));
    }
    let findings = context.findings(diagnostics);
    context.show(&findings);
    if matches!(task, Task::Compare { .. }) {
        count_current(context, &delivered, outdated.len());
    }
    if !left_out.is_empty() {
        let label = context.choose("not milled", "nicht gefräst");
        context.printer.status(format_args!("{label}: {}", left_out.join("; ")));
    }
    if findings.errors() > 0 || !is_current { ExitStatus::Errors } else { ExitStatus::Success }
}

/// Returns a line for each path that has entities on its layer which are not part of its program. The line counts them by type.
fn left_out(diagnostics: &[Diagnostic]) -> Vec<String> {
    let curves = diagnostics.iter().filter(|found| found.code() == Code::UnsupportedCurve);
    let curves: BTreeSet<_> = curves.map(|found| (&found.path, &found.file, &found.place)).collect();
    let mut counts: BTreeMap<_, BTreeMap<&str, usize>> = BTreeMap::new();
    for (path, file, place) in curves {
        let name = path.as_deref().or_else(|| file.as_ref().and_then(|file| file.file_name()));
        let kind = place.entity.map_or("", EntityKind::name);
        *counts.entry(name.unwrap_or_default()).or_default().entry(kind).or_default() += 1;
    }
    let entities = |kinds: &BTreeMap<&str, usize>| {
        kinds.iter().map(|(kind, count)| format!("{count} {kind}")).collect::<Vec<_>>().join(", ")
    };
    counts.iter().map(|(path, kinds)| format!("{} ({path})", entities(kinds))).collect()
}

/// Shows the outcome of all files, and the notes of post-processors. Returns whether all files are up to date.
pub(super) fn show_all(context: &Context, delivered: &[ProgramOutcome]) -> bool {
    let mut is_current = true;
    let mut notes: Vec<&Note> = Vec::new();
    for delivered in delivered {
        is_current &= show(context, delivered);
        notes.extend(delivered.notes.iter().filter(|note| !notes.contains(note)).collect::<Vec<_>>());
    }
    for note in notes {
        context.printer.status(format_args!("{}", note.text(context.lang())));
    }
    is_current
}

/// Runs the commands that post-processors request for their output. Returns the errors.
fn post_builds(delivered: &[ProgramOutcome]) -> Vec<Diagnostic> {
    let commands = delivered.iter().filter_map(|delivered| {
        delivered.post_build.as_ref().filter(|(_, file)| delivered.has_written(file))
    });
    commands
        .filter_map(|(command, file)| run_post_build(command, file).err())
        .map(|failure| *failure)
        .collect()
}

/// Shows the outcome of a program's files. Returns whether all of them are up to date.
fn show(context: &Context, delivered: &ProgramOutcome) -> bool {
    let mut is_current = true;
    for (index, (path, state)) in delivered.files.iter().enumerate() {
        let phrase = |en, de| context.choose(en, de);
        // Only the first file, the program, gets a length; the files of its probes have none.
        context.json_row(|| row(context, path, state, Some(delivered), index == 0));
        match state {
            State::Written | State::Unchanged => {
                let state = match state {
                    State::Written => phrase("written", "geschrieben"),
                    _ => phrase("unchanged", "unverändert"),
                };
                if index == 0 {
                    let (length, minutes) = (delivered.length, delivered.minutes);
                    context.printer.status(format_args!("{path}: {state}, {length:.0} mm, {minutes:.0} min"));
                } else {
                    context.printer.status(format_args!("{path}: {state}"));
                }
            }
            State::Printed(text) => context.printer.result_bytes(text),
            State::Current | State::Outdated | State::Missing => {
                show_state(context, path, state);
                is_current &= matches!(state, State::Current);
            }
        }
    }
    is_current
}

/// Reports how many files are up to date.
fn count_current(context: &Context, delivered: &[ProgramOutcome], outdated: usize) {
    let states = || delivered.iter().flat_map(|delivered| &delivered.files);
    let current = states().filter(|(_, state)| matches!(state, State::Current)).count();
    let (all, lang) = (states().count() + outdated, context.lang());
    context.output.add_figure("current", current);
    context.output.add_figure("not_current", all - current);
    let [current, others] = [current, all - current].map(|number| count(number, lang));
    context.printer.status(match lang {
        Lang::En => format!("{current} current, {others} not current"),
        Lang::De => format!("{current} aktuell, {others} nicht aktuell"),
    });
}

fn row(
    context: &Context,
    path: &Utf8Path,
    state: &State,
    delivered: Option<&ProgramOutcome>,
    is_program: bool,
) -> (&'static str, Value) {
    let state = match state {
        State::Written => "written",
        State::Unchanged => "unchanged",
        State::Current => "current",
        State::Outdated => "stale",
        State::Missing => "missing",
        State::Printed(_) => "printed",
    };
    let program = delivered.filter(|_| is_program);
    let (length, minutes) = (program.map(|outcome| outcome.length), program.map(|outcome| outcome.minutes));
    let (file, path) = (context.file(path), delivered.map(|outcome| &*outcome.path));
    ("output", json!({ "file": file, "path": path, "state": state, "length": length, "minutes": minutes }))
}

/// Shows the result of comparing a file; files that are up to date are shown with `-v` only.
fn show_state(context: &Context, path: &Utf8Path, state: &State) {
    if context.format == Format::Json {
        return;
    }
    if matches!(state, State::Current) {
        let current = context.choose("current", "aktuell");
        return context.printer.detail(format_args!("{path}: {current}"));
    }
    let state = match state {
        State::Missing => context.choose("missing", "fehlt"),
        _ => context.choose("not current", "nicht aktuell"),
    };
    context.printer.result_line(format_args!("{path}: {state}"));
}
