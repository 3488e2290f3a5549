//! A graph for Mermaid, as in Markdown files.

use std::fmt::Write;

use super::label;
use pathbuild_workspace::session::{End, Graph};

pub(super) fn mermaid(graph: &Graph) -> String {
    let mut text = String::from("flowchart LR\n");
    for (index, node) in graph.nodes.iter().enumerate() {
        let label = format!("{}<br>{}", escaped(&label::path(node)), escaped(&label::file(node)));
        _ = writeln!(text, "  n{index}[\"{label}\"]");
    }
    for (index, embedding) in graph.embeddings.iter().enumerate() {
        let arrow = if embedding.count > 1 { format!("-->|{}|", embedding.count) } else { "-->".to_owned() };
        match &embedding.to {
            End::Node(to) => _ = writeln!(text, "  n{} {arrow} n{to}", embedding.from),
            End::Nowhere(name, code) => {
                let missing = escaped(&label::nowhere(name.as_ref(), *code));
                _ = writeln!(text, "  n{} {arrow} m{index}([\"{missing}\"])", embedding.from);
            }
        }
    }
    text
}

/// Replaces characters that are special to Mermaid by entity codes.
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
