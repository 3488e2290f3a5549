//! What comes of a path with values for its variables, in short: all that a check and the paths that embed it ask.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::{Bindings, PathSignature, RawPath};
use pathbuild_toolpath::own_moves;

use super::binding::{BoundPath, bind, walk};
use super::nearby_ends::LayerEnds;
use crate::db::Db;
use crate::settings::Settings;

/// What came of a path with values for its variables.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PathSummary {
    /// What is wrong with its drawing or its values.
    pub problems: Vec<Diagnostic>,
    /// What others see of the path, where none of these is an error. What follows is empty where there is none.
    pub signature: Option<PathSignature>,
    /// What is wrong with the sweep height that it has where it is embedded or checked.
    pub sweep_problems: Vec<Diagnostic>,
    /// What is wrong with the walk along it.
    pub walk_problems: Vec<Diagnostic>,
    /// About how many moves it has without what it embeds.
    pub moves: u64,
}

impl PathSummary {
    /// Binds a path, walks along it, and keeps what others need to know.
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

    /// Whether nothing is to be said of the path itself.
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
