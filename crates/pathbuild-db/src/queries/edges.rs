//! The embeddings of a closure as graph edges, for the commands that show a library.

use pathbuild_diagnostic::{Code, Diagnostic, Point};
use pathbuild_path::PathName;

use super::closures::Closure;
use super::embedding::{Embedding, Outcome, embeds};
use super::instance::Instance;
use crate::db::Db;

/// A subpath segment of a path in a closure.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge<'db> {
    /// The embedding path.
    pub from: Instance<'db>,
    /// The start of its subpath segment, in its drawing.
    pub point: Point,
    /// The embedded path.
    pub to: Destination<'db>,
}

/// The target of a subpath segment.
#[derive(Clone, Debug, PartialEq)]
pub enum Destination<'db> {
    /// A path with its values.
    Path(Instance<'db>),
    /// None; only the first reason is kept.
    Nowhere {
        /// The name it refers to, if any.
        name: Option<PathName>,
        /// The reason.
        code: Code,
    },
}

impl<'db> Closure<'db> {
    /// All embeddings, path by path in the order in which paths are reached, segment by segment.
    pub fn edges(&self, db: &'db dyn Db) -> Vec<Edge<'db>> {
        let of_path =
            |from: Instance<'db>| embeds(db, from).iter().map(move |embedding| edge(from, embedding));
        self.reached.iter().flat_map(|reached| of_path(reached.instance)).collect()
    }
}

fn edge<'db>(from: Instance<'db>, embedding: &Embedding<'db>) -> Edge<'db> {
    let nowhere = |code| Destination::Nowhere { name: embedding.name.as_deref().cloned(), code };
    let to = match &embedding.outcome {
        Outcome::Found { child, .. } => Destination::Path(*child),
        Outcome::Refused(problem) | Outcome::NotFound(problem) => nowhere(problem.code()),
        Outcome::Unlisted(_) => nowhere(Code::UnreadableFile),
        // An unbound segment has at least one problem.
        Outcome::Unbound(problems) => {
            nowhere(problems.first().map_or(Code::MissingVariableValue, Diagnostic::code))
        }
    };
    Edge { from, point: embedding.origin.point, to }
}
