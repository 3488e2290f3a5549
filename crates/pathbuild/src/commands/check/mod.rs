//! `pathbuild check`: every path of drawings, paths or the library. Writes nothing. (spec/05-command-line.md)

mod kept;
mod since;

use std::collections::{HashMap, HashSet};
use std::time::Instant;

use pathbuild_db::{Role, SourceFile, Target, check_file, path_names};
use pathbuild_path::PathName;

pub(super) use kept::check_drawings;

use crate::args::CheckArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::report::{Checked, CheckedFile, CheckedPath, conclude};
use crate::session::timings::FINDING;
use crate::session::{CheckedTarget, Session, Wanted};

/// Runs the command.
pub fn run(context: &Context, args: &CheckArgs) -> ExitStatus {
    let begun = Instant::now();
    if args.inputs.inputs.is_empty() && !context.has_library() {
        return context.nothing_named("check");
    }
    if context.keeps_results() || args.changed_since.is_some() {
        let session = Session::traced(context);
        if args.timings {
            session.timings().switch_on();
        }
        if let Some(drawings) = session.timings().measure(&FINDING, || session.directories_only(&args.inputs))
        {
            let checked = kept::check(context, &session, args, drawings);
            let status = match checked {
                Ok(checked) => finish(context, args, &session, checked, begun),
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
    let session = Session::new(context);
    if args.timings {
        session.timings().switch_on();
    }
    let wanted = session.timings().measure(&FINDING, || session.wanted(&args.inputs));
    let checked = check(&session, wanted, args.all_bindings);
    let status = finish(context, args, &session, checked, begun);
    leave(session);
    status
}

/// The run is over: to take a million values apart would take longer than to end.
fn leave<T>(over: T) {
    std::mem::forget(over);
}

/// What is asked of the drawings, for telling results of other runs apart.
pub(super) fn question(args: &CheckArgs) -> String {
    format!("check {} {:?}", args.all_bindings, args.inputs.inputs)
}

fn finish(
    context: &Context,
    args: &CheckArgs,
    session: &Session<'_>,
    mut checked: Checked,
    begun: Instant,
) -> ExitStatus {
    checked.diagnostics = session.with_elsewhere(checked.diagnostics);
    session.tell_scans();
    checked.time = begun.elapsed();
    let status = conclude(context, args, checked);
    if args.timings {
        for line in session.timings().lines(context.lang()) {
            context.printer.status(line);
        }
    }
    status
}

/// A path of a drawing.
type Asked = (SourceFile, PathName);

fn check(session: &Session<'_>, wanted: Wanted, with_all_values: bool) -> Checked {
    let db = session.db();
    let whole: Vec<SourceFile> = wanted.drawings.iter().map(|drawing| drawing.file).collect();
    session.read_ahead(&whole);
    let of_file = |file: SourceFile| path_names(db, file).iter().map(move |name| (file, name.clone()));
    let is_whole: HashSet<SourceFile> = whole.iter().copied().collect();
    let named = wanted.paths.into_iter().filter(|path| !is_whole.contains(&path.file));
    let asked: Vec<Asked> = whole
        .iter()
        .flat_map(|file| of_file(*file))
        .chain(named.map(|path| (path.file, path.name)))
        .collect();
    let mut checked = Checked { diagnostics: wanted.problems, ..Checked::default() };
    let reached = if with_all_values {
        check_all_values(session, &asked, &mut checked)
    } else {
        check_examples(session, &asked, &mut checked)
    };
    checked.diagnostics.extend(session.q_projects(&whole));
    let mut files = [whole, reached].concat();
    files.sort_by(|a, b| a.path(db).cmp(b.path(db)));
    files.dedup();
    let mut names: HashMap<SourceFile, Vec<CheckedPath>> = HashMap::new();
    for (file, name) in &asked {
        names.entry(*file).or_default().push(CheckedPath { name: name.as_str().into(), time: None });
    }
    for file in files {
        checked.diagnostics.extend_from_slice(check_file(db, file));
        let paths = names.remove(&file).unwrap_or_default();
        if !paths.is_empty() || path_names(db, file).is_empty() {
            checked.files.push(CheckedFile { file: file.path(db).clone(), paths });
        }
    }
    checked
}

/// Checks each path with example values; returns the drawings that were reached.
fn check_examples(session: &Session<'_>, asked: &[Asked], checked: &mut Checked) -> Vec<SourceFile> {
    let target = |(file, name): &Asked| Target::new(session.db(), *file, name.as_str().into(), Role::Checked);
    let targets: Vec<Target> = asked.iter().map(target).collect();
    let mut reached = Vec::new();
    for result in session.check(&targets) {
        reached.extend(result.files);
        checked.diagnostics.extend(result.diagnostics);
    }
    reached
}

/// Checks each path with all values; returns the drawings that were reached.
fn check_all_values(session: &Session<'_>, asked: &[Asked], checked: &mut Checked) -> Vec<SourceFile> {
    let combined = |(file, name): &Asked| session.combined_targets(*file, name);
    let (targets, warnings): (Vec<_>, Vec<_>) = asked.iter().map(combined).unzip();
    checked.diagnostics.extend(warnings.into_iter().flatten());
    let mut results = session.check(&targets.concat()).into_iter();
    let mut reached = Vec::new();
    for targets in targets {
        let results: Vec<CheckedTarget> = results.by_ref().take(targets.len()).collect();
        checked.diagnostics.extend(session.merged(&results));
        reached.extend(results.into_iter().flat_map(|result| result.files));
    }
    reached
}
