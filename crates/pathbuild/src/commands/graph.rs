//! `pathbuild graph`, `deps` and `rdeps`: show which path embeds which. (book: reference/commands)

use std::borrow::Cow;
use std::fmt::Write;

use pathbuild_diagnostic::{Code, Lang, Text, escaping};
use pathbuild_path::{Bindings, PathName};
use pathbuild_workspace::session::{Direction, Embedding, EmbeddingEnd, Graph, GraphOutcome, Node, Session};
use serde_json::{Map, Value, json};

use crate::args::GraphArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::render::Format;

/// Runs `graph`: lists all embeddings of the given paths, or of the library's paths if no arguments are given.
pub fn graph(context: &Context, args: &GraphArgs) -> ExitStatus {
    show(context, args, list)
}

/// Runs `deps`: shows the paths that the given ones embed, level by level.
pub fn deps(context: &Context, args: &GraphArgs) -> ExitStatus {
    show(context, args, |graph, lang| tree(graph, Direction::Down, lang))
}

fn show(context: &Context, args: &GraphArgs, text: impl Fn(&Graph, Lang) -> String) -> ExitStatus {
    let mut session = Session::new(context);
    if args.inputs.is_empty() && !session.has_library() {
        return context.refuse_empty_input();
    }
    let outcome = session.embedded_paths(&args.inputs.to_inputs());
    print(context, &outcome.graph, text);
    finish(context, outcome)
}

/// Runs `rdeps`: shows the paths that embed the given ones, level by level. All paths of the library are searched; without a library,
/// those in and below the working directory.
pub fn rdeps(context: &Context, args: &GraphArgs) -> ExitStatus {
    if args.inputs.is_empty() {
        return context.usage_error(
            context.choose("name drawings or paths for rdeps", "für rdeps Zeichnungen oder Pfade nennen"),
        );
    }
    let outcome = Session::new(context).embedding_paths(&args.inputs.to_inputs());
    print(context, &outcome.graph, |graph, lang| tree(graph, Direction::Up, lang));
    finish(context, outcome)
}

/// Shows diagnostics, and warns if the graph is incomplete.
fn finish(context: &Context, GraphOutcome { diagnostics, incomplete, .. }: GraphOutcome) -> ExitStatus {
    if incomplete > 0 {
        context.printer.status(format_args!(
            "{}: {incomplete} ({})",
            context.choose(
                "paths with errors, which may embed more than is shown",
                "Pfade mit Fehlern, die mehr einbetten können als gezeigt"
            ),
            context.choose("pathbuild check shows them", "pathbuild check zeigt sie")
        ));
    }
    context.conclude(diagnostics)
}

fn print(context: &Context, graph: &Graph, text: impl Fn(&Graph, Lang) -> String) {
    match context.format {
        Format::Dot => context.printer.result(dot(graph)),
        Format::Mermaid => context.printer.result(mermaid(graph)),
        Format::Json => context.row("graph", json(context, graph)),
        _ => context.printer.result(text(graph, context.lang())),
    }
}

/// Formats a path with the values of its variables as in the text of a subpath: `2051.1P :A0,5 :BX`.
fn path(node: &Node) -> String {
    let mut label = escaping::line(node.name.as_str()).into_owned();
    for (variable, value) in node.bindings.iter() {
        _ = write!(label, " :{variable}{}", escaping::line(value));
    }
    label
}

/// Returns the file name of the drawing that contains a path, escaped for the terminal.
fn file(node: &Node) -> Cow<'_, str> {
    escaping::line(node.file.as_str())
}

/// Formats the target of an embedding.
fn target_text(graph: &Graph, end: &EmbeddingEnd) -> String {
    match end {
        EmbeddingEnd::Node(node) => path(&graph.nodes[*node]),
        EmbeddingEnd::Nowhere(name, code) => missing_target(name.as_ref(), *code),
    }
}

/// Formats a missing target with the reason: `9999.1P (PB503 path-not-found)`.
fn missing_target(name: Option<&PathName>, code: Code) -> String {
    format!("{} ({code} {})", escaping::line(name.map_or("?", PathName::as_str)), code.name())
}

