//! A graph as a JSON object: `paths`, and `embeddings` that refer to them by index.

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
    /// Whether the values are only examples, with which nothing embeds the path.
    example: bool,
    /// Whether its drawing has errors, so that its embeddings may be incomplete.
    erroneous: bool,
}

/// `to` is null if nothing is embedded; then `path` is the name in the segment, and `code` the reason.
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
        embeddings: graph.embeddings.iter().map(|edge| embedding(graph, edge)).collect(),
    };
    // Serialization fails only for maps with keys that are not strings.
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

fn embedding<'a>(graph: &'a Graph, edge: &'a pathbuild_workspace::session::Embedding) -> Embedding<'a> {
    let (to, path, code) = match &edge.to {
        End::Node(to) => (Some(*to), Some(graph.nodes[*to].name.as_str()), None),
        End::Nowhere(name, code) => (None, name.as_ref().map(PathName::as_str), Some(code.to_string())),
    };
    Embedding { from: edge.from, to, count: edge.count, path, code }
}
