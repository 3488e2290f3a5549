//! A graph for Graphviz.

use std::fmt::Write;

use super::label;
use pathbuild_workspace::session::{End, Graph};

pub(super) fn dot(graph: &Graph) -> String {
    let mut text = String::from("digraph pathbuild {\n  rankdir=LR;\n  node [shape=box];\n");
    for (index, node) in graph.nodes.iter().enumerate() {
        let style = if node.is_sound { "" } else { ", style=dashed" };
        let label = format!("{}\n{}", label::path(node), label::file(node));
        _ = writeln!(text, "  n{index} [label={}{style}];", quoted(&label));
    }
    for (index, embedding) in graph.embeddings.iter().enumerate() {
        let label =
            if embedding.count > 1 { format!(" [label=\"{}\"]", embedding.count) } else { String::new() };
        match &embedding.to {
            End::Node(to) => _ = writeln!(text, "  n{} -> n{to}{label};", embedding.from),
            End::Nowhere(name, code) => {
                let missing = quoted(&label::nowhere(name.as_ref(), *code));
                _ = writeln!(text, "  m{index} [label={missing}, style=dashed];");
                _ = writeln!(text, "  n{} -> m{index}{label};", embedding.from);
            }
        }
    }
    text.push_str("}\n");
    text
}

/// Quotes a string for DOT; line breaks become `\n`.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n"))
}
