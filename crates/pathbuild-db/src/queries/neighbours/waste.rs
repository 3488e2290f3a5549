//! Paths that are milled in loose waste. (book: language/part)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::part as messages;
use pathbuild_path::{EarlierCuts, WasteCut};

use super::{PlacedPath, PlacedProgram, diagnostic_point};

impl<'db> PlacedProgram<'db> {
    /// Returns PB222 for embedded paths with cuts in waste that earlier cuts have separated from the plate.
    pub(super) fn cuts_in_loose_waste(&self) -> Vec<Diagnostic> {
        if self.settings.is_held_otherwise {
            return Vec::new();
        }
        let embedded =
            (0..self.paths.len()).filter(|path| self.paths[*path].parent.is_some() || self.is_joined);
        embedded.flat_map(|later| self.cuts_of_path_in_loose_waste(later)).collect()
    }

    /// Returns PB222 for a path, once for each path in whose openings it cuts loose waste.
    fn cuts_of_path_in_loose_waste(&self, later: usize) -> Vec<Diagnostic> {
        let owners: Vec<usize> =
            (0..self.paths.len()).filter(|owner| self.may_share_waste(*owner, later)).collect();
        if owners.is_empty() {
            return Vec::new();
        }
        let earlier = self.cuts_before(later);
        let cut = |owner: usize| {
            let cut = self.paths[owner].cuts.cut_in_loose_waste(&self.paths[later].cuts, &earlier)?;
            Some(self.loose_waste(owner, later, &cut))
        };
        owners.into_iter().filter_map(cut).collect()
    }

    /// Whether a path may cut waste from an opening of another drawing's part; in joined programs, of another program's.
    fn may_share_waste(&self, owner: usize, later: usize) -> bool {
        let (owned, cutting) = (&self.paths[owner], &self.paths[later]);
        let has_opening = owned.cuts.parts.iter().any(|part| part.rings.len() > 1);
        has_opening
            && owned.cuts.is_reached_by(&cutting.cuts)
            && !self.is_at(owned, cutting.instance, &cutting.cuts.placement)
            && !(self.is_joined && self.root(owner) == self.root(later))
    }

    /// Returns the cuts that are made before a path is milled, except for those of the same drawing at the same place.
    fn cuts_before(&self, later: usize) -> Vec<EarlierCuts<'_, 'db>> {
        let PlacedPath { instance, cuts, .. } = &self.paths[later];
        let is_other = |path: &usize| !self.is_at(&self.paths[*path], *instance, &cuts.placement);
        let mut counts = vec![usize::MAX; later];
        for inner in self.path_and_embedders(later) {
            if let Some(parent) = &self.paths[inner].parent {
                counts[parent.path] = parent.cuts_before;
            }
        }
        let paths = counts.into_iter().enumerate().filter(|(path, _)| is_other(path));
        paths.map(|(path, count)| EarlierCuts { path: &self.paths[path].cuts, count }).collect()
    }

    fn loose_waste(&self, owner: usize, later: usize, cut: &WasteCut) -> Diagnostic {
        let (path, origin) = self.innermost_common_path(later, cut.element, owner);
        let problem = Diagnostic::new(&messages::CUT_IN_LOOSE_WASTE)
            .quoting("name", self.paths[later].cuts.cuts.name.as_str())
            .quoting("other", self.paths[owner].cuts.cuts.name.as_str())
            .with("place", diagnostic_point(cut.opening));
        self.at(path, origin, problem)
    }
}
