//! Paths that cut the same part, but place it differently. (book: language/part)

use std::collections::{BTreeMap, BTreeSet};

use camino::Utf8Path;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::part as messages;
use pathbuild_path::{Part, largest_displacement};

use super::{PlacedProgram, diagnostic_point};
use crate::queries::part::parts_of;

/// A path in a program, with the parts that it cuts.
struct CuttingPath<'db> {
    /// Index into [`PlacedProgram::paths`].
    number: usize,
    name: &'db str,
    parts: Vec<&'db Part>,
}

/// Two paths that cut the same part.
struct Partners<'db> {
    /// The numbers of the paths, in the order of the program.
    paths: [usize; 2],
    part: &'db Part,
    /// The largest distance in mm between the places that the two paths give to a point of the part's outline.
    distance: f64,
    /// The difference in mm between the heights at which the two paths cut the part out; 0 if one of them only cuts into it.
    raised: f64,
}

impl Partners<'_> {
    fn displacement(&self) -> f64 {
        self.distance.max(self.raised)
    }
}

impl<'db> PlacedProgram<'db> {
    /// Returns PB221 for paths that cut the same part of a drawing, but are embedded so that they place it less than O apart, or at
    /// different heights.
    pub(super) fn displaced_paths(&self) -> Vec<Diagnostic> {
        let mut reported = BTreeSet::new();
        let mut found = Vec::new();
        for paths in self.paths_by_drawing().values() {
            let displaced = paths.iter().flat_map(|path| self.displaced_partners(path, paths));
            let new = displaced.filter(|partners| reported.insert(partners.paths));
            found.extend(new.filter_map(|partners| self.displacement_problem(&partners)));
        }
        found
    }

    /// Returns the embedded paths by drawing, for drawings with several different paths in the program. In joined programs, the targets' own paths
    /// count as embedded.
    fn paths_by_drawing(&self) -> BTreeMap<&'db Utf8Path, Vec<CuttingPath<'db>>> {
        let mut drawings: BTreeMap<&Utf8Path, Vec<CuttingPath<'db>>> = BTreeMap::new();
        for (number, path) in self.paths.iter().enumerate() {
            if path.parent.is_some() || self.is_joined {
                let of_drawing = drawings.entry(path.instance.file(self.db).path(self.db)).or_default();
                let name = path.cuts.cuts.name.as_str();
                of_drawing.push(CuttingPath { number, name, parts: Vec::new() });
            }
        }
        drawings.retain(|_, paths| paths.iter().any(|path| path.name != paths[0].name));
        for path in drawings.values_mut().flatten() {
            path.parts = parts_of(self.db, self.paths[path.number].instance);
        }
        drawings
    }

    /// Returns this path with the nearest embedding of each other path that cuts a part together with it, unless that embedding is O or farther away,
    /// or has the part at the same place and height.
    fn displaced_partners(&self, path: &CuttingPath<'db>, all: &[CuttingPath<'db>]) -> Vec<Partners<'db>> {
        let mut nearest: BTreeMap<&str, Partners<'db>> = BTreeMap::new();
        for other in all.iter().filter(|other| other.name != path.name) {
            let Some(partners) = self.partners(path, other) else { continue };
            if nearest.get(other.name).is_none_or(|known| partners.displacement() < known.displacement()) {
                nearest.insert(other.name, partners);
            }
        }
        nearest.into_values().filter(|partners| partners.displacement() > self.settings.tolerance).collect()
    }

    /// Returns two paths as partners if they cut a part together and place it less than O apart. In joined programs, they belong to different
    /// programs.
    fn partners(&self, one: &CuttingPath<'db>, other: &CuttingPath<'db>) -> Option<Partners<'db>> {
        let [cuts, other_cuts] = [one, other].map(|path| &self.paths[path.number].cuts);
        let diameter = 2.0 * cuts.cuts.radius.max(other_cuts.cuts.radius);
        let is_shared = |part: &&Part| other.parts.iter().any(|known| std::ptr::eq(*known, *part));
        let mut shared = one.parts.iter().copied().filter(is_shared).peekable();
        let start = shared.peek()?.rings[0].curves[0].start();
        let is_far = (cuts.placement.place(start) - other_cuts.placement.place(start)).norm() >= diameter;
        if is_far || self.is_joined && self.root(one.number) == self.root(other.number) {
            return None;
        }
        let displaced =
            shared.map(|part| (largest_displacement(part, &cuts.placement, &other_cuts.placement), part));
        let (distance, part) = displaced.reduce(|most, next| if next.0 > most.0 { next } else { most })?;
        let paths = [one.number.min(other.number), one.number.max(other.number)];
        let cut_out = cuts.cuts.is_contour() && other_cuts.cuts.is_contour();
        let raised = if cut_out { (cuts.raised - other_cuts.raised).abs() } else { 0.0 };
        (distance < diameter).then_some(Partners { paths, part, distance, raised })
    }

    fn displacement_problem(
        &self,
        Partners { paths: [earlier, later], part, distance, raised }: &Partners<'db>,
    ) -> Option<Diagnostic> {
        let name = |path: usize| self.paths[path].cuts.cuts.name.as_str();
        let start = part.rings[0].curves[0].start();
        let place = |path: usize| diagnostic_point(self.paths[path].cuts.placement.place(start));
        let problem = if *distance > self.settings.tolerance {
            Diagnostic::new(&messages::DISPLACED_PATH)
                .with("distance", *distance)
                .with("point", place(*later))
                .with("place", place(*earlier))
        } else {
            Diagnostic::new(&messages::RAISED_PATH).with("distance", *raised)
        };
        let problem = problem.quoting("name", name(*later)).quoting("other", name(*earlier));
        let first = || Some((*later, &self.paths[*later].cuts.cuts.elements.first()?.origin));
        let (path, origin) = self.embedding_beside(*later, *earlier).or_else(first)?;
        Some(self.at(path, origin, problem))
    }
}
