//! Paths that are milled in loose waste. (book: language/part)

use std::cell::OnceCell;
use std::ops::Range;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::part as messages;
use pathbuild_path::{EarlierCuts, WasteCut};

use super::{PlacedPath, PlacedProgram, diagnostic_point};

/// Successive cuts of a path, between which it embeds no other path.
struct UninterruptedCuts<'p, 'db> {
    /// Indices into [`PathCuts::cuts`](pathbuild_path::PathCuts::cuts).
    cuts: Range<usize>,
    /// Number of paths in [`PlacedProgram::paths`] that begin before these cuts.
    paths_before: usize,
    /// The cuts that other paths make before these. Computed when first needed.
    earlier: OnceCell<Vec<EarlierCuts<'p, 'db>>>,
}

impl<'db> PlacedProgram<'db> {
    /// Returns PB222 for paths with cuts in waste that earlier cuts have separated from the plate.
    pub(super) fn cuts_in_loose_waste(&self) -> Vec<Diagnostic> {
        if self.settings.is_held_otherwise {
            return Vec::new();
        }
        (0..self.paths.len()).flat_map(|later| self.cuts_of_path_in_loose_waste(later)).collect()
    }

    /// Returns PB222 for a path, once for each path with openings in which it cuts loose waste.
    fn cuts_of_path_in_loose_waste(&self, later: usize) -> Vec<Diagnostic> {
        let sections: Vec<UninterruptedCuts<'_, 'db>> = self.sections(later).collect();
        let paths_before = sections.last().map_or(0, |section| section.paths_before);
        let owners = (0..paths_before).filter(|owner| self.may_share_waste(*owner, later));
        let cut = |owner: usize| {
            let mut sections = sections.iter().filter(|section| owner < section.paths_before);
            let cut = sections.find_map(|section| {
                let earlier = section.earlier.get_or_init(|| self.cuts_before(later, section.paths_before));
                let (owned, cutting) = (&self.paths[owner].cuts, &self.paths[later].cuts);
                owned.cut_in_loose_waste(cutting, section.cuts.clone(), earlier)
            })?;
            Some(self.loose_waste_problem(owner, later, &cut))
        };
        owners.filter_map(cut).collect()
    }

    /// Returns the sections with cuts of a path, which the paths that it embeds divide.
    fn sections(&self, path: usize) -> impl Iterator<Item = UninterruptedCuts<'_, 'db>> {
        let is_within = |inner: &usize| self.path_and_embedders(*inner).any(|around| around == path);
        let end = (path..self.paths.len()).find(|inner| !is_within(inner)).unwrap_or(self.paths.len());
        let parent = move |inner: usize| self.paths[inner].parent.filter(|parent| parent.path == path);
        let children = (path..end).filter_map(move |inner| Some((inner, parent(inner)?.cuts_before)));
        let ends = children.chain([(end, self.paths[path].cuts.cuts.cuts.len())]);
        let mut start = 0;
        let sections = ends.map(move |(paths_before, end)| {
            let cuts = std::mem::replace(&mut start, end)..end;
            UninterruptedCuts { cuts, paths_before, earlier: OnceCell::new() }
        });
        sections.filter(|section| !section.cuts.is_empty())
    }

    /// Whether `later` may cut waste from an opening in the parts of `owner`, which is of another drawing or lies at another place. In joined
    /// programs, the two also belong to different programs.
    fn may_share_waste(&self, owner: usize, later: usize) -> bool {
        let (owned, cutting) = (&self.paths[owner], &self.paths[later]);
        let has_opening = owned.cuts.parts.iter().any(|part| part.rings.len() > 1);
        has_opening
            && owned.cuts.is_reached_by(&cutting.cuts)
            && !self.is_at(owned, cutting.instance, &cutting.cuts.placement)
            && !(self.is_joined && self.root(owner) == self.root(later))
    }

    /// Returns the cuts that the first `paths_before` paths make before a section of the path `later`, except for paths of the same drawing at the
    /// same place.
    fn cuts_before(&self, later: usize, paths_before: usize) -> Vec<EarlierCuts<'_, 'db>> {
        let PlacedPath { instance, cuts, .. } = &self.paths[later];
        let is_other = |path: &usize| !self.is_at(&self.paths[*path], *instance, &cuts.placement);
        let mut counts = vec![usize::MAX; paths_before];
        for inner in self.path_and_embedders(later) {
            if let Some(parent) = &self.paths[inner].parent {
                counts[parent.path] = parent.cuts_before;
            }
        }
        let paths = counts.into_iter().enumerate().filter(|(path, _)| is_other(path));
        paths.map(|(path, count)| EarlierCuts { path: &self.paths[path].cuts, count }).collect()
    }

    fn loose_waste_problem(&self, owner: usize, later: usize, cut: &WasteCut) -> Diagnostic {
        let (path, origin) = self.innermost_common_path(later, cut.element, owner);
        let problem = Diagnostic::new(&messages::CUT_IN_LOOSE_WASTE)
            .quoting("name", self.paths[later].cuts.cuts.name.as_str())
            .quoting("other", self.paths[owner].cuts.cuts.name.as_str())
            .with("place", diagnostic_point(cut.opening));
        self.at(path, origin, problem)
    }
}
