//! `pathbuild texts`: shows the element that each parameter text belongs to, and the parameters in force for each element. (book:
//! language/parameter-texts)

use std::fmt::Write;

use pathbuild_db::{
    Database, SourceFile, assigned_texts, drawn_path, effective_parameters, file_index, path_names,
};
use pathbuild_diagnostic::{Diagnostic, Handle, Number, Point, escaping};
use pathbuild_path::{
    AssignedElement, AssignedText, Curve, ElementParameters, Parameter, PathName, Position, Provider, Shape,
    TextCircle, Xy,
};
use pathbuild_workspace::config::{self, Origin};
use pathbuild_workspace::session::Session;
use regex::Regex;
use serde_json::{Value as Json, json};

use crate::args::TextsArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::render::Format;

/// Runs the command: prints the texts, and reports errors of their drawings.
pub fn run(context: &Context, args: &TextsArgs) -> ExitStatus {
    let pattern = args.pattern.as_deref().map(|pattern| config::regex("match", pattern)).transpose();
    let pattern = match pattern {
        Ok(pattern) => pattern.and_then(|pattern| Regex::new(pattern).ok()),
        Err(fault) => return context.refuse(vec![*fault]),
    };
    let mut session = Session::new(context);
    if args.inputs.is_empty() && !session.has_library() {
        return context.refuse_empty_input();
    }
    let (texts, problems) =
        session.with_stable_files(|session| texts(context, session, args, pattern.as_ref()));
    for shown in texts {
        match shown {
            OutputItem::Row(kind, row) => context.row(kind, row),
            OutputItem::Lines(lines) => context.printer.result(lines),
        }
    }
    context.conclude(problems)
}

