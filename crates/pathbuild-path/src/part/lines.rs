//! Closed lines on a part that are not openings: the edge of a pocket, of a chamfer, or of a counterbore. (book: language/part)

use std::collections::BTreeSet;

use pathbuild_diagnostic::Place;

use super::cuts::{CutIndex, IndexedCut, PathCuts, THROUGH_HEIGHT};
use super::intervals::JOIN_GAP;
use super::prepared::PreparedPart;
use super::{DrawnParts, Part};
use crate::boxes::square;
use crate::geometry::{Curve, Xy};

/// Number of sample points on an outline at which the check looks for cuts.
const SAMPLE_COUNT: u32 = 32;

impl DrawnParts {
    /// Uses the cuts of a drawing's paths to report open outlines that lack a piece (PB219), and to leave out openings that are only lines on a part:
    /// paths cut out an opening inside them, but not them. `is_complete`: whether the cuts of all paths are known.
    pub fn judge_outlines(&mut self, paths: &[PathCuts], is_complete: bool) {
        self.judge_open_outlines(paths);
        // Paths that are embedded may cut the outlines.
        if is_complete && paths.iter().all(|path| path.embedded.is_empty()) {
            self.leave_out_lines(paths);
        }
    }

    /// Leaves out the openings that no path cuts out, although some opening inside them is cut out.
    fn leave_out_lines(&mut self, paths: &[PathCuts]) {
        if self.parts.iter().all(|part| part.rings.iter().all(|ring| ring.around.is_empty())) {
            return;
        }
        let paths: Vec<&PathCuts> = paths.iter().collect();
        let cuts = CutIndex::new(&paths);
        for (part, places) in self.parts.iter_mut().zip(&mut self.places) {
            let mut lines = lines_on_part(part, &cuts);
            while !lines.is_empty() {
                part.leave_out_rings(&lines, places);
                lines = lines_on_part(part, &cuts);
            }
        }
    }
}

impl Part {
    /// Removes rings, and their places in the file.
    fn leave_out_rings(&mut self, left_out: &BTreeSet<usize>, places: &mut Vec<Place>) {
        let mut number = 0..;
        places.retain(|_| number.next().is_some_and(|number| !left_out.contains(&number)));
        let mut number = 0..;
        self.rings.retain(|_| number.next().is_some_and(|number| !left_out.contains(&number)));
        for ring in &mut self.rings {
            ring.around.retain(|other| !left_out.contains(other));
            for other in &mut ring.around {
                *other -= left_out.range(..*other).count();
            }
        }
    }
}

/// Returns the outermost openings that no path cuts out, unlike one of those inside them.
fn lines_on_part(part: &Part, cuts: &CutIndex<'_>) -> BTreeSet<usize> {
    let outermost = part.rings.iter().filter_map(|ring| ring.around.first().copied());
    let mut lines: BTreeSet<usize> = outermost.collect();
    if lines.is_empty() {
        return lines;
    }
    let prepared = PreparedPart::new(part);
    lines.retain(|outer| {
        let mut inside = (0..part.rings.len()).filter(|ring| part.rings[*ring].around.first() == Some(outer));
        !is_cut_out(&prepared, *outer, cuts) && inside.any(|ring| is_cut_out(&prepared, ring, cuts))
    });
    lines
}

/// Whether cuts run along most of an opening.
fn is_cut_out(part: &PreparedPart<'_>, ring: usize, cuts: &CutIndex<'_>) -> bool {
    let length = part.ring_length(ring);
    let place = |number| part.ring_point(ring, length * (f64::from(number) + 0.5) / f64::from(SAMPLE_COUNT));
    let cut = (0..SAMPLE_COUNT).map(place).filter(|at| is_cut_at(part, ring, *at, cuts));
    2 * cut.count() > SAMPLE_COUNT as usize
}

/// Whether a cut through the plate comes within O of a place on an opening's edge, on the inside, and its own edge is not nearer to another outline.
fn is_cut_at(part: &PreparedPart<'_>, ring: usize, at: Xy, cuts: &CutIndex<'_>) -> bool {
    let error = |(way, radius): &(Curve, f64)| (way.distance_to(at) - radius).abs();
    let inside = cuts.near(square(at, 0.0)).filter_map(|number| {
        let cut = &cuts.cuts[number];
        let is_own = part.part.may_belong_to(&cuts.paths[cut.path].name);
        let way = through_section_or_segment(cut, cuts)
            .filter(|way| is_own && part.contains(ring, way.middle()))?;
        (way.distance_to(at) < 2.0 * cut.radius).then_some((way, cut.radius))
    });
    let Some(nearest) = inside.min_by(|one, other| error(one).total_cmp(&error(other))) else { return false };
    let (way, radius) = nearest;
    let centre = way.nearest(at);
    let Some(direction) = (at - centre).try_normalize(0.0) else { return false };
    let (edge, error) = (centre + direction * radius, error(&nearest));
    let is_nearer =
        |(other, curve): (usize, &Curve)| other != ring && curve.distance_to(edge) < error - JOIN_GAP;
    !part.curves_near(square(edge, error)).any(is_nearer)
}

/// Returns the section of a cut that goes through the plate or, if support bars interrupt it, the whole segment.
fn through_section_or_segment(cut: &IndexedCut<'_>, cuts: &CutIndex<'_>) -> Option<Curve> {
    let element = cut.element(cuts);
    element.supported.filter(|_| element.bottom <= THROUGH_HEIGHT).or(cut.through_section())
}