/// Formats a tree for each root.
fn tree(graph: &Graph, direction: Direction, lang: Lang) -> String {
    let neighbours = graph.neighbours(direction);
    let mut text = String::new();
    let mut is_shown = vec![false; graph.nodes.len()];
    // Avoid recursion, because a library may nest deeper than the stack permits.
    let mut open: Vec<Step> = graph.roots.iter().rev().map(|root| Step::root(*root)).collect();
    while let Some(step) = open.pop() {
        let (label, mut remarks) = line(graph, &step, lang);
        // A path that only borrows parameters is not affected by what the lending path embeds.
        let is_leaf = step.is_lender && direction == Direction::Down;
        if let EmbeddingEnd::Node(node) = step.to
            && !is_leaf
        {
            if !std::mem::replace(&mut is_shown[node], true) {
                let below = neighbours[node].iter().rev();
                open.extend(
                    below.map(|index| Step::along(&graph.embeddings[*index], direction, step.level + 1)),
                );
            } else if !neighbours[node].is_empty() {
                remarks.push(lang.choose("as above", "wie oben").to_owned());
            }
        }
        _ = write!(text, "{:indent$}{label}", "", indent = 2 * step.level.min(MAX_INDENTATION));
        _ = if remarks.is_empty() { writeln!(text) } else { writeln!(text, "  ({})", remarks.join(", ")) };
    }
    text
}

/// Maximum indentation level. Deeper lines would be unreadable, and the output of a long chain would grow quadratically.
const MAX_INDENTATION: usize = 100;

/// A path in the printed tree of embeddings: one line of output.
struct Step {
    to: EmbeddingEnd,
    /// Number of segments that embed the path at this point of the tree.
    count: usize,
    /// See [`Embedding::is_lender`].
    is_lender: bool,
    level: usize,
}

impl Step {
    fn root(node: usize) -> Self {
        Self { to: EmbeddingEnd::Node(node), count: 1, is_lender: false, level: 0 }
    }

    fn along(embedding: &Embedding, direction: Direction, level: usize) -> Self {
        let to = match direction {
            Direction::Down => embedding.to.clone(),
            Direction::Up => EmbeddingEnd::Node(embedding.from),
        };
        Self { to, count: embedding.count, is_lender: embedding.is_lender, level }
    }
}

/// Returns the text of a line and the remarks about it.
fn line(graph: &Graph, step: &Step, lang: Lang) -> (String, Vec<String>) {
    let mut remarks = Vec::new();
    if step.count > 1 {
        remarks.push(times(step.count, lang));
    }
    if step.is_lender {
        remarks.push(lang.choose("parameters by @", "Parameter über @").to_owned());
    }
    let EmbeddingEnd::Node(node) = step.to else { return (target_text(graph, &step.to), remarks) };
    let node = &graph.nodes[node];
    if node.is_example {
        remarks.push(EXAMPLE.in_lang(lang).to_owned());
    }
    if !node.is_sound {
        remarks.push(lang.choose("has errors", "hat Fehler").to_owned());
    }
    (format!("{}  {}", path(node), file(node)), remarks)
}

const EXAMPLE: Text = Text { en: "example values", de: "Beispielwerte" };

fn times(count: usize, lang: Lang) -> String {
    format!("{count} {}", lang.choose("times", "mal"))
}

/// Formats one line per embedding, such as `8001.1P > 2051.1P :A0,5`, or `2051.2P @ 2051.1P` for borrowed parameters, sorted by the embedding path.
/// Paths without any embeddings get a line of their own.
fn list(graph: &Graph, lang: Lang) -> String {
    let (below, above) = (graph.neighbours(Direction::Down), graph.neighbours(Direction::Up));
    let mut text = String::new();
    for (index, node) in graph.nodes.iter().enumerate() {
        if below[index].is_empty() && above[index].is_empty() {
            let remark =
                if node.is_example { format!("  ({})", EXAMPLE.in_lang(lang)) } else { String::new() };
            _ = writeln!(text, "{}{remark}", path(node));
        }
        for embedding in below[index].iter().map(|embedding| &graph.embeddings[*embedding]) {
            let sign = if embedding.is_lender { '@' } else { '>' };
            _ = write!(text, "{} {sign} {}", path(node), target_text(graph, &embedding.to));
            _ = match embedding.count {
                1 => writeln!(text),
                count => writeln!(text, "  ({})", times(count, lang)),
            };
        }
    }
    text
}

