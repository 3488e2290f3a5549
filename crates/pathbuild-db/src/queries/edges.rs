//! The embeddings of a closure, as edges from path to path: what commands show of a library.

use pathbuild_diagnostic::{Code, Diagnostic, Point};
use pathbuild_path::PathName;

use super::closures::Closure;
use super::embedding::{Embedding, Outcome, embeds};
use super::instance::Instance;
use crate::db::Db;

/// A subpath segment of a path in a closure.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge<'db> {
    /// The path that embeds.
    pub from: Instance<'db>,
    /// Where its subpath segment begins, in its drawing.
    pub point: Point,
    /// What the segment embeds.
    pub to: Destination<'db>,
}

/// What a subpath segment leads to.
#[derive(Clone, Debug, PartialEq)]
pub enum Destination<'db> {
    /// A path with its values.
    Path(Instance<'db>),
    /// Nothing, for the first reason why not.
    Nowhere {
        /// The path that it names, where it names one.
        name: Option<PathName>,
        /// The reason.
        code: Code,
    },
}

impl<'db> Closure<'db> {
    /// Every embedding in it: path by path in the order in which they are reached, segment by segment.
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
        // There is one problem at least.
        Outcome::Unbound(problems) => {
            nowhere(problems.first().map_or(Code::MissingVariableValue, Diagnostic::code))
        }
    };
    Edge { from, point: embedding.origin.point, to }
}
