//! A graph as one JSON object: `paths`, and `embeddings` between them by their numbers.

use pathbuild_path::{Bindings, PathName};
use serde::Serialize;
use serde_json::{Map, Value};

use crate::context::Context;
use pathbuild_workspace::session::{End, Graph, Node};

#[derive(Serialize)]
struct Object<'a> {
    paths: Vec<Path<'a>>,
    embeddings: Vec<Embedding<'a>>,
}

#[expect(clippy::struct_field_names, reason = "the keys of the JSON")]
#[derive(Serialize)]
struct Path<'a> {
    path: &'a str,
    file: String,
    values: Map<String, Value>,
    /// Whether the values are examples, with which nothing embeds it.
    example: bool,
    /// Whether its own drawing has errors, so that it is not known what it embeds.
    erroneous: bool,
}

/// `to` is null where nothing is embedded; then `path` is what the segment names, and `code` says why.
#[derive(Serialize)]
struct Embedding<'a> {
    from: usize,
    to: Option<usize>,
    count: usize,
    path: Option<&'a str>,
    code: Option<String>,
}

pub(super) fn json(context: &Context, graph: &Graph) -> Value {
    let object = Object {
        paths: graph.nodes.iter().map(|node| path(context, node)).collect(),
        embeddings: graph.embeddings.iter().map(|it| embedding(graph, it)).collect(),
    };
    // Only maps with keys that are no text can fail to become JSON.
    serde_json::to_value(&object).unwrap_or_default()
}

fn path<'a>(context: &Context, node: &'a Node) -> Path<'a> {
    Path {
        path: node.name.as_str(),
        file: context.file(&node.file),
        values: values(&node.bindings),
        example: node.is_example,
        erroneous: !node.is_sound,
    }
}

fn values(bindings: &Bindings) -> Map<String, Value> {
    bindings.iter().map(|(variable, value)| (variable.to_string(), value.into())).collect()
}

fn embedding<'a>(graph: &'a Graph, it: &'a pathbuild_workspace::session::Embedding) -> Embedding<'a> {
    let (to, path, code) = match &it.to {
        End::Node(to) => (Some(*to), Some(graph.nodes[*to].name.as_str()), None),
        End::Nowhere(name, code) => (None, name.as_ref().map(PathName::as_str), Some(code.to_string())),
    };
    Embedding { from: it.from, to, count: it.count, path, code }
}
