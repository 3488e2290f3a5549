//! The parameters in force for each element of a path, with their sources.

use std::fmt::Write;

use pathbuild_db::{Database, SourceFile, drawn_path, file_index, in_force};
use pathbuild_diagnostic::{Point, shown};
use pathbuild_path::{ElementParameters, Parameter, PathName, Position, Provider};
use pathbuild_workspace::config::Origin;
use serde_json::{Value as Json, json};

use super::{OutputItem, handle, named};
use crate::args::Format;
use crate::context::Context;

/// The parameters of a path: a table, or one JSON object per element.
pub(super) fn shown(context: &Context, db: &Database, file: SourceFile, path: &PathName) -> Vec<OutputItem> {
    let index = file_index(db, file).path(path);
    let Some((index, drawn)) = index.zip(drawn_path(db, file, path)) else { return Vec::new() };
    let positions = drawn.positions.positions();
    let elements = in_force(db, file, path, &index.examples, true);
    let placed =
        elements.iter().filter_map(|element| Some((element, *positions.get(element.origin.id.0 as usize)?)));
    let file = file.path(db);
    match context.format {
        Format::Json => {
            let name = context.file(file);
            placed.map(|(element, at)| OutputItem::Row("element", object(&name, path, element, at))).collect()
        }
        _ => vec![OutputItem::Lines(table(context, file.as_str(), path, placed))],
    }
}

fn table<'a>(
    context: &Context,
    file: &str,
    path: &PathName,
    elements: impl Iterator<Item = (&'a ElementParameters, Position)>,
) -> String {
    let title = context.choose("parameters of path", "Parameter des Pfads");
    let mut text = format!("{}: {title} {}\n", shown::line(file), shown::line(path.as_str()));
    for (ElementParameters { origin, what, parameters }, position) in elements {
        let element = named(origin.entity.name(), position);
        let at = context.choose("at", "bei");
        let Point { x, y } = origin.point;
        _ = writeln!(text, "  {element} {at} ({x}, {y}): {}", what.in_lang(context.lang()));
        for Parameter { letter, value, from } in parameters {
            let value = shown::line(value);
            _ = writeln!(text, "    {} {value:<12} {}", letter.as_char(), source(context, from));
        }
    }
    text
}

/// Describes the source of a parameter.
fn source(context: &Context, from: &Provider) -> String {
    let word = from.word().in_lang(context.lang());
    match from {
        Provider::Option(name) => option(context, word, name),
        Provider::Lender(path) => format!("{word}: {}", shown::line(path.as_str())),
        _ => word.to_owned(),
    }
}

/// The configuration key or option that sets a value.
fn option(context: &Context, word: &str, name: &str) -> String {
    match context.settings.origin_of_option(name) {
        Origin::File(line) => context
            .choose("`{name}` in pathbuild.toml, line {line}", "`{name}` in pathbuild.toml, Zeile {line}")
            .replace("{name}", name)
            .replace("{line}", &line.to_string()),
        Origin::Default | Origin::CommandLine(_) => format!("{word} --{name}"),
    }
}

fn object(file: &str, path: &PathName, element: &ElementParameters, position: Position) -> Json {
    let ElementParameters { origin, what, parameters } = element;
    let parameter = |Parameter { letter, value, from }: &Parameter| json!({ "letter": letter.as_char(), "value": value.as_str(), "from": from.name(), "which": from.which() });
    json!({
        "file": file,
        "line": position.line,
        "path": path.as_str(),
        "entity": origin.entity.name(),
        "handle": handle(position.handle),
        "layer": origin.layer.as_str(),
        "x": origin.point.x.0,
        "y": origin.point.y.0,
        "element": what.en,
        "parameters": parameters.iter().map(parameter).collect::<Vec<_>>(),
    })
}
