//! `pathbuild emit`: writes the programs of paths. (book: reference/commands, book: program/gcode)

use std::collections::BTreeMap;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_api::{EmitOptions, EmitReport, FileState, LeftOutElements, OutputFile, PostBuild};
use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_workspace::findings::Findings;
use pathbuild_workspace::post_processor::run_post_build;
use serde_json::{Value, json};

use crate::args::EmitArgs;
use crate::context::{Context, for_rendering};
use crate::exit::ExitStatus;
use crate::render::Format;
use crate::text::format_count;

/// Runs the command: writes the files, or with `--check` compares them, and reports findings and outcomes.
pub fn run(context: &Context, args: &EmitArgs) -> ExitStatus {
    let options = options(args);
    match context.library().and_then(|library| library.emit(&args.inputs.to_inputs().texts(), &options)) {
        Ok(report) => conclude(context, args, report),
        Err(error) => context.show_request_error(error),
    }
}

/// A method that switches an option on.
type Switch = fn(EmitOptions) -> EmitOptions;

fn options(args: &EmitArgs) -> EmitOptions {
    let mut options = EmitOptions::new();
    options = args.post.iter().fold(options, EmitOptions::post);
    options = args.join.iter().fold(options, EmitOptions::join);
    options = args.deps.iter().fold(options, |options, file| options.deps(file.as_str()));
    options = args.date.iter().fold(options, |options, date| options.date(date.to_string()));
    options = args.dialect.iter().fold(options, EmitOptions::dialect);
    let switches: [(bool, Switch); 6] = [
        (args.check, EmitOptions::compare),
        (args.moves, EmitOptions::compare_moves),
        (args.output.is_some(), EmitOptions::print),
        (args.force, EmitOptions::force),
        (args.remove_stale, EmitOptions::remove_stale),
        (args.run_post_build, EmitOptions::post_builds),
    ];
    switches
        .into_iter()
        .filter(|(is_given, _)| *is_given)
        .fold(options, |options, (_, switch)| switch(options))
}

/// Shows findings and the outcome of all files, and returns the exit status.
fn conclude(context: &Context, args: &EmitArgs, report: EmitReport) -> ExitStatus {
    let EmitReport { files, findings, accepted, notes, left_out, removed, outdated, post_builds, .. } =
        report;
    let outdated = if args.check { outdated } else { Vec::new() };
    let is_current = show_all(context, &files, &notes) && outdated.is_empty();
    for file in &outdated {
        show(context, file, FileState::Outdated, None);
    }
    let failed = run_post_builds(&post_builds);
    for path in removed {
        let removed = context.choose("stale, removed", "veraltet, entfernt");
        context.printer.status(format_args!("{path}: {removed}"));
    }
    let programs = files.iter().map(|output| &output.file).chain(&outdated).map(Utf8PathBuf::from);
    let mut findings = Findings { programs: programs.collect(), ..for_rendering(findings, accepted) };
    if !failed.is_empty() {
        findings.diagnostics.extend(context.findings(failed).diagnostics);
        findings.diagnostics = Findings::new(findings.diagnostics).diagnostics;
    }
    context.show(&findings);
    if args.check {
        report_current_count(context, &files, outdated.len());
    }
    if !left_out.is_empty() {
        let label = context.choose("not milled", "nicht gefräst");
        context.printer.status(format_args!("{label}: {}", left_out_text(&left_out)));
    }
    if findings.error_count() > 0 || !is_current { ExitStatus::Errors } else { ExitStatus::Success }
}

/// Lists the elements on layers of paths that are not part of their programs, counted by type.
fn left_out_text(left_out: &[LeftOutElements]) -> String {
    let mut counts: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for LeftOutElements { path, entity, count, .. } in left_out {
        counts.entry(path).or_default().push(format!("{count} {entity}"));
    }
    let paths = counts.iter().map(|(path, counts)| format!("{} ({path})", counts.join(", ")));
    paths.collect::<Vec<_>>().join("; ")
}

