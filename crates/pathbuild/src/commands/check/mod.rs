//! `pathbuild check`: every path of drawings, paths or the library. Writes nothing. (spec/05-command-line.md)

mod drawings;
mod kept;
mod since;

use std::collections::HashSet;
use std::time::Instant;

use pathbuild_db::SourceFile;

pub(super) use drawings::check_drawings;

use self::drawings::{Asked, check_paths};
use crate::args::CheckArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::report::{Checked, CheckedFile, conclude};
use pathbuild_workspace::session::timings::FINDING;
use pathbuild_workspace::session::{DrawingResult, Session, Wanted, WantedPath, by_place};

/// Runs the command.
pub fn run(context: &Context, args: &CheckArgs) -> ExitStatus {
    let begun = Instant::now();
    if args.inputs.inputs.is_empty() && !context.has_library() {
        return context.nothing_named("check");
    }
    if context.keeps_results() || args.changed_since.is_some() {
        let mut session = session(Session::traced(context), args);
        if let Some(found) = session.timings().measure(&FINDING, || session.directories_only(&args.inputs)) {
            let checked = kept::check(context, &mut session, args, found);
            let status = match checked {
                Ok(checked) => finish(context, args, &mut session, checked, begun),
                Err(reason) => context.usage(&reason),
            };
            leave(session);
            return status;
        }
        if args.changed_since.is_some() {
            return context.usage(
                "--changed-since looks at directories or the library, not at single drawings or paths",
            );
        }
    }
    let mut session = session(Session::new(context), args);
    session.prefetch(&args.inputs);
    let checked = session.settled(|session| {
        let wanted = session.timings().measure(&FINDING, || session.wanted(&args.inputs));
        check(session, wanted, args.all_bindings)
    });
    let status = finish(context, args, &mut session, checked, begun);
    leave(session);
    status
}

fn session<'a>(session: Session<'a>, args: &CheckArgs) -> Session<'a> {
    if args.timings {
        session.timings().switch_on();
    }
    session
}

/// The run is over: to take a million values apart would take longer than to end.
fn leave<T>(over: T) {
    std::mem::forget(over);
}

/// What is asked of the drawings, for telling results of other runs apart.
pub(super) fn question(args: &CheckArgs) -> String {
    format!("check {}", args.all_bindings)
}

fn finish(
    context: &Context,
    args: &CheckArgs,
    session: &mut Session<'_>,
    mut checked: Checked,
    begun: Instant,
) -> ExitStatus {
    checked.diagnostics = session.with_elsewhere(checked.diagnostics);
    checked.time = begun.elapsed();
    let status = conclude(context, args, checked);
    if args.timings {
        for line in session.timings().lines(context.lang()) {
            context.printer.status(line);
        }
    }
    status
}

fn check(session: &mut Session<'_>, wanted: Wanted, with_all_values: bool) -> Checked {
    session.know_names(&wanted.listings);
    leave(wanted.listings);
    let whole: Vec<SourceFile> = wanted.drawings.iter().map(|drawing| drawing.file).collect();
    let mut asked: Vec<Asked> = whole.iter().map(|file| Asked { file: *file, names: None }).collect();
    asked.extend(single_paths(wanted.paths, &whole));
    let found = check_paths(session, &asked, with_all_values);
    let files = asked.iter().map(|asked| asked.file);
    let mut checked = Checked { diagnostics: wanted.problems, ..Checked::default() };
    checked.files.reserve(found.len());
    for (file, (DrawingResult { names, diagnostics }, _)) in files.zip(found) {
        checked.files.push(CheckedFile { file: file.path(session.db()).clone(), paths: names });
        checked.diagnostics.extend(diagnostics);
    }
    checked.files.sort_by(|a, b| by_place(&a.file, &b.file));
    checked.diagnostics.extend(session.q_projects(&whole));
    checked
}

/// The paths that were named by themselves, drawing by drawing, without those of drawings that are checked as a whole.
fn single_paths(paths: Vec<WantedPath>, whole: &[SourceFile]) -> Vec<Asked> {
    if paths.is_empty() {
        return Vec::new();
    }
    let is_whole: HashSet<SourceFile> = whole.iter().copied().collect();
    let mut single: Vec<Asked> = Vec::new();
    for WantedPath { file, name } in paths.into_iter().filter(|path| !is_whole.contains(&path.file)) {
        match single.iter_mut().find(|asked| asked.file == file) {
            Some(asked) => asked.names.get_or_insert_default().push(name),
            None => single.push(Asked { file, names: Some(vec![name]) }),
        }
    }
    single
}
