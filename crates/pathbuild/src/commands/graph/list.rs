//! A graph as one line per embedding, for searching.

use std::fmt::Write;

use pathbuild_diagnostic::Lang;

use super::label;
use pathbuild_workspace::session::{Direction, Graph};

/// `8001.1P > 2051.1P :A0,5`, sorted by embedding path. Paths without any embeddings are listed on their own.
pub(super) fn list(graph: &Graph, lang: Lang) -> String {
    let (below, above) = (graph.neighbours(Direction::Down), graph.neighbours(Direction::Up));
    let (times, example) = match lang {
        Lang::En => ("times", "example values"),
        Lang::De => ("mal", "Beispielwerte"),
    };
    let mut text = String::new();
    for (index, node) in graph.nodes.iter().enumerate() {
        if below[index].is_empty() && above[index].is_empty() {
            let remark = if node.is_example { format!("  ({example})") } else { String::new() };
            _ = writeln!(text, "{}{remark}", label::path(node));
        }
        for embedding in below[index].iter().map(|embedding| &graph.embeddings[*embedding]) {
            _ = write!(text, "{} > {}", label::path(node), label::end(graph, &embedding.to));
            _ = match embedding.count {
                1 => writeln!(text),
                count => writeln!(text, "  ({count} {times})"),
            };
        }
    }
    text
}
