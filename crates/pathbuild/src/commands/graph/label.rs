//! How paths with their values are written.

use pathbuild_diagnostic::Code;
use pathbuild_path::{Bindings, PathName};

use pathbuild_workspace::session::{End, Graph, Node};

/// A path with the values of its variables as a subpath's text sets them: `2051.1P :A0,5 :BX`.
pub(super) fn path(node: &Node) -> String {
    with_values(node.name.as_str(), &node.bindings)
}

/// What an embedding leads to.
pub(super) fn end(graph: &Graph, end: &End) -> String {
    match end {
        End::Node(node) => path(&graph.nodes[*node]),
        End::Nowhere(name, code) => nowhere(name.as_ref(), *code),
    }
}

/// What is not embedded, and why: `9999.1P (PB503 path-not-found)`.
pub(super) fn nowhere(name: Option<&PathName>, code: Code) -> String {
    format!("{} ({code} {})", name.map_or("?", PathName::as_str), code.name())
}

fn with_values(name: &str, bindings: &Bindings) -> String {
    let mut label = name.to_owned();
    for (variable, value) in bindings.iter() {
        label.push_str(" :");
        label.push(variable);
        label.push_str(value);
    }
    label
}
