//! `pathbuild where`: shows where paths are defined. (book: reference/commands)

use std::cell::LazyCell;

use pathbuild_db::{PathPlace, SourceFile, path_names, path_place};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;
use serde_json::{Value, json};

use crate::args::GraphArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::render::Format;
use pathbuild_workspace::session::{Selection, Session};

/// Runs the command. Prints one line per definition: `1234.1P  components/1234.dxf:153  layer 1234.1P, start at (0, 0)`.
pub fn run(context: &Context, args: &GraphArgs) -> ExitStatus {
    let mut session = Session::new(context);
    if args.inputs.is_empty() && !session.has_library() {
        return context.refuse_empty_input();
    }
    let (found, problems) = session.with_stable_files(|session| {
        let matches = session.match_arguments(&args.inputs.to_inputs());
        let names: Vec<PathName> = matches.names().cloned().collect();
        let selection = session.select_matches(matches);
        let mut problems = selection.problems.clone();
        let found = definitions(session, &names, &selection, &mut problems);
        (found, session.with_hints(problems))
    });
    for (file, place) in found {
        let file = file.path(session.db());
        match context.format {
            Format::Json => context.row("definition", json(&context.file(file), &place)),
            _ => context.printer.result_line(line(context, file.as_str(), &place)),
        }
    }
    context.conclude(problems)
}

/// Returns the definitions of each path. A path that is defined twice, which is an error, is listed at both places.
fn definitions(
    session: &Session<'_>,
    names: &[PathName],
    selection: &Selection,
    problems: &mut Vec<Diagnostic>,
) -> Vec<(SourceFile, PathPlace)> {
    let db = session.db();
    let mut found = Vec::new();
    let directories = LazyCell::new(|| session.name_directories());
    for name in names {
        let files = session.definitions(name, &directories);
        found.extend(files.into_iter().filter_map(|file| Some((file, path_place(db, file, name)?))));
    }
    let files = selection.whole_drawings(session);
    session.parse_ahead(&files);
    for file in files {
        problems.extend(session.errors_without_paths(file).cloned());
        let names = path_names(db, file).iter();
        found.extend(names.filter_map(|name| Some((file, path_place(db, file, name)?))));
    }
    found
}

fn line(context: &Context, file: &str, place: &PathPlace) -> String {
    let line = place.position.map(|position| format!(":{}", position.line)).unwrap_or_default();
    let start = context.choose("start at", "Anfang bei");
    let point = place.point.map(|point| format!(", {start} ({}, {})", point.x, point.y)).unwrap_or_default();
    let layer = context.choose("layer", "Layer");
    format!("{}  {file}{line}  {layer} {}{point}", place.name, place.layer)
}

fn json(file: &str, place: &PathPlace) -> Value {
    json!({
        "path": place.name.as_str(),
        "file": file,
        "line": place.position.map(|position| position.line),
        "layer": &*place.layer,
        "handle": place.position.and_then(|position| position.handle).map(|handle| handle.to_string()),
        "x": place.point.map(|point| point.x.0),
        "y": place.point.map(|point| point.y.0),
    })
}