fn dot(graph: &Graph) -> String {
    let mut text = String::from("digraph pathbuild {\n  rankdir=LR;\n  node [shape=box];\n");
    for (index, node) in graph.nodes.iter().enumerate() {
        let style = if node.is_sound { "" } else { ", style=dashed" };
        let label = format!("{}\n{}", path(node), file(node));
        _ = writeln!(text, "  n{index} [label={}{style}];", quoted(&label));
    }
    for (index, embedding) in graph.embeddings.iter().enumerate() {
        let label = edge_label(embedding).map_or_else(String::new, |label| format!(" [label=\"{label}\"]"));
        match &embedding.to {
            EmbeddingEnd::Node(to) => _ = writeln!(text, "  n{} -> n{to}{label};", embedding.from),
            EmbeddingEnd::Nowhere(name, code) => {
                let missing = quoted(&missing_target(name.as_ref(), *code));
                _ = writeln!(text, "  m{index} [label={missing}, style=dashed];");
                _ = writeln!(text, "  n{} -> m{index}{label};", embedding.from);
            }
        }
    }
    text.push_str("}\n");
    text
}

/// Returns the label of an embedding in a drawn graph.
fn edge_label(embedding: &Embedding) -> Option<String> {
    if embedding.is_lender {
        return Some("@".to_owned());
    }
    (embedding.count > 1).then(|| embedding.count.to_string())
}

/// Quotes a string for DOT; line breaks become `\n`.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n"))
}

fn mermaid(graph: &Graph) -> String {
    let mut text = String::from("flowchart LR\n");
    for (index, node) in graph.nodes.iter().enumerate() {
        let label = format!("{}<br>{}", escaped(&path(node)), escaped(&file(node)));
        _ = writeln!(text, "  n{index}[\"{label}\"]");
    }
    for (index, embedding) in graph.embeddings.iter().enumerate() {
        let arrow = edge_label(embedding).map_or_else(|| "-->".to_owned(), |label| format!("-->|{label}|"));
        match &embedding.to {
            EmbeddingEnd::Node(to) => _ = writeln!(text, "  n{} {arrow} n{to}", embedding.from),
            EmbeddingEnd::Nowhere(name, code) => {
                let missing = escaped(&missing_target(name.as_ref(), *code));
                _ = writeln!(text, "  n{} {arrow} m{index}([\"{missing}\"])", embedding.from);
            }
        }
    }
    text
}

/// Replaces characters that are special in Mermaid by entity codes.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '#' | '"' | '<' | '>' | '&' | '`' | '%' => _ = write!(escaped, "#{};", u32::from(character)),
            character => escaped.push(character),
        }
    }
    escaped
}

fn json(context: &Context, graph: &Graph) -> Value {
    let paths: Vec<Value> = graph.nodes.iter().map(|node| path_json(context, node)).collect();
    let embeddings: Vec<Value> = graph.embeddings.iter().map(|edge| embedding(graph, edge)).collect();
    json!({ "paths": paths, "embeddings": embeddings })
}

/// Returns the JSON object of a path. `example` states whether the values are only examples, not those of an embedding; `erroneous`
/// states whether the path has errors, so that it may embed more than is known.
fn path_json(context: &Context, node: &Node) -> Value {
    json!({
        "path": node.name.as_str(),
        "file": context.file(&node.file),
        "values": values(&node.bindings),
        "example": node.is_example,
        "erroneous": !node.is_sound,
    })
}

fn values(bindings: &Bindings) -> Map<String, Value> {
    bindings.iter().map(|(variable, value)| (variable.to_string(), value.into())).collect()
}

/// Returns the JSON object of an embedding. If the target does not exist, `to` is null, `path` is the name in the segment, and `code` is
/// the reason. `lender` states whether the target is not embedded, but lends its parameters by @.
fn embedding(graph: &Graph, edge: &Embedding) -> Value {
    let (to, path, code) = match &edge.to {
        EmbeddingEnd::Node(to) => (Some(*to), Some(graph.nodes[*to].name.as_str()), None),
        EmbeddingEnd::Nowhere(name, code) => {
            (None, name.as_ref().map(PathName::as_str), Some(code.to_string()))
        }
    };
    json!({
        "from": edge.from,
        "to": to,
        "count": edge.count,
        "path": path,
        "code": code,
        "lender": edge.is_lender,
    })
}