/// Runs the commands that post-processors request for their output. Returns the errors.
fn run_post_builds(post_builds: &[PostBuild]) -> Vec<Diagnostic> {
    let run = |build: &PostBuild| run_post_build(&build.command, Utf8Path::new(&build.file)).err();
    post_builds.iter().filter_map(run).map(|failure| *failure).collect()
}

/// Shows the outcome of all files, and the notes of post-processors. Returns whether all files are up to date.
pub(super) fn show_all(context: &Context, files: &[OutputFile], notes: &[String]) -> bool {
    let mut is_current = true;
    for file in files {
        is_current &= show(context, &file.file, file.state, Some(file));
    }
    for note in notes {
        context.printer.status(note);
    }
    is_current
}

/// Shows the outcome of a file, which is one of an earlier run without `output`. Returns whether it is up to date.
fn show(context: &Context, file: &str, state: FileState, output: Option<&OutputFile>) -> bool {
    context.json_row(|| row(context, file, state, output));
    let label = match state {
        FileState::Written => context.choose("written", "geschrieben"),
        FileState::Overwritten => context.choose(
            "written over an edited file (give edited programs a name of their own)",
            "über eine bearbeitete Datei geschrieben (bearbeiteten Programmen einen eigenen Namen geben)",
        ),
        FileState::Unchanged => context.choose("unchanged", "unverändert"),
        FileState::Current | FileState::Outdated | FileState::Missing => {
            show_state(context, file, state);
            return state == FileState::Current;
        }
        _ => {
            if let Some(text) = output.and_then(|output| output.text.as_ref()) {
                context.printer.result_bytes(text);
            }
            return true;
        }
    };
    // Only the program itself gets a length; the files that belong to it have none.
    match output.filter(|output| output.is_program) {
        Some(OutputFile { length, minutes, .. }) => {
            context.printer.status(format_args!("{file}: {label}, {length:.0} mm, {minutes:.0} min"));
        }
        None => context.printer.status(format_args!("{file}: {label}")),
    }
    true
}

/// Reports how many files are up to date.
fn report_current_count(context: &Context, files: &[OutputFile], outdated: usize) {
    let current = files.iter().filter(|file| file.state == FileState::Current).count();
    let (all, lang) = (files.len() + outdated, context.lang());
    context.output.add_figure("current", current);
    context.output.add_figure("not_current", all - current);
    let [current, others] = [current, all - current].map(|number| format_count(number, lang));
    context.printer.status(match lang {
        Lang::En => format!("{current} current, {others} not current"),
        Lang::De => format!("{current} aktuell, {others} nicht aktuell"),
    });
}

fn row(
    context: &Context,
    file: &str,
    state: FileState,
    output: Option<&OutputFile>,
) -> (&'static str, Value) {
    let state = match state {
        FileState::Written | FileState::Overwritten => "written",
        FileState::Unchanged => "unchanged",
        FileState::Current => "current",
        FileState::Outdated => "stale",
        FileState::Missing => "missing",
        _ => "printed",
    };
    let program = output.filter(|output| output.is_program);
    let (length, minutes) = (program.map(|program| program.length), program.map(|program| program.minutes));
    let (file, path) = (context.file(file.as_ref()), output.map(|output| &output.path));
    ("output", json!({ "file": file, "path": path, "state": state, "length": length, "minutes": minutes }))
}

/// Shows the result of comparing a file; files that are up to date are shown with `-v` only.
fn show_state(context: &Context, file: &str, state: FileState) {
    if context.format == Format::Json {
        return;
    }
    if state == FileState::Current {
        let current = context.choose("current", "aktuell");
        return context.printer.detail(format_args!("{file}: {current}"));
    }
    let state = match state {
        FileState::Missing => context.choose("missing", "fehlt"),
        _ => context.choose("not current", "nicht aktuell"),
    };
    context.printer.result_line(format_args!("{file}: {state}"));
}
