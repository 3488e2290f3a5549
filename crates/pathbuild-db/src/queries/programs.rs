//! The finished program of a target.

use std::sync::Arc;

use pathbuild_path::{Path, WalkedPath};
use pathbuild_toolpath::{Parts, Program, fold};

use super::closures::closure;
use super::embedding::{Outcome, embeds};
use super::instance::{Instance, chains, path};
use super::keep_outs::entered_keep_outs;
use crate::db::Db;
use crate::inputs::Target;
use crate::settings::Settings;

/// Folds a path and everything it embeds into a program. `None` if one of them has errors, an option is missing or the tool hits a clamp.
/// Programs are large and used once, so only the last few are kept.
#[salsa::tracked(lru = 16)]
pub fn program(db: &dyn Db, target: Target) -> Option<Arc<Program>> {
    let closure = closure(db, target);
    let is_right = !closure.has_errors() && closure.missing_options.is_empty();
    if !is_right || !entered_keep_outs(db, target).is_empty() {
        return None;
    }
    let drawing = target.file(db).path(db).file_name().unwrap_or_default();
    let program =
        fold(&ClosurePaths { db }, closure.root?, drawing, Settings::get(db).fold(db), closure.moves);
    Some(Arc::new(program))
}

/// Gives the fold access to the paths of a closure without errors.
pub(super) struct ClosurePaths<'db> {
    pub(super) db: &'db dyn Db,
}

impl<'db> Parts for ClosurePaths<'db> {
    type Id = Instance<'db>;

    fn path(&self, id: Instance<'db>) -> &Path {
        path(self.db, id).path.as_ref().expect("a path of a closure without errors is bound")
    }

    fn walked(&self, id: Instance<'db>) -> &WalkedPath {
        chains(self.db, id)
    }

    fn embedded(&self, id: Instance<'db>, segment: usize) -> Option<Instance<'db>> {
        let embedded = embeds(self.db, id);
        let place = embedded.binary_search_by_key(&segment, |embedding| embedding.segment).ok()?;
        match &embedded[place].outcome {
            Outcome::Found { child, .. } => Some(*child),
            _ => None,
        }
    }

    fn checkpoint(&self) {
        self.db.unwind_if_revision_cancelled();
    }
}
