//! The summary of a bound path: everything that a check and the embedding paths need.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::{Bindings, PathSignature, RawPath};
use pathbuild_toolpath::own_moves;

use super::binding::{BoundPath, bind, walk};
use super::nearby_ends::LayerEnds;
use crate::db::Db;
use crate::settings::Settings;

/// The summary of a path with bound variables.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PathSummary {
    /// Findings about its drawing or values.
    pub problems: Vec<Diagnostic>,
    /// The path as seen by others, unless a finding is an error. The following fields are empty in that case.
    pub signature: Option<PathSignature>,
    /// Findings about the sweep height it gets when embedded or checked.
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
        let BoundPath { path, diagnostics: problems } = bind(raw, bindings, language);
        let Some(path) = path else { return Self { problems, ..Self::default() } };
        let walked = walk(db, &path, language);
        let with_hint =
            |found: &Diagnostic| ends.with_hint(&path.name, &language.path_pattern, found.clone());
        let signature = PathSignature::of(&path);
        Self {
            problems,
            sweep_problems: signature.sweep_limits.check(path.embedded_sweep_height()),
            walk_problems: walked.diagnostics.iter().map(with_hint).collect(),
            moves: own_moves(&path, &walked),
            signature: Some(signature),
        }
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
        self.signature.as_ref().is_some_and(|signature| !signature.subpaths.is_empty())
    }
}
