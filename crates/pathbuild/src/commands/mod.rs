//! The commands. Each has a module with a function `run(&Context, &Args)`, which returns the exit status, or a `Failure` that ends the command.

pub mod adjust;
pub mod cache;
pub mod check;
pub(crate) mod compat;
pub mod completions;
pub mod config;
pub mod diff;
pub mod emit;
pub mod explain;
pub mod graph;
pub mod import;
pub mod init;
pub mod list;
pub mod locate;
pub mod machine;
pub mod man;
mod picture_output;
pub mod post;
pub mod q_project;
pub mod sheet;
pub mod texts;
pub mod verify;
pub mod view;
pub mod watch;
pub mod why;

use camino::Utf8Path;
use pathbuild_db::system::WriteOutcome;
use pathbuild_workspace::Failure;
use serde_json::{Value, json};

use crate::args::Command;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::german;
use crate::render::Format;

/// Returns a JSON row about a file that was written.
fn output_row(context: &Context, file: &Utf8Path, written: WriteOutcome) -> (&'static str, Value) {
    let state = match written {
        WriteOutcome::Changed => "written",
        WriteOutcome::Unchanged => "unchanged",
    };
    ("output", json!({ "file": context.file(file), "state": state }))
}

/// Adds a row about a written file to the JSON document. Returns the file's state as shown to users.
fn report_output(context: &Context, file: &Utf8Path, written: WriteOutcome) -> &'static str {
    context.json_row(|| output_row(context, file, written));
    state_word(context, written)
}

fn state_word(context: &Context, written: WriteOutcome) -> &'static str {
    match written {
        WriteOutcome::Changed => context.choose("written", "geschrieben"),
        WriteOutcome::Unchanged => context.choose("unchanged", "unverändert"),
    }
}

/// Runs a command and returns its exit status.
pub fn run(context: &Context, command: &Command) -> ExitStatus {
    if let Some(refusal) = format_refusal(context, command) {
        return refuse(context, &refusal);
    }
    match command {
        Command::Check(args) => check::run(context, args),
        Command::Emit(args) => emit::run(context, args),
        Command::Adjust(args) => adjust::run(context, args),
        Command::Import(args) => import::run(context, args),
        Command::Verify(args) => status_of(context, verify::run(context, args)),
        Command::Post(args) => post::run(context, args),
        Command::Explain(args) => explain::run(context, args),
        Command::Completions(args) => completions::run(context, args),
        Command::Man => man::run(context),
        Command::Graph(args) => graph::graph(context, args),
        Command::Deps(args) => graph::deps(context, args),
        Command::Rdeps(args) => graph::rdeps(context, args),
        Command::List(args) => list::list(context, args),
        Command::Stats(args) => list::stats(context, args),
        Command::Where(args) => locate::run(context, args),
        Command::Why(args) => why::run(context, args),
        Command::Texts(args) => texts::run(context, args),
        Command::View(args) => status_of(context, view::run(context, args)),
        Command::Sheet(args) => status_of(context, sheet::run(context, args)),
        Command::Diff(args) => status_of(context, diff::run(context, args)),
        Command::QProject(args) => q_project::run(context, args),
        Command::Cache(args) => cache::run(context, args),
        Command::Init(args) => init::run(context, args.example),
        Command::Config(args) => config::run(context, args),
        Command::Machine(args) => machine::run(context, args),
        Command::Watch(_) | Command::Compat(_) => unreachable!("they make their own surroundings"),
    }
}

fn status_of(context: &Context, run: Result<ExitStatus, Failure>) -> ExitStatus {
    run.unwrap_or_else(|failure| context.show_failure(failure))
}

/// Returns an error message if the format is for graphs and the command prints none, or if the format is only for reports.
fn format_refusal(context: &Context, command: &Command) -> Option<String> {
    if context.format == Format::Html {
        let refusal = context.choose(
            "an HTML page is written to a file: give --report html=FILE",
            "eine HTML-Seite wird in eine Datei geschrieben: --report html=DATEI angeben",
        );
        return Some(refusal.to_owned());
    }
    let prints_graph = matches!(command, Command::Graph(_) | Command::Deps(_) | Command::Rdeps(_));
    let is_wrong = !context.format.shows_diagnostics() && !prints_graph;
    is_wrong.then(|| {
        context.phrase(
            "`{}` has no such --format: dot and mermaid are for graph, deps and rdeps",
            "`{}` hat dieses --format nicht: dot und mermaid sind für graph, deps und rdeps",
            command.name(),
        )
    })
}

fn refuse(context: &Context, reason: &str) -> ExitStatus {
    german::print_usage_error(reason, context.lang(), &context.printer)
}