/// A text, or the parameters of an element, as printed.
enum OutputItem {
    /// A row of the JSON document: its type and its values.
    Row(&'static str, Json),
    /// Lines of plain text.
    Lines(String),
}

/// Returns everything to show about each text, and the diagnostics of drawings and arguments.
fn texts(
    context: &Context,
    session: &Session<'_>,
    args: &TextsArgs,
    pattern: Option<&Regex>,
) -> (Vec<OutputItem>, Vec<Diagnostic>) {
    let selection = session.select(&args.inputs.to_inputs());
    let whole = selection.whole_drawings(session).into_iter().map(|file| (file, None));
    let parts = selection.paths.iter().map(|path| (path.file, Some(&path.name)));
    let mut problems = selection.problems;
    let db = session.db();
    let mut shown = Vec::new();
    for (file, path) in whole.chain(parts) {
        problems.extend(session.errors_without_paths(file).cloned());
        let is_wanted = |text: &&AssignedText| {
            path.is_none_or(|path| text.path == *path)
                && pattern.is_none_or(|pattern| pattern.is_match(&text.text))
        };
        let name = file.path(db).as_str();
        let of_whole = path.is_none().then(|| path_names(db, file)).into_iter().flatten();
        // With `--match`, the tables of parameters are not shown.
        let paths = of_whole.chain(path).filter(|_| pattern.is_none());
        shown.extend(assigned_texts(db, file).iter().filter(is_wanted).map(|text| match context.format {
            Format::Json => OutputItem::Row("text", object(&context.file(file.path(db)), text)),
            _ => OutputItem::Lines(format_text(context, name, text)),
        }));
        shown.extend(paths.flat_map(|path| table_of(context, db, file, path)));
    }
    (shown, session.with_hints(problems))
}

/// Formats a text in a few lines: its content, its place, and the elements that it belongs to.
fn format_text(context: &Context, file: &str, text: &AssignedText) -> String {
    let TextCircle { centre, radius } = text.circle;
    let layer = context.choose("layer", "Layer");
    let [file, of_layer] = [file, &text.layer].map(escaping::line);
    let mut shown = format!("{file}:{}: {:?}\n", text.position.line, text.text);
    _ = writeln!(
        shown,
        "  {}, {layer} {}, {} {}, {} {}",
        element_name(text.entity.name(), text.position),
        of_layer,
        context.choose("circle around", "Kreis um"),
        point(centre),
        context.choose("diameter", "Durchmesser"),
        Number(2.0 * radius).prose(context.lang()),
    );
    for element in &text.elements {
        let AssignedElement { entity, line_type, position, shape } = element;
        let (named, geometry) = (element_name(entity.name(), *position), geometry(context, shape));
        _ = writeln!(shown, "  -> {named}, {layer} {of_layer}, {}, {geometry}", escaping::line(line_type));
    }
    if text.elements.is_empty() {
        _ = writeln!(shown, "  -> {}", context.choose("nothing (PB107)", "nichts (PB107)"));
    }
    shown
}

/// Names an element by its handle, as in `LINE 1F`, or else by its line in the file, as in `LINE :120`.
fn element_name(entity: &str, position: Position) -> String {
    match position.handle {
        Some(handle) => format!("{entity} {handle}"),
        None => format!("{entity} :{}", position.line),
    }
}

fn geometry(context: &Context, shape: &Shape) -> String {
    let [from, to] = [context.choose("from", "von"), context.choose("to", "bis")];
    let [centre, diameter] =
        [context.choose("centre", "Mittelpunkt"), context.choose("diameter", "Durchmesser")];
    match shape {
        Shape::Circle { centre: at, radius } => {
            format!("{centre} {}, {diameter} {}", point(*at), Number(2.0 * radius).prose(context.lang()))
        }
        Shape::Curve(curve) => {
            let ends = format!("{from} {} {to} {}", point(curve.start()), point(curve.end()));
            match curve {
                Curve::Line(_) => ends,
                Curve::Arc(arc) => {
                    format!(
                        "{ends}, {centre} {}, {diameter} {}",
                        point(arc.centre),
                        Number(2.0 * arc.radius).prose(context.lang())
                    )
                }
            }
        }
    }
}

fn point(point: Xy) -> String {
    format!("({}, {})", Number(point.x), Number(point.y))
}

fn object(file: &str, text: &AssignedText) -> Json {
    json!({
        "file": file,
        "line": text.position.line,
        "text": text.text,
        "entity": text.entity.name(),
        "path": text.path.as_str(),
        "layer": text.layer,
        "handle": handle(text.position.handle),
        "x": text.circle.centre.x,
        "y": text.circle.centre.y,
        "diameter": 2.0 * text.circle.radius,
        "elements": text.elements.iter().map(element).collect::<Vec<_>>(),
    })
}

fn element(element: &AssignedElement) -> Json {
    let pair = |point: Xy| json!([point.x, point.y]);
    let (from, to, circle) = match element.shape {
        Shape::Circle { centre, radius } => (None, None, Some((centre, radius))),
        Shape::Curve(Curve::Line(line)) => (Some(line.start), Some(line.end), None),
        Shape::Curve(Curve::Arc(arc)) => (Some(arc.start), Some(arc.end), Some((arc.centre, arc.radius))),
    };
    json!({
        "entity": element.entity.name(),
        "line": element.position.line,
        "handle": handle(element.position.handle),
        "line_type": element.line_type,
        "from": from.map(pair),
        "to": to.map(pair),
        "centre": circle.map(|(centre, _)| pair(centre)),
        "diameter": circle.map(|(_, radius)| 2.0 * radius),
    })
}

fn handle(handle: Option<Handle>) -> Option<String> {
    handle.map(|handle| handle.to_string())
}

/// Returns the parameters of a path: as a table, or as one JSON row per element.
fn table_of(context: &Context, db: &Database, file: SourceFile, path: &PathName) -> Vec<OutputItem> {
    let index = file_index(db, file).path(path);
    let Some((index, drawn)) = index.zip(drawn_path(db, file, path)) else { return Vec::new() };
    let positions = drawn.positions.positions();
    let elements = effective_parameters(db, file, path, &index.examples, true);
    let placed =
        elements.iter().filter_map(|element| Some((element, *positions.get(element.origin.id.0 as usize)?)));
    let file = file.path(db);
    match context.format {
        Format::Json => {
            let name = context.file(file);
            placed
                .map(|(element, at)| OutputItem::Row("element", parameters_json(&name, path, element, at)))
                .collect()
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
    let mut text = format!("{}: {title} {}\n", escaping::line(file), escaping::line(path.as_str()));
    for (ElementParameters { origin, what, parameters }, position) in elements {
        let element = element_name(origin.entity.name(), position);
        let at = context.choose("at", "bei");
        let Point { x, y } = origin.point;
        _ = writeln!(text, "  {element} {at} ({x}, {y}): {}", what.in_lang(context.lang()));
        for Parameter { letter, value, from } in parameters.iter() {
            let value = escaping::line(value);
            _ = writeln!(text, "    {} {value:<12} {}", letter.as_char(), source(context, from));
        }
    }
    text
}

fn source(context: &Context, from: &Provider) -> String {
    let word = from.word().in_lang(context.lang());
    match from {
        Provider::Option(name) => option(context, word, name),
        Provider::Lender(path) => format!("{word}: {}", escaping::line(path.as_str())),
        _ => word.to_owned(),
    }
}

/// Returns the configuration key or the option that sets a value.
fn option(context: &Context, word: &str, name: &str) -> String {
    match context.settings.origin_of_option(name) {
        Origin::File(line) | Origin::Extended { line, .. } => context
            .choose("`{name}` in pathbuild.toml, line {line}", "`{name}` in pathbuild.toml, Zeile {line}")
            .replace("{name}", name)
            .replace("{line}", &line.to_string()),
        Origin::Default | Origin::CommandLine(_) => format!("{word} --{name}"),
    }
}

fn parameters_json(file: &str, path: &PathName, element: &ElementParameters, position: Position) -> Json {
    let ElementParameters { origin, what, parameters } = element;
    let parameter = |Parameter { letter, value, from }: &Parameter| json!({ "letter": letter.as_char(), "value": value.as_str(), "from": from.name(), "which": from.provider_name() });
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
