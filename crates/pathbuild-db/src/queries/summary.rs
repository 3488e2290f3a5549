//! The summary of a bound path: everything that a check and the embedding paths need.

use pathbuild_diagnostic::messages::drawing as messages;
use pathbuild_diagnostic::{Code, Diagnostic, Note, Point};
use pathbuild_path::{Bindings, PathSignature, RawPath, Xy};
use pathbuild_toolpath::own_moves;

use super::binding::{BoundPath, examine, walk};
use super::nearby_ends::LayerEnds;
use crate::db::Db;
use crate::settings::Settings;

/// The summary of a path with bound variables.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PathSummary {
    /// Findings about its drawing or values.
    pub problems: Vec<Diagnostic>,
    /// The path as seen by others, unless a finding is an error.
    pub signature: Option<PathSignature>,
    /// The known part of the signature of a path with errors, used to judge what it embeds. `None` if nothing is drawn.
    pub faulty_signature: Option<Box<PathSignature>>,
    /// Findings about the sweep height it gets when embedded or checked. Empty if the path has errors.
    pub sweep_problems: Vec<Diagnostic>,
    /// Findings about the walk.
    pub walk_problems: Vec<Diagnostic>,
    /// Estimated number of moves, without embedded paths.
    pub moves: u64,
}

impl PathSummary {
    /// Binds and walks a path.
    pub(super) fn new(db: &dyn Db, raw: &RawPath, bindings: &Bindings, ends: &LayerEnds<'_>) -> Self {
        let language = Settings::get(db).language(db);
        let with_hint = |found: Diagnostic| ends.with_hint(&raw.name, language, found);
        let BoundPath { path, diagnostics } = examine(raw, bindings, language);
        let mut problems: Vec<Diagnostic> = diagnostics.into_iter().map(with_hint).collect();
        let Some(path) = path else { return Self { problems, ..Self::default() } };
        let walked = walk(db, &path, language);
        if let Some(end) = walked.open_end {
            add_path_end(&mut problems, end);
        }
        let signature = PathSignature::of(&path);
        let moves = if path.has_faults() { 0 } else { own_moves(&path, &walked) };
        let walk_problems = walked.diagnostics.into_iter().map(with_hint).collect();
        if path.has_faults() {
            let faulty_signature = Some(Box::new(signature));
            return Self { problems, faulty_signature, walk_problems, ..Self::default() };
        }
        Self {
            problems,
            sweep_problems: signature.sweep_limits.check(path.embedded_sweep_height()),
            walk_problems,
            moves,
            signature: Some(signature),
            faulty_signature: None,
        }
    }

    /// The signature as far as it is known, with or without errors.
    pub(super) fn known_signature(&self) -> Option<&PathSignature> {
        self.signature.as_ref().or(self.faulty_signature.as_deref())
    }

    /// Whether the path itself has no findings.
    pub(super) fn is_clean(&self) -> bool {
        let Self { problems, sweep_problems, walk_problems, .. } = self;
        self.signature.is_some()
            && problems.is_empty()
            && sweep_problems.is_empty()
            && walk_problems.is_empty()
    }

    /// Whether the path embeds others.
    pub(super) fn has_subpaths(&self) -> bool {
        self.known_signature().is_some_and(|signature| !signature.subpaths.is_empty())
    }
}

/// Adds to PB102 where the path ends.
fn add_path_end(problems: &mut [Diagnostic], end: Xy) {
    for problem in problems.iter_mut().filter(|problem| problem.code() == Code::MissingEnd) {
        let note = Note {
            message: &messages::ENDS_HERE,
            arguments: vec![("point", Point::new(end.x, end.y).into())],
        };
        problem.notes.push(note);
    }
}
