//! Labels of paths with their values, with control characters escaped.

use std::borrow::Cow;

use pathbuild_diagnostic::{Code, shown};
use pathbuild_path::{Bindings, PathName};

use pathbuild_workspace::session::{End, Graph, Node};

/// A path with the values of its variables, written as in a subpath's text: `2051.1P :A0,5 :BX`.
pub(super) fn path(node: &Node) -> String {
    with_values(node.name.as_str(), &node.bindings)
}

/// The drawing of a path.
pub(super) fn file(node: &Node) -> Cow<'_, str> {
    shown::line(node.file.as_str())
}

/// The target of an embedding.
pub(super) fn end(graph: &Graph, end: &End) -> String {
    match end {
        End::Node(node) => path(&graph.nodes[*node]),
        End::Nowhere(name, code) => nowhere(name.as_ref(), *code),
    }
}

/// A missing target with the reason: `9999.1P (PB503 path-not-found)`.
pub(super) fn nowhere(name: Option<&PathName>, code: Code) -> String {
    format!("{} ({code} {})", shown::line(name.map_or("?", PathName::as_str)), code.name())
}

fn with_values(name: &str, bindings: &Bindings) -> String {
    let mut label = shown::line(name).into_owned();
    for (variable, value) in bindings.iter() {
        label.push_str(" :");
        label.push(variable);
        label.push_str(&shown::line(value));
    }
    label
}
