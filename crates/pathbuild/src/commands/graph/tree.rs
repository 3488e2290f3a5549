//! A graph as indented lines. A path whose embeddings were already shown is not expanded again.

use std::fmt::Write;

use pathbuild_diagnostic::Lang;

use super::label;
use pathbuild_workspace::session::{Direction, Embedding, End, Graph};

/// A tree for each root.
pub(super) fn tree(graph: &Graph, direction: Direction, lang: Lang) -> String {
    let neighbours = graph.neighbours(direction);
    let words = Words::of(lang);
    let mut text = String::new();
    let mut is_shown = vec![false; graph.nodes.len()];
    // Not recursive: a library may nest deeper than the stack.
    let mut open: Vec<Step> = graph.roots.iter().rev().map(|root| Step::root(*root)).collect();
    while let Some(step) = open.pop() {
        let (label, mut remarks) = words.line(graph, &step);
        if let End::Node(node) = step.to {
            if !std::mem::replace(&mut is_shown[node], true) {
                let below = neighbours[node].iter().rev();
                open.extend(
                    below.map(|index| Step::along(&graph.embeddings[*index], direction, step.level + 1)),
                );
            } else if !neighbours[node].is_empty() {
                remarks.push(words.shown.to_owned());
            }
        }
        _ = write!(text, "{:indent$}{label}", "", indent = 2 * step.level.min(DEEPEST));
        _ = if remarks.is_empty() { writeln!(text) } else { writeln!(text, "  ({})", remarks.join(", ")) };
    }
    text
}

/// Upper bound on the indentation level: deeper lines would be unreadable, and the output of a long chain would grow quadratically.
const DEEPEST: usize = 100;

/// A line of a tree.
struct Step {
    to: End,
    /// Number of segments that embed it at this point.
    count: usize,
    level: usize,
}

impl Step {
    fn root(node: usize) -> Self {
        Self { to: End::Node(node), count: 1, level: 0 }
    }

    fn along(embedding: &Embedding, direction: Direction, level: usize) -> Self {
        let to = match direction {
            Direction::Down => embedding.to.clone(),
            Direction::Up => End::Node(embedding.from),
        };
        Self { to, count: embedding.count, level }
    }
}

struct Words {
    times: &'static str,
    shown: &'static str,
    example: &'static str,
    errors: &'static str,
}

impl Words {
    fn of(lang: Lang) -> &'static Self {
        match lang {
            Lang::En => {
                &Self { times: "times", shown: "as above", example: "example values", errors: "has errors" }
            }
            Lang::De => {
                &Self { times: "mal", shown: "wie oben", example: "Beispielwerte", errors: "hat Fehler" }
            }
        }
    }

    /// The label of a line, with remarks.
    fn line(&self, graph: &Graph, step: &Step) -> (String, Vec<String>) {
        let mut remarks = Vec::new();
        if step.count > 1 {
            remarks.push(format!("{} {}", step.count, self.times));
        }
        let End::Node(node) = step.to else { return (label::end(graph, &step.to), remarks) };
        let node = &graph.nodes[node];
        if node.is_example {
            remarks.push(self.example.to_owned());
        }
        if !node.is_sound {
            remarks.push(self.errors.to_owned());
        }
        (format!("{}  {}", label::path(node), label::file(node)), remarks)
    }
}
